#include "export/equations.hpp"

#include <array>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "simulate/march.hpp"
#include "simulate/traced.hpp"

namespace hysteron {
namespace {

constexpr int numbers_of_an_argument = 1000;

int number_of(Argument argument, int index = 0) { return static_cast<int>(argument) * numbers_of_an_argument + index; }

// Two numbers apiece for what equations take as a plain number: what is done with it must not depend on which.
struct StandIns {
  double speed;
  double change;
  double elapsed;
};
constexpr StandIns stand_ins[] = {{0x1.3c0ca428c59fbp+3, 0x1.71547652b82fep-2, 0x1.0a2b23f3bab73p-9},
                                  {0x1.5bf0a8b145769p+1, 0x1.193ea7aad030bp+4, 0x1.34378fcbda71cp-5}};

// What equations are recorded from.
struct Recorder {
  const Part& part;
  StandIns numbers;
  Tape tape;
  std::vector<Trace> p;
  std::vector<Trace> s;
  Input<Trace> in;
  std::vector<Function::Result> results;

  Recorder(const Part& of, const StandIns& with) : part(of), numbers(with) {
    for (std::size_t k = 0; k < part.parameters.size(); ++k) {
      p.push_back(input(Argument::parameter, static_cast<int>(k)));
    }
    for (int k = 0; k < part.states; ++k) {
      s.push_back(input(Argument::state, k));
    }
    in = {input(Argument::x),   input(Argument::v), input(Argument::drive), input(Argument::time),
          input(Argument::age), input(Argument::a), input(Argument::jerk)};
    tape.stand_in(numbers.speed, input(Argument::speed));
    tape.stand_in(numbers.change, input(Argument::change));
    tape.stand_in(numbers.elapsed, input(Argument::elapsed));
  }
  Trace input(Argument argument, int index = 0) { return tape.input(number_of(argument, index)); }
  void result(Argument target, int index, const Trace& value) {
    results.push_back({{target, index}, tape.node_of(value)});
  }
};

using Record = std::function<void(Recorder&)>;

bool same(const Function& a, const Function& b) {
  if (a.nodes.size() != b.nodes.size() || a.results.size() != b.results.size()) {
    return false;
  }
  for (std::size_t k = 0; k < a.nodes.size(); ++k) {
    const Tape::Node& x = a.nodes[k];
    const Tape::Node& y = b.nodes[k];
    if (x.operation != y.operation || x.a != y.a || x.b != y.b || x.c != y.c || x.value != y.value) {
      return false;
    }
  }
  for (std::size_t k = 0; k < a.results.size(); ++k) {
    if (a.results[k].node != b.results[k].node || a.results[k].target.argument != b.results[k].target.argument ||
        a.results[k].target.index != b.results[k].target.index) {
      return false;
    }
  }
  return true;
}

Function recorded_with(const Part& part, const StandIns& numbers, const Record& record) {
  Recorder recorder(part, numbers);
  record(recorder);
  return {recorder.tape.nodes(), std::move(recorder.results)};
}

Function recorded(const Part& part, const Record& record) {
  Function result = recorded_with(part, stand_ins[0], record);
  if (!same(result, recorded_with(part, stand_ins[1], record))) {
    throw InputError("export: " + std::string(part.id) +
                     " computes with a plain number of the march, expected T(speed) and T(elapsed) in its equations");
  }
  return result;
}

// A motion's members in the order of Input.
template <class Visit>
void for_members(const Input<Trace>& before, const Input<Trace>& after, Visit&& visit) {
  visit(Argument::x, before.x, after.x);
  visit(Argument::v, before.v, after.v);
  visit(Argument::drive, before.drive, after.drive);
  visit(Argument::time, before.time, after.time);
  visit(Argument::age, before.age, after.age);
  visit(Argument::a, before.a, after.a);
  visit(Argument::jerk, before.jerk, after.jerk);
}

Function excitation(const Part& part, const TracedPart& traced, bool first) {
  return recorded(part, [&](Recorder& r) {
    std::array<Trace, excitation_memory> memory;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      memory[k] = r.input(Argument::memory, static_cast<int>(k));
    }
    Trace drive = r.input(Argument::acting);
    traced.excite(r.p.data(), memory.data(), first ? -1.0 : r.numbers.elapsed, drive);
    r.result(Argument::acting, 0, drive);
    for (std::size_t k = 0; k < memory.size(); ++k) {
      if (r.tape.node_of(memory[k]) != r.tape.node_of(r.input(Argument::memory, static_cast<int>(k)))) {
        r.result(Argument::memory, static_cast<int>(k), memory[k]);
      }
    }
  });
}

}  // namespace

ArgumentNumber argument_of_input(int number) {
  return {static_cast<Argument>(number / numbers_of_an_argument), number % numbers_of_an_argument};
}

PartEquations equations_of(const Part& part) {
  const TracedPart& traced = *part.traced;
  PartEquations result;
  if (traced.yield != nullptr) {
    result.yield = recorded(part, [&](Recorder& r) {
      Yield<Trace> yield;
      traced.yield(r.p.data(), r.s[0], yield);
      int place = 0;
      for (const Trace& value : {yield.deflection, yield.slope, yield.bend, yield.gain, yield.hold, yield.width}) {
        r.result(Argument::state, place++, value);
      }
    });
    return result;
  }
  if (traced.drive != nullptr) {
    result.drive = recorded(part, [&](Recorder& r) {
      Input<Trace> seen = r.in;
      traced.drive(r.p.data(), r.s.data(), seen);
      for_members(r.in, seen, [&](Argument argument, const Trace& before, const Trace& after) {
        if (r.tape.node_of(before) != r.tape.node_of(after)) {
          r.result(argument, 0, after);
        }
      });
    });
  }
  if (part.states > 0) {
    result.loaded = traced.loaded_rate != nullptr;
    result.rate = recorded(part, [&](Recorder& r) {
      std::vector<Trace> rates(static_cast<std::size_t>(part.states));
      if (traced.loaded_rate != nullptr) {
        traced.loaded_rate(r.p.data(), r.s.data(), r.in, r.input(Argument::below), rates.data());
      } else {
        traced.rate(r.p.data(), r.s.data(), r.in, rates.data());
      }
      for (int k = 0; k < part.states; ++k) {
        r.result(Argument::state, k, rates[static_cast<std::size_t>(k)]);
      }
    });
    result.stiffness = recorded(
        part, [&](Recorder& r) { r.result(Argument::state, 0, traced.stiffness(r.p.data(), r.numbers.speed)); });
  }
  result.settles = traced.settles;
  if (traced.settles >= 0) {
    result.towards = recorded(
        part, [&](Recorder& r) { r.result(Argument::state, 0, traced.towards(r.p.data(), r.s.data(), r.in)); });
    result.slack = recorded(part, [&](Recorder& r) { r.result(Argument::state, 0, traced.slack(r.p.data())); });
    if (traced.stiffness_near != nullptr) {
      result.stiffness_near = recorded(part, [&](Recorder& r) {
        r.result(Argument::state, 0,
                 traced.stiffness_near(r.p.data(), r.s.data(), r.in.v, r.numbers.speed, r.numbers.change));
      });
    }
  }
  result.force = recorded(part, [&](Recorder& r) {
    Trace force = r.input(Argument::below);
    traced.force(r.p.data(), r.s.data(), r.in, force);
    r.result(Argument::below, 0, force);
  });
  if (traced.recall != nullptr) {
    result.recall = recorded(part, [&](Recorder& r) {
      Trace drive = r.input(Argument::acting);
      traced.recall(r.p.data(), Command{}, drive);
      r.result(Argument::acting, 0, drive);
    });
  }
  if (traced.excite != nullptr) {
    result.excite_first = excitation(part, traced, true);
    result.excite = excitation(part, traced, false);
  }
  return result;
}

}  // namespace hysteron

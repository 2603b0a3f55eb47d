#include "bench/work_of_march.hpp"

#include <functional>

#include "export/equations.hpp"
#include "simulate/march.hpp"

namespace hysteron::bench {
namespace {

using Operation = TraceOperation;
using Arguments = std::function<double(ArgumentNumber)>;

double value_of_node(const Tape::Node& node, const std::vector<double>& known, const Arguments& argument) {
  const auto at = [&](int index) { return known[static_cast<std::size_t>(index)]; };
  switch (node.operation) {
    case Operation::constant:
      return node.value;
    case Operation::input:
      return argument(argument_of_input(node.a));
    case Operation::negate:
      return -at(node.a);
    case Operation::add:
      return at(node.a) + at(node.b);
    case Operation::subtract:
      return at(node.a) - at(node.b);
    case Operation::multiply:
      return at(node.a) * at(node.b);
    case Operation::divide:
      return at(node.a) / at(node.b);
    case Operation::minimum:
      return min(at(node.a), at(node.b));
    case Operation::maximum:
      return max(at(node.a), at(node.b));
    case Operation::absolute:
      return abs(at(node.a));
    case Operation::square_root:
      return sqrt(at(node.a));
    case Operation::exponential:
      return exp(at(node.a));
    case Operation::logarithm:
      return log(at(node.a));
    case Operation::power:
      return pow(at(node.a), at(node.b));
    case Operation::power_law:
      return power_law(at(node.a), at(node.b));
    case Operation::hyperbolic_tangent:
      return tanh(at(node.a));
    case Operation::earlier:
      return 0.0;
    case Operation::less:
      return at(node.a) < at(node.b) ? 1.0 : 0.0;
    case Operation::both:
      return at(node.a) * at(node.b);
    case Operation::either:
      return max(at(node.a), at(node.b));
    case Operation::choose:
      return at(node.a) != 0.0 ? at(node.b) : at(node.c);
  }
  return 0.0;
}

std::vector<double> values_of(const Function& function, const Arguments& argument) {
  std::vector<double> known;
  for (const Tape::Node& node : function.nodes) {
    known.push_back(value_of_node(node, known, argument));
  }
  return known;
}

double result_of(const Function& function, const Arguments& argument) {
  return values_of(function, argument)[static_cast<std::size_t>(function.results.at(0).node)];
}

// Those of scalar/math.hpp.
constexpr double operations_of_exp = 30.0;
constexpr double operations_of_log = 28.0;
constexpr double operations_of_pow = operations_of_exp + operations_of_log + 1.0;
constexpr double operations_of_tanh = 35.0;

double operations_of_node(const Tape::Node& node, const std::vector<double>& known) {
  switch (node.operation) {
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::square_root:
      return 1.0;
    case Operation::exponential:
      return operations_of_exp;
    case Operation::logarithm:
      return operations_of_log;
    case Operation::power:
      return operations_of_pow;
    case Operation::power_law: {
      const double exponent = known[static_cast<std::size_t>(node.b)];
      return exponent == 1.0 ? 0.0 : exponent == 2.0 ? 1.0 : 1.0 + operations_of_pow;
    }
    case Operation::hyperbolic_tangent:
      return operations_of_tanh;
    default:
      return 0.0;
  }
}

// Of the nodes that depend on more than parameters: those are done once a march.
double operations_of(const Function& function, const std::vector<double>& p) {
  const std::vector<double> known = values_of(function, [&](const ArgumentNumber& number) {
    return number.argument == Argument::parameter ? p.at(static_cast<std::size_t>(number.index)) : 0.0;
  });
  std::vector<bool> varies;
  double sum = 0.0;
  for (const Tape::Node& node : function.nodes) {
    bool own = false;
    if (node.operation == Operation::input) {
      own = argument_of_input(node.a).argument != Argument::parameter;
    } else {
      for (const int from : {node.a, node.b, node.c}) {
        own = own || (from >= 0 && varies[static_cast<std::size_t>(from)]);
      }
    }
    if (own) sum += operations_of_node(node, known);
    varies.push_back(own);
  }
  return sum;
}

// The law as the march of a law alone sees it (simulate/compile.hpp), counting.
class CountingLaw {
 public:
  CountingLaw(const Part& law, const PartEquations& equations) : law_(law), equations_(equations) {}

  [[nodiscard]] double count() const { return count_; }

  [[nodiscard]] int states() const { return law_.states; }
  void rate(const double* p, const double* s, const Input<double>& in, double* rates) const {
    ++count_;
    law_.on_double.rate(p, s, in, rates);
  }
  [[nodiscard]] double force(const double* /*p*/, const double* /*s*/, const Input<double>& /*in*/) const {
    return 0.0;
  }
  double stiffness(const double* p, double speed) const { return law_.on_double.stiffness(p, speed); }
  [[nodiscard]] bool settles() const { return law_.on_double.settles >= 0; }
  void rest(const double* p, const double* s, const Input<double>& in, double* rates) const {
    law_.on_double.rest(p, s, in, rates);
  }
  double stiffness_now(const double* p, const double* s, const double* rates, const Input<double>& in, double speed,
                       double change) const {
    if (detail::rests(rates[law_.on_double.settles])) return law_.on_double.slack(p);
    if (!equations_.stiffness_near) return stiffness(p, speed);
    return result_of(*equations_.stiffness_near, [&](const ArgumentNumber& number) {
      return number.argument == Argument::speed    ? speed
             : number.argument == Argument::change ? change
                                                   : argument(p, s, in, number);
    });
  }
  [[nodiscard]] bool woken(const double* before, const double* now, double little) const {
    const int k = law_.on_double.settles;
    return detail::rests(before[k]) && abs(now[k]) > little;
  }
  static constexpr bool knows_kinks() { return true; }
  bool kinked(const double* p, const double* before, const Input<double>& in_before, const double* now,
              const Input<double>& in_now) const {
    const int k = law_.on_double.settles;
    return towards(p, before, in_before) * towards(p, now, in_now) < 0.0 || before[k] * now[k] < 0.0;
  }

 private:
  static double argument(const double* p, const double* s, const Input<double>& in, const ArgumentNumber& number) {
    switch (number.argument) {
      case Argument::parameter:
        return p[number.index];
      case Argument::state:
        return s[number.index];
      case Argument::x:
        return in.x;
      case Argument::v:
        return in.v;
      case Argument::drive:
        return in.drive;
      case Argument::time:
        return in.time;
      case Argument::age:
        return in.age;
      case Argument::a:
        return in.a;
      case Argument::jerk:
        return in.jerk;
      default:
        return 0.0;
    }
  }
  double towards(const double* p, const double* s, const Input<double>& in) const {
    return result_of(*equations_.towards, [&](const ArgumentNumber& number) { return argument(p, s, in, number); });
  }

  const Part& law_;
  const PartEquations& equations_;
  mutable double count_ = 0.0;
};

}  // namespace

WorkOfMarch work_of_march(const Part& law, const Motion& motion, const std::vector<double>& p) {
  const PartEquations equations = equations_of(law);
  const auto samples = static_cast<double>(motion.time.size());
  WorkOfMarch work;
  if (equations.force) work.operations = operations_of(*equations.force, p);
  if (law.states == 0) return work;
  const CountingLaw counting(law, equations);
  std::vector<double> state(max_states);
  std::vector<double> force(motion.time.size());
  march<double>(counting, motion, p.data(), 0, 0, force.size(), state.data(), force.data());
  work.rates = counting.count() / samples;
  constexpr double sums_of_step = 12.0;  // of a state: three stages of two, and six at the end
  const double of_rate = operations_of(*equations.rate, p) + sums_of_step * law.states / 4.0;
  work.operations_of_step = work.operations + 4.0 * of_rate;
  work.operations += work.rates * of_rate;
  return work;
}

}  // namespace hysteron::bench

#include "export/modelica_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "export/names.hpp"
#include "export/writer.hpp"

namespace hysteron {
namespace {

std::string signed_literal(double value) { return value < 0.0 ? "(" + literal(value) + ")" : literal(value); }

std::string quoted(std::string text) {
  std::ranges::replace(text, '"', '\'');
  std::ranges::replace(text, '\\', '/');
  return text;
}

std::string name_of_parameter(const ExportedLink& link, std::size_t k) {
  return identifier(link.name + "_" + std::string(link.part->parameters[k].name));
}

std::string name_of_state(const ExportedLink& link, int k) {
  return link.part->states == 1 ? "state_of_" + link.name : fmt::format("state_{}_of_{}", k + 1, link.name);
}

// What a link sees of the motion, by name.
using Seen = std::map<Argument, std::string>;

std::string name_of_seen(Argument argument) {
  static constexpr const char* members[] = {"x", "v", "drive", "time", "age", "a", "jerk"};
  return members[static_cast<int>(argument) - static_cast<int>(Argument::x)];
}

class Block {
 public:
  Block(const ExportedModel& exported, const TestVector& vector)
      : exported_(exported), vector_(vector), links_(links_of(exported)) {
    declare_parameters();
    act_on_drive();
    follow_motion();
    std::string force;
    for (std::size_t i = 0; i < links_.size(); ++i) force = add_link(i, force);
    equation("the force", "force", force);
  }

  ModelicaBlock finished() {
    ModelicaBlock block;
    block.drive = used_.contains("drive");
    block.acceleration = used_.contains("acceleration");
    block.jerk = used_.contains("jerk");
    block.samples = !updates_.empty();
    std::string& text = block.text;
    text = functions_;
    text += "  block Damper \"Force of the damper as its equations give it\"\n";
    text += "    input Real displacement(unit = \"m\");\n    input Real velocity(unit = \"m/s\") \"its derivative\";\n";
    if (block.acceleration) text += "    input Real acceleration(unit = \"m/s2\") \"of the whole damper\";\n";
    if (block.jerk) text += "    input Real jerk(unit = \"m/s3\") \"derivative of the acceleration\";\n";
    if (block.drive) text += fmt::format("    input Real drive \"{}\";\n", exported_.about_drive());
    text += "    output Real force(unit = \"N\");\n";
    text += fmt::format(
        "    parameter Real frequency(unit = \"Hz\") = {} \"of the motion, where parameters follow it\";\n"
        "    parameter Real startTime(unit = \"s\") = 0 \"when the motion begins\";\n"
        "    parameter Real lead(unit = \"s\") = 0 \"for which it went on before\";\n",
        literal(vector_.frequency));
    if (block.samples) {
      text += fmt::format("    parameter Real samplePeriod(unit = \"s\") = {} \"of what remembers the drive\";\n",
                          literal(sample_period()));
    }
    text += parameters_ + "  protected\n" + variables_;
    if (block.samples) {
      text += "    discrete Real sampled(start = 0, fixed = false) \"when the drive was last remembered\";\n";
      text += "  initial equation\n    sampled = startTime;\n" + initial_;
    }
    text += "  equation\n" + equations_;
    if (block.samples) {
      text += "    when sample(startTime + samplePeriod, samplePeriod) then\n      sampled = time;\n" + updates_ +
              "    end when;\n";
    }
    text += "  end Damper;\n";
    return block;
  }

 private:
  [[nodiscard]] double sample_period() const {
    return vector_.samples.size() < 2 ? 1e-3
                                      : (vector_.samples.back().time - vector_.samples.front().time) /
                                            static_cast<double>(vector_.samples.size() - 1);
  }

  std::string use(const std::string& input) {
    used_.insert(input);
    return input;
  }

  void declare(const std::string& name, const std::string& meaning) {
    variables_ += fmt::format("    Real {}{};\n", name, meaning.empty() ? "" : " \"" + quoted(meaning) + "\"");
  }
  void equation(const std::string& meaning, const std::string& left, const std::string& right) {
    equations_ += fmt::format("    {} = {}{};\n", left, right, meaning.empty() ? "" : " \"" + quoted(meaning) + "\"");
  }

  // A polynomial in the drive that acts, or in another.
  std::string polynomial(std::size_t k, const std::string& drive) {
    std::string text;
    if (std::ranges::count(exported_.terms, k, &Term::parameter) == 1 && drive.empty()) {
      const Term& term = *std::ranges::find(exported_.terms, k, &Term::parameter);
      if (term.frequency_power == 0) return literal(term.value);  // which may have its sign
    }
    for (const Term& term : exported_.terms) {
      if (term.parameter != k) continue;
      std::string product = signed_literal(term.value);
      for (int power = 0; power < term.drive_power; ++power) product += " * " + drive;
      for (int power = 0; power < term.frequency_power; ++power) product += " * frequency";
      text += (text.empty() ? "" : " + ") + product;
    }
    return text.empty() ? literal(exported_.held[k]) : text;
  }
  [[nodiscard]] bool follows_drive(std::size_t k) const {
    return std::ranges::any_of(exported_.terms,
                               [&](const Term& term) { return term.parameter == k && term.drive_power > 0; });
  }

  void declare_parameters() {
    for (const ExportedLink& link : links_) {
      for (std::size_t k = 0; k < link.part->parameters.size(); ++k) {
        const Parameter& card = link.part->parameters[k];
        const std::string meaning = fmt::format("{}, {}", card.meaning, card.unit);
        const std::string name = name_of_parameter(link, k);
        if (!follows_drive(link.parameter + k)) {
          parameters_ += fmt::format("    parameter Real {} = {} \"{}\";\n", name, polynomial(link.parameter + k, ""),
                                     quoted(meaning));
          continue;
        }
        declare(name, meaning);
        equation("", name, polynomial(link.parameter + k, "acting"));
      }
    }
  }

  // Of an operation on the drive, which takes its parameters at the drive as it is recorded.
  std::string recorded_parameter(const ExportedLink& link, int k) {
    const auto number = static_cast<std::size_t>(k);
    if (!follows_drive(link.parameter + number)) return name_of_parameter(link, number);
    return "(" + polynomial(link.parameter + number, use("drive")) + ")";
  }

  void act_on_drive() {
    if (!exported_.follows_drive()) return;
    declare("acting", "the drive that parameters follow");
    std::string acting = use("drive");
    for (std::size_t i = links_.size(); i-- > 0;) {
      if (links_[i].equations.recall) acting = recall(links_[i], acting);
    }
    for (std::size_t i = links_.size(); i-- > 0;) {
      if (links_[i].equations.excite) acting = excite(links_[i], acting);
    }
    equation("", "acting", acting);
  }

  std::string recall(const ExportedLink& link, const std::string& acting) {
    const auto name_of = [&](const ArgumentNumber& number) {
      if (number.argument == Argument::acting) return acting;
      if (follows_drive(link.parameter + static_cast<std::size_t>(number.index))) {
        throw InputError("export: modelica: a delay that follows the drive, expected a constant " + link.name);
      }
      return name_of_parameter(link, static_cast<std::size_t>(number.index));
    };
    const Statements statements = write_modelica(*link.equations.recall, name_of, "_of_" + link.name, "=");
    add_temporaries(statements);
    const std::string name = "drive_behind_" + link.name;
    declare(name, "drive as " + std::string(link.part->id) + " leaves it");
    equation("", name, statements.results.front().expression);
    return name;
  }

  // As a function, because it is called at every sample with what it remembers, and in between.
  std::string excite(const ExportedLink& link, const std::string& acting) {
    const std::string call = link.name + "_excite";
    const int kept = static_cast<int>(excitation_memory);
    add_function(link, call + "_first", *link.equations.excite_first);
    add_function(link, call, *link.equations.excite);
    std::string arguments;
    for (std::size_t k = 0; k < link.part->parameters.size(); ++k) {
      arguments += recorded_parameter(link, static_cast<int>(k)) + ", ";
    }
    std::string memory;
    std::string before;
    std::string zeros;
    for (int k = 0; k < kept; ++k) {
      const std::string name = fmt::format("memory_{}_of_{}", k + 1, link.name);
      variables_ += fmt::format("    discrete Real {}(start = 0, fixed = false);\n", name);
      memory += (k == 0 ? "" : ", ") + name;
      before += "pre(" + name + "), ";
      zeros += "0.0, ";
    }
    const std::string then = fmt::format("memory_{}_of_{}", kept + 1, link.name);
    variables_ += fmt::format("    discrete Real {}(start = 0, fixed = false) \"drive at the last sample\";\n", then);
    initial_ += fmt::format("    ({}, {}) = {}_first({}{}0.0, {});\n", then, memory, call, arguments, zeros, acting);
    updates_ += fmt::format("      ({}, {}) = {}({}{}time - pre(sampled), {});\n", then, memory, call, arguments,
                            before, acting);
    const std::string name = "drive_behind_" + link.name;
    declare(name, "drive as " + std::string(link.part->id) + " leaves it");
    equation("", name, fmt::format("{}({}{}, max(time - sampled, 1e-9), {})", call, arguments, memory, acting));
    return name;
  }

  void add_function(const ExportedLink& link, const std::string& name, const Function& code) {
    const auto name_of = [&](const ArgumentNumber& number) {
      switch (number.argument) {
        case Argument::parameter:
          return name_of_parameter(link, static_cast<std::size_t>(number.index));
        case Argument::memory:
          return fmt::format("before_{}", number.index + 1);
        case Argument::elapsed:
          return std::string("elapsed");
        default:
          return std::string("drive");
      }
    };
    const Statements statements = write_modelica(code, name_of, "", ":=");
    std::string& text = functions_;
    text += fmt::format("  function {} \"{}: the drive that acts, and what is remembered\"\n", name,
                        quoted(std::string(link.part->title)));
    for (std::size_t k = 0; k < link.part->parameters.size(); ++k) {
      text += fmt::format("    input Real {};\n", name_of_parameter(link, k));
    }
    std::array<std::string, excitation_memory> after;
    for (std::size_t k = 0; k < after.size(); ++k) {
      after[k] = fmt::format("before_{}", k + 1);
      text += fmt::format("    input Real before_{};\n", k + 1);
    }
    text += "    input Real elapsed;\n    input Real drive;\n    output Real acting;\n";
    for (std::size_t k = 0; k < after.size(); ++k) text += fmt::format("    output Real after_{};\n", k + 1);
    if (!statements.names.empty()) {
      text += "  protected\n";
      for (const std::string& temporary : statements.names) text += fmt::format("    Real {};\n", temporary);
    }
    text += "  algorithm\n";
    for (const std::string& line : statements.lines) text += "    " + line + ";\n";
    std::string acting = "drive";
    for (const Statements::Result& result : statements.results) {
      if (result.target.argument == Argument::memory) {
        after[static_cast<std::size_t>(result.target.index)] = result.expression;
      } else {
        acting = result.expression;
      }
    }
    text += "    acting := " + acting + ";\n";
    for (std::size_t k = 0; k < after.size(); ++k) text += fmt::format("    after_{} := {};\n", k + 1, after[k]);
    text += "  end " + name + ";\n\n";
  }

  void add_temporaries(const Statements& statements) {
    for (std::size_t k = 0; k < statements.names.size(); ++k) {
      declare(statements.names[k], "");
      equations_ += "    " + statements.lines[k] + ";\n";
    }
  }

  // From the outermost link inwards: each sees the motion as those outside leave it.
  void follow_motion() {
    seen_.resize(links_.size());
    Seen seen = {{Argument::x, "displacement"},
                 {Argument::v, "velocity"},
                 {Argument::drive, "drive"},
                 {Argument::time, "(time - startTime)"},
                 {Argument::age, "(time - startTime + lead)"},
                 {Argument::a, "acceleration"},
                 {Argument::jerk, "jerk"}};
    for (std::size_t i = links_.size(); i-- > 0;) {
      seen_[i] = seen;
      const ExportedLink& link = links_[i];
      if (link.equations.yield) {
        seen[Argument::x] = "x_behind_" + link.name;
        seen[Argument::v] = "v_behind_" + link.name;
      } else if (link.equations.drive) {
        for (const Function::Result& result : link.equations.drive->results) {
          seen[result.target.argument] = fmt::format("{}_behind_{}", name_of_seen(result.target.argument), link.name);
        }
      }
    }
  }

  // Equations of a link on the force of those below; returns that of both.
  std::string add_link(std::size_t i, const std::string& below) {
    const ExportedLink& link = links_[i];
    equations_ += fmt::format("    // {}\n", link.part->title);
    for (int k = 0; k < link.part->states; ++k) {
      variables_ += fmt::format("    Real {}(start = 0, fixed = true);\n", name_of_state(link, k));
    }
    const auto name_of = [&](const ArgumentNumber& number) -> std::string {
      switch (number.argument) {
        case Argument::parameter:
          return name_of_parameter(link, static_cast<std::size_t>(number.index));
        case Argument::state:
          return name_of_state(link, number.index);
        case Argument::below:
          return below.empty() ? "0.0" : below;
        default:
          return use(seen_[i].at(number.argument));
      }
    };
    int functions = 0;
    const auto write = [&](const Function& function) {
      Statements statements = write_modelica(
          function, name_of,
          fmt::format("{}_of_{}", std::string(static_cast<std::size_t>(functions++), 'b'), link.name), "=");
      add_temporaries(statements);
      return statements.results;
    };
    if (link.equations.yield) return add_series(link, i, below, write);
    if (link.equations.drive) {
      for (const Statements::Result& result : write(*link.equations.drive)) {
        const std::string member = name_of_seen(result.target.argument);
        const std::string name = fmt::format("{}_behind_{}", member, link.name);
        declare(name, fmt::format("{} as what is inside sees it", member));
        equation("", name, result.expression);
      }
    }
    if (link.equations.rate) {
      for (const Statements::Result& result : write(*link.equations.rate)) {
        equation("", "der(" + name_of_state(link, result.target.index) + ")", result.expression);
      }
    }
    const std::string force = write(*link.equations.force).front().expression;
    if (force == below) return below;
    const std::string name = "force_of_" + link.name;
    declare(name, i == 0 ? "N, of the law" : "N, with what is inside");
    equation("", name, force);
    return name;
  }

  // An element of state q deflects by D(q): q' = gain (F - hold q).
  std::string add_series(const ExportedLink& link, std::size_t i, const std::string& below,
                         const std::function<std::vector<Statements::Result>(const Function&)>& write) {
    enum Place { deflection, slope, bend, gain, hold };
    Function needed = *link.equations.yield;
    std::erase_if(needed.results, [](const Function::Result& result) {
      return result.target.index == bend || result.target.index > hold;
    });
    std::map<int, std::string> law;
    for (const Statements::Result& result : write(needed)) law[result.target.index] = "(" + result.expression + ")";
    const std::string q = name_of_state(link, 0);
    const std::string x = "x_behind_" + link.name;
    const std::string v = "v_behind_" + link.name;
    declare(x, "displacement behind the element");
    declare(v, "velocity behind the element");
    equation("", "der(" + q + ")", fmt::format("{} * ({} - {} * {})", law[gain], below, law[hold], q));
    equation("", x, fmt::format("{} - {}", use(seen_[i].at(Argument::x)), law[deflection]));
    equation("", v, fmt::format("{} - {} * der({})", use(seen_[i].at(Argument::v)), law[slope], q));
    return below;
  }

  const ExportedModel& exported_;
  const TestVector& vector_;
  std::vector<ExportedLink> links_;
  std::vector<Seen> seen_;
  std::set<std::string> used_;
  std::string functions_;
  std::string parameters_;
  std::string variables_;
  std::string equations_;
  std::string initial_;
  std::string updates_;
};

// One column of the replayed samples.
std::string column(const char* name, const std::vector<double>& values) {
  std::string text = fmt::format("    constant Real {}[:] = {{", name);
  for (std::size_t n = 0; n < values.size(); ++n) {
    text += (n == 0 ? "" : n % 6 == 0 ? ",\n      " : ", ") + literal(values[n]);
  }
  return text + "};\n";
}
std::string column(const char* name, const std::vector<TestSample>& samples, double TestSample::*member) {
  std::vector<double> values(samples.size());
  std::ranges::transform(samples, values.begin(), [member](const TestSample& sample) { return sample.*member; });
  return column(name, values);
}

}  // namespace

ModelicaBlock modelica_block(const ExportedModel& exported, const TestVector& vector) {
  return Block(exported, vector).finished();
}

std::string modelica_test(const TestVector& vector, const ModelicaBlock& block) {
  // What is marched beforehand ends where the samples begin.
  std::vector<TestSample> samples = vector.lead_in;
  const std::size_t first = samples.empty() ? 0 : samples.size() - 1;
  samples.resize(first);
  const double begin = vector.samples.front().time;
  const double lead = first > 0 ? vector.lead_in.back().time - vector.lead_in.front().time : 0.0;
  for (TestSample& sample : samples) sample.time += begin - vector.lead_in.back().time;
  samples.insert(samples.end(), vector.samples.begin(), vector.samples.end());
  std::vector<double> force(first, 0.0);
  force.insert(force.end(), vector.force.begin(), vector.force.end());
  double peak = 0.0;
  for (const double value : force) peak = std::max(peak, std::abs(value));
  std::string text =
      "  model Test \"Replays the test vector: error is the largest difference, as a share of the largest force\"\n";
  text += fmt::format("    Damper damper(startTime = {}, lead = {});\n", signed_literal(begin), literal(lead));
  text += "    discrete Real error(start = 0, fixed = true);\n  protected\n";
  text += column("t", samples, &TestSample::time) + column("x", samples, &TestSample::displacement) +
          column("v", samples, &TestSample::velocity) + column("slope", samples, &TestSample::slope);
  if (block.acceleration || block.jerk) {
    text += column("a", samples, &TestSample::acceleration) + column("j", samples, &TestSample::jerk);
  }
  if (block.drive) text += column("i", samples, &TestSample::drive);
  text += column("expected", force);
  text += fmt::format("    constant Integer first = {} \"before it nothing is compared\";\n", first + 1);
  text += fmt::format("    constant Real largest = {};\n", literal(peak > 0.0 ? peak : 1.0));
  text +=
      "    discrete Integer n(start = 1, fixed = true) \"the last sample\";\n"
      "    Real h, u;\n"
      "  equation\n"
      "    when time >= t[min(pre(n) + 1, size(t, 1))] then\n"
      "      n = min(pre(n) + 1, size(t, 1) - 1);\n"
      "      error = if pre(n) + 1 < first then 0 else max(pre(error), abs(damper.force - expected[pre(n) + 1]) / "
      "largest);\n"
      "    end when;\n"
      "    h = t[n + 1] - t[n];\n"
      "    u = (time - t[n]) / h;\n"
      "    damper.displacement = cubic(u, h, x[n], x[n + 1], v[n], v[n + 1]);\n"
      "    damper.velocity = cubic(u, h, v[n], v[n + 1], slope[n], slope[n + 1]);\n";
  if (block.acceleration) text += "    damper.acceleration = cubic(u, h, a[n], a[n + 1], j[n], j[n + 1]);\n";
  if (block.jerk) text += "    damper.jerk = cubicSlope(u, h, a[n], a[n + 1], j[n], j[n + 1]);\n";
  if (block.drive) text += "    damper.drive = i[n] + (i[n + 1] - i[n]) * u;\n";
  text += fmt::format(
      "    annotation(experiment(StartTime = {}, StopTime = {}, Tolerance = 1e-9, Interval = {}));\n  end Test;\n",
      signed_literal(samples.front().time), literal(samples.back().time),
      literal((samples.back().time - samples.front().time) / static_cast<double>(samples.size() - 1)));
  return text;
}

}  // namespace hysteron

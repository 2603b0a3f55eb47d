#include "export/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "export/names.hpp"

namespace hysteron {
namespace {

// Longer expressions are given a name.
constexpr std::size_t longest_expression = 80;

// How tightly an expression holds together, in all languages.
enum Tightness { choice, disjunction, conjunction, comparison, sum, product, sign, whole };

struct Expression {
  std::string text;
  Tightness tightness = whole;
};

using NameOf = std::function<std::string(const ArgumentNumber&)>;

// An input in C or Python.
std::string name_in_code(const ArgumentNumber& number, std::span<const Parameter> parameters, Language language) {
  const char* member = language == Language::c ? "in->" : "seen.";
  switch (number.argument) {
    case Argument::parameter:
      return parameter_identifier(parameters[static_cast<std::size_t>(number.index)]);
    case Argument::state:
      return fmt::format("s[{}]", number.index);
    case Argument::memory:
      return fmt::format("memory[{}]", number.index);
    case Argument::x:
      return member + std::string("x");
    case Argument::v:
      return member + std::string("v");
    case Argument::drive:
      return member + std::string("drive");
    case Argument::time:
      return member + std::string("time");
    case Argument::age:
      return member + std::string("age");
    case Argument::a:
      return member + std::string("a");
    case Argument::jerk:
      return member + std::string("jerk");
    case Argument::below:
      return "below";
    case Argument::speed:
      return "speed";
    case Argument::change:
      return "change";
    case Argument::elapsed:
      return "elapsed";
    case Argument::acting:
      return "drive";
  }
  return {};
}

class Printer {
 public:
  Printer(const Function& function, Language language, const NameOf& name_of, std::string behind_temporaries,
          std::string assign)
      : function_(function),
        language_(language),
        name_of_(name_of),
        behind_temporaries_(std::move(behind_temporaries)),
        assign_(std::move(assign)),
        uses_(function.nodes.size(), 0) {
    std::vector<bool> needed(function.nodes.size(), false);
    for (const Function::Result& result : function.results) {
      needed[static_cast<std::size_t>(result.node)] = true;
      ++uses_[static_cast<std::size_t>(result.node)];
    }
    for (std::size_t k = function.nodes.size(); k-- > 0;) {
      const Tape::Node& node = function.nodes[k];
      if (!needed[k] || node.operation == TraceOperation::input || node.operation == TraceOperation::constant) {
        continue;
      }
      for (const int argument : {node.a, node.b, node.c}) {
        if (argument >= 0) {
          needed[static_cast<std::size_t>(argument)] = true;
          ++uses_[static_cast<std::size_t>(argument)];
        }
      }
    }
    expressions_.resize(function.nodes.size());
    for (std::size_t k = 0; k < function.nodes.size(); ++k) {
      if (needed[k]) {
        place(k);
      }
    }
  }

  Statements statements() {
    for (const Function::Result& result : function_.results) {
      statements_.results.push_back({result.target, expressions_[static_cast<std::size_t>(result.node)].text});
    }
    return std::move(statements_);
  }

 private:
  void place(std::size_t k) {
    const Tape::Node& node = function_.nodes[k];
    Expression expression = print(node);
    const bool truth = node.operation == TraceOperation::less || node.operation == TraceOperation::both ||
                       node.operation == TraceOperation::either;
    const bool plain = node.operation == TraceOperation::input || node.operation == TraceOperation::constant;
    if (!plain && !truth && (uses_[k] > 1 || expression.text.size() > longest_expression)) {
      const std::string name = fmt::format("t{}{}", ++temporaries_, behind_temporaries_);
      statements_.lines.push_back(language_ == Language::c ? fmt::format("const double {} = {};", name, expression.text)
                                                           : fmt::format("{} {} {}", name, assign_, expression.text));
      statements_.names.push_back(name);
      expression = {name, whole};
    }
    expressions_[k] = expression;
  }

  [[nodiscard]] std::string inside(int node, Tightness least) const {
    const Expression& expression = expressions_[static_cast<std::size_t>(node)];
    return expression.tightness < least ? "(" + expression.text + ")" : expression.text;
  }
  [[nodiscard]] const std::string& bare(int node) const { return expressions_[static_cast<std::size_t>(node)].text; }
  [[nodiscard]] std::string call(const char* c, const char* python, const char* modelica,
                                 const Tape::Node& node) const {
    std::string text = by_language(c, python, modelica) + "(" + bare(node.a);
    if (node.b >= 0) {
      text += ", " + bare(node.b);
    }
    return text + ")";
  }

  [[nodiscard]] std::string by_language(const char* c, const char* python, const char* modelica) const {
    return language_ == Language::c ? c : language_ == Language::python ? python : modelica;
  }

  Expression print(const Tape::Node& node) {
    const bool c = language_ == Language::c;
    const bool modelica = language_ == Language::modelica;
    // In Modelica a sign may only begin a sum.
    const Tightness signed_as = modelica ? sum : sign;
    const Tightness factor = modelica ? whole : sign;
    switch (node.operation) {
      case TraceOperation::constant:
        return {literal(node.value), node.value < 0.0 ? signed_as : whole};
      case TraceOperation::input:
        return {input(argument_of_input(node.a)), whole};
      case TraceOperation::negate:
        return {"-" + inside(node.a, whole), signed_as};
      case TraceOperation::add:
        return {inside(node.a, sum) + " + " + inside(node.b, product), sum};
      case TraceOperation::subtract:
        return {inside(node.a, sum) + " - " + inside(node.b, product), sum};
      case TraceOperation::multiply:
        return {inside(node.a, product) + " * " + inside(node.b, factor), product};
      case TraceOperation::divide:
        // Python raises an error where C gives an infinity.
        return language_ == Language::python
                   ? Expression{call("", "quotient", "", node), whole}
                   : Expression{inside(node.a, product) + " / " + inside(node.b, factor), product};
      case TraceOperation::minimum:
        return {call("lesser", "lesser", "min", node), whole};
      case TraceOperation::maximum:
        return {call("greater", "greater", "max", node), whole};
      case TraceOperation::absolute:
        return {call("fabs", "abs", "abs", node), whole};
      case TraceOperation::square_root:
        return {call("sqrt", "square_root", "sqrt", node), whole};
      case TraceOperation::exponential:
        return {call("exponential", "exponential", "exponential", node), whole};
      case TraceOperation::logarithm:
        return {call("logarithm", "logarithm", "logarithm", node), whole};
      case TraceOperation::power:
        return {call("power", "power", "power", node), whole};
      case TraceOperation::power_law:
        return {call("power_law", "power_law", "power_law", node), whole};
      case TraceOperation::hyperbolic_tangent:
        return {call("tanh", "tanh", "tanh", node), whole};
      case TraceOperation::earlier:
        return {by_language("drive_before(past, ", "past.drive_before(", "delay(drive, ") + bare(node.a) + ")", whole};
      case TraceOperation::less:
        return {inside(node.a, sum) + " < " + inside(node.b, sum), comparison};
      case TraceOperation::both:
        return {inside(node.a, comparison) + (c ? " && " : " and ") + inside(node.b, comparison), conjunction};
      case TraceOperation::either:
        return {inside(node.a, comparison) + (c ? " || " : " or ") + inside(node.b, comparison), disjunction};
      case TraceOperation::choose:
        if (modelica) {
          return {"noEvent(if " + bare(node.a) + " then " + bare(node.b) + " else " + bare(node.c) + ")", whole};
        }
        return c ? Expression{inside(node.a, whole) + " ? " + inside(node.b, sum) + " : " + inside(node.c, sum), choice}
                 : Expression{
                       inside(node.b, sum) + " if " + inside(node.a, disjunction) + " else " + inside(node.c, sum),
                       choice};
    }
    return {};
  }

  std::string input(const ArgumentNumber& number) {
    if (std::ranges::none_of(statements_.used, [&](const ArgumentNumber& other) {
          return other.argument == number.argument && other.index == number.index;
        })) {
      statements_.used.push_back(number);
    }
    return name_of_(number);
  }

  const Function& function_;
  Language language_;
  const NameOf& name_of_;
  std::string behind_temporaries_;
  std::string assign_;
  std::vector<int> uses_;
  std::vector<Expression> expressions_;
  Statements statements_;
  int temporaries_ = 0;
};

}  // namespace

std::string literal(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) {
    text += ".0";
  }
  return text;
}

std::string parameter_identifier(const Parameter& parameter) { return identifier("p_" + std::string(parameter.name)); }

Statements write_statements(const Function& function, std::span<const Parameter> parameters, Language language) {
  const NameOf name_of = [&](const ArgumentNumber& number) { return name_in_code(number, parameters, language); };
  return Printer(function, language, name_of, "", "=").statements();
}

Statements write_modelica(const Function& function, const NameOf& name_of, const std::string& behind_temporaries,
                          const std::string& assign) {
  return Printer(function, Language::modelica, name_of, behind_temporaries, assign).statements();
}

}  // namespace hysteron

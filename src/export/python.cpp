// Python: one module of the same equations, nothing but the standard library, and one that replays a test vector.
#include <fmt/format.h>

#include "export/pieces.hpp"
#include "export/runtime.hpp"
#include "export/targets.hpp"
#include "export/writer.hpp"

namespace hysteron {
namespace {

std::string quoted(std::string_view text) { return replaced(replaced(std::string(text), "\\", "/"), "\"\"\"", "'''"); }

// Results in the order of the function's targets are handed back as a tuple, but for a drive, which changes `seen`.
std::string function(const ExportedLink& link, const std::string& kind, const std::string& arguments,
                     const Function& code) {
  const Statements statements = write_statements(code, link.part->parameters, Language::python);
  std::string text = fmt::format("\n\ndef {}_{}({}):\n", link.name, kind, arguments);
  for (const int k : parameters_used(statements)) {
    text +=
        fmt::format("    {} = p[{}]\n", parameter_identifier(link.part->parameters[static_cast<std::size_t>(k)]), k);
  }
  for (const std::string& line : statements.lines) {
    text += "    " + line + "\n";
  }
  std::string targets;
  std::string values;
  std::string acting;
  for (const Statements::Result& result : statements.results) {
    std::string target;
    if (kind == "drive") {
      target = std::string("seen.") + motion_member(result.target.argument);
    } else if (result.target.argument == Argument::memory) {
      target = fmt::format("memory[{}]", result.target.index);
    } else if (kind.starts_with("excite")) {
      target = "acting";
    }
    targets += (targets.empty() ? "" : ", ") + target;
    values += (values.empty() ? "" : ", ") + result.expression;
  }
  if (kind == "drive") {
    text += fmt::format("    {} = {}\n", targets, values);
  } else if (kind.starts_with("excite")) {
    text += fmt::format("    {} = {}\n    return acting\n", targets, values);
  } else {
    const bool list = kind == "rate" || kind == "yield";
    text += list ? "    return [" + values + "]\n" : "    return " + values + "\n";
  }
  return text;
}

std::string functions_of(const ExportedLink& link) {
  const PartEquations& e = link.equations;
  std::string text = fmt::format("\n\n# {}\n", link.part->title);
  for (const std::string_view equation : link.part->equations) {
    text += fmt::format("#   {}\n", equation);
  }
  text += fmt::format("# {}", link.part->reference);
  const auto add = [&](const char* kind, const char* arguments, const std::optional<Function>& code) {
    if (code) {
      text += function(link, kind, arguments, *code);
    }
  };
  add("drive", "p, s, seen", e.drive);
  add("rate", "p, s, seen, below", e.rate);
  add("force", "p, s, seen, below", e.force);
  add("stiffness", "p, speed", e.stiffness);
  add("towards", "p, s, seen", e.towards);
  add("slack", "p", e.slack);
  add("stiffness_near", "p, s, seen, speed, change", e.stiffness_near);
  add("yield", "p, s", e.yield);
  add("recall", "p, past, drive", e.recall);
  add("excite_first", "p, memory, elapsed, drive", e.excite_first);
  add("excite", "p, memory, elapsed, drive", e.excite);
  return text;
}

std::string table_of(const std::vector<ExportedLink>& links) {
  std::string text;
  for (const ExportedLink& link : links) {
    const PartEquations& e = link.equations;
    const auto name = [&](const std::optional<Function>& code, const char* kind) {
      return code ? link.name + "_" + kind : std::string("None");
    };
    text += fmt::format("    Link({}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}),\n", link.parameter, link.state,
                        link.part->states, e.settles, name(e.drive, "drive"), name(e.rate, "rate"),
                        name(e.force, "force"), name(e.stiffness, "stiffness"), name(e.towards, "towards"),
                        name(e.slack, "slack"), name(e.stiffness_near, "stiffness_near"), name(e.yield, "yield"));
  }
  return text;
}

std::string parameters_at(const ExportedModel& exported) {
  std::string text =
      "def parameters_at(drive, frequency):\n"
      "    \"\"\"Parameters of all links where the drive that acts has this value.\"\"\"\n    return [\n";
  const std::vector<Parameter> cards = exported.model.parameters();
  const std::vector<std::string> names = exported.model.parameter_names();
  for (std::size_t k = 0; k < cards.size(); ++k) {
    text += fmt::format("        {},  # {} [{}]: {}\n", expression_of_parameter(exported, k), names[k], cards[k].unit,
                        cards[k].meaning);
  }
  return text + "    ]\n";
}

std::string acting(const std::vector<ExportedLink>& links) {
  std::string acts;
  bool recalls = false;
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].equations.recall) {
      recalls = true;
      acts += fmt::format("        drive = {}_recall(p[{}:], self, drive)\n", links[i].name, links[i].parameter);
    }
  }
  for (std::size_t i = links.size(); i-- > 0;) {
    const ExportedLink& link = links[i];
    if (link.equations.excite) {
      acts += fmt::format(
          "        act = {0}_excite if self.samples else {0}_excite_first\n"
          "        drive = act(p[{1}:], self.memory[{2}], elapsed, drive)\n",
          link.name, link.parameter, link.memory);
    }
  }
  if (acts.empty()) {
    return "        return parameters_at(now.drive, self.frequency)\n";
  }
  std::string text = "        drive = now.drive\n        p = parameters_at(drive, self.frequency)\n";
  if (recalls) {
    text += "        self.history.append((now.time, drive))\n";
  }
  return text + acts + "        return parameters_at(drive, self.frequency)\n";
}

std::string rows(const std::vector<TestSample>& samples) {
  std::string text;
  for (const TestSample& s : samples) {
    text += "    (" + literals(s) + "),\n";
  }
  return text;
}

}  // namespace

Export export_python(const ExportedModel& exported, const TestVector& vector) {
  const std::vector<ExportedLink> links = links_of(exported);
  const ChainFacts facts = facts_of(links);
  std::string equations;
  for (const ExportedLink& link : links) {
    equations += functions_of(link);
  }
  std::string text(runtime::python_py());
  const auto truth = [](bool value) { return std::string(value ? "True" : "False"); };
  const std::pair<const char*, std::string> pieces[] = {
      {"@title@", quoted(exported.title())},
      {"@drive@", exported.about_drive()},
      {"@frequency@", literal(vector.frequency)},
      {"@states@", std::to_string(exported.model.states())},
      {"@settles@", truth(facts.settles)},
      {"@alone@", truth(facts.alone)},
      {"@series@", truth(facts.series)},
      {"@step_limit@", literal(make_motion({}, {}, {}, {}, exported.tolerance).step_limit)},
      {"@most_substeps@", std::to_string(exported.most_substeps)},
      {"@substeps@", std::to_string(exported.substeps)},
      {"@memories@", std::to_string(facts.memories)},
      {"@equations@", equations},
      {"@links@", table_of(links)},
      {"@parameters_at@", parameters_at(exported)},
      {"@acting@\n", acting(links)}};
  for (const auto& [what, with] : pieces) {
    text = replaced(text, what, with);
  }
  std::string test(runtime::python_test_py());
  test = replaced(test, "@name@", exported.name);
  test = replaced(test, "@allowed@", literal(vector.allowed()));
  test = replaced(test, "@frequency@", literal(vector.frequency));
  test = replaced(test, "@lead_in@", rows(vector.lead_in));
  test = replaced(test, "@samples@", rows(vector.samples));
  test = replaced(test, "@force@", lines_of(vector.force));
  return {{{exported.name + ".py", text}, {exported.name + "_test.py", test}},
          "replay: python3 " + exported.name + "_test.py in that folder"};
}

}  // namespace hysteron

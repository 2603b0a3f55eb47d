#include "export/c_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "export/pieces.hpp"
#include "export/runtime.hpp"
#include "export/writer.hpp"

namespace hysteron {
namespace {

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  return text;
}

// A comment's text must not end it.
std::string quoted(std::string_view text) { return replaced(std::string(text), "*/", "* /"); }

// Whether it occurs and no letter stands before it.
bool uses(const std::string& text, const std::string& what) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) {
      return true;
    }
  }
  return false;
}

// One function of a part. `arguments` are those of the signature, `result` how a result is handed back.
std::string function(const ExportedLink& link, const std::string& kind, const std::string& type,
                     const std::vector<std::pair<std::string, std::string>>& arguments, const Function& code) {
  const Statements statements = write_statements(code, link.part->parameters, Language::c);
  std::string signature;
  for (const auto& [declaration, name] : arguments) {
    signature += (signature.empty() ? "" : ", ") + declaration + name;
  }
  std::string body;
  for (const int k : parameters_used(statements)) {
    body += fmt::format("  const double {} = p[{}];\n",
                        parameter_identifier(link.part->parameters[static_cast<std::size_t>(k)]), k);
  }
  for (const std::string& line : statements.lines) {
    body += "  " + line + "\n";
  }
  static constexpr const char* yield_members[] = {"deflection", "slope", "bend", "gain", "hold", "width"};
  std::string stores;
  for (const Statements::Result& result : statements.results) {
    std::string target;
    if (kind == "drive") {
      const char* member = motion_member(result.target.argument);
      body += fmt::format("  const double new_{} = {};\n", member, result.expression);
      stores += fmt::format("  in->{0} = new_{0};\n", member);
    } else if (kind == "rate") {
      stores += fmt::format("  rates[{}] = {};\n", result.target.index, result.expression);
    } else if (kind == "yield") {
      stores += fmt::format("  law->{} = {};\n", yield_members[result.target.index], result.expression);
    } else if (result.target.argument == Argument::memory) {
      body += fmt::format("  const double new_{} = {};\n", result.target.index, result.expression);
      stores += fmt::format("  memory[{0}] = new_{0};\n", result.target.index);
    } else if (kind.starts_with("excite")) {
      body += fmt::format("  const double acting = {};\n", result.expression);
      stores += "  return acting;\n";
    } else {
      stores += fmt::format("  return {};\n", result.expression);
    }
  }
  if (kind.starts_with("excite")) {  // the value to return is the first result
    const std::string value = "  return acting;\n";
    stores = stores.substr(value.size()) + value;
  }
  std::string unused;
  const std::string all = body + stores;
  for (const auto& argument : arguments) {
    const std::string& name = argument.second;
    const bool pointer_used = uses(all, name + "[") || uses(all, name + "->");
    const bool value_used = std::ranges::any_of(statements.used,
                                                [&](const ArgumentNumber& used) {
                                                  return (name == "below" && used.argument == Argument::below) ||
                                                         (name == "speed" && used.argument == Argument::speed) ||
                                                         (name == "change" && used.argument == Argument::change) ||
                                                         (name == "elapsed" && used.argument == Argument::elapsed) ||
                                                         (name == "drive" && used.argument == Argument::acting);
                                                }) ||
                            (name == "past" && all.find("past,") != std::string::npos);
    if (!pointer_used && !value_used) {
      unused += fmt::format("  (void){};\n", name);
    }
  }
  // Declarations come first in every block, as some compilers for controllers want it.
  return fmt::format("static {} {}_{}({}) {{\n{}{}{}}}\n", type, link.name, kind, signature, body, unused, stores);
}

const std::pair<std::string, std::string> p_argument{"const double *", "p"};
const std::pair<std::string, std::string> s_argument{"const double *", "s"};
const std::pair<std::string, std::string> in_argument{"const motion_point *", "in"};
const std::pair<std::string, std::string> below_argument{"double ", "below"};
const std::pair<std::string, std::string> speed_argument{"double ", "speed"};
const std::pair<std::string, std::string> change_argument{"double ", "change"};
const std::pair<std::string, std::string> drive_argument{"double ", "drive"};

std::string functions_of(const ExportedLink& link) {
  std::string text = fmt::format("\n/* {}\n", quoted(link.part->title));
  for (const std::string_view equation : link.part->equations) {
    text += fmt::format(" *   {}\n", quoted(equation));
  }
  text += fmt::format(" * {}\n */\n", quoted(link.part->reference));
  const PartEquations& e = link.equations;
  const auto add = [&](const char* kind, const char* type,
                       const std::vector<std::pair<std::string, std::string>>& arguments,
                       const std::optional<Function>& code) {
    if (code) {
      text += function(link, kind, type, arguments, *code);
    }
  };
  add("drive", "void", {p_argument, s_argument, {"motion_point *", "in"}}, e.drive);
  add("rate", "void", {p_argument, s_argument, in_argument, below_argument, {"double *", "rates"}}, e.rate);
  add("force", "double", {p_argument, s_argument, in_argument, below_argument}, e.force);
  add("stiffness", "double", {p_argument, speed_argument}, e.stiffness);
  add("towards", "double", {p_argument, s_argument, in_argument}, e.towards);
  add("slack", "double", {p_argument}, e.slack);
  add("stiffness_near", "double", {p_argument, s_argument, in_argument, speed_argument, change_argument},
      e.stiffness_near);
  add("yield", "void", {p_argument, s_argument, {"yield_law *", "law"}}, e.yield);
  add("recall", "double", {p_argument, {"const drive_history *", "past"}, drive_argument}, e.recall);
  const std::pair<std::string, std::string> memory{"double *", "memory"};
  const std::pair<std::string, std::string> elapsed{"double ", "elapsed"};
  add("excite_first", "double", {p_argument, memory, elapsed, drive_argument}, e.excite_first);
  add("excite", "double", {p_argument, memory, elapsed, drive_argument}, e.excite);
  return text;
}

std::string table_of(const std::vector<ExportedLink>& links, bool series) {
  std::string text =
      "\ntypedef struct {\n"
      "  int parameter, state; /* where its own begin */\n"
      "  int settles;          /* its state that rests at its bound, or -1 */\n"
      "  void (*drive)(const double *p, const double *s, motion_point *in);\n"
      "  void (*rate)(const double *p, const double *s, const motion_point *in, double below, double *rates);\n"
      "  double (*force)(const double *p, const double *s, const motion_point *in, double below);\n"
      "  double (*stiffness)(const double *p, double speed);\n"
      "  double (*towards)(const double *p, const double *s, const motion_point *in);\n"
      "  double (*slack)(const double *p);\n"
      "  double (*stiffness_near)(const double *p, const double *s, const motion_point *in, double speed, double "
      "change);\n";
  if (series) {
    text += "  void (*yield)(const double *p, const double *s, yield_law *law);\n";
  }
  text += "} link;\n\n/* The law first, then the effects from it outwards. */\nstatic const link links[LINKS] = {\n";
  for (const ExportedLink& link : links) {
    const PartEquations& e = link.equations;
    const auto name = [&](const std::optional<Function>& code, const char* kind) {
      return code ? link.name + "_" + kind : std::string("0");
    };
    text += fmt::format("    {{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}", link.parameter, link.state, e.settles,
                        name(e.drive, "drive"), name(e.rate, "rate"), name(e.force, "force"),
                        name(e.stiffness, "stiffness"), name(e.towards, "towards"), name(e.slack, "slack"),
                        name(e.stiffness_near, "stiffness_near"));
    text += series ? ", " + name(e.yield, "yield") + "},\n" : "},\n";
  }
  return text + "};\n";
}

std::string parameters_at(const ExportedModel& exported) {
  std::string text =
      "\n/* Parameters of all links where the drive that acts has this value. */\n"
      "static void parameters_at(double drive, double frequency, double *p) {\n";
  const std::vector<Parameter> cards = exported.model.parameters();
  const std::vector<std::string> names = exported.model.parameter_names();
  for (std::size_t k = 0; k < cards.size(); ++k) {
    text += fmt::format("  p[{}] = {}; /* {} [{}]: {} */\n", k, expression_of_parameter(exported, k), names[k],
                        cards[k].unit, quoted(cards[k].meaning));
  }
  if (!exported.follows_drive()) {
    text += "  (void)drive;\n";
  }
  if (!exported.follows_frequency()) {
    text += "  (void)frequency;\n";
  }
  return text + "}\n";
}

std::string acting_parameters(const ExportedModel& exported, const std::vector<ExportedLink>& links) {
  std::string acts;
  bool recalls = false;
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].equations.recall) {
      recalls = true;
      acts += fmt::format("  drive = {}_recall(p + {}, &past, drive);\n", links[i].name, links[i].parameter);
    }
  }
  for (std::size_t i = links.size(); i-- > 0;) {
    const ExportedLink& link = links[i];
    if (link.equations.excite) {
      acts += fmt::format(
          "  drive = model->samples == 0 ? {0}_excite_first(p + {1}, model->memory[{2}], elapsed, drive)\n"
          "                              : {0}_excite(p + {1}, model->memory[{2}], elapsed, drive);\n",
          link.name, link.parameter, link.memory);
    }
  }
  std::string text =
      "\n/* The drive passes the effects on it, then the parameters follow it. */\n"
      "static void acting_parameters(@name@_model *model, const @name@_input *now, double *p) {\n";
  if (acts.empty()) {
    return text + "  parameters_at(now->drive, model->frequency, p);\n}\n";
  }
  const bool excites = acts.find("elapsed") != std::string::npos;
  text += "  double drive = now->drive;\n";
  if (excites) {
    text += "  const double elapsed = model->samples == 0 ? -1.0 : now->time - model->last.time;\n";
  }
  if (recalls) {
    text +=
        "  drive_history past;\n  remember_drive(model, now->time, now->drive);\n"
        "  past.time = model->history_time;\n  past.drive = model->history_drive;\n"
        "  past.count = model->history_count;\n";
  }
  text += "  parameters_at(drive, model->frequency, p);\n" + acts + "  parameters_at(drive, model->frequency, p);\n}\n";
  return with_name(text, exported.name);
}

struct Helper {
  const char* name;
  const char* text;
};
// In the order in which they use each other.
constexpr Helper helpers[] = {
    {"lesser", "static double lesser(double a, double b) { return b < a ? b : a; }\n"},
    {"greater", "static double greater(double a, double b) { return a < b ? b : a; }\n"},
    {"exponential",
     "static double exponential(double a) {\n"
     "  return a > 709.0 ? 8.218407461554972e+307 : a < -708.0 ? 3.307553003638408e-308 : exp(a);\n}\n"},
    {"logarithm", "static double logarithm(double a) { return log(a < 1e-300 ? 1e-300 : a); }\n"},
    {"power",
     "/* a^n for a >= 0 */\n"
     "static double power(double a, double n) {\n"
     "  return a < 1e-300 ? 0.0 : exp(fmin(fmax(n * log(a), -708.0), 709.0));\n}\n"},
    {"power_law",
     "static double power_law(double a, double n) { return n == 1.0 ? a : n == 2.0 ? a * a : power(a, n); }\n"},
};

int history_length(const ExportedModel& exported, const std::vector<ExportedLink>& links, const TestVector& vector) {
  for (const ExportedLink& link : links) {
    if (link.equations.recall && vector.samples.size() > 1) {
      // Twice what the delay spans at the sampling of the test vector.
      const double interval = vector.samples.back().time / static_cast<double>(vector.samples.size() - 1);
      double lag = 0.0;
      for (const Term& term : exported.terms) {
        lag += term.parameter == link.parameter ? std::abs(term.value) : 0.0;
      }
      return std::clamp(static_cast<int>(2.0 * lag / interval) + 8, 64, 100000);
    }
  }
  return 1;
}

}  // namespace

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

std::string with_name(std::string_view text, const std::string& name) {
  return replaced(replaced(std::string(text), "@name@", name), "@NAME@", upper(name));
}

CSource c_source(const ExportedModel& exported, const TestVector& vector) {
  const std::vector<ExportedLink> links = links_of(exported);
  const int states = exported.model.states();
  const auto [series, settles, recalls, alone, memories] = facts_of(links);
  CSource result;
  result.header = with_name(runtime::header_h(), exported.name);
  const std::pair<const char*, std::string> numbers[] = {
      {"@title@", quoted(exported.title())},
      {"@drive@", exported.about_drive()},
      {"@set_drive@", takes_drive(exported, links) ? "\n *     now.drive = ...;    in " + exported.about_drive() : ""},
      {"@room@", std::to_string(std::max(states, 1))},
      {"@parameters@", std::to_string(exported.model.parameter_count())},
      {"@memories@", std::to_string(std::max(memories, 1))},
      {"@history@", std::to_string(history_length(exported, links, vector))},
      {"@frequency@", literal(vector.frequency)},
      {"@most_substeps@", std::to_string(exported.most_substeps)},
      {"@substeps@", std::to_string(exported.substeps)}};
  for (const auto& [what, with] : numbers) {
    result.header = replaced(result.header, what, with);
  }

  std::string equations;
  for (const ExportedLink& link : links) {
    equations += functions_of(link);
  }
  std::string helper_text;
  const std::string body = equations;
  const bool needs_power = body.find("power(") != std::string::npos || body.find("power_law(") != std::string::npos;
  for (const Helper& helper : helpers) {
    const bool used = body.find(std::string(helper.name) + "(") != std::string::npos;
    if (used || (std::string_view(helper.name) == "power" && needs_power)) {
      helper_text += helper.text;
    }
  }

  std::string text = fmt::format("/* {}: see {}.h. Written by hysteron. */\n#include \"{}.h\"\n\n#include <math.h>\n\n",
                                 quoted(exported.title()), exported.name, exported.name);
  text += fmt::format(
      "#define LINKS {}\n#define PARAMETERS {}\n#define STATES {}\n#define SETTLES {} /* some state may rest at its "
      "bound */\n#define ALONE {}   /* no other link bends the motion that the law sees */\n#define STEP_LIMIT {} /* "
      "largest rate times step */\n",
      links.size(), exported.model.parameter_count(), states, settles ? 1 : 0, alone ? 1 : 0,
      literal(make_motion({}, {}, {}, {}, exported.tolerance).step_limit));
  text +=
      "\n/* What the equations see of the motion, SI units. */\n"
      "typedef struct {\n  double x, v, drive, time, age, a, jerk;\n} motion_point;\n";
  if (series) {
    text +=
        "\n/* A series element of state q deflects by D(q): q' = gain (F - hold q). */\n"
        "typedef struct {\n  double deflection, slope, bend, gain, hold, width;\n} yield_law;\n";
  }
  if (recalls) {
    text += with_name(runtime::drive_c(), exported.name);
  }
  text += "\n/* ---- The equations of the law and the effects " + std::string(68, '-') + " */\n\n" + helper_text;
  text += equations;
  text += table_of(links, series);
  text += parameters_at(exported) + with_name(acting_parameters(exported, links), exported.name);
  if (states > 0) {
    text += with_name(runtime::march_c(), exported.name);
    text += with_name(series ? runtime::series_c() : runtime::chain_c(), exported.name);
  }
  if (!series) {
    text += runtime::chain_force_c();
  }
  text += with_name(runtime::step_c(), exported.name);
  result.source = text;
  return result;
}

ExportedFiles c_files(const ExportedModel& exported, const TestVector& vector) {
  const CSource source = c_source(exported, vector);
  const auto table = [](const std::vector<TestSample>& samples) {
    std::string text;
    for (const TestSample& s : samples) {
      text += "    {" + literals(s) + "},\n";
    }
    return text;
  };
  std::string test = with_name(runtime::test_c(), exported.name);
  test = replaced(test, "@allowed@", literal(vector.allowed()));
  test = replaced(test, "@frequency@", literal(vector.frequency));
  test = replaced(test, "@lead_in_count@", std::to_string(vector.lead_in.size()));
  test = replaced(test, "@lead_in@", vector.lead_in.empty() ? "    {0, 0, 0, 0, 0, 0, 0},\n" : table(vector.lead_in));
  test = replaced(test, "@count@", std::to_string(vector.samples.size()));
  test = replaced(test, "@samples@", table(vector.samples));
  test = replaced(test, "@force@", lines_of(vector.force));
  return {
      {exported.name + ".h", source.header}, {exported.name + ".c", source.source}, {exported.name + "_test.c", test}};
}

}  // namespace hysteron

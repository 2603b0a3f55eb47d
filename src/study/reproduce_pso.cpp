// Tables V to VIII of the PSO paper on the stand-in rd8040-twin, or on recordings the user gives. Figure 9 is in
// reproduce_pso_surface.cpp.
#include "study/reproduce_pso.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/terminal.hpp"
#include "study/analysis.hpp"
#include "study/quantile.hpp"
#include "study/ranks.hpp"

namespace hysteron::reproduce {

using pso::base;
using pso::full_model;
using pso::model_spec;
using pso::on_twin;

namespace {

// Kwok's form as printed: the branch is the sign of the displacement.
constexpr const char* literal_tangent = "algebraic-hysteresis";

}  // namespace

namespace pso {
namespace {

bool of_twin(const ReproduceOptions& options) { return options.data.empty(); }

}  // namespace

bool on_twin(const Plan& plan) { return plan.study.data.front().dataset == "rd8040-twin"; }

ModelSpec model_spec(const std::string& label, const ReproduceOptions& options) {
  ModelSpec spec;
  spec.label = label;
  const auto plus = label.find('+');
  spec.model = label.substr(0, plus);
  if (plus != std::string::npos) spec.effects = {label.substr(plus + 1)};
  if (spec.model == "modified-bouc-wen") {
    spec.layout.fix["n"] = 1.0;
    spec.layout.bounds["k0"] = {-1e4, of_twin(options) ? 1e4 : 1e6};
    if (of_twin(options)) spec.layout.bounds["k1"] = {-5e3, 2e4};
  }
  if (!of_twin(options) && (spec.model == "modified-bouc-wen" || spec.model == "bouc-wen")) {
    spec.layout.bounds["share"] = {0.1, 20.0};
  }
  if (spec.model == literal_tangent && of_twin(options)) {
    spec.layout.fix["x0"] = 0.0;
    spec.layout.fix["x_s"] = 1e-6;  // a sign function but for the samples next to the middle
  }
  return spec;
}

Study base(const ReproduceOptions& options, const std::string& title, const std::vector<std::string>& conditions) {
  Study study;
  study.title = title;
  DataSpec data;
  data.each = true;
  if (options.data.empty()) {
    data.label = "twin";
    data.dataset = "rd8040-twin";
    data.only = conditions;
  } else {
    data.label = "recordings";
    data.paths = options.data;
  }
  study.data = {data};
  study.budgets = {options.budget};
  for (std::uint64_t seed = 1; seed <= options.seeds; ++seed) study.seeds.push_back(seed);
  return study;
}

void say_of_descents(const Plan& plan, std::string_view about, Reproduction& result) {
  result.not_remade.push_back(fmt::format(
      "Each condition is identified by multistart-lm with {} evaluations, not PSO: the figure asks about {}, "
      "not about solvers.",
      plan.study.budgets.front(), about));
}

void say_of_data(const Plan& plan, Reproduction& result) {
  if (on_twin(plan)) {
    result.not_remade.push_back(
        "The recordings of the paper are not public. The stand-in rd8040-twin is simulated from its published "
        "equations (16) "
        "to (23) with white noise of 1 % of each recording's peak force, so that no model can reach an NRMSE much "
        "below 0.010 "
        "and the true model can reach just that; the published errors of 0.015 to 0.13 are those of a real damper that "
        "the "
        "model only approximates. Absolute numbers are therefore not comparable; orderings are.");
  } else {
    result.not_remade.push_back("These are the recordings given, of another damper than the paper's.");
  }
  result.remade.push_back("The cost: RMSE over the largest absolute force.");
  result.not_remade.push_back(
      std::string(
          "The parameter ranges: the paper does not print them; those of the model's card are used, the same for "
          "all solvers, but for what the paper itself found outside: n = 1 held, as in its equations, and k0 from "
          "-1e4 N/m") +
      (on_twin(plan) ? " to 1e4 N/m and k1 from -5e3 to 2e4 N/m, as the published k0 is negative in 45 of 55 "
                       "conditions and k1 in 11."
                     : " to 1e6 N/m; share up to 20, where the card ends at 1.5 and measured dampers sit on it."));
  result.not_remade.push_back(
      "The coordinates: the paper searches alpha, beta, gamma and A, of which one is redundant; here the normal form "
      "(yield force, yield displacement on a logarithmic scale, share) is searched, so that a swarm takes other "
      "paths.");
}

}  // namespace pso

namespace {

using nlohmann::json;

constexpr double published_population = 100.0;
constexpr std::size_t published_budget = 10000;

// Solvers of a study, in this order; tables VI to VIII have no GA.
constexpr std::size_t paper_swarm = 0;
constexpr std::size_t paper_ga = 1;
constexpr std::size_t shipped_after_ga = 2;
constexpr std::size_t shipped_swarm = 1;

// Published numbers.
struct Pair {
  double frequency;
  double current;
  double first;
  double second;
};
// Table V: PSO, GA.
constexpr Pair table_v[] = {{2.0, 0.0, 0.0214, 0.0327}, {2.0, 0.2, 0.0157, 0.0317}, {2.0, 0.4, 0.0253, 0.0420},
                            {2.0, 0.6, 0.0323, 0.0391}, {2.0, 0.8, 0.0372, 0.0438}, {0.4, 1.0, 0.0245, 0.0329},
                            {0.8, 1.0, 0.0262, 0.0354}, {1.2, 1.0, 0.0343, 0.0538}, {1.6, 1.0, 0.0377, 0.0508},
                            {2.0, 1.0, 0.0408, 0.0529}};
// Table VII: with, without offset force.
constexpr Pair table_vii[] = {{2.0, 0.0, 0.0214, 0.0377}, {2.0, 0.2, 0.0157, 0.0210}, {2.0, 0.4, 0.0253, 0.0433},
                              {2.0, 0.6, 0.0323, 0.0965}, {2.0, 0.8, 0.0372, 0.1158}, {0.4, 1.0, 0.0245, 0.0711},
                              {0.8, 1.0, 0.0262, 0.0625}, {1.2, 1.0, 0.0343, 0.1131}, {1.6, 1.0, 0.0377, 0.0662},
                              {2.0, 1.0, 0.0408, 0.1061}};
struct ModelRow {
  const char* name;
  const char* model;
  double half;  // 2 Hz, 0.5 A
  double full;  // 2 Hz, 1 A
};
constexpr ModelRow table_vi[] = {{"Bingham", "bingham", 0.1881, 0.2045},
                                 {"Simple Bouc-Wen", "bouc-wen", 0.0456, 0.0454},
                                 {"Modified Bouc-Wen", full_model, 0.0306, 0.0408},
                                 {"Nonlinear biviscous", "nonlinear-biviscous", 0.2120, 0.2335},
                                 {"Hyperbolic tangent", literal_tangent, 0.1010, 0.0971}};
// Not of the paper: the same shape with the branch told by a lagged velocity, which is the program's own law.
constexpr ModelRow own_tangent = {"(lagged velocity)", "hyperbolic-tangent", 0.0, 0.0};
// Readings of the hyperbolic tangent beside the printed one: on the twin, what is held at 0.
struct TangentReading {
  const char* name;
  const char* label;
  const char* held;
};
constexpr TangentReading tangent_readings[] = {{"(printed form, f0 = 0)", "tangent without offset", "f0"},
                                               {"(printed form, delta = 0)", "tangent without loop", "v_h"}};
// Table VIII: rows 0.4 to 2.0 Hz, columns 0 to 1 A; NRMSE and "accuracy" in percent.
constexpr double table_viii[5][11] = {{0.129, 0.070, 0.043, 0.025, 0.021, 0.020, 0.020, 0.019, 0.028, 0.017, 0.024},
                                      {0.097, 0.044, 0.024, 0.023, 0.021, 0.021, 0.021, 0.021, 0.024, 0.020, 0.026},
                                      {0.059, 0.027, 0.023, 0.025, 0.023, 0.028, 0.025, 0.029, 0.032, 0.034, 0.033},
                                      {0.032, 0.025, 0.015, 0.024, 0.020, 0.023, 0.026, 0.028, 0.028, 0.032, 0.034},
                                      {0.021, 0.021, 0.015, 0.019, 0.025, 0.036, 0.032, 0.034, 0.037, 0.038, 0.041}};
constexpr double table_viii_accuracy[5][11] = {
    {87.01, 92.97, 95.65, 97.41, 97.83, 97.95, 97.93, 98.01, 97.20, 98.20, 98.18},
    {90.23, 95.52, 97.55, 97.64, 97.89, 97.81, 97.87, 97.88, 97.56, 97.99, 97.97},
    {94.00, 97.21, 97.62, 97.41, 97.64, 97.12, 97.43, 97.05, 96.73, 96.51, 96.69},
    {96.75, 97.44, 98.47, 97.57, 97.90, 97.63, 97.32, 97.15, 97.11, 96.77, 97.06},
    {97.84, 97.88, 98.03, 98.09, 97.44, 96.33, 96.77, 96.50, 96.29, 96.11, 95.86}};

std::string condition(double frequency, double current) { return fmt::format("{:.1f}Hz_{:.1f}A", frequency, current); }
std::string shown(double frequency, double current) { return fmt::format("{:.1f} Hz, {:.1f} A", frequency, current); }
std::string twin_problem(const std::string& model, double frequency, double current) {
  return model + " @ twin/" + condition(frequency, current);
}

// The published population needs the published budget; with less, population and iterations stay equal as there.
double population_for(std::size_t budget) {
  if (budget >= published_budget) return published_population;
  return std::max(10.0, std::round(std::sqrt(static_cast<double>(budget))));
}

// The whole swarm informs every particle; the paper names no limit of the velocity, so the range is the limit.
SolverSpec swarm_of_the_paper(std::size_t budget) {
  return {"PSO as published", "pso", {{"population", population_for(budget)}, {"topology", 0.0}, {"vmax", 1.0}}, 0};
}
SolverSpec swarm_as_shipped() {
  SolverSpec spec{"PSO as shipped", "pso", {}, 0};
  spec.shipped = true;
  return spec;
}
std::vector<SolverSpec> both_swarms(std::size_t budget) { return {swarm_of_the_paper(budget), swarm_as_shipped()}; }

std::vector<std::string> conditions_of(std::span<const Pair> rows) {
  std::vector<std::string> result;
  for (const Pair& row : rows) result.push_back(condition(row.frequency, row.current));
  return result;
}

void say_common(const Plan& plan, Reproduction& result) {
  const std::size_t budget = plan.study.budgets.front();
  result.remade.push_back(
      "\"As published\": PSO with Clerc's constriction, k = 1, phi1 = phi2 = 2.05, every particle informed by the "
      "whole "
      "swarm (the g_best of equation 2); the printed formula (3) is garbled, the original is used.");
  result.not_remade.push_back(
      "The paper says neither how fast a particle may be nor what happens at the bounds. Here |v| is limited to the "
      "range, and a coordinate that leaves the box is put on the bound with velocity 0.");
  result.not_remade.push_back(
      "\"As shipped\" is no column of the paper: the program's own defaults (von Neumann torus, budget / 100 and at "
      "most "
      "40 particles, |v| limited to a fifth of the range), chosen on other problems (results/defaults.md).");
  if (budget >= published_budget) {
    result.remade.push_back("The budget: a population of 100 over 100 iterations.");
  } else {
    result.not_remade.push_back(
        fmt::format("The budget: {} evaluations (population {:.0f}) instead of 100 x 100; a budget of 10000 does the "
                    "published amount.",
                    budget, population_for(budget)));
  }
  pso::say_of_data(plan, result);
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string p_text(double p) { return p < 1e-4 ? "< 0.0001" : format_number(p, 2); }

// The recording's name out of a label like "twin/2.0Hz_1.0A".
std::string data_name(const std::string& label) { return label.substr(label.find('/') + 1); }

}  // namespace

// ------------------------------------------------------------------------------------------------------------- table V

Study pso_table_v(const ReproduceOptions& options) {
  Study study = base(options, "table-v", conditions_of(table_v));
  study.models = {model_spec(full_model, options)};
  study.solvers = {swarm_of_the_paper(options.budget),
                   {"GA", "ga", {{"population", population_for(options.budget)}}, 0},
                   swarm_as_shipped()};
  return study;
}

namespace {

// Null where half of the runs failed.
std::string ratio_text(const json& ratio) {
  return ratio.is_number() ? format_number(ratio.get<double>(), 3) : "no number, for runs that failed";
}

// What all conditions together say of "PSO is ahead of GA", by the row of that pair.
std::string claim_of_table_v(const json& pair, const json& analysis, std::size_t seeds) {
  const bool of_seeds = analysis.at("ranking").at("block") == "seed";  // one condition, whose seeds are the pairs
  const auto pairs = pair.at("pairs").get<std::size_t>();
  const std::string over = counted(pairs, of_seeds ? "seed" : "condition");
  const std::string ratio = fmt::format("Over {}, the median ratio PSO as published / GA is {}",
                                        of_seeds ? over + " of the one condition" : over + ", each with its medians",
                                        ratio_text(pair.at("median_ratio")));
  if (const std::size_t needed = pairs_to_tell(analysis.at("pairs").size(), analysis.at("alpha").get<double>());
      pairs < needed) {
    return fmt::format(
        "{}: so few cannot show a difference, whatever they are, which takes {} {}; of the paper's claim "
        "this says nothing.",
        ratio, needed, of_seeds ? "seeds" : "conditions");
  }
  const std::string verdict = pair.at("verdict");
  return fmt::format("{} (Wilcoxon p = {}): {}", ratio, p_text(pair.at("p").get<double>()),
                     verdict == "a" ? "PSO is ahead, as the paper claims."
                     : verdict == "b"
                         ? "GA is ahead, against the paper's claim."
                         : fmt::format("no difference is shown, which with {} a condition neither confirms "
                                       "the paper's claim nor refutes it.",
                                       counted(seeds, "seed")));
}

}  // namespace

Reproduction pso_table_v_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  const json analysis = analyse(plan_json(plan), records);
  std::map<std::size_t, json> tests;
  const auto of_the_paper = [](const json& row) { return row.at("a") == paper_swarm && row.at("b") == paper_ga; };
  for (const json& row : analysis.at("problem_pairs")) {
    if (of_the_paper(row)) tests[row.at("problem").get<std::size_t>()] = row;
  }
  StudyTable table{
      "table-v",
      "PSO against GA",
      "Obtained: median [quartiles] over the seeds. p and verdict: PSO as published against GA, Wilcoxon on "
      "pairs of seeds, Holm over all pairs of the three solvers.",
      {"condition", "published PSO", "published GA", "PSO as published", "GA", "p Holm", "verdict", "PSO as shipped"},
      {}};
  const double level = analysis.at("alpha").get<double>();
  const std::size_t seeds = plan.study.seeds.size();
  const std::size_t seeds_to_tell = pairs_to_tell(analysis.at("problem_pairs").size(), level);
  std::size_t pso_ahead = 0;
  std::size_t shipped_ahead = 0;
  std::size_t shown_pso = 0;
  std::size_t shown_ga = 0;
  std::size_t compared = 0;
  const auto add = [&](const std::string& name, const std::string& pso, const std::string& ga, std::size_t problem) {
    if (problem >= plan.problems.size()) return;
    std::vector<std::string> row{name,
                                 pso,
                                 ga,
                                 spread(plan, records, problem, paper_swarm),
                                 spread(plan, records, problem, paper_ga),
                                 "-",
                                 "-",
                                 spread(plan, records, problem, shipped_after_ga)};
    if (seeds < seeds_to_tell) {
      row[6] = "cannot tell";
    } else if (const auto test = tests.find(problem); test != tests.end()) {
      row[5] = p_text(test->second.at("p_holm").get<double>());
      const std::string verdict = test->second.at("verdict");
      row[6] = verdict == "tie" ? "tie" : verdict == "a" ? "PSO better" : "GA better";
      shown_pso += verdict == "a" ? 1 : 0;
      shown_ga += verdict == "b" ? 1 : 0;
    }
    const double ga_median = median_nrmse(plan, records, problem, paper_ga);
    pso_ahead += median_nrmse(plan, records, problem, paper_swarm) < ga_median ? 1 : 0;
    shipped_ahead += median_nrmse(plan, records, problem, shipped_after_ga) < ga_median ? 1 : 0;
    ++compared;
    table.rows.push_back(std::move(row));
  };
  if (on_twin(plan)) {
    for (const Pair& row : table_v) {
      add(shown(row.frequency, row.current), fmt::format("{:.4f}", row.first), fmt::format("{:.4f}", row.second),
          problem_index(plan, twin_problem(full_model, row.frequency, row.current)));
    }
  } else {
    for (std::size_t p = 0; p < plan.problems.size(); ++p) add(data_name(plan.problems[p].data), "-", "-", p);
  }
  result.tables.push_back(std::move(table));
  const std::string of_one_case =
      seeds < seeds_to_tell
          ? fmt::format("of a single case {} cannot show a difference, whatever they are, which takes {} seeds",
                        counted(seeds, "seed"), seeds_to_tell)
          : fmt::format("shown after Holm's correction: PSO better in {}, GA better in {}, {} ties", shown_pso,
                        shown_ga, compared - shown_pso - shown_ga);
  result.findings.push_back(
      fmt::format("PSO as published has the lower median in {} of {} cases (published: in all 10); {}. PSO as shipped "
                  "has a lower median than the GA in {}.",
                  pso_ahead, compared, of_one_case, shipped_ahead));
  if (const auto found = std::ranges::find_if(analysis.at("pairs"), of_the_paper);
      found != analysis.at("pairs").end()) {
    result.findings.push_back(claim_of_table_v(*found, analysis, seeds));
    if (on_twin(plan) && plan.study.budgets.front() < published_budget) {
      result.findings.push_back(
          "At this budget neither has converged (the twin's noise is 0.010): this says nothing of the published 10,000 "
          "evaluations.");
    }
  }
  say_common(plan, result);
  result.not_remade.push_back(
      "The GA: MATLAB's is not public in every detail; `ga` follows its documentation (`hysteron describe ga`).");
  result.not_remade.push_back("The paper prints one number a case, so that its own spread over seeds is unknown.");
  return result;
}

// ------------------------------------------------------------------------------------------------------------ table VI

Study pso_table_vi(const ReproduceOptions& options) {
  Study study = base(options, "table-vi", {condition(2.0, 0.5), condition(2.0, 1.0)});
  for (const ModelRow& row : table_vi) study.models.push_back(model_spec(row.model, options));
  study.models.push_back(model_spec(own_tangent.model, options));
  for (const TangentReading& reading : tangent_readings) {
    if (!options.data.empty()) break;
    ModelSpec spec = model_spec(literal_tangent, options);
    spec.label = reading.label;
    spec.layout.fix[reading.held] = 0.0;
    study.models.push_back(spec);
  }
  study.solvers = both_swarms(options.budget);
  return study;
}

Reproduction pso_table_vi_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  StudyTable table{"table-vi", "Five models", "Obtained: median [quartiles] over the seeds.", {}, {}};
  if (on_twin(plan)) {
    table.header = {"model",      "published 2 Hz, 0.5 A", "as published",
                    "as shipped", "published 2 Hz, 1 A",   "as published",
                    "as shipped"};
    std::vector<std::pair<double, std::string>> published;
    std::vector<std::pair<double, std::string>> obtained;
    const auto add = [&](const ModelRow& row, const std::string& half_text, const std::string& full_text) {
      const std::size_t half = problem_index(plan, twin_problem(row.model, 2.0, 0.5));
      const std::size_t full = problem_index(plan, twin_problem(row.model, 2.0, 1.0));
      table.rows.push_back({row.name, half_text, spread(plan, records, half, paper_swarm),
                            spread(plan, records, half, shipped_swarm), full_text,
                            spread(plan, records, full, paper_swarm), spread(plan, records, full, shipped_swarm)});
      return median_nrmse(plan, records, full, paper_swarm);
    };
    for (const ModelRow& row : table_vi) {
      obtained.emplace_back(add(row, fmt::format("{:.4f}", row.half), fmt::format("{:.4f}", row.full)), row.name);
      published.emplace_back(row.full, row.name);
    }
    const double lagged = add(own_tangent, "-", "-");
    std::string readings;
    for (const TangentReading& reading : tangent_readings) {
      const double at_full = add({reading.name, reading.label, 0.0, 0.0}, "-", "-");
      readings +=
          fmt::format("{}{} = 0 leaves {}", readings.empty() ? "" : ", ",
                      std::string_view(reading.held) == "v_h" ? "delta" : reading.held, format_number(at_full, 3));
    }
    std::ranges::sort(published);
    std::ranges::sort(obtained);
    const auto order = [](const auto& rows) {
      std::string text;
      for (const auto& [value, name] : rows) text += (text.empty() ? "" : " < ") + name;
      return text;
    };
    const bool same =
        std::ranges::equal(published, obtained, [](const auto& a, const auto& b) { return a.second == b.second; });
    result.findings.push_back("Order at 2 Hz, 1 A, published: " + order(published) + ".");
    result.findings.push_back("Order at 2 Hz, 1 A, obtained: " + order(obtained) +
                              (same ? " (the same)." : " (not the same)."));
    result.findings.push_back(fmt::format(
        "\"Hyperbolic tangent\" is Kwok's form as printed, F = alpha tanh(beta v + delta sgn(x)) + c v + k x + f0 "
        "(`{}`, x0 = 0, the sign rounded over a micrometre). The program's `{}` carries the branch by a lagged "
        "velocity "
        "instead; it is another law, and fits this stand-in with {} at 2 Hz, 1 A. The published error is {:.4f}; of "
        "readings "
        "tried, {}.",
        literal_tangent, own_tangent.model, format_number(lagged, 3), table_vi[std::size(table_vi) - 1].full,
        readings));
    result.not_remade.push_back(
        "The twin is made of the modified Bouc-Wen model: that this model fits it best is so by construction and "
        "proves nothing.");
  } else {
    table.header = {"recording"};
    std::vector<ModelRow> rows(std::begin(table_vi), std::end(table_vi));
    rows.push_back(own_tangent);
    for (const ModelRow& row : rows) table.header.emplace_back(row.name);
    table.note += " PSO as published.";
    const std::size_t models = rows.size();
    std::vector<std::size_t> wins(models, 0);
    for (std::size_t p = 0; p + models <= plan.problems.size(); p += models) {
      std::vector<std::string> row{data_name(plan.problems[p].data)};
      std::size_t best = 0;
      for (std::size_t m = 0; m < models; ++m) {
        row.push_back(spread(plan, records, p + m, paper_swarm));
        if (median_nrmse(plan, records, p + m, paper_swarm) < median_nrmse(plan, records, p + best, paper_swarm)) {
          best = m;
        }
      }
      ++wins[best];
      table.rows.push_back(std::move(row));
    }
    for (std::size_t m = 0; m < models; ++m) {
      result.findings.push_back(fmt::format("{} has the lowest median on {} of {} recordings.", rows[m].name, wins[m],
                                            plan.problems.size() / models));
    }
  }
  result.tables.push_back(std::move(table));
  say_common(plan, result);
  return result;
}

// ----------------------------------------------------------------------------------------------------------- table VII

Study pso_table_vii(const ReproduceOptions& options) {
  Study study = base(options, "table-vii", conditions_of(table_vii));
  study.models = {model_spec(full_model, options), model_spec("modified-bouc-wen", options)};
  study.solvers = both_swarms(options.budget);
  return study;
}

Reproduction pso_table_vii_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  StudyTable table{"table-vii",
                   "With and without offset force",
                   "Obtained: median [quartiles] over the seeds.",
                   {"condition", "published with", "published without", "with, as published", "without, as published",
                    "with, as shipped", "without, as shipped"},
                   {}};
  std::size_t better = 0;
  std::size_t better_shipped = 0;
  std::size_t cases = 0;
  const auto add = [&](const std::string& name, const std::string& with, const std::string& without, std::size_t a,
                       std::size_t b) {
    if (a >= plan.problems.size() || b >= plan.problems.size()) return;
    table.rows.push_back({name, with, without, spread(plan, records, a, paper_swarm),
                          spread(plan, records, b, paper_swarm), spread(plan, records, a, shipped_swarm),
                          spread(plan, records, b, shipped_swarm)});
    better += median_nrmse(plan, records, a, paper_swarm) < median_nrmse(plan, records, b, paper_swarm) ? 1 : 0;
    better_shipped +=
        median_nrmse(plan, records, a, shipped_swarm) < median_nrmse(plan, records, b, shipped_swarm) ? 1 : 0;
    ++cases;
  };
  if (on_twin(plan)) {
    for (const Pair& row : table_vii) {
      add(shown(row.frequency, row.current), fmt::format("{:.4f}", row.first), fmt::format("{:.4f}", row.second),
          problem_index(plan, twin_problem(full_model, row.frequency, row.current)),
          problem_index(plan, twin_problem("modified-bouc-wen", row.frequency, row.current)));
    }
    result.not_remade.push_back(
        "The twin holds the offset force of equation (23); where that is small against the noise, leaving it out costs "
        "little.");
  } else {
    for (std::size_t p = 0; p + 1 < plan.problems.size(); p += 2)
      add(data_name(plan.problems[p].data), "-", "-", p, p + 1);
  }
  result.tables.push_back(std::move(table));
  result.findings.push_back(
      fmt::format("The model with offset force has the lower median in {} of {} cases by PSO as published and in {} by "
                  "PSO as shipped "
                  "(published: in all 10).",
                  better, cases, better_shipped));
  say_common(plan, result);
  return result;
}

// ---------------------------------------------------------------------------------------------------------- table VIII

Study pso_table_viii(const ReproduceOptions& options) {
  Study study = base(options, "table-viii", {});
  study.models = {model_spec(full_model, options)};
  study.solvers = both_swarms(options.budget);
  return study;
}

Reproduction pso_table_viii_result(const Plan& plan, const std::vector<RunRecord>& records) {
  Reproduction result;
  StudyTable obtained{"table-viii-obtained",
                      "Obtained NRMSE, PSO as published",
                      "Median over the seeds; current in A across, frequency down.",
                      {"Hz"},
                      {}};
  StudyTable published{"table-viii-published", "Published NRMSE", "", {"Hz"}, {}};
  for (int c = 0; c <= 10; ++c) {
    obtained.header.push_back(fmt::format("{:.1f} A", 0.1 * c));
    published.header.push_back(obtained.header.back());
  }
  StudyTable shipped = obtained;
  shipped.id = "table-viii-shipped";
  shipped.title = "Obtained NRMSE, PSO as shipped";
  std::vector<double> own;
  std::vector<double> own_shipped;
  std::vector<double> theirs;
  std::string inconsistent;
  std::size_t wrong = 0;
  for (int f = 0; f < 5; ++f) {
    const double frequency = 0.4 * (f + 1);
    std::vector<std::string> row{fmt::format("{:.1f}", frequency)};
    std::vector<std::string> row_published = row;
    std::vector<std::string> row_shipped = row;
    for (int c = 0; c <= 10; ++c) {
      const double current = 0.1 * c;
      const std::size_t problem = problem_index(plan, twin_problem(full_model, frequency, current));
      const double value = median_nrmse(plan, records, problem, paper_swarm);
      row.push_back(fmt::format("{:.4f}", value));
      own_shipped.push_back(median_nrmse(plan, records, problem, shipped_swarm));
      row_shipped.push_back(fmt::format("{:.4f}", own_shipped.back()));
      row_published.push_back(fmt::format("{:.3f}", table_viii[f][c]));
      own.push_back(value);
      theirs.push_back(table_viii[f][c]);
      // Rounded or cut to three decimals, an NRMSE leaves the accuracy open by 0.05 upwards and 0.1 downwards.
      const double excess = table_viii_accuracy[f][c] - 100.0 * (1.0 - table_viii[f][c]);
      if (excess > 0.051 || excess < -0.101) {
        ++wrong;
        inconsistent += (inconsistent.empty() ? "" : "; ") + shown(frequency, current);
      }
    }
    obtained.rows.push_back(std::move(row));
    published.rows.push_back(std::move(row_published));
    shipped.rows.push_back(std::move(row_shipped));
  }
  result.tables = {published, obtained, shipped};
  result.findings.push_back(fmt::format(
      "Median over the 55 conditions: published {}, obtained {} by PSO as published and {} by PSO as shipped "
      "(noise of the twin: 0.010); largest {}, {} and {}.",
      format_number(quantile(theirs, 0.5), 3), format_number(quantile(own, 0.5), 3),
      format_number(quantile(own_shipped, 0.5), 3), format_number(std::ranges::max(theirs), 3),
      format_number(std::ranges::max(own), 3), format_number(std::ranges::max(own_shipped), 3)));
  result.findings.push_back(
      fmt::format("In the published table itself the accuracy is 100 (1 - NRMSE) within rounding or cutting except in "
                  "{} of 55 cells: {}.",
                  wrong, inconsistent));
  say_common(plan, result);
  result.not_remade.push_back(
      "The text calls the table the error of the model with polynomial parameters, but its cells equal those of table "
      "V, which are "
      "fits of each condition alone; here each condition is identified alone. The twin is made of the polynomials, so "
      "that "
      "their own error on it is its noise.");
  return result;
}

}  // namespace hysteron::reproduce

#include "report/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/printable.hpp"
#include "core/unit_text.hpp"
#include "report/html.hpp"
#include "report/latex.hpp"
#include "report/markdown.hpp"
#include "report/terminal.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr int digits = 4;

std::string shown(const json& value, int significant = digits) {
  return value.is_number() ? format_number(value.get<double>(), significant) : std::string("-");
}
std::string p_value(const json& value) {
  if (!value.is_number()) return "-";
  const double p = value.get<double>();
  return p < 1e-4 ? "< 0.0001" : format_number(p, 2);
}
std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }
std::string whole(const json& value) { return std::to_string(value.get<std::size_t>()); }

class Names {
 public:
  explicit Names(const json& analysis) : analysis_(analysis) {}
  [[nodiscard]] std::string solver(const json& index) const {
    return analysis_.at("solvers").at(index.get<std::size_t>()).at("label");
  }
  [[nodiscard]] std::string problem(const json& index) const {
    return analysis_.at("problems").at(index.get<std::size_t>()).at("label");
  }

 private:
  const json& analysis_;
};

std::string joined(const json& words) {
  std::string text;
  for (const json& word : words) text += (text.empty() ? "" : ", ") + word.get<std::string>();
  return text;
}

std::string verdict_of(const json& row, const Names& names) {
  const std::string verdict = row.at("verdict");
  return verdict == "tie" ? "tie" : names.solver(row.at(verdict)) + " better";
}

StudyTable ranking_table(const json& analysis, const Names& names, const char* member, const char* id,
                         const char* title) {
  const json& ranking = analysis.at(member);
  StudyTable table{id, title, {}, {"place", "solver", "mean rank", "share best", "ties with"}, {}};
  if (ranking.at("rows").empty()) {
    table.note = "No seed has been finished by every solver yet.";
    return table;
  }
  const bool one_problem = ranking.at("block") == "seed";
  table.note = fmt::format(
      "Mean rank over {}, at {} evaluations; costs within {} of each other tie. Friedman's test: chi-squared {} with "
      "{} "
      "degrees of freedom, p {}. Solvers whose mean ranks differ by less than the critical difference {} (Nemenyi, 5 "
      "%) "
      "tie: the place is one more than the number of solvers that are better.{}",
      one_problem ? fmt::format("{} seeds of one problem", whole(ranking.at("blocks")))
                  : fmt::format("{} problems, each with the medians over its seeds", whole(ranking.at("blocks"))),
      analysis.at("budgets").back().get<std::size_t>(), percent(analysis.at("tie").get<double>()),
      shown(ranking.at("chi_squared"), 3), whole(ranking.at("degrees")), p_value(ranking.at("p")),
      shown(ranking.at("critical_difference"), 3),
      one_problem ? " It speaks of this problem, not of others." : " Share best: of the pairs of (problem, seed).");
  for (const json& row : ranking.at("rows")) {
    table.rows.push_back({whole(row.at("place")), names.solver(row.at("solver")),
                          fmt::format("{:.2f}", row.at("mean_rank").get<double>()),
                          percent(row.at("share_best").get<double>()),
                          row.at("ties_with").empty() ? "none" : joined(row.at("ties_with"))});
  }
  return table;
}

StudyTable fixed_budget_table(const json& analysis, const Names& names) {
  StudyTable table{"fixed-budget",
                   "Fixed budget: NRMSE reached",
                   "Quartiles over the seeds, normalised by " + analysis.at("normalisation").get<std::string>() +
                       ". Diverged: share of evaluations whose simulation did not stay finite.",
                   {"problem", "budget", "solver", "runs", "best", "lower quartile", "median", "upper quartile",
                    "worst", "diverged"},
                   {}};
  bool heldout = false;
  for (const json& row : analysis.at("fixed_budget")) heldout = heldout || !row.at("heldout_median").is_null();
  if (heldout) table.header.emplace_back("held-out median");
  for (const json& row : analysis.at("fixed_budget")) {
    table.rows.push_back({names.problem(row.at("problem")), whole(row.at("budget")), names.solver(row.at("solver")),
                          whole(row.at("runs")), shown(row.at("best")), shown(row.at("q1")), shown(row.at("median")),
                          shown(row.at("q3")), shown(row.at("worst")),
                          percent(row.at("diverged_share").get<double>())});
    if (heldout) table.rows.back().push_back(shown(row.at("heldout_median")));
  }
  return table;
}

StudyTable model_table(const json& analysis, const Names& names) {
  StudyTable table{"models",
                   "Ranking of models",
                   "Each with the solver of the lowest median at the largest budget; medians over the seeds. The order "
                   "is that of the error on the recordings named.",
                   {"data", "place", "model", "parameters", "solver", "NRMSE fitted", "NRMSE held out", "order by"},
                   {}};
  for (const json& row : analysis.at("models")) {
    table.rows.push_back({row.at("data"), whole(row.at("place")), row.at("model"), whole(row.at("dimension")),
                          names.solver(row.at("solver")), shown(row.at("median")), shown(row.at("heldout_median")),
                          row.at("ranked_by")});
  }
  return table;
}

StudyTable fixed_target_table(const json& analysis, const Names& names) {
  StudyTable table{
      "fixed-target",
      "Fixed target: success and expected run time",
      "Success with its 95 % Wilson interval; ERT: evaluations of all runs over successes, with a 95 % bootstrap "
      "interval over the runs. Without a success only a lower bound is known: the evaluations spent.",
      {"problem", "target", "NRMSE", "solver", "success", "of runs", "95 % interval", "ERT", "95 % interval of ERT"},
      {}};
  for (const json& row : analysis.at("fixed_target")) {
    const bool reached = !row.at("ert").is_null();
    table.rows.push_back({names.problem(row.at("problem")), row.at("target"), shown(row.at("nrmse")),
                          names.solver(row.at("solver")), whole(row.at("successes")), whole(row.at("runs")),
                          fmt::format("{:.0f}-{:.0f} %", 100.0 * row.at("success_low").get<double>(),
                                      100.0 * row.at("success_high").get<double>()),
                          reached ? fmt::format("{:.0f}", row.at("ert").get<double>())
                                  : fmt::format("> {:.0f}", row.at("spent").get<double>()),
                          !reached ? "-"
                                   : fmt::format("{:.0f}-{}", row.at("ert_low").get<double>(),
                                                 row.at("ert_high").is_null()
                                                     ? "inf"
                                                     : fmt::format("{:.0f}", row.at("ert_high").get<double>()))});
  }
  return table;
}

// Failed runs, or a cost of 0, leave no number; then their problems are counted.
std::string mean_ratio(const json& row) {
  if (row.at("mean_ratio").is_number() || !row.contains("problems_infinite")) return shown(row.at("mean_ratio"));
  return fmt::format("- ({} failed)", whole(row.at("problems_infinite")));
}

StudyTable pair_table(const json& analysis, const Names& names, const std::string& member) {
  const bool by_problem = member == "problem_pairs";
  const bool one_problem = analysis.at("ranking").at("block") == "seed";
  StudyTable table{
      by_problem ? "pairs-by-problem" : "pairs",
      by_problem ? "Paired tests by problem" : "Differences over all problems",
      by_problem || one_problem
          ? "Wilcoxon's signed-rank test of log(NRMSE a / NRMSE b) over pairs with the same seed, two-sided; ties are "
            "dropped and counted; p after Holm's correction over this table. A median ratio below 1: a is better."
          : "Wilcoxon's signed-rank test of log(NRMSE a / NRMSE b), a problem's medians over its seeds a pair, "
            "two-sided; "
            "ties are dropped and counted; p after Holm's correction over this table. A ratio below 1: a is better.",
      {"a", "b", by_problem || one_problem ? "pairs" : "problems", "ties", "a better", "median ratio a/b", "p",
       "p Holm", "verdict"},
      {}};
  if (!by_problem) {
    const std::string region = percent(analysis.at("equivalence").get<double>());
    table.note +=
        " Mean ratio: geometric, with the 95 % interval of a bootstrap over problems and seeds within them. In "
        "practice: better by more than " +
        region + " where the whole interval says so, equal where it lies within " + region + ", else undecided.";
    if (std::ranges::any_of(analysis.at(member), [](const json& row) { return row.contains("problems_infinite"); })) {
      table.note +=
          " The cost of a failed run counts as infinite: a mean ratio with one of them is no number, but - with the "
          "problems where one of the two failed; so may be an end of its interval.";
    }
    table.header.insert(table.header.end(), {"mean ratio a/b", "95 % interval", "in practice"});
  }
  if (by_problem) {
    table.header.insert(table.header.begin(), "problem");
    table.note += " With more than four solvers each is tested against the one with the lowest median only.";
  }
  for (const json& row : analysis.at(member)) {
    std::vector<std::string> cells{names.solver(row.at("a")), names.solver(row.at("b")), whole(row.at("pairs")),
                                   whole(row.at("ties")),     whole(row.at("a_better")), shown(row.at("median_ratio")),
                                   p_value(row.at("p")),      p_value(row.at("p_holm")), verdict_of(row, names)};
    if (by_problem) cells.insert(cells.begin(), names.problem(row.at("problem")));
    if (!by_problem && !row.contains("practical")) {
      cells.insert(cells.end(), {"-", "-", "-"});
    } else if (!by_problem) {
      const std::string practical = row.at("practical");
      cells.insert(cells.end(),
                   {mean_ratio(row), shown(row.at("ratio_low")) + " to " + shown(row.at("ratio_high")),
                    practical == "a" || practical == "b" ? names.solver(row.at(practical)) + " better" : practical});
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

StudyTable problem_table(const json& analysis) {
  StudyTable table{
      "problems",
      "Problems and best known values",
      "Best NRMSE of any run of this study, with the parameters that it has on an end of their range and the "
      "key of the run that found it.",
      {"problem", "dimension", "recordings", "samples", "best NRMSE", "on the box", "by", "run"},
      {}};
  for (const json& row : analysis.at("problems")) {
    const json& best = row.at("best");
    table.rows.push_back({row.at("label"), whole(row.at("dimension")), std::to_string(row.at("recordings").size()),
                          whole(row.at("samples")), best.is_null() ? "-" : shown(best.at("nrmse"), 6),
                          best.is_null() || best.at("on_box").empty() ? "-" : joined(best.at("on_box")),
                          best.is_null() ? "-" : best.at("solver").get<std::string>(),
                          best.is_null() ? "-" : best.at("key").get<std::string>().substr(0, 12)});
  }
  return table;
}

// "1.2 to 3.4", open where the profile stays below its threshold up to the box.
std::string profile_interval(const json& row) {
  if (row.at("low").is_null() && row.at("high").is_null()) return "open";
  if (row.at("low").is_null()) return "below " + shown(row.at("high"));
  if (row.at("high").is_null()) return "above " + shown(row.at("low"));
  return shown(row.at("low")) + " to " + shown(row.at("high"));
}

StudyTable identifiability_table(const json& analysis, const Names& names) {
  StudyTable table{
      "identifiability",
      "Identifiability of the best fits",
      "The best run of every problem, followed down by Levenberg-Marquardt. Profile 95 %: where the NRMSE, all "
      "other parameters fitted again, stays below the threshold of the likelihood ratio for the effective "
      "number of samples; open where the box or three standard deviations end first. Sloppiness: decades "
      "between the largest and the smallest eigenvalue of J'J in logarithms of the parameters.",
      {"problem", "parameter", "value", "unit", "profile 95 %", "strongest correlation", "bound", "sloppiness"},
      {}};
  if (!analysis.contains("identifiability")) return table;
  const json& problems = analysis.at("identifiability");
  for (std::size_t p = 0; p < problems.size(); ++p) {
    const json& one = problems.at(p);
    if (one.is_null()) continue;
    const json& spectrum = one.at("spectrum");
    const std::string decades =
        spectrum.empty() ? "-" : fmt::format("{:.1f}", -std::log10(spectrum.back().at("eigenvalue").get<double>()));
    const json& free = one.at("free");
    for (std::size_t c = 0; c < one.at("parameters").size(); ++c) {
      const json& row = one.at("parameters").at(c);
      std::string partner = "-";
      double strongest = 0.0;
      for (std::size_t i = 0; i < free.size(); ++i) {
        if (free.at(i) != c) continue;
        for (std::size_t j = 0; j < free.size(); ++j) {
          const double value = one.at("correlation").at(i).at(j);
          if (j == i || std::fabs(value) <= strongest) continue;
          strongest = std::fabs(value);
          partner = fmt::format("{:.2f} with {}", value,
                                one.at("parameters").at(free.at(j).get<std::size_t>()).at("name").get<std::string>());
        }
      }
      table.rows.push_back({names.problem(p), row.at("name"), shown(row.at("value")),
                            unit_text(row.at("unit").get<std::string>()), profile_interval(row), partner,
                            row.at("at_bound").is_null() ? std::string("-") : row.at("at_bound").get<std::string>(),
                            decades});
    }
  }
  return table;
}

StudyTable time_table(const json& times, const Names& names) {
  StudyTable table{
      "times",
      "Time beside evaluations",
      "Processor time of a run's thread, which is the time on the clock where the machine does nothing "
      "else; it varies with the machine and is no result. To target: ERT to the first target (" +
          (times.at("target").is_null() ? "none" : times.at("target").get<std::string>()) +
          ") times the time of an evaluation.",
      {"problem", "solver", "runs", "run, median [s]", "all runs [s]", "per evaluation [us]", "to target [s]"},
      {}};
  for (const json& row : times.at("rows")) {
    table.rows.push_back({names.problem(row.at("problem")), names.solver(row.at("solver")), whole(row.at("runs")),
                          shown(row.at("seconds_median"), 3), shown(row.at("seconds_total"), 3),
                          shown(row.at("microseconds_per_evaluation"), 3), shown(row.at("seconds_to_target"), 3)});
  }
  return table;
}

// In one line of a terminal; the report has the table.
std::string left_open(const json& analysis) {
  if (!analysis.contains("identifiability")) return {};
  std::size_t open = 0;
  std::size_t all = 0;
  for (const json& one : analysis.at("identifiability")) {
    if (one.is_null()) continue;
    for (const json& row : one.at("parameters")) {
      ++all;
      open += row.at("low").is_null() || row.at("high").is_null() ? 1 : 0;
    }
  }
  return fmt::format(
      "Identifiability: of {} parameters of the best fits {} are open to one side at least (profile 95 %).\n", all,
      open);
}

std::string state_of(const json& analysis) {
  const auto counted = [&](const char* what) {
    const std::size_t count = analysis.at(what).size();
    const std::string words(what);
    return fmt::format("{} {}", count, count == 1 ? words.substr(0, words.size() - 1) : words);
  };
  return fmt::format("{} of {} runs: {}, {}, {}", whole(analysis.at("done")), whole(analysis.at("planned")),
                     counted("problems"), counted("solvers"), counted("seeds"));
}

}  // namespace

std::vector<StudyTable> study_tables(const json& analysis, const json& times) {
  const Names names(analysis);
  // A single solver has no rank and nothing to be paired with.
  const bool several = analysis.at("solvers").size() > 1;
  std::vector<StudyTable> tables;
  if (several) {
    tables.push_back(ranking_table(analysis, names, "ranking", "ranking", "Ranking"));
    if (analysis.contains("ranking_inside")) {
      tables.push_back(ranking_table(analysis, names, "ranking_inside", "ranking-inside",
                                     "Ranking where the best known point lies inside the box"));
      tables.push_back(ranking_table(analysis, names, "ranking_on_box", "ranking-on-box",
                                     "Ranking where the best known point lies on the box"));
    }
  }
  if (!analysis.at("models").empty()) tables.push_back(model_table(analysis, names));
  tables.push_back(fixed_budget_table(analysis, names));
  tables.push_back(fixed_target_table(analysis, names));
  if (several) tables.push_back(pair_table(analysis, names, "pairs"));
  if (several && analysis.at("problems").size() > 1) tables.push_back(pair_table(analysis, names, "problem_pairs"));
  tables.push_back(problem_table(analysis));
  if (analysis.contains("identifiability")) tables.push_back(identifiability_table(analysis, names));
  if (!times.is_null()) tables.push_back(time_table(times, names));
  return tables;
}

std::string study_verdict(const json& analysis) {
  const json& ranking = analysis.at("ranking");
  const Names names(analysis);
  if (ranking.at("rows").empty()) return "No seed has been finished by every solver yet: nothing can be compared.";
  if (ranking.at("rows").size() == 1) {
    return analysis.at("models").empty() ? "One solver only: nothing to compare."
                                         : "One solver: models are ranked, solvers are not.";
  }
  if (!ranking.at("different").get<bool>()) {
    return fmt::format("No difference between the {} solvers was shown (Friedman p = {}): they tie.",
                       ranking.at("rows").size(), p_value(ranking.at("p")));
  }
  std::string first;
  std::size_t count = 0;
  for (const json& row : ranking.at("rows")) {
    if (row.at("place").get<std::size_t>() != 1) continue;
    first += (first.empty() ? "" : ", ") + names.solver(row.at("solver"));
    ++count;
  }
  return first + (count > 1 ? " share the first place" : " leads alone") +
         fmt::format(" at {} evaluations, over {}.", analysis.at("budgets").back().get<std::size_t>(),
                     ranking.at("block") == "seed" ? whole(ranking.at("blocks")) + " seeds of one problem"
                                                   : whole(ranking.at("problems")) + " problems");
}

std::string study_terminal(const json& analysis, const json& times) {
  std::string text = printable(analysis.at("title").get<std::string>()) + "\n" + state_of(analysis) + "\n\n";
  for (const StudyTable& one : study_tables(analysis, times)) {
    if (one.id == "fixed-target" || one.id == "pairs-by-problem" || one.id == "problems" || one.id == "identifiability")
      continue;
    if (one.rows.empty()) continue;
    text += one.title + "\n" + table(one.header, one.rows) + "\n";
  }
  for (const json& warning : analysis.at("warnings")) text += "warning: " + warning.get<std::string>() + "\n";
  text += left_open(analysis);
  return text + study_verdict(analysis) + "\n";
}

std::string study_markdown(const json& analysis, const json& times) {
  std::string text = "# " + analysis.at("title").get<std::string>() + "\n\n" + study_verdict(analysis) + "\n\n" +
                     state_of(analysis) + ".\n";
  for (const json& warning : analysis.at("warnings")) text += "\n> " + warning.get<std::string>() + "\n";
  for (const StudyTable& one : study_tables(analysis, times)) {
    text += "\n## " + one.title + "\n\n" + one.note + "\n";
    if (!one.rows.empty()) text += "\n" + markdown_table(one.header, one.rows);
  }
  return text + "\nEvery number comes from runs listed in `runs.csv`, each named by the sha256 of its configuration.\n";
}

std::string study_latex(const json& analysis, const json& times) {
  std::string text = "% Tables of a study of hysteron; needs \\usepackage{booktabs}.\n";
  for (const StudyTable& one : study_tables(analysis, times)) {
    if (one.rows.empty()) continue;
    text += "\n" + latex_table(one.title + ". " + one.note, "tab:" + one.id, one.header, one.rows);
  }
  return text;
}

std::string study_html(const json& analysis, const json& times) {
  json page = analysis;
  page["verdict"] = study_verdict(analysis);
  page["state"] = state_of(analysis);
  page["tables"] = json::array();
  for (const StudyTable& one : study_tables(analysis, times)) {
    page["tables"].push_back({{"id", one.id},
                              {"title", one.title},
                              {"note", one.note},
                              {"header", one.header},
                              {"numeric", numeric_columns(one.header, one.rows)},
                              {"rows", one.rows}});
  }
  return study_page_html(page);
}

}  // namespace hysteron

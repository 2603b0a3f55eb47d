#include "study/reproduce.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "report/terminal.hpp"
#include "study/quantile.hpp"

namespace hysteron {
namespace {

constexpr std::string_view pso_paper =
    "Parametric estimation from empirical data using particle swarm optimization for different magnetorheological "
    "damper "
    "models, IEEE Access, 2021";
constexpr std::string_view least_squares_paper =
    "Bouc-Wen identification of an MR damper by non-linear least squares, 2023";
constexpr std::string_view nelder_mead_paper =
    "Parameter identification of Bouc-Wen model for MR damper, by the Nelder-Mead simplex";
constexpr std::string_view review_paper = "A review paper on mathematical modeling of magneto-rheological damper";
constexpr std::string_view lm_paper =
    "Long and short stroke MR dampers (RD-8040-1, RD-8041-1), Bouc-Wen identified by Levenberg-Marquardt";

// Nothing is worked out behind the runs that takes long.
template <Reproduction (*result)(const Plan& plan, const std::vector<RunRecord>& records)>
Reproduction at_once(const Plan& plan, const std::vector<RunRecord>& records, const Done& /*done*/) {
  return result(plan, records);
}

constexpr PublishedTable tables[] = {
    {"table-v", "PSO against GA: NRMSE of the modified Bouc-Wen model with offset force", pso_paper, 5, 2000, true,
     &reproduce::pso_table_v, &at_once<&reproduce::pso_table_v_result>},
    {"table-vi", "NRMSE of five models identified by PSO", pso_paper, 5, 2000, true, &reproduce::pso_table_vi,
     &at_once<&reproduce::pso_table_vi_result>},
    {"table-vii", "Modified Bouc-Wen with and without offset force", pso_paper, 3, 2000, true,
     &reproduce::pso_table_vii, &at_once<&reproduce::pso_table_vii_result>},
    {"table-viii", "NRMSE over 55 conditions of current and frequency", pso_paper, 1, 1500, false,
     &reproduce::pso_table_viii, &at_once<&reproduce::pso_table_viii_result>},
    {"figure-6", "Loops at 2 Hz and 1 A: PSO against GA", pso_paper, 5, 10000, false, &reproduce::pso_figure_6,
     &at_once<&reproduce::pso_figure_6_result>},
    {"figure-7", "Loops at 2 Hz and 1 A: five models", pso_paper, 5, 10000, false, &reproduce::pso_figure_7,
     &at_once<&reproduce::pso_figure_7_result>},
    {"figure-8", "Loops at 2 Hz and 1 A: with and without offset force", pso_paper, 3, 10000, false,
     &reproduce::pso_figure_8, &at_once<&reproduce::pso_figure_8_result>},
    {"figure-9", "Order of the parameter polynomials against error", pso_paper, 1, 1000, false,
     &reproduce::pso_figure_9, &reproduce::pso_figure_9_result},
    {"figure-10", "Loops at 0.4 and 2 Hz with varied current", pso_paper, 3, 10000, false, &reproduce::pso_figure_10,
     &at_once<&reproduce::pso_figure_10_result>},
    {"figure-11", "Parameters over current and frequency, beside the published polynomials", pso_paper, 1, 1500, false,
     &reproduce::pso_figure_11, &at_once<&reproduce::pso_figure_11_result>},
    {"least-squares-table-2", "Bouc-Wen at five currents in a shrinking box, and its laws in the current",
     least_squares_paper, 1, 2500, false, &reproduce::least_squares_table_2,
     &at_once<&reproduce::least_squares_table_2_result>},
    {"lm-table-1", "Bouc-Wen of two dampers with a lagged voltage, round trip", lm_paper, 1, 2000, false,
     &reproduce::lm_table_1, &at_once<&reproduce::lm_table_1_result>},
    {"nelder-mead-tables", "Sixteen parameters of the asymmetric sigmoid by Nelder-Mead, with its sine",
     nelder_mead_paper, 3, 10000, false, &reproduce::nelder_mead_tables,
     &at_once<&reproduce::nelder_mead_tables_result>},
    {"review-polynomials", "Polynomials 13 to 28 of the review in two steps, odd and even n", review_paper, 1, 2000,
     false, &reproduce::review_polynomials, &at_once<&reproduce::review_polynomials_result>},
};

// Runs of a (problem, solver) that there are records of.
std::vector<const RunRecord*> runs_of(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                                      std::size_t solver) {
  std::map<std::string, const RunRecord*> by_key;
  for (const RunRecord& record : records) by_key[record.key] = &record;
  std::vector<const RunRecord*> result;
  for (const PlannedRun& run : plan.runs) {
    if (run.problem != problem || run.solver != solver) continue;
    if (const auto found = by_key.find(run.key); found != by_key.end()) result.push_back(found->second);
  }
  return result;
}

std::vector<double> costs(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                          std::size_t solver) {
  std::vector<double> result;
  for (const RunRecord* run : runs_of(plan, records, problem, solver)) {
    result.push_back(run->nrmse.value_or(std::numeric_limits<double>::infinity()));
  }
  return result;
}

}  // namespace

std::span<const PublishedTable> published_tables() { return tables; }

const PublishedTable* find_published_table(std::string_view id) {
  const auto found = std::ranges::find_if(tables, [&](const PublishedTable& table) { return table.id == id; });
  return found == std::end(tables) ? nullptr : found;
}

namespace reproduce {

std::string spread(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem, std::size_t solver) {
  const std::vector<double> own = costs(plan, records, problem, solver);
  if (own.empty()) return "-";
  const Quartiles q = quartiles(own);
  const std::string middle = format_number(q.median, 3);
  return own.size() == 1 ? middle : middle + " [" + format_number(q.lower, 3) + ", " + format_number(q.upper, 3) + "]";
}

double median_nrmse(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem, std::size_t solver) {
  const std::vector<double> own = costs(plan, records, problem, solver);
  return own.empty() ? std::numeric_limits<double>::infinity() : quantile(own, 0.5);
}

const RunRecord* median_run(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem,
                            std::size_t solver) {
  std::vector<const RunRecord*> own = runs_of(plan, records, problem, solver);
  std::erase_if(own, [](const RunRecord* run) { return !run->nrmse; });
  if (own.empty()) return nullptr;
  std::ranges::stable_sort(own, {}, [](const RunRecord* run) { return *run->nrmse; });
  return own[(own.size() - 1) / 2];
}

const RunRecord* best_run(const Plan& plan, const std::vector<RunRecord>& records, std::size_t problem) {
  std::map<std::string, const RunRecord*> by_key;
  for (const RunRecord& record : records) by_key[record.key] = &record;
  const RunRecord* best = nullptr;
  for (const PlannedRun& run : plan.runs) {
    if (run.problem != problem) continue;
    const auto found = by_key.find(run.key);
    if (found == by_key.end() || !found->second->nrmse) continue;
    if (best == nullptr || *found->second->nrmse < *best->nrmse) best = found->second;
  }
  return best;
}

std::size_t problem_index(const Plan& plan, const std::string& label) {
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    if (plan.problems[p].label == label) return p;
  }
  return plan.problems.size();
}

}  // namespace reproduce
}  // namespace hysteron

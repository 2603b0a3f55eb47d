#include "study/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "fit/free_coordinates.hpp"
#include "study/quantile.hpp"
#include "study/ranks.hpp"
#include "study/runtime.hpp"
#include "study/study.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double significance = 0.05;
constexpr int ecdf_targets = 41;
constexpr double ecdf_closest = 1e-3;  // of the distance to the best known cost, relative to it
constexpr double ecdf_farthest = 10.0;
constexpr std::size_t curve_points = 80;
constexpr double failure_ratio = 1e3;  // stands for the cost ratio to a run that found no finite candidate
constexpr std::size_t all_pairs_up_to = 4;
constexpr std::size_t difference_resamples = 1000;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

std::vector<double> log_grid(double low, double high, std::size_t count) {
  std::vector<double> grid;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
    grid.push_back(low * std::pow(high / low, share));
  }
  return grid;
}

// Whole evaluation counts, log-spaced, without repeats.
std::vector<double> evaluation_grid(double budget) {
  std::vector<double> grid;
  for (const double value : log_grid(1.0, std::max(budget, 2.0), curve_points)) {
    const double whole = std::round(value);
    if (grid.empty() || whole > grid.back()) grid.push_back(whole);
  }
  return grid;
}

struct Cell {
  std::vector<const RunRecord*> by_seed;  // null where the run is missing
  [[nodiscard]] std::vector<const RunRecord*> present() const {
    std::vector<const RunRecord*> result;
    for (const RunRecord* record : by_seed) {
      if (record != nullptr) result.push_back(record);
    }
    return result;
  }
};

double cost_of(const RunRecord& record) { return record.nrmse.value_or(infinite); }

// Best cost a run had after `evaluations`.
double cost_at(const RunRecord& record, double evaluations) {
  double best = infinite;
  for (const TracePoint& point : record.trace) {
    if (static_cast<double>(point.evaluations) > evaluations) break;
    best = point.best;
  }
  return best;
}

Attempt attempt(const RunRecord& record, double target) {
  for (const TracePoint& point : record.trace) {
    if (point.best <= target) return {true, static_cast<double>(point.evaluations)};
  }
  return {false, static_cast<double>(record.evaluations)};
}

class Analysis {
 public:
  Analysis(const json& plan, const std::vector<RunRecord>& records) : plan_(plan) {
    std::map<std::string, const RunRecord*> by_key;
    for (const RunRecord& record : records) by_key[record.key] = &record;
    problems_ = plan.at("problems").size();
    solvers_ = plan.at("solvers").size();
    budgets_ = plan.at("budgets").get<std::vector<std::size_t>>();
    seeds_ = plan.at("seeds").get<std::vector<std::uint64_t>>();
    tie_ = plan.at("tie").get<double>();
    equivalence_ = plan.value("equivalence", Study{}.equivalence);
    std::map<std::uint64_t, std::size_t> seed_index;
    for (std::size_t k = 0; k < seeds_.size(); ++k) seed_index[seeds_[k]] = k;
    cells_.resize(problems_ * budgets_.size() * solvers_);
    for (Cell& cell : cells_) cell.by_seed.resize(seeds_.size(), nullptr);
    best_.resize(problems_, nullptr);
    best_solver_.resize(problems_, 0);
    for (const json& run : plan.at("runs")) {
      ++planned_;
      const auto found = by_key.find(run.at("key").get<std::string>());
      if (found == by_key.end()) continue;
      ++done_;
      const auto problem = run.at("problem").get<std::size_t>();
      const auto solver = run.at("solver").get<std::size_t>();
      const auto budget =
          static_cast<std::size_t>(std::ranges::find(budgets_, run.at("budget").get<std::size_t>()) - budgets_.begin());
      const RunRecord* record = found->second;
      cell(problem, budget, solver).by_seed[seed_index.at(run.at("seed").get<std::uint64_t>())] = record;
      if (best_[problem] == nullptr || cost_of(*record) < cost_of(*best_[problem])) {
        best_[problem] = record;
        best_solver_[problem] = solver;
      }
    }
  }

  json run() {
    json result;
    result["schema"] = "hysteron.study-analysis/1";
    result["equivalence"] = equivalence_;
    for (const char* name : {"title", "normalisation", "weighting", "tolerance", "start", "targets", "target_nrmse",
                             "tie", "budgets", "seeds", "solvers"}) {
      result[name] = plan_.at(name);
    }
    result["planned"] = planned_;
    result["done"] = done_;
    result["alpha"] = significance;
    result["problems"] = problem_rows();
    result["fixed_budget"] = fixed_budget();
    result["models"] = models(result["fixed_budget"]);
    result["ranking"] = ranking(study_blocks(all_problems()));
    if (const auto [inside, on_box] = by_place_of_the_best(); !inside.empty() && !on_box.empty()) {
      result["ranking_inside"] = ranking(study_blocks(inside));
      result["ranking_on_box"] = ranking(study_blocks(on_box));
    }
    result["pairs"] = pairs();
    result["problem_pairs"] = problem_pairs();
    result["fixed_target"] = fixed_target();
    result["ecdf"] = ecdf();
    result["profiles"] = profiles();
    result["convergence"] = convergence();
    result["waterfall"] = waterfall();
    result["runs"] = run_rows();
    result["warnings"] = warnings(result);
    return result;
  }

 private:
  Cell& cell(std::size_t problem, std::size_t budget, std::size_t solver) {
    return cells_[(problem * budgets_.size() + budget) * solvers_ + solver];
  }
  [[nodiscard]] const Cell& cell(std::size_t problem, std::size_t budget, std::size_t solver) const {
    return cells_[(problem * budgets_.size() + budget) * solvers_ + solver];
  }
  [[nodiscard]] std::size_t last() const { return budgets_.size() - 1; }
  [[nodiscard]] std::string solver_name(std::size_t s) const { return plan_.at("solvers").at(s).at("label"); }
  [[nodiscard]] std::string problem_name(std::size_t p) const { return plan_.at("problems").at(p).at("label"); }
  [[nodiscard]] double best_cost(std::size_t p) const { return best_[p] == nullptr ? infinite : cost_of(*best_[p]); }

  // Costs of one problem at one budget, a row a seed that every solver has finished.
  [[nodiscard]] std::vector<std::vector<double>> blocks(std::size_t problem, std::size_t budget) const {
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < seeds_.size(); ++k) {
      std::vector<double> row;
      for (std::size_t s = 0; s < solvers_; ++s) {
        const RunRecord* record = cell(problem, budget, s).by_seed[k];
        if (record != nullptr) row.push_back(cost_of(*record));
      }
      if (row.size() == solvers_) rows.push_back(std::move(row));
    }
    return rows;
  }

  [[nodiscard]] json problem_rows() const {
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      json row = plan_.at("problems").at(p);
      row["best"] = nullptr;
      if (std::isfinite(best_cost(p))) {
        row["best"] = {{"nrmse", best_cost(p)},
                       {"key", best_[p]->key},
                       {"solver", solver_name(best_solver_[p])},
                       {"parameters", json::parse(best_[p]->parameters)},
                       {"on_box", on_box(p)}};
      }
      rows.push_back(std::move(row));
    }
    return rows;
  }

  // Parameters that the best run of a problem has on an end of their range.
  [[nodiscard]] std::vector<std::string> on_box(std::size_t p) const {
    std::vector<std::string> names;
    const json& problem = plan_.at("problems").at(p);
    if (best_[p] == nullptr || !problem.contains("box")) return names;
    const json parameters = json::parse(best_[p]->parameters);
    for (const auto& [name, range] : problem.at("box").items()) {
      if (!parameters.contains(name)) continue;
      const double lower = range.at(0).get<double>();
      const double upper = range.at(1).get<double>();
      if (on_bound((parameters.at(name).get<double>() - lower) / (upper - lower))) names.push_back(name);
    }
    return names;
  }

  [[nodiscard]] std::vector<std::size_t> all_problems() const {
    std::vector<std::size_t> result(problems_);
    std::iota(result.begin(), result.end(), std::size_t{0});
    return result;
  }

  struct ByPlace {
    std::vector<std::size_t> inside;
    std::vector<std::size_t> on_box;
  };
  // Problems by where their best known point lies: a solver that clips, reflects or projects does well or ill on those
  // of the second kind for that alone.
  [[nodiscard]] ByPlace by_place_of_the_best() const {
    ByPlace result;
    for (std::size_t p = 0; p < problems_; ++p) {
      if (best_[p] != nullptr) (on_box(p).empty() ? result.inside : result.on_box).push_back(p);
    }
    return result;
  }

  [[nodiscard]] json fixed_budget() const {
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      for (std::size_t b = 0; b < budgets_.size(); ++b) {
        for (std::size_t s = 0; s < solvers_; ++s) {
          const auto present = cell(p, b, s).present();
          if (present.empty()) continue;
          std::vector<double> costs;
          std::vector<double> heldout;
          std::vector<double> spent;
          std::vector<double> moved;
          std::size_t failed = 0;
          double diverged = 0.0;
          for (const RunRecord* record : present) {
            costs.push_back(cost_of(*record));
            spent.push_back(static_cast<double>(record->evaluations));
            diverged += static_cast<double>(record->diverged) / std::max(1.0, spent.back());
            failed += record->nrmse ? 0 : 1;
            if (record->nrmse_heldout) heldout.push_back(*record->nrmse_heldout);
            if (record->nrmse && record->nrmse_tight) {
              moved.push_back(std::fabs(*record->nrmse_tight - *record->nrmse) / *record->nrmse);
            }
          }
          const Quartiles q = quartiles(costs);
          rows.push_back({{"problem", p},
                          {"solver", s},
                          {"budget", budgets_[b]},
                          {"runs", present.size()},
                          {"failed", failed},
                          {"best", number(*std::ranges::min_element(costs))},
                          {"q1", number(q.lower)},
                          {"median", number(q.median)},
                          {"q3", number(q.upper)},
                          {"worst", number(*std::ranges::max_element(costs))},
                          {"heldout_median", heldout.empty() ? json(nullptr) : json(quantile(heldout, 0.5))},
                          {"evaluations_median", quantile(spent, 0.5)},
                          {"diverged_share", diverged / static_cast<double>(present.size())},
                          {"integration_shift", moved.empty() ? json(nullptr) : json(quantile(moved, 0.5))}});
        }
      }
    }
    return rows;
  }

  // The models of every dataset that has several, each with the solver of the lowest median at the largest budget, best
  // first: by the median on held-out recordings where all of them have one, else by that on the fitted ones.
  [[nodiscard]] json models(const json& cells) const {
    const auto data_of = [&](const json& row) {
      return plan_.at("problems").at(row.at("problem").get<std::size_t>()).at("data").get<std::string>();
    };
    std::map<std::string, std::map<std::size_t, json>> best;  // by data, then problem
    for (const json& row : cells) {
      if (row.at("budget") != budgets_.back() || !row.at("median").is_number()) continue;
      auto& of_data = best[data_of(row)];
      const auto [at, added] = of_data.emplace(row.at("problem").get<std::size_t>(), row);
      if (!added && row.at("median") < at->second.at("median")) at->second = row;
    }
    json result = json::array();
    for (const auto& [data, problems] : best) {
      if (problems.size() < 2) continue;
      std::vector<json> rows;
      for (const auto& [problem, row] : problems) {
        const json& planned = plan_.at("problems").at(problem);
        rows.push_back({{"data", data},
                        {"model", planned.at("model")},
                        {"dimension", planned.at("dimension")},
                        {"solver", row.at("solver")},
                        {"median", row.at("median")},
                        {"heldout_median", row.at("heldout_median")}});
      }
      const bool heldout =
          std::ranges::all_of(rows, [](const json& row) { return row.at("heldout_median").is_number(); });
      const char* by = heldout ? "heldout_median" : "median";
      std::ranges::stable_sort(rows, [&](const json& a, const json& b) { return a.at(by) < b.at(by); });
      for (std::size_t k = 0; k < rows.size(); ++k) {
        rows[k]["place"] = k + 1;
        rows[k]["ranked_by"] = heldout ? "held-out" : "fitted";
        result.push_back(std::move(rows[k]));
      }
    }
    return result;
  }

  // Blocks of a test over the whole study: the problems, each with the median cost of every solver; with one problem
  // its seeds. Seeds of a problem repeat that problem, and a test that counts them as blocks would take a difference on
  // few problems for one on problems in general.
  struct Blocks {
    std::vector<std::vector<std::vector<double>>> by_problem;  // problem, seed, solver
    std::vector<std::vector<double>> rows;
  };
  [[nodiscard]] Blocks study_blocks(const std::vector<std::size_t>& problems) const {
    Blocks result;
    for (const std::size_t p : problems) {
      if (auto rows = blocks(p, last()); !rows.empty()) result.by_problem.push_back(std::move(rows));
    }
    if (result.by_problem.size() == 1) {
      result.rows = result.by_problem.front();
      return result;
    }
    for (const auto& seeds : result.by_problem) {
      std::vector<double> row;
      for (std::size_t s = 0; s < solvers_; ++s) {
        std::vector<double> own;
        for (const auto& costs : seeds) own.push_back(costs[s]);
        row.push_back(quantile(own, 0.5));
      }
      result.rows.push_back(std::move(row));
    }
    return result;
  }

  [[nodiscard]] json ranking(const Blocks& of) const {
    std::vector<std::vector<double>> all;
    std::vector<std::vector<double>> by_problem;
    for (const auto& seeds : of.by_problem) {
      all.insert(all.end(), seeds.begin(), seeds.end());
      by_problem.push_back(friedman_test(seeds, tie_).mean_ranks);
    }
    json result = {{"blocks", of.rows.size()},
                   {"block", by_problem.size() == 1 ? "seed" : "problem"},
                   {"problems", by_problem.size()},
                   {"rows", json::array()},
                   {"cliques", json::array()}};
    if (all.empty()) return result;
    const Friedman test = friedman_test(of.rows, tie_);
    const bool different = solvers_ > 1 && test.p < significance;
    result["chi_squared"] = test.chi_squared;
    result["degrees"] = solvers_ - 1;
    result["p"] = test.p;
    result["critical_difference"] = test.critical_difference;
    result["different"] = different;
    std::vector<std::size_t> order(solvers_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return test.mean_ranks[a] < test.mean_ranks[b]; });
    std::vector<double> sorted;
    for (const std::size_t s : order) sorted.push_back(test.mean_ranks[s]);
    const auto apart = [&](std::size_t a, std::size_t b) {
      return different && std::fabs(test.mean_ranks[a] - test.mean_ranks[b]) >= test.critical_difference;
    };
    for (const std::size_t s : order) {
      std::size_t better = 0;
      json ties = json::array();
      for (const std::size_t other : order) {
        if (other == s) continue;
        if (!apart(s, other)) {
          ties.push_back(solver_name(other));
        } else if (test.mean_ranks[other] < test.mean_ranks[s]) {
          ++better;
        }
      }
      std::size_t wins = 0;
      for (const auto& block : all) {
        wins += block[s] <= *std::ranges::min_element(block) * (1.0 + tie_) && std::isfinite(block[s]) ? 1 : 0;
      }
      json own = json::array();
      for (const auto& ranks : by_problem) own.push_back(ranks[s]);
      result["rows"].push_back({{"solver", s},
                                {"place", better + 1},
                                {"mean_rank", test.mean_ranks[s]},
                                {"ties_with", ties},
                                {"share_best", static_cast<double>(wins) / static_cast<double>(all.size())},
                                {"mean_rank_by_problem", own}});
    }
    const double width = different ? test.critical_difference : infinite;
    for (const auto& [first, end] : cliques(sorted, width)) result["cliques"].push_back({first, end});
    return result;
  }

  [[nodiscard]] double log_ratio(double a, double b) const {
    if (std::isinf(a) && std::isinf(b)) return 0.0;
    if (std::isinf(a)) return std::log(failure_ratio);
    if (std::isinf(b)) return -std::log(failure_ratio);
    if (a <= 0.0 || b <= 0.0) return a == b ? 0.0 : (a < b ? -1.0 : 1.0) * std::log(failure_ratio);
    return std::log(a / b);
  }

  [[nodiscard]] json pair_row(std::size_t a, std::size_t b, const std::vector<double>& ratios) const {
    const SignedRank test = signed_rank_test(ratios, std::log1p(tie_));
    const auto n = static_cast<double>(test.pairs - test.zeros);
    return {{"a", a},
            {"b", b},
            {"pairs", test.pairs},
            {"ties", test.zeros},
            {"a_better", std::ranges::count_if(ratios, [&](double r) { return r < -std::log1p(tie_); })},
            {"w_plus", test.w_plus},
            {"w_minus", 0.5 * n * (n + 1.0) - test.w_plus},
            {"median_ratio", ratios.empty() ? json(nullptr) : json(std::exp(quantile(ratios, 0.5)))},
            {"exact", test.exact},
            {"p", test.p}};
  }

  static void correct(json& rows) {
    std::vector<double> p;
    for (const json& row : rows) p.push_back(row.at("p").get<double>());
    const std::vector<double> adjusted = holm(p);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k]["p_holm"] = adjusted[k];
      const bool shown = adjusted[k] < significance;
      const bool first = rows[k].at("w_minus").get<double>() > rows[k].at("w_plus").get<double>();
      rows[k]["verdict"] = !shown ? "tie" : first ? "a" : "b";
    }
  }

  [[nodiscard]] std::vector<double> ratios(const std::vector<std::vector<double>>& rows, std::size_t a,
                                           std::size_t b) const {
    std::vector<double> result;
    for (const auto& row : rows) result.push_back(log_ratio(row[a], row[b]));
    return result;
  }

  // Mean over the problems of the mean log cost ratio over their seeds, with the 95 % percentile interval of a
  // bootstrap that draws problems, then seeds within them, and the shares of resamples below, within and above the
  // region of practical equivalence. With one problem only its seeds are drawn.
  [[nodiscard]] json difference(const Blocks& of, std::size_t a, std::size_t b) const {
    std::vector<std::vector<double>> values;
    double mean = 0.0;
    for (const auto& seeds : of.by_problem) {
      values.push_back(ratios(seeds, a, b));
      mean +=
          std::accumulate(values.back().begin(), values.back().end(), 0.0) / static_cast<double>(values.back().size());
    }
    const std::size_t problems = values.size();
    const Stream stream = Stream(0).child("cost ratio").child(solver_name(a)).child(solver_name(b));
    std::vector<double> means;
    std::size_t below = 0;
    std::size_t above = 0;
    const double region = std::log1p(equivalence_);
    for (std::size_t draw = 0; draw < difference_resamples; ++draw) {
      std::uint32_t next = 0;
      double sum = 0.0;
      for (std::size_t k = 0; k < problems; ++k) {
        const auto& seeds = values[problems > 1 ? stream.below(problems, draw, next++) : 0];
        double own = 0.0;
        for (std::size_t n = 0; n < seeds.size(); ++n) own += seeds[stream.below(seeds.size(), draw, next++)];
        sum += own / static_cast<double>(seeds.size());
      }
      means.push_back(sum / static_cast<double>(problems));
      below += means.back() < -region ? 1 : 0;
      above += means.back() > region ? 1 : 0;
    }
    const double low = quantile(means, 0.025);
    const double high = quantile(means, 0.975);
    constexpr auto all = static_cast<double>(difference_resamples);
    return {{"mean_ratio", std::exp(mean / static_cast<double>(problems))},
            {"ratio_low", std::exp(low)},
            {"ratio_high", std::exp(high)},
            {"share_a_better", static_cast<double>(below) / all},
            {"share_equal", (all - static_cast<double>(below + above)) / all},
            {"share_b_better", static_cast<double>(above) / all},
            {"practical", high < -region                     ? "a"
                          : low > region                     ? "b"
                          : low >= -region && high <= region ? "equal"
                                                             : "undecided"}};
  }

  [[nodiscard]] json pairs() const {
    const Blocks of = study_blocks(all_problems());
    json result = json::array();
    for (std::size_t a = 0; a < solvers_; ++a) {
      for (std::size_t b = a + 1; b < solvers_; ++b) {
        result.push_back(pair_row(a, b, ratios(of.rows, a, b)));
        if (!of.rows.empty()) result.back().update(difference(of, a, b));
      }
    }
    correct(result);
    return result;
  }

  [[nodiscard]] json problem_pairs() const {
    json result = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      const auto rows = blocks(p, last());
      if (rows.empty()) continue;
      std::size_t best = 0;
      double lowest = infinite;
      for (std::size_t s = 0; s < solvers_; ++s) {
        std::vector<double> own;
        for (const auto& row : rows) own.push_back(row[s]);
        if (const double middle = quantile(own, 0.5); middle < lowest) {
          lowest = middle;
          best = s;
        }
      }
      for (std::size_t a = 0; a < solvers_; ++a) {
        for (std::size_t b = a + 1; b < solvers_; ++b) {
          if (solvers_ > all_pairs_up_to && a != best && b != best) continue;
          const std::size_t first = solvers_ > all_pairs_up_to ? best : a;
          const std::size_t second = first == a ? b : a;
          json row = pair_row(first, second, ratios(rows, first, second));
          row["problem"] = p;
          result.push_back(std::move(row));
        }
      }
    }
    correct(result);
    return result;
  }

  struct TargetLevel {
    std::string label;
    double factor;  // 0: absolute
    double value;
  };
  [[nodiscard]] std::vector<TargetLevel> levels(std::size_t problem) const {
    std::vector<TargetLevel> result;
    for (const json& factor : plan_.at("targets")) {
      const auto f = factor.get<double>();
      char text[48];
      std::snprintf(text, sizeof text, "%g x best known", f);
      // A run that ends on the best cost itself reaches the target 1.0.
      result.push_back({text, f, best_cost(problem) * f * (1.0 + 1e-12)});
    }
    for (const json& value : plan_.at("target_nrmse")) {
      char text[48];
      std::snprintf(text, sizeof text, "NRMSE %g", value.get<double>());
      result.push_back({text, 0.0, value.get<double>()});
    }
    return result;
  }

  [[nodiscard]] std::vector<Attempt> attempts(std::size_t p, std::size_t s, double target) const {
    std::vector<Attempt> result;
    for (const RunRecord* record : cell(p, last(), s).present()) result.push_back(attempt(*record, target));
    return result;
  }

  [[nodiscard]] json fixed_target() const {
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      if (!std::isfinite(best_cost(p))) continue;
      for (const TargetLevel& level : levels(p)) {
        for (std::size_t s = 0; s < solvers_; ++s) {
          const auto tries = attempts(p, s, level.value);
          if (tries.empty()) continue;
          const Stream stream =
              Stream(0).child("expected run time").child(problem_name(p)).child(solver_name(s)).child(level.label);
          const ExpectedRunTime time = expected_run_time(tries, stream);
          const Interval share = wilson(time.successes, time.runs);
          rows.push_back({{"problem", p},
                          {"target", level.label},
                          {"nrmse", level.value},
                          {"solver", s},
                          {"runs", time.runs},
                          {"successes", time.successes},
                          {"success_low", share.lower},
                          {"success_high", share.upper},
                          {"ert", time.value ? json(*time.value) : json(nullptr)},
                          {"ert_low", time.interval ? number(time.interval->lower) : json(nullptr)},
                          {"ert_high", time.interval ? number(time.interval->upper) : json(nullptr)},
                          {"spent", time.spent}});
        }
      }
    }
    return rows;
  }

  [[nodiscard]] json ecdf() const {
    const std::vector<double> grid = evaluation_grid(static_cast<double>(budgets_.back()));
    const std::vector<double> distances = log_grid(ecdf_closest, ecdf_farthest, ecdf_targets);
    json curves = json::array();
    for (std::size_t s = 0; s < solvers_; ++s) {
      std::vector<double> hits;
      for (std::size_t p = 0; p < problems_; ++p) {
        if (!std::isfinite(best_cost(p))) continue;
        for (const RunRecord* record : cell(p, last(), s).present()) {
          for (const double distance : distances) {
            const Attempt found = attempt(*record, best_cost(p) * (1.0 + distance));
            hits.push_back(found.success ? found.evaluations : infinite);
          }
        }
      }
      curves.push_back(distribution(hits, grid));
    }
    return {{"evaluations", grid},
            {"share", curves},
            {"targets", ecdf_targets},
            {"closest", ecdf_closest},
            {"farthest", ecdf_farthest}};
  }

  [[nodiscard]] json profiles() const {
    // Performance: expected run time of every (problem, target). Data: every (problem, seed) at the first target.
    std::vector<std::vector<double>> expected;
    for (std::size_t p = 0; p < problems_; ++p) {
      if (!std::isfinite(best_cost(p))) continue;
      for (const TargetLevel& level : levels(p)) {
        std::vector<double> row;
        for (std::size_t s = 0; s < solvers_; ++s) {
          double spent = 0.0;
          double successes = 0.0;
          for (const Attempt& one : attempts(p, s, level.value)) {
            spent += one.evaluations;
            successes += one.success ? 1.0 : 0.0;
          }
          row.push_back(successes > 0.0 ? spent / successes : infinite);
        }
        expected.push_back(std::move(row));
      }
    }
    std::vector<std::vector<double>> single;
    std::vector<std::size_t> dimensions;
    std::size_t smallest = std::numeric_limits<std::size_t>::max();
    for (std::size_t p = 0; p < problems_; ++p) {
      const auto dimension = plan_.at("problems").at(p).at("dimension").get<std::size_t>();
      smallest = std::min(smallest, dimension);
      if (!std::isfinite(best_cost(p)) || levels(p).empty()) continue;
      const double target = levels(p).front().value;
      for (std::size_t k = 0; k < seeds_.size(); ++k) {
        std::vector<double> row;
        for (std::size_t s = 0; s < solvers_; ++s) {
          const RunRecord* record = cell(p, last(), s).by_seed[k];
          if (record == nullptr) continue;
          const Attempt one = attempt(*record, target);
          row.push_back(one.success ? one.evaluations : infinite);
        }
        if (row.size() != solvers_) continue;
        single.push_back(std::move(row));
        dimensions.push_back(dimension);
      }
    }
    const std::vector<double> ratios = log_grid(1.0, 100.0, curve_points);
    const std::vector<double> budgets = log_grid(
        1.0, std::max(2.0, static_cast<double>(budgets_.back()) / static_cast<double>(smallest + 1)), curve_points);
    return {{"ratios", ratios},
            {"performance", performance_profile(expected, ratios)},
            {"performance_cases", expected.size()},
            {"simplex_gradients", budgets},
            {"data", data_profile(single, dimensions, budgets)},
            {"data_cases", single.size()},
            {"data_target", problems_ > 0 && !levels(0).empty() ? json(levels(0).front().label) : json(nullptr)}};
  }

  [[nodiscard]] json convergence() const {
    const std::vector<double> grid = evaluation_grid(static_cast<double>(budgets_.back()));
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      for (std::size_t s = 0; s < solvers_; ++s) {
        const auto present = cell(p, last(), s).present();
        if (present.empty()) continue;
        json median = json::array();
        json lower = json::array();
        json upper = json::array();
        for (const double at : grid) {
          std::vector<double> costs;
          for (const RunRecord* record : present) costs.push_back(cost_at(*record, at));
          const Quartiles q = quartiles(costs);
          median.push_back(number(q.median));
          lower.push_back(number(q.lower));
          upper.push_back(number(q.upper));
        }
        rows.push_back({{"problem", p}, {"solver", s}, {"median", median}, {"q1", lower}, {"q3", upper}});
      }
    }
    return {{"evaluations", grid}, {"rows", rows}};
  }

  [[nodiscard]] json waterfall() const {
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      for (std::size_t s = 0; s < solvers_; ++s) {
        std::vector<double> costs;
        for (const RunRecord* record : cell(p, last(), s).present()) {
          if (record->nrmse) costs.push_back(*record->nrmse);
        }
        std::ranges::sort(costs);
        rows.push_back({{"problem", p}, {"solver", s}, {"nrmse", costs}});
      }
    }
    return rows;
  }

  [[nodiscard]] json run_rows() const {
    json rows = json::array();
    for (std::size_t p = 0; p < problems_; ++p) {
      for (std::size_t b = 0; b < budgets_.size(); ++b) {
        for (std::size_t k = 0; k < seeds_.size(); ++k) {
          for (std::size_t s = 0; s < solvers_; ++s) {
            const RunRecord* record = cell(p, b, s).by_seed[k];
            if (record == nullptr) continue;
            rows.push_back({record->key, p, s, budgets_[b], seeds_[k],
                            record->nrmse ? json(*record->nrmse) : json(nullptr), record->evaluations,
                            record->stopped});
          }
        }
      }
    }
    return rows;
  }

  [[nodiscard]] json warnings(const json& result) const {
    json list = json::array();
    if (done_ < planned_) {
      list.push_back(std::to_string(planned_ - done_) + " of " + std::to_string(planned_) +
                     " runs are missing: everything below is of the others, and rankings of the seeds that every "
                     "solver has finished");
    }
    const std::size_t blocks = result.at("ranking").at("blocks").get<std::size_t>();
    const std::size_t tests = result.at("pairs").size();
    if (tests > 0 && blocks > 0 && blocks < 60 &&
        static_cast<double>(tests) * std::exp2(1.0 - static_cast<double>(blocks)) > significance) {
      const std::string block = result.at("ranking").at("block");
      list.push_back("with " + std::to_string(blocks) + " " + block + (blocks == 1 ? "" : "s") +
                     " no difference between two solvers can reach significance after Holm's correction: add " + block +
                     "s");
    }
    for (std::size_t p = 0; p < problems_; ++p) {
      std::vector<double> medians;
      double shift = 0.0;
      double lowest = infinite;
      std::size_t failed = 0;
      for (const json& row : result.at("fixed_budget")) {
        if (row.at("problem") != p || row.at("budget") != budgets_.back()) continue;
        failed += row.at("failed").get<std::size_t>();
        if (row.at("median").is_null()) continue;
        medians.push_back(row.at("median").get<double>());
        if (medians.back() < lowest && !row.at("integration_shift").is_null()) {
          lowest = medians.back();
          shift = row.at("integration_shift").get<double>();
        }
      }
      std::ranges::sort(medians);
      if (medians.size() > 1) {
        const double gap = medians[1] / medians[0] - 1.0;
        if (shift > tie_ && shift > gap) {
          char text[64];
          std::snprintf(text, sizeof text, "%.2g %%", 100.0 * shift);
          list.push_back(problem_name(p) + ": a finer integration moves the NRMSE of the leading solver by " + text +
                         ", more than its lead: use a smaller tolerance in the study");
        }
      }
      if (failed > 0) {
        list.push_back(problem_name(p) + ": " + std::to_string(failed) +
                       " runs found no candidate that stays finite; they rank last");
      }
    }
    return list;
  }

  const json& plan_;
  std::size_t problems_ = 0;
  std::size_t solvers_ = 0;
  std::vector<std::size_t> budgets_;
  std::vector<std::uint64_t> seeds_;
  double tie_ = 0.0;
  double equivalence_ = 0.0;
  std::vector<Cell> cells_;
  std::vector<const RunRecord*> best_;
  std::vector<std::size_t> best_solver_;
  std::size_t planned_ = 0;
  std::size_t done_ = 0;
};

}  // namespace

json analyse(const json& plan, const std::vector<RunRecord>& records) { return Analysis(plan, records).run(); }

json analyse_times(const json& plan, const json& analysis, const std::vector<RunRecord>& records,
                   const std::vector<RunTiming>& timings) {
  std::map<std::string, const RunTiming*> by_key;
  for (const RunTiming& timing : timings) by_key[timing.key] = &timing;
  std::map<std::string, const RunRecord*> results;
  for (const RunRecord& record : records) results[record.key] = &record;
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::vector<double>, double>> cells;
  double total = 0.0;
  std::map<std::string, std::size_t> hosts;
  for (const json& run : plan.at("runs")) {
    const auto key = run.at("key").get<std::string>();
    const auto timing = by_key.find(key);
    const auto record = results.find(key);
    if (timing == by_key.end() || record == results.end()) continue;
    auto& [seconds, evaluations] = cells[{run.at("problem").get<std::size_t>(), run.at("solver").get<std::size_t>()}];
    seconds.push_back(timing->second->seconds);
    evaluations += static_cast<double>(record->second->evaluations);
    total += timing->second->seconds;
    ++hosts[timing->second->host];
  }
  std::map<std::pair<std::size_t, std::size_t>, double> to_target;
  json target = nullptr;
  for (const json& row : analysis.at("fixed_target")) {
    if (target.is_null()) target = row.at("target");
    if (row.at("target") != target || row.at("ert").is_null()) continue;
    to_target[{row.at("problem").get<std::size_t>(), row.at("solver").get<std::size_t>()}] =
        row.at("ert").get<double>();
  }
  json rows = json::array();
  for (const auto& [where, what] : cells) {
    const auto expected = to_target.find(where);
    const double sum = std::accumulate(what.first.begin(), what.first.end(), 0.0);
    rows.push_back({{"problem", where.first},
                    {"solver", where.second},
                    {"runs", what.first.size()},
                    {"seconds_median", quantile(what.first, 0.5)},
                    {"seconds_total", sum},
                    {"evaluations_total", what.second},
                    {"microseconds_per_evaluation", what.second > 0.0 ? json(1e6 * sum / what.second) : json(nullptr)},
                    {"seconds_to_target", what.second > 0.0 && expected != to_target.end()
                                              ? json(expected->second * sum / what.second)
                                              : json(nullptr)}});
  }
  return {{"schema", "hysteron.study-times/1"},
          {"target", target},
          {"seconds_total", total},
          {"runs_by_host", hosts},
          {"rows", rows}};
}

}  // namespace hysteron

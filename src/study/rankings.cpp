#include "study/rankings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/random.hpp"
#include "study/quantile.hpp"
#include "study/ranks.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t all_pairs_up_to = 4;
constexpr std::size_t difference_resamples = 1000;

// Blocks of a test over the whole study: the problems, each with the median cost of every solver; with one problem
// its seeds. Seeds of a problem repeat that problem, and a test that counts them as blocks would take a difference on
// few problems for one on problems in general.
struct Blocks {
  std::vector<std::vector<std::vector<double>>> by_problem;  // problem, seed, solver
  std::vector<std::vector<double>> rows;
};

// Costs of one solver.
std::vector<double> column(const std::vector<std::vector<double>>& rows, std::size_t solver) {
  std::vector<double> result(rows.size());
  std::ranges::transform(rows, result.begin(), [&](const std::vector<double>& row) { return row[solver]; });
  return result;
}

Blocks study_blocks(const Cells& study, const std::vector<std::size_t>& problems) {
  Blocks result;
  for (const std::size_t p : problems) {
    if (auto rows = study.by_seed(p, study.last()); !rows.empty()) result.by_problem.push_back(std::move(rows));
  }
  if (result.by_problem.size() == 1) {
    result.rows = result.by_problem.front();
    return result;
  }
  for (const auto& seeds : result.by_problem) {
    std::vector<double> row;
    for (std::size_t s = 0; s < study.solvers(); ++s) row.push_back(quantile(column(seeds, s), 0.5));
    result.rows.push_back(std::move(row));
  }
  return result;
}

// Infinite against a run that found no finite candidate, whose cost counts as infinite, and against a cost of 0.
double log_ratio(double a, double b) {
  if (a == b) return 0.0;
  if (std::isinf(a) || std::isinf(b) || a <= 0.0 || b <= 0.0) return a < b ? -infinite : infinite;
  return std::log(a / b);
}

// The ratio of a logarithm; null where it is infinite, or as good as zero.
json ratio_of(double logarithm) { return std::isfinite(logarithm) ? json(std::exp(logarithm)) : json(nullptr); }

json pair_row(const Cells& study, std::size_t a, std::size_t b, const std::vector<double>& ratios) {
  const SignedRank test = signed_rank_test(ratios, std::log1p(study.tie()));
  const auto n = static_cast<double>(test.pairs - test.zeros);
  return {{"a", a},
          {"b", b},
          {"pairs", test.pairs},
          {"ties", test.zeros},
          {"a_better", std::ranges::count_if(ratios, [&](double r) { return r < -std::log1p(study.tie()); })},
          {"w_plus", test.w_plus},
          {"w_minus", 0.5 * n * (n + 1.0) - test.w_plus},
          {"median_ratio", ratios.empty() ? json(nullptr) : ratio_of(quantile(ratios, 0.5))},
          {"exact", test.exact},
          {"p", test.p}};
}

void correct(json& rows) {
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

std::vector<double> log_ratios(const std::vector<std::vector<double>>& rows, std::size_t a, std::size_t b) {
  std::vector<double> result(rows.size());
  std::ranges::transform(rows, result.begin(), [&](const auto& row) { return log_ratio(row[a], row[b]); });
  return result;
}

bool any_infinite(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isinf(value); });
}

// Mean over the problems of the mean log cost ratio over their seeds, with the 95 % percentile interval of a
// bootstrap that draws problems, then seeds within them, and the shares of resamples below, within and above the
// region of practical equivalence. With one problem only its seeds are drawn. Failed runs are not left out, which would
// favour who fails where it is hard: their ratios are infinite, and so is a mean with one of them. A resample with
// failures of either solver has no mean: it counts in no share, and may lie at either end of the interval.
json difference(const Cells& study, const Blocks& of, std::size_t a, std::size_t b) {
  std::vector<std::vector<double>> values;
  double mean = 0.0;
  for (const auto& seeds : of.by_problem) {
    values.push_back(log_ratios(seeds, a, b));
    mean +=
        std::accumulate(values.back().begin(), values.back().end(), 0.0) / static_cast<double>(values.back().size());
  }
  const std::size_t problems = values.size();
  const Stream stream = Stream(0).child("cost ratio").child(study.solver_name(a)).child(study.solver_name(b));
  std::vector<double> lows;
  std::vector<double> highs;
  std::size_t below = 0;
  std::size_t within = 0;
  std::size_t above = 0;
  const double region = std::log1p(study.equivalence());
  for (std::size_t draw = 0; draw < difference_resamples; ++draw) {
    std::uint32_t next = 0;
    double sum = 0.0;
    for (std::size_t k = 0; k < problems; ++k) {
      const auto& seeds = values[problems > 1 ? stream.below(problems, draw, next++) : 0];
      double own = 0.0;
      for (std::size_t n = 0; n < seeds.size(); ++n) own += seeds[stream.below(seeds.size(), draw, next++)];
      sum += own / static_cast<double>(seeds.size());
    }
    const double own_mean = sum / static_cast<double>(problems);
    lows.push_back(std::isnan(own_mean) ? -infinite : own_mean);
    highs.push_back(std::isnan(own_mean) ? infinite : own_mean);
    below += own_mean < -region ? 1 : 0;
    within += own_mean >= -region && own_mean <= region ? 1 : 0;
    above += own_mean > region ? 1 : 0;
  }
  const double low = quantile(lows, 0.025);
  const double high = quantile(highs, 0.975);
  constexpr auto all = static_cast<double>(difference_resamples);
  json result = {{"mean_ratio", ratio_of(mean / static_cast<double>(problems))},
                 {"ratio_low", ratio_of(low)},
                 {"ratio_high", ratio_of(high)},
                 {"share_a_better", static_cast<double>(below) / all},
                 {"share_equal", static_cast<double>(within) / all},
                 {"share_b_better", static_cast<double>(above) / all},
                 {"practical", high < -region                     ? "a"
                               : low > region                     ? "b"
                               : low >= -region && high <= region ? "equal"
                                                                  : "undecided"}};
  if (const auto infinite_ones = std::ranges::count_if(values, any_infinite); infinite_ones > 0) {
    result["problems_infinite"] = infinite_ones;
  }
  return result;
}

}  // namespace

json ranking(const Cells& study, const std::vector<std::size_t>& problems) {
  const Blocks of = study_blocks(study, problems);
  std::vector<std::vector<double>> all;
  std::vector<std::vector<double>> by_problem;
  for (const auto& seeds : of.by_problem) {
    all.insert(all.end(), seeds.begin(), seeds.end());
    by_problem.push_back(friedman_test(seeds, study.tie()).mean_ranks);
  }
  json result = {{"blocks", of.rows.size()},
                 {"block", by_problem.size() == 1 ? "seed" : "problem"},
                 {"problems", by_problem.size()},
                 {"rows", json::array()},
                 {"cliques", json::array()}};
  if (all.empty()) return result;
  const Friedman test = friedman_test(of.rows, study.tie());
  const bool different = study.solvers() > 1 && test.p < significance;
  result["chi_squared"] = test.chi_squared;
  result["degrees"] = study.solvers() - 1;
  result["p"] = test.p;
  result["critical_difference"] = test.critical_difference;
  result["different"] = different;
  std::vector<std::size_t> order(study.solvers());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return test.mean_ranks[a] < test.mean_ranks[b]; });
  std::vector<double> sorted(study.solvers());
  std::ranges::transform(order, sorted.begin(), [&](std::size_t s) { return test.mean_ranks[s]; });
  const auto apart = [&](std::size_t a, std::size_t b) {
    return different && std::fabs(test.mean_ranks[a] - test.mean_ranks[b]) >= test.critical_difference;
  };
  for (const std::size_t s : order) {
    std::size_t better = 0;
    json ties = json::array();
    for (const std::size_t other : order) {
      if (other == s) continue;
      if (!apart(s, other)) {
        ties.push_back(study.solver_name(other));
      } else if (test.mean_ranks[other] < test.mean_ranks[s]) {
        ++better;
      }
    }
    std::size_t wins = 0;
    for (const auto& block : all) {
      wins += block[s] <= *std::ranges::min_element(block) * (1.0 + study.tie()) && std::isfinite(block[s]) ? 1 : 0;
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

json pairs(const Cells& study) {
  std::vector<std::size_t> problems(study.problems());
  std::iota(problems.begin(), problems.end(), std::size_t{0});
  const Blocks of = study_blocks(study, problems);
  json result = json::array();
  for (std::size_t a = 0; a < study.solvers(); ++a) {
    for (std::size_t b = a + 1; b < study.solvers(); ++b) {
      result.push_back(pair_row(study, a, b, log_ratios(of.rows, a, b)));
      if (!of.rows.empty()) result.back().update(difference(study, of, a, b));
    }
  }
  correct(result);
  return result;
}

json problem_pairs(const Cells& study) {
  json result = json::array();
  for (std::size_t p = 0; p < study.problems(); ++p) {
    const auto rows = study.by_seed(p, study.last());
    if (rows.empty()) continue;
    std::size_t best = 0;
    double lowest = infinite;
    for (std::size_t s = 0; s < study.solvers(); ++s) {
      if (const double middle = quantile(column(rows, s), 0.5); middle < lowest) {
        lowest = middle;
        best = s;
      }
    }
    for (std::size_t a = 0; a < study.solvers(); ++a) {
      for (std::size_t b = a + 1; b < study.solvers(); ++b) {
        if (study.solvers() > all_pairs_up_to && a != best && b != best) continue;
        const std::size_t first = study.solvers() > all_pairs_up_to ? best : a;
        const std::size_t second = first == a ? b : a;
        json row = pair_row(study, first, second, log_ratios(rows, first, second));
        row["problem"] = p;
        result.push_back(std::move(row));
      }
    }
  }
  correct(result);
  return result;
}

}  // namespace hysteron

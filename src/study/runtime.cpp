#include "study/runtime.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "study/quantile.hpp"

namespace hysteron {

ExpectedRunTime expected_run_time(const std::vector<Attempt>& attempts, const Stream& stream, std::size_t resamples) {
  constexpr std::size_t many_runs = 100;
  constexpr std::size_t fewest_part = 5;
  ExpectedRunTime result;
  result.runs = attempts.size();
  for (const Attempt& attempt : attempts) {
    result.spent += attempt.evaluations;
    result.successes += attempt.success ? 1 : 0;
  }
  if (result.successes == 0) return result;
  result.value = result.spent / static_cast<double>(result.successes);
  std::vector<double> values;
  const std::size_t enough =
      std::max(resamples * many_runs / std::max(attempts.size(), many_runs), resamples / fewest_part);
  values.reserve(enough);
  for (std::size_t b = 0; b < enough; ++b) {
    double spent = 0.0;
    double successes = 0.0;
    for (std::size_t k = 0; k < attempts.size(); ++k) {
      const Attempt& drawn = attempts[stream.below(attempts.size(), b, static_cast<std::uint32_t>(k))];
      spent += drawn.evaluations;
      successes += drawn.success ? 1.0 : 0.0;
    }
    values.push_back(successes > 0.0 ? spent / successes : std::numeric_limits<double>::infinity());
  }
  result.interval = Interval{quantile(values, 0.025), quantile(values, 0.975)};
  return result;
}

std::vector<double> distribution(const std::vector<double>& values, const std::vector<double>& grid) {
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  std::vector<double> result;
  for (const double x : grid) {
    const auto count = std::ranges::upper_bound(sorted, x) - sorted.begin();
    result.push_back(values.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(values.size()));
  }
  return result;
}

std::vector<std::vector<double>> performance_profile(const std::vector<std::vector<double>>& times,
                                                     const std::vector<double>& ratios) {
  const std::size_t solvers = times.empty() ? 0 : times.front().size();
  std::vector<std::vector<double>> ratio(solvers);
  for (const std::vector<double>& row : times) {
    assert(row.size() == solvers);
    const double best = *std::ranges::min_element(row);
    for (std::size_t s = 0; s < solvers; ++s) {
      ratio[s].push_back(std::isfinite(row[s]) ? row[s] / best : std::numeric_limits<double>::infinity());
    }
  }
  std::vector<std::vector<double>> result;
  for (const std::vector<double>& own : ratio) result.push_back(distribution(own, ratios));
  return result;
}

std::vector<std::vector<double>> data_profile(const std::vector<std::vector<double>>& times,
                                              const std::vector<std::size_t>& dimensions,
                                              const std::vector<double>& budgets) {
  assert(times.size() == dimensions.size());
  const std::size_t solvers = times.empty() ? 0 : times.front().size();
  std::vector<std::vector<double>> simplex(solvers);
  for (std::size_t p = 0; p < times.size(); ++p) {
    for (std::size_t s = 0; s < solvers; ++s) {
      simplex[s].push_back(times[p][s] / static_cast<double>(dimensions[p] + 1));
    }
  }
  std::vector<std::vector<double>> result;
  for (const std::vector<double>& own : simplex) result.push_back(distribution(own, budgets));
  return result;
}

}  // namespace hysteron

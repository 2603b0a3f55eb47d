// Run times in evaluations: expected run time, empirical distribution, performance and data profiles.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "study/proportion.hpp"

namespace hysteron {

// How long one run took to reach a target: evaluations at success, or the evaluations it spent in vain.
struct Attempt {
  bool success;
  double evaluations;
};

// Expected run time of independent restarts: evaluations of all runs / number of successes (Price 1997; Hansen et al.,
// COCO). Empty when no run succeeded: then only the lower bound `spent` is known.
struct ExpectedRunTime {
  std::size_t successes = 0;
  std::size_t runs = 0;
  double spent = 0.0;
  std::optional<double> value;
  // 95 %, percentiles of the bootstrap over runs; its upper end may be infinite.
  std::optional<Interval> interval;
};
// At most `resamples`, fewer of more than a hundred runs and never less than a fifth: their interval is narrow.
[[nodiscard]] ExpectedRunTime expected_run_time(const std::vector<Attempt>& attempts, const Stream& stream,
                                                std::size_t resamples = 1000);

// Share of values <= x at every x of the grid; infinite values never count.
[[nodiscard]] std::vector<double> distribution(const std::vector<double>& values, const std::vector<double>& grid);

// Performance profiles of Dolan and More, Math. Program. 91 (2002) 201-213: times[problem][solver], infinite for a
// failure; result[solver][k] is the share of problems whose ratio to the best solver is <= ratios[k]. Problems that no
// solver solves count as unsolved.
[[nodiscard]] std::vector<std::vector<double>> performance_profile(const std::vector<std::vector<double>>& times,
                                                                   const std::vector<double>& ratios);

// Data profiles of More and Wild, SIAM J. Optim. 20 (2009) 172-191: share of problems solved within k (n + 1)
// evaluations, n the dimension of each problem.
[[nodiscard]] std::vector<std::vector<double>> data_profile(const std::vector<std::vector<double>>& times,
                                                            const std::vector<std::size_t>& dimensions,
                                                            const std::vector<double>& budgets);

}  // namespace hysteron

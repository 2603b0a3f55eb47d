// Tests on ranks: which solver is better, and when that cannot be said.
#pragma once

#include <cstddef>
#include <vector>

#include "core/midranks.hpp"

namespace hysteron {

struct SignedRank {
  std::size_t pairs = 0;  // given
  std::size_t zeros = 0;  // dropped: differences that are ties
  double w_plus = 0.0;    // sum of the ranks of positive differences
  double p = 1.0;         // two-sided
  bool exact = false;     // from the permutation distribution of the ranks, else normal with tie correction
};

// Wilcoxon signed-rank test of differences against a symmetric distribution about zero (Wilcoxon, Biometrics Bull. 1
// (1945) 80-83). Differences of magnitude <= `zero` are dropped and counted. Exact, with midranks, up to 50 differences
// left; beyond it the normal approximation with the correction for ties and for continuity.
[[nodiscard]] SignedRank signed_rank_test(const std::vector<double>& differences, double zero = 0.0);

// Pairs without which signed_rank_test shows nothing, whatever they are: with fewer, even differences that all have one
// sign give a p of `level` or more after Holm's correction over so many tests.
[[nodiscard]] std::size_t pairs_to_tell(std::size_t tests, double level);

// Holm's step-down correction (Scand. J. Stat. 6 (1979) 65-70): adjusted p values in the order given.
[[nodiscard]] std::vector<double> holm(const std::vector<double>& p);

struct Friedman {
  std::size_t blocks = 0;
  std::vector<double> mean_ranks;  // one a treatment
  double chi_squared = 0.0;        // corrected for ties
  double p = 1.0;
  double critical_difference = 0.0;  // Nemenyi at 5 %: mean ranks closer than this are not told apart; 0 if unknown
};

// Friedman's test over `blocks` (rows of costs, one a treatment; J. Am. Stat. Assoc. 32 (1937) 675-701) with the
// critical difference q sqrt(k (k + 1) / (6 N)) of Nemenyi as in Demsar, J. Mach. Learn. Res. 7 (2006) 1-30.
[[nodiscard]] Friedman friedman_test(const std::vector<std::vector<double>>& blocks, double tie = 0.0);

// Groups of treatments that the critical difference does not tell apart: maximal runs in the order of mean rank, as
// index pairs into that order.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> cliques(const std::vector<double>& sorted_mean_ranks,
                                                                       double critical_difference);

// Upper tail of the chi-squared distribution, and of the standard normal one.
[[nodiscard]] double chi_squared_tail(double value, double degrees);
[[nodiscard]] double normal_tail(double value);
// 5 % point of the studentised range for k groups and infinite degrees of freedom, divided by sqrt(2).
[[nodiscard]] double nemenyi_quantile(std::size_t k);

}  // namespace hysteron

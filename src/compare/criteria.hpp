// What the residuals of a model say: how white they are, how they are distributed, and the information criteria.
//   -2 ln L = n_eff ln(mean square) + const,   AIC = -2 ln L + 2 k,   BIC = -2 ln L + k ln n_eff
//   n_eff = n (1 - r) / (1 + r)
// for k free parameters and residuals of lag-1 correlation r: a coloured residual carries fewer independent samples
// than it has. Sources: Akaike, IEEE Trans. Autom. Control 19 (1974) 716-723; Schwarz, Ann. Stat. 6 (1978) 461-464;
// Bayley, Hammersley, J. R. Stat. Soc. Suppl. 8 (1946) 184-197.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hysteron {

inline constexpr std::size_t residual_lags = 40;
inline constexpr std::size_t histogram_bins = 41;
inline constexpr double histogram_reach = 4.1;  // standard deviations to either side

struct ResidualFacts {
  std::size_t samples = 0;
  double mean_square = 0.0;             // mean over the recordings of each one's
  std::vector<double> autocorrelation;  // at lags 1 .. residual_lags, about zero; 0 where the residual is
  // Within which 95 % of the lags of white noise stay, each recording's noise of its own size:
  //   1.96 sqrt(sum_r (sum r^2)^2 / N_r) / sum_r sum r^2, which is 1.96 / sqrt(N) where all are of one size.
  double white_band = 0.0;
  double outside = 0.0;           // share of these lags beyond it
  std::vector<double> histogram;  // density of residual / its root mean square, histogram_bins of equal width
  double beyond = 0.0;            // share beyond histogram_reach

  [[nodiscard]] double effective_samples() const;
};

// One series a recording, in the same unit (or each normalised); the correlations are pooled over them.
ResidualFacts residual_facts(const std::vector<std::vector<double>>& residuals);

struct Criteria {
  double aic;
  double bic;
};
// Comparable between models only where the recordings and n_eff are the same.
Criteria criteria(double mean_square, double effective_samples, std::size_t parameters);

}  // namespace hysteron

#include "compare/criteria.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {

double ResidualFacts::effective_samples() const {
  // Of a negative correlation no more is made than of white noise.
  const double r = autocorrelation.empty() ? 0.0 : std::clamp(autocorrelation.front(), 0.0, 0.9999);
  return std::max(static_cast<double>(samples) * (1.0 - r) / (1.0 + r), 1.0);
}

ResidualFacts residual_facts(const std::vector<std::vector<double>>& residuals) {
  ResidualFacts result;
  double square = 0.0;
  double fourth = 0.0;  // of white noise of each recording's own size: variance of a sum of neighbours' products
  for (const std::vector<double>& series : residuals) {
    double own = 0.0;
    for (const double value : series) {
      own += value * value;
    }
    square += own;
    fourth += own * own / static_cast<double>(std::max<std::size_t>(series.size(), 1));
    result.samples += series.size();
    if (!series.empty()) {
      result.mean_square += own / static_cast<double>(series.size()) / static_cast<double>(residuals.size());
    }
  }
  result.autocorrelation.assign(residual_lags, 0.0);
  result.histogram.assign(histogram_bins, 0.0);
  if (!(square > 0.0)) {
    return result;
  }
  result.white_band = 1.96 * std::sqrt(fourth) / square;
  std::size_t outside = 0;
  for (std::size_t lag = 1; lag <= residual_lags; ++lag) {
    double product = 0.0;
    for (const std::vector<double>& series : residuals) {
      for (std::size_t n = lag; n < series.size(); ++n) {
        product += series[n] * series[n - lag];
      }
    }
    result.autocorrelation[lag - 1] = product / square;
    outside += std::fabs(product / square) > result.white_band ? 1 : 0;
  }
  result.outside = static_cast<double>(outside) / static_cast<double>(residual_lags);
  const double deviation = std::sqrt(square / static_cast<double>(result.samples));
  const double width = 2.0 * histogram_reach / static_cast<double>(histogram_bins);
  const double one = 1.0 / static_cast<double>(result.samples);
  for (const std::vector<double>& series : residuals) {
    for (const double value : series) {
      const double place = (value / deviation + histogram_reach) / width;
      if (place >= 0.0 && place < static_cast<double>(histogram_bins)) {
        result.histogram[static_cast<std::size_t>(place)] += one / width;
      } else {
        result.beyond += one;
      }
    }
  }
  return result;
}

Criteria criteria(double mean_square, double effective_samples, std::size_t parameters) {
  const double k = static_cast<double>(parameters);
  const double twice = effective_samples * std::log(std::max(mean_square, 1e-300));
  return {twice + 2.0 * k, twice + k * std::log(effective_samples)};
}

}  // namespace hysteron

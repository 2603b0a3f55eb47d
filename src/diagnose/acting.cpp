#include "diagnose/acting.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::fabs(value));
  return result;
}

}  // namespace

std::vector<bool> acting_in(const Workbench& bench, const Fit& fit, const std::string& effect) {
  const std::vector<Recording>& recordings = bench.split().fit;
  std::vector<bool> result(recordings.size(), true);
  if (!contains(fit.what, effect_extension(effect))) {
    return result;
  }
  const std::vector<Residual> with = bench.plain_residuals(fit);
  const std::vector<Residual> without = bench.plain_residuals(bench.less(fit, effect));
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    std::vector<double> change = with[k].force;
    for (std::size_t n = 0; n < change.size(); ++n) change[n] -= without[k].force[n];
    result[k] = largest(change) > 2.0 * bench.options().tolerance * largest(recordings[k].force);
  }
  return result;
}

Seen seen_in(const Contrast& contrast, const std::vector<bool>& acting) {
  Seen result{0, contrast.of_recordings.size()};
  for (const ContrastOfRecording& one : contrast.of_recordings) {
    result.seen += acting[one.recording] && one.value * contrast.value > 0.0 ? 1 : 0;
  }
  return result;
}

}  // namespace hysteron

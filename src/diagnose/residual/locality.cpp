#include "diagnose/residual/locality.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr double acting = 0.02;

}  // namespace

Locality locality_of(const std::vector<Recording>& recordings, const Residuals& with, const Residuals& without,
                     const Residuals& switched_off) {
  Locality result;
  double acted = 0.0;
  double counted = 0.0;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Residual& after = with.of[k];
    const Residual& before = without.of[k];
    const double norm = with.norms[k];
    const double noise = with.noise[k].sigma / norm;
    for (std::size_t n = std::max(after.from, before.from); n < after.force.size(); ++n) {
      counted += 1.0;
      if (std::fabs(switched_off.of[k].force[n] - after.force[n]) > acting * norm) {
        acted += 1.0;
        result.after += squared(after.force[n] / norm);
        result.before += squared(before.force[n] / norm);
        result.noise += noise * noise;
      }
    }
  }
  result.share = counted > 0.0 ? acted / counted : 0.0;
  return result;
}

}  // namespace hysteron

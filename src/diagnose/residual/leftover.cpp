#include "diagnose/residual/leftover.hpp"

#include <cstddef>
#include <utility>

namespace hysteron {

std::vector<Leftover> leftovers_of(const std::vector<Recording>& recordings, const std::vector<Residual>& residuals,
                                   const std::vector<double>& norms) {
  std::vector<Leftover> result;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Residual& residual = residuals[k];
    const auto from = static_cast<std::ptrdiff_t>(residual.from);
    Leftover one;
    one.time.assign(recordings[k].time.begin() + from, recordings[k].time.end());
    for (std::size_t n = residual.from; n < recordings[k].size(); ++n) {
      one.residual.push_back(residual.force[n] / norms[k]);
      one.force.push_back(recordings[k].force[n] + residual.force[n]);
    }
    if (!one.time.empty()) {
      result.push_back(std::move(one));
    }
  }
  return result;
}

}  // namespace hysteron

// Correlation of residuals with their neighbours in time, pooled over recordings.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hysteron {

class NeighbourCorrelation {
 public:
  void add(const std::vector<double>& residual) {
    for (std::size_t n = 0; n < residual.size(); ++n) {
      product_ += n > 0 ? residual[n] * residual[n - 1] : 0.0;
      square_ += residual[n] * residual[n];
    }
  }
  // Negative ones count as none.
  [[nodiscard]] double value() const { return square_ > 0.0 ? std::clamp(product_ / square_, 0.0, 0.9999) : 0.0; }

 private:
  double product_ = 0.0;
  double square_ = 0.0;
};

}  // namespace hysteron

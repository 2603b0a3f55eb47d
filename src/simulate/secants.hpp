// The root of a residual g(u) whose slope is one at least, by secants that are kept within a bracket; lanes that are
// done stay, so that none depends on its company.
#pragma once

#include <limits>

#include "scalar/lanes.hpp"
#include "scalar/math.hpp"

namespace hysteron::detail {

template <class V>
class Secants {
 public:
  struct Residual {
    V g;
    V tolerance;  // below which |g| counts as none
  };

  // A first point; the root is no farther from it than its residual.
  Secants(const V& u, const V& g) : before_(u), g_before_(g), low_(min(u, u - g)), high_(max(u, u - g)) {}

  // The second point.
  void take(const V& u, const Residual& residual) {
    u_ = u;
    residual_ = residual;
    narrow();
  }

  // Asks for residual_at(u) until all lanes are done, the last time at u().
  template <class ResidualAt>
  void close_in(int iterations, const ResidualAt& residual_at) {
    for (int k = 0; k < iterations; ++k) {
      const auto active = abs(residual_.g) > residual_.tolerance;
      if (!any(active)) {
        return;
      }
      const V change = residual_.g - g_before_;
      // Now and then the middle of the bracket.
      const auto steep = abs(change) > V(k % 4 == 3 ? std::numeric_limits<double>::infinity() : 0.0);
      V next = u_ - residual_.g * (u_ - before_) / select(steep, change, V(1.0));
      next = select(steep & (next > low_) & (next < high_), next, V(0.5) * (low_ + high_));
      next = select(active, next, u_);
      before_ = select(active, u_, before_);
      g_before_ = select(active, residual_.g, g_before_);
      const Residual there = residual_at(next);
      u_ = next;
      residual_.g = select(active, there.g, residual_.g);
      residual_.tolerance = select(active, there.tolerance, residual_.tolerance);
      narrow();
    }
  }

  [[nodiscard]] const V& u() const { return u_; }
  [[nodiscard]] const Residual& residual() const { return residual_; }

 private:
  void narrow() {
    low_ = select(residual_.g < V(0.0), max(low_, u_), low_);
    high_ = select(residual_.g > V(0.0), min(high_, u_), high_);
  }

  V before_;
  V g_before_;
  V low_;
  V high_;
  V u_;
  Residual residual_;
};

}  // namespace hysteron::detail

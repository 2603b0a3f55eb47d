#include "respond/settling.hpp"

#include <cmath>
#include <complex>

#include "core/extent.hpp"

namespace hysteron {

Settling settling_of(const MassMotion& motion, int periods, std::size_t samples) {
  const auto last = static_cast<std::size_t>(periods) * samples;
  const double far = peak_of(std::span(motion.displacement).subspan(last - samples, samples));
  const double fast = peak_of(std::span(motion.velocity).subspan(last - samples, samples));
  if (!(far > 0.0) || !(fast > 0.0)) return {0.0, 0.0, 0.0};
  // A decaying oscillation turns the states in this plane and shrinks them, each period by one complex factor.
  const auto state = [&](std::size_t n) {
    return std::complex<double>(motion.displacement[n] / far, motion.velocity[n] / fast);
  };
  const std::complex<double> change = state(last) - state(last - samples);
  Settling result{std::abs(change), std::nullopt, std::nullopt};
  // What the integration leaves of a steady motion has no pace.
  constexpr double rounding = 1e-6;
  if (result.change < rounding) return {result.change, result.change, 0.0};
  if (periods < 2) return result;
  const std::complex<double> before = state(last - samples) - state(last - 2 * samples);
  if (!(std::abs(before) > 0.0)) return {result.change, result.change, 0.0};
  const std::complex<double> factor = change / before;
  if (std::abs(factor) < 1.0) {
    result.left = std::abs(change * factor / (1.0 - factor));
    result.factor = std::abs(factor);
  }
  return result;
}

}  // namespace hysteron

#include "challenge/electric.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron::challenge {
namespace {
constexpr double grid = 1e-4;
}

Field::Field(const Physics& physics, const Drive& drive, double begin, double end) : begin_(begin) {
  const auto points = static_cast<std::size_t>(std::ceil((end - begin) / grid)) + 2;
  values_.reserve(points);
  double coil = drive.at(begin);
  double flux = coil;
  const double rise = physics.coil_rise > 0.0 ? std::exp(-grid / physics.coil_rise) : 0.0;
  const double fall = physics.coil_fall > 0.0 ? std::exp(-grid / physics.coil_fall) : 0.0;
  for (std::size_t k = 0; k < points; ++k) {
    const double t = begin + grid * static_cast<double>(k);
    double command = drive.at(t);
    if (physics.supply != 0.0) {
      command *=
          1.0 + physics.supply * std::sin(2.0 * std::numbers::pi * t / physics.supply_period + physics.supply_phase);
    }
    coil = command + (coil - command) * (command > coil ? rise : fall);
    flux = std::clamp(flux, coil - physics.remanence, coil + physics.remanence);
    const double limit = physics.saturation;
    values_.push_back(
        limit < never ? 2.0 / std::numbers::pi * limit * std::atan(std::numbers::pi * flux / (2.0 * limit)) : flux);
  }
}

double Field::at(double t) const {
  const double place = std::clamp((t - begin_) / grid, 0.0, static_cast<double>(values_.size() - 2));
  const auto k = static_cast<std::size_t>(place);
  return values_[k] + (place - static_cast<double>(k)) * (values_[k + 1] - values_[k]);
}

}  // namespace hysteron::challenge

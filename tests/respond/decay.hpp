// Free decays of a mass on a spring and a dashpot.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/velocity.hpp"

namespace hysteron::testing {

// Of 50 kg on 20 kN/m and 300 N s/m at 500 Hz, from rest at `from` m: after `held` samples at rest there.
struct Decay {
  double from = 0.01;
  std::size_t held = 0;
  std::size_t samples = 2000;
  double zero = 0.0;    // m, of the sensor
  double noise = 2e-6;  // m

  static constexpr double mass = 50.0;
  static constexpr double stiffness = 20000.0;
  static constexpr double damping = 300.0;

  [[nodiscard]] Recording recording() const {
    const double slower = damping / (2.0 * mass);
    const double omega = std::sqrt(stiffness / mass - slower * slower);
    const Stream stream = Stream(7).child(std::to_string(zero));
    Recording result;
    result.file = "decay.csv";
    for (std::size_t n = 0; n < held + samples; ++n) {
      result.time.push_back(static_cast<double>(n) / 500.0);
      const double t = n < held ? 0.0 : static_cast<double>(n - held) / 500.0;
      const double x = from * std::exp(-slower * t) * (std::cos(omega * t) + slower / omega * std::sin(omega * t));
      result.displacement.push_back(x + zero + noise * stream.normal(n));
    }
    result.velocity = derive_velocity(result.time, result.displacement);
    result.derived_acceleration = derive_acceleration(result.time, result.displacement, result.velocity, false);
    return result;
  }
};

}  // namespace hysteron::testing

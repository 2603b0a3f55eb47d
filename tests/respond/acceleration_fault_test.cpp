// An acceleration that is that of the displacement, and six that are not.
#include "respond/acceleration_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/random.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

using Kind = AccelerationFault::Kind;

// Sines of 1 to 6 Hz of a mass on a base that moves in others; `recorded` makes the acceleration of that of the mass
// relative to the base, of that of the base, and of a standard normal number.
Recording moved(const std::function<double(double relative, double base, double normal)>& recorded,
                double noise = 5e-6) {
  const Stream stream(5);
  Recording result;
  for (std::size_t n = 0; n < 4000; ++n) {
    const double t = static_cast<double>(n) / 500.0;
    double x = 0.0;
    double a = 0.0;
    double b = 0.0;
    double of_base = 0.0;
    for (const double omega : {7.0, 19.0, 37.0}) {
      x += 3e-3 * std::sin(omega * t + omega);
      a -= 3e-3 * omega * omega * std::sin(omega * t + omega);
      b += 2e-3 * std::sin(omega * t + 2.0 * omega);
      of_base -= 2e-3 * omega * omega * std::sin(omega * t + 2.0 * omega);
    }
    result.time.push_back(t);
    result.displacement.push_back(0.1 + x + noise * stream.normal(n));
    result.base.push_back(b);
    result.acceleration.push_back(recorded(a, of_base, stream.normal(100000 + n)));
  }
  result.velocity = derive_velocity(result.time, result.displacement);
  return result;
}

TEST(AccelerationOfAMass, IsNoFaultWhereItIsThatOfTheDisplacement) {
  // Accelerometers are noisy; displacements that are differentiated twice are noisier still.
  for (const double noise : {0.0, 5e-6, 1e-4}) {
    EXPECT_FALSE(acceleration_fault_of(moved([](double a, double, double) { return a; }, noise))) << noise;
    EXPECT_FALSE(acceleration_fault_of(moved([](double a, double, double z) { return a + 2.0 * z; }, noise))) << noise;
  }
  Recording none = moved([](double a, double, double) { return a; });
  none.acceleration.clear();
  EXPECT_FALSE(acceleration_fault_of(none));
}

TEST(AccelerationOfAMass, IsToldForWhatItIs) {
  const auto fault = [](const std::function<double(double, double, double)>& recorded) {
    return acceleration_fault_of(moved(recorded)).value_or(AccelerationFault{Kind::foreign, 99.0});
  };
  EXPECT_EQ(fault([](double a, double, double) { return -a; }).kind, Kind::reversed);
  const AccelerationFault in_g = fault([](double a, double, double) { return a / 9.80665; });
  EXPECT_EQ(in_g.kind, Kind::factor);
  EXPECT_NEAR(in_g.size, 1.0 / 9.80665, 1e-3);
  const AccelerationFault upright = fault([](double a, double, double) { return a + 9.80665; });
  EXPECT_EQ(upright.kind, Kind::offset);
  EXPECT_NEAR(upright.size, 9.80665, 0.01);
  EXPECT_EQ(fault([](double a, double b, double) { return a + b; }).kind, Kind::absolute);
  EXPECT_EQ(fault([](double, double b, double) { return b; }).kind, Kind::of_base);
  const AccelerationFault foreign = fault([](double a, double, double z) { return std::fabs(a) + 0.1 * z; });
  EXPECT_EQ(foreign.kind, Kind::foreign);
  EXPECT_LT(std::fabs(foreign.size), 0.5);
}

}  // namespace
}  // namespace hysteron

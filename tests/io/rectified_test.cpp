#include "io/rectified.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/reread.hpp"

namespace hysteron {
namespace {

using testing::said_of;

using Of = std::function<double(double phase)>;

// Ten periods of 200 samples.
Recording recording(const Of& displacement, const Of& force) {
  Recording result;
  for (int n = 0; n < 2000; ++n) {
    const double phase = 0.01 * std::numbers::pi * n + 0.3;
    result.time.push_back(0.005 * n);
    result.displacement.push_back(displacement(phase));
    result.force.push_back(force(phase));
  }
  return result;
}

double sine(double phase) { return 0.02 * std::sin(phase); }
double viscous(double phase) { return 300.0 * std::cos(phase); }
// From one end to the other in straight lines, upwards first.
double ramps(double phase) { return 0.02 * std::acos(std::cos(phase)); }

TEST(Rectified, AForceWithoutItsSign) {
  const Stream noise(4);
  for (const double scatter : {0.0, 3.0}) {
    const auto without = [&](double phase) {
      return std::fabs(viscous(phase) + scatter * noise.normal(static_cast<std::uint64_t>(100.0 * phase)));
    };
    EXPECT_TRUE(force_is_rectified(recording(sine, without))) << scatter;
  }
  // Of a damper that yields: the kinks are steep.
  EXPECT_TRUE(force_is_rectified(
      recording(sine, [](double phase) { return std::fabs(300.0 * std::tanh(4.0 * std::cos(phase - 0.1))); })));
}

TEST(Rectified, AForceOfOneDirectionHasItsSign) {
  EXPECT_FALSE(force_is_rectified(recording(sine, viscous)));
  EXPECT_FALSE(force_is_rectified(recording(sine, [](double phase) { return std::max(viscous(phase), 0.0); })));
  // A spring that is just loaded, and one that is loaded further.
  EXPECT_FALSE(force_is_rectified(recording(sine, [](double phase) { return 300.0 + 300.0 * std::sin(phase); })));
  EXPECT_FALSE(force_is_rectified(recording(sine, [](double phase) { return 100.0 + std::fabs(viscous(phase)); })));
}

TEST(Rectified, ADisplacementWithoutItsSign) {
  const auto without = [](double phase) { return std::fabs(sine(phase)); };
  EXPECT_TRUE(displacement_is_rectified(recording(without, viscous)));
  EXPECT_FALSE(displacement_is_rectified(recording(sine, viscous)));
  // A ramp turns at zero by a kink, and the force with it.
  const auto turning = [](double phase) { return std::sin(phase) > 0.0 ? 300.0 : -300.0; };
  EXPECT_FALSE(displacement_is_rectified(recording(ramps, turning)));
}

TEST(Rectified, IsTold) {
  const auto force =
      said_of(recording(sine, [](double phase) { return std::fabs(viscous(phase)); }), "rectified force");
  ASSERT_EQ(force.size(), 1U);
  EXPECT_EQ(force.front(),
            "the force is never below 0 and turns up by a kink wherever it comes down to it, while the rod goes to and "
            "fro: one without its sign looks so; give it its sign back");
  const auto displacement =
      said_of(recording([](double phase) { return std::fabs(sine(phase)); }, viscous), "rectified displacement");
  EXPECT_EQ(displacement.size(), 1U);
}

}  // namespace
}  // namespace hysteron

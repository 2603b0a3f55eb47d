#include "io/mains_hum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/reread.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

using testing::said_of;

using Of = std::function<double(double t)>;

// 4 s at 500 Hz of 1200 N s/m; `hum` is on the displacement and `vibration` is of the rod.
Recording recording(
    const Of& hum, const Of& vibration = [](double) { return 0.0; }) {
  Recording result;
  Recording rod;
  for (int n = 0; n < 2000; ++n) {
    const double t = 0.002 * n;
    const double x = 0.02 * std::sin(2.0 * std::numbers::pi * t) + vibration(t);
    result.time.push_back(t);
    rod.displacement.push_back(x);
    result.displacement.push_back(x + hum(t));
  }
  result.velocity = derive_velocity(result.time, result.displacement);
  result.force = derive_velocity(result.time, rod.displacement);
  for (double& force : result.force) force *= 1200.0;
  return result;
}
Of tone(double amplitude, double frequency) {
  return [=](double t) { return amplitude * std::sin(2.0 * std::numbers::pi * frequency * t + 0.7); };
}

TEST(MainsHum, IsFoundInADisplacement) {
  for (const double frequency : {50.0, 49.8, 60.1}) {
    const auto hum = mains_hum_of(recording(tone(1e-4, frequency)));
    ASSERT_TRUE(hum) << frequency;
    EXPECT_NEAR(hum->frequency, frequency, 0.05);
    EXPECT_NEAR(hum->amplitude, 1e-4, 2e-6);
    EXPECT_NEAR(hum->share, 0.24, 0.06);
  }
}

TEST(MainsHum, IsNoOtherThing) {
  EXPECT_FALSE(mains_hum_of(recording(tone(1e-5, 50.0))));  // too weak
  EXPECT_FALSE(mains_hum_of(recording(tone(1e-4, 46.0))));
  const Stream noise(9);
  EXPECT_FALSE(
      mains_hum_of(recording([&](double t) { return 1e-4 * noise.normal(static_cast<std::uint64_t>(500.0 * t)); })));
  // A rod that vibrates, and a motion of that frequency.
  EXPECT_FALSE(mains_hum_of(recording([](double) { return 0.0; }, tone(1e-4, 50.0))));
  Recording measured = recording(tone(1e-4, 50.0));
  measured.velocity_measured = true;
  EXPECT_FALSE(mains_hum_of(measured));
}

TEST(MainsHum, IsTold) {
  const auto said = said_of(recording(tone(1e-4, 50.0)), "mains hum");
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said.front().find("a tone of 50 Hz and 0.1 mm runs through the displacement and makes 2"), 0U);
}

}  // namespace
}  // namespace hysteron

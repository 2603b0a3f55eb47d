// A zero of the force that steps: told from what changes slowly, from noise, and from a motion that changes.
#include "diagnose/residual/zero_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <string>

namespace hysteron {
namespace {

constexpr std::size_t samples = 4000;
constexpr double rate = 500.0;
constexpr double stepped_at = 3.1;  // s

struct Left {
  Recording recording;
  Residual residual;
};

// Sines of 20 mm with noise of 2 N; `zero` is what the measured force has besides.
Left left_of(const std::function<double(double t)>& zero, double later_stroke = 1.0) {
  Left result;
  result.recording.file = "r1.csv";
  std::mt19937_64 bits(7);
  std::normal_distribution<double> noise(0.0, 2.0);
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = static_cast<double>(n) / rate;
    const double stroke = 0.02 * (t < stepped_at ? 1.0 : later_stroke);
    const double omega = 2.0 * std::numbers::pi * 1.3;
    result.recording.time.push_back(t);
    result.recording.displacement.push_back(stroke * std::sin(omega * t));
    result.recording.velocity.push_back(stroke * omega * std::cos(omega * t));
    result.recording.drive.push_back(0.5);
    result.residual.force.push_back(noise(bits) - zero(t));
  }
  return result;
}
double stepped(double t) { return t < stepped_at ? 0.0 : 30.0; }

TEST(ZeroStep, IsFoundWithItsTimeAndSize) {
  const Left left = left_of(stepped);
  const std::optional<ZeroStep> found = zero_step_of(left.recording, left.residual);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->time, stepped_at, 0.01);
  EXPECT_NEAR(found->step, 30.0, 0.3);
  EXPECT_GT(found->share, 0.95);
  const Left none = left_of([](double) { return 0.0; });
  const auto steps = zero_steps_of({none.recording, left.recording}, {none.residual, left.residual});
  ASSERT_TRUE(steps);
  EXPECT_FALSE(shape_the_search(*steps));
  EXPECT_NE(sentence_of(*steps).find("N at 3.1 s of r1.csv (1 of 2 recordings has such a step)"), std::string::npos)
      << sentence_of(*steps);
  const auto most = zero_steps_of({left.recording}, {left.residual});
  ASSERT_TRUE(most);
  EXPECT_TRUE(shape_the_search(*most));
  EXPECT_FALSE(zero_steps_of({none.recording}, {none.residual}));
}

TEST(ZeroStep, IsNoneOfNoiseAndOfOtherCourses) {
  std::mt19937_64 bits(11);
  std::normal_distribution<double> noise(0.0, 0.5);
  double walked = 0.0;
  const std::vector<std::function<double(double)>> courses = {
      [](double) { return 0.0; },
      [](double t) { return 5.0 * t; },
      [](double t) { return 40.0 * std::exp(-t / 0.8); },
      [](double t) { return 20.0 * std::sin(2.0 * std::numbers::pi * 0.17 * t); },
      [](double t) { return t > 4.0 && t < 4.4 ? 80.0 : 0.0; },
      [&](double) { return walked += noise(bits); },
  };
  for (std::size_t k = 0; k < courses.size(); ++k) {
    const Left left = left_of(courses[k]);
    EXPECT_FALSE(zero_step_of(left.recording, left.residual)) << k;
  }
}

// Physics that follows the stroke steps with it, as does what follows the drive.
TEST(ZeroStep, IsNoneWhereTheMotionOrItsDriveChanges) {
  const Left stroke = left_of(stepped, 0.4);
  EXPECT_FALSE(zero_step_of(stroke.recording, stroke.residual));
  Left drive = left_of(stepped);
  for (std::size_t n = 0; n < samples; ++n) {
    if (drive.recording.time[n] >= stepped_at) drive.recording.drive[n] = 1.0;
  }
  EXPECT_FALSE(zero_step_of(drive.recording, drive.residual));
}

}  // namespace
}  // namespace hysteron

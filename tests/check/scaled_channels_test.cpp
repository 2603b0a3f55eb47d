#include "check/scaled_channels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"

namespace hysteron {
namespace {

// How a test was made and what became of its channels in the file.
struct Test {
  double stroke = 0.02;       // m
  double displacement = 1.0;  // factors of the numbers in the file
  double force = 1.0;
  double sensors = 1.0;  // factor of the noise of both
  double setting = 1.0;  // factor of the force that the damper has
};

Recording recording(std::size_t number, const Test& test) {
  const Stream noise(number);
  Recording result;
  result.file = std::string(1, static_cast<char>('a' + number));
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const double phase = 0.01 * std::numbers::pi * static_cast<double>(n);
    const double speed = 0.5 * test.stroke * 2.0 * std::numbers::pi * std::cos(phase);
    result.time.push_back(0.005 * static_cast<double>(n));
    result.displacement.push_back(test.displacement *
                                  (0.5 * test.stroke * std::sin(phase) + test.sensors * 1e-5 * noise.normal(n)));
    result.velocity.push_back(test.displacement * speed);
    result.force.push_back(test.force * (test.setting * (300.0 * std::tanh(100.0 * speed) + 5e3 * speed) +
                                         test.sensors * noise.normal(5000 + n)));
  }
  return result;
}

std::vector<std::string> said_of(const std::vector<Test>& tests) {
  std::vector<Recording> recordings;
  recordings.reserve(tests.size());
  for (const Test& test : tests) recordings.push_back(recording(recordings.size(), test));
  std::vector<std::string> lines;
  for (const Remark& remark : remarks_on_scaled_channels(recordings)) {
    lines.push_back(remark.file + ": " + remark.text.plain());
  }
  return lines;
}

// Tests of 10, 20 and 40 mm, and one more.
std::vector<std::string> said_beside(const Test& test) {
  return said_of({{.stroke = 0.01}, {.stroke = 0.02}, {.stroke = 0.04}, test});
}

using Lines = std::vector<std::string>;

TEST(ScaledChannels, ADisplacementOrAForceInAnotherUnit) {
  const Lines said = said_beside({.displacement = 10.0});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_TRUE(said[0].starts_with("d: a stroke of 200 mm with a noise of 0.1")) << said[0];
  EXPECT_TRUE(
      said[0].ends_with("in the other recordings, whose noise does not follow the stroke: both about 10 times "
                        "too large, as in another unit; check that of the displacement"))
      << said[0];
  for (const double factor : {0.01, 1.0 / 25.4, 0.1, 25.4, 100.0}) {
    EXPECT_EQ(said_beside({.displacement = factor}).size(), 1U) << factor;
  }
  for (const double factor : {0.01, 0.1, 10.0, 100.0}) {
    const Lines of_force = said_beside({.force = factor});
    ASSERT_EQ(of_force.size(), 1U) << factor;
    EXPECT_TRUE(of_force[0].ends_with("check that of the force")) << of_force[0];
  }
}

TEST(ScaledChannels, AnotherTestAndAnotherSettingAreWhatTheyAre) {
  for (const double stroke : {0.0002, 0.001, 0.002, 0.2, 0.4}) EXPECT_EQ(said_beside({.stroke = stroke}), Lines{});
  for (const double setting : {0.01, 0.1, 10.0, 100.0}) EXPECT_EQ(said_beside({.setting = setting}), Lines{});
  for (const double sensors : {0.1, 10.0}) EXPECT_EQ(said_beside({.sensors = sensors}), Lines{});
  // Noise that follows the stroke in all of them, as where it was made so.
  EXPECT_EQ(said_of({{.stroke = 0.01, .sensors = 0.5},
                     {.stroke = 0.02},
                     {.stroke = 0.04, .sensors = 2.0},
                     {.displacement = 10.0}}),
            Lines{});
  // Of strokes that are alike nothing tells whether it does, and of three recordings not which is the odd one.
  EXPECT_EQ(said_of({{}, {}, {}, {.displacement = 10.0}}), Lines{});
  EXPECT_EQ(said_of({{.stroke = 0.01}, {.stroke = 0.04}, {.displacement = 10.0}}), Lines{});
}

}  // namespace
}  // namespace hysteron

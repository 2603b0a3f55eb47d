#include "io/straight_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/csv.hpp"

namespace hysteron {
namespace {

using Motion = std::function<double(double time)>;

double sine(double t) { return 10.0 * std::sin(3.7 * std::numbers::pi * t); }

// Three seconds of 1 kHz, of a motion that is known at every `length`-th sample, from `first` on, and by straight lines
// in between.
std::vector<double> interpolated(const Motion& motion, double length, double first = 0.0) {
  std::vector<double> values;
  for (int n = 0; n < 3000; ++n) {
    const double k = std::floor((n - first) / length);
    const double left = motion(1e-3 * (first + k * length));
    const double right = motion(1e-3 * (first + (k + 1.0) * length));
    values.push_back(std::lerp(left, right, (n - first) / length - k));
  }
  return values;
}

std::vector<double> rounded(std::vector<double> values, double step) {
  for (double& value : values) value = step * std::round(value / step);
  return values;
}

TEST(StraightPieces, OfASlowerSensorThatWasInterpolated) {
  for (const std::size_t length : {2U, 3U, 4U, 5U, 10U, 20U, 50U}) {
    const auto of = static_cast<double>(length);
    EXPECT_EQ(straight_pieces_of(interpolated(sine, of)), length);
    EXPECT_EQ(straight_pieces_of(rounded(interpolated(sine, of), 1e-5)), length);
    // The sensor's clock ticks between the samples.
    if (length < 4) continue;
    EXPECT_EQ(straight_pieces_of(interpolated(sine, of, 0.4)), length);
  }
  // With the noise of the sensor, which the lines join.
  const Stream noise(5);
  const Motion noisy = [&](double t) {
    return sine(t) + 0.02 * noise.normal(static_cast<std::uint64_t>(std::lround(1e3 * t) + 1000));
  };
  EXPECT_EQ(straight_pieces_of(rounded(interpolated(noisy, 10.0), 1e-4)), 10U);
}

TEST(StraightPieces, AMotionThatIsSmoothOrNoisyHasNone) {
  const Stream noise(6);
  std::vector<double> noisy = interpolated(sine, 1.0);
  EXPECT_EQ(straight_pieces_of(noisy), std::nullopt);
  for (std::size_t n = 0; n < noisy.size(); ++n) noisy[n] += 0.01 * noise.normal(n);
  EXPECT_EQ(straight_pieces_of(noisy), std::nullopt);
}

TEST(StraightPieces, HeldSamplesHaveNone) {
  for (const int length : {2, 3, 10}) {
    std::vector<double> held(3000);
    for (int n = 0; n < 3000; ++n) held[static_cast<std::size_t>(n)] = sine(1e-3 * (n - n % length));
    EXPECT_EQ(straight_pieces_of(held), std::nullopt) << length;
  }
}

TEST(StraightPieces, StepsOfAConverterHaveNone) {
  const Motion ramp = [](double t) { return 8.0 * t; };
  for (const double step : {1e-4, 1e-3, 0.01, 0.03, 0.08, 0.1, 0.5, 2.0}) {
    for (const Motion& motion : {Motion(sine), ramp}) {
      EXPECT_EQ(straight_pieces_of(rounded(interpolated(motion, 1.0), step)), std::nullopt) << step;
    }
  }
}

TEST(StraightPieces, TrianglesAndHeldRodsHaveNone) {
  for (const double period : {0.04, 0.1, 0.25, 1.0}) {
    const Motion triangle = [&](double t) {
      return 10.0 * std::fabs(2.0 * (t / period - std::floor(t / period + 0.5)));
    };
    const Motion trapezoid = [&](double t) { return std::clamp(2.0 * triangle(t), 5.0, 15.0); };
    // Ramps and holds of one duration, up and down.
    const Motion programme = [&](double t) {
      const double at = std::fabs(3.0 * std::fmod(t, 1.0) - 1.5) / period;
      return std::floor(at) + std::max(0.0, 2.0 * (at - std::floor(at)) - 1.0);
    };
    for (const Motion& motion : {triangle, trapezoid, programme}) {
      for (const double step : {0.0, 1e-5, 1e-3, 0.02}) {
        const std::vector<double> values = interpolated(motion, 1.0);
        EXPECT_EQ(straight_pieces_of(step > 0.0 ? rounded(values, step) : values), std::nullopt)
            << period << " s in steps of " << step;
      }
    }
  }
  EXPECT_EQ(straight_pieces_of(std::vector<double>(3000, 5.0)), std::nullopt);
}

TEST(StraightPieces, AreTold) {
  const std::vector<double> x = interpolated(sine, 10.0);
  std::string text = "time [s],displacement [mm],force [N]\n";
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double t = 1e-3 * static_cast<double>(n);
    text += std::to_string(t) + "," + std::to_string(x[n]) + "," +
            std::to_string(800.0 * std::cos(4.0 * std::numbers::pi * t)) + "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text, "a.csv", options);
  EXPECT_EQ(said, (std::vector<std::string>{
                      "the displacement goes in straight lines of 10 samples each: a channel of 100 Hz that was "
                      "interpolated to 1000 Hz looks so, and its slope goes in steps; record it at 1000 Hz, or keep "
                      "one sample in 10 of all channels"}));
}

}  // namespace
}  // namespace hysteron

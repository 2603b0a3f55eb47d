#include "diagnose/residual/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "diagnose/residual/conditions.hpp"

namespace hysteron {
namespace {

constexpr std::size_t samples = 400;

Recording sine(double amplitude, double frequency, double drive = 0.0) {
  Recording result;
  const double w = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = 4.0 / frequency * static_cast<double>(n) / static_cast<double>(samples);
    result.time.push_back(t);
    result.displacement.push_back(amplitude * std::sin(w * t));
    result.velocity.push_back(amplitude * w * std::cos(w * t));
    result.force.push_back(0.0);
    result.drive.push_back(drive);
  }
  return result;
}

// Parts that are whole recordings.
std::vector<SizeOfPart> by_recording(std::span<const SizeOfPart> parts) {
  std::vector<SizeOfPart> result;
  for (const SizeOfPart& part : parts) {
    if (result.empty() || result.back().recording != part.recording) {
      result.push_back({part.recording, 0, 0.0, 0.0});
    }
    SizeOfPart& whole = result.back();
    whole.size = (whole.size * whole.weight + part.size * part.weight) / (whole.weight + part.weight);
    whole.weight += part.weight;
  }
  return result;
}

using Forces = std::vector<std::vector<double>>;

// A force of each sample of each recording.
template <class Shape>
Forces left(const std::vector<Recording>& recordings, Shape shape) {
  Forces result;
  for (const Recording& one : recordings) {
    std::vector<double>& force = result.emplace_back();
    for (std::size_t n = 0; n < one.size(); ++n) {
      force.push_back(shape(one, n));
    }
  }
  return result;
}

TEST(Sizes, AreOneEverywhereOfWhatIsThere) {
  const std::vector<Recording> recordings = {sine(0.01, 1.0), sine(0.02, 1.0), sine(0.01, 3.0)};
  const Forces without = left(recordings, [](const Recording& of, std::size_t n) { return 50.0 * of.velocity[n]; });
  const Forces with = left(recordings, [](const Recording&, std::size_t) { return 0.0; });
  const std::vector<SizeOfPart> parts = sizes_of_parts(recordings, without, with);
  ASSERT_EQ(parts.size(), 12U);
  for (const SizeOfPart& part : parts) {
    EXPECT_NEAR(part.size, 1.0, 1e-12);
  }
  EXPECT_NEAR(evenness_of(parts), 1.0, 1e-12);
}

TEST(Sizes, AreUnevenOfWhatCoversForAnother) {
  // Viscous damping fitted to a cubic one: least squares over all give one size, each recording another.
  const std::vector<Recording> recordings = {sine(0.01, 1.0), sine(0.02, 1.0), sine(0.01, 3.0)};
  const Forces without =
      left(recordings, [](const Recording& of, std::size_t n) { return std::pow(of.velocity[n], 3); });
  double vv = 0.0;
  double vf = 0.0;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    for (std::size_t n = 0; n < samples; ++n) {
      vv += std::pow(recordings[r].velocity[n], 2);
      vf += recordings[r].velocity[n] * without[r][n];
    }
  }
  const Forces with = left(recordings, [&](const Recording& of, std::size_t n) {
    return std::pow(of.velocity[n], 3) - vf / vv * of.velocity[n];
  });
  const std::vector<SizeOfPart> recorded = by_recording(sizes_of_parts(recordings, without, with));
  ASSERT_EQ(recorded.size(), 3U);
  double sum = 0.0;
  double weights = 0.0;
  for (const SizeOfPart& part : recorded) {
    sum += part.weight * part.size;
    weights += part.weight;
  }
  EXPECT_NEAR(sum / weights, 1.0, 1e-9);  // least squares
  // The cube of a sine is to the sine as three quarters of its peak squared.
  EXPECT_NEAR(recorded[1].size / recorded[0].size, 4.0, 1e-6);
  EXPECT_NEAR(recorded[2].size / recorded[0].size, 9.0, 1e-6);
  EXPECT_NEAR(
      evenness_of(recorded),
      [&] {
        // Weights 1, 4, 9 of sizes 1, 4, 9.
        return std::pow(1.0 + 16.0 + 81.0, 2) / (14.0 * (1.0 + 64.0 + 729.0));
      }(),
      1e-6);
}

TEST(Sizes, AreUnevenWithinTheCycleOfOneMotion) {
  // A spring fitted to a spring that acts above the middle only.
  const std::vector<Recording> recordings = {sine(0.01, 1.0), sine(0.01, 1.0, 1.0)};
  const Forces without =
      left(recordings, [](const Recording& of, std::size_t n) { return std::max(of.displacement[n], 0.0); });
  const Forces with = left(recordings, [](const Recording& of, std::size_t n) {
    return std::max(of.displacement[n], 0.0) - 0.5 * of.displacement[n];
  });
  const std::vector<SizeOfPart> parts = sizes_of_parts(recordings, without, with);
  EXPECT_NEAR(evenness_of(parts), 0.5, 1e-9);
  EXPECT_NEAR(evenness_of(by_recording(parts)), 1.0, 1e-9);
}

TEST(Sizes, OfNothingAreNotEven) {
  EXPECT_EQ(evenness_of({}), 0.0);
  const std::vector<SizeOfPart> opposed = {{0, 0, -1.0, 2.0}, {1, 0, 1.0, 1.0}};
  EXPECT_EQ(evenness_of(opposed), 0.0);
}

TEST(Motions, DifferByStrokeFrequencyAndForm) {
  Recording triangle = sine(0.01, 1.0);
  for (double& x : triangle.displacement) {
    x = 0.01 * 2.0 / std::numbers::pi * std::asin(std::clamp(x / 0.01, -1.0, 1.0));
  }
  for (double& v : triangle.velocity) {
    v = std::copysign(0.04, v);
  }
  const std::vector<std::size_t> motions =
      motions_of({sine(0.01, 1.0, 0.0), sine(0.01, 1.0, 2.0), sine(0.012, 1.0, 0.0), sine(0.01, 2.0, 0.0), triangle,
                  sine(0.0101, 1.01, 1.0)});
  EXPECT_EQ(motions, (std::vector<std::size_t>{0, 0, 1, 2, 3, 0}));
}

}  // namespace
}  // namespace hysteron

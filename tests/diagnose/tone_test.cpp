// A tone at one frequency in all recordings is told from noise of any colour and from what follows the motion.
#include "diagnose/residual/tone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "core/random.hpp"
#include "diagnose/concealed_damper.hpp"
#include "diagnose/doubts.hpp"

namespace hysteron {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// Four sines of 6 to 9 s at 400 Hz, their forces those of a yielding damper; what is left of `which` at a time with the
// force there, beside coloured noise of variance 1.
std::vector<Leftover> leftovers(const std::function<double(std::size_t which, double time, double force)>& left,
                                double colour, std::uint64_t seed = 5) {
  std::vector<Leftover> result;
  const Stream stream = Stream(seed).child("noise");
  std::uint64_t drawn = 0;
  for (const double frequency : {0.7, 1.6, 3.1, 2.2}) {
    Leftover one;
    double noise = 0.0;
    const auto size = 2400 + 400 * result.size();
    for (std::size_t n = 0; n < size; ++n) {
      const double t = static_cast<double>(n) / 400.0;
      const double v = std::sin(two_pi * frequency * t);
      const double force = std::tanh(8.0 * v) + 0.3 * v;
      noise = colour * noise + std::sqrt(1.0 - colour * colour) * stream.normal(drawn++);
      one.time.push_back(t);
      one.force.push_back(1000.0 * force);
      one.residual.push_back(left(result.size(), t, force) + noise);
    }
    result.push_back(std::move(one));
  }
  return result;
}

TEST(Tone, IsFoundWithFrequencyAmplitudeAndShare) {
  for (const double colour : {0.0, 0.9}) {
    for (const double frequency : {5.3, 23.7, 49.9, 121.0}) {
      const auto tone =
          tone_of(leftovers([&](std::size_t which, double t,
                                double) { return 1.5 * std::sin(two_pi * frequency * t + static_cast<double>(which)); },
                            colour));
      ASSERT_TRUE(tone) << frequency << " Hz in noise of colour " << colour;
      EXPECT_NEAR(tone->frequency, frequency, 0.1);
      // Noise adds its part at that frequency, more the lower that is.
      EXPECT_NEAR(tone->amplitude, 1.5, frequency < 10.0 ? 0.4 : 0.15);
      EXPECT_NEAR(tone->share, 0.5 * 1.5 * 1.5 / (1.0 + 0.5 * 1.5 * 1.5), 0.1);
      EXPECT_EQ(tone->recordings, 4U);
    }
  }
}

// Chance: each draw is expected to give 1e-6.
TEST(Tone, NoiseOfAnyColourHoldsNone) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (const double colour : {0.0, 0.9, -0.7, 0.99}) {
      EXPECT_FALSE(tone_of(leftovers([](std::size_t, double, double) { return 0.0; }, colour, seed)))
          << colour << ' ' << seed;
    }
  }
}

TEST(Tone, WhatFollowsTheMotionIsNone) {
  EXPECT_FALSE(tone_of(leftovers([](std::size_t, double, double force) { return 3.0 * force * force * force; }, 0.5)));
}

// One loud recording, or each its own frequency, is no tone that runs through all.
TEST(Tone, MustBeInMostRecordingsAtOneFrequency) {
  EXPECT_FALSE(tone_of(leftovers(
      [](std::size_t which, double t, double) { return which < 2 ? 5.0 * std::sin(two_pi * 23.7 * t) : 0.0; }, 0.0)));
  EXPECT_FALSE(
      tone_of(leftovers([](std::size_t which, double t,
                           double) { return 2.0 * std::sin(two_pi * (20.0 + 3.0 * static_cast<double>(which)) * t); },
                        0.0)));
}

TEST(Tone, OfOneRecordingIsASineByLeastSquares) {
  const auto tone = [](std::size_t which, double t, double) {
    return 1.5 * std::sin(two_pi * 49.93 * t + static_cast<double>(which));
  };
  const std::vector<Leftover> with = leftovers(tone, 0.5);
  const auto told = tone_of(with);
  ASSERT_TRUE(told);
  for (std::size_t which = 0; which < with.size(); ++which) {
    const auto sine = sine_of(with[which], told->frequency);
    ASSERT_TRUE(sine);
    EXPECT_NEAR(sine->frequency, 49.93, 0.01);
    for (const double t : {0.1, 2.0, 5.9}) EXPECT_NEAR(sine->at(t), tone(which, t, 0.0), 0.25) << which << " " << t;
  }
  const std::vector<Leftover> of_the_motion =
      leftovers([](std::size_t, double, double force) { return 3.0 * force * force * force; }, 0.0);
  EXPECT_FALSE(sine_of(of_the_motion.front(), 3.0 * 0.7)) << "the third harmonic of the motion";
}

// A tone of its own phase in every recording, of so much of the largest force.
Campaign with_hum(Campaign campaign, double part) {
  double largest = 0.0;
  double sampling = 1e300;
  for (const Recording& recording : campaign.recordings) {
    sampling = std::min(sampling, static_cast<double>(recording.size()) / recording.time.back());
    for (const double force : recording.force) {
      largest = std::max(largest, std::fabs(force));
    }
  }
  double phase = 0.5;
  for (Recording& recording : campaign.recordings) {
    phase += 1.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.force[n] += part * largest * std::sin(two_pi * 0.2137 * sampling * recording.time[n] + phase);
    }
  }
  return campaign;
}

bool says(const std::vector<std::string>& texts, std::string_view words) {
  return std::ranges::any_of(texts, [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

TEST(Tone, IsTheReasonWhyNothingIsCalledComplete) {
  const Campaign quiet = testing::campaign_with({}, {}, 0.01);
  const auto diagnosis = testing::diagnosis_of(with_hum(quiet, 0.03), testing::few);
  EXPECT_EQ(diagnosis->verdict.answer, Answer::unattributed);
  ASSERT_TRUE(diagnosis->tone);
  EXPECT_EQ(diagnosis->verdict.reason.find(sentence_of(*diagnosis->tone)), 0U) << diagnosis->verdict.reason;
  EXPECT_TRUE(says(diagnosis->notes, " was taken out of the force before effects were looked for"));
  EXPECT_TRUE(says(diagnosis->summary, "Without the tone only noise is left."));
  const auto without = testing::diagnosis_of(quiet, testing::few);
  EXPECT_NEAR(diagnosis->search.base.cost, without->search.base.cost, 0.02 * without->search.base.cost);
}

// What is smaller than the hum is found beside it as without it.
TEST(Tone, HidesNoEffect) {
  const Campaign quiet = testing::campaign_with({"inertia"}, {{"inertia.m", 8.0}}, 0.01);
  const auto without = testing::diagnosis_of(quiet, testing::few);
  const auto with = testing::diagnosis_of(with_hum(quiet, 0.1), testing::few);
  ASSERT_EQ(without->verdict.effects.size(), 1U);
  ASSERT_EQ(with->verdict.effects.size(), 1U);
  EXPECT_EQ(with->verdict.effects.front().id, "inertia");
  EXPECT_NEAR(with->verdict.effects.front().confidence, without->verdict.effects.front().confidence, 0.01);
  EXPECT_NEAR(with->search.augmented.cost, without->search.augmented.cost, 0.02 * without->search.augmented.cost);
  EXPECT_TRUE(says(with->notes, " was taken out of the force before effects were looked for"));
}

}  // namespace
}  // namespace hysteron

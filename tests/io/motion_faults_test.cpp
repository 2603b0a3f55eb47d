#include "io/motion_faults.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>

#include "core/random.hpp"
#include "io/csv.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

constexpr double omega = 4.0 * std::numbers::pi;

// Three seconds of 10 mm at 2 Hz, 500 samples a second, recorded by the channels given, each of the time and the
// sample.
using Channel = std::function<double(double time, int sample)>;
double at(double t) { return 0.01 * std::sin(omega * t); }
double speed(double t) { return 0.01 * omega * std::cos(omega * t); }
double force(double t) { return 2000.0 * speed(t) + 5000.0 * at(t); }

std::vector<std::string> remarks(
    const Channel& x, const Channel& v, const Channel& f,
    const std::function<double(int sample)>& time = [](int n) { return 0.002 * n; }) {
  std::ostringstream text;
  text.precision(12);
  text << "time [s],displacement [m],velocity [m/s],force [N]\n";
  for (int n = 0; n <= 1500; ++n) {
    const double t = time(n);
    text << t << "," << x(t, n) << "," << v(t, n) << "," << f(t, n) << "\n";
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  (void)parse_csv(text.str(), "a.csv", options);
  return said;
}

const Channel true_x = [](double t, int) { return at(t); };
const Channel true_v = [](double t, int) { return speed(t); };
const Channel true_f = [](double t, int) { return force(t); };

void expect_one(const std::vector<std::string>& said, const std::string& beginning) {
  ASSERT_EQ(said.size(), 1U) << beginning;
  EXPECT_TRUE(said[0].starts_with(beginning)) << said[0];
}

TEST(MotionFaults, NothingIsSaidOfSoundChannels) {
  EXPECT_TRUE(remarks(true_x, true_v, true_f).empty());
  const Stream noise(3);
  const auto said =
      remarks([&](double t, int n) { return at(t) + 2e-5 * noise.normal(static_cast<std::uint64_t>(n)); },
              [&](double t, int n) { return speed(t) + 2e-3 * noise.normal(5000 + static_cast<std::uint64_t>(n)); },
              [&](double t, int n) { return force(t) + 5.0 * noise.normal(9000 + static_cast<std::uint64_t>(n)); });
  EXPECT_TRUE(said.empty()) << said[0];
}

TEST(MotionFaults, AVelocityThatIsLate) {
  expect_one(remarks(
                 true_x, [](double t, int) { return speed(t - 0.015); }, true_f),
             "the velocity is behind the slope of the displacement by 15 ms: a phase of 11 degrees");
  expect_one(remarks(
                 true_x, [](double t, int) { return speed(t + 0.015); }, true_f),
             "the velocity is ahead of the slope of the displacement by 15 ms");
  EXPECT_TRUE(remarks(
                  true_x, [](double t, int) { return speed(t - 0.003); }, true_f)
                  .empty())
      << "two degrees";
}

TEST(MotionFaults, AVelocityThatIsOff) {
  expect_one(remarks(
                 true_x, [](double t, int) { return speed(t) + 0.04; }, true_f),
             "the velocity is 0.04 m/s off what displacement and time tell on average, 32 % of its largest");
  const Stream noise(4);
  const auto noisy = [&](double off) {
    return
        [&noise, off](double t, int n) { return speed(t) + off + 2e-3 * noise.normal(static_cast<std::uint64_t>(n)); };
  };
  // A hundredth is 1.26 mm/s, and the noise of the mean 0.05 mm/s.
  expect_one(remarks(true_x, noisy(-0.004), true_f), "the velocity is -0.00");
  EXPECT_TRUE(remarks(true_x, noisy(0.001), true_f).empty());
  // Of one that is late, or of a gain that is not told either, nothing is.
  EXPECT_TRUE(remarks(
                  true_x, [](double t, int) { return 1.1 * speed(t - 0.004); }, true_f)
                  .empty());
  const Channel ramp = [](double t, int) { return 0.02 * t + 0.001 * std::sin(omega * t); };
  const Channel of_ramp = [](double t, int) { return 1.08 * (0.02 + 0.001 * omega * std::cos(omega * t)); };
  EXPECT_TRUE(remarks(ramp, of_ramp, true_f).empty());
}

TEST(MotionFaults, AVelocityThatIsZero) {
  expect_one(remarks(
                 true_x, [](double, int) { return 0.0; }, true_f),
             "the velocity is 0 throughout while the displacement moves: it is taken from the displacement instead");
}

TEST(MotionFaults, AVelocityThatIsOneNumberWhileTheRodGoesToAndFro) {
  for (const double set : {0.1, -0.1}) {
    expect_one(remarks(
                   true_x, [&](double, int) { return set; }, true_f),
               set > 0.0 ? "the velocity is 0.1 m/s throughout while the displacement goes to and fro: a speed that "
                           "was set looks so; it is taken from the displacement instead"
                         : "the velocity is -0.1 m/s throughout");
  }
  // Of a ramp it may be the velocity.
  const Channel ramp = [](double t, int) { return 0.01 * t; };
  const Channel steady = [](double, int) { return 0.01; };
  EXPECT_TRUE(remarks(ramp, steady, true_f).empty());
}

TEST(MotionFaults, AForceThatIsCutOffIsNoSlowSensor) {
  const Stream noise(4);
  for (const double limit : {75.0, 125.0, 175.0}) {
    for (const double hiss : {0.0, 1.0}) {
      const auto said = remarks(true_x, true_v, [&](double t, int n) {
        return std::clamp(force(t) + hiss * noise.normal(static_cast<std::uint64_t>(n)), -limit, limit);
      });
      for (const std::string& text : said) EXPECT_EQ(text.find("slower than the log"), std::string::npos) << text;
      if (hiss > 0.0) {
        expect_one(said, "the force stays at exactly ");
      }
    }
  }
  // Nor is one that rests for a while between its strokes.
  std::vector<double> strokes;
  for (int n = 0; n < 3000; ++n)
    strokes.push_back(n % 300 < 200 ? std::sin(0.01 * std::numbers::pi * n) + 1e-6 * n : n / 300);
  EXPECT_FALSE(held_samples_of(strokes).has_value());
}

TEST(MotionFaults, AChannelSlowerThanTheLog) {
  expect_one(remarks(true_x, true_v, [](double, int n) { return force(0.002 * (n / 10 * 10)); }),
             "the force holds each value for 10 samples: a sensor slower than the log looks so, and is 9 ms late");
  // Five of its samples to twelve of the log's.
  expect_one(remarks(true_x, true_v, [](double, int n) { return force(0.0048 * std::floor(n / 2.4)); }),
             "the force holds each value for 2.4 samples");
  // The steps of a converter, of a sine and of a straight line.
  EXPECT_FALSE(held_samples_of({}).has_value());
  for (const double step : {20.0, 80.0}) {
    const auto said = remarks(true_x, true_v, [&](double t, int) { return step * std::round(force(t) / step); });
    EXPECT_TRUE(said.empty()) << said[0];
  }
  std::vector<double> line;
  for (int n = 0; n < 2000; ++n) {
    line.push_back(0.1 * std::floor(n / 7.0));
  }
  EXPECT_FALSE(held_samples_of(line).has_value());
}

// What is said of the damping is what a regression on the noisy velocity loses.
TEST(MotionFaults, NoiseThatMakesADampingSmall) {
  for (const bool recorded : {true, false}) {
    for (const double size : {0.02, 0.1, 0.2, 0.4}) {
      const Stream noise(11);
      Recording recording;
      recording.velocity_measured = recorded;
      for (int n = 0; n <= 6000; ++n) {
        const auto k = static_cast<std::uint64_t>(n);
        const double t = 0.002 * n;
        recording.time.push_back(t);
        recording.displacement.push_back(at(t) + (recorded ? 0.0 : 0.02 * size * noise.normal(k)));
        recording.velocity.push_back(speed(t) + 0.01 * omega * size * noise.normal(k));
      }
      if (!recorded) recording.velocity = derive_velocity(recording.time, recording.displacement);
      double with_force = 0.0;
      double squares = 0.0;
      for (std::size_t n = 0; n < recording.size(); ++n) {
        with_force += recording.velocity[n] * speed(recording.time[n]);
        squares += recording.velocity[n] * recording.velocity[n];
      }
      const double lost = 1.0 - with_force / squares;
      EXPECT_NEAR(noise_share_of_velocity(recording), lost, 0.1 * lost + 3e-3) << recorded << " " << size;
    }
  }
  const Stream noise(3);
  expect_one(remarks(
                 true_x, [&](double t, int n) { return speed(t) + 0.02 * noise.normal(static_cast<std::uint64_t>(n)); },
                 true_f),
             "23 % of the velocity is noise (RMS): a damping comes out about 5.4 % too small");
}

TEST(MotionFaults, LostSamples) {
  // Sixty samples are gone and the times go on.
  const auto skip = [](int n) { return 0.002 * (n < 700 ? n : n + 60); };
  const auto said = remarks([&](double, int n) { return at(skip(n)); }, [&](double, int n) { return speed(skip(n)); },
                            [&](double, int n) { return force(skip(n)); });
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(said[0].starts_with("the displacement leaps by 12.1 mm between 1.398 and 1.4 s")) << said[0];
  // Where the times have the gap, it is no leap.
  for (const std::string& text : remarks(true_x, true_v, true_f, skip)) {
    EXPECT_FALSE(text.starts_with("the displacement leaps")) << text;
  }
}

// A position on a counter that begins again at either end of its range.
double on_counter(double x, double low, double range) { return x - range * std::floor((x - low) / range); }

TEST(MotionFaults, ACounterThatOverflows) {
  // 11 mm to and fro on a counter of 20 mm.
  const auto said = remarks([](double t, int) { return on_counter(1.1 * at(t), -0.01, 0.02); },
                            [](double t, int) { return 1.1 * speed(t); }, true_f);
  ASSERT_FALSE(said.empty());
  const auto told = std::ranges::find_if(said, [](const std::string& text) {
    return text.starts_with("the displacement jumps from 9.953 to -9.932 mm behind sample 46, at 0.09 s, nearly its ");
  });
  ASSERT_NE(told, said.end()) << said[0];
  EXPECT_NE(told->find(": a counter that overflows looks so, 24 times here; add its range, about 20 mm, at each"),
            std::string::npos)
      << *told;
  for (const std::string& text : said) EXPECT_FALSE(text.starts_with("the displacement leaps")) << text;
}

TEST(MotionFaults, ACounterOverflowsAtAnyRateAndResolution) {
  for (const int rate : {100, 500, 5000}) {
    for (const double reach : {0.0105, 0.012, 0.035}) {
      for (const double count : {1e-9, 2e-5}) {
        std::vector<double> time;
        std::vector<double> values;
        for (int n = 0; n < 4 * rate; ++n) {
          time.push_back(static_cast<double>(n) / rate);
          values.push_back(count *
                           std::round(on_counter(reach * std::sin(0.5 * omega * time.back()), -0.01, 0.02) / count));
        }
        const auto wrap = wrap_of(time, values);
        ASSERT_TRUE(wrap.has_value()) << rate << " " << reach << " " << count;
        EXPECT_NEAR(wrap->range, 0.02, 5e-4) << rate << " " << reach << " " << count;
      }
    }
  }
  // Once, slowly, as an encoder counts.
  std::vector<double> time;
  std::vector<double> values;
  for (int n = 0; n < 3000; ++n) {
    time.push_back(0.001 * n);
    values.push_back(1e-4 * std::round(on_counter(0.049 + 0.001 * time.back(), -0.05, 0.1) / 1e-4));
  }
  const auto wrap = wrap_of(time, values);
  ASSERT_TRUE(wrap.has_value());
  EXPECT_EQ(wrap->count, 1U);
  EXPECT_NEAR(wrap->range, 0.1, 2e-4);
}

TEST(MotionFaults, JumpsThatAreNoOverflow) {
  const Stream noise(5);
  std::vector<double> time, square, ringing, stuck, lost, spikes;
  for (int n = 0; n < 4000; ++n) {
    const double t = 0.001 * n;
    const double hiss = 1e-5 * noise.normal(static_cast<std::uint64_t>(n));
    time.push_back(t);
    square.push_back((n / 500 % 2 == 0 ? 0.01 : -0.01) + hiss);
    // It goes beyond and comes back after each step.
    ringing.push_back((n / 500 % 2 == 0 ? 1.0 : -1.0) * (0.01 + 0.001 * std::exp(-0.01 * (n % 500))));
    stuck.push_back(at(n < 900 || n >= 1000 ? t : 0.9));
    lost.push_back(at(n < 1500 ? t : t + 0.25));
    spikes.push_back(at(t) + (n % 1000 == 300 ? 0.03 : 0.0));
  }
  for (const auto* values : {&square, &ringing, &stuck, &lost, &spikes}) {
    EXPECT_FALSE(wrap_of(time, *values).has_value());
  }
  EXPECT_FALSE(wrap_of({}, {}).has_value());
  EXPECT_FALSE(wrap_of(time, std::vector<double>(time.size(), 0.0)).has_value());
}

TEST(MotionFaults, MomentsOfZeros) {
  // Of three samples each; the displacement crosses zero in the last, the force nearly does in the second.
  const auto fails = [](int n) { return (n >= 415 && n < 418) || (n >= 935 && n < 938) || (n >= 1000 && n < 1003); };
  const auto failing = [&](const Channel& channel) {
    return [&fails, channel](double t, int n) { return fails(n) ? 0.0 : channel(t, n); };
  };
  const std::string times =
      " jumps to exactly 0 and back 2 times, first at 0.83 s, far beyond its other steps: a sensor";
  const auto said_of_motion = remarks(failing(true_x), true_v, true_f);
  ASSERT_FALSE(said_of_motion.empty());
  EXPECT_TRUE(said_of_motion.front().starts_with("the displacement" + times)) << said_of_motion.front();
  const auto said_of_force = remarks(true_x, true_v, failing(true_f));
  ASSERT_FALSE(said_of_force.empty());
  EXPECT_TRUE(said_of_force.front().starts_with("the force jumps to exactly 0 and back 2 times, first at 0.83 s"))
      << said_of_force.front();
}

TEST(MotionFaults, ZerosOfADamperAreNoFaults) {
  std::vector<double> friction, play, stops;
  for (int n = 0; n < 1000; ++n) {
    const double phase = 0.02 * std::numbers::pi * n;
    const double cosine = std::round(1e6 * std::cos(phase)) / 1e6;
    friction.push_back(cosine == 0.0 ? 0.0 : std::copysign(500.0, cosine));
    play.push_back(std::fabs(std::sin(phase)) > 0.1 ? 500.0 * std::sin(phase) : 0.0);
    stops.push_back(n % 50 < 25 ? 500.0 : n % 50 < 30 ? 0.0 : -500.0);
  }
  EXPECT_FALSE(dropouts_of(friction).has_value());
  EXPECT_FALSE(dropouts_of(play).has_value());
  EXPECT_FALSE(dropouts_of(stops).has_value());
  EXPECT_FALSE(dropouts_of({}).has_value());
  // Once is an outlier, and what it does often is no failure.
  std::vector<double> once(200, 5.0);
  once[100] = 0.0;
  EXPECT_FALSE(dropouts_of(once).has_value());
}

TEST(MotionFaults, AStepOfTheMotionIsNoLeap) {
  std::vector<double> time;
  std::vector<double> step;
  for (int n = 0; n < 400; ++n) {
    time.push_back(0.01 * n);
    step.push_back(n < 200 ? 0.0 : 0.02);
  }
  EXPECT_FALSE(leap_of(time, step).has_value()) << "it rests before and after";
}

TEST(MotionFaults, ALeapIsToldAtAnySamplingRateAndBesideAReversal) {
  for (const int rate : {500, 5000, 50000}) {
    for (const double lost_from : {0.45, 0.62}) {  // in mid-stroke; 5 ms before a reversal
      for (const double count : {1e-12, 1e-6}) {   // m, of the converter
        std::vector<double> time;
        std::vector<double> values;
        for (int n = 0; n < 2 * rate; ++n) {
          const double t = static_cast<double>(n) / rate;
          time.push_back(t);
          values.push_back(count * std::round(at(t < lost_from ? t : t + 0.11) / count));
        }
        const auto leap = leap_of(time, values);
        ASSERT_TRUE(leap.has_value()) << rate << " " << lost_from << " " << count;
        EXPECT_NEAR(time[leap->after], lost_from, 1.5 / rate);
      }
    }
  }
}

TEST(MotionFaults, AChannelThatWasStuckForAMomentLeaps) {
  std::vector<double> time;
  std::vector<double> values;
  for (int n = 0; n < 2000; ++n) {
    time.push_back(0.001 * n);
    values.push_back(at(n < 900 || n >= 1000 ? time.back() : 0.9));
  }
  const auto leap = leap_of(time, values);
  ASSERT_TRUE(leap.has_value());
  EXPECT_EQ(leap->after, 999U);
}

// Of what a converter, a hold and a motion in steps do.
TEST(MotionFaults, StepsThatAreNoLeaps) {
  const Stream noise(5);
  std::vector<double> time, square, coarse, held, started;
  for (int n = 0; n < 4000; ++n) {
    const double t = 0.001 * n;
    const double hiss = 1e-5 * noise.normal(static_cast<std::uint64_t>(n));
    time.push_back(t);
    square.push_back((n / 500 % 2 == 0 ? 0.01 : -0.01) + hiss);
    coarse.push_back(5e-4 * std::round(at(t) / 5e-4));
    held.push_back(at(0.001 * (n / 20 * 20)));
    // Moved in one step after a rest that is longer than its strokes.
    started.push_back(n < 1000 ? hiss : 0.01 + at(t - 1.0));
  }
  EXPECT_FALSE(leap_of(time, square).has_value());
  EXPECT_FALSE(leap_of(time, coarse).has_value());
  EXPECT_FALSE(leap_of(time, held).has_value());
  EXPECT_FALSE(leap_of(time, started).has_value());
  EXPECT_FALSE(excursion_of(time, square).has_value());
  EXPECT_FALSE(excursion_of(time, coarse).has_value());
  EXPECT_FALSE(excursion_of(time, held).has_value());
  EXPECT_FALSE(excursion_of(time, started).has_value());
}

TEST(MotionFaults, ASampleOrTwoThatLeaveThePathWithinItsRange) {
  for (const int samples : {1, 2}) {
    const auto said =
        remarks([&](double t, int n) { return at(t) + (n >= 700 && n < 700 + samples ? 0.005 : 0.0); }, true_v, true_f);
    ASSERT_FALSE(said.empty()) << samples;
    EXPECT_TRUE(said[0].starts_with("the displacement goes from -9.585 to -4.5")) << said[0];
    EXPECT_NE(said[0].find(" at 1.4 s and back at once"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find(", 1 time like that"), std::string::npos) << said[0];
  }
  // Three are no glitch of one.
  EXPECT_TRUE(std::ranges::none_of(
      remarks([](double t, int n) { return at(t) + (n >= 700 && n < 703 ? 0.005 : 0.0); }, true_v, true_f),
      [](const std::string& text) { return text.find("and back at once") != std::string::npos; }));
}

TEST(MotionFaults, AFirstOrLastSampleOffThePath) {
  const auto off = [](int from, int to) {
    return remarks([=](double t, int n) { return at(t) + (n >= from && n < to ? 0.004 : 0.0); }, true_v, true_f);
  };
  expect_one(off(0, 1),
             "the displacement is 4 mm in the first sample, at 0 s, and the samples behind it tell 0 mm, far "
             "beyond their steps: a sensor that was not ready, or a row that is no sample, looks so; cut it");
  expect_one(off(1500, 1501), "the displacement is 4 mm in the last sample, at 3 s, and the samples before it tell ");
  expect_one(off(0, 3),
             "the displacement is 4.502 mm in sample 3, at 0.004 s, and the samples behind it tell 0.503 mm, far "
             "beyond their steps: a sensor that was not ready, or a row that is no sample, looks so; cut the first 3 "
             "samples");
  expect_one(off(1497, 1498), "the displacement is 3.247 mm in sample 4 from the end, at 2.994 s");
}

// A rod that sets out, turns, or rests and goes on in steps is where it was told to be.
TEST(MotionFaults, NothingIsSaidOfHowAMotionBegins) {
  const auto of = [](const std::function<double(double)>& x) {
    std::string text = "time [s],displacement [mm],force [N]\n";
    for (int n = 0; n < 1000; ++n) {
      const double t = 0.002 * n;
      text += fmt::format("{:.4f},{:.4f},{:.3f}\n", t, x(t), 800.0 * std::cos(omega * t));
    }
    std::string said;
    ReadOptions options;
    options.force_required = false;
    options.remark = [&](const Remark& remark) { said += remark.text.plain() + "\n"; };
    (void)parse_csv(text, "a.csv", options);
    return said.find("first sample") != std::string::npos || said.find("in sample") != std::string::npos;
  };
  const auto triangle = [](double t, double begin) { return 20.0 * std::fabs(std::remainder(t + begin, 1.0)); };
  EXPECT_FALSE(of([&](double t) { return triangle(t, 0.498); }));
  EXPECT_FALSE(of([&](double t) { return triangle(t, 0.497); }));
  EXPECT_FALSE(of([](double t) { return t < 0.001 ? 0.0 : 10.0 * std::sin(omega * (t - 0.001)); }));
  EXPECT_FALSE(of([](double t) { return 10.0 * std::cos(omega * t); }));
  EXPECT_FALSE(of([](double t) { return 4.0 * std::ceil(t / 0.5); })) << "stairs";
  EXPECT_TRUE(of([](double t) { return t == 0.0 ? 0.0 : 10.0 * std::cos(omega * t); }));
}

}  // namespace
}  // namespace hysteron

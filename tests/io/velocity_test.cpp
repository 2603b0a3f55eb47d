#include "io/velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "io/local_cubic.hpp"
#include "io/local_window.hpp"

namespace hysteron {
namespace {

constexpr double pi = std::numbers::pi;

// Gain and phase (degrees) of the velocity against the true A w cos(w t), by projection over whole periods, and the
// largest error relative to the peak velocity.
struct Quality {
  double gain;
  double phase;
  double worst;
};

Quality quality(const std::vector<double>& t, double amplitude, double hertz, double quantum) {
  const double w = 2.0 * pi * hertz;
  std::vector<double> x;
  for (const double at : t) {
    const double exact = amplitude * std::sin(w * at);
    x.push_back(quantum > 0.0 ? quantum * std::round(exact / quantum) : exact);
  }
  const auto v = derive_velocity(t, x);
  // Least squares on cos and sin, for any spacing.
  double cc = 0, cs = 0, ss = 0, vc = 0, vs = 0, worst = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double c = std::cos(w * t[i]);
    const double s = std::sin(w * t[i]);
    cc += c * c, cs += c * s, ss += s * s, vc += v[i] * c, vs += v[i] * s;
    worst = std::max(worst, std::abs(v[i] - amplitude * w * c));
  }
  const double det = cc * ss - cs * cs;
  const double a = (vc * ss - vs * cs) / det;
  const double b = (vs * cc - vc * cs) / det;
  return {std::hypot(a, b) / (amplitude * w), std::atan2(-b, a) * 180.0 / pi, worst / (amplitude * w)};
}

std::vector<double> uniform(double rate, double duration) {
  std::vector<double> t;
  for (int i = 0; i < static_cast<int>(rate * duration); ++i) t.push_back(i / rate);
  return t;
}

TEST(Velocity, QuantisedSinesHaveNoPhaseError) {
  struct Case {
    double rate, hertz, amplitude;
  };
  for (const auto& c : {Case{1000, 5, 2e-3}, Case{1000, 0.5, 25e-3}, Case{200, 5, 2e-3}, Case{1000, 20, 1e-3},
                        Case{100, 1, 10e-3}, Case{1000, 1, 2e-3}}) {
    const auto q = quality(uniform(c.rate, 10.0 / c.hertz), c.amplitude, c.hertz, 3e-6);
    EXPECT_LT(std::abs(q.phase), 0.1) << c.rate << " " << c.hertz;
    EXPECT_NEAR(q.gain, 1.0, 0.01) << c.rate << " " << c.hertz;
    EXPECT_LT(q.worst, 0.03) << c.rate << " " << c.hertz;
    RecordProperty("worst", std::to_string(q.worst));
  }
}

TEST(Velocity, NonUniformTime) {
  std::vector<double> t;
  double at = 0.0;
  for (int i = 0; i < 4000; ++i) {
    t.push_back(at);
    at += 1e-3 * (1.0 + 0.6 * std::sin(12.9898 * i));
  }
  const auto quantised = quality(t, 2e-3, 5.0, 3e-6);
  EXPECT_LT(std::abs(quantised.phase), 0.1);
  EXPECT_NEAR(quantised.gain, 1.0, 0.01);
  EXPECT_LT(quantised.worst, 0.03);
  const auto exact = quality(t, 2e-3, 5.0, 0.0);
  EXPECT_LT(exact.worst, 1e-4);
}

TEST(Velocity, ExactForCubicsUpToTheEnds) {
  std::vector<double> t;
  std::vector<double> x;
  for (int i = 0; i < 50; ++i) {
    t.push_back(0.1 * i + 0.02 * (i % 3));
    x.push_back(1.0 + t.back() * (2.0 + t.back() * (0.5 - 0.3 * t.back())));
  }
  const auto v = derive_velocity(t, x);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(v[i], 2.0 + t[i] - 0.9 * t[i] * t[i], 1e-9) << i;
}

TEST(Velocity, AStartFromRestIsNotSmeared) {
  // At rest for a tenth of a second, then a slow motion that is faded in: its noise asks for a window far longer.
  const auto t = uniform(250, 20.0);
  const Stream stream(5);
  const double noise = 2e-5;
  for (const bool reversed : {false, true}) {
    std::vector<double> x;
    std::vector<double> exact;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double at = std::max(0.0, t[reversed ? t.size() - 1 - i : i] - 0.1);
      const double fade = std::tanh(at * at / 0.04);
      const double speed = 0.012 * fade * std::cos(0.6 * at) +
                           (1.0 - fade * fade) * 2.0 * at / 0.04 * (0.004 + 0.02 * std::sin(0.6 * at));
      x.push_back(fade * (0.004 + 0.02 * std::sin(0.6 * at)) + noise * stream.normal(i));
      exact.push_back(reversed ? -speed : speed);
    }
    const auto v = derive_velocity(t, x);
    for (std::size_t k = 0; k < 20; ++k) {
      const std::size_t i = reversed ? t.size() - 1 - k : k;
      EXPECT_NEAR(v[i], exact[i], 4e-3) << reversed << " " << k;
    }
  }
}

TEST(Velocity, RestIsZeroAndGapsAreBridged) {
  const auto t = uniform(1000, 0.1);
  for (const double v : derive_velocity(t, std::vector<double>(t.size(), 0.3))) EXPECT_EQ(v, 0.0);
  // A gap of five seconds and a half period: what is beyond it must not bend the fit.
  std::vector<double> gappy;
  for (int i = 0; i < 2000; ++i) gappy.push_back(1e-3 * i + (i > 1000 ? 5.05 : 0.0));
  const auto q = quality(gappy, 2e-3, 5.0, 3e-6);
  EXPECT_NEAR(q.gain, 1.0, 0.01);
  EXPECT_LT(q.worst, 0.03);
}

TEST(Velocity, ConstantSpeedIsNotTakenForAQuantum) {
  const auto t = uniform(1000, 2.0);
  std::vector<double> x;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto phase = static_cast<double>(i % 500);
    x.push_back(4e-5 * (phase < 250.0 ? phase : 500.0 - phase));
  }
  const auto v = derive_velocity(t, x);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (i % 250 < 3 || i % 250 > 247) continue;
    EXPECT_NEAR(std::abs(v[i]), 0.04, 1e-9) << i;
  }
}

// Noise as of a good transducer, deterministic.
double noise(std::size_t i) {
  const double x = std::sin(12.9898 * static_cast<double>(i + 1)) * 43758.5453;
  return 2.0 * (x - std::floor(x)) - 1.0;
}

TEST(Velocity, CornersOfTrianglesAndRampsStayCorners) {
  // 42 mm/s, with corners between the samples, and rest before and after.
  const auto t = uniform(500, 10.0);
  std::vector<double> x;
  std::vector<double> truth;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double at = t[i] - 0.5013;
    const double phase = std::fmod(at, 4.0);
    const bool rests = at < 0.0 || at > 8.0;
    const double place = phase < 1.0 ? phase : (phase < 3.0 ? 2.0 - phase : phase - 4.0);
    x.push_back((rests ? 0.0 : 0.042 * place) + 1.5e-6 * noise(i));
    truth.push_back(rests ? 0.0 : (phase < 1.0 || phase > 3.0 ? 0.042 : -0.042));
  }
  const auto v = derive_velocity(t, x);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(v[i], truth[i], 0.05 * 0.042) << i;
}

TEST(Velocity, ASampleOnACornerHasTheMeanOfBothSides) {
  const auto t = uniform(500, 4.0);
  std::vector<double> x;
  for (const double at : t) x.push_back(0.042 * std::abs(std::fmod(at + 1.0, 2.0) - 1.0));
  const auto v = derive_velocity(t, x);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double place = std::fmod(t[i], 2.0);
    const double truth = i % 500 == 0 ? 0.0 : (place < 1.0 ? 0.042 : -0.042);
    EXPECT_NEAR(v[i], truth, 1e-6) << i;
  }
}

// A sample an eighth of a step from a corner has the speed of its side, where noise lets that be told.
TEST(Velocity, ASampleBesideACornerHasTheSpeedOfItsSide) {
  const auto t = uniform(500, 4.0);
  for (const double off : {-0.2, -0.125, 0.02, 0.125, 0.2}) {
    const auto place_of = [&](double at) { return std::fmod(at - 0.002 * off + 2.0, 2.0); };
    for (const double size : {0.0, 1e-7}) {
      std::vector<double> x;
      for (std::size_t i = 0; i < t.size(); ++i) {
        x.push_back(0.042 * std::abs(place_of(t[i]) - 1.0) + size * noise(i));
      }
      const auto v = derive_velocity(t, x);
      for (std::size_t i = 4; i + 4 < t.size(); ++i) {
        EXPECT_NEAR(v[i], place_of(t[i]) < 1.0 ? -0.042 : 0.042, 0.01 * 0.042) << i << " " << off << " " << size;
      }
    }
  }
}

TEST(Velocity, ASampleThatNoiseLeavesOnACornerHasTheMean) {
  const auto t = uniform(500, 4.0);
  for (const double off : {-0.125, 0.02, 0.125}) {
    std::vector<double> x;
    for (std::size_t i = 0; i < t.size(); ++i) {
      x.push_back(0.042 * std::abs(std::fmod(t[i] - 0.002 * off + 2.0, 2.0) - 1.0) + 2e-5 * noise(i));
    }
    EXPECT_NEAR(derive_velocity(t, x)[500], 0.0, 0.01 * 0.042) << off;
  }
}

TEST(Velocity, ArcsAreNotTakenForCorners) {
  // Constant acceleration of alternating sign: straight velocity, the sharpest turn of the displacement but a corner.
  const auto t = uniform(500, 4.0);
  std::vector<double> x;
  std::vector<double> truth;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double phase = std::fmod(t[i] + 0.25, 1.0);
    const double away = phase < 0.5 ? phase - 0.25 : phase - 0.75;
    const double bow = 0.0625 - away * away;
    x.push_back((phase < 0.5 ? 0.1 : -0.1) * bow + 1.5e-6 * noise(i));
    truth.push_back((phase < 0.5 ? -0.2 : 0.2) * away);
  }
  const auto v = derive_velocity(t, x);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(v[i], truth[i], 0.02 * 0.05) << i;
}

double root_mean_square_error(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// A triangle wave of 3 Hz and 120 mm/s whose corners are arcs of `arc` seconds, and its velocity.
struct Rounded {
  double displacement;
  double velocity;
};
Rounded rounded_triangle(double t, double arc) {
  constexpr double speed = 0.12;
  constexpr double half = 1.0 / 6.0;
  const double in = std::fmod(t, 2.0 * half);
  const double sign = in < half ? 1.0 : -1.0;
  const double since = std::fmod(in, half);
  const double acceleration = 2.0 * speed / arc;
  // Displacement from mid-stroke; an arc is half before and half after a reversal.
  const double to_corner = std::min(since, half - since);
  const double direction = since < half / 2.0 ? -1.0 : 1.0;
  const double straight = speed * (half / 2.0 - to_corner);
  if (to_corner >= arc / 2.0) return {sign * direction * straight, sign * speed};
  const double into = arc / 2.0 - to_corner;
  return {sign * direction * (straight - 0.5 * acceleration * into * into), sign * (speed - acceleration * into)};
}

TEST(Velocity, RoundedCornersAreAsSharpAsTheSamplesTell) {
  // Sampled at 500 Hz: four to six samples are in an arc, and the noise asks for windows twice as long.
  const auto t = uniform(500, 3.0);
  const Stream stream(6);
  for (const double arc : {0.008, 0.010, 0.012}) {
    std::vector<double> x;
    for (std::size_t i = 0; i < t.size(); ++i) {
      x.push_back(rounded_triangle(t[i], arc).displacement + 2e-6 * stream.normal(i));
    }
    const auto v = derive_velocity(t, x);
    double squares = 0.0;
    for (std::size_t i = 10; i + 10 < t.size(); ++i) {
      const double error = v[i] - rounded_triangle(t[i], arc).velocity;
      EXPECT_LT(std::abs(error), 0.018) << arc << " " << t[i];
      squares += error * error / static_cast<double>(t.size() - 20);
    }
    EXPECT_LT(std::sqrt(squares), 0.002) << arc;
  }
}

TEST(Velocity, ACornerThatAServoRoundsIsNone) {
  // Reversals of 120 mm/s smoothed by a Gaussian, so that lines through eight samples nearly fit on both sides.
  const auto t = uniform(500, 3.0);
  const Stream stream(6);
  constexpr double half = 1.0 / 6.0;
  for (const auto& [width, noise] : {std::pair(1.5e-3, 2e-7), std::pair(2e-3, 1e-6)}) {
    std::vector<double> x;
    std::vector<double> exact;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double reversals = std::round(t[i] / half);
      const double z = (t[i] - reversals * half) / (std::sqrt(2.0) * width);
      const double way = std::fmod(reversals, 2.0) == 0.0 ? 0.12 : -0.12;
      exact.push_back(way * std::erf(z));
      x.push_back(way * width * std::sqrt(2.0) * (z * std::erf(z) + std::exp(-z * z) / std::sqrt(pi)) -
                  way * half / 2.0 + noise * stream.normal(i));
    }
    const auto v = derive_velocity(t, x);
    for (std::size_t i = 10; i + 10 < t.size(); ++i) EXPECT_NEAR(v[i], exact[i], 0.014) << width << " " << t[i];
  }
}

// 1 Hz, 10 mm, and noise.
std::vector<double> noisy_sine(const std::vector<double>& t, double deviation, std::uint64_t seed) {
  const Stream stream(seed);
  std::vector<double> x;
  for (std::size_t i = 0; i < t.size(); ++i)
    x.push_back(0.01 * std::sin(2.0 * pi * t[i]) + deviation * stream.normal(i));
  return x;
}

TEST(Velocity, AGlitchDoesNotShortenTheWindow) {
  const auto t = uniform(500, 4.0);
  auto x = noisy_sine(t, 5e-6, 7);
  const auto before = derive_velocity(t, x);
  x[990] += 4e-4;
  const auto v = derive_velocity(t, x);
  // The five samples of the shortest window would make 133 mm/s of it.
  for (std::size_t i = 970; i < 1010; ++i) EXPECT_NEAR(v[i], before[i], 0.02) << i;
}

TEST(Velocity, AGapDoesNotShortenTheWindow) {
  // Of 100 samples 30 are lost, and the cubic beside them passes on several times the noise.
  std::vector<double> t;
  for (int i = 0; i < 20000; ++i) {
    if (i % 100 >= 30) t.push_back(0.002 * i);
  }
  const auto x = noisy_sine(t, 5e-6, 9);
  std::vector<double> whole(t.size());
  std::vector<double> local(t.size());
  local_cubic_slopes(t, x, 16.0, 0.002, 5e-6, whole);
  local_window_slopes(t, x, 16.0, 0.002, 5e-6, local);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_EQ(local[i], whole[i]) << t[i];
}

TEST(Velocity, NoiseAloneIsSmoothedByTheLongestWindow) {
  const auto t = uniform(1000, 60.0);
  const auto x = noisy_sine(t, 2e-6, 8);
  const auto v = derive_velocity(t, x);
  double squares = 0.0;
  for (std::size_t i = 100; i + 100 < t.size(); ++i) {
    const double error = v[i] - 0.02 * pi * std::cos(2.0 * pi * t[i]);
    squares += error * error / static_cast<double>(t.size() - 200);
  }
  EXPECT_NEAR(std::sqrt(squares) / derived_velocity_noise(t, x), 1.0, 0.03);
}

TEST(Acceleration, OfANoisyMeasuredVelocityIsSmoothedWithoutPhaseError) {
  const double w = 2.0 * pi * 3.0;
  const auto t = uniform(1000, 3.0);
  std::vector<double> x, v, noisy, truth;
  for (std::size_t i = 0; i < t.size(); ++i) {
    x.push_back(0.01 * std::sin(w * t[i]));
    v.push_back(0.01 * w * std::cos(w * t[i]));
    noisy.push_back(v.back() + 5e-4 * noise(i));
    truth.push_back(-0.01 * w * w * std::sin(w * t[i]));
  }
  const double peak = 0.01 * w * w;
  EXPECT_LT(root_mean_square_error(derive_acceleration(t, x, v, true), truth), 1e-3 * peak);
  const auto a = derive_acceleration(t, x, noisy, true);
  // The shortest window would pass sqrt(75/8) noise / (dt 2^1.5), a third of the peak.
  EXPECT_LT(root_mean_square_error(a, truth), 0.02 * peak);
  double in_phase = 0.0, late = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    in_phase -= a[i] * std::sin(w * t[i]);
    late += a[i] * std::cos(w * t[i]);
  }
  EXPECT_NEAR(late / in_phase, 0.0, 5e-3);
  EXPECT_NEAR(2.0 * in_phase / static_cast<double>(t.size()), peak, 0.02 * peak);
}

TEST(Acceleration, OfTrianglesIsAllInTheCorners) {
  const auto t = uniform(500, 6.0);
  std::vector<double> x;
  for (const double at : t) x.push_back(0.042 * std::abs(std::fmod(at + 1.0, 2.0) - 1.0));
  const auto v = derive_velocity(t, x);
  for (const bool measured : {false, true}) {
    const auto a = derive_acceleration(t, x, v, measured);
    double impulse = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const std::size_t place = i % 500;
      const bool at_corner = i > 2 && i + 3 < t.size() && (place < 3 || place > 497);
      if (!at_corner) {
        EXPECT_NEAR(a[i], 0.0, 1e-6) << i;
      }
      if (i > 250 && i < 750) impulse += a[i] / 500.0;
    }
    EXPECT_NEAR(impulse, -2.0 * 0.042, 1e-6);
  }
}

TEST(Velocity, FewSamples) {
  EXPECT_TRUE(derive_velocity({}, {}).empty());
  EXPECT_TRUE(derive_acceleration({}, {}, {}, true).empty());
  for (std::size_t n = 1; n < 12; ++n) {
    std::vector<double> t(n);
    for (std::size_t i = 0; i < n; ++i) t[i] = static_cast<double>(i);
    const auto v = derive_velocity(t, t);
    for (const double value : v) EXPECT_NEAR(value, n > 1 ? 1.0 : 0.0, 1e-9);
    for (const bool measured : {false, true}) {
      for (const double value : derive_acceleration(t, t, v, measured)) EXPECT_NEAR(value, 0.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace hysteron

// The hysteretic oscillator against an integration of the published equations by another method, and its excitation
// against what the benchmark asks.
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "datasets/dataset.hpp"

namespace hysteron {
namespace {

const Campaign& oscillator() {
  static const Campaign campaign = find_dataset("hysteretic-oscillator")->generate(Stream(1));
  return campaign;
}

TEST(Oscillator, SweepObeysThePublishedEquations) {
  using State = std::array<double, 3>;  // y, y', z
  const Recording& sweep = oscillator().recordings[2];
  ASSERT_EQ(sweep.size(), 153000U);
  const auto u = [](double t) { return 40.0 * std::sin(2.0 * std::numbers::pi * (20.0 * t + t * t / 12.0)); };
  const auto rates = [&](const State& s, State& d, double t) {
    d[0] = s[1];
    d[1] = (u(t) - 10.0 * s[1] - 5e4 * s[0] - s[2]) / 2.0;
    d[2] = 5e4 * s[1] - 1e3 * (0.8 * std::fabs(s[1]) * s[2] - 1.1 * s[1] * std::fabs(s[2]));
  };
  namespace odeint = boost::numeric::odeint;
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(1e-11, 1e-11);
  State state{};
  constexpr std::size_t seconds = 110;  // through the resonance
  for (std::size_t n = 0; n < 750 * seconds; ++n) {
    ASSERT_NEAR(sweep.displacement[n], state[0], 5e-8) << n;
    ASSERT_NEAR(sweep.force[n], u(sweep.time[n]), 1e-9) << n;
    odeint::integrate_adaptive(stepper, rates, state, sweep.time[n], sweep.time[n + 1], 1e-4);
  }
}

TEST(Oscillator, MultisinesAreThoseOfTheBenchmark) {
  const Recording& training = oscillator().recordings[0];
  const Recording& test = oscillator().recordings[1];
  ASSERT_EQ(training.size(), 40960U);
  ASSERT_EQ(test.size(), 2 * 8192U);
  EXPECT_NE(training.force[9000], test.force[9000]);
  for (const Recording* recording : {&training, &test}) {
    double square = 0.0;
    for (std::size_t n = 8192; n < 2 * 8192; ++n) {
      square += recording->force[n] * recording->force[n];
    }
    EXPECT_NEAR(std::sqrt(square / 8192.0), 50.0, 1e-6);
    // Lines of 750 / 8192 Hz: the first and the last of the band, and those beside it.
    const auto line = [&](int k) {
      std::complex<double> sum = 0.0;
      for (std::size_t n = 0; n < 8192; ++n) {
        sum += std::polar(recording->force[8192 + n] * 2.0 / 8192.0,
                          -2.0 * std::numbers::pi * static_cast<double>(n) * k / 8192.0);
      }
      return std::abs(sum);
    };
    const double amplitude = 50.0 * std::sqrt(2.0 / 1584.0);
    EXPECT_NEAR(line(54), 0.0, 1e-6);
    EXPECT_NEAR(line(55), amplitude, 1e-6);
    EXPECT_NEAR(line(1638), amplitude, 1e-6);
    EXPECT_NEAR(line(1639), 0.0, 1e-6);
  }
}

TEST(Oscillator, TheTestIsQuietAndTheTrainingNoisy) {
  const Recording& training = oscillator().recordings[0];
  // Steady from the second period on: what two periods differ by is the noise of both.
  double square = 0.0;
  for (std::size_t n = 2 * 8192; n < 3 * 8192; ++n) {
    const double difference = training.displacement[n] - training.displacement[n + 8192];
    square += difference * difference;
  }
  EXPECT_NEAR(std::sqrt(square / 8192.0), 8e-6 * std::numbers::sqrt2, 0.4e-6);
  const Campaign other = find_dataset("hysteretic-oscillator")->generate(Stream(2));
  EXPECT_NE(other.recordings[1].displacement[9000], oscillator().recordings[1].displacement[9000]);
  EXPECT_EQ(other.recordings[2].displacement, oscillator().recordings[2].displacement);
}

}  // namespace
}  // namespace hysteron

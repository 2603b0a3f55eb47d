// The concealed truth against closed forms: laws, series elements, chain, limits.
#include "challenge/physics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "challenge/chain.hpp"
#include "challenge/dormand_prince.hpp"

namespace hysteron::challenge {
namespace {

using Motioned = challenge::Run;  // the name Run belongs to the fixtures

constexpr double rate = 4000.0;

Motioned sine(double amplitude, double frequency, double duration, double level = 1.0) {
  Motioned test;
  test.motion.sines = {{amplitude, 2.0 * std::numbers::pi * frequency, 0.0}};
  test.drive = {{0.0}, {level}, 0.002};
  test.duration = duration;
  test.lead = 0.5;
  return test;
}

// Yield force 800 N, damping 2000 N s/m, knee 0.5 mm.
Physics bouc_wen() {
  Physics p;
  p.alpha_a = 800.0;
  p.c_a = 2000.0;
  p.A = 10.0;
  p.n = 2.0;
  const double full = 5e-4 * p.A;
  p.beta = p.gamma = 0.5 * p.A / (full * full);
  p.force_scale = 1000.0;
  p.length_scale = 1e-2;
  return p;
}

Physics bingham() {
  Physics p;
  p.law = Law::bingham;
  p.alpha_a = 800.0;
  p.c_a = 2000.0;
  p.force_scale = 1000.0;
  return p;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

TEST(DormandPrince, MeetsItsToleranceOnAnOscillator) {
  std::array<double, 2> y = {1.0, 0.0};
  double step = 0.1;
  advance(y, 0.0, 10.0, step, 1e-9, {1.0, 1.0}, [](double, const std::array<double, 2>& s) {
    return std::array<double, 2>{s[1], -s[0]};
  });
  EXPECT_NEAR(y[0], std::cos(10.0), 1e-7);
  EXPECT_NEAR(y[1], -std::sin(10.0), 1e-7);
}

TEST(Motion, DerivativesAreThoseOfTheDisplacement) {
  Motion motion;
  motion.sines = {{1e-2, 9.0, 0.3}, {2e-3, 31.0, 1.0}};
  motion.triangle_amplitude = 5e-3;
  motion.triangle_omega = 4.0;
  motion.offset = 1e-3;
  motion.ramp = 0.4;
  constexpr double h = 1e-5;
  for (const double t : {0.05, 0.2, 0.39, 0.7, 1.9}) {
    const Kinematics m = motion.at(t);
    EXPECT_NEAR(m.v, (motion.at(t + h).x - motion.at(t - h).x) / (2.0 * h), 1e-7) << t;
    EXPECT_NEAR(m.a, (motion.at(t + h).v - motion.at(t - h).v) / (2.0 * h), 1e-4) << t;
  }
  EXPECT_EQ(motion.at(-1.0).x, 1e-3);
}

TEST(Truth, BoucWenSaturatesAtTheYieldForce) {
  const Motioned test = sine(1e-2, 1.0, 2.0);
  const Track track = simulate(bouc_wen(), test, rate);
  // At the fastest point the knee lies ten yield displacements behind.
  const std::size_t fastest = track.lead + static_cast<std::size_t>(rate);
  EXPECT_NEAR(track.force[fastest], 800.0 + 2000.0 * track.v[fastest], 0.5);
}

TEST(Truth, ModifiedBoucWenTurnsIntoBoucWenForAStiffDashpot) {
  Physics modified = bouc_wen();
  modified.law = Law::modified_bouc_wen;
  modified.c1 = 1e9;
  const Motioned test = sine(5e-3, 2.0, 1.0);
  EXPECT_LT(largest_difference(simulate(modified, test, rate).force, simulate(bouc_wen(), test, rate).force), 0.5);
}

TEST(Truth, ResultDoesNotHangOnTheGrid) {
  Physics p = bouc_wen();
  p.gap = 4e-4;
  p.contact_stiffness = 1e7;
  p.contact_damping = 2e3;
  const Motioned test = sine(5e-3, 2.0, 1.0);
  const Track coarse = simulate(p, test, 2000.0);
  const Track fine = simulate(p, test, 8000.0);
  double largest = 0.0;
  for (std::size_t k = 0; k < coarse.force.size(); ++k) {
    largest = std::max(largest, std::abs(coarse.force[k] - fine.force[4 * k]));
  }
  EXPECT_LT(largest, 0.02 * 1000.0);
}

TEST(Truth, GapGivesAPlateauOfItsOwnWidthAtZeroForce) {
  Physics p = bouc_wen();
  p.gap = 1e-3;
  p.contact_stiffness = 1e7;
  p.contact_damping = 2e3;
  for (const double amplitude : {5e-3, 1e-2}) {
    const Track track = simulate(p, sine(amplitude, 1.0, 2.0), rate);
    double low = 1.0;
    double high = -1.0;
    // After the upper reversal of the second period.
    for (std::size_t k = track.lead + 5000; k < track.lead + 7000; ++k) {
      if (std::abs(track.force[k]) < 1.0) {
        low = std::min(low, track.x[k]);
        high = std::max(high, track.x[k]);
      }
    }
    EXPECT_NEAR(high - low, 1e-3, 1e-4) << amplitude;
  }
}

TEST(Truth, SeriesSpringTakesItsShareOfTheStroke) {
  // Bingham at rest holds, so below the yield force the rod moves the spring alone, F = k x, but for the creep of its
  // rounded step: at 100 N 0.125 mm/s, 2 um in a quarter of the period.
  Physics p = bingham();
  p.series_stiffness = 1e6;
  const Track track = simulate(p, sine(1e-4, 20.0, 0.5), rate);
  EXPECT_NEAR(*std::ranges::max_element(track.force), 100.0, 2.0);
}

TEST(Truth, SeriesDashpotHalvesTheViscousForceOfItsEqual) {
  Physics p = bingham();
  p.alpha_a = 0.0;
  p.series_dashpot = 2000.0;
  const Track track = simulate(p, sine(5e-3, 1.0, 1.0), rate);
  for (std::size_t k = 0; k < track.force.size(); k += 97) EXPECT_NEAR(track.force[k], 1000.0 * track.v[k], 1e-6);
}

TEST(Truth, AirPocketIsSoftAndHardens) {
  Physics p = bingham();
  p.pocket_length = 1e-3;
  p.pocket_force = 50.0;
  const Track track = simulate(p, sine(5e-3, 1.0, 2.0), rate);
  Physics without = bingham();
  const Track plain = simulate(without, sine(5e-3, 1.0, 2.0), rate);
  // After the upper reversal the damper holds while the pocket gives way: the force passes zero after a travel of
  // L (1 - (1 + F / P)^(-1 / kappa)), 0.83 to 0.91 L for F of 400 to 800 N. At full speed it is that of the damper.
  std::size_t k = track.lead + static_cast<std::size_t>(1.25 * rate);
  const double top = track.x[k];
  while (track.force[k] > 0.0) ++k;
  EXPECT_GT(top - track.x[k], 0.83e-3);
  EXPECT_LT(top - track.x[k], 1.0e-3);
  const std::size_t fastest = track.lead + static_cast<std::size_t>(1.5 * rate);
  EXPECT_NEAR(track.force[fastest], plain.force[fastest], 0.02 * std::abs(plain.force[fastest]));
}

TEST(Truth, ParallelForcesAddUp) {
  const Motioned test = sine(1e-2, 2.0, 1.0);
  const Track plain = simulate(bouc_wen(), test, rate);
  Physics p = bouc_wen();
  p.mass = 3.0;
  p.cubic = 1e8;
  p.offset = 20.0;
  p.stop_force = 400.0;
  p.stop_up = p.stop_low = 8e-3;
  p.stop_depth = 2e-3;
  p.drift = 50.0;
  const Track with = simulate(p, test, rate);
  for (std::size_t k = 0; k < plain.force.size(); k += 101) {
    const double t = (static_cast<double>(k) - static_cast<double>(plain.lead)) / rate;
    const Kinematics m = test.motion.at(t);
    const double past = std::max(std::abs(m.x) - 8e-3, 0.0) / 2e-3;
    const double expected = 3.0 * m.a + 1e8 * m.x * m.x * m.x + 20.0 + 50.0 * std::max(t, 0.0) +
                            400.0 * std::pow(past, 1.5) * (m.x < 0.0 ? -1.0 : 1.0);
    EXPECT_NEAR(with.force[k] - plain.force[k], expected, 0.05) << t;
  }
}

TEST(Truth, StopsOutOfReachAndLagOfAConstantCurrentChangeNothing) {
  const Motioned test = sine(1e-2, 2.0, 1.0);
  Physics p = bouc_wen();
  p.alpha_b = 300.0;
  const Track plain = simulate(p, test, rate);
  p.stop_force = 1e5;
  p.stop_up = p.stop_low = 1.01e-2;
  p.coil_rise = p.coil_fall = 0.05;
  p.remanence = 0.3;
  EXPECT_EQ(largest_difference(simulate(p, test, rate).force, plain.force), 0.0);
}

TEST(Truth, CoilLagFollowsAStepExponentially) {
  Physics p = bingham();
  p.c_a = 0.0;
  p.alpha_a = 0.0;
  p.alpha_b = 1000.0;
  p.coil_rise = 0.05;
  p.coil_fall = 0.1;
  Motioned test = sine(2e-2, 0.5, 0.9);  // the speed keeps its sign until 0.5 s
  test.motion.sines[0].phase = -1.4;
  test.lead = 0.01;
  test.drive = {{0.0, 0.2, 0.5}, {0.0, 1.0, 0.0}, 1e-5};
  const Track track = simulate(p, test, rate);
  const auto at = [&](double t) { return track.force[track.lead + static_cast<std::size_t>(std::lround(t * rate))]; };
  EXPECT_NEAR(at(0.25), 1000.0 * (1.0 - std::exp(-1.0)), 3.0);
  const double top = 1000.0 * (1.0 - std::exp(-6.0));
  EXPECT_NEAR(at(0.6), top * std::exp(-1.0), 3.0);
}

TEST(Truth, RemanenceKeepsTheFieldAboveAfterAStepDown) {
  Physics p = bingham();
  p.c_a = 0.0;
  p.alpha_a = 0.0;
  p.alpha_b = 1000.0;
  p.remanence = 0.1;
  Motioned test = sine(2e-2, 0.5, 0.9);
  test.motion.sines[0].phase = -1.4;
  test.drive = {{0.0, 0.2, 0.5}, {0.2, 1.0, 0.2}, 1e-4};
  const Track track = simulate(p, test, rate);
  const auto at = [&](double t) { return track.force[track.lead + static_cast<std::size_t>(std::lround(t * rate))]; };
  EXPECT_NEAR(at(0.4), 900.0, 1.0);
  EXPECT_NEAR(at(0.8), 300.0, 1.0);
}

TEST(Truth, CavitationLimitsOneSideAndDwells) {
  Physics p = bingham();
  p.cavitation = 850.0;
  const Track track = simulate(p, sine(1e-2, 2.0, 1.0), rate);
  EXPECT_NEAR(*std::ranges::min_element(track.force), -850.0, 1e-6);
  EXPECT_GT(*std::ranges::max_element(track.force), 1000.0);
  // 5 ms after the lower reversal the void is not yet filled.
  EXPECT_EQ(track.force[track.lead + static_cast<std::size_t>(0.38 * rate)], 0.0);
}

// The damper's spring slackens while the void closes: no pull comes back in the stroke that closed it.
TEST(Truth, NoPullAfterTheVoidHasClosed) {
  Physics p = bouc_wen();
  p.cavitation = 700.0;
  const Motioned test = sine(1e-2, 1.0, 3.0);
  const Track track = simulate(p, test, rate);
  bool dwelt = false;
  for (std::size_t k = 1; k < track.force.size(); ++k) {
    dwelt = track.v[k] > 0.0 && (dwelt || track.force[k] == 0.0);
    if (dwelt) {
      EXPECT_GE(track.force[k], -1e-6 * p.force_scale) << k;
    }
  }
}

TEST(Truth, HeatAndWearLowerTheForceMonotonically) {
  for (const bool heat : {true, false}) {
    Physics p = bouc_wen();
    if (heat) {
      p.heat_rate = 0.02;
      p.heat_capacity = 5.0;
    } else {
      p.wear = 0.01;
    }
    const Track track = simulate(p, sine(1e-2, 2.0, 3.0), rate);
    double before = 1e9;
    for (int period = 0; period < 6; ++period) {
      const auto begin =
          track.force.begin() + static_cast<std::ptrdiff_t>(track.lead + 2000 * static_cast<std::size_t>(period));
      const double peak = *std::max_element(begin, begin + 2000);
      EXPECT_LT(peak, before);
      before = peak;
    }
    EXPECT_LT(before, 0.95 * 1050.0);
  }
}

TEST(Chain, DelayShiftsTheForceAndTheFilterNothingElse) {
  Physics p = bouc_wen();
  const Motioned test = sine(1e-2, 1.0, 1.0);
  const Track track = simulate(p, test, rate);
  const std::vector<double> now = clean_force(p, track, 8);
  p.force_delay = 0.01;
  const std::vector<double> late = clean_force(p, track, 8);
  for (std::size_t k = 5; k < now.size(); ++k) EXPECT_NEAR(late[k], now[k - 5], 1e-6);
}

TEST(Chain, NoiseHasTheDrawnSizeAndColour) {
  const Physics p = bingham();
  const Track track = simulate(p, sine(1e-2, 1.0, 10.0), 2000.0);
  Chain chain;
  chain.noise = 0.01;
  chain.coloured_share = 1.0;
  chain.correlation = 0.9;
  chain.force_bits = 24;
  const Range range{1000.0, 1e-2, 0.1, 1.0};
  const Measured m = measure(p, track, 2, chain, range, Stream(7));
  double variance = 0.0;
  double neighbours = 0.0;
  for (std::size_t k = 1; k < m.force.size(); ++k) {
    variance += (m.force[k] - m.clean[k]) * (m.force[k] - m.clean[k]);
    neighbours += (m.force[k] - m.clean[k]) * (m.force[k - 1] - m.clean[k - 1]);
  }
  EXPECT_NEAR(std::sqrt(variance / static_cast<double>(m.force.size())), 10.0, 0.8);
  EXPECT_NEAR(neighbours / variance, 0.9, 0.02);
}

TEST(Chain, LagOfTheVelocityChannelLeavesTheForceAlone) {
  Physics p = bingham();
  const Track track = simulate(p, sine(1e-2, 1.0, 1.0), rate);
  Chain chain;
  chain.velocity_noise = 0.0;
  const Range range{1000.0, 1e-2, 0.1, 1.0};
  const Measured plain = measure(p, track, 8, chain, range, Stream(1));
  p.velocity_lag = 0.01;
  const Measured lagged = measure(p, track, 8, chain, range, Stream(1));
  EXPECT_EQ(plain.force, lagged.force);
  // A first-order lag of a slow sine is a delay of atan(w tau) / w.
  const double w = 2.0 * std::numbers::pi;
  const double shift = std::atan(w * 0.01) / w;
  const std::size_t k = 300;
  const double gain = std::cos(std::atan(w * 0.01));
  EXPECT_NEAR(lagged.v[k],
              gain * (plain.v[k] * std::cos(w * shift) + 1e-2 * w * std::sin(w * plain.time[k]) * std::sin(w * shift)),
              2e-4);
}

}  // namespace
}  // namespace hysteron::challenge

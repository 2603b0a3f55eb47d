// The concealed truth against closed forms: laws, series elements, chain, limits.
#include "challenge/physics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "challenge/chain.hpp"
#include "challenge/dormand_prince.hpp"
#include "challenge/forms_electric.hpp"
#include "challenge/forms_fluid.hpp"
#include "challenge/forms_foreign.hpp"
#include "challenge/forms_friction.hpp"
#include "challenge/forms_series.hpp"
#include "challenge/forms_slow.hpp"
#include "challenge/forms_springs.hpp"

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

// Puts a part into the damper.
template <class Form, class... Values>
void add(Physics& p, Values... values) {
  p.parts.push_back(std::make_shared<const Form>(values...));
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

TEST(Motion, StopsWhereItIsAndStays) {
  Motion motion;
  motion.sines = {{1e-2, 9.0, 0.3}, {2e-3, 31.0, 1.0}};
  const Motion on = motion;
  motion.stop = 1.0;
  motion.stopping = 0.08;
  constexpr double h = 1e-5;
  for (const double t : {0.5, 0.99, 1.01, 1.04, 1.07, 1.2}) {
    const Kinematics m = motion.at(t);
    EXPECT_NEAR(m.v, (motion.at(t + h).x - motion.at(t - h).x) / (2.0 * h), 1e-6) << t;
    EXPECT_NEAR(m.a, (motion.at(t + h).v - motion.at(t - h).v) / (2.0 * h), 1e-2) << t;
  }
  EXPECT_EQ(motion.at(1.0).x, on.at(1.0).x);
  // Half of the way that was to go in that time.
  EXPECT_NEAR(motion.at(1.08).x, on.at(1.04).x, 1e-12);
  EXPECT_EQ(motion.at(5.0).x, motion.at(1.08).x);
  EXPECT_EQ(motion.at(5.0).v, 0.0);
  EXPECT_EQ(motion.at(5.0).a, 0.0);
}

TEST(Truth, BoucWenSaturatesAtTheYieldForce) {
  const Motioned test = sine(1e-2, 1.0, 2.0);
  const Track track = simulate(bouc_wen(), test, rate);
  // At the fastest point the knee lies ten yield displacements behind.
  const std::size_t fastest = track.lead + static_cast<std::size_t>(rate);
  EXPECT_NEAR(track.force[fastest], 800.0 + 2000.0 * track.v[fastest], 0.5);
}

TEST(Truth, WearGoesOnAfterAPauseAndBeginsAnewWithoutOne) {
  Physics p = bouc_wen();
  p.parts = {std::make_shared<PathWear>(0.5)};
  Motioned test = sine(5e-3, 2.0, 1.0);
  const Track first = simulate(p, test, rate);
  ASSERT_EQ(first.end.size(), 1U);
  // Four turns of 10 mm and two of 5 mm a second.
  EXPECT_NEAR(first.end[0], 0.04 / 0.5, 1e-4);
  EXPECT_EQ(simulate(p, test, rate, first.end).force, first.force)
      << "without a pause nothing is told of the test before";
  test.pause = 100.0;
  const Track second = simulate(p, test, rate, first.end);
  EXPECT_NEAR(second.end[0], 2.0 * first.end[0], 1e-4);
  for (std::size_t k = 0; k < second.force.size(); k += 100) {
    EXPECT_NEAR(second.force[k], first.force[k] * std::exp(-first.end[0]), 1e-4 * 800.0) << k;
  }
}

TEST(Truth, ModifiedBoucWenTurnsIntoBoucWenForAStiffDashpot) {
  Physics modified = bouc_wen();
  modified.law = Law::modified_bouc_wen;
  modified.c1 = 1e9;
  const Motioned test = sine(5e-3, 2.0, 1.0);
  EXPECT_LT(largest_difference(simulate(modified, test, rate).force, simulate(bouc_wen(), test, rate).force), 0.5);
}

TEST(Truth, ADamperThatIsTooStiffIsGivenUp) {
  Physics stiff = bouc_wen();
  stiff.A *= 1e9;  // a yield displacement of femtometres
  EXPECT_THROW(simulate(stiff, sine(5e-3, 2.0, 1.0), rate), TooStiff);
}

TEST(Truth, ResultDoesNotHangOnTheGrid) {
  Physics p = bouc_wen();
  add<DampedContact>(p, 4e-4, 1e7, 2e3);
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
  add<DampedContact>(p, 1e-3, 1e7, 2e3);
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
  add<KelvinVoigtCompliance>(p, 1e6, 0.0);
  const Track track = simulate(p, sine(1e-4, 20.0, 0.5), rate);
  EXPECT_NEAR(*std::ranges::max_element(track.force), 100.0, 2.0);
}

TEST(Truth, SeriesDashpotHalvesTheViscousForceOfItsEqual) {
  Physics p = bingham();
  p.alpha_a = 0.0;
  add<CheckedLeak>(p, 2000.0, 1.0);
  const Track track = simulate(p, sine(5e-3, 1.0, 1.0), rate);
  for (std::size_t k = 0; k < track.force.size(); k += 97) EXPECT_NEAR(track.force[k], 1000.0 * track.v[k], 1e-6);
}

TEST(Truth, AirPocketIsSoftAndHardens) {
  Physics p = bingham();
  add<AdiabaticPocket>(p, 1e-3, 50.0);
  const Track track = simulate(p, sine(5e-3, 1.0, 2.0), rate);
  Physics without = bingham();
  const Track plain = simulate(without, sine(5e-3, 1.0, 2.0), rate);
  // After the upper reversal the damper holds while the pocket gives way: the force passes zero after a travel of
  // L (1 - (1 + F / P)^(-1 / kappa)), 0.79 to 0.87 L for F of 400 to 800 N. At full speed it is that of the damper.
  std::size_t k = track.lead + static_cast<std::size_t>(1.25 * rate);
  const double top = track.x[k];
  while (track.force[k] > 0.0) ++k;
  EXPECT_GT(top - track.x[k], 0.79e-3);
  EXPECT_LT(top - track.x[k], 0.9e-3);
  const std::size_t fastest = track.lead + static_cast<std::size_t>(1.5 * rate);
  EXPECT_NEAR(track.force[fastest], plain.force[fastest], 0.02 * std::abs(plain.force[fastest]));
}

TEST(Truth, ParallelForcesAddUp) {
  const Motioned test = sine(1e-2, 2.0, 1.0);
  const Track plain = simulate(bouc_wen(), test, rate);
  Physics p = bouc_wen();
  add<MassOfPlace>(p, 3.0, 0.0, 1e-2);
  add<QuinticSpring>(p, 100.0, 1e-2, 0.0);
  add<SettlingPreload>(p, 20.0, 0.0, 1.0);
  add<LossyStop>(p, StopPlaces{8e-3, 8e-3}, 400.0, 2e-3, 0.0);
  add<SettlingDrift>(p, 50e3, 1e3);
  const Track with = simulate(p, test, rate);
  for (std::size_t k = 0; k < plain.force.size(); k += 101) {
    const double t = (static_cast<double>(k) - static_cast<double>(plain.lead)) / rate;
    const Kinematics m = test.motion.at(t);
    const double past = std::max(std::abs(m.x) - 8e-3, 0.0) / 2e-3;
    const double expected = 3.0 * m.a + 1e8 * m.x * m.x * m.x + 20.0 + 50e3 * -std::expm1(-std::max(t, 0.0) / 1e3) +
                            400.0 * std::pow(past, 1.5) * (m.x < 0.0 ? -1.0 : 1.0);
    EXPECT_NEAR(with.force[k] - plain.force[k], expected, 0.05) << t;
  }
}

TEST(Truth, StopsOutOfReachAndLagOfAConstantCurrentChangeNothing) {
  const Motioned test = sine(1e-2, 2.0, 1.0);
  Physics p = bouc_wen();
  p.alpha_b = 300.0;
  const Track plain = simulate(p, test, rate);
  add<ClosingStop>(p, StopPlaces{1.01e-2, 1.01e-2}, 1e5, 1e-3);
  add<EddyCoil>(p, 0.05, 0.2, 0.3);
  add<JilesRemanence>(p, 0.3);
  EXPECT_EQ(largest_difference(simulate(p, test, rate).force, plain.force), 0.0);
}

TEST(Truth, CoilLagFollowsAStepExponentially) {
  Physics p = bingham();
  p.c_a = 0.0;
  p.alpha_a = 0.0;
  p.alpha_b = 1000.0;
  add<EddyCoil>(p, 0.05, 0.1, 0.0);
  Motioned test = sine(2e-2, 0.5, 0.9);  // the speed keeps its sign until 0.5 s
  test.motion.sines[0].phase = -1.4;
  test.lead = 0.01;
  test.drive = {{0.0, 0.2, 0.5}, {0.0, 1.0, 0.0}, 1e-5};
  const Track track = simulate(p, test, rate);
  const auto at = [&](double t) { return track.force[track.lead + static_cast<std::size_t>(std::lround(t * rate))]; };
  EXPECT_NEAR(at(0.25), 1000.0 * (1.0 - std::exp(-1.0)), 3.0);
  const double top = 1000.0 * (1.0 - std::exp(-6.0));
  EXPECT_NEAR(at(0.55), top * std::exp(-1.0), 3.0);
}

TEST(Truth, RemanenceKeepsTheFieldAboveAfterAStepDown) {
  Physics p = bingham();
  p.c_a = 0.0;
  p.alpha_a = 0.0;
  p.alpha_b = 1000.0;
  Motioned test = sine(2e-2, 0.5, 0.9);
  test.motion.sines[0].phase = -1.4;
  test.drive = {{0.0, 0.2, 0.5}, {0.2, 1.0, 0.2}, 1e-4};
  const auto levels = [&](const PartPointer& part) {
    Physics with = p;
    with.parts = {part};
    const Track track = simulate(with, test, rate);
    const auto at = [&](double t) { return track.force[track.lead + static_cast<std::size_t>(std::lround(t * rate))]; };
    return std::pair(at(0.4), at(0.8));
  };
  // Plays of 0.025, 0.075, 0.125 and 0.175 A lag by their mean.
  const auto [up, down] = levels(std::make_shared<PlaysRemanence>(0.1));
  EXPECT_NEAR(up, 900.0, 1.0);
  EXPECT_NEAR(down, 300.0, 1.0);
  // Over a path of 0.8 A the field follows all but exp(-8), and lags by 0.1 A.
  const auto [risen, fallen] = levels(std::make_shared<JilesRemanence>(0.1));
  EXPECT_NEAR(risen, 900.0, 2.0);
  EXPECT_NEAR(fallen, 300.0, 2.0);
  // d = 0.8 A from the last turn.
  const auto [above, below] = levels(std::make_shared<LastExtremeRemanence>(0.1));
  EXPECT_NEAR(above, 1000.0 - 100.0 * 0.8 / 0.9, 1.0);
  EXPECT_NEAR(below, 200.0 + 100.0 * 0.8 / 0.9, 1.0);
}

TEST(Truth, PartedColumnLimitsOneSideAndDwells) {
  Physics p = bingham();
  add<PartedColumn>(p, 850.0, 1e7, 1e-4);
  const Track track = simulate(p, sine(1e-2, 2.0, 1.0), rate);
  EXPECT_NEAR(*std::ranges::min_element(track.force), -850.0, 1.0);
  EXPECT_GT(*std::ranges::max_element(track.force), 1000.0);
  // 5 ms after the lower reversal the void has not closed.
  EXPECT_NEAR(track.force[track.lead + static_cast<std::size_t>(0.38 * rate)], 0.0, 1.0);
}

TEST(Truth, HeatAndWearLowerTheForceMonotonically) {
  for (const bool heat : {true, false}) {
    Physics p = bouc_wen();
    if (heat) {
      add<YieldHeat>(p, 250.0, 60.0, 1.0);
    } else {
      add<EnergyWear>(p, 0.8, 100.0);
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

// Two springs in a row are one of their compliances' sum; a spring and a dashpot in a row creep by F / c.
TEST(Truth, ElementsInARowAddTheirStretches) {
  const Motioned test = sine(5e-3, 1.0, 1.0);
  Physics two = bouc_wen();
  add<AeratedOil>(two, 2e6, 1e3);  // so long that it is linear
  add<AeratedOil>(two, 2e6, 1e3);
  Physics one = bouc_wen();
  add<KelvinVoigtCompliance>(one, 1e6, 0.0);
  EXPECT_LT(largest_difference(simulate(two, test, rate).force, simulate(one, test, rate).force), 0.5);
  // Behind a stiff spring the dashpot is as it is alone, once the spring is stretched: 10 um at 1 kN, where the knee
  // has a slope of 1.6 N/um.
  Physics row = bouc_wen();
  add<CheckedLeak>(row, 2e4, 1.0);
  add<AeratedOil>(row, 1e8, 1e3);
  Physics alone = bouc_wen();
  add<CheckedLeak>(alone, 2e4, 1.0);
  const Track stiff = simulate(row, test, rate);
  const Track rigid = simulate(alone, test, rate);
  const Track without = simulate(bouc_wen(), test, rate);
  double difference = 0.0;
  double effect = 0.0;
  for (std::size_t k = stiff.lead; k < stiff.force.size(); ++k) {
    difference = std::max(difference, std::abs(stiff.force[k] - rigid.force[k]));
    effect = std::max(effect, std::abs(without.force[k] - rigid.force[k]));
  }
  EXPECT_LT(difference, 25.0);
  EXPECT_GT(effect, 100.0);
}

TEST(Truth, OnlyWhatAForceBalanceAllowsStandsInSeries) {
  using enum InSeries;
  EXPECT_TRUE(can_stand_in_series({none, whole, none}));
  EXPECT_TRUE(can_stand_in_series({elastic, elastic}));
  EXPECT_TRUE(can_stand_in_series({dashpot, none, elastic}));
  EXPECT_FALSE(can_stand_in_series({dashpot, dashpot}));
  EXPECT_FALSE(can_stand_in_series({whole, elastic}));
  EXPECT_FALSE(can_stand_in_series({elastic, elastic, elastic}));
}

TEST(Truth, MechanismsOfEveryKindRunTogether) {
  Physics p = bouc_wen();
  p.alpha_b = 300.0;
  add<AeratedOil>(p, 3e6, 1e-3);
  add<CheckedLeak>(p, 5e4, 1.5);
  add<DampingHeat>(p, 100.0, 60.0, 0.5);
  add<DampingAsymmetry>(p, 0.2, 5e-3);
  add<SealLugre>(p, 20.0, 40.0, 5e-3, 4e-5);
  add<EddyCoil>(p, 0.02, 0.1, 0.3);
  add<RigRinging>(p, 0.3, 150.0, 0.05);
  add<ForceBessel>(p, 0.003);
  const Track track = simulate(p, sine(1e-2, 2.0, 2.0), rate);
  for (const double f : track.force) {
    ASSERT_TRUE(std::isfinite(f));
    ASSERT_LT(std::abs(f), 2500.0);
  }
  EXPECT_GT(*std::ranges::max_element(track.force), 800.0);
}

TEST(Chain, DelayShiftsTheForceAndTheFilterNothingElse) {
  Physics p = bouc_wen();
  const Motioned test = sine(1e-2, 1.0, 1.0);
  const Track track = simulate(p, test, rate);
  const std::vector<double> now = clean_force(p, track, 8);
  add<ForceTransport>(p, 0.01);
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
  add<VelocityTransport>(p, 0.01);
  const Measured late = measure(p, track, 8, chain, range, Stream(1));
  EXPECT_EQ(plain.force, late.force);
  for (std::size_t k = 5; k < plain.v.size(); ++k) EXPECT_NEAR(late.v[k], plain.v[k - 5], 1e-9);
}

}  // namespace
}  // namespace hysteron::challenge

// Every form against a closed form or a limit of its equation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "challenge/dormand_prince.hpp"
#include "challenge/effects.hpp"
#include "challenge/forms_electric.hpp"
#include "challenge/forms_fluid.hpp"
#include "challenge/forms_foreign.hpp"
#include "challenge/forms_friction.hpp"
#include "challenge/forms_series.hpp"
#include "challenge/forms_slow.hpp"
#include "challenge/forms_springs.hpp"
#include "io/file.hpp"

namespace hysteron::challenge {
namespace {

constexpr double pi = std::numbers::pi;

Moment at(double x, double v, double a = 0.0, double t = 1.0) {
  Moment m;
  m.t = t;
  m.rod = {x, v, a};
  m.x = x;
  m.v = v;
  m.branch = v < 0.0 ? -1.0 : 1.0;
  return m;
}

// The states of a part after a motion, by Dormand-Prince in short pieces; `see` is told every moment.
using States = std::array<double, 8>;
States after(const Part& part, double end, const std::function<Moment(double)>& motion,
             const std::function<void(const Moment&, const States&)>& see = {}) {
  States s{};
  States scale;
  scale.fill(1.0);
  part.scales({}, scale.data());
  part.start(motion(0.0), s.data());
  double step = 1e-4;
  constexpr int pieces = 4000;
  for (int k = 0; k < pieces; ++k) {
    advance(s, end * k / pieces, end * (k + 1) / pieces, step, 1e-9, scale, [&](double t, const States& now) {
      States d{};
      part.rate(motion(t), now.data(), d.data());
      return d;
    });
    const Moment m = motion(end * (k + 1) / pieces);
    part.settle(m, s.data());
    if (see) see(m, s);
  }
  return s;
}

std::function<Moment(double)> sine(double amplitude, double frequency) {
  const double w = 2.0 * pi * frequency;
  return [=](double t) {
    return at(amplitude * std::sin(w * t), amplitude * w * std::cos(w * t), -amplitude * w * w * std::sin(w * t), t);
  };
}

TEST(Forms, EveryEffectHasThreeAndNoneTwice) {
  std::vector<std::string> ids;
  int foreign = 0;
  for (const HiddenEffect& effect : hidden_effects()) {
    foreign += effect.foreign ? 1 : 0;
    EXPECT_GE(effect.forms.size(), effect.foreign ? 1U : 3U) << effect.id;
    for (const HiddenForm& form : effect.forms) {
      EXPECT_TRUE(form.id == effect.id || form.id.starts_with(std::string(effect.id) + "/")) << form.id;
      EXPECT_EQ(hidden_form(form.id).form, &form);
      ids.push_back(form.id);
      // The card and the part agree on what stands in series.
      const PartPointer part = form.make({}, effect.least, Draws(Stream(1)));
      EXPECT_EQ(part->chain(), form.chain) << form.id;
      EXPECT_LE(part->states(), 8U) << form.id;
    }
  }
  EXPECT_GE(foreign, 12);
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

TEST(Forms, TheirPageHoldsThemAll) {
  const std::string page = read_file(HYSTERON_SOURCE_DIR "/docs/challenge.md");
  for (const HiddenEffect& effect : hidden_effects()) {
    for (const HiddenForm& form : effect.forms) {
      EXPECT_NE(page.find("| " + form.id + " "), std::string::npos) << form.id;
      EXPECT_NE(page.find("| " + std::string(form.words) + " "), std::string::npos) << form.words;
    }
  }
}

TEST(Forms, OneSlipElementIsElasticPlastic) {
  SlipElements<1> one{1e-3};
  double s = 0.0;
  const auto move = [&](double by) {
    for (int k = 0; k < 1000; ++k) {
      double d = 0.0;
      one.rate(by, &s, &d);
      s += d / 1000.0;
      one.settle(&s);
    }
  };
  move(0.5e-3);
  EXPECT_NEAR(one.engaged(&s), 0.5, 1e-3);
  move(2e-3);
  EXPECT_NEAR(one.engaged(&s), 1.0, 1e-12);
  move(-1e-3);  // back by its limit: no force
  EXPECT_NEAR(one.engaged(&s), 0.0, 2e-3);
  move(-5e-3);
  EXPECT_NEAR(one.engaged(&s), -1.0, 1e-12);
}

TEST(Forms, FrictionTendsToCoulombAtSpeed) {
  const CoulombFilm film(100.0, 1e-4);
  EXPECT_NEAR(film.beside(at(0.0, 0.1), nullptr), 100.0, 0.1);
  EXPECT_NEAR(film.beside(at(0.0, -0.1), nullptr), -100.0, 0.1);
  const CoulombMaxwellSlip slip(100.0, 1e-4);
  EXPECT_NEAR(slip.beside({}, after(slip, 0.2, sine(1e-2, 1.0)).data()), 100.0, 1e-9);
  // A decade of speed adds b ln 10.
  const CoulombRateHardening hard(100.0, 1e-5, 0.05);
  EXPECT_NEAR(hard.beside(at(0.0, 0.1), nullptr) - hard.beside(at(0.0, 0.01), nullptr), 5.0 * std::log(10.0), 0.01);
}

TEST(Forms, SealFrictionFallsFromStaticToCoulomb) {
  const SealLugre lugre(100.0, 180.0, 5e-3, 2e-5);
  EXPECT_NEAR(180.0 * lugre.level(0.0), 180.0, 1e-12);
  EXPECT_NEAR(180.0 * lugre.level(0.5), 100.0, 1e-9);
  // At a steady speed the bristles carry the level of that speed.
  const auto steady = [](double t) { return at(4e-3 * t, 4e-3, 0.0, t); };
  EXPECT_NEAR(lugre.beside({}, after(lugre, 0.5, steady).data()), 100.0 + 80.0 * std::exp(-0.8), 0.01);
  const SealFilm film(100.0, 80.0, 5e-3, 1e-5);
  EXPECT_NEAR(film.beside(at(0.0, 5e-3), nullptr), 140.0, 1e-6);
  const SealMaxwellSlip slip(100.0, 80.0, 5e-3, 1e-5);
  const States s = after(slip, 0.5, steady);
  EXPECT_NEAR(slip.beside(at(0.0, 5e-3), s.data()), 100.0 + 80.0 * std::exp(-1.0), 1e-6);
}

TEST(Forms, PreYieldSaturatesAtItsForce) {
  const auto forward = [](double t) { return at(t, 1.0, 0.0, t); };
  const PreYieldIwan iwan(50.0, 1e-3);
  EXPECT_NEAR(iwan.beside({}, after(iwan, 0.01, forward).data()), 50.0, 1e-9);
  const PreYieldSharpKnee knee(50.0, 1e-3, 2.0);
  // n = 2, loading: z = tanh(x / x_y).
  EXPECT_NEAR(knee.beside({}, after(knee, 7e-4, forward).data()), 50.0 * std::tanh(0.7), 1e-4);
  const PreYieldCreeping creeping(50.0, 1e-3, 0.5);
  // At rest: exponential with T.
  States s{};
  s[0] = 0.8;
  double d = 0.0;
  creeping.rate(at(0.0, 0.0), s.data(), &d);
  EXPECT_NEAR(d, -1.6, 1e-12);
}

TEST(Forms, PreloadsAreTheirForceInTheMiddle) {
  EXPECT_NEAR(ScatteringPreload(20.0, {0.1, -0.1}).beside(at(0.3, 1.0), nullptr), 22.0, 1e-12);
  const SettlingPreload settling(20.0, 0.25, 2.0);
  EXPECT_NEAR(settling.beside(at(0.0, 0.0, 0.0, -1.0), nullptr), 20.0, 1e-12);
  EXPECT_NEAR(settling.beside(at(0.0, 0.0, 0.0, 1e3), nullptr), 15.0, 1e-9);
  EXPECT_NEAR(SoftSpringPreload(20.0, 0.5).beside(at(0.1, 0.0), nullptr), 24.0, 1e-12);
}

TEST(Forms, SpringsHaveTheirSlopesAndLimits) {
  EXPECT_NEAR(SofteningSpring(1e4, 0.1).beside(at(0.05, 0.0), nullptr), 500.0 * 0.75, 1e-9);
  EXPECT_NEAR(UnequalSpring(1e4, 0.1).beside(at(-0.01, 0.0), nullptr), -90.0, 1e-9);
  // Fast: k (1 + a); slow: k.
  const ElastomerSpring rubber(1e4, 0.5, 0.1);
  double fast = 0.0;
  after(rubber, 0.01, sine(1e-2, 25.0), [&](const Moment& m, const States& s) { fast = rubber.beside(m, s.data()); });
  EXPECT_NEAR(fast, 150.0, 4.0);
  // Odd, and to third order in the stroke cubic beside their linear part.
  for (const double x : {0.001, -0.004}) {
    EXPECT_NEAR(SinhSpring(10.0, 0.01).beside(at(x, 0.0), nullptr), 10.0 * std::sinh(x / 0.01), 1e-12);
    EXPECT_NEAR(TangentSpring(10.0, 0.01).beside(at(x, 0.0), nullptr), 10.0 * std::tan(0.5 * pi * x / 0.01), 1e-9);
  }
  const QuinticSpring quintic(10.0, 0.01, 0.4);
  EXPECT_NEAR(quintic.beside(at(0.01, 0.0), nullptr), 10.0, 1e-12);
  EXPECT_NEAR(quintic.beside(at(0.005, 0.0), nullptr), 10.0 * 0.125 * (0.6 + 0.1), 1e-12);
}

TEST(Forms, GasObeysBoyleAndPoissonInItsLimits) {
  const double g = 30.0;
  double worst_slow = 0.0;
  double worst_fast = 0.0;
  const HeatExchangingGas slow(100.0, g, 1.4, 1e-3);
  after(slow, 2.0, sine(1e-2, 0.5), [&](const Moment& m, const States& s) {
    worst_slow = std::max(worst_slow, std::abs(slow.beside(m, s.data()) / 100.0 * (1.0 - g * m.rod.x) - 1.0));
  });
  EXPECT_LT(worst_slow, 2e-3);
  const HeatExchangingGas fast(100.0, g, 1.4, 1e6);
  after(fast, 2.0, sine(1e-2, 0.5), [&](const Moment& m, const States& s) {
    worst_fast =
        std::max(worst_fast, std::abs(fast.beside(m, s.data()) / 100.0 * std::pow(1.0 - g * m.rod.x, 1.4) - 1.0));
  });
  EXPECT_LT(worst_fast, 1e-5);
  // Without solubility p V = 1; with it less gas under pressure once it has settled: n = (1 + H) / (1 + H / V).
  const auto held = [](double t) { return at(1e-2, 0.0, 0.0, t); };
  EXPECT_NEAR(DissolvedGas(100.0, g, 0.0, 0.1).beside(at(1e-2, 0.0), std::array{1.0}.data()), 100.0 / 0.7, 1e-9);
  const DissolvedGas soluble(100.0, g, 0.3, 0.1);
  EXPECT_NEAR(after(soluble, 3.0, held)[0], 1.3 / (1.0 + 0.3 / 0.7), 1e-6);
  EXPECT_NEAR(OneSidedGas(100.0, g, 2e-3).beside(at(-5e-3, 0.0), nullptr), 100.0, 1e-12);
  EXPECT_NEAR(OneSidedGas(100.0, g, 0.0).beside(at(1e-2, 0.0), nullptr), 100.0 / 0.7, 1e-9);
  const ElasticBagGas bag(1.0, g, 0.2);
  const double p = bag.pressure(1e-2);
  EXPECT_NEAR(p * (0.7 + 0.2 * (p - 1.0)), 1.0, 1e-12);
  EXPECT_NEAR(ElasticBagGas(1.0, g, 1e-6).pressure(1e-2), 1.0 / 0.7, 1e-4);
}

TEST(Forms, StopsDoNothingInsideTheirPlaces) {
  const StopPlaces places{8e-3, 6e-3};
  const ExponentialStop exponential(places, 100.0, 1e-3);
  const LossyStop lossy(places, 100.0, 1e-3, 2.0);
  const ClosingStop closing(places, 100.0, 2e-3);
  for (const Part* stop :
       {static_cast<const Part*>(&exponential), static_cast<const Part*>(&lossy), static_cast<const Part*>(&closing)}) {
    EXPECT_EQ(stop->beside(at(7.9e-3, 1.0), nullptr), 0.0);
    EXPECT_EQ(stop->beside(at(-5.9e-3, 1.0), nullptr), 0.0);
  }
  EXPECT_NEAR(exponential.beside(at(9e-3, 0.0), nullptr), 100.0 * (std::numbers::e - 1.0), 1e-9);
  EXPECT_NEAR(lossy.beside(at(9e-3, 0.1), nullptr), 120.0, 1e-9);
  EXPECT_NEAR(lossy.beside(at(-7e-3, 0.1), nullptr), -80.0, 1e-9);
  EXPECT_NEAR(closing.beside(at(-7e-3, 0.0), nullptr), -100.0, 1e-9);
}

TEST(Forms, MassesAreMassesWhereTheyAreSmallCorrections) {
  EXPECT_NEAR(MassOfPlace(2.0, 0.0, 1e-2).beside(at(3e-3, 0.2, 7.0), nullptr), 14.0, 1e-12);
  // Work of a mass of place over a closed path is none: its kinetic energy is m(x) v^2 / 2.
  const MassOfPlace of_place(2.0, 0.4, 1e-2);
  double work = 0.0;
  after(of_place, 1.0, sine(1e-2, 2.0),
        [&](const Moment& m, const States&) { work += of_place.beside(m, nullptr) * m.rod.v * 1.0 / 4000.0; });
  EXPECT_NEAR(work, 0.0, 1e-6);
  // Far below its resonance, after the transient.
  const SprungMass sprung(2.0, 300.0, 0.3);
  double worst = 0.0;
  after(sprung, 1.0, sine(1e-2, 2.0), [&](const Moment& m, const States& s) {
    if (m.t > 0.5) worst = std::max(worst, std::abs(sprung.beside(m, s.data()) - 2.0 * m.rod.a));
  });
  EXPECT_LT(worst, 0.05 * 2.0 * 1e-2 * std::pow(4.0 * pi, 2.0));
  // At a steady acceleration the entrained fluid comes along in full.
  const EntrainedMass entrained(2.0, 0.5, 0.02, 0.1);
  const auto steady = [](double t) { return at(0.0, 3.0 * t, 3.0, t); };
  EXPECT_NEAR(entrained.beside(at(0.0, 0.0, 3.0), after(entrained, 2.0, steady).data()), 2.0 * 1.5 * 3.0, 1e-5);
}

TEST(Forms, DragsTendToTheirLaws) {
  EXPECT_NEAR(EddyDrag(100.0, 1.0).beside(at(0.0, 1.0), nullptr), 50.0, 1e-12);  // the peak of a magnetic brake
  EXPECT_NEAR(AmbientDrag(100.0, {0.2}).beside(at(0.0, 0.5), nullptr), 60.0, 1e-12);
  const ViscoelasticDrag soft(100.0, 0.01);
  const auto steady = [](double t) { return at(0.0, 0.3, 0.0, t); };
  EXPECT_NEAR(soft.beside({}, after(soft, 0.5, steady).data()), 30.0, 1e-9);
  // Twice the speed: 2^1.75.
  const TurbulentDrag turbulent(100.0, 0.2);
  EXPECT_NEAR(turbulent.fluid({}, nullptr, -0.4), -100.0 * std::pow(2.0, 1.75), 1e-9);
  const TransitionDrag transition(100.0, 0.2, 0.05);
  EXPECT_NEAR(transition.fluid({}, nullptr, 1e-4) / 1e-4, 100.0 * 0.05 / 0.04, 0.01);
  EXPECT_NEAR(transition.fluid({}, nullptr, 2.0), 100.0 * 100.0, 5.0);
  EXPECT_NEAR(ShimDrag(100.0, 0.2, 0.2).fluid({}, nullptr, 0.2), 50.0, 1e-12);
}

TEST(Forms, ThinningRunsFromANewtonianPlateauToItsPowerLaw) {
  const PowerLawThinning power(0.5, 0.1, 0.4);
  const CrossThinning cross(0.5, 0.1, 1.0);
  const CarreauYasudaThinning carreau(0.5, 0.1, 0.2, 4.0);
  const PapanastasiouThinning plastic(0.5, 0.1);
  const EyringThinning eyring(0.5, 0.1);
  for (const Thinning* law : {static_cast<const Thinning*>(&power), static_cast<const Thinning*>(&cross),
                              static_cast<const Thinning*>(&carreau), static_cast<const Thinning*>(&plastic),
                              static_cast<const Thinning*>(&eyring)}) {
    EXPECT_NEAR(law->damping({}, nullptr, 0.0), 1.0, 1e-12);
    EXPECT_NEAR(law->damping({}, nullptr, 1e-7), 1.0, 1e-5);
    double before = 1.0;
    for (double v = 0.01; v < 10.0; v *= 1.5) {
      const double now = law->damping({}, nullptr, v);
      EXPECT_LE(now, before);
      EXPECT_GE(now, 0.5);
      EXPECT_EQ(now, law->damping({}, nullptr, -v));
      before = now;
    }
  }
  // Far above v_c the slopes on logarithms are m - 1 and the like.
  const auto slope = [](const Thinning& law) { return std::log(law.shape(1e5) / law.shape(1e4)) / std::log(10.0); };
  EXPECT_NEAR(slope(power), -0.6, 1e-9);
  EXPECT_NEAR(slope(carreau), -0.8, 1e-3);
  EXPECT_NEAR(slope(cross), -1.0, 1e-3);
  EXPECT_NEAR(slope(plastic), -1.0, 1e-9);
  EXPECT_NEAR(eyring.shape(1e5) * 1e5, std::log(2e5), 1e-6);
}

TEST(Forms, AsymmetryIsTheDifferenceOfBothSenses) {
  const DampingAsymmetry damping(0.3, 1e-3);
  EXPECT_NEAR(damping.damping({}, nullptr, 0.1) - damping.damping({}, nullptr, -0.1), 0.6, 1e-12);
  EXPECT_NEAR(damping.damping({}, nullptr, 1e-5), 1.003, 1e-6);
  const YieldAsymmetry yield(0.3);
  EXPECT_NEAR(yield.yield(at(0.0, 1.0), nullptr) - yield.yield(at(0.0, -1.0), nullptr), 0.6, 1e-12);
  const UnequalAsymmetry both(0.3, 0.5);
  EXPECT_NEAR(both.yield(at(0.0, 1.0), nullptr), 1.3, 1e-12);
  EXPECT_NEAR(both.damping({}, nullptr, -0.1), 0.85, 1e-12);
  const SmoothAsymmetry smooth(0.3, 1e-3);
  EXPECT_NEAR(smooth.whole({}, nullptr, -0.1, -100.0), -70.0, 1e-9);
  EXPECT_NEAR(smooth.whole({}, nullptr, 0.0, 100.0), 100.0, 1e-12);
}

TEST(Forms, PinchesTakeTheirShareAtTheirPlaceAndNothingFarAway) {
  const RationalPinch rational(0.4, 1e-3, 2e-3);
  EXPECT_NEAR(rational.whole(at(1e-3, 0.0), nullptr, 0.0, 100.0), 60.0, 1e-12);
  EXPECT_NEAR(rational.whole(at(1.0, 0.0), nullptr, 0.0, 100.0), 100.0, 1e-6);
  const OneSidedPinch one_sided(0.4, 1e-3, 2e-4);
  EXPECT_NEAR(one_sided.whole(at(1e-2, 0.0), nullptr, 0.0, 100.0), 60.0, 1e-6);
  EXPECT_NEAR(one_sided.whole(at(-1e-2, 0.0), nullptr, 0.0, 100.0), 100.0, 1e-6);
  const GroovePinch groove(0.4, 1e-3, 2e-3);
  EXPECT_NEAR(groove.whole(at(1e-3, 0.0), nullptr, 0.0, 100.0), 60.0, 1e-12);
  EXPECT_EQ(groove.whole(at(3.1e-3, 0.0), nullptr, 0.0, 100.0), 100.0);
}

TEST(Forms, HeatIsTheStoredWork) {
  const auto working = [](double t) {
    Moment m = at(0.0, 0.5, 0.0, t);
    m.core = 200.0;
    return m;
  };
  // 100 W for 2 s into 400 J without cooling.
  const DampingHeat damping(400.0, 1e9, 1.2);
  const States s = after(damping, 2.0, working);
  EXPECT_NEAR(damping.damping({}, s.data(), 0.1), std::exp(-0.6), 1e-6);
  EXPECT_NEAR(YieldHeat(400.0, 1e9, 1.0).yield({}, s.data()), 1.0 / 1.5, 1e-6);
  const ArrheniusHeat arrhenius(400.0, 1e9, 1.0, 0.5);
  EXPECT_NEAR(arrhenius.damping({}, s.data(), 0.1), std::exp(-0.5 / (1.0 + 0.5 / 8.0)), 1e-6);
  EXPECT_NEAR(arrhenius.yield({}, s.data()), std::sqrt(arrhenius.damping({}, s.data(), 0.1)), 1e-12);
  // Two stores without exchange are one.
  const TwoStoreHeat apart(400.0, 1e9, 1e9, 0.2, 1.2, 0.5);
  EXPECT_NEAR(after(apart, 2.0, working)[0], s[0], 1e-6);
  // With quick exchange the fluid and a body of five times its capacity share the heat.
  EXPECT_NEAR(after(TwoStoreHeat(400.0, 1e-3, 1e9, 0.2, 1.2, 0.5), 2.0, working)[0], s[0] / 6.0, 2e-3);
}

TEST(Forms, WearAndStictionCountWhatTheySayTheyCount) {
  const auto working = [](double t) {
    Moment m = at(0.0, 0.5, 0.0, t);
    m.core = 200.0;
    return m;
  };
  const EnergyWear energy(0.6, 100.0);
  EXPECT_NEAR(energy.whole({}, after(energy, 1.0, working).data(), 0.0, 10.0), 10.0 - 6.0 * (1.0 - std::exp(-1.0)),
              1e-6);
  const PathWear path(2.0);
  EXPECT_NEAR(path.whole({}, after(path, 1.0, working).data(), 0.0, 10.0), 10.0 * std::exp(-0.25), 1e-6);
  // Ten periods of a sine have twenty turns.
  const CycleWear cycles(0.01, 1e-4);
  EXPECT_NEAR(cycles.whole({}, after(cycles, 10.0, sine(1e-2, 1.0)).data(), 0.0, 10.0), 10.0 / 1.2, 1e-3);
  const PathStiction stiction(0.4, 0.25);
  EXPECT_NEAR(stiction.whole({}, after(stiction, 0.5, working).data(), 0.0, 10.0), 10.0 * (1.0 + 0.4 / 4.0), 1e-6);
  EXPECT_NEAR(TimeStiction(0.4, 0.5).whole(at(0.0, 0.0, 0.0, 0.5), nullptr, 0.0, 10.0),
              10.0 * (1.0 + 0.4 * std::exp(-1.0)), 1e-9);
  // Rest builds up what a balance of both leaves: (1 / T) / (1 / T + |v| / L).
  const ThixotropicStiction thixotropic(0.4, 0.05, 0.4);
  EXPECT_NEAR(after(thixotropic, 5.0, working)[0], 2.5 / 12.5, 1e-6);
}

TEST(Forms, DriftsBeginAtNothing) {
  const SettlingDrift settling(10.0, 2.0);
  const SlowSineDrift slow(10.0, 0.3, 1.0);
  const WalkDrift walk(10.0, 0.3, {0.1, 0.7, 2.0, 3.0, 1.0, 1.5, 0.2, 5.0});
  for (const Part* drift :
       {static_cast<const Part*>(&settling), static_cast<const Part*>(&slow), static_cast<const Part*>(&walk)}) {
    EXPECT_NEAR(drift->beside(at(0.0, 0.0, 0.0, 0.0), nullptr), 0.0, 1e-12);
    EXPECT_NE(drift->beside(at(0.0, 0.0, 0.0, 3.0), nullptr), 0.0);
  }
  EXPECT_NEAR(settling.beside(at(0.0, 0.0, 0.0, 1e3), nullptr), 10.0, 1e-9);
  EXPECT_NEAR(slow.beside(at(0.0, 0.0, 0.0, 2.0), nullptr), 10.0 * (std::sin(1.6) - std::sin(1.0)), 1e-12);
  Moment other = at(0.0, 0.0, 0.0, 3.0);
  other.test = 1;
  EXPECT_NE(walk.beside(other, nullptr), walk.beside(at(0.0, 0.0, 0.0, 3.0), nullptr));
}

TEST(Forms, SeriesElementsRiseWithTheStretchAndHaveTheirPlateaus) {
  for (const HiddenEffect& effect : hidden_effects()) {
    for (const HiddenForm& form : effect.forms) {
      if (form.chain != InSeries::elastic) continue;
      const PartPointer part = form.make({}, 0.1, Draws(Stream(3)));
      double before = -1e300;
      for (int k = -200; k <= 200; ++k) {
        const double now = part->series({}, nullptr, 2e-5 * k, 0.0);
        EXPECT_GE(now, before) << form.id;
        before = now;
      }
      EXPECT_EQ(part->series({}, nullptr, 0.0, 0.0), 0.0) << form.id;
    }
  }
  EXPECT_EQ(HertzContact(1e-3, 1e3, 1e-4).pull(-0.5e-3), 0.0);
  EXPECT_NEAR(HertzContact(1e-3, 1e3, 1e-4).pull(-0.6e-3), -1e3, 1e-6);
  EXPECT_EQ(OffCentreContact(1e-3, 1e6, 0.2).pull(0.2e-3), 0.0);
  EXPECT_NEAR(OffCentreContact(1e-3, 1e6, 0.2).pull(-0.9e-3), -100.0, 1e-6);
  EXPECT_NEAR(RubbingContact(1e-3, 1e6, 20.0, 1e-4).series({}, nullptr, 0.0, 0.1), 20.0, 1e-9);
  EXPECT_NEAR(DampedContact(1e-3, 1e6, 1e3).series({}, nullptr, 0.6e-3, 0.0), 100.0, 1e-6);
  EXPECT_EQ(DampedContact(1e-3, 1e6, 1e3).series({}, nullptr, 0.6e-3, -1.0), 0.0);
  // Tangent stiffnesses at no force, and hardening.
  EXPECT_NEAR(HardeningCompliance(1e6, 1e-3).pull(1e-3), 2e3, 1e-6);
  EXPECT_NEAR(AeratedOil(1e6, 1e-3).pull(1e-9), 1e-3, 1e-8);
  EXPECT_NEAR(KelvinVoigtCompliance(1e6, 2e-3).series({}, nullptr, 1e-3, 0.5), 2e3, 1e-6);
  // Boyle and Poisson: the force at half the length is P (2^kappa - 1).
  EXPECT_NEAR(IsothermalPocket(1e-3, 50.0).pull(0.5e-3), 50.0, 1e-9);
  EXPECT_NEAR(AdiabaticPocket(1e-3, 50.0).pull(-0.5e-3), -50.0 * (std::pow(2.0, 1.4) - 1.0), 1e-9);
  EXPECT_NEAR(OneChamberPocket(1e-3, 50.0, 1e7, 1.0).pull(-1e-5), -100.0, 1e-9);
  const DissolvingPocket pocket(1e-3, 50.0, 0.1, 0.05);
  const auto pressed = [](double t) {
    Moment m = at(0.0, 0.0, 0.0, t);
    m.core = 500.0;
    return m;
  };
  EXPECT_NEAR(after(pocket, 2.0, pressed)[0], 0.5, 1e-6);
  // A suction that cannot fall below none.
  EXPECT_NEAR(VacuumColumn(800.0, 1e-4).pull(-1.0), -800.0, 0.1);
  EXPECT_NEAR(PartedColumn(800.0, 1e7, 1e-4).series({}, nullptr, -5e-3, -1.0), -800.0, 1e-6);
  EXPECT_NEAR(PartedColumn(800.0, 1e7, 1e-4).series({}, nullptr, -5e-3, 1.0), 0.0, 1e-6);
  EXPECT_NEAR(ChokedSuction(800.0, 6.0).whole({}, nullptr, -1.0, -1e5), -800.0, 0.1);
  EXPECT_EQ(ChokedSuction(800.0, 6.0).whole({}, nullptr, 1.0, 1e5), 1e5);
}

TEST(Forms, DashpotsAreTheirOwnInverses) {
  const OrificeLeak orifice(0.02, 1e3);
  const CheckedLeak check(5e4, 1.6);
  for (const double f : {-900.0, -3.0, 40.0, 2000.0}) {
    EXPECT_NEAR(orifice.series({}, nullptr, 0.0, orifice.creep(f)), f, 1e-6 * std::abs(f));
    EXPECT_NEAR(check.series({}, nullptr, 0.0, check.creep(f)), f, 1e-6 * std::abs(f));
  }
  EXPECT_NEAR(check.creep(100.0) / check.creep(-100.0), -1.6, 1e-12);
  EXPECT_NEAR(ReturningLeak(5e4, 1e3).series({}, nullptr, 1e-2, 1e-3), 60.0, 1e-9);
  // A standard solid that is held relaxes to its spring.
  const StandardSolidCompliance solid(1e6, 0.5, 0.05);
  States s{};
  s[0] = 1e-3;
  double d = 0.0;
  solid.rate(at(0.0, 0.0), s.data(), &d);
  EXPECT_NEAR(d, -1e-3 / 0.05, 1e-12);
  EXPECT_NEAR(solid.series({}, s.data(), 1e-3, 0.0), 1500.0, 1e-9);
}

TEST(Forms, CurvesOfMagnetisationHaveSlopeOneAndALimit) {
  const ArctanSaturation arctan(2.0);
  const LangevinSaturation langevin(2.0);
  const FroehlichSaturation froehlich(2.0);
  const KneeSaturation knee(2.0);
  for (const SaturationCurve* curve :
       {static_cast<const SaturationCurve*>(&arctan), static_cast<const SaturationCurve*>(&langevin),
        static_cast<const SaturationCurve*>(&froehlich), static_cast<const SaturationCurve*>(&knee)}) {
    EXPECT_NEAR(curve->curve(0.01) / 0.01, 1.0, 6e-3);
    EXPECT_NEAR(curve->curve(-1.5), -curve->curve(1.5), 1e-12);
  }
  EXPECT_NEAR(arctan.curve(1e6), 2.0, 1e-5);
  EXPECT_NEAR(langevin.curve(1e6), 2.0, 1e-5);
  EXPECT_NEAR(froehlich.curve(1e6), 2.0, 1e-5);
  EXPECT_NEAR(knee.curve(3.0), 2.1, 1e-12);
}

TEST(Forms, CoilsFollowAStepToTheEnd) {
  std::vector<double> step(20000, 1.0);
  step[0] = 0.0;
  auto eddy = step;
  EddyCoil(0.02, 0.1, 0.4).magnetise(eddy, 1e-4, 0.0);
  EXPECT_NEAR(eddy[1000], 1.0 - 0.6 * std::exp(-5.0) - 0.4 * std::exp(-1.0), 1e-3);
  auto saturable = step;
  SaturableCoil(0.05, 1e9).magnetise(saturable, 1e-4, 0.0);  // far from saturation: first order
  EXPECT_NEAR(saturable[500], 1.0 - std::exp(-1.0), 1e-3);
  auto loop = step;
  LoopCoil(100.0, 0.5).magnetise(loop, 1e-4, 0.0);
  EXPECT_NEAR(*std::ranges::max_element(loop), 1.0 + std::exp(-pi * 0.5 / std::sqrt(0.75)), 2e-3);
  for (const auto* signal : {&eddy, &saturable, &loop}) EXPECT_NEAR(signal->back(), 1.0, 1e-6);
}

// All filters delay a slow sine by their lag.
TEST(Forms, LateChannelsAreLateByTheirLag) {
  constexpr double rate = 2000.0;
  constexpr double lag = 0.01;
  const double w = 2.0 * pi * 0.5;
  const auto signal = [&] {
    std::vector<double> values;
    for (int k = 0; k < 8000; ++k) values.push_back(std::cos(w * k / rate));
    return values;
  };
  const auto check = [&](const std::vector<double>& late, const char* name) {
    for (std::size_t k = 2000; k < late.size(); k += 97) {
      EXPECT_NEAR(late[k], std::cos(w * (static_cast<double>(k) / rate - lag)), 1.2e-3) << name;
    }
  };
  const ForceTransport transport(lag);
  const ForceLowPass low_pass(lag);
  const ForceBessel bessel(lag);
  for (const Part* part :
       {static_cast<const Part*>(&transport), static_cast<const Part*>(&low_pass), static_cast<const Part*>(&bessel)}) {
    auto values = signal();
    part->on_force(values, rate);
    check(values, "force");
  }
  const VelocityTransport v_transport(lag);
  const VelocityBessel v_bessel(lag);
  const VelocityWindow v_window(lag);
  for (const Part* part : {static_cast<const Part*>(&v_transport), static_cast<const Part*>(&v_bessel),
                           static_cast<const Part*>(&v_window)}) {
    auto values = signal();
    part->on_velocity(values, rate);
    check(values, "velocity");
    EXPECT_EQ(part->velocity_delay(), lag);
  }
}

TEST(Forms, ForeignCausesDoWhatTheirWordsSay) {
  EXPECT_NEAR(PlaceFriction(100.0, 0.0, 1e-2).beside(at(1e-2, 0.5), nullptr), 100.0, 1e-3);
  EXPECT_NEAR(Cogging(100.0, 4e-3, 0.0).beside(at(1e-3, 0.0), nullptr), 100.0, 1e-9);
  EXPECT_NEAR(LeverGeometry(0.2, 1e-2).whole(at(1e-2, 0.0), nullptr, 0.0, 100.0), 120.0, 1e-9);
  std::vector<double> force = {100.0, -100.0};
  LoadCellSquare(0.1, 1e3).on_force(force, 1.0);
  EXPECT_NEAR(force[0], 101.0, 1e-12);
  EXPECT_NEAR(force[1], -99.0, 1e-12);
  Moment driven = at(1e-2, 0.0);
  driven.drive = 0.5;
  EXPECT_NEAR(FieldSpring(1e4, 1.0).beside(driven, nullptr), 50.0, 1e-9);
  std::vector<double> current = {0.0, 0.3, -0.4};
  DriverThreshold(0.4).magnetise(current, 1.0, 0.0);
  EXPECT_NEAR(current[0], 0.0, 1e-12);
  EXPECT_NEAR(current[1], 0.1, 1e-12);
  std::vector<double> supply(5, 2.0);
  SupplyCycling(0.1, 4.0, 0.0).magnetise(supply, 1.0, 0.0);
  EXPECT_NEAR(supply[1], 2.2, 1e-9);
  EXPECT_NEAR(supply[3], 1.8, 1e-9);
  driven.drive = 2.0;
  EXPECT_NEAR(KneeOfCurrent(0.5).hysteresis(driven, 1.0, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(SlipLock(0.9, 0.0, 0.3).hysteresis({}, 1.0, 0.0), 0.1, 1e-12);
  // A valve opens above its speed and shuts below half of it.
  const BlowOffValve valve(0.4, 0.05);
  const auto rising = [](double t) { return at(0.0, 0.1 * t, 0.0, t); };
  const auto falling = [](double t) { return at(0.0, 0.1 * (1.0 - t), 0.0, t); };
  EXPECT_NEAR(valve.damping({}, after(valve, 0.4, rising).data(), 0.0), 1.0, 1e-9);
  EXPECT_NEAR(valve.damping({}, after(valve, 0.6, rising).data(), 0.0), 0.6, 1e-6);
  EXPECT_NEAR(valve.damping({}, after(valve, 0.7, falling).data(), 0.0), 0.6, 1e-6);
  EXPECT_NEAR(valve.damping({}, after(valve, 0.9, falling).data(), 0.0), 1.0, 1e-6);
  const InertiaValve inertia(0.4, 1.0);
  EXPECT_GT(inertia.urge(at(0.0, -0.1, -2.0)), 1.0);
  EXPECT_LT(inertia.urge(at(0.0, -0.1, 2.0)), 0.0);
  const auto working = [](double t) {
    Moment m = at(0.0, 0.5, 0.0, t);
    m.core = 200.0;
    return m;
  };
  const HotThreshold hot(0.3, 100.0, 1e9);
  EXPECT_NEAR(hot.yield({}, after(hot, 0.9, working).data()), 1.0, 1e-9);
  EXPECT_NEAR(hot.yield({}, after(hot, 2.0, working).data()), 0.7, 1e-6);
  // At a steady speed every arm is stretched by v T_k.
  const FractionalRelaxation fractional(100.0, 1e-2, 0.4);
  double arms = 0.0;
  for (const double time : FractionalRelaxation::times) arms += std::pow(time, 0.6);
  const auto steady = [](double t) { return at(1e-3 * t, 1e-3, 0.0, t); };
  EXPECT_NEAR(fractional.beside({}, after(fractional, 20.0, steady).data()), 10.0 * arms, 1e-5);
  // Rings at its frequency after a step of force and ends where it began.
  const RigRinging ringing(0.5, 100.0, 0.05);
  const auto stepped = [](double t) {
    Moment m = at(0.0, 0.0, 0.0, t);
    m.core = 200.0;
    return m;
  };
  const States s = after(ringing, 3.0, stepped);
  EXPECT_NEAR(ringing.beside(stepped(3.0), s.data()), 0.0, 1e-2);
  EXPECT_NEAR(GripSlip(500.0, 1e-4, 0.2).series({}, nullptr, 0.0, 10.0), 500.0, 0.1);
  const SwingDamping swing(0.5, 1e-2);
  EXPECT_NEAR(swing.damping({}, after(swing, 3.0, sine(1e-2, 2.0)).data(), 0.0), 1.5, 0.1);
  const MountLadder ladder(100.0, 1e-2, 0.02, 0.2);
  EXPECT_NEAR(ladder.stretch(1e-2), 2e-2, 1e-12);
}

// At a standstill the states go the way of their equation, whichever of the two works it out.
void expect_rest(const Part& part, const States& from) {
  ASSERT_TRUE(part.goes_on());
  for (const double pause : {0.5, 40.0, 400.0}) {
    States marched = from;
    States scale;
    scale.fill(1.0);
    double step = 1e-4;
    constexpr int pieces = 400;
    for (int k = 0; k < pieces; ++k) {
      advance(marched, pause * k / pieces, pause * (k + 1) / pieces, step, 1e-10, scale,
              [&](double t, const States& s) {
                States d{};
                part.rate(at(0.0, 0.0, 0.0, t), s.data(), d.data());
                return d;
              });
    }
    States rested = from;
    part.rest(pause, rested.data());
    for (std::size_t k = 0; k < part.states(); ++k) EXPECT_NEAR(rested[k], marched[k], 2e-4) << pause << " s, " << k;
  }
}

TEST(Pause, HeatIsLostAndStructureComesBack) {
  expect_rest(DampingHeat(100.0, 50.0, 1.0), {1.3});
  expect_rest(TwoStoreHeat(100.0, 3.0, 60.0, 0.2, 1.0, 0.5), {1.3, 0.4});
  expect_rest(ThixotropicStiction(0.3, 0.01, 20.0), {0.1});
  expect_rest(EnergyWear(0.3, 100.0), {0.7});
  expect_rest(PathWear(2.0), {0.7});
  EXPECT_FALSE(PathStiction(0.3, 0.01).goes_on()) << "settled anew in every pause";
}

TEST(Pause, TurnsThatWereCountedStayCounted) {
  const CycleWear wear(0.01, 1e-3);
  States s{6.8, 1.0, 7.0};
  wear.rest(10.0, s.data());
  EXPECT_EQ(s[0], 7.0);
  EXPECT_EQ(s[1], 0.0) << "no turn is counted where the next test goes the other way";
}

}  // namespace
}  // namespace hysteron::challenge

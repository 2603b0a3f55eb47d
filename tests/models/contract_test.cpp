// What every law and effect of the catalogue promises, and limits in which theory gives the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "simulate/composite.hpp"
#include "simulate/drawn.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;

struct Series {
  Vector time, x, v, drive;
  [[nodiscard]] Motion motion() const { return make_motion(time, x, v, drive); }
  [[nodiscard]] std::size_t size() const { return time.size(); }
};

// Sine of the given frequency and amplitude with a drive that swings between 0.2 and 1 A at another frequency.
Series sine(double frequency, double amplitude, double rate, double duration) {
  Series s;
  const double w = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < static_cast<std::size_t>(rate * duration); ++n) {
    const double t = static_cast<double>(n) / rate;
    s.time.push_back(t);
    s.x.push_back(amplitude * std::sin(w * t));
    s.v.push_back(amplitude * w * std::cos(w * t));
    s.drive.push_back(0.6 + 0.4 * std::sin(31.0 * t + 0.3));
  }
  return s;
}

// Constant velocity.
Series ramp(double speed, double rate, double duration) {
  Series s;
  for (std::size_t n = 0; n < static_cast<std::size_t>(rate * duration); ++n) {
    const double t = static_cast<double>(n) / rate;
    s.time.push_back(t);
    s.x.push_back(speed * t);
    s.v.push_back(speed);
  }
  return s;
}

// Position in the box at share u of the side, 0 .. 1.
double at_share(const Parameter& p, double u) {
  return p.scale == Scale::logarithmic ? p.box.lower * std::pow(p.box.upper / p.box.lower, u)
                                       : p.box.lower + u * (p.box.upper - p.box.lower);
}

Vector draw(const CompositeModel& model, std::uint64_t seed, double margin, bool fixed_too) {
  const Stream stream(seed);
  const auto parameters = model.parameters();
  Vector p;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double u = margin + (1.0 - 2.0 * margin) * stream.uniform(seed, static_cast<std::uint32_t>(j));
    p.push_back(parameters[j].fixed && !fixed_too ? parameters[j].initial : at_share(parameters[j], u));
  }
  return p;
}

Vector initial(const CompositeModel& model) {
  Vector p;
  for (const Parameter& parameter : model.parameters()) {
    p.push_back(parameter.initial);
  }
  return p;
}

double largest(const Vector& a) {
  double result = 0.0;
  for (const double value : a) {
    result = std::max(result, std::fabs(value));
  }
  return result;
}
double distance(const Vector& a, const Vector& b) {
  double result = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    result = std::max(result, std::fabs(a[i] - b[i]));
  }
  return result;
}
double rms(const Vector& a) {
  double sum = 0.0;
  for (const double value : a) {
    sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}
double rms_distance(const Vector& a, const Vector& b) {
  Vector d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    d[i] = a[i] - b[i];
  }
  return rms(d);
}

struct Case {
  std::string name;
  CompositeModel model;
  std::size_t first;  // parameters from here on are those of the part under test
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const Part* part : model_catalogue()) {
    result.push_back({std::string(part->id), make_model(part->id, {}), 0});
  }
  for (const Part* part : effect_catalogue()) {
    Case c{"bouc-wen+" + std::string(part->id), make_model("bouc-wen", {std::string(part->id)}), 0};
    c.first = c.model.law->parameters.size();
    result.push_back(c);
  }
  return result;
}

class Contract : public ::testing::TestWithParam<Case> {};

TEST_P(Contract, CardIsComplete) {
  const Case& c = GetParam();
  const Part& part = c.first == 0 ? *c.model.law : *c.model.effects.front();
  EXPECT_FALSE(part.title.empty());
  EXPECT_FALSE(part.reference.empty());
  EXPECT_FALSE(part.equations.empty());
  EXPECT_FALSE(part.parameters.empty());
  EXPECT_LE(part.states, 4);
  for (const Parameter& p : part.parameters) {
    const std::string name(p.name);
    EXPECT_FALSE(p.name.empty());
    EXPECT_FALSE(p.symbol.empty()) << name;
    EXPECT_FALSE(p.unit.empty()) << name;
    EXPECT_FALSE(p.meaning.empty()) << name;
    EXPECT_LT(p.box.lower, p.box.upper) << name;
    EXPECT_GE(p.initial, p.box.lower) << name;
    EXPECT_LE(p.initial, p.box.upper) << name;
    if (p.scale == Scale::logarithmic) {
      EXPECT_GT(p.box.lower, 0.0) << name;
    }
    const auto same = std::ranges::count_if(part.parameters, [&](const Parameter& o) { return o.name == p.name; });
    EXPECT_EQ(same, 1) << name;
  }
}

TEST_P(Contract, ForceIsFiniteInTheBox) {
  const CompositeModel& model = GetParam().model;
  const Motion motion = sine(2.0, 0.025, 200.0, 1.0).motion();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Vector force = simulate(model, motion, draw(model, seed, 0.0, false));
    for (const double f : force) {
      ASSERT_TRUE(std::isfinite(f)) << "seed " << seed;
      ASSERT_LT(std::fabs(f), 1.0e6) << "seed " << seed;
    }
  }
}

// The stiffness bound is honest when a fraction of the step leaves the force as it is. The first 20 ms are left out:
// the acceleration estimate settles there, and a branch told by its sign turns any rounding of it into force.
TEST_P(Contract, StepIsSmallEnough) {
  const CompositeModel& model = GetParam().model;
  const Motion motion = sine(2.0, 0.025, 200.0, 0.6).motion();
  Motion tight = motion;
  tight.step_limit = 0.1;
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    const Vector p = draw(model, seed, 0.0, false);
    Vector force = simulate(model, motion, p);
    Vector finer = simulate(model, tight, p);
    force.erase(force.begin(), force.begin() + 4);
    finer.erase(finer.begin(), finer.begin() + 4);
    EXPECT_LT(rms_distance(force, finer), 1e-3 * largest(force)) << "seed " << seed;
  }
}

// What marches that do not know the speed beforehand take for granted (simulate/march.hpp).
TEST_P(Contract, StiffnessIsLinearInTheSpeedOrRisesEverLess) {
  const CompositeModel& model = GetParam().model;
  for (std::uint64_t seed = 300; seed < 320; ++seed) {
    const Vector p = draw(model, seed, 0.0, false);
    model.for_links([&](const Link& link) {
      const PartOperations<double>& part = link.part->on<double>();
      if (part.stiffness == nullptr) {
        return;
      }
      const double* own = p.data() + link.parameter;
      const double still = part.stiffness(own, 0.0);
      for (double slow = 1e-4; slow < 1.0; slow *= 4.0) {
        const double known = part.stiffness(own, slow);
        for (double fast = 2.0 * slow; fast < 10.0; fast *= 3.0) {
          const double line = known + (fast - slow) / slow * (known - still);
          ASSERT_LE(part.stiffness(own, fast), line * (1.0 + 1e-12))
              << link.part->id << " from " << slow << " to " << fast;
        }
      }
    });
  }
}

template <class P>
void expect_lanes_agree_with_doubles(const CompositeModel& model) {
  const Motion motion = sine(2.0, 0.025, 200.0, 0.3).motion();
  std::vector<P> p(model.parameter_count());
  std::vector<Vector> rows;
  for (int lane = 0; lane < P::lanes; ++lane) {
    rows.push_back(draw(model, static_cast<std::uint64_t>(200 + lane), 0.0, false));
    for (std::size_t j = 0; j < p.size(); ++j) {
      p[j].set_lane(lane, rows.back()[j]);
    }
  }
  std::vector<P> state(16), force(motion.time.size());
  model.march<P>(motion, p.data(), 0, 0, motion.time.size(), state.data(), force.data());
  for (int lane = 0; lane < P::lanes; ++lane) {
    const Vector alone = simulate(model, motion, rows[static_cast<std::size_t>(lane)]);
    for (std::size_t n = 0; n < alone.size(); ++n) {
      ASSERT_EQ(force[n].lane(lane), alone[n]) << "lane " << lane << " sample " << n;
    }
  }
}

TEST_P(Contract, LanesAgreeWithDoubles) { expect_lanes_agree_with_doubles<Lanes>(GetParam().model); }

TEST_P(Contract, LanesOfTwoPacksSideBySideAgreeWithDoubles) {
  if (GetParam().model.has_wide_march()) expect_lanes_agree_with_doubles<WideLanes>(GetParam().model);
}

TEST_P(Contract, DerivativeIsThatOfTheForce) {
  const CompositeModel& model = GetParam().model;
  Motion motion = sine(2.0, 0.025, 200.0, 0.3).motion();
  // The number of steps follows the parameters; with fine steps its jumps do not show in a difference.
  motion.step_limit = 0.05;
  const std::size_t samples = motion.time.size();
  const std::size_t count = model.parameter_count();
  const auto card = model.parameters();
  const Vector p = draw(model, 7, 0.15, true);
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest(simulate(model, motion, p));
  for (std::size_t first = 0; first < count; first += sweep_directions) {
    std::vector<LaneDual> dual(count), state(16), force(samples);
    for (std::size_t j = 0; j < count; ++j) {
      dual[j] = LaneDual(p[j]);
      if (j >= first && j < first + sweep_directions) {
        dual[j].d[j - first] = Lanes(1.0);
      }
    }
    model.march<LaneDual>(motion, dual.data(), 0, 0, samples, state.data(), force.data());
    for (std::size_t j = first; j < std::min(count, first + sweep_directions); ++j) {
      Vector exact(samples);
      for (std::size_t n = 0; n < samples; ++n) {
        exact[n] = force[n].d[j - first].lane(3);
      }
      const double range = card[j].scale == Scale::logarithmic ? p[j] : card[j].box.upper - card[j].box.lower;
      double best = 1e300;
      for (const double share : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const double h = share * range;
        Vector above = p;
        Vector below = p;
        above[j] += h;
        below[j] -= h;
        const Vector up = simulate(model, motion, above);
        const Vector down = simulate(model, motion, below);
        Vector difference(samples);
        for (std::size_t n = 0; n < samples; ++n) {
          difference[n] = (up[n] - down[n]) / (above[j] - below[j]);
        }
        best = std::min(best, distance(difference, exact));
      }
      // A difference over the widest step is no better than the rounding of the forces.
      EXPECT_LT(best, 1e-3 * largest(exact) + rounding / (1e-3 * range) + 1e-12) << model.parameter_names()[j];
    }
  }
}

// Somewhere in the box: a damper that does not yield at one point has no yield force there.
TEST_P(Contract, EveryParameterMatters) {
  const Case& c = GetParam();
  if (c.first > 0 && c.model.effects[0]->on_double.excite != nullptr) {
    GTEST_SKIP() << "acts on parameters that follow the drive: tests/fit";
  }
  const Motion motion = sine(2.0, 0.025, 200.0, 1.0).motion();
  const auto card = c.model.parameters();
  Vector change(card.size(), 0.0);
  for (std::uint64_t seed = 11; seed < 16; ++seed) {
    const Vector p = draw(c.model, seed, 0.2, false);
    const Vector force = simulate(c.model, motion, p);
    for (std::size_t j = c.first; j < card.size(); ++j) {
      Vector changed = p;
      changed[j] = at_share(card[j], 0.9);
      change[j] = std::max(change[j], rms_distance(simulate(c.model, motion, changed), force) / rms(force));
    }
  }
  for (std::size_t j = c.first; j < card.size(); ++j) {
    if (!card[j].fixed) {
      EXPECT_GT(change[j], 1e-5) << card[j].name;
    }
  }
}

// `linear` is meant jointly: the force is affine in all flagged parameters of law and effects together.
TEST_P(Contract, LinearFlagsHold) {
  const CompositeModel& model = GetParam().model;
  const Motion motion = sine(2.0, 0.025, 200.0, 0.5).motion();
  const auto card = model.parameters();
  const Vector p = draw(model, 13, 0.2, false);
  const Vector force = simulate(model, motion, p);
  Vector sum(force.size(), 0.0);
  Vector all = p;
  double scale = 0.0;
  for (std::size_t j = 0; j < card.size(); ++j) {
    if (!card[j].linear) {
      continue;
    }
    const double step = 0.1 * (card[j].box.upper - card[j].box.lower);
    Vector once = p;
    Vector twice = p;
    once[j] += step;
    twice[j] += 2.0 * step;
    all[j] += step;
    const Vector f1 = simulate(model, motion, once);
    const Vector f2 = simulate(model, motion, twice);
    scale = std::max({scale, largest(f1), largest(f2)});
    for (std::size_t n = 0; n < force.size(); ++n) {
      sum[n] += f1[n] - force[n];
      EXPECT_NEAR(f2[n] - force[n], 2.0 * (f1[n] - force[n]), 1e-9 * scale) << card[j].name;
    }
  }
  const Vector together = simulate(model, motion, all);
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_NEAR(together[n] - force[n], sum[n], 1e-9 * std::max(scale, largest(together)));
  }
}

// And no parameter that passes is left unflagged in a law.
TEST_P(Contract, NonlinearParametersAreNot) {
  const Case& c = GetParam();
  if (c.first > 0) {
    GTEST_SKIP() << "effects that scale the force are linear alone, not together with the law";
  }
  if (c.name == "wang-sigmoid") {
    GTEST_SKIP() << "its force is a product of factors that are linear alone, not together";
  }
  const Motion motion = sine(2.0, 0.025, 200.0, 0.5).motion();
  const auto card = c.model.parameters();
  const Vector p = draw(c.model, 17, 0.3, false);
  const Vector force = simulate(c.model, motion, p);
  for (std::size_t j = 0; j < card.size(); ++j) {
    if (card[j].linear || card[j].fixed) {
      continue;
    }
    Vector once = p;
    Vector twice = p;
    once[j] = at_share(card[j], 0.75);
    twice[j] = p[j] + 2.0 * (once[j] - p[j]);
    const Vector f1 = simulate(c.model, motion, once);
    const Vector f2 = simulate(c.model, motion, twice);
    double bend = 0.0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      bend = std::max(bend, std::fabs(f2[n] - 2.0 * f1[n] + force[n]));
    }
    EXPECT_GT(bend, 1e-7 * largest(force)) << card[j].name;
  }
}

// At its initial values an effect leaves the force of the law.
TEST_P(Contract, EffectVanishesInitially) {
  const Case& c = GetParam();
  if (c.first == 0) {
    GTEST_SKIP() << "a law";
  }
  const Motion motion = sine(2.0, 0.025, 200.0, 0.5).motion();
  const CompositeModel law = make_model("bouc-wen", {});
  Vector p = draw(law, 19, 0.2, false);
  const Vector bare = simulate(law, motion, p);
  const Vector tail = initial(c.model);
  p.insert(p.end(), tail.begin() + static_cast<std::ptrdiff_t>(c.first), tail.end());
  EXPECT_LT(distance(simulate(c.model, motion, p), bare), 1e-3 * largest(bare));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, Contract, ::testing::ValuesIn(cases()),
                         [](const ::testing::TestParamInfo<Case>& tested) {
                           std::string name = tested.param.name;
                           std::ranges::replace_if(
                               name, [](char ch) { return ch == '-' || ch == '+'; }, '_');
                           return name;
                         });

using hysteron::testing::with;

TEST(Limits, NonlinearBiviscousSlopes) {
  const CompositeModel model = make_model("nonlinear-biviscous", {});
  const Vector p = with(model, {{"fy", 400.0}, {"c0", 1000.0}, {"v_y", 0.05}});
  const auto at = [&](double speed) { return simulate(model, ramp(speed, 100.0, 0.05).motion(), p).back(); };
  EXPECT_NEAR(at(0.02), (1000.0 + 400.0 / 0.05) * 0.02, 1e-9);
  EXPECT_NEAR(at(0.2), 1000.0 * 0.2 + 400.0, 1e-9);
  EXPECT_NEAR(at(-0.2), -1000.0 * 0.2 - 400.0, 1e-9);
}

TEST(Limits, BinghamMaxwellRelaxesToBingham) {
  const CompositeModel model = make_model("bingham-maxwell", {});
  const Vector p = with(model, {{"fc", 400.0}, {"c0", 1000.0}, {"f0", 30.0}, {"lambda", 0.02}});
  const Series motion = ramp(0.1, 500.0, 0.3);
  const Vector force = simulate(model, motion.motion(), p);
  for (std::size_t n = 0; n < motion.size(); ++n) {
    EXPECT_NEAR(force[n], 400.0 + 1000.0 * 0.1 * (1.0 - std::exp(-motion.time[n] / 0.02)) + 30.0, 1e-3);
  }
}

TEST(Limits, ExtendedBinghamFlowsAsBinghamAtSteadyVelocity) {
  const CompositeModel model = make_model("extended-bingham", {});
  const Vector p = with(model, {{"fc", 400.0}, {"c0", 1000.0}, {"f0", 30.0}});
  for (const double speed : {0.02, -0.1}) {
    const double force = simulate(model, ramp(speed, 200.0, 2.0).motion(), p).back();
    EXPECT_NEAR(force, std::copysign(400.0, speed) + 1000.0 * speed + 30.0, 1e-3);
  }
}

TEST(Limits, ExtendedBinghamIsStandardLinearSolidBelowYield) {
  const CompositeModel model = make_model("extended-bingham", {});
  const double k1 = 2e4;
  const double k2 = 5e4;
  const double c1 = 1e3;
  const Vector p = with(model, {{"fc", 3000.0}, {"c1", c1}, {"k1", k1}, {"k2", k2}});
  const double speed = 0.02;
  const Series motion = ramp(speed, 500.0, 0.5);
  const Vector force = simulate(model, motion.motion(), p);
  // k2 and (k1 parallel c1) in series under a ramp.
  const double relaxation = c1 / (k1 + k2);
  const double slow = k1 * k2 / (k1 + k2);
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double t = motion.time[n];
    const double theory = speed * (slow * t + (k2 - slow) * relaxation * (1.0 - std::exp(-t / relaxation)));
    EXPECT_NEAR(force[n], theory, 1e-3 * largest(force));
  }
}

TEST(Limits, LuGreIsStribeckAndViscousAtSteadyVelocity) {
  const CompositeModel model = make_model("lugre", {});
  const Vector p = with(model, {{"alpha", 300.0}, {"c0", 800.0}, {"c1", 50.0}, {"ratio", 1.8}, {"v_st", 0.02}});
  for (const double speed : {0.01, 0.15, -0.03}) {
    const double force = simulate(model, ramp(speed, 200.0, 3.0).motion(), p).back();
    const double curve = 300.0 * (1.0 + 0.8 * std::exp(-std::pow(speed / 0.02, 2)));
    EXPECT_NEAR(force, std::copysign(curve, speed) + 800.0 * speed, 1e-3);
  }
}

TEST(Limits, LuGreWithoutHumpIsDahl) {
  Motion motion = sine(2.0, 0.01, 500.0, 1.0).motion();
  motion.step_limit = 0.01;  // the two take their steps differently
  const CompositeModel lugre = make_model("lugre", {});
  const CompositeModel dahl = make_model("modified-dahl", {});
  const Vector a = simulate(lugre, motion, with(lugre, {{"ratio", 1.0}, {"c1", 0.0}, {"k0", 300.0}}));
  EXPECT_LT(distance(a, simulate(dahl, motion, with(dahl, {{"k0", 300.0}}))), 1e-9 * largest(a));
}

TEST(Limits, ModifiedDahlLoopOfAMonotonePath) {
  const CompositeModel model = make_model("modified-dahl", {});
  const Series motion = ramp(0.05, 1000.0, 0.2);
  const Vector force = simulate(model, motion.motion(), with(model, {{"c0", 0.0}, {"alpha", 100.0}, {"x_y", 2e-3}}));
  for (std::size_t n = 0; n < motion.size(); ++n) {
    EXPECT_NEAR(force[n], 100.0 * (1.0 - std::exp(-motion.x[n] / 2e-3)), 1e-4);
  }
}

TEST(Limits, BaberNooriWithoutDegradationIsBoucWen) {
  Motion motion = sine(2.0, 0.01, 500.0, 1.0).motion();
  motion.step_limit = 0.05;
  const CompositeModel degrading = make_model("baber-noori", {});
  const CompositeModel plain = make_model("bouc-wen", {});
  const std::vector<std::pair<std::string, double>> values = {{"share", 0.7}, {"n", 2.0}, {"x_y", 8e-4}, {"k0", 500.0}};
  const Vector a = simulate(degrading, motion, with(degrading, values));
  EXPECT_LT(distance(a, simulate(plain, motion, with(plain, values))), 1e-6 * largest(a));
}

TEST(Limits, BaberNooriDegradesAndPinches) {
  const Series motion = sine(2.0, 0.01, 500.0, 4.0);
  const CompositeModel model = make_model("baber-noori", {});
  const std::vector<std::pair<std::string, double>> plain = {{"c0", 0.0}, {"alpha", 100.0}};
  auto weak = plain;
  weak.emplace_back("delta_nu", 0.5);
  const Vector force = simulate(model, motion.motion(), with(model, weak));
  double last = 0.0;
  double energy = 0.0;
  for (std::size_t n = 1; n < motion.size(); ++n) {
    energy += 0.5 * (force[n] * motion.v[n] + force[n - 1] * motion.v[n - 1]) / 500.0 / 100.0;
    last = n >= motion.size() - 250 ? std::max(last, std::fabs(force[n])) : 0.0;
  }
  // z saturates at nu^(-1/n), nu between those at the start and at the end of the last cycle.
  const double nu = 1.0 + 0.5 * 10.0 * (1.0 - std::exp(-energy / 10.0));
  EXPECT_NEAR(last, 100.0 * std::pow(nu, -1.0 / 1.5), 1.0);
  auto pinched = plain;
  pinched.emplace_back("zeta_s", 0.9);
  const auto loop = [&](const Vector& f) {
    double area = 0.0;
    for (std::size_t n = 1; n < f.size(); ++n) {
      area += f[n] * motion.v[n];
    }
    return area;
  };
  EXPECT_LT(loop(simulate(model, motion.motion(), with(model, pinched))),
            0.97 * loop(simulate(model, motion.motion(), with(model, plain))));
}

// The branch of Guo-Hu, the sigmoid and the polynomial is told by the acceleration.
TEST(Limits, BranchesOfTheLoop) {
  const Series motion = sine(2.0, 0.025, 500.0, 1.0);
  const CompositeModel guo = make_model("guo-hu", {});
  const Vector a = simulate(guo, motion.motion(), with(guo, {{"f_y", 400.0}, {"v_h", 0.04}, {"v_y", 0.02}}));
  const CompositeModel sigmoid = make_model("asymmetric-sigmoid", {});
  const Vector b = simulate(
      sigmoid, motion.motion(),
      with(sigmoid, {{"f_t", 400.0}, {"v_h", 0.04}, {"v_t", 0.05}, {"c_c", 900.0}, {"c_e", 300.0}, {"f_d", 20.0}}));
  const CompositeModel polynomial = make_model("polynomial-hysteresis", {});
  const Vector c = simulate(
      polynomial, motion.motion(),
      with(polynomial, {{"rise_0", -80.0}, {"rise_3", 70.0}, {"fall_0", 90.0}, {"fall_2", -30.0}, {"fall_1", 400.0}}));
  const double w = 4.0 * std::numbers::pi;
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double acceleration = -w * w * motion.x[n];
    const double v = motion.v[n];
    if (std::fabs(acceleration) < 1.5 || motion.time[n] < 0.02) {
      continue;
    }
    const double branch = acceleration > 0.0 ? 1.0 : -1.0;
    EXPECT_NEAR(a[n], 500.0 * v + 800.0 / std::numbers::pi * std::atan((v - 0.04 * branch) / 0.02), 0.01);
    EXPECT_NEAR(b[n], std::tanh((v - 0.04 * branch) / 0.05) * (400.0 + (v > 0.0 ? 900.0 : 300.0) * std::fabs(v)) + 20.0,
                0.01);
    const double r = v / 0.3;
    EXPECT_NEAR(c[n], branch > 0.0 ? -80.0 + 500.0 * r + 70.0 * r * r * r : 90.0 + 400.0 * r - 30.0 * r * r, 0.01);
  }
}

TEST(Limits, AlgebraicHysteresisAsPrinted) {
  const Series motion = sine(2.0, 0.025, 200.0, 1.0);
  const CompositeModel model = make_model("algebraic-hysteresis", {});
  const Vector force = simulate(model, motion.motion(), with(model, {{"v_y", 0.05}, {"v_h", 0.03}, {"k0", 200.0}}));
  for (std::size_t n = 0; n < motion.size(); ++n) {
    if (std::fabs(motion.x[n]) > 5e-3) {
      const double side = motion.x[n] > 0.0 ? 1.0 : -1.0;
      const double z = std::tanh((motion.v[n] + 0.03 * side) / 0.05);
      EXPECT_NEAR(force[n], 500.0 * motion.v[n] + 200.0 * motion.x[n] + 500.0 * z, 1e-3);
    }
  }
}

// Force that an effect adds to a law without force of its own.
Vector effect_alone(const std::string& effect, const Series& motion,
                    const std::vector<std::pair<std::string, double>>& values) {
  const CompositeModel model = make_model("viscous", {effect});
  std::vector<std::pair<std::string, double>> all = {{"c0", 0.0}};
  for (const auto& [name, value] : values) {
    all.emplace_back(effect + "." + name, value);
  }
  return simulate(model, motion.motion(), with(model, all));
}

TEST(Effects, InertiaIsMassTimesAcceleration) {
  const Series motion = sine(5.0, 0.005, 500.0, 1.0);
  const Vector force = effect_alone("inertia", motion, {{"m", 10.0}});
  const double w = 10.0 * std::numbers::pi;
  const double peak = 10.0 * 0.005 * w * w;
  for (std::size_t n = 10; n < motion.size(); ++n) {
    EXPECT_NEAR(force[n], -10.0 * w * w * motion.x[n], 0.01 * peak) << n;
  }
}

TEST(Effects, SensorDelayShiftsTheForce) {
  const double delay = 0.004;
  const double w = 4.0 * std::numbers::pi;
  const Series motion = sine(2.0, 0.025, 500.0, 1.0);
  const CompositeModel model = make_model("viscous", {"sensor-delay"});
  for (const double sign : {1.0, -1.0}) {
    const Vector force = simulate(model, motion.motion(),
                                  with(model, {{"c0", 800.0}, {"k0", 9000.0}, {"sensor-delay.lag", sign * delay}}));
    for (std::size_t n = 10; n < motion.size(); ++n) {
      const double t = motion.time[n] - sign * delay;
      const double theory = 0.025 * (800.0 * w * std::cos(w * t) + 9000.0 * std::sin(w * t));
      EXPECT_NEAR(force[n], theory, 2e-4 * largest(force));
    }
  }
}

TEST(Effects, VelocityLagUndoesAFirstOrderFilter) {
  const double w = 4.0 * std::numbers::pi;
  const double tau = 0.02;
  Series motion = sine(2.0, 0.025, 500.0, 1.0);
  const Vector acting = motion.v;
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double t = motion.time[n];
    motion.v[n] = 0.025 * w * (std::cos(w * t) + w * tau * std::sin(w * t)) / (1.0 + w * w * tau * tau);
  }
  const CompositeModel model = make_model("viscous", {"velocity-lag"});
  const Vector force = simulate(model, motion.motion(), with(model, {{"velocity-lag.lag", tau}}));
  for (std::size_t n = 1; n + 1 < motion.size(); ++n) {
    EXPECT_NEAR(force[n], 1000.0 * acting[n], 2e-4 * largest(force));
  }
}

TEST(Effects, TravelScalesTheForce) {
  const Series motion = ramp(0.1, 200.0, 2.0);
  const auto scaled = [&](const std::string& effect, std::vector<std::pair<std::string, double>> values) {
    const CompositeModel model = make_model("viscous", {effect});
    values.emplace_back("c0", 1000.0);
    return simulate(model, motion.motion(), with(model, values));
  };
  const Vector stuck = scaled("stiction", {{"stiction.a", 0.5}, {"stiction.L", 0.03}});
  for (std::size_t n = 0; n < motion.size(); ++n) {
    EXPECT_NEAR(stuck[n], 100.0 * (1.0 + 0.5 * std::exp(-motion.x[n] / 0.03)), 1e-6);
  }
}

// Constant speed of a dashpot: 10 W at the start.
TEST(Effects, WorkScalesTheForce) {
  const Series motion = ramp(0.1, 200.0, 2.0);
  const auto scaled = [&](const std::string& effect, std::vector<std::pair<std::string, double>> values) {
    const CompositeModel model = make_model("viscous", {effect});
    values.emplace_back("c0", 1000.0);
    return simulate(model, motion.motion(), with(model, values));
  };
  const Vector worn = scaled("degradation", {{"degradation.d", 0.02}});
  const Vector warm =
      scaled("self-heating", {{"self-heating.b", 0.02}, {"self-heating.tau", 1e9}, {"self-heating.y", 1.0}});
  const Vector steady =
      scaled("self-heating", {{"self-heating.b", 0.02}, {"self-heating.tau", 0.1}, {"self-heating.c_h", 1000.0}});
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double t = motion.time[n];
    // E' = P / (1 + d E): (1 + d E)^2 = 1 + 2 d P t;  q' = P exp(-b q): exp(b q) = 1 + b P t.
    EXPECT_NEAR(worn[n], 100.0 / std::sqrt(1.0 + 2.0 * 0.02 * 10.0 * t), 1e-6);
    EXPECT_NEAR(warm[n], 100.0 / (1.0 + 0.02 * 10.0 * t), 1e-6);
  }
  // Long after the thermal time constant q = tau P exp(-b q).
  const double q = -std::log(steady.back() / 100.0) / 0.02;
  EXPECT_NEAR(q, 0.1 * 10.0 * std::exp(-0.02 * q), 1e-3);
}

TEST(Effects, FrictionTurnsOverItsBristleLength) {
  // After a turn at constant speed: z = 1 - 2 exp(-distance / (x_b + |v| t_b)).
  Series motion;
  constexpr double speed = 0.04;
  constexpr double rate = 20000.0;
  for (int n = 0; n <= 4000; ++n) {
    const double t = n / rate;
    motion.time.push_back(t);
    motion.x.push_back(t < 0.1 ? -speed * t : speed * (t - 0.2));
    motion.v.push_back(t < 0.1 ? -speed : speed);
  }
  const Vector friction = effect_alone("coulomb-friction", motion, {{"fc", 50.0}});
  for (std::size_t n = 2010; n < 2100; n += 10) {
    const double distance = speed * (static_cast<double>(n) - 2000.0) / rate;
    EXPECT_NEAR(friction[n], 50.0 * (1.0 - 2.0 * std::exp(-distance / (2e-5 + speed * 5e-4))), 2.0);
  }
}

TEST(Effects, ForcesInClosedForm) {
  const Series motion = sine(2.0, 0.025, 200.0, 1.0);
  const Vector gas = effect_alone("gas-spring", motion, {{"f_g", 150.0}, {"g", 8.0}});
  const Vector stop = effect_alone("end-stop", motion, {{"k_b", 2e5}, {"x_up", 0.02}, {"x_low", 0.023}, {"p", 2.0}});
  const Vector orifice = effect_alone("quadratic-damping", motion, {{"d2", 3000.0}});
  const Vector thin = effect_alone("shear-thinning", motion, {{"c_t", 700.0}, {"v_c", 0.05}, {"m", 0.4}});
  const Vector seal = effect_alone("seal-friction", motion, {{"fc", 60.0}, {"fb", 25.0}, {"v_st", 0.3}});
  const Vector film = effect_alone("coulomb-friction", motion, {{"fc", 50.0}, {"v_t", 0.4}});
  const Vector drift = effect_alone("force-drift", motion, {{"r", 7.0}});
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double x = motion.x[n];
    const double v = motion.v[n];
    EXPECT_NEAR(gas[n], 150.0 * std::pow(1.0 - 8.0 * x, -1.2), 1e-9);
    const double up = std::max(x - 0.02, 0.0);
    const double low = std::max(-x - 0.023, 0.0);
    EXPECT_NEAR(stop[n], 2e8 * (up * up - low * low), 1e-8);
    EXPECT_NEAR(orifice[n], 3000.0 * v * std::fabs(v), 1e-9);
    EXPECT_NEAR(thin[n], -700.0 * v * (1.0 - std::pow(1.0 + v * v / 0.0025, -0.3)), 1e-9);
    // Sliding long since the last turn: the sign is the velocity's.
    if (std::fabs(v) > 0.2 && n > motion.size() / 4) {
      EXPECT_NEAR(film[n], 50.0 * std::tanh(v / 0.4), 1e-5);
      EXPECT_NEAR(seal[n], (60.0 + 25.0 * std::exp(-v * v / 0.09)) * std::copysign(1.0, v), 1e-5);
    }
    EXPECT_NEAR(drift[n], 7.0 * motion.time[n], 1e-9);
  }
}

// Behind a part whose state the force drives, steps follow the state: they must be as fine as without it, at speeds at
// which a contact bends within a fraction of a sample too.
TEST(Effects, AHeatThatWeakensNothingLeavesEveryForceAsItIs) {
  for (const Part* effect : effect_catalogue()) {
    if (effect->id == "self-heating") {
      continue;
    }
    const CompositeModel model = make_model("bouc-wen", {std::string(effect->id)});
    const CompositeModel warm = make_model("bouc-wen", {std::string(effect->id), "self-heating"});
    for (const double amplitude : {2e-4, 5e-3}) {
      const Motion motion = sine(1.0, amplitude, 200.0, 1.0).motion();
      for (std::uint64_t seed = 400; seed < 406; ++seed) {
        Vector p = draw(model, seed, 0.0, false);
        const Vector force = simulate(model, motion, p);
        for (const Parameter& card : find_effect("self-heating")->parameters) {
          p.push_back(card.initial);
        }
        EXPECT_LT(rms_distance(simulate(warm, motion, p), force), 1e-3 * largest(force))
            << effect->id << " seed " << seed << " amplitude " << amplitude;
      }
    }
  }
}

}  // namespace
}  // namespace hysteron

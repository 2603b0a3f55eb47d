// Series elements against closed forms, in their limits, and in every company.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/extent.hpp"
#include "simulate/composite.hpp"
#include "simulate/drawn.hpp"

namespace hysteron {
namespace {

using testing::draw;
using testing::rms_distance;
using testing::with;
using Vector = std::vector<double>;
using Complex = std::complex<double>;
constexpr double w = 4.0 * std::numbers::pi;  // 2 Hz
constexpr double amplitude = 0.02;
const std::vector<std::string> elements = {"compliance", "clearance", "entrapped-gas", "series-dashpot"};

// x = amplitude sin(w t), with a second tone when `rich`.
Motion sine(double rate, double duration, bool rich = false) {
  Vector time;
  Vector x;
  Vector v;
  for (std::size_t n = 0; n < static_cast<std::size_t>(rate * duration); ++n) {
    const double t = static_cast<double>(n) / rate;
    time.push_back(t);
    x.push_back(amplitude * std::sin(w * t) + (rich ? 0.003 * std::sin(3.3 * w * t) : 0.0));
    v.push_back(amplitude * w * std::cos(w * t) + (rich ? 0.0099 * w * std::cos(3.3 * w * t) : 0.0));
  }
  return make_motion(time, x, v, {});
}

double distance(const Vector& a, const Vector& b) {
  double result = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    result = std::max(result, std::fabs(a[n] - b[n]));
  }
  return result;
}

// The last period against the real part of phasor exp(i w t).
void expect_phasor(const Motion& motion, const Vector& force, Complex phasor, double tolerance) {
  ASSERT_GT(std::abs(phasor), 10.0);
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (motion.time[n] > motion.time.back() - 0.5) {
      const double theory = (phasor * std::exp(Complex(0.0, w * motion.time[n]))).real();
      ASSERT_NEAR(force[n], theory, tolerance * std::abs(phasor)) << n;
    }
  }
}
const Complex velocity(amplitude* w, 0.0);  // v = Re(velocity exp(i w t))
const Complex i_omega(0.0, w);

TEST(Series, ComplianceAndDashpotAreMaxwell) {
  const CompositeModel model = make_model("viscous", {"compliance"});
  const Motion motion = sine(500.0, 2.0);
  const double c = 4000.0;
  for (const double compliance : {1e-6, 1e-5}) {
    const Vector force =
        simulate(model, motion, with(model, {{"c0", c}, {"compliance.C", compliance}, {"compliance.tau", 5e-4}}));
    const Complex spring = i_omega * compliance / (1.0 + i_omega * 5e-4);
    expect_phasor(motion, force, c * velocity / (1.0 + c * spring), 1e-4);
    // The element's own damping hardly shows.
    expect_phasor(motion, force, c * velocity / (1.0 + c * i_omega * compliance), 4e-3);
  }
}

TEST(Series, DashpotAndSpringAreMaxwell) {
  const CompositeModel model = make_model("viscous", {"series-dashpot"});
  const Motion motion = sine(500.0, 3.0);
  const double k = 5e4;
  const double e = 2e-4;
  const Vector force = simulate(model, motion, with(model, {{"c0", 0.0}, {"k0", k}, {"series-dashpot.e", e}}));
  expect_phasor(motion, force, k * velocity / (i_omega + k * e), 1e-4);
}

TEST(Series, DashpotsInSeriesAddTheirMobilities) {
  const CompositeModel model = make_model("viscous", {"series-dashpot"});
  const Motion motion = sine(200.0, 1.0);
  const Vector force = simulate(model, motion, with(model, {{"c0", 2000.0}, {"series-dashpot.e", 3e-4}}));
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_NEAR(force[n], motion.v[n] / (1.0 / 2000.0 + 3e-4), 1e-6);
  }
}

// The travel between the last force of one direction and the first of the other is the gap.
TEST(Series, ClearanceHasAPlateauOfItsWidth) {
  const CompositeModel model = make_model("viscous", {"clearance"});
  const Motion motion = sine(2000.0, 1.0);
  for (const double gap : {5e-4, 2e-3}) {
    const Vector force = simulate(model, motion, with(model, {{"c0", 5000.0}, {"clearance.gap", gap}}));
    const double open = 30.0;  // three times f_c: tanh 3 = 0.995 of the gap
    int plateaus = 0;
    std::size_t from = 0;
    for (std::size_t n = 1; n < force.size(); ++n) {
      if (std::fabs(force[n]) < open && std::fabs(force[n - 1]) >= open) {
        from = n;
      }
      if (std::fabs(force[n]) >= open && std::fabs(force[n - 1]) < open && from > 0) {
        // Turning within the plateau: the travel since the reversal counts.
        double turned = motion.x[from];
        for (std::size_t k = from; k < n; ++k) {
          turned = std::fabs(motion.x[k]) > std::fabs(turned) ? motion.x[k] : turned;
        }
        EXPECT_NEAR(std::fabs(motion.x[n] - turned), gap, 0.05 * gap) << motion.time[n];
        ++plateaus;
      }
    }
    EXPECT_GE(plateaus, 3);
    // Away from the plateau the law is bare.
    for (std::size_t n = 400; n < force.size(); ++n) {
      if (std::fabs(motion.x[n]) < 0.3 * amplitude) {
        EXPECT_NEAR(force[n], 5000.0 * motion.v[n], 1e-3 * peak_of(force));
      }
    }
  }
}

TEST(Series, EntrappedGasLosesItsTravelOnce) {
  const CompositeModel model = make_model("bouc-wen", {"entrapped-gas"});
  const CompositeModel bare = make_model("bouc-wen", {});
  const Motion motion = sine(500.0, 1.5);
  const std::vector<std::pair<std::string, double>> law = {{"alpha", 900.0}, {"c0", 0.0}, {"x_y", 1e-3}};
  auto soft = law;
  soft.emplace_back("entrapped-gas.d_a", 1e-3);
  soft.emplace_back("entrapped-gas.f_a", 100.0);
  const auto loop = [&](const Vector& f) {
    double area = 0.0;
    for (std::size_t n = 500; n < f.size(); ++n) {
      area += f[n] * motion.v[n] / 500.0;
    }
    return area;  // one period
  };
  // Saturated both ways the gas is compressed: the dissipation of a rate-independent law falls as on a stroke that is
  // shorter by d_a at either end.
  const double lost = loop(simulate(bare, motion, with(bare, law))) - loop(simulate(model, motion, with(model, soft)));
  EXPECT_NEAR(lost, 4.0 * 1e-3 * 900.0, 0.05 * 3.6);
}

TEST(Series, VanishesInTheLimit) {
  const Motion motion = sine(200.0, 1.0, true);
  const CompositeModel bare = make_model("bouc-wen", {});
  for (const std::string& id : elements) {
    const CompositeModel model = make_model("bouc-wen", {id});
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      Vector p = draw(bare, 900 + seed);
      // Finer steps for the law alone, which has longer ones.
      Motion finer = motion;
      finer.step_limit = 0.05;
      const Vector law = simulate(bare, finer, p);
      const Vector tail = with(model, {});
      p.insert(p.end(), tail.begin() + static_cast<std::ptrdiff_t>(p.size()), tail.end());
      const double upper = model.effects[0]->parameters[0].box.upper;
      for (const double size : {0.0, 1e-8 * upper}) {
        p[bare.parameter_count()] = size;
        EXPECT_LT(distance(simulate(model, motion, p), law), 1e-4 * peak_of(law)) << id << " " << seed << " " << size;
      }
    }
  }
}

TEST(Series, StepsAreFineEnough) {
  for (const double rate : {100.0, 1000.0}) {
    const Motion motion = sine(rate, 0.4, true);
    Motion tight = motion;
    tight.step_limit = 0.1;
    for (const std::string& id : elements) {
      for (const char* law : {"viscous", "bouc-wen", "modified-bouc-wen", "modified-dahl"}) {
        const CompositeModel model = make_model(law, {id});
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
          const Vector p = draw(model, 7100 + seed);
          const Vector force = simulate(model, motion, p);
          const Vector finer = simulate(model, tight, p);
          EXPECT_LT(rms_distance(force, finer), 1e-4 * peak_of(finer))
              << id << ", " << law << ", " << rate << " Hz, draw " << seed;
        }
      }
    }
  }
}

// Alone, among seven others, as the value of a dual and marched in pieces: the same bits.
TEST(Series, ACandidateDoesNotDependOnItsCompany) {
  const Motion motion = sine(100.0, 0.2, true);
  const std::size_t samples = motion.time.size();
  for (const auto& effects : std::vector<std::vector<std::string>>{{"clearance"},
                                                                   {"compliance"},
                                                                   {"entrapped-gas"},
                                                                   {"series-dashpot"},
                                                                   {"compliance", "inertia", "clearance"}}) {
    for (const char* law : {"bouc-wen", "lugre", "bingham", "viscous"}) {
      if (effects.size() > 1 && std::string(law) != "bingham") {
        continue;  // an element behind another costs the product of both
      }
      const CompositeModel model = make_model(law, effects);
      std::vector<Vector> rows;
      std::vector<Lanes> p(model.parameter_count());
      std::vector<LaneDual> dual_p;
      for (int lane = 0; lane < lane_count; ++lane) {
        rows.push_back(draw(model, static_cast<std::uint64_t>(60 + lane)));
        for (std::size_t j = 0; j < p.size(); ++j) {
          p[j].set_lane(lane, rows.back()[j]);
        }
      }
      for (std::size_t j = 0; j < p.size(); ++j) {
        dual_p.emplace_back(p[j]);
        if (j < sweep_directions) {
          dual_p.back().d[j] = Lanes(1.0);
        }
      }
      std::vector<Lanes> state(16), force(samples), piece_state(16), pieces(samples);
      std::vector<LaneDual> dual_state(16), dual(samples);
      model.march<Lanes>(motion, p.data(), 0, 0, samples, state.data(), force.data());
      for (std::size_t begin = 0; begin < samples; begin += 7) {
        model.march<Lanes>(motion, p.data(), 0, begin, std::min(begin + 7, samples), piece_state.data(),
                           pieces.data() + begin);
      }
      model.march<LaneDual>(motion, dual_p.data(), 0, 0, samples, dual_state.data(), dual.data());
      for (int lane = 0; lane < lane_count; ++lane) {
        const Vector alone = simulate(model, motion, rows[static_cast<std::size_t>(lane)]);
        for (std::size_t n = 0; n < samples; ++n) {
          const auto bits = std::bit_cast<std::uint64_t>(alone[n]);
          ASSERT_EQ(std::bit_cast<std::uint64_t>(force[n].lane(lane)), bits) << law << " " << effects[0] << " " << n;
          ASSERT_EQ(std::bit_cast<std::uint64_t>(pieces[n].lane(lane)), bits) << law << " " << effects[0] << " " << n;
          ASSERT_EQ(std::bit_cast<std::uint64_t>(dual[n].v.lane(lane)), bits) << law << " " << effects[0] << " " << n;
        }
      }
    }
  }
}

TEST(Series, ANeighbourWithNanDoesNotStopTheOthers) {
  const Motion motion = sine(100.0, 0.3);
  const CompositeModel model = make_model("bouc-wen", {"clearance"});
  const Vector good = with(model, {{"clearance.gap", 1e-3}});
  std::vector<Lanes> p(good.begin(), good.end());
  p[0].set_lane(2, std::numeric_limits<double>::quiet_NaN());
  std::vector<Lanes> state(16), force(motion.time.size());
  model.march<Lanes>(motion, p.data(), 0, 0, motion.time.size(), state.data(), force.data());
  const Vector alone = simulate(model, motion, good);
  for (std::size_t n = 0; n < alone.size(); ++n) {
    ASSERT_EQ(force[n].lane(5), alone[n]);
  }
}

// Velocities that pass zero within rounding of a sample leave an interval without room for the shortest step, which is
// taken where a candidate is too stiff to be followed.
TEST(Series, AReversalWithinRoundingOfASampleIsPassed) {
  Motion motion = comparing_motion(sine(100.0, 0.3));
  std::size_t placed = 0;
  for (MotionInterval& interval : motion.intervals) {
    if (interval.reversal) {
      interval.split_at = std::nextafter(1.0, 0.0);
      ++placed;
    }
  }
  ASSERT_GT(placed, 0U);
  for (const std::string& id : elements) {
    const CompositeModel model = make_model("bouc-wen", {id});
    Vector p = with(model, {{"alpha", 2000.0}, {"x_y", 1e-25}});
    p[model.law->parameters.size()] = model.effects[0]->parameters[0].box.upper;
    EXPECT_EQ(simulate(model, motion, p).size(), motion.time.size()) << id;
  }
}

// What a linearisation at the bare law relies on: the size of every effect acts at first order where it vanishes.
TEST(Effects, SizeActsAtFirstOrderWhereItVanishes) {
  const Motion motion = [] {
    Motion m = sine(200.0, 1.0, true);
    for (std::size_t n = 0; n < m.time.size(); ++n) {
      m.drive.push_back(0.6 + 0.4 * std::sin(31.0 * m.time[n]));
    }
    return m;
  }();
  for (const Part* effect : effect_catalogue()) {
    if (effect->on_double.excite != nullptr || effect->id == "cavitation" || effect->id == "end-stop") {
      continue;  // seen by the laws of parameters only; beyond a limit only
    }
    const CompositeModel model = make_model("bouc-wen", {std::string(effect->id)});
    const Vector p = with(model, {{"c0", 800.0}, {"k0", 900.0}});
    const std::size_t size = model.law->parameters.size();
    std::vector<LaneDual> dual(p.begin(), p.end());
    std::vector<LaneDual> state(16), force(motion.time.size());
    const Parameter& card = effect->parameters[0];
    dual[size].d[0] = Lanes(card.box.upper - card.box.lower);
    model.march<LaneDual>(motion, dual.data(), 0, 0, motion.time.size(), state.data(), force.data());
    double change = 0.0;
    double scale = 0.0;
    for (const LaneDual& f : force) {
      change = std::max(change, std::fabs(f.d[0].lane(0)));
      scale = std::max(scale, std::fabs(f.v.lane(0)));
    }
    EXPECT_GT(change, 1e-2 * scale) << effect->id;
  }
}

// Distance travelled up in one return stroke of a 1 Hz sine before the force builds up again.
double dwell_of(const Motion& motion, const Vector& force, double least) {
  double dwell = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    const double t = motion.time[n];
    if (t > 0.375 && t < 0.625 && motion.v[n] > 0.0 && std::fabs(force[n]) < least) {
      dwell += motion.v[n] / 2000.0;
    }
  }
  return dwell;
}

TEST(Effects, CavitationOfAViscousDamperLimitsOneSideAndDwells) {
  const CompositeModel model = make_model("viscous", {"cavitation"});
  const Motion motion = sine(2000.0, 1.0);
  const double c = 4000.0;
  const double limit = 400.0;
  const Vector force = simulate(
      model, motion,
      with(model, {{"c0", c}, {"cavitation.kappa", 1.0 / limit}, {"cavitation.w", 1.0}, {"cavitation.s_r", 2e-5}}));
  // The void of one suction stroke: integral of |v| - limit / c while c |v| > limit.
  double opened = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_GE(force[n], -limit * (1.0 + 1e-9));
    if (motion.time[n] > 0.125 && motion.time[n] < 0.375) {
      opened += std::max(-motion.v[n] - limit / c, 0.0) / 2000.0;
    }
  }
  ASSERT_GT(opened, 5e-3);
  EXPECT_NEAR(dwell_of(motion, force, 50.0), opened, 1e-4);  // s_r = 0.02 mm
}

TEST(Effects, CavitationOfDryFrictionPartsTheWholeMotion) {
  const CompositeModel model = make_model("bingham", {"cavitation"});
  const Motion motion = sine(2000.0, 1.0);
  const Vector force = simulate(model, motion,
                                with(model, {{"fc", 600.0},
                                             {"c0", 0.0},
                                             {"f0", 0.0},
                                             {"cavitation.kappa", 1.0 / 400.0},
                                             {"cavitation.w", 0.01},
                                             {"cavitation.s_r", 2e-5}}));
  // 0.5 / 0.51 of the stroke down is void, so that the half stroke up to the end of the record is dwell.
  double stroke = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_GE(force[n], -400.0 * (1.0 + 1e-9));
    stroke = std::max(stroke, motion.x[n]);
  }
  double whole = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (motion.v[n] > 0.0 && motion.time[n] > 0.75 && std::fabs(force[n]) < 50.0) {
      whole += motion.v[n] / 2000.0;
    }
  }
  EXPECT_NEAR(whole, stroke, 0.01 * stroke);
}

// A damper that yields over 2 mm unloads along its own line before the void lets go of the force.
TEST(Effects, CavitationLetsTheDamperUnloadFirst) {
  const Motion motion = sine(2000.0, 1.0);
  const CompositeModel law = make_model("bouc-wen", {});
  const Vector alone = simulate(law, motion, with(law, {{"alpha", 600.0}, {"x_y", 2e-3}, {"n", 1.0}}));
  const CompositeModel model = make_model("bouc-wen", {"cavitation"});
  const Vector force = simulate(model, motion,
                                with(model, {{"alpha", 600.0},
                                             {"x_y", 2e-3},
                                             {"n", 1.0},
                                             {"cavitation.kappa", 1.0 / 400.0},
                                             {"cavitation.w", 0.01},
                                             {"cavitation.s_r", 2e-5}}));
  std::size_t unloading = 0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    EXPECT_GE(force[n], -400.0 * (1.0 + 1e-9));
    if (motion.v[n] > 0.0 && alone[n] < 0.0 && alone[n] > -400.0) {
      EXPECT_NEAR(force[n], alone[n], 1e-3 * 400.0);
      ++unloading;
    }
  }
  EXPECT_GT(unloading, 20U);
}

// Deflection d_a (tanh(q / f_a - e_a) + tanh e_a): nothing at rest, 2 d_a in all, the softest at e_a f_a.
TEST(Effects, GasInOneChamberIsSoftestOffZeroForce) {
  const Part& part = *make_model("viscous", {"entrapped-gas"}).effects[0];
  const double d_a = 1e-3;
  const double f_a = 200.0;
  for (const double e_a : {-2.0, 0.0, 0.7, 2.0}) {
    const std::vector<double> p = {d_a, f_a, e_a, 0.0, 5e-4};
    const auto at = [&](double q) {
      Yield<double> result;
      part.on_double.yield(p.data(), q, result);
      return result;
    };
    EXPECT_EQ(at(0.0).deflection, 0.0);
    EXPECT_NEAR(at(1e5).deflection - at(-1e5).deflection, 2.0 * d_a, 1e-12);
    EXPECT_NEAR(at(1e5).deflection, d_a * (1.0 + std::tanh(e_a)), 1e-12);
    EXPECT_GT(at(e_a * f_a).slope, at((e_a + 0.2) * f_a).slope);
    EXPECT_GT(at(e_a * f_a).slope, at((e_a - 0.2) * f_a).slope);
    const double h = 0.1;
    for (const double q : {-500.0, 0.0, 90.0, 400.0}) {
      EXPECT_NEAR(at(q).slope, (at(q + h).deflection - at(q - h).deflection) / (2.0 * h), 1e-6 * d_a / f_a);
      EXPECT_NEAR(at(q).bend, (at(q + h).slope - at(q - h).slope) / (2.0 * h), 1e-6 * d_a / (f_a * f_a));
    }
  }
}

TEST(Effects, PinchingTakesTheMiddle) {
  const CompositeModel model = make_model("viscous", {"pinching"});
  const Motion motion = sine(200.0, 1.0);
  const Vector force =
      simulate(model, motion, with(model, {{"c0", 1000.0}, {"pinching.p", 0.6}, {"pinching.w", 3e-3}}));
  for (std::size_t n = 0; n < force.size(); ++n) {
    const double share = 1.0 - 0.6 * std::exp(-std::pow(motion.x[n] / 3e-3, 2));
    EXPECT_NEAR(force[n], 1000.0 * motion.v[n] * share, 1e-9);
  }
}

}  // namespace
}  // namespace hysteron

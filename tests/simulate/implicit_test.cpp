// Steps that need not follow series elements: order, stiffness, derivatives, and the exact march beside them.
#include "simulate/implicit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/extent.hpp"
#include "simulate/compile.hpp"
#include "simulate/drawn.hpp"
#include "simulate/motion.hpp"

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

Motion sine(double rate, double duration) {
  Vector time;
  Vector x;
  Vector v;
  for (std::size_t n = 0; n < static_cast<std::size_t>(rate * duration); ++n) {
    const double t = static_cast<double>(n) / rate;
    time.push_back(t);
    x.push_back(amplitude * std::sin(w * t));
    v.push_back(amplitude * w * std::cos(w * t));
  }
  return make_motion(time, x, v, {});
}

// Steps of one interval each, balanced to the last bits.
Motion implicit(Motion motion) {
  motion = comparing_motion(std::move(motion));
  motion.balance_tolerance = 1e-12;
  motion.balance_iterations = 60;
  return motion;
}

// Largest error over the last period against the real part of phasor exp(i w t), over its size.
double error_of(const Motion& motion, const Vector& force, Complex phasor) {
  double result = 0.0;
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (motion.time[n] > motion.time.back() - 0.5) {
      const double theory = (phasor * std::exp(Complex(0.0, w * motion.time[n]))).real();
      result = std::max(result, std::fabs(force[n] - theory));
    }
  }
  return result / std::abs(phasor);
}
const Complex velocity(amplitude* w, 0.0);  // v = Re(velocity exp(i w t))
const Complex i_omega(0.0, w);

TEST(Implicit, IsOfSecondOrder) {
  // A spring behind a dashpot that relaxes in 0.1 s: k / (c1 k) with e = 1 / c1.
  const CompositeModel model = make_model("viscous", {"series-dashpot"});
  const double k = 5e4;
  const double e = 2e-4;
  const Complex phasor = k * velocity / (i_omega + k * e);
  double before = 0.0;
  for (const double rate : {50.0, 100.0, 200.0, 400.0}) {
    const Motion motion = implicit(sine(rate, 3.0));
    const double error = error_of(
        motion, simulate(model, motion, with(model, {{"c0", 0.0}, {"k0", k}, {"series-dashpot.e", e}})), phasor);
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.5) << rate;
    }
    before = error;
  }
  EXPECT_LT(before, 1e-4);
}

TEST(Implicit, FollowsWhatIsStiffWithOneStepBetweenTwoSamples) {
  // The spring's own damping relaxes 4 to 40 times between two samples.
  const CompositeModel model = make_model("viscous", {"compliance"});
  const double c = 4000.0;
  for (const double rate : {50.0, 500.0}) {
    const Motion motion = implicit(sine(rate, 2.0));
    for (const double compliance : {1e-9, 1e-6, 1e-5}) {
      const Vector force =
          simulate(model, motion, with(model, {{"c0", c}, {"compliance.C", compliance}, {"compliance.tau", 5e-4}}));
      const Complex spring = i_omega * compliance / (1.0 + i_omega * 5e-4);
      EXPECT_LT(error_of(motion, force, c * velocity / (1.0 + c * spring)), 2e-3) << rate << " Hz, " << compliance;
    }
  }
}

// What is lost lies at kinks within a step, where the error is of first order or better: it falls to a half at least
// when samples are twice as dense.
TEST(Implicit, ApproachesTheMarchThatFollowsEverything) {
  for (const std::string& id : elements) {
    const auto typical_error = [&](double rate) {
      std::vector<double> errors;
      for (const char* law : {"viscous", "bouc-wen", "modified-bouc-wen", "modified-dahl"}) {
        const CompositeModel model = make_model(law, {id});
        for (std::uint64_t seed = 0; seed < 8; ++seed) {
          const Vector p = draw(model, 7100 + seed);
          const Motion motion = sine(rate, 1.0);
          const Vector exact = simulate(model, motion, p);
          errors.push_back(rms_distance(simulate(model, comparing_motion(motion), p), exact) / peak_of(exact));
        }
      }
      std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
      return errors[errors.size() / 2];
    };
    const double coarse = typical_error(200.0);
    EXPECT_LT(coarse, 5e-3) << id;  // a hundred samples a period
    const bool straight = id == "compliance" || id == "series-dashpot";
    EXPECT_LT(typical_error(800.0), straight ? coarse / 4.0 : coarse) << id;
  }
}

TEST(Implicit, DerivativesAreThoseOfTheForce) {
  Motion motion = implicit(sine(200.0, 0.6));
  motion.most_substeps = 1.0;  // lengths of steps follow the parameters, and are not differentiated
  const std::vector<std::pair<std::string, double>> sizes = {
      {"compliance.C", 3e-6},   {"clearance.gap", 1e-3}, {"entrapped-gas.d_a", 1e-3}, {"series-dashpot.e", 1e-4},
      {"self-heating.b", 1e-3}, {"degradation.d", 1e-4}, {"inertia.m", 2.0},          {"x_y", 2e-3}};
  for (const auto& effects : std::vector<std::vector<std::string>>{{"compliance"},
                                                                   {"clearance"},
                                                                   {"entrapped-gas"},
                                                                   {"series-dashpot"},
                                                                   {"self-heating", "compliance"},
                                                                   {"compliance", "degradation"},
                                                                   {"compliance", "inertia", "series-dashpot"}}) {
    const CompositeModel model = make_model("modified-dahl", effects);
    const std::vector<std::string> names = model.parameter_names();
    Vector p = with(model, {});
    for (const auto& [name, value] : sizes) {
      if (const auto at = std::ranges::find(names, name); at != names.end()) {
        p[static_cast<std::size_t>(at - names.begin())] = value;
      }
    }
    for (std::size_t j = 0; j < std::min<std::size_t>(p.size(), 12); ++j) {
      std::vector<LaneDual> dual(p.begin(), p.end());
      const double scale = p[j] == 0.0 ? 0.01 * model.parameters()[j].box.upper : std::fabs(p[j]);
      dual[j].d[0] = Lanes(scale);
      std::vector<LaneDual> state(16), force(motion.time.size());
      model.march<LaneDual>(motion, dual.data(), 0, 0, motion.time.size(), state.data(), force.data());
      Vector up = p;
      Vector down = p;
      constexpr double h = 1e-5;
      up[j] += h * scale;
      down[j] -= h * scale;
      const Vector above = simulate(model, motion, up);
      const Vector below = simulate(model, motion, down);
      Vector slope;
      Vector expected;
      for (std::size_t n = 0; n < force.size(); ++n) {
        slope.push_back(force[n].d[0].lane(0));
        expected.push_back((above[n] - below[n]) / (2.0 * h));
      }
      EXPECT_LT(rms_distance(slope, expected), 1e-3 * std::max(peak_of(expected), 1e-6))
          << effects[0] << " " << model.parameter_names()[j];
    }
  }
}

// A force that is no number has no sign: compilers order the operands of a sum as they like, and the NaN of one of them
// is passed on.
std::uint64_t bits_of(double force) {
  return std::bit_cast<std::uint64_t>(std::isnan(force) ? std::numeric_limits<double>::quiet_NaN() : force);
}

// Alone, among seven others and marched in pieces: the same bits; the value of a dual too where no element stands
// behind another.
TEST(Implicit, ACandidateDoesNotDependOnItsCompany) {
  const Motion motion = comparing_motion(sine(100.0, 0.4));
  const std::size_t samples = motion.time.size();
  for (const std::string& id : elements) {
    for (const char* law : {"bouc-wen", "lugre", "viscous"}) {
      const CompositeModel model = make_model(law, {id});
      std::vector<Vector> rows;
      std::vector<Lanes> p(model.parameter_count());
      for (int lane = 0; lane < lane_count; ++lane) {
        rows.push_back(draw(model, static_cast<std::uint64_t>(60 + lane)));
        for (std::size_t j = 0; j < p.size(); ++j) {
          p[j].set_lane(lane, rows.back()[j]);
        }
      }
      std::vector<LaneDual> dual_p(p.begin(), p.end());
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
          const auto bits = bits_of(alone[n]);
          ASSERT_EQ(bits_of(force[n].lane(lane)), bits) << law << " " << id << " " << n;
          ASSERT_EQ(bits_of(pieces[n].lane(lane)), bits) << law << " " << id << " " << n;
          ASSERT_EQ(bits_of(dual[n].v.lane(lane)), bits) << law << " " << id << " " << n;
        }
      }
    }
  }
}

// Five lags of the velocity, one behind the other: more states than the steps have room for.
struct FiveLags {
  static constexpr std::string_view id = "five-lags";
  static constexpr std::string_view title = "Five lags";
  static constexpr std::string_view reference = "none";
  static constexpr std::string_view equations[] = {"F = c s_5", "s_1' = (v - s_1) / tau", "s_k' = (s_k-1 - s_k) / tau"};
  static constexpr int states = 5;
  static constexpr Parameter parameters[] = {
      {.name = "c", .unit = "N s/m", .meaning = "damping", .box = {0, 1e4}, .initial = 1e3, .linear = true}};
  static constexpr double tau = 5e-3;  // s

  template <class T>
  static std::array<T, 5> rate(const std::array<T, 1>& /*p*/, const std::array<T, 5>& s, const Input<T>& in) {
    std::array<T, 5> result;
    for (std::size_t k = 0; k < 5; ++k) {
      result[k] = ((k == 0 ? in.v : s[k - 1]) - s[k]) * T(1.0 / tau);
    }
    return result;
  }
  template <class T>
  static T stiffness(const std::array<T, 1>& /*p*/, double /*speed*/) {
    return T(2.0 / tau);
  }
  template <class T>
  static T force(const std::array<T, 1>& p, const std::array<T, 5>& s, const Input<T>& /*in*/, const T& /*below*/) {
    return p[0] * s[4];
  }
};
constexpr Part five_lags = compile<FiveLags>();

TEST(Implicit, APartWithMoreStatesIsFollowed) {
  const CompositeModel model{&five_lags, {find_effect("compliance")}};
  ASSERT_FALSE(takes_implicit_steps(model));
  ASSERT_TRUE(takes_implicit_steps(make_model("preisach", {"compliance"})));
  const Motion motion = sine(500.0, 1.0);
  const Vector p = with(model, {{"compliance.C", 1e-6}});
  const Vector exact = simulate(model, motion, p);
  EXPECT_LT(rms_distance(simulate(model, comparing_motion(motion), p), exact), 1e-3 * peak_of(exact));
}

TEST(Implicit, ANeighbourWithNanDoesNotStopTheOthers) {
  const Motion motion = comparing_motion(sine(100.0, 0.3));
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

}  // namespace
}  // namespace hysteron

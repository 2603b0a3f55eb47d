// Series elements under a known force: fed with the force that the balance gives, the march gives that force back.
#include "simulate/under_load.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "simulate/composite.hpp"

namespace hysteron {
namespace {

// Two amplitudes and frequencies, so that no phase is special.
Motion motion_of(double step) {
  std::vector<double> time;
  std::vector<double> x;
  std::vector<double> v;
  for (double t = 0.0; t < 2.0; t += step) {
    time.push_back(t);
    x.push_back(8e-3 * std::sin(7.0 * t) + 3e-3 * std::sin(17.0 * t));
    v.push_back(56e-3 * std::cos(7.0 * t) + 51e-3 * std::cos(17.0 * t));
  }
  return make_motion(time, x, v, {});
}

struct Case {
  std::vector<std::string> effects;
  std::vector<std::pair<std::string, double>> sizes;
};

std::vector<double> parameters_of(const CompositeModel& model, const Case& one) {
  std::vector<double> result;
  for (const Parameter& parameter : model.parameters()) {
    result.push_back(parameter.initial);
  }
  const std::vector<std::string> names = model.parameter_names();
  for (const auto& [name, value] : one.sizes) {
    result[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())] = value;
  }
  return result;
}

// Root mean square difference from the balance, over the peak force.
double difference(const Case& one, double step) {
  const CompositeModel model = make_model("bouc-wen", one.effects);
  const std::vector<double> p = parameters_of(model, one);
  Motion motion = motion_of(step);
  const std::vector<double> balance = simulate(model, motion, p);
  motion.load = balance;
  const std::vector<double> given_back = simulate(model, motion, p);
  double sum = 0.0;
  double peak = 0.0;
  for (std::size_t n = 0; n < balance.size(); ++n) {
    sum += (given_back[n] - balance[n]) * (given_back[n] - balance[n]);
    peak = std::max(peak, std::fabs(balance[n]));
  }
  return std::sqrt(sum / static_cast<double>(balance.size())) / peak;
}

const Case play = {{"clearance"}, {{"clearance.gap", 1e-3}, {"clearance.C_c", 3e-7}}};

// A held element follows the force with the time constant tau, which the march under load leaves out: its error is of
// first order in it where the element is straight, and falls at least as fast where it bends.
TEST(UnderLoad, HeldElementsGiveTheForceOfTheBalanceBackButForTheirTimeConstant) {
  const std::vector<Case> cases = {
      {{"compliance"}, {{"compliance.C", 2e-6}}},
      play,
      {{"entrapped-gas"}, {{"entrapped-gas.d_a", 1e-3}, {"entrapped-gas.C_c", 2e-7}}},
      {{"sensor-delay", "compliance", "stiction"}, {{"sensor-delay.lag", 3e-3}, {"compliance.C", 2e-6}}},
  };
  for (Case one : cases) {
    const std::string held = one.effects.front() == "sensor-delay" ? "compliance" : one.effects.front();
    one.sizes.emplace_back(held + ".tau", 2e-3);
    const double slow = difference(one, 1e-3);
    one.sizes.back().second = 2e-4;
    const double fast = difference(one, 1e-3);
    EXPECT_LT(slow, 0.04) << held;
    EXPECT_GT(slow / fast, 5.0) << held;
    if (held == "compliance") {
      EXPECT_LT(slow / fast, 15.0);
    }
  }
}

// What nothing holds is integrated by the trapezoidal rule: of second order in the sampling interval.
TEST(UnderLoad, ADashpotGivesTheForceOfTheBalanceBackToSecondOrder) {
  const Case dashpot = {{"series-dashpot"}, {{"series-dashpot.e", 1e-5}}};
  const double coarse = difference(dashpot, 8e-3);
  const double fine = difference(dashpot, 2e-3);
  EXPECT_LT(coarse, 0.01);
  EXPECT_GT(coarse / fine, 8.0);
}

TEST(UnderLoad, HeatFollowsTheMeasuredForce) {
  const Case heat = {{"self-heating"}, {{"self-heating.b", 1e-4}}};
  EXPECT_LT(difference(heat, 2e-3), 1e-3);
}

TEST(UnderLoad, AnElementOfNoSizeLeavesTheForceOfTheLaw) {
  const Case none = {{"compliance", "series-dashpot"}, {}};
  const CompositeModel model = make_model("bouc-wen", none.effects);
  const CompositeModel law = make_model("bouc-wen", {});
  Motion motion = motion_of(2e-3);
  const std::vector<double> alone = simulate(law, motion, parameters_of(law, {}));
  motion.load.assign(motion.time.size(), 700.0);
  const std::vector<double> loaded = simulate(model, motion, parameters_of(model, none));
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_NEAR(loaded[n], alone[n], 1e-2) << n;  // 1e-5 of the peak: the law's kinks are looked for where it is alone
  }
}

TEST(UnderLoad, ALaneDoesNotDependOnItsCompany) {
  const Case& one = play;
  const CompositeModel model = make_model("bouc-wen", one.effects);
  const std::vector<double> p = parameters_of(model, one);
  Motion motion = motion_of(4e-3);
  motion.load = simulate(model, motion, p);
  const std::vector<double> alone = simulate(model, motion, p);
  std::vector<Lanes> packed(p.size());
  for (std::size_t j = 0; j < p.size(); ++j) {
    for (int lane = 0; lane < lane_count; ++lane) {
      // The other lanes are stiffer or softer.
      packed[j].set_lane(lane,
                         model.parameter_names()[j] == "x_y" ? p[j] * (lane == 3 ? 1.0 : 0.4 + 0.5 * lane) : p[j]);
    }
  }
  std::vector<Lanes> state(static_cast<std::size_t>(std::max(model.states(), 16)));
  std::vector<Lanes> out(motion.time.size());
  model.march<Lanes>(motion, packed.data(), 0, 0, motion.time.size(), state.data(), out.data());
  for (std::size_t n = 0; n < alone.size(); ++n) {
    EXPECT_EQ(out[n].lane(3), alone[n]) << n;
  }
}

}  // namespace
}  // namespace hysteron

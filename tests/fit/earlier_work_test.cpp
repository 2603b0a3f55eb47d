// Heat and wear that go on from one recording to the next: two routes to one force.
#include "core/earlier_work.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "fit/layout.hpp"
#include "fit/objective.hpp"
#include "fit/predict.hpp"
#include "simulate/composite.hpp"

namespace hysteron {
namespace {

constexpr double step = 2e-3;
constexpr double moving = 8.0;  // s, from rest to rest
constexpr double pause = 30.0;

// A sine of 2 Hz and 20 mm that rises from rest and dies away within `moving` seconds.
void append_motion(Recording& recording, double from, double until, double begin) {
  const double omega = 4.0 * std::numbers::pi;
  for (double t = from; t < until - 0.5 * step; t += step) {
    const double at = std::clamp((t - begin) / moving, 0.0, 1.0);
    const double window = std::pow(std::sin(std::numbers::pi * at), 2);
    const double slope = at > 0.0 && at < 1.0 ? std::numbers::pi / moving * std::sin(2.0 * std::numbers::pi * at) : 0.0;
    recording.time.push_back(t);
    recording.displacement.push_back(0.02 * window * std::sin(omega * t));
    recording.velocity.push_back(0.02 * (window * omega * std::cos(omega * t) + slope * std::sin(omega * t)));
  }
}

std::vector<double> values_of(const CompositeModel& model, const std::map<std::string, double>& set) {
  std::vector<double> values;
  const std::vector<std::string> names = model.parameter_names();
  const std::vector<Parameter> cards = model.parameters();
  for (std::size_t k = 0; k < names.size(); ++k) {
    values.push_back(set.contains(names[k]) ? set.at(names[k]) : cards[k].initial);
  }
  return values;
}

std::vector<double> force_of(const CompositeModel& model, const std::vector<double>& values,
                             const Recording& recording) {
  return predict(model, values, {}, make_target(recording, {}));
}

void two_routes(const std::string& effect, const std::map<std::string, double>& set) {
  const CompositeModel model = make_model("viscous", {effect});
  const std::vector<double> values = values_of(model, set);
  // The whole afternoon in one recording.
  const double second = std::round((moving + pause) * 2.0) / 2.0;  // in phase
  Recording whole;
  whole.velocity_measured = true;
  append_motion(whole, 0.0, moving, 0.0);
  append_motion(whole, moving, second, 0.0);
  append_motion(whole, second, second + moving, second);
  whole.force.assign(whole.size(), 1.0);
  whole.force = force_of(model, values, whole);
  // The two motions as recordings of their own.
  std::vector<Recording> parts(2);
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const bool late = whole.time[n] > second - 0.5 * step;
    if (!late && whole.time[n] > moving) continue;
    Recording& part = parts[late ? 1 : 0];
    part.time.push_back(whole.time[n] - (late ? second : 0.0));
    part.displacement.push_back(whole.displacement[n]);
    part.velocity.push_back(whole.velocity[n]);
    part.force.push_back(whole.force[n]);
  }
  const double peak = *std::ranges::max_element(parts[0].force);
  const auto difference = [&] {
    const std::vector<double> force = force_of(model, values, parts[1]);
    double largest = 0.0;
    for (std::size_t n = 0; n < force.size(); ++n) largest = std::max(largest, std::fabs(force[n] - parts[1].force[n]));
    return largest / peak;
  };
  EXPECT_GT(difference(), 0.05) << "cold and new without the starts";
  parts[0].started = 1e9;
  parts[1].started = 1e9 + second;
  ASSERT_FALSE(carry_work(parts).has_value());
  EXPECT_LT(difference(), 1e-3);
}

TEST(EarlierWork, SelfHeatingGoesOnAfterThePause) {
  two_routes("self-heating", {{"c0", 2000.0},
                              {"self-heating.b", 2e-3},
                              {"self-heating.tau", 40.0},
                              {"self-heating.y", 0.5},
                              {"self-heating.c_h", 1500.0}});
}

TEST(EarlierWork, DegradationGoesOnAfterThePause) {
  two_routes("degradation", {{"c0", 2000.0}, {"degradation.d", 1e-3}});
}

TEST(EarlierWork, DerivativesHoldTheHeatThatIsLeft) {
  LayoutOptions held;
  held.bounds["self-heating.tau"] = {5.0, 100.0};
  const Layout layout(make_model("viscous", {"self-heating"}), DataScale{800.0, 0.02, 0.25}, held);
  std::vector<Recording> recordings(2);
  for (Recording& recording : recordings) {
    append_motion(recording, 0.0, moving, 0.0);
    recording.velocity_measured = true;
    recording.force.assign(recording.size(), 100.0);
  }
  recordings[1].earlier = {{60.0, 300.0}, {20.0, 200.0}};
  ObjectiveOptions options;
  options.tolerance = 1e-9;
  const Objective of(layout, recordings, options);
  const std::size_t d = of.layout().dimension();
  const std::vector<double> u(d, 0.4);
  const Response response = of.evaluate({u, true});
  constexpr double h = 1e-5;
  for (std::size_t c = 0; c < d; ++c) {
    std::vector<double> two;
    for (const double side : {-h, h}) {
      two.insert(two.end(), u.begin(), u.end());
      two[two.size() - d + c] += side;
    }
    const Response around = of.evaluate({two, false});
    const double numeric = 0.5 * (around.cost[1] * around.cost[1] - around.cost[0] * around.cost[0]) / (2.0 * h);
    EXPECT_NEAR(response.gradient[c], numeric, 2e-4 * std::max(std::fabs(numeric), 1e-3)) << c;
  }
}

}  // namespace
}  // namespace hysteron

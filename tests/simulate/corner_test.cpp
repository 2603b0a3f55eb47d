#include "simulate/corner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "simulate/composite.hpp"
#include "simulate/drawn.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;

struct Recorded {
  Vector time;
  Vector x;
  Vector v;
};

// Triangles of 10 mm and 50 mm/s, which turn every 0.4 s, first after 0.2 s. A sample on a corner has the mean speed.
constexpr double speed = 0.05;
constexpr double half_period = 0.4;

Recorded triangles(double step, double begin, double duration) {
  Recorded result;
  for (int n = 0; n * step <= duration; ++n) {
    const double t = begin + n * step;
    const double sweep = (t + 0.5 * half_period) / half_period;  // turns at whole numbers
    const double since = sweep - std::floor(sweep);
    const double way = static_cast<int>(std::floor(sweep)) % 2 == 0 ? 1.0 : -1.0;
    const bool on_corner = std::min(since, 1.0 - since) * half_period < 1e-9;
    result.time.push_back(t);
    result.x.push_back(way * speed * half_period * (since - 0.5));
    result.v.push_back(on_corner && t > 1e-9 ? 0.0 : way * speed);
  }
  return result;
}

std::optional<VelocityCorner> corner_in(const Recorded& r, std::size_t n) { return corner_of(r.time, r.x, r.v, n); }

TEST(Corner, LiesWhereTheLinesMeet) {
  const double step = 0.01;
  for (const double share : {0.02, 0.3, 0.5, 0.9}) {
    const Recorded r = triangles(step, (1.0 - share) * step, 0.95);
    int found = 0;
    for (std::size_t n = 0; n + 1 < r.time.size(); ++n) {
      const auto corner = corner_in(r, n);
      const double nearest =
          (std::round((r.time[n] - 0.2) / half_period + 0.5 * step / half_period)) * half_period + 0.2;
      const bool inside = nearest > r.time[n] && nearest < r.time[n + 1];
      EXPECT_EQ(corner.has_value(), inside) << share << ' ' << n;
      if (!corner || !inside) continue;
      ++found;
      EXPECT_NEAR(r.time[n] + corner->at * step, nearest, 1e-12);
      EXPECT_DOUBLE_EQ(std::fabs(corner->start - corner->end), 2.0 * speed);
    }
    EXPECT_GE(found, 2);
  }
}

TEST(Corner, OnASampleTurnsTheIntervalsBesideIt) {
  const Recorded r = triangles(0.01, 0.0, 1.0);
  for (std::size_t n = 0; n + 1 < r.time.size(); ++n) {
    const bool before = n == 19 || n == 59;
    const bool after = n == 20 || n == 60;
    const auto corner = corner_in(r, n);
    ASSERT_EQ(corner.has_value(), before || after) << n;
    EXPECT_NEAR(corner.value_or(VelocityCorner{}).at, before ? 1.0 : 0.0, 1e-9) << n;
  }
}

TEST(Corner, IsNotSeenInSmoothMotion) {
  // Sines of four and more samples a period, and arcs of constant acceleration, whose velocity is a triangle.
  for (const double samples : {4.0, 7.3, 20.0, 300.0}) {
    Recorded sine;
    Recorded arcs;
    for (int n = 0; n < 400; ++n) {
      const double turn = n / samples;
      sine.time.push_back(turn);
      sine.x.push_back(0.01 * std::sin(2.0 * std::numbers::pi * turn + 0.3));
      sine.v.push_back(0.02 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * turn + 0.3));
      const double phase = turn + 0.1 - std::floor(turn + 0.1);
      arcs.time.push_back(turn);
      arcs.v.push_back(phase < 0.5 ? 4.0 * phase - 1.0 : 3.0 - 4.0 * phase);
      arcs.x.push_back(phase < 0.5 ? 2.0 * phase * phase - phase : 3.0 * phase - 2.0 * phase * phase - 1.0);
    }
    for (std::size_t n = 0; n + 1 < sine.time.size(); ++n) {
      EXPECT_FALSE(corner_in(sine, n).has_value()) << samples << ' ' << n;
      EXPECT_FALSE(corner_in(arcs, n).has_value()) << samples << ' ' << n;
    }
  }
}

// Steps of the noise of a held rod between samples that agree by chance, beside a motion that is fast.
TEST(Corner, IsNotSeenInTheNoiseOfAHeldRod) {
  Recorded r = triangles(0.01, 0.003, 0.95);
  for (std::size_t n = 0; n < r.time.size(); ++n) {
    if (r.time[n] < 0.5) continue;
    r.x[n] = 0.0;
    r.v[n] = n % 4 < 2 ? 1e-4 : -1e-4;
  }
  for (std::size_t n = 51; n + 3 < r.time.size(); ++n) EXPECT_FALSE(corner_in(r, n).has_value()) << n;
  // The same alone is a motion with corners.
  for (double& v : r.v) v = std::clamp(v, -1e-4, 1e-4);
  int found = 0;
  for (std::size_t n = 51; n + 3 < r.time.size(); ++n) found += corner_in(r, n).has_value() ? 1 : 0;
  EXPECT_GT(found, 0);
}

// Largest difference between the force of samples `step` apart and that of 64 times as many, of peak force, away from
// samples on a corner, where the speed and with it the force has two values.
double error_of(const CompositeModel& model, double step, double begin, const std::function<Motion(Motion)>& as) {
  constexpr std::size_t finer = 64;
  const auto force = [&](const Recorded& r) {
    return simulate(model, as(make_motion(r.time, r.x, r.v, {})), testing::with(model, {}));
  };
  const Recorded coarse = triangles(step, begin, 0.95);
  const Vector few = force(coarse);
  const Vector many = force(triangles(step / finer, begin, 0.95));
  double worst = 0.0;
  double peak = 0.0;
  for (std::size_t n = 0; n < few.size() && n * finer < many.size(); ++n) {
    peak = std::max(peak, std::fabs(many[n * finer]));
    if (coarse.v[n] != 0.0) worst = std::max(worst, std::fabs(few[n] - many[n * finer]));
  }
  return worst / peak;
}

struct Case {
  std::string law;
  std::vector<std::string> effects;
};

// 0.4 mm between samples, which is a good part of the yield displacements. Interpolated across the corners the velocity
// turns hysteresis early: 2 to 20 % of peak force after them.
TEST(Corner, HysteresisTurnsAtItWhereverTheSamplesLie) {
  const std::vector<Case> cases = {{"bouc-wen", {}},
                                   {"lugre", {}},
                                   {"modified-bouc-wen", {}},
                                   {"bouc-wen", {"seal-friction"}},
                                   {"bouc-wen", {"compliance"}},
                                   {"bouc-wen", {"series-dashpot"}}};
  for (const Case& c : cases) {
    const CompositeModel model = make_model(c.law, c.effects);
    for (const double share : {0.0, 0.1, 0.5, 0.77}) {
      const double error = error_of(model, 0.008, share * 0.008, [](Motion motion) { return motion; });
      EXPECT_LT(error, 1e-3) << c.law << ' ' << (c.effects.empty() ? "" : c.effects[0]) << ' ' << share;
    }
  }
}

TEST(Corner, IsTakenByStepsThatDoNotFollowSeriesElements) {
  const CompositeModel model = make_model("bouc-wen", {"compliance"});
  for (const double share : {0.1, 0.5, 0.77}) {
    EXPECT_LT(error_of(model, 0.008, share * 0.008, comparing_motion), 5e-3) << share;
  }
}

}  // namespace
}  // namespace hysteron

// Asymmetry: friction and damping that differ by shares of their own, and the direction that the force has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulate/composite.hpp"
#include "simulate/drawn.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

using hysteron::testing::with;
using Vector = std::vector<double>;

TEST(Asymmetry, FrictionAndDampingDifferByTheirOwnShares) {
  constexpr double friction = 400.0;
  constexpr double damping = 3000.0;
  constexpr double of_friction = 0.1;
  constexpr double of_damping = -0.25;
  const CompositeModel model = make_model("bingham", {"asymmetry"});
  const Vector p = with(model, {{"fc", friction},
                                {"c0", damping},
                                {"v_s", 1e-4},
                                {"asymmetry.e", of_friction},
                                {"asymmetry.c_d", (of_damping - of_friction) * damping}});
  for (const double speed : {0.002, 0.02, 0.2, 0.9}) {
    for (const double sense : {1.0, -1.0}) {
      const Vector time{0.0, 0.001};
      const Vector v{sense * speed, sense * speed};
      const Vector x{0.0, 0.001 * sense * speed};
      const double expected =
          sense * (friction * (1.0 + sense * of_friction) + damping * speed * (1.0 + sense * of_damping));
      EXPECT_NEAR(simulate(model, make_motion(time, x, v, {}), p).front(), expected, 1e-9 * friction) << sense * speed;
    }
  }
}

// Hysteresis keeps its direction for a while after a reversal of the motion, and its asymmetry with it: the force goes
// through zero without a jump.
TEST(Asymmetry, MakesNoJumpWhereTheMotionReverses) {
  constexpr double rate = 2000.0;
  constexpr double omega = 2.0 * std::numbers::pi;
  Vector time;
  Vector x;
  Vector v;
  for (int n = 0; n < 4000; ++n) {
    const double t = n / rate;
    time.push_back(t);
    x.push_back(0.01 * std::sin(omega * t));
    v.push_back(0.01 * omega * std::cos(omega * t));
  }
  const Motion motion = make_motion(time, x, v, {});
  const CompositeModel plain = make_model("bouc-wen", {});
  const CompositeModel uneven = make_model("bouc-wen", {"asymmetry"});
  const auto largest_step = [&](const CompositeModel& model, const Vector& p) {
    const Vector force = simulate(model, motion, p);
    double most = 0.0;
    for (std::size_t n = 1; n < force.size(); ++n) most = std::max(most, std::fabs(force[n] - force[n - 1]));
    return most;
  };
  const double before = largest_step(plain, with(plain, {{"alpha", 800.0}, {"x_y", 1e-3}}));
  const double after = largest_step(uneven, with(uneven, {{"alpha", 800.0}, {"x_y", 1e-3}, {"asymmetry.e", 0.3}}));
  EXPECT_LT(after, 1.31 * before);
  EXPECT_GT(after, 1.2 * before);
}

}  // namespace
}  // namespace hysteron

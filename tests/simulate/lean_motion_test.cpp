#include "simulate/lean_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using Vector = std::vector<double>;

void expect_same(const MotionInterval& a, const MotionInterval& b, std::size_t n) {
  EXPECT_EQ(a.length, b.length) << n;
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(a.x[k], b.x[k]) << n;
    EXPECT_EQ(a.v[k], b.v[k]) << n;
    EXPECT_EQ(a.a[k], b.a[k]) << n;
    EXPECT_EQ(a.middle[k], b.middle[k]) << n;
    EXPECT_EQ(a.end[k], b.end[k]) << n;
  }
  EXPECT_EQ(a.speed, b.speed) << n;
  EXPECT_EQ(a.reversal, b.reversal) << n;
  EXPECT_EQ(a.reversal_at, b.reversal_at) << n;
}

TEST(LeanMotion, EveryPieceHasTheIntervalsOfTheWhole) {
  Vector time;
  Vector x;
  Vector v;
  Vector a;
  Vector drive;
  for (int n = 0; n < 200; ++n) {
    const double t = 3.0 + 0.01 * n + 0.002 * std::sin(n);
    time.push_back(t);
    x.push_back(0.01 * std::sin(9.0 * t));
    v.push_back(0.09 * std::cos(9.0 * t));
    a.push_back(-0.81 * std::sin(9.0 * t));
    drive.push_back(0.1 * n);
  }
  for (const Vector& acceleration : {Vector{}, a}) {
    const Motion whole = comparing_motion(make_motion(time, x, v, drive, 1e-6, acceleration));
    const Motion lean = comparing_motion(make_lean_motion(time, x, v, drive, 1e-6, acceleration));
    ASSERT_TRUE(is_lean(lean));
    ASSERT_FALSE(is_lean(whole));
    for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, 200}, {0, 2}, {57, 130}, {150, 200}}) {
      Motion piece;
      prepare(lean, first, last, piece);
      ASSERT_EQ(piece.time.size(), last - first);
      ASSERT_EQ(piece.intervals.size(), last - first - 1);
      for (std::size_t n = 0; n < piece.time.size(); ++n) {
        EXPECT_EQ(piece.time[n], whole.time[first + n]);
        EXPECT_EQ(piece.x[n], whole.x[first + n]);
        EXPECT_EQ(piece.v[n], whole.v[first + n]);
        EXPECT_EQ(piece.a[n], whole.a[first + n]);
        EXPECT_EQ(piece.jerk[n], whole.jerk[first + n]);
        EXPECT_EQ(piece.drive[n], whole.drive[first + n]);
        if (n < piece.intervals.size()) expect_same(piece.intervals[n], whole.intervals[first + n], n);
      }
      EXPECT_EQ(piece.lead, whole.lead);
      EXPECT_EQ(piece.step_limit, whole.step_limit);
      EXPECT_EQ(piece.finer_at_reversals, whole.finer_at_reversals);
      EXPECT_EQ(piece.finer_when_long, whole.finer_when_long);
      EXPECT_EQ(piece.most_substeps, whole.most_substeps);
      EXPECT_EQ(piece.balance_tolerance, whole.balance_tolerance);
      EXPECT_EQ(piece.balance_iterations, whole.balance_iterations);
      EXPECT_EQ(piece.element_rate_limit, whole.element_rate_limit);
      EXPECT_EQ(piece.implicit_elements, whole.implicit_elements);
    }
  }
}

}  // namespace
}  // namespace hysteron

#include "simulate/lean_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

using Vector = std::vector<double>;

void expect_same(const MotionInterval& a, const MotionInterval& b, std::size_t n) {
  EXPECT_EQ(a.length, b.length) << n;
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(a.course.x[k], b.course.x[k]) << n;
    EXPECT_EQ(a.course.v[k], b.course.v[k]) << n;
    EXPECT_EQ(a.a[k], b.a[k]) << n;
    EXPECT_EQ(a.middle[k], b.middle[k]) << n;
    EXPECT_EQ(a.end[k], b.end[k]) << n;
  }
  EXPECT_EQ(a.speed, b.speed) << n;
  EXPECT_EQ(a.reversal, b.reversal) << n;
  EXPECT_EQ(a.split_at, b.split_at) << n;
  EXPECT_EQ(a.corner < 0, b.corner < 0) << n;
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

TEST(LeanMotion, CornersBesideAPieceAreThoseOfTheWhole) {
  Vector time;
  Vector x;
  Vector v;
  for (int n = 0; n < 40; ++n) {
    const double phase = std::fmod(0.013 + 0.01 * n, 0.1);
    time.push_back(0.01 * n);
    x.push_back(phase < 0.05 ? phase : 0.1 - phase);
    v.push_back(phase < 0.05 ? 1.0 : -1.0);
  }
  const Motion whole = make_motion(time, x, v, {});
  const Motion lean = make_lean_motion(time, x, v, {}, 1e-4, {});
  ASSERT_EQ(whole.beyond_corners.size(), 7U);
  Motion piece;
  for (std::size_t first = 0; first < 30; ++first) {
    prepare(lean, first, first + 6, piece);
    for (std::size_t n = 0; n < piece.intervals.size(); ++n) {
      expect_same(piece.intervals[n], whole.intervals[first + n], first + n);
      const MotionCourse& a = course_from(piece, piece.intervals[n], 1.0);
      const MotionCourse& b = course_from(whole, whole.intervals[first + n], 1.0);
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(a.x[k], b.x[k]) << first + n;
        EXPECT_EQ(a.v[k], b.v[k]) << first + n;
      }
    }
  }
}

}  // namespace
}  // namespace hysteron

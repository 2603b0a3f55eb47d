// Limits of quasi-static-flow and the properties of the Preisach operator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "simulate/composite.hpp"
#include "simulate/drawn.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;
using hysteron::testing::with;

double flow_force(double speed, const std::vector<std::pair<std::string, double>>& values) {
  const CompositeModel model = make_model("quasi-static-flow", {});
  const Vector time{0.0, 0.001};
  const Vector v{speed, speed};
  const Vector x{0.0, 0.001 * speed};
  auto all = values;
  all.emplace_back("v_s", 1e-6);
  return simulate(model, make_motion(time, x, v, {}), with(model, all)).front();
}

// Pressure gradient of an annulus by brute force: 2 pi int w r dr with w from the shear stress, bisection on the
// gradient and, inside, on the constant C that brings w to zero at the outer wall.
double brute_gradient(double flow, double tau_y, double eta, double radius, double height) {
  const int cells = 4000;
  const double inner = radius - 0.5 * height;
  const double dr = height / cells;
  const auto shear_rate = [&](double gradient, double c, double r) {
    const double tau = -0.5 * gradient * r + c / r;
    return (std::max(tau - tau_y, 0.0) + std::min(tau + tau_y, 0.0)) / eta;
  };
  const auto rate_of_flow = [&](double gradient) {
    double low = 0.0;
    double high = gradient * radius * radius;
    for (int step = 0; step < 60; ++step) {
      const double c = 0.5 * (low + high);
      double end = 0.0;
      for (int n = 0; n < cells; ++n) end += shear_rate(gradient, c, inner + (n + 0.5) * dr) * dr;
      (end > 0.0 ? high : low) = c;
    }
    double w = 0.0;
    double sum = 0.0;
    for (int n = 0; n < cells; ++n) {
      const double r = inner + (n + 0.5) * dr;
      const double slope = shear_rate(gradient, 0.5 * (low + high), r);
      sum += 2.0 * std::numbers::pi * (w + 0.5 * slope * dr) * r * dr;
      w += slope * dr;
    }
    return sum;
  };
  double low = 2.0 * tau_y / height;
  double high = 3.0 * low + 24.0 * eta * flow / (std::numbers::pi * radius * std::pow(height, 3));
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    (rate_of_flow(middle) > flow ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TEST(QuasiStaticFlow, IsNewtonianWithoutYieldStress) {
  // Annular Poiseuille flow in closed form; the gap is wide, so that parallel plates would be off by more.
  const double eta = 0.2;
  const double r1 = 0.008;
  const double r2 = 0.012;
  const double annulus = std::pow(r2, 4) - std::pow(r1, 4) - std::pow(r2 * r2 - r1 * r1, 2) / std::log(r2 / r1);
  for (const double speed : {0.05, 0.4, -0.4}) {
    const double theory = 8.0 * eta * 1e-3 * speed / (std::numbers::pi * annulus) * 0.05 * 1e-3;
    EXPECT_NEAR(
        flow_force(
            speed,
            {{"tau_y", 1e-6}, {"eta", eta}, {"A_p", 1e-3}, {"R", 0.01}, {"h", 0.004}, {"L_a", 0.05}, {"L_p", 0.0}}),
        theory, 1e-6 * std::fabs(theory));
    EXPECT_NEAR(
        flow_force(
            speed,
            {{"tau_y", 1e4}, {"eta", eta}, {"A_p", 1e-3}, {"R", 0.01}, {"h", 0.004}, {"L_a", 0.0}, {"L_p", 0.05}}),
        theory, 1e-9 * std::fabs(theory));
  }
}

TEST(QuasiStaticFlow, FullPlugCarriesTheYieldForce) {
  // 2 tau_y L A_p / h as the speed goes to zero; the excess goes with its root: s - 1 = sqrt(2 q / 3).
  const double yield = 2.0 * 3e4 / 7e-4 * 2e-2 * 8e-4;
  const std::vector<std::pair<std::string, double>> values{{"tau_y", 3e4}, {"eta", 0.05}, {"L_p", 0.0}};
  const auto q = [](double speed) {
    return 3.0 * 0.05 * 8e-4 * speed / (std::numbers::pi * 0.015 * 7e-4 * 7e-4 * 3e4);
  };
  for (const double speed : {1e-3, 1e-4}) {
    EXPECT_NEAR(flow_force(speed, values) / yield - 1.0, std::sqrt(2.0 / 3.0 * q(speed)), 0.03 * std::sqrt(q(speed)));
  }
  EXPECT_DOUBLE_EQ(flow_force(-1e-3, values), -flow_force(1e-3, values));
  EXPECT_EQ(flow_force(0.0, values), 0.0);
}

TEST(QuasiStaticFlow, PlugIsSolvedAsByBruteForce) {
  struct Case {
    double tau_y, eta, radius, height, speed;
  };
  for (const Case& c :
       {Case{1e4, 0.1, 0.015, 7e-4, 0.2}, Case{3e4, 0.3, 0.01, 2e-3, 0.05}, Case{2e3, 0.5, 0.006, 3e-3, 0.3}}) {
    const double theory = brute_gradient(8e-4 * c.speed, c.tau_y, c.eta, c.radius, c.height) * 0.02 * 8e-4;
    EXPECT_NEAR(
        flow_force(c.speed, {{"tau_y", c.tau_y}, {"eta", c.eta}, {"R", c.radius}, {"h", c.height}, {"L_p", 0.0}}),
        theory, 2e-4 * theory);
  }
}

// y of a path of the drive through turning points, slow enough for the plays to follow: force at constant speed, c0 =
// 0.
Vector preisach_path(const Vector& turning, double R, double d) {
  const CompositeModel model = make_model("preisach", {});
  Vector time{0.0}, v{0.1}, x{0.0}, drive{turning.front()};
  for (std::size_t k = 1; k < turning.size(); ++k) {
    const int steps = 400;
    for (int n = 1; n <= steps; ++n) {
      drive.push_back(turning[k - 1] + (turning[k] - turning[k - 1]) * n / steps);
      time.push_back(time.back() + 0.005);
      v.push_back(0.1);
      x.push_back(0.1 * time.back());
    }
  }
  return simulate(model, make_motion(time, x, v, drive),
                  with(model, {{"f_y", 0.0}, {"f_i", 1.0}, {"c0", 0.0}, {"R", R}, {"d", d}}));
}

TEST(Preisach, VirginCurveMajorLoopAndRemanence) {
  const double R = 0.2;
  const double d = 1.3;
  double total = 1.0;
  double lag = 0.0;
  for (int j = 1; j <= 4; ++j) {
    total += std::exp(-0.25 * d * j);
    lag += std::exp(-0.25 * d * j) * 0.25 * R * j;
  }
  lag /= total;
  const Vector y = preisach_path({0.0, 1.0, 0.0, 1.0}, R, d);
  // The plays follow 1 A in 2 s with 2 ms: 1 mA behind.
  EXPECT_NEAR(y[400], 1.0 - lag, 2e-3);
  EXPECT_NEAR(y[800], lag, 2e-3);
  EXPECT_NEAR(y[600], 0.5 + lag, 2e-3);
  EXPECT_NEAR(y[1000], 0.5 - lag, 2e-3);
}

TEST(Preisach, MinorLoopsAreWipedOutAndCongruent) {
  const Vector plain = preisach_path({0.0, 1.0, 0.0}, 0.3, 0.5);
  const Vector minor = preisach_path({0.0, 0.7, 0.4, 1.0, 0.0}, 0.3, 0.5);
  EXPECT_NEAR(minor[1200], plain[400], 1e-3);
  EXPECT_NEAR(minor[1600], plain[800], 1e-3);
  // The loop between 0.6 and 0.4 A has one shape whether it is reached from below or from above.
  const Vector below = preisach_path({0.0, 0.6, 0.4, 0.6, 0.4}, 0.3, 0.5);
  const Vector above = preisach_path({0.0, 1.0, 0.4, 0.6, 0.4}, 0.3, 0.5);
  for (std::size_t n = 800; n <= 1600; n += 100) {
    EXPECT_NEAR(below[n] - below[800], above[n] - above[800], 1e-3) << n;
  }
  EXPECT_GT(above[800] - below[800], 0.02);
}

}  // namespace
}  // namespace hysteron

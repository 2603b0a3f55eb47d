// Tables 1 and 2 of the Nelder-Mead study as printed: one row a current.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace hysteron::nelder_mead {

inline constexpr double amplitude = 0.0025;  // m
inline constexpr double frequency = 1.0;     // Hz

struct Row {
  double current;  // A
  // f0, a0, a1, a2, a3, a4, k0, k1c, k1e, k2, k3, k4, k5, k6, I0, I1: in the order of models/wang_sigmoid.cpp.
  std::array<double, 16> values;
};

inline constexpr std::array<Row, 6> rows{{
    {0.0,
     {36.55, 11309, -23.2, 118.6, -1.55, 33.59, 1433.8, 93.84, 40.85, -6109, -1046, -0.15, 0.42, 0.007, 0.147, 4.09}},
    {0.1,
     {136.20, 2109, -33.85, 0.13, 37.48, -39.71, 29.35, 49.62, 14.62, -189, 1.31, -0.46, 0.39, 0.33, -0.05, -0.51}},
    {0.2,
     {145.19, 1982, 34.81, 0.116, 36.72, -44.15, 36.58, 65.59, 13.40, -91.5, 1.07, -0.46, 0.46, 0.34, -0.065, -0.487}},
    {0.3, {175.78, 1688, 36.99, 0.11, 28.51, -40.44, 55.18, 66.33, 13.78, -54.3, 1.03, -0.47, 0.46, 0.33, 1.66, 0.02}},
    {0.4,
     {95.69, 656.56, 81.85, 0.11, 72.90, 28.57, 134.14, 24.12, 20.50, 14.87, -1.76, -0.52, 0.08, 0.10, -0.168, -0.836}},
    {0.5,
     {67.23, 895, 121.74, 0.062, 78.02, 5.80, 219.13, 21.07, 25.63, 22.54, -2.95, -0.48, 0.03, 0.06, -0.10, -0.93}},
}};

inline const Row& nearest(double current) {
  return *std::ranges::min_element(rows, {}, [&](const Row& row) { return std::fabs(row.current - current); });
}

}  // namespace hysteron::nelder_mead

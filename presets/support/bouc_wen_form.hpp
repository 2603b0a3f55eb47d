// From z' = A v - weight_abs |v| z |z|^(n-1) - weight |z|^n v, F = ... + alpha z, to the normal form of the models:
//   Z = (A / (weight_abs + weight))^(1/n), yield force alpha Z, x_y = Z / A, share = weight_abs / (weight_abs + weight)
#pragma once

#include <cmath>

namespace hysteron {

struct NormalForm {
  double yield_force;  // N
  double x_y;          // m
  double share;
};

inline NormalForm normal_form(double alpha, double A, double weight_abs, double weight, double n) {
  const double sum = weight_abs + weight;
  const double scale = std::pow(A / sum, 1.0 / n);
  return {alpha * scale, scale / A, weight_abs / sum};
}

}  // namespace hysteron

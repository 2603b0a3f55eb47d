#include "fit/sensitivity.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {

double measured_square(const std::vector<Target>& targets) {
  double result = 0.0;
  for (const Target& target : targets) {
    double sum = 0.0;
    for (std::size_t n = target.run_in; n < target.force.size(); ++n) {
      sum += target.force[n] * target.force[n];
    }
    result += target.weight * sum;
  }
  return result;
}

std::vector<ScaledSensitivity> sensitivities(const Layout& layout, const Response& derivatives, double measured,
                                             const std::vector<double>& u) {
  // Of one point: the matrix is as wide as it has coordinates, of which there may be more than the layout's.
  const auto width =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(derivatives.gauss_newton.size()))));
  std::vector<ScaledSensitivity> result;
  for (const ParameterLaw& law : layout.laws()) {
    // d/d(log of the whole law): every node times the derivative by it.
    std::vector<double> direction;
    for (std::size_t k = law.first; k < law.first + law.count(); ++k) {
      direction.push_back(layout.physical(k, u[k]) / layout.slope(k, u[k]));
    }
    double square = 0.0;
    for (std::size_t a = 0; a < direction.size(); ++a) {
      for (std::size_t b = 0; b < direction.size(); ++b) {
        square += direction[a] * direction[b] * derivatives.gauss_newton[(law.first + a) * width + law.first + b];
      }
    }
    result.push_back({law.parameter, std::sqrt(std::max(square, 0.0) / measured)});
    if (std::isnan(square)) result.back().value = square;
  }
  std::ranges::stable_sort(result, [](const ScaledSensitivity& a, const ScaledSensitivity& b) {
    // What is not finite last.
    return std::isfinite(a.value) && (!std::isfinite(b.value) || a.value > b.value);
  });
  return result;
}

}  // namespace hysteron

// Parameter sets of models, and what their forces are compared by.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "simulate/composite.hpp"

namespace hysteron::testing {

// The initial values, but for these.
inline std::vector<double> with(const CompositeModel& model,
                                const std::vector<std::pair<std::string, double>>& values) {
  std::vector<double> p;
  for (const Parameter& parameter : model.parameters()) {
    p.push_back(parameter.initial);
  }
  const auto names = model.parameter_names();
  for (const auto& [name, value] : values) {
    const auto at = std::ranges::find(names, name);
    EXPECT_NE(at, names.end()) << name;
    p[static_cast<std::size_t>(at - names.begin())] = value;
  }
  return p;
}

// Drawn from the whole box, but for what is fixed.
inline std::vector<double> draw(const CompositeModel& model, std::uint64_t seed) {
  const Stream stream(seed);
  std::vector<double> p;
  std::uint32_t j = 0;
  for (const Parameter& card : model.parameters()) {
    const double u = stream.uniform(3, j++);
    p.push_back(card.fixed                         ? card.initial
                : card.scale == Scale::logarithmic ? card.box.lower * std::pow(card.box.upper / card.box.lower, u)
                                                   : card.box.lower + u * (card.box.upper - card.box.lower));
  }
  return p;
}

// Root mean square of the difference.
inline double rms_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    sum += (a[n] - b[n]) * (a[n] - b[n]);
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace hysteron::testing

// A probability from features: a logistic function with weights that are never negative, then a monotone table that was
// calibrated on campaigns of its own.
//   s = intercept + sum weight_k feature_k,   P = piecewise linear in s through the knots
// Learned by bench/learn_grades.cpp, which writes table_data.cpp.
#pragma once

#include <span>

namespace hysteron {

struct Knot {
  double score;
  double probability;
};

struct Table {
  double intercept;
  std::span<const double> weights;
  std::span<const Knot> knots;

  [[nodiscard]] double score(std::span<const double> features) const;
  [[nodiscard]] double probability(std::span<const double> features) const;
};

// That an effect is in the truth for which a contrast speaks that needs no model.
double channel_probability();

// Where an effect or one that does as well in its place is in the truth: that it is the one that was found.
double found_of_set();

// That the effect, or one that does as well in its place, is in the truth; that physics is missing.
const Table& name_table();
const Table& missing_table();

}  // namespace hysteron

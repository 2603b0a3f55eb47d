// A probability from features: a score with weights that are never negative, then what such scores were worth on
// campaigns that the weights had not seen.
//   s = intercept + offset(effect) + sum weight_k feature_k
//   log(P / (1 - P)) = piecewise linear in s through the knots, rising, constant beyond them; without knots s itself
// The offset of an effect says how often it is found where it is not: some shapes cover for many others.
// Learned by bench/learn_grades.cpp, which writes table_data.cpp.
#pragma once

#include <span>
#include <string_view>

namespace hysteron {

struct Knot {
  double score;
  double log_odds;
};

struct Offset {
  std::string_view effect;
  double value;
};

struct Table {
  double intercept;
  std::span<const double> weights;
  std::span<const Knot> knots;
  std::span<const Offset> offsets = {};

  // Of an effect without an offset, as one of a plugin is, the offset is zero.
  [[nodiscard]] double score(std::span<const double> features, std::string_view effect = {}) const;
  [[nodiscard]] double probability(std::span<const double> features, std::string_view effect = {}) const;
};

// That an effect is in the truth for which a contrast speaks that needs no model.
double channel_probability();

// That the effect is in the truth (alone_features); that it or one that does as well in its place is (name_features);
// that physics is missing (missing_features).
const Table& alone_table();
const Table& name_table();
const Table& missing_table();

}  // namespace hysteron

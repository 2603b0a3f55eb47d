// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.8035, 1.691, 1.121, 1.401, 0.9473, 3.406, 2.616, 2.363, 1.473, 3.056};
constexpr Knot name_knots[] = {{-4.314, 0.1098}, {-2.066, 0.123}, {-1.099, 0.2619}, {-0.6071, 0.3095}, {0.04158, 0.3537}, {0.9533, 0.7195}, {1.782, 0.8902}, {3.128, 0.9909}};
constexpr double name_intercept = -16.172;

constexpr double set_weights[] = {0.9006, 1.359, 0, 0.3142, 1.514, 2.932, 2.229, 1.845, 1.509, 3.167};
constexpr Knot set_knots[] = {{-3.779, 0.1098}, {-1.671, 0.1885}, {-0.4506, 0.3537}, {0.4419, 0.5}, {1.128, 0.7381}, {2.045, 0.9098}, {3.306, 0.9909}};
constexpr double set_intercept = -13.669;

constexpr double missing_weights[] = {1.362, 1.409, 1.117, 0, 1.514, 1.911};
constexpr Knot missing_knots[] = {{-1.695, 0.07143}, {-1.326, 0.1667}, {-0.7143, 0.3571}, {0.2571, 0.5952}, {1.997, 0.9286}, {5.962, 0.9948}};
constexpr double missing_intercept = -1.7566;

}  // namespace

const Table& name_table() {
  static constexpr Table table{name_intercept, name_weights, name_knots};
  return table;
}

const Table& set_table() {
  static constexpr Table table{set_intercept, set_weights, set_knots};
  return table;
}

const Table& missing_table() {
  static constexpr Table table{missing_intercept, missing_weights, missing_knots};
  return table;
}

}  // namespace hysteron

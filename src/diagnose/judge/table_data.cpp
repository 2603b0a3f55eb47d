// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.8445, 1.478, 0.9605, 1.274, 0.8964, 3.846, 3.067, 2.333, 1.34, 2.751};
constexpr Knot name_knots[] = {{-5.37, 0.07143}, {-3.528, 0.119},  {-2.555, 0.1341},  {-1.926, 0.1667},
                               {-1.386, 0.2073}, {-0.743, 0.2143}, {-0.1484, 0.3537}, {0.3818, 0.5476},
                               {0.7827, 0.6429}, {1.183, 0.7381},  {1.642, 0.8415},   {2.845, 0.9928}};
constexpr double name_intercept = -16.338;

constexpr double set_weights[] = {0.8364, 1.187, 0, 0.05296, 1.23, 3.377, 2.536, 1.593, 1.392, 2.858};
constexpr Knot set_knots[] = {{-3.213, 0.123}, {-1.463, 0.2213}, {-0.1308, 0.3765}, {0.7639, 0.5952},
                              {1.195, 0.7857}, {1.731, 0.8902},  {2.367, 0.939},    {3.224, 0.9898}};
constexpr double set_intercept = -13.188;

constexpr double missing_weights[] = {1.564, 1.412, 1.078, 2.075, 1.381, 1.661};
constexpr Knot missing_knots[] = {{-1.918, 0.07143}, {-1.584, 0.119}, {-1.065, 0.2143},
                                  {-0.3004, 0.5},    {1.282, 0.8333}, {6.341, 0.996}};
constexpr double missing_intercept = -1.983;

constexpr double of_channels = 0.9583;

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

double channel_probability() { return of_channels; }

}  // namespace hysteron

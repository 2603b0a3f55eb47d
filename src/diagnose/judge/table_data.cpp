// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.5537, 0.8312, 2.163, 1.293, 1.924, 1.038, 1.995};
constexpr Knot name_knots[] = {{-4.179, 0.119},   {-3.192, 0.1667}, {-1.606, 0.2313}, {-0.4505, 0.3293},
                               {-0.1286, 0.3525}, {0.113, 0.4048},  {0.3939, 0.4344}, {0.6619, 0.5952},
                               {0.7735, 0.6429},  {1.017, 0.7683},  {1.223, 0.8333},  {1.641, 0.8404},
                               {2.1, 0.8902},     {2.234, 0.9286},  {2.428, 0.959},   {2.822, 0.9881}};
constexpr double name_intercept = -7.9545;

constexpr double missing_weights[] = {1.813, 1.809, 1.07, 2.536, 1.636, 2.371};
constexpr Knot missing_knots[] = {{-2.13, 0.08537}, {-1.751, 0.1173}, {-1.153, 0.2143}, {-0.7115, 0.4048},
                                  {0.2438, 0.5},    {1.174, 0.8333},  {7.289, 0.9984}};
constexpr double missing_intercept = -2.149;

constexpr double of_channels = 0.98;
constexpr double of_set = 0.6784;

}  // namespace

const Table& name_table() {
  static constexpr Table table{name_intercept, name_weights, name_knots};
  return table;
}

const Table& missing_table() {
  static constexpr Table table{missing_intercept, missing_weights, missing_knots};
  return table;
}

double channel_probability() { return of_channels; }

double found_of_set() { return of_set; }

}  // namespace hysteron

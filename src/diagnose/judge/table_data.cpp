// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.7451, 0.2837, 0.9589, 2.136, 5.049, 2.2, 1.221, 2.625};
constexpr Knot name_knots[] = {{-5.963, 0.02381}, {-3.547, 0.07143}, {-2.488, 0.1585}, {-1.513, 0.2805},
                               {-0.7493, 0.3293}, {-0.0851, 0.3571}, {0.3805, 0.4048}, {0.9059, 0.5976},
                               {1.399, 0.7381},   {1.711, 0.8333},   {2.064, 0.939},   {2.527, 0.9904}};
constexpr double name_intercept = -14.06;

constexpr double set_weights[] = {0.7076, 0, 1.095, 1.519, 3.356, 1.997, 1.338, 2.694};
constexpr Knot set_knots[] = {{-4.882, 0.119},    {-2.609, 0.1585}, {-1.531, 0.2561}, {-0.7455, 0.2805},
                              {0.005768, 0.4024}, {0.5508, 0.4048}, {0.9655, 0.6429}, {1.287, 0.6905},
                              {1.507, 0.7857},    {2.015, 0.959},   {2.541, 0.9904}};
constexpr double set_intercept = -11.571;

constexpr double missing_weights[] = {1.627, 1.409, 1.107, 2.183, 1.308, 1.434};
constexpr Knot missing_knots[] = {{-1.96, 0.07143}, {-1.621, 0.119}, {-1.087, 0.2143},
                                  {-0.3254, 0.5},   {1.462, 0.8333}, {6.27, 0.9959}};
constexpr double missing_intercept = -2.0285;

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

// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.7912, 1.269, 1.021, 1.196, 0.828, 3.659, 2.787, 3.251, 0.9761, 1.274, 2.378};
constexpr Knot name_knots[] = {{-5.005, 0.07143}, {-3.34, 0.119},    {-2.467, 0.1585}, {-1.915, 0.1667},
                               {-1.052, 0.2284},  {-0.1165, 0.3571}, {0.2858, 0.5},    {0.8064, 0.6429},
                               {1.187, 0.7381},   {1.539, 0.8333},   {2.292, 0.939},   {3.505, 0.9898}};
constexpr double name_intercept = -15.158;

constexpr double set_weights[] = {0.7712, 0.9907, 0, 0, 1.179, 3.261, 2.258, 2.373, 1.018, 1.296, 2.617};
constexpr Knot set_knots[] = {{-3.103, 0.123}, {-1.49, 0.2213}, {-0.2318, 0.3642}, {0.6836, 0.5952},
                              {1.284, 0.8333}, {1.853, 0.8415}, {3.225, 0.9944}};
constexpr double set_intercept = -12.293;

constexpr double missing_weights[] = {1.563, 1.411, 1.086, 2.068, 1.387, 1.668};
constexpr Knot missing_knots[] = {{-1.923, 0.07143}, {-1.586, 0.119}, {-1.063, 0.2143},
                                  {-0.2953, 0.5},    {1.289, 0.8333}, {6.33, 0.996}};
constexpr double missing_intercept = -1.9877;

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

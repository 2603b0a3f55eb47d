// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.5131, 0.9915, 1.962, 1.111, 1.934, 1.266, 2.12};
constexpr Knot name_knots[] = {{-4.113, 0.07143}, {-1.71, 0.2264}, {-0.2767, 0.3025}, {0.1722, 0.4512},
                               {0.5388, 0.5492},  {0.81, 0.6905},  {1.082, 0.7927},   {1.564, 0.8223},
                               {2.05, 0.9146},    {2.202, 0.9286}, {2.423, 0.959},    {2.7, 0.9754},
                               {2.97, 0.98}};
constexpr double name_intercept = -8.0615;

constexpr double missing_weights[] = {1.542, 1.562, 1.1, 2.354, 1.568, 2.491};
constexpr Knot missing_knots[] = {{-2.159, 0.06098}, {-1.948, 0.119},  {-1.66, 0.1341}, {-1.189, 0.2143},
                                  {-0.6885, 0.4048}, {0.4563, 0.5476}, {1.53, 0.9286},  {7.08, 0.9981}};
constexpr double missing_intercept = -2.1919;

constexpr double of_channels = 0.9762;
constexpr double of_set = 0.6585;

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

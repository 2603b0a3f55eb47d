// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.6911, 1.095, 1.799, 1.459, 1.202, 1.108, 2.239};
constexpr Knot name_knots[] = {{-3.782, 0.1667},   {-2.302, 0.2377}, {-0.9999, 0.2822}, {-0.2303, 0.3293},
                               {-0.02355, 0.3571}, {0.2578, 0.4024}, {0.7696, 0.5492},  {1.136, 0.6429},
                               {1.233, 0.7381},    {1.456, 0.7927},  {1.609, 0.8333},   {1.887, 0.9691},
                               {2.292, 0.9931}};
constexpr double name_intercept = -8.6671;

constexpr double missing_weights[] = {1.544, 1.489, 1.13, 2.157, 1.406, 1.974};
constexpr Knot missing_knots[] = {
    {-1.793, 0.1049}, {-0.9621, 0.3095}, {-0.154, 0.4524}, {1.129, 0.7857}, {6.309, 0.9975}};
constexpr double missing_intercept = -2.1549;

constexpr double of_channels = 0.9706;
constexpr double of_set = 0.6786;

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

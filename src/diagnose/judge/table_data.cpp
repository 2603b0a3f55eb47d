// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.6736, 1.108, 1.704, 1.408, 1.137, 1.209, 2.204};
constexpr Knot name_knots[] = {{-3.668, 0.119}, {-1.665, 0.2851}, {-0.3288, 0.3025}, {0.1836, 0.4268},
                               {0.575, 0.4512}, {0.9528, 0.5976}, {1.173, 0.6905},   {1.366, 0.7927},
                               {1.597, 0.8659}, {1.916, 0.9691},  {2.298, 0.9925}};
constexpr double name_intercept = -8.4771;

constexpr double missing_weights[] = {1.551, 1.489, 1.129, 2.156, 1.408, 1.969};
constexpr Knot missing_knots[] = {
    {-1.793, 0.1049}, {-0.9623, 0.3095}, {-0.1536, 0.4524}, {1.128, 0.7857}, {6.308, 0.9975}};
constexpr double missing_intercept = -2.1551;

constexpr double of_channels = 0.9706;
constexpr double of_set = 0.6712;

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

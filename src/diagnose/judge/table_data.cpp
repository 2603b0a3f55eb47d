// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.5348, 0.6528, 2.408, 1.585, 1.747, 1.448, 1.699, 0.7242};
constexpr Knot name_knots[] = {
    {-4.679, 0.119},   {-3.594, 0.1667}, {-2.108, 0.2015}, {-1.183, 0.2619}, {-0.9191, 0.2705}, {-0.5562, 0.3148},
    {-0.1633, 0.3272}, {0.1004, 0.378},  {0.4355, 0.4802}, {0.7484, 0.6429}, {0.894, 0.6951},   {1.083, 0.7683},
    {1.305, 0.8333},   {1.732, 0.8602},  {2.173, 0.9356},  {2.452, 0.959},   {2.816, 0.9878}};
constexpr double name_intercept = -8.9276;

constexpr double missing_weights[] = {1.828, 0.8597, 0.8965, 1.984, 1.548, 1.836};
constexpr Knot missing_knots[] = {{-1.652, 0.1585},  {-1.561, 0.1885},  {-1.298, 0.2037}, {-0.9402, 0.3049},
                                  {-0.6085, 0.3571}, {-0.3035, 0.4048}, {0.2391, 0.4524}, {0.9139, 0.6905},
                                  {1.664, 0.8415},   {2.468, 0.9286},   {6.518, 0.9988}};
constexpr double missing_intercept = -1.6327;

constexpr double of_channels = 0.9857;
constexpr double of_set = 0.695;

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

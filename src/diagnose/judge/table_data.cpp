// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.7926, 1.608, 0.9011, 1.175, 0.1151, 3.089, 2.632, 2.347, 1.191, 2.207};
constexpr Knot name_knots[] = {{-5.409, 0.02381}, {-3.218, 0.09259}, {-2.312, 0.1829}, {-1.494, 0.1942},
                               {-0.5287, 0.3395}, {0.1137, 0.5244},  {0.3884, 0.5476}, {0.8101, 0.5988},
                               {1.232, 0.7857},   {1.474, 0.8171},   {1.803, 0.8902},  {2.097, 0.9286},
                               {2.545, 0.9754},   {3.428, 0.9898}};
constexpr double name_intercept = -13.701;

constexpr double set_weights[] = {0.772, 1.625, 0.06733, 0, 0.1568, 2.758, 2.595, 1.629, 1.343, 1.975};
constexpr Knot set_knots[] = {{-2.921, 0.1116},  {-1.7, 0.2143},   {-1.203, 0.2624}, {-0.4215, 0.4016},
                              {0.04858, 0.4512}, {0.2604, 0.4524}, {0.4939, 0.5476}, {0.8002, 0.6463},
                              {1.121, 0.6905},   {1.546, 0.8279},  {2.097, 0.877},   {2.589, 0.9754},
                              {3.299, 0.9944}};
constexpr double set_intercept = -10.884;

constexpr double missing_weights[] = {1.71, 0.8853, 1.099, 0, 2.018, 1.467};
constexpr Knot missing_knots[] = {{-1.843, 0.05738}, {-1.346, 0.1829}, {-0.9043, 0.3571}, {-0.4322, 0.4524},
                                  {0.605, 0.6429},   {1.637, 0.9286},  {5.881, 0.9937}};
constexpr double missing_intercept = -1.9628;

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

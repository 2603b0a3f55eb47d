// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0,      1.103, 1.802, 1.357,  0.8594, 0.1329,  0.6398, 0,    1.02,
                                   0.2718, 3.191, 2.09,  0.9124, 0.8426, 0.07295, 1.332,  2.394};
constexpr Knot name_knots[] = {{-4.855, 0.07143}, {-3.247, 0.119}, {-1.217, 0.2654}, {0.3513, 0.5476},
                               {0.8343, 0.6429},  {1.529, 0.7857}, {2.205, 0.8333},  {3.486, 0.93}};
constexpr double name_intercept = -14.019;

constexpr double set_weights[] = {0, 0.4924, 2.226, 0,      0,     0.3234, 0.07855, 0,    1.244,
                                  0, 2.266,  1.415, 0.9964, 0.205, 0.2285, 0.4165,  2.225};
constexpr Knot set_knots[] = {{-3.424, 0.119}, {-1.832, 0.2561}, {-0.8423, 0.3571}, {-0.327, 0.4048}, {0.4823, 0.4756},
                              {1.406, 0.7857}, {1.905, 0.8333},  {2.664, 0.8902},   {3.772, 0.95}};
constexpr double set_intercept = -9.0482;

constexpr double missing_weights[] = {1.675, 1.205, 1.086, 0, 1.849, 2.667};
constexpr Knot missing_knots[] = {{-1.715, 0.119}, {-1.258, 0.2143}, {-0.5423, 0.5}, {1.394, 0.6905}, {6.601, 0.9944}};
constexpr double missing_intercept = -1.7459;

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

// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double name_weights[] = {0.5236, 0.7861, 2.592, 1.85, 1.789, 1.52, 1.775, 0.6759};
constexpr Knot name_knots[] = {
    {-4.945, 0.119},   {-3.818, 0.1667}, {-2.243, 0.1968}, {-1.274, 0.2143}, {-0.9749, 0.2531}, {-0.6133, 0.3197},
    {-0.1172, 0.3385}, {0.3664, 0.4836}, {0.6002, 0.5},    {0.784, 0.5952},  {0.9591, 0.7459},  {1.25, 0.7951},
    {1.413, 0.8415},   {1.557, 0.8607},  {1.93, 0.8688},   {2.206, 0.9146},  {2.456, 0.9711},   {2.926, 0.9967}};
constexpr double name_intercept = -9.511;

constexpr double missing_weights[] = {1.847, 0.8947, 0.9179, 2.042, 1.648, 1.879};
constexpr Knot missing_knots[] = {{-1.707, 0.1557},  {-1.619, 0.1829}, {-1.447, 0.1885}, {-1.241, 0.2073},
                                  {-0.9586, 0.2805}, {-0.4847, 0.378}, {0.1923, 0.5},    {0.8827, 0.5952},
                                  {1.907, 0.8934},   {6.703, 0.9989}};
constexpr double missing_intercept = -1.6994;

constexpr double of_channels = 0.9868;
constexpr double of_set = 0.7064;

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

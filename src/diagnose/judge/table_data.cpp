// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double alone_weights[] = {1.278, 0.9296, 2.609, 3.774, 1.535, 1.721, 1.356, 0.7917, 0.4188, 1.093};
constexpr Offset alone_offsets[] = {
    {"asymmetry", -0.161},
    {"cavitation", 0.0585},
    {"clearance", 0.806},
    {"coil-lag", 1.04},
    {"compliance", 0.154},
    {"coulomb-friction", -0.741},
    {"cubic-stiffness", 0.321},
    {"degradation", -1.49},
    {"end-stop", -1.22},
    {"entrapped-gas", -0.188},
    {"force-drift", -0.206},
    {"gas-spring", -0.544},
    {"inertia", 0.35},
    {"linear-stiffness", 0.572},
    {"magnetic-remanence", 0.376},
    {"magnetic-saturation", 0.845},
    {"offset-force", -0.659},
    {"pinching", -0.386},
    {"pre-yield-hysteresis", 0.704},
    {"quadratic-damping", 0.447},
    {"seal-friction", 0.0449},
    {"self-heating", -1.13},
    {"sensor-delay", -0.0763},
    {"series-dashpot", 0.47},
    {"shear-thinning", -0.37},
    {"stiction", -0.509},
    {"velocity-lag", 1.89},
    {"viscous-damping", -0.346},
};
constexpr Knot alone_knots[] = {
    {-5.353, -2.372},  {-3.566, -2.312},  {-2.798, -2.093},   {-2.526, -1.609}, {-2.021, -1.363}, {-1.17, -1.246},
    {-0.7061, -0.588}, {-0.512, -0.3955}, {-0.1115, -0.2639}, {0.1736, 0.191},  {0.4963, 0.331},  {0.8661, 0.498},
    {1.284, 1.149},    {1.802, 1.869},    {2.281, 2.53},      {2.67, 2.799},    {3.377, 3.406}};
constexpr double alone_intercept = -12.881;

constexpr double name_weights[] = {1.735, 0.9003, 2.179, 2.296, 1.305, 1.82, 1.281, 0.8987, 0.5992};
constexpr Offset name_offsets[] = {
    {"asymmetry", -0.238},
    {"cavitation", 0.253},
    {"clearance", 0.3},
    {"coil-lag", 0.964},
    {"compliance", -0.0997},
    {"coulomb-friction", -0.936},
    {"cubic-stiffness", 0.269},
    {"degradation", 0.674},
    {"end-stop", -0.845},
    {"entrapped-gas", 0.0144},
    {"force-drift", -0.328},
    {"gas-spring", -0.668},
    {"inertia", 0.265},
    {"linear-stiffness", 0.738},
    {"magnetic-remanence", 0.561},
    {"magnetic-saturation", 1},
    {"offset-force", -0.799},
    {"pinching", -0.85},
    {"pre-yield-hysteresis", 0.387},
    {"quadratic-damping", 0.608},
    {"seal-friction", 0.0539},
    {"self-heating", -1.26},
    {"sensor-delay", -0.371},
    {"series-dashpot", 0.193},
    {"shear-thinning", -0.593},
    {"stiction", -0.323},
    {"velocity-lag", 1.58},
    {"viscous-damping", -0.386},
};
constexpr Knot name_knots[] = {{-3.822, -2.018},  {-2.681, -2.002}, {-1.473, -1.217}, {-0.3623, -0.6655},
                               {-0.1162, -0.191}, {-0.02493, 0},    {0.4817, 0.3602}, {1.059, 1.199},
                               {1.334, 1.341},    {1.56, 1.609},    {1.836, 1.905},   {2.238, 2.144},
                               {2.65, 2.799},     {3.501, 3.647}};
constexpr double name_intercept = -10.379;

constexpr double missing_weights[] = {2.092, 1.278, 0.761, 2.006, 1.678, 1.4};
constexpr Knot missing_knots[] = {{-1.517, -1.609}, {-1.246, -1.289}, {-0.7949, -0.942}, {-0.1972, -0.191},
                                  {0.7028, 0.8025}, {1.743, 1.865},   {2.764, 2.565},    {6.551, 6.436}};
constexpr double missing_intercept = -1.5466;

constexpr double of_channels = 0.9815;

}  // namespace

const Table& alone_table() {
  static constexpr Table table{alone_intercept, alone_weights, alone_knots, alone_offsets};
  return table;
}

const Table& name_table() {
  static constexpr Table table{name_intercept, name_weights, name_knots, name_offsets};
  return table;
}

const Table& missing_table() {
  static constexpr Table table{missing_intercept, missing_weights, missing_knots};
  return table;
}

double channel_probability() { return of_channels; }

}  // namespace hysteron

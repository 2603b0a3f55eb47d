// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double alone_weights[] = {1.042, 0.8603, 2.514, 4.148, 1.614, 1.707, 1.915, 0.8505, 0.4819, 1.209};
constexpr Offset alone_offsets[] = {
    {"asymmetry", -0.444},
    {"cavitation", 0.637},
    {"clearance", 1.11},
    {"coil-lag", 1.23},
    {"compliance", -0.11},
    {"coulomb-friction", -0.634},
    {"cubic-stiffness", 0.32},
    {"degradation", -1.34},
    {"end-stop", -1.48},
    {"entrapped-gas", -0.279},
    {"force-drift", -0.103},
    {"gas-spring", -0.804},
    {"inertia", 0.2},
    {"linear-stiffness", 0.966},
    {"magnetic-remanence", 0.451},
    {"magnetic-saturation", 1.28},
    {"offset-force", -0.888},
    {"pinching", -0.511},
    {"pre-yield-hysteresis", 0.365},
    {"quadratic-damping", 0.0739},
    {"seal-friction", -0.0151},
    {"self-heating", -1.18},
    {"sensor-delay", -0.453},
    {"series-dashpot", 0.511},
    {"shear-thinning", -0.593},
    {"stiction", -0.171},
    {"velocity-lag", 2.44},
    {"viscous-damping", -0.504},
};
constexpr Knot alone_knots[] = {{-9.367, -5.058}, {-1.137, -1.111}, {1.363, 1.17}, {5.991, 6.816}};
constexpr double alone_intercept = -13.601;

constexpr double name_weights[] = {1.389, 0.7927, 2.165, 2.39, 1.495, 1.92, 1.879, 0.8872, 0.6292};
constexpr Offset name_offsets[] = {
    {"asymmetry", -0.552},
    {"cavitation", 0.615},
    {"clearance", 0.539},
    {"coil-lag", 1.2},
    {"compliance", -0.293},
    {"coulomb-friction", -0.764},
    {"cubic-stiffness", 0.23},
    {"degradation", 0.36},
    {"end-stop", -1.03},
    {"entrapped-gas", 0.238},
    {"force-drift", -0.183},
    {"gas-spring", -1.01},
    {"inertia", 0.124},
    {"linear-stiffness", 1.16},
    {"magnetic-remanence", 0.614},
    {"magnetic-saturation", 1.37},
    {"offset-force", -1.01},
    {"pinching", -0.922},
    {"pre-yield-hysteresis", 0.113},
    {"quadratic-damping", 0.101},
    {"seal-friction", 0.0639},
    {"self-heating", -1.31},
    {"sensor-delay", -0.619},
    {"series-dashpot", 0.321},
    {"shear-thinning", -0.841},
    {"stiction", 0.226},
    {"velocity-lag", 2.05},
    {"viscous-damping", -0.525},
};
constexpr Knot name_knots[] = {{-8.219, -3.732}, {-0.6482, -0.9118}, {1.761, 1.737}, {5.999, 7.044}};
constexpr double name_intercept = -10.832;

constexpr double missing_weights[] = {2.448, 1.787, 0.8122, 1.967, 1.866, 1.534};
constexpr Knot missing_knots[] = {{-1.797, -1.927}, {-0.1575, 0.1006}, {5.89, 5.452}, {16.68, 7.382}};
constexpr double missing_intercept = -1.7487;

constexpr double of_channels = 0.9872;

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

// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double alone_weights[] = {1.197, 0.8397, 2.488, 4.233, 1.623, 1.604, 1.373, 0.852, 0.4307, 1.066};
constexpr Offset alone_offsets[] = {
    {"asymmetry", -0.365},
    {"cavitation", 0.495},
    {"clearance", 0.98},
    {"coil-lag", 1.27},
    {"compliance", -0.0715},
    {"coulomb-friction", -0.74},
    {"cubic-stiffness", 0.467},
    {"degradation", -1.42},
    {"end-stop", -1.44},
    {"entrapped-gas", -0.176},
    {"force-drift", -0.194},
    {"gas-spring", -0.713},
    {"inertia", 0.325},
    {"linear-stiffness", 0.796},
    {"magnetic-remanence", 0.465},
    {"magnetic-saturation", 0.88},
    {"offset-force", -0.551},
    {"pinching", -0.331},
    {"pre-yield-hysteresis", 0.445},
    {"quadratic-damping", 0.144},
    {"seal-friction", -0.132},
    {"self-heating", -1.13},
    {"sensor-delay", -0.423},
    {"series-dashpot", 0.548},
    {"shear-thinning", -0.478},
    {"stiction", -0.277},
    {"velocity-lag", 2.24},
    {"viscous-damping", -0.525},
};
constexpr Knot alone_knots[] = {{-8.716, -4.396}, {-1.009, -1.066}, {1.318, 1.151}, {5.71, 6.412}};
constexpr double alone_intercept = -13.025;

constexpr double name_weights[] = {1.576, 0.8418, 2.151, 2.626, 1.444, 1.828, 1.367, 0.8858, 0.5975};
constexpr Offset name_offsets[] = {
    {"asymmetry", -0.453},
    {"cavitation", 0.691},
    {"clearance", 0.46},
    {"coil-lag", 1.2},
    {"compliance", -0.289},
    {"coulomb-friction", -0.91},
    {"cubic-stiffness", 0.382},
    {"degradation", 0.564},
    {"end-stop", -1.12},
    {"entrapped-gas", 0.119},
    {"force-drift", -0.318},
    {"gas-spring", -0.896},
    {"inertia", 0.243},
    {"linear-stiffness", 0.949},
    {"magnetic-remanence", 0.653},
    {"magnetic-saturation", 1.04},
    {"offset-force", -0.691},
    {"pinching", -0.811},
    {"pre-yield-hysteresis", 0.19},
    {"quadratic-damping", 0.245},
    {"seal-friction", -0.0452},
    {"self-heating", -1.35},
    {"sensor-delay", -0.598},
    {"series-dashpot", 0.319},
    {"shear-thinning", -0.617},
    {"stiction", -0.0634},
    {"velocity-lag", 1.9},
    {"viscous-damping", -0.564},
};
constexpr Knot name_knots[] = {{-7.742, -3.577}, {-0.5558, -0.8214}, {1.811, 1.816}, {5.835, 6.367}};
constexpr double name_intercept = -10.615;

constexpr double missing_weights[] = {2.2, 1.759, 0.7425, 1.884, 1.739, 1.527};
constexpr Knot missing_knots[] = {{-1.677, -1.787}, {-0.2822, -0.05568}, {5.476, 5.121}, {15.63, 7.225}};
constexpr double missing_intercept = -1.6221;

constexpr double of_channels = 0.9848;

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

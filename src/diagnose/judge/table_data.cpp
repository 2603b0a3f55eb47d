// Written by bench/learn_grades.cpp; what it was learned from: results/grades.md.
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

constexpr double alone_weights[] = {1.213, 0.9806, 2.704, 3.725, 1.565, 1.732, 0.8223, 0.4673, 0.9745};
constexpr Offset alone_offsets[] = {
    {"asymmetry", -0.0291},
    {"cavitation", 0.0546},
    {"clearance", 0.778},
    {"coil-lag", 1.09},
    {"compliance", 0.121},
    {"coulomb-friction", -0.776},
    {"cubic-stiffness", -0.0607},
    {"degradation", -1.49},
    {"end-stop", -1.27},
    {"entrapped-gas", -0.164},
    {"force-drift", -0.0956},
    {"gas-spring", -0.631},
    {"inertia", 0.445},
    {"linear-stiffness", 0.533},
    {"magnetic-remanence", 0.308},
    {"magnetic-saturation", 0.929},
    {"offset-force", -0.625},
    {"pinching", -0.309},
    {"pre-yield-hysteresis", 0.617},
    {"quadratic-damping", 0.464},
    {"seal-friction", 0.092},
    {"self-heating", -1.21},
    {"sensor-delay", -0.0536},
    {"series-dashpot", 0.579},
    {"shear-thinning", -0.382},
    {"stiction", -0.5},
    {"velocity-lag", 1.96},
    {"viscous-damping", -0.33},
};
constexpr Knot alone_knots[] = {{-4.137, 0.104},   {-2.72, 0.1341},   {-2.141, 0.1667},  {-1.3, 0.2021},
                                {-0.7923, 0.2619}, {-0.5938, 0.4024}, {-0.2289, 0.4344}, {0.1043, 0.4512},
                                {0.555, 0.6358},   {0.9104, 0.6429},  {1.172, 0.7295},   {1.464, 0.8171},
                                {1.831, 0.858},    {2.25, 0.9098},    {2.569, 0.939},    {3.258, 0.9643}};
constexpr double alone_intercept = -11.657;

constexpr double name_weights[] = {1.669, 0.9391, 2.289, 2.249, 1.332, 1.836, 0.9145, 0.6358};
constexpr Offset name_offsets[] = {
    {"asymmetry", -0.12},
    {"cavitation", 0.221},
    {"clearance", 0.274},
    {"coil-lag", 0.984},
    {"compliance", -0.133},
    {"coulomb-friction", -0.976},
    {"cubic-stiffness", -0.107},
    {"degradation", 0.686},
    {"end-stop", -0.882},
    {"entrapped-gas", 0.0408},
    {"force-drift", -0.234},
    {"gas-spring", -0.756},
    {"inertia", 0.345},
    {"linear-stiffness", 0.738},
    {"magnetic-remanence", 0.444},
    {"magnetic-saturation", 1.08},
    {"offset-force", -0.763},
    {"pinching", -0.789},
    {"pre-yield-hysteresis", 0.309},
    {"quadratic-damping", 0.617},
    {"seal-friction", 0.11},
    {"self-heating", -1.31},
    {"sensor-delay", -0.354},
    {"series-dashpot", 0.292},
    {"shear-thinning", -0.561},
    {"stiction", -0.307},
    {"velocity-lag", 1.66},
    {"viscous-damping", -0.375},
};
constexpr Knot name_knots[] = {{-3.413, 0.1436},  {-2.195, 0.1829},   {-1.906, 0.2143}, {-1.198, 0.2205},
                               {-0.3568, 0.3765}, {-0.02662, 0.4756}, {0.2418, 0.5488}, {0.6308, 0.6148},
                               {1.004, 0.7439},   {1.283, 0.8171},    {1.691, 0.8457},  {1.966, 0.881},
                               {2.202, 0.9074},   {2.913, 0.9468},    {3.973, 0.9741}};
constexpr double name_intercept = -9.3004;

constexpr double missing_weights[] = {2.092, 1.278, 0.761, 2.006, 1.678, 1.4};
constexpr Knot missing_knots[] = {{-1.517, 0.1667}, {-1.246, 0.216}, {-0.7949, 0.2805}, {-0.1972, 0.4524},
                                  {0.7028, 0.6905}, {1.743, 0.8659}, {2.764, 0.9286},   {6.551, 0.9984}};
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

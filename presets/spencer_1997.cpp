// The MR damper prototype of Spencer, Dyke, Sain and Carlson with the generalised parameters for a varying voltage.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"

namespace hysteron {

extern const Preset preset_spencer_1997;

namespace {

constexpr PresetQuantity quantities[] = {
    {"c0a", "N s/cm", "21.0", [](double /*i*/, double /*f*/) { return 21.0; }},
    {"c0b", "N s/(cm V)", "3.50", [](double /*i*/, double /*f*/) { return 3.50; }},
    {"k0", "N/cm", "46.9", [](double /*i*/, double /*f*/) { return 46.9; }},
    {"c1a", "N s/cm", "283", [](double /*i*/, double /*f*/) { return 283.0; }},
    {"c1b", "N s/(cm V)", "2.95", [](double /*i*/, double /*f*/) { return 2.95; }},
    {"k1", "N/cm", "5.00", [](double /*i*/, double /*f*/) { return 5.00; }},
    {"x0", "cm", "14.3", [](double /*i*/, double /*f*/) { return 14.3; }},
    {"alpha_a", "N/cm", "140", [](double /*i*/, double /*f*/) { return 140.0; }},
    {"alpha_b", "N/(cm V)", "695", [](double /*i*/, double /*f*/) { return 695.0; }},
    {"gamma", "cm^-2", "363", [](double /*i*/, double /*f*/) { return 363.0; }},
    {"beta", "cm^-2", "363", [](double /*i*/, double /*f*/) { return 363.0; }},
    {"A", "1", "301", [](double /*i*/, double /*f*/) { return 301.0; }},
    {"n", "1", "2", [](double /*i*/, double /*f*/) { return 2.0; }},
    {"u", "V", "the lagged voltage", [](double i, double /*f*/) { return i; }},
};

std::vector<double> parameters(std::span<const double> q) {
  const double u = q[13];
  const NormalForm z = normal_form(100.0 * (q[7] + q[8] * u), q[11], 1e4 * q[9], 1e4 * q[10], q[12]);
  return {z.yield_force,
          100.0 * (q[0] + q[1] * u),
          100.0 * (q[3] + q[4] * u),
          100.0 * q[2],
          100.0 * q[5],
          z.x_y,
          z.share,
          q[12],
          0.01 * q[6]};
}

}  // namespace

const Preset preset_spencer_1997 = {
    "spencer-1997",
    "MR damper prototype, modified Bouc-Wen for a varying voltage",
    "Spencer, Dyke, Sain, Carlson, J. Eng. Mech. 123 (1997) 230-238, doi 10.1061/(ASCE)0733-9399(1997)123:3(230)",
    "modified-bouc-wen",
    {},
    PresetDrive::voltage,
    0.0,
    2.25,
    false,
    1.0 / 190.0,
    "Printed in centimetres; converted. The drive lag eta = 190 1/s acts on the voltage before the parameters see it.",
    quantities,
    parameters};

}  // namespace hysteron

// Bouc-Wen parameters of the least-squares study, table 1; 0.4 Hz, 10 mm.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"
#include "presets/support/tabulated.hpp"

namespace hysteron {

extern const Preset preset_least_squares_table_1;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/m", "17.5, 19.3, 19.7, 19.0, 19.2",
     [](double i, double /*f*/) {
       return tabulated(i, {17.5, 19.3, 19.7, 19.0, 19.2});
     }},
    {"beta", "m^-n", "-889, -909, -1048, -1054, -1060",
     [](double i, double /*f*/) {
       return tabulated(i, {-889.0, -909.0, -1048.0, -1054.0, -1060.0});
     }},
    {"gamma", "m^-n", "1.4, 1.24, 1.207, 1.202, 1.196 (thousands)",
     [](double i, double /*f*/) {
       return tabulated(i, {1400.0, 1240.0, 1207.0, 1202.0, 1196.0});
     }},
    {"A", "1", "1.647, 1.626, 3.255, 3.516, 3.516 (thousands)",
     [](double i, double /*f*/) {
       return tabulated(i, {1647.0, 1626.0, 3255.0, 3516.0, 3516.0});
     }},
    {"n", "1", "1.02, -, 1.02, -, -",
     [](double i, double /*f*/) {
       return tabulated(i, {1.02, 1.01, 1.02, 1.01, 1.01});
     }},
    {"c0", "N s/m", "50.0, 50.4, 49.8, 50.0, 50.0",
     [](double i, double /*f*/) {
       return tabulated(i, {50.0, 50.4, 49.8, 50.0, 50.0});
     }},
    {"k0", "N/m", "111.7, 111.3, 82.4, 82.3, 82.3",
     [](double i, double /*f*/) {
       return tabulated(i, {111.7, 111.3, 82.4, 82.3, 82.3});
     }},
    {"x0", "m", "-25.8, -25.8, -25.6, -25.6, -25.6 (mm)",
     [](double i, double /*f*/) {
       return tabulated(i, {-0.0258, -0.0258, -0.0256, -0.0256, -0.0256});
     }},
};

std::vector<double> parameters(std::span<const double> q) {
  // alpha, beta, gamma, A, n, c0, k0, x0: gamma multiplies |v| z.
  const NormalForm z = normal_form(q[0], q[3], q[2], q[1], q[4]);
  return {z.yield_force, q[5], q[6], -q[6] * q[7], z.x_y, z.share, q[4]};
}

}  // namespace

const Preset preset_least_squares_table_1 = {
    "least-squares-table-1",
    "Bouc-Wen by least squares, all parameters free",
    "identification of a damper's Bouc-Wen model by non-linear least squares, 2023, table 1",
    "bouc-wen",
    {},
    PresetDrive::current,
    0.0,
    1.0,
    false,
    0.0,
    "No units are printed. A and gamma are read as thousands: the text gives their means after the second stage as "
    "3507.8 and 1235.8 beside 3.5 and 1.24 in table 2; x0 is in mm in the text. n is printed for 0 and 0.5 A only, the "
    "mean 1.01 of the text stands for the others. Linear between the printed currents.",
    quantities,
    parameters};

}  // namespace hysteron

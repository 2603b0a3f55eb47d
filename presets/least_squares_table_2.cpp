// Bouc-Wen parameters of the least-squares study, table 2; 0.4 Hz, 10 mm.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"
#include "presets/support/tabulated.hpp"

namespace hysteron {

extern const Preset preset_least_squares_table_2;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/m", "15.71, 21.4, 27.13, 31.69, 35.82",
     [](double i, double /*f*/) {
       return tabulated(i, {15.71, 21.4, 27.13, 31.69, 35.82});
     }},
    {"beta", "m^-n", "-1013.6 (mean, text)", [](double /*i*/, double /*f*/) { return -1013.6; }},
    {"gamma", "m^-n", "1235.8 (mean, text)", [](double /*i*/, double /*f*/) { return 1235.8; }},
    {"A", "1", "3507.8 (mean, text)", [](double /*i*/, double /*f*/) { return 3507.8; }},
    {"n", "1", "1.01", [](double /*i*/, double /*f*/) { return 1.01; }},
    {"c0", "N s/m", "33.78, 46.08, 49.5, 56.5, 53.6",
     [](double i, double /*f*/) {
       return tabulated(i, {33.78, 46.08, 49.5, 56.5, 53.6});
     }},
    {"k0", "N/m", "75.04, 68.13, 65.87, 70.87, 61.65: mean",
     [](double /*i*/, double /*f*/) { return (75.04 + 68.13 + 65.87 + 70.87 + 61.65) / 5.0; }},
    {"x0", "m", "-25.64 (mm)", [](double /*i*/, double /*f*/) { return -0.02564; }},
};

std::vector<double> parameters(std::span<const double> q) {
  // alpha, beta, gamma, A, n, c0, k0, x0: gamma multiplies |v| z.
  const NormalForm z = normal_form(q[0], q[3], q[2], q[1], q[4]);
  return {z.yield_force, q[5], q[6], -q[6] * q[7], z.x_y, z.share, q[4]};
}

}  // namespace

const Preset preset_least_squares_table_2 = {
    "least-squares-table-2",
    "Bouc-Wen by least squares, boundaries shrunk",
    "identification of a damper's Bouc-Wen model by non-linear least squares, 2023, table 2",
    "bouc-wen",
    {},
    PresetDrive::current,
    0.0,
    1.0,
    false,
    0.0,
    "Table 2 prints beta = -gamma (or below) for every current but 0 A, with which z grows without bound, so the "
    "columns of A, beta and gamma cannot be right: the means of the text (3507.8, -1013.6, 1235.8) are used, and that "
    "of the k0 column. n and x0 are fixed to the means 1.01 and -25.64 mm of the first stage. No units are printed. "
    "alpha and c0 linear between the printed currents.",
    quantities,
    parameters};

}  // namespace hysteron

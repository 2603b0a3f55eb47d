// The damper RD-8040-1 of the Levenberg-Marquardt study, table 1.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"

namespace hysteron {

extern const Preset preset_rd8040_1_lm;

namespace {

constexpr PresetQuantity quantities[] = {
    {"c0a", "N s/m", "3146.5 kN s/m", [](double /*i*/, double /*f*/) { return 3146.5; }},
    {"c0b", "kN s/(m V)", "0.6145", [](double /*i*/, double /*f*/) { return 0.6145; }},
    {"k0a", "kN/m", "0.2795", [](double /*i*/, double /*f*/) { return 0.2795; }},
    {"k0b", "kN/(m V)", "0", [](double /*i*/, double /*f*/) { return 0.0; }},
    {"x0", "m", "0.05", [](double /*i*/, double /*f*/) { return 0.05; }},
    {"alpha_a", "N/m", "4404.5 kN/m", [](double /*i*/, double /*f*/) { return 4404.5; }},
    {"alpha_b", "kN/(m V)", "0.0645", [](double /*i*/, double /*f*/) { return 0.0645; }},
    {"beta", "m^-2", "22148", [](double /*i*/, double /*f*/) { return 22148.0; }},
    {"gamma", "m^-2", "22148", [](double /*i*/, double /*f*/) { return 22148.0; }},
    {"A", "1", "1092.5", [](double /*i*/, double /*f*/) { return 1092.5; }},
    {"n", "1", "2.2", [](double /*i*/, double /*f*/) { return 2.2; }},
    {"u", "V", "the lagged voltage", [](double i, double /*f*/) { return i; }},
};

std::vector<double> parameters(std::span<const double> q) {
  const double u = q[11];
  const double k0 = 1e3 * (q[2] + q[3] * u);
  const NormalForm z = normal_form(q[5] + 1e3 * q[6] * u, q[9], q[8], q[7], q[10]);
  return {z.yield_force, q[0] + 1e3 * q[1] * u, k0, -k0 * q[4], z.x_y, z.share, q[10]};
}

}  // namespace

const Preset preset_rd8040_1_lm = {
    "rd8040-1-lm",
    "Damper RD-8040-1, 12-parameter current-dependent Bouc-Wen",
    "parameter identification of a long stroke and a short stroke MR damper (RD-8040-1, RD-8041-1) by "
    "Levenberg-Marquardt, table 1",
    "bouc-wen",
    {},
    PresetDrive::voltage,
    0.0,
    1.0,
    false,
    1.0 / 157.0,
    "The printed units of c0a (kN s/m) and alpha_a (kN/m) give hundreds of kN for a damper of 2.4 kN: they are read as "
    "N s/m and N/m, the others as printed. alpha_b as printed adds 12 to 13 N per volt, so that the set hardly depends "
    "on the drive, unlike the curves of the study. F = ... + alpha z-dot of its equation 1 is a misprint of alpha z. "
    "The drive lag eta = 157 1/s acts before the parameters see the drive.",
    quantities,
    parameters};

}  // namespace hysteron

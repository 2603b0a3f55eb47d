// Polynomials in current of a Bouc-Wen damper as quoted by the review.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"

namespace hysteron {

extern const Preset preset_review_13_14;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/mm", "-9.66 I^3 + 9.76 I^2 + 1.12 I + 0.1",
     [](double i, double /*f*/) { return ((-9.66 * i + 9.76) * i + 1.12) * i + 0.1; }},
    {"c0", "N s/mm", "4.48 I^4 - 4.74 I^3 + 1.35 I^2 + 0.05 I + 0.01",
     [](double i, double /*f*/) { return (((4.48 * i - 4.74) * i + 1.35) * i + 0.05) * i + 0.01; }},
    {"A", "1", "", nullptr},
    {"beta", "m^-n", "", nullptr},
    {"gamma", "m^-n", "", nullptr},
    {"n", "1", "", nullptr},
    {"k0", "N/m", "", nullptr},
    {"x0", "m", "", nullptr},
};

std::vector<double> parameters(std::span<const double> q) {
  const NormalForm z = normal_form(1e3 * q[0], q[2], q[4], q[3], q[5]);
  return {z.yield_force, 1e3 * q[1], q[6], -q[6] * q[7], z.x_y, z.share, q[5]};
}

}  // namespace

const Preset preset_review_13_14 = {
    "review-13-14",
    "Bouc-Wen, alpha and c0 as polynomials of the current",
    "review of the mathematical modelling of MR dampers, equations 13 and 14",
    "bouc-wen",
    {},
    PresetDrive::current,
    0.0,
    1.0,
    false,
    0.0,
    "The source prints these polynomials only; the other quantities have to be given with --set. The unit of c0 is not "
    "printed; N s/mm is assumed, to go with the N/mm of alpha. beta and gamma in 1/m^n, A without unit.",
    quantities,
    parameters};

}  // namespace hysteron

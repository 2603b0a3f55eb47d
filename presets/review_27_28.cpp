// Polynomials in voltage of a modified Bouc-Wen damper as quoted by the review.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"

namespace hysteron {

extern const Preset preset_review_27_28;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/m", "2.3363 v^2 - 3.4209 v + 5000",
     [](double i, double /*f*/) { return (2.3363 * i - 3.4209) * i + 5000.0; }},
    {"c0", "N s/m", "0.1794 v^2 - 2.0484 v + 2700",
     [](double i, double /*f*/) { return (0.1794 * i - 2.0484) * i + 2700.0; }},
    {"c1", "N s/m", "", nullptr},
    {"A", "1", "", nullptr},
    {"beta", "m^-n", "", nullptr},
    {"gamma", "m^-n", "", nullptr},
    {"n", "1", "", nullptr},
    {"k0", "N/m", "", nullptr},
    {"k1", "N/m", "", nullptr},
    {"x0", "m", "", nullptr},
};

std::vector<double> parameters(std::span<const double> q) {
  const NormalForm z = normal_form(q[0], q[3], q[5], q[4], q[6]);
  return {z.yield_force, q[1], q[2], q[7], q[8], z.x_y, z.share, q[6], q[9]};
}

}  // namespace

const Preset preset_review_27_28 = {
    "review-27-28",
    "Modified Bouc-Wen, alpha and c0 as polynomials of the voltage",
    "review of the mathematical modelling of MR dampers, equations 27 and 28",
    "modified-bouc-wen",
    {},
    PresetDrive::voltage,
    0.0,
    2.0,
    false,
    0.0,
    "The source prints these polynomials only; the other quantities have to be given with --set. No units are printed; "
    "N/m and N s/m are assumed. As printed both hardly depend on the voltage (0.1 per cent over 2 V), which cannot be "
    "right for an MR damper: factors of thousand are probably lost.",
    quantities,
    parameters};

}  // namespace hysteron

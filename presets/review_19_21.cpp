// Polynomials in current of a modified Bouc-Wen damper as quoted by the review.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"

namespace hysteron {

extern const Preset preset_review_19_21;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/mm", "-826.67 I^3 + 905.14 I^2 + 412.52 I + 38.24",
     [](double i, double /*f*/) { return ((-826.67 * i + 905.14) * i + 412.52) * i + 38.24; }},
    {"c0", "N s/mm", "-11.73 I^3 + 10.51 I^2 + 11.02 I + 0.59",
     [](double i, double /*f*/) { return ((-11.73 * i + 10.51) * i + 11.02) * i + 0.59; }},
    {"c1", "N s/mm", "-54.40 I^3 + 57.03 I^2 + 64.57 I + 4.73",
     [](double i, double /*f*/) { return ((-54.4 * i + 57.03) * i + 64.57) * i + 4.73; }},
    {"A", "1", "", nullptr},
    {"beta", "m^-n", "", nullptr},
    {"gamma", "m^-n", "", nullptr},
    {"n", "1", "", nullptr},
    {"k0", "N/m", "", nullptr},
    {"k1", "N/m", "", nullptr},
    {"x0", "m", "", nullptr},
};

std::vector<double> parameters(std::span<const double> q) {
  const NormalForm z = normal_form(1e3 * q[0], q[3], q[5], q[4], q[6]);
  return {z.yield_force, 1e3 * q[1], 1e3 * q[2], q[7], q[8], z.x_y, z.share, q[6], q[9]};
}

}  // namespace

const Preset preset_review_19_21 = {"review-19-21",
                                    "Modified Bouc-Wen, alpha, c0 and c1 as polynomials of the current",
                                    "review of the mathematical modelling of MR dampers, equations 19 to 21",
                                    "modified-bouc-wen",
                                    {},
                                    PresetDrive::current,
                                    0.0,
                                    0.9,
                                    false,
                                    0.0,
                                    "The source prints these polynomials only; the other quantities have to be given "
                                    "with --set. No units are printed; N/mm and N s/mm are assumed. The range of their "
                                    "experiments is not printed either; alpha and c0 fall again beyond 0.9 A.",
                                    quantities,
                                    parameters};

}  // namespace hysteron

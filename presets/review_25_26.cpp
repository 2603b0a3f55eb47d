// Polynomials in current of a Bingham damper as quoted by the review.
#include "presets/preset.hpp"

namespace hysteron {

extern const Preset preset_review_25_26;

namespace {

constexpr PresetQuantity quantities[] = {
    {"fc", "N", "-85.19 i^3 + 75.67 i^2 + 24.95 i + 0.14",
     [](double i, double /*f*/) { return ((-85.19 * i + 75.67) * i + 24.95) * i + 0.14; }},
    {"c0", "N s/mm", "-0.079 i^3 - 0.133 i^2 + 0.184 i + 0.004",
     [](double i, double /*f*/) { return ((-0.079 * i - 0.133) * i + 0.184) * i + 0.004; }},
};

std::vector<double> parameters(std::span<const double> q) { return {q[0], 1e3 * q[1], 0.0, 1e-3}; }

}  // namespace

const Preset preset_review_25_26 = {
    "review-25-26",
    "Bingham, yield force and damping as polynomials of the current",
    "review of the mathematical modelling of MR dampers, equations 25 and 26",
    "bingham",
    {},
    PresetDrive::current,
    0.0,
    0.8,
    false,
    0.0,
    "No units are printed; N and N s/mm are assumed (the peak is then some 25 N, a small damper). From 0.92 A on c0 is "
    "negative, which no damper is: the polynomial cannot hold up to 1 A.",
    quantities,
    parameters};

}  // namespace hysteron

// The damper RD-8040-1 as identified by particle swarm, polynomials in current and frequency.
#include "presets/preset.hpp"
#include "presets/support/bouc_wen_form.hpp"
#include "presets/support/rd8040_polynomials.hpp"

namespace hysteron {

extern const Preset preset_rd8040_1_pso;

namespace {

constexpr PresetQuantity quantities[] = {
    {"alpha", "N/m", "80", [](double /*i*/, double /*f*/) { return 80.0; }},
    {"n", "1", "1", [](double /*i*/, double /*f*/) { return 1.0; }},
    {"x0", "m", "0", [](double /*i*/, double /*f*/) { return 0.0; }},
    {"beta", "m^-1", "equation 16", [](double i, double f) { return rd8040::beta(i, f); }},
    {"gamma", "m^-1", "equation 17", [](double i, double f) { return rd8040::gamma(i, f); }},
    {"A", "1", "equation 18", [](double i, double f) { return rd8040::A(i, f); }},
    {"k1", "N/m", "equation 19", [](double i, double f) { return rd8040::k1(i, f); }},
    {"k0", "N/m", "equation 20", [](double i, double f) { return rd8040::k0(i, f); }},
    {"c0", "N s/m", "equation 21", [](double i, double f) { return rd8040::c0(i, f); }},
    {"c1", "N s/m", "equation 22", [](double i, double f) { return rd8040::c1(i, f); }},
    {"f0", "N", "equation 23", [](double i, double f) { return rd8040::f0(i, f); }},
};

constexpr std::string_view effects[] = {"offset-force"};

std::vector<double> parameters(std::span<const double> q) {
  // gamma multiplies |u| z.
  const NormalForm z = normal_form(q[0], q[5], q[4], q[3], q[1]);
  return {z.yield_force, q[8], q[9], q[7], q[6], z.x_y, z.share, q[1], q[2], q[10]};
}

}  // namespace

const Preset preset_rd8040_1_pso = {
    "rd8040-1-pso",
    "Damper RD-8040-1, modified Bouc-Wen with offset force over current and frequency",
    "PSO-against-GA study of the RD-8040-1, 2021, equations 16 to 23",
    "modified-bouc-wen",
    effects,
    PresetDrive::current,
    0.0,
    1.0,
    true,
    0.0,
    "In SI units, the polynomials give finite, sensible forces over all 55 conditions (0.4 to 2 Hz, 0 to 1 A, 25 mm). "
    "k0 is negative for many of them, beta or gamma for some; used as printed. The terms in i^3 or f^3 that some "
    "polynomials lack are lacking in print. The frequency is that of the recording.",
    quantities,
    parameters};

}  // namespace hysteron

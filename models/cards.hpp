// Rows that the cards of several parts share.
#pragma once

#include "simulate/parameter.hpp"

namespace hysteron::cards {

// In parallel with the rest of a law.
inline constexpr Parameter c0 = {.name = "c0", .unit = "N s/m", .meaning = "viscous damping", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping};
inline constexpr Parameter k0 = {.name = "k0", .unit = "N/m", .meaning = "stiffness", .box = {-2e4, 1e5}, .initial = 0, .linear = true, .role = PhysicalRole::stiffness};
inline constexpr Parameter f0 = {.name = "f0", .unit = "N", .meaning = "offset force", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force};

// tanh(v / v_s) stands for sgn(v).
inline constexpr Parameter v_s = {.name = "v_s", .unit = "m/s", .meaning = "speed at which the sign function is rounded", .box = {1e-4, 0.1}, .initial = 1e-3, .scale = Scale::logarithmic, .fixed = true};

}  // namespace hysteron::cards

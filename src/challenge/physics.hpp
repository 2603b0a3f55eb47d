// The true damper of a concealed campaign: a law, everything that may be added to it, and its simulation.
// Written from the physics, apart from models/ and simulate/: other normal forms, other state equations, other
// integrator, series elements with a force balance instead of a filtered motion.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "challenge/excitation.hpp"

namespace hysteron::challenge {

enum class Law { bouc_wen, modified_bouc_wen, tanh_hysteresis, bingham, lugre };

// The id of the model of the contract that has the same equations.
[[nodiscard]] std::string_view model_of(Law law);

inline constexpr double never = std::numeric_limits<double>::infinity();

// SI units. A default means: not there.
struct Physics {
  Law law = Law::bouc_wen;

  // The law. Yield force and damping are affine in the drive: alpha = alpha_a + alpha_b i, c = c_a + c_b i.
  double alpha_a = 0.0, alpha_b = 0.0;  // N, N/A
  double c_a = 0.0, c_b = 0.0;          // N s/m
  double k0 = 0.0, f0 = 0.0;            // spring and offset
  // Bouc-Wen: F = (alpha / Z) z + c v + k0 x + f0, z' = A v - beta |v| z |z|^(n-1) - gamma v |z|^n, Z^n =
  // A/(beta+gamma)
  double A = 1.0, beta = 0.0, gamma = 0.0, n = 2.0;
  // modified Bouc-Wen: F = c1 y' + k1 x, y' = (alpha z + c x' + k0 (x - y)) / (c + c1), z driven by x' - y'
  double c1 = never, k1 = 0.0;
  // Kwok: F = alpha tanh((v + v_h sgn x) / v_y) + c v + k0 x + f0; Bingham: F = alpha sgn v + c v + f0
  double v_y = 0.0, v_h = 0.0, sign_speed = 1e-3, sign_length = 5e-4;
  // LuGre: F = s0 z + s1 z' + c v, z' = v - s0 |v| z / g(v), g = alpha (1 + (ratio - 1) exp(-(v/v_st)^2)), s0 =
  // alpha/x_b
  double x_b = 1e-3, ratio = 1.0, v_st = 1e-2, s1 = 0.0;

  // Parallel to the rod.
  double offset = 0.0, stiffness = 0.0, cubic = 0.0, viscous = 0.0, mass = 0.0, drift = 0.0;
  double gas_force = 0.0, gas_swept = 0.0, gas_exponent = 1.2;  // p0 A, A / V0
  double stop_force = 0.0, stop_up = never, stop_low = never, stop_depth = 1e-3,
         stop_power = 1.5;                                                          // force at the depth
  double seal_coulomb = 0.0, seal_static = 0.0, seal_speed = 1e-2, bristle = 4e-5;  // LuGre bristles
  double film_speed = 0.0;  // above zero friction on a film in place of bristles
  double coulomb = 0.0;
  double pre_force = 0.0, pre_length = 1e-3;  // sliding bristles with a long knee

  // In the fluid.
  double quadratic = 0.0;
  double thinning = 0.0, thin_speed = 0.1, thin_power = 1.0;  // Cross law: c (1 - th + th / (1 + |v/v_c|^m))
  double asymmetry = 0.0;
  double heat_rate = 0.0, heat_capacity = 1.0, cooling_time = 60.0, heat_yield_share = 1.0;
  double wear = 0.0;                                           // loss per joule
  double rest_excess = 0.0, rest_length = 0.0;                 // first travel
  double pinch = 0.0, pinch_centre = 0.0, pinch_width = 1e-2;  // loss of force around a place of the stroke
  double cavitation = never, refill_time = 0.1;                // force at which the fluid column parts, for v < 0

  // In series with the damper; at most one.
  double gap = 0.0, contact_stiffness = 0.0, contact_damping = 0.0;
  double series_stiffness = never;
  double series_dashpot = never;
  double pocket_length = 0.0, pocket_force = 0.0, pocket_exponent = 1.2;

  // From command to field.
  double coil_rise = 0.0, coil_fall = 0.0;  // s
  double saturation = never;                // A
  double remanence = 0.0;                   // A, half width of the play

  // Measuring chain.
  double force_delay = 0.0;   // s
  double velocity_lag = 0.0;  // s, of the recorded velocity
  double acting_lag = 0.0;    // s, of the velocity that acts: what a law fed with the recorded velocity would see

  // In no catalogue.
  double place_friction = 0.0, place_centre = 0.0, place_length = 1.0;
  double knee_growth = 0.0;  // of the yield displacement, per unit of drive
  double mount_force = 0.0, mount_length = 1e-2, mount_fast = 0.02, mount_slow = 0.2;
  double swing_damping = 0.0, swing_length = 1e-2;
  double supply = 0.0, supply_period = 3.0, supply_phase = 0.0;
  double slip_lock = 0.0, slip_centre = 0.0, slip_width = 0.3;  // of the hysteresis, where it passes zero
  double valve = 0.0, valve_speed = 0.1;

  double force_scale = 1e3, length_scale = 1e-2;  // of the device, for error control

  [[nodiscard]] bool has_series() const {
    return gap > 0.0 || series_stiffness < never || series_dashpot < never || pocket_length > 0.0;
  }
};

// All channels on a grid of `rate` Hz that begins `lead` seconds before the recording.
struct Track {
  double rate = 0.0;
  std::size_t lead = 0;  // points before t = 0
  std::vector<double> x, v, drive, force;
};

// Simulates one test; `rate` is the grid's, in Hz.
[[nodiscard]] Track simulate(const Physics& physics, const Run& test, double rate);

}  // namespace hysteron::challenge

// The true damper of a concealed campaign: a law, the mechanisms that are added to it, and its simulation.
// Written from the physics, apart from models/ and simulate/: other normal forms, other state equations, other
// integrator, series elements with a force balance instead of a filtered motion.
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "challenge/excitation.hpp"
#include "challenge/part.hpp"

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

  // Beside the law, in any number; in series at most what can_stand_in_series() takes.
  std::vector<PartPointer> parts;

  // The velocity that acts is this late: what a law fed with a late velocity channel would see. For sizes only.
  double acting_delay = 0.0;  // s

  double force_scale = 1e3, length_scale = 1e-2;  // of the device, for error control
};

// Whether a force balance can be found with these parts in series: one; two elastic ones; or an elastic one and a
// dashpot.
[[nodiscard]] bool can_stand_in_series(const std::vector<InSeries>& chain);

// All channels on a grid of `rate` Hz that begins `lead` seconds before the recording.
struct Track {
  double rate = 0.0;
  std::size_t lead = 0;  // points before t = 0
  std::vector<double> x, v, drive, force;
  std::vector<double> end;  // states of the parts, one part after the other
};

// Thrown where a damper takes hundreds of times as many steps as others: parts that chatter or are too stiff together.
struct TooStiff {};

// Simulates one test; `rate` is the grid's, in Hz, `before` the end of the test before it, which counts where the test
// has a pause.
[[nodiscard]] Track simulate(const Physics& physics, const Run& test, double rate, std::span<const double> before = {});

}  // namespace hysteron::challenge

// Motion of a mass on a damper model:
//   m x'' + C x' + K x + F(x, x', ...) = f(t)                            under a force f
//   m (y + b)'' + C y' + K y + F(y, y', ...) = 0,   y = x - b            under a base motion b
// with the model's own states. Integrated by the pair of Dormand and Prince, order 5 with steps controlled by order 4,
// or in steps of equal length; steps end at every sample. A force that depends on the acceleration (inertia) is solved
// for it. Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19-26.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fit/layout.hpp"
#include "respond/signal.hpp"

namespace hysteron {

struct Oscillator {
  CompositeModel model;
  // Parameters of the model at a drive (A or V) and at values of the conditions.
  std::function<std::vector<double>(double drive, std::span<const double> conditions)> parameters;
  double mass = 1.0;       // kg
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // N s/m
};

struct RespondOptions {
  double tolerance = 1e-8;    // of a step, relative to the largest state so far
  int substeps = 0;           // steps of equal length between samples; 0: as the tolerance asks
  double displacement = 0.0;  // m, at the start, relative to the base
  double velocity = 0.0;      // m/s
  // Asked between steps; true ends the motion.
  std::function<bool()> stopped = [] { return false; };
};

// No mass on a damper comes so far.
constexpr double farthest_motion = 1e5;  // m

struct Excitation {
  std::vector<double> time;     // s, where the motion is wanted
  std::optional<Signal> force;  // N
  std::optional<Signal> base;   // m
  std::optional<Signal> drive;  // A or V
  std::vector<Signal> conditions = {};
};

// Conditions of a recording along its time.
std::vector<Signal> condition_signals(const Recording& recording, bool periodic);

// One entry a time.
struct MassMotion {
  std::vector<double> displacement;  // m, relative to the base
  std::vector<double> velocity;      // m/s
  std::vector<double> acceleration;  // m/s^2
  std::vector<double> force;         // N, of the model
};

// Throws InputError for a model whose motion cannot be told: its force needs the jerk, which belongs to the channels of
// a recording, or an effect acts on a drive that varies and that parameters follow. `p` are parameters off all neutral
// values.
void require_response(const CompositeModel& model, const std::vector<double>& p, bool follows_varying_drive);

// Throws WorkError where the motion runs away, cannot be followed or is stopped, InputError for a model that needs what
// a motion to come does not tell.
MassMotion respond(const Oscillator& oscillator, const Excitation& excitation, const RespondOptions& options);

}  // namespace hysteron

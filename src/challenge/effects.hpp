// What can be hidden in a campaign: every effect of the catalogue, and causes that are in no catalogue.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

// Orders of magnitude of the damper and of what is done to it.
struct Device {
  double force = 1e3;       // N, peak
  double amplitude = 1e-2;  // m, largest
  double smallest_amplitude = 1e-3;
  double speed = 0.1;         // m/s, largest
  double acceleration = 1.0;  // m/s^2, largest
  double longest = 5.0;       // s, of a recording
  double middle = 0.0;        // m
  double level = 1.0;         // highest drive
  double energy = 1.0;        // J, dissipated in the longest recording, roughly
};

struct TrueParameter {
  std::string name;
  double value;
  std::string unit;
};

enum class Group { dead_zone, phase, curvature, even, slow, drive_path, friction, stop, stiffness };

struct HiddenEffect {
  std::string_view id;
  Group group;  // two effects of a pair come from different groups
  bool foreign;
  bool series;    // at most one series element
  Needs needs;    // what excites it
  Needs starved;  // what keeps it unexcited
  bool can_starve;
  bool needs_velocity_channel;
  std::vector<Law> laws;  // where it is not already in the law
  double least, most;     // strength
  // Puts the effect in; shape parameters are drawn from the stream, the same for every strength.
  void (*put)(Physics& physics, const Device& device, double strength, Draws shape);
  // Its parameters as the catalogue has them, where they are comparable.
  std::vector<TrueParameter> (*parameters)(const Physics& physics);
};

[[nodiscard]] std::span<const HiddenEffect> hidden_effects();
// InputError with the known ids when there is none of this name.
[[nodiscard]] const HiddenEffect& hidden_effect(std::string_view id);

}  // namespace hysteron::challenge

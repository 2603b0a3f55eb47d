// What can be hidden in a campaign: every effect of the catalogue in several forms, none with the catalogue's equation,
// and causes that are in no catalogue.
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

enum class Group { dead_zone, phase, curvature, even, slow, drive_path, friction, stop, stiffness };

// One equation of a cause. Its id is "effect/form"; a foreign cause has one form, of its own id.
struct HiddenForm {
  std::string id;
  std::string_view words;  // what sets it apart, for lists
  InSeries chain;
  // At a strength; shape parameters are drawn from the stream, the same for every strength.
  PartPointer (*make)(const Device& device, double strength, Draws shape);
  // Another effect of the catalogue that is this physics too: naming it is no mistake, and counts as no find.
  std::string_view also = {};
};

struct HiddenEffect {
  std::string_view id;
  Group group;  // two effects of a pair come from different groups
  bool foreign = false;
  Needs needs = {};    // what excites it
  Needs starved = {};  // what keeps it unexcited
  bool can_starve = false;
  bool needs_velocity_channel = false;
  std::vector<Law> laws = {};          // where it is not already in the law
  double least = 1e-4, most = 1.0;     // strength
  std::vector<HiddenForm> forms = {};  // at least one
};

[[nodiscard]] std::span<const HiddenEffect> hidden_effects();
// InputError with the known ids when there is none of this name.
[[nodiscard]] const HiddenEffect& hidden_effect(std::string_view id);

// A form with its effect.
struct FormOf {
  const HiddenEffect* effect;
  const HiddenForm* form;
};
// Of an id "effect/form", or of a foreign cause's id; InputError when there is none.
[[nodiscard]] FormOf hidden_form(std::string_view id);

}  // namespace hysteron::challenge

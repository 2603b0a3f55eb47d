// Signature contrasts: what only one mechanism does to the force. How each is read off what a fitted law leaves:
// diagnose/residual/contrast.hpp. An effect says on its card which of them speak for it.
#pragma once

#include <cstddef>
#include <string_view>

namespace hysteron {

enum class ContrastKind {
  rest_relaxation,
  reversal_travel,
  force_travel,
  force_delay,
  velocity_delay,
  acceleration,
  drive_lag,
  drive_memory,
  drive_bend,
  mean_force,
  stiffness,
  stiffness_bend,
  stiffness_cubic,
  stroke_end,
  middle_loss,
  side_loss,
  energy_fade,
  carried_fade,
  pause_recovery,
  first_travel,
  drift,
  direction,
  one_sided_limit,
  dry_friction,
  low_speed,
  viscous,
  speed_bend,
  pre_yield,
};
constexpr std::size_t contrast_kinds = static_cast<std::size_t>(ContrastKind::pre_yield) + 1;

// The sign that the value of a contrast has where an effect acts.
enum class Sense { either, positive, negative };
// 0, 1 or -1.
constexpr int sign_of(Sense sense) { return sense == Sense::either ? 0 : sense == Sense::positive ? 1 : -1; }

struct ContrastSense {
  ContrastKind contrast;
  Sense sense;
};

// One line for a contrast: "travel without force after a reversal", its unit, and the identifier used in result files.
struct ContrastCard {
  ContrastKind kind{};
  std::string_view id;
  std::string_view what;
  std::string_view unit;
  // Recordings of one motion tell it each for itself: it is no misfit that a motion repeats.
  bool by_recording = false;
};
const ContrastCard& card_of(ContrastKind kind);

}  // namespace hysteron

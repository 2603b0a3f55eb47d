// Signature contrasts: what only one mechanism does to the force, read off what a fitted base model leaves of it.
// Nothing is fitted or simulated here. Each is one number in physical units with a standard error over recordings, and
// is compared with placebos: the same number of residuals that were moved against the motion. docs/contrasts.md says
// what each measures, needs and is mistaken for.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

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
  energy_fade,
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

struct ContrastOfRecording {
  std::size_t recording = 0;  // index in the span that was given
  double value = 0.0;         // in the contrast's unit
};

struct Contrast {
  ContrastKind kind{};
  std::string_view what;  // "travel without force after a reversal"
  double value = 0.0;
  double std_error =
      0.0;  // the largest of those over half-cycles, over recordings and over motions, of these three and more
  std::string_view unit;
  std::size_t recordings = 0;  // that hold the motion it needs
  double consistency = 0.0;    // share of these whose own value has the sign of `value`
  // value / std_error, Student's t of as many degrees of freedom as there are recordings (with fewer than three, half-
  // cycles) less one, as the standard normal's value that is as rare: comparable between few and many.
  double z = 0.0;
  double placebo_quantile = 0.0;  // share of the placebos whose size is below that of the value
  std::size_t placebos = 0;       // how many there were
  std::vector<ContrastOfRecording> of_recordings;
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

// Ids of the effects (CONTRACT) that a contrast speaks for, nearest first.
std::span<const std::string_view> speaks_for(ContrastKind kind);
// The sign that its value has where that effect acts: 1, -1, or 0 where both occur or it does not speak for it.
int sign_for(ContrastKind kind, std::string_view effect);

enum class Placebos { none, all };

// In the order of ContrastKind; kinds whose motion no recording holds are absent. `residuals` holds simulated -
// measured force of the fitted base on each recording. Every number is finite. Deterministic. Placebos take nearly all
// of the time: without them `placebo_quantile` is 0.
// `motions` holds the number of each recording's motion (conditions.hpp); empty: each has one of its own.
std::vector<Contrast> contrasts(std::span<const Recording> recordings, std::span<const Residual> residuals,
                                std::span<const std::size_t> motions = {}, Placebos placebos = Placebos::all);

// Those of them that the channels of the recordings tell by themselves, whatever the model.
std::vector<Contrast> channel_contrasts(std::span<const Recording> recordings);

}  // namespace hysteron

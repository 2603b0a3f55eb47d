// Signature contrasts: what only one mechanism does to the force, read off what a fitted base model leaves of it.
// Nothing is fitted or simulated here. Each is one number in physical units with a standard error over recordings, and
// is compared with placebos: the same number of residuals that were moved against the motion. docs/contrasts.md says
// what each measures, needs and is mistaken for.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/contrast_kind.hpp"
#include "core/recording.hpp"
#include "diagnose/residual/residuals.hpp"

namespace hysteron {

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
  bool of_all = false;  // one number of all recordings together, of which none has a value of its own
};

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

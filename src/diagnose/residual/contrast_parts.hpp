// What the contrasts share: how values of recordings become one with a standard error, and placebos.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "diagnose/residual/contrast.hpp"
#include "diagnose/residual/contrast_track.hpp"

namespace hysteron::contrast {

constexpr std::size_t all_placebos = 199;  // so that a quantile of 0.995 can be told

// Samples by which a placebo shifts a residual of `size` samples in time: uniform at random for each placebo and
// recording, at least 8 % from either end, and no nearer to a multiple of `period` (in samples) than a tenth of it, if
// one of 16 draws is.
std::size_t placebo_shift(std::size_t placebo, std::size_t recording, std::size_t size, double period);
// 1 or -1, at random for each placebo, recording and part of it.
double placebo_sign(std::size_t placebo, std::size_t recording, std::size_t part);

// A value with its weight, of a recording or of a part of one.
struct Part {
  std::size_t recording = 0;
  double weight = 0.0;
  double value = 0.0;
  std::size_t motion = 0;
};

// The weighted mean of the recordings' values. Its standard error is that over `blocks`, parts of recordings, and where
// three or more recordings hold what it needs, or three or more motions, that over these if it is larger. Empty where
// there are not two blocks.
std::optional<Contrast> pooled(ContrastKind kind, std::span<const Part> recordings, std::span<const Part> blocks);
// How many parts of equal weight would be worth as much: (sum w)^2 / sum w^2.
double effective_number(std::span<const Part> parts);

// The standard normal's value that is as rare as Student's t (Wallace 1959, within 0.02 up to 4 from three degrees on).
double normal_of(double t, double degrees);
// Of the value: standard errors below it are those of rounding.
constexpr double least_error = 1e-6;
// Fewest degrees of freedom of Student's t.
constexpr double least_degrees = 2.0;
// Share of a signature's square that what is held beside it must leave.
constexpr double least_left = 3e-3;

// Events of single recordings: each recording has the mean of its own.
struct Event {
  std::size_t recording = 0;
  double value = 0.0;
  std::size_t motion = 0;
};
std::optional<Contrast> pooled(ContrastKind kind, std::span<const Event> events);
// The mean over recordings of the mean of their events; 0 for none.
double mean_of(std::span<const Event> events);

// Enters the share of placebos whose size is below that of what was found.
void judge(Contrast& contrast, double size, std::span<const double> of_placebos);

// The contrasts, by subject; each adds those whose motion is there.
void add_rest_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_reversal_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_motion_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_slow_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_carried_contrast(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_drive_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);
void add_channel_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result);

}  // namespace hysteron::contrast

// What displacement and velocity show of faults of the motion's channels: samples that are lost, glitches, also at the
// ends, moments of zeros, a channel that is slower than the log, and a recorded velocity that lags the slope of the
// displacement or is off by a constant.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// The largest step of a channel that moves before and after it, many times longer than the steps around it and than the
// channel's resolution: samples are lost there, or two records were joined. A channel that stays at one value exactly
// before or after it has to move on the other side of that. Steps of time that are longer than the others make longer
// steps: a gap in the times is no leap.
struct Leap {
  std::size_t after = 0;  // the step is from this sample to the next
  double size = 0.0;      // in the channel's unit
};
std::optional<Leap> leap_of(const std::vector<double>& time, const std::vector<double>& values);

// Jumps by nearly the whole range of the channel, each against the way that it goes on both sides and at the same
// speed: a counter that overflows and begins again at the other end. Nothing where any jump is of another kind.
struct Wrap {
  std::size_t after = 0;  // the first is from this sample to the next
  double range = 0.0;     // of the counter, about, in the channel's unit
  double before = 0.0;    // speed, per s
  double behind = 0.0;
  std::size_t count = 0;  // of the jumps
};
std::optional<Wrap> wrap_of(const std::vector<double>& time, const std::vector<double>& values);

// One or two samples that a channel leaves for and comes back from, by steps many times longer than those around them
// and than the channel's resolution: a glitch of a sensor within its range. The furthest, and how many there are; more
// than one of fifty samples is how the channel is. Those beyond its range are told by io/outliers.hpp.
struct Excursion {
  std::size_t at = 0;  // index of a sample
  double from = 0.0;   // the sample before
  std::size_t count = 0;
};
std::optional<Excursion> excursion_of(const std::vector<double>& time, const std::vector<double>& values);

// A sample among the first or last five that is off the path which the samples behind it (before it, at the end) tell,
// by many times what that misses any of these and more than their steps, while the channel moves: no sample tells of it
// from the other side. Nothing beside a gap of the times.
struct StrayEnd {
  std::size_t at = 0;     // index of the sample next to the path
  double told = 0.0;      // there, by the path
  std::size_t count = 0;  // of samples from that end to it
  bool first = false;     // at the start
};
std::optional<StrayEnd> stray_end_of(const std::vector<double>& time, const std::vector<double>& values);

// Stretches of few samples that are exactly zero, two or more of them, entered and left by jumps many times longer than
// any step of the channel elsewhere, and back to where it may have gone meanwhile: a sensor or a transmission that
// fails for moments.
struct Dropouts {
  std::size_t count = 0;
  std::size_t first = 0;  // index of a sample
};
std::optional<Dropouts> dropouts_of(const std::vector<double>& values);

// How many samples a channel holds each of its values for, where it does so throughout and its steps are not those of a
// converter: a sensor that is slower than the log. Nothing for a channel that changes from sample to sample.
std::optional<double> held_samples_of(const std::vector<double>& values);

// A recorded velocity against the slope of the displacement.
struct VelocityFault {
  double offset = 0.0;        // m/s, by which its mean misses the net displacement over the time
  double offset_share = 0.0;  // of the largest speed without it
  double offset_error = 0.0;  // its standard error, by how far parts of the recording agree
  double lag = 0.0;           // s, behind the slope (io/channel_lag.hpp); negative: ahead
  double phase = 0.0;         // rad, that the lag is at the frequency of the motion, as acceleration over speed tell it
};
VelocityFault velocity_fault_of(const Recording& recording);

// Share of the velocity's mean square that is noise, over the samples that move. By so much a damping comes out too
// small: a regression on v + e attenuates by 1 - <e^2> / <(v + e)^2>.
double noise_share_of_velocity(const Recording& recording);

}  // namespace hysteron

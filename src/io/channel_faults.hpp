// What a channel shows of its own faults: an end of its range at which it stays, silence, and, beside another channel,
// a value that it holds while the other goes on. Samples that stand out alone: io/outliers.hpp.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace hysteron {

// Calls `visit(first, count)` for all stretches of one value.
template <class Visit>
void for_each_run(const std::vector<double>& values, Visit visit) {
  for (std::size_t first = 0; first < values.size();) {
    std::size_t last = first;
    while (last + 1 < values.size() && values[last + 1] == values[first]) ++last;
    visit(first, last + 1 - first);
    first = last + 1;
  }
}

// The largest or smallest value of the channel, taken by several samples running, again and again, while next to none
// come near it, or while the channel has noise everywhere else (io/saturation.hpp): the channel ends there. `share` is
// that of the samples at it.
struct FlatEnd {
  double value = 0.0;
  double share = 0.0;
  bool in_noise = false;  // told by the noise elsewhere
};
std::optional<FlatEnd> flat_end_of(const std::vector<double>& values);

// The longest stretch of samples that are exactly zero, where it is long and the channel is not zero throughout: a
// logger that pads, or a channel that was off.
struct Silence {
  std::size_t first = 0;  // index of a sample
  std::size_t count = 0;
};
std::optional<Silence> silence_of(const std::vector<double>& values);

// A shorter one at the start or the end while the rod moves, which the force enters or leaves by a jump and which has
// no like elsewhere: a channel that was switched on late, or off early. A play is entered and left without a jump.
std::optional<Silence> silence_at_an_end_of(const std::vector<double>& force, const std::vector<double>& displacement);

// The largest or smallest value of the channel where samples running hold exactly that one, and it lies as far beyond
// all others as they span, and many times further than any of their steps: -9999 for a sample that is missing.
struct Placeholder {
  double value = 0.0;
  std::size_t first = 0;  // index of a sample
  std::size_t count = 0;  // of samples, in all
  double low = 0.0;       // of the others
  double high = 0.0;
};
std::optional<Placeholder> placeholder_of(const std::vector<double>& values);

// Likewise of a channel that is set to a level, or to several, as a drive, a temperature and a pressure are: one more
// level is no placeholder unless it is a number of nines, below zero from -99 on or from 9999 on, further from all
// others than they span and than the largest of them is from zero. In the unit of the file, in any number of samples up
// to half.
std::optional<Placeholder> placeholder_of_setting(const std::vector<double>& values);

// The longest stretch in which the channel holds one value while `other` rises and falls by a quarter of its span and
// more, as it does not where the damper rests or yields: a channel that froze. Nothing where the channel has so few
// values that it holds others as long.
struct Stretch {
  std::size_t first = 0;
  std::size_t count = 0;
};
std::optional<Stretch> frozen_stretch_of(const std::vector<double>& values, const std::vector<double>& other);

// Whether the force turns round while the displacement stays at an end of its range, as under a motion that goes on
// beyond it. Where the motion rests there the force relaxes, or stays.
bool force_turns_at(double end, const std::vector<double>& displacement, const std::vector<double>& force);

}  // namespace hysteron

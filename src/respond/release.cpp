#include "respond/release.hpp"

#include <algorithm>
#include <cmath>

#include "core/extent.hpp"
#include "core/mean.hpp"
#include "fit/usable.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// As of held rods (io/stillness.hpp), in standard deviations of the noise; and of the whole span, for what a hand or a
// rope lets it move while it is held.
constexpr double surely_moved = 20.0;
constexpr double surely_moved_share = 0.01;
// Of that way, within which the mass still stands: three standard deviations.
constexpr double still_share = 0.15;
// A mass that passes a crest is about as long near it before as behind it. One that stood for longer than twice the
// time that it takes to leave was held.
constexpr double times_longer = 2.0;
constexpr std::size_t fewest_held = 4;  // samples

template <class T>
void drop_first(std::vector<T>& values, std::size_t count) {
  if (!values.empty()) values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

std::optional<std::size_t> release_of(std::span<const double> time, std::span<const double> displacement) {
  const double span = span_of(displacement);
  const double moved = std::max(surely_moved * channel_noise(time, displacement), surely_moved_share * span);
  if (!(span > moved)) return std::nullopt;
  const auto leaves = [&](double from) {
    const auto found =
        std::ranges::find_if(displacement, [&](double value) { return std::fabs(value - from) > moved; });
    return static_cast<std::size_t>(found - displacement.begin());
  };
  const std::size_t about = leaves(displacement[0]);
  if (about < fewest_held || about == displacement.size()) return std::nullopt;
  // Of one that was held the first half of that is within the hold.
  const double held_at = mean_of(displacement.first(about / 2));
  const std::size_t gone = leaves(held_at);
  std::size_t release = std::min(gone, displacement.size() - 1);
  while (release > 0 && std::fabs(displacement[release] - held_at) > still_share * moved) --release;
  if (release < fewest_held || displacement.size() - release < fewest_samples) return std::nullopt;
  const double held_for = time[release] - time[0];
  const double leaves_for = time[gone] - time[release];
  // Neither does it creep.
  const double first_half = mean_of(displacement.first(release / 2));
  const double second_half = mean_of(displacement.subspan(release / 2, release - release / 2));
  const bool stands = std::fabs(second_half - first_half) < still_share * moved;
  return stands && held_for > times_longer * leaves_for ? std::optional(release) : std::nullopt;
}

void begin_at(Recording& recording, std::size_t first) {
  for (std::vector<double>* channel : channels_of(recording)) drop_first(*channel, first);
  if (!recording.velocity_measured) recording.velocity = derive_velocity(recording.time, recording.displacement);
  recording.derived_acceleration =
      derive_acceleration(recording.time, recording.displacement, recording.velocity, recording.velocity_measured);
}

}  // namespace hysteron

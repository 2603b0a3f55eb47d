#include "io/rectified.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/extent.hpp"
#include "core/robust.hpp"
#include "io/strokes.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// There are so many kinks, two periods' at least; between them the channel rises over this part of its largest value.
constexpr std::size_t fewest_kinks = 4;
constexpr double low = 0.1;
// Samples that tell the slope on either side of a kink: an eighth of a stroke, in which a sine bends by a part of its
// slope only.
constexpr double part_of_stroke = 0.125;
constexpr std::size_t fewest_beside = 3;
// On both sides of a kink the slopes are alike by this factor, and the outer half of what is looked at rises by this
// part of it at most: by half of straight lines, by three quarters of a rounded bottom.
constexpr double alike = 0.5;
constexpr double outer = 0.65;
// At a kink the channel comes this near to zero, of the step beside it: half of that where the kink is between samples.
constexpr double near = 0.6;
// So many of the bottoms are kinks; where a motion dies away some are lost in noise.
constexpr double most = 0.8;
// What goes through a kink keeps this part of itself.
constexpr double goes_on = 0.5;

// The lowest sample of every stretch below a tenth of the largest value that has higher ones on both sides.
std::vector<std::size_t> bottoms_of(const std::vector<double>& values) {
  const double enough = low * peak_of(values);
  std::vector<std::size_t> bottoms;
  bool was_high = false;
  bool inside = false;
  std::size_t lowest = 0;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (values[n] >= enough) {
      if (inside) bottoms.push_back(lowest);
      inside = false;
      was_high = true;
    } else if (was_high) {
      if (!inside || values[n] < values[lowest]) lowest = n;
      inside = true;
    }
  }
  return bottoms;
}

// Bottoms that are kinks at zero; empty where not most of them are.
std::vector<std::size_t> kinks_of(const std::vector<double>& time, const std::vector<double>& values) {
  if (values.empty() || std::ranges::min(values) < 0.0 || !(peak_of(values) > 0.0)) return {};
  const std::vector<std::size_t> bottoms = bottoms_of(values);
  if (bottoms.size() < fewest_kinks) return {};
  const std::size_t beside =
      std::max(fewest_beside, static_cast<std::size_t>(part_of_stroke * static_cast<double>(samples_a_stroke(values))));
  const double noise = channel_noise(time, values);
  std::vector<std::size_t> kinks;
  std::size_t seen = 0;
  for (const std::size_t n : bottoms) {
    if (n < beside || n + beside >= values.size()) continue;
    ++seen;
    const double down = values[n - beside] - values[n];
    const double up = values[n + beside] - values[n];
    const bool straight = values[n - beside] - values[n - beside / 2] < outer * down &&
                          values[n + beside] - values[n + beside / 2] < outer * up;
    const bool both = std::min(down, up) > alike * std::max(down, up) && std::min(down, up) > 4.0 * noise;
    const double step = std::max(values[n - 1], values[n + 1]) - values[n];
    if (straight && both && values[n] <= near * step + 4.0 * noise) kinks.push_back(n);
  }
  const bool all =
      kinks.size() >= fewest_kinks && static_cast<double>(kinks.size()) >= most * static_cast<double>(seen);
  return all ? kinks : std::vector<std::size_t>{};
}

}  // namespace

bool force_is_rectified(const Recording& recording) {
  return recording.force.size() == recording.size() && !kinks_of(recording.time, recording.force).empty();
}

bool displacement_is_rectified(const Recording& recording) {
  if (recording.displacement.size() != recording.size() || recording.force.size() != recording.size()) return false;
  const std::vector<std::size_t> kinks = kinks_of(recording.time, recording.displacement);
  if (kinks.empty()) return false;
  const std::size_t beside = std::max(fewest_beside, samples_a_stroke(recording.displacement) / 8);
  std::size_t through = 0;
  for (const std::size_t n : kinks) {
    if (n < beside || n + beside >= recording.size()) continue;
    const double before = recording.force[n - beside];
    const double behind = recording.force[n + beside];
    through += before * behind > goes_on * std::max(before * before, behind * behind) ? 1 : 0;
  }
  return 2 * through > kinks.size();
}

}  // namespace hysteron

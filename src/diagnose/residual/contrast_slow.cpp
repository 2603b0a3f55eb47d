// What changes in the course of a recording: fade with the work done, an excess in the first travel, drift. Everything
// is compared within recordings, so that none has to have the size of another.
#include <algorithm>
#include <cmath>

#include "diagnose/residual/contrast_panel.hpp"

namespace hysteron::contrast {
namespace {

constexpr double cycles_of_travel = 4.0;  // half strokes that a cycle has: over it the excess of the first travel fades
constexpr std::size_t fewest_half_cycles = 4;  // that tell a slow change from the first travel

}  // namespace

void add_slow_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  std::size_t half_cycles = 0;
  for (const Track& track : tracks) {
    half_cycles = std::max(half_cycles, track.half_cycles.size());
  }
  if (half_cycles < fewest_half_cycles) {
    return;
  }
  Panel panel(tracks, &Track::missing, placebos);
  const Panel::Column one = panel.add([](const Track&, std::size_t) { return 1.0; });
  const Panel::Column f = panel.add([](const Track& t, std::size_t n) { return t.simulated[n]; });
  const Panel::Column x = panel.add([](const Track& t, std::size_t n) { return t.x[n]; });
  const std::vector<Panel::Column> of_each = {one, f, x};
  const Panel::Column fade =
      panel.add_within([](const Track& t, std::size_t n) { return -t.simulated[n] * t.work[n]; }, of_each);
  const Panel::Column first = panel.add_within(
      [](const Track& t, std::size_t n) {
        return t.simulated[n] * std::exp(-t.travelled[n] / (cycles_of_travel * t.stroke));
      },
      of_each);
  const Panel::Column drift =
      panel.add_within([](const Track& t, std::size_t n) { return t.time[n] - t.time.front(); }, of_each);
  const auto contrast = [&](ContrastKind kind, Panel::Column signature, const std::vector<Panel::Column>& without) {
    if (std::optional<Contrast> found = panel.partial(kind, std::vector{signature}, without)) {
      result.push_back(std::move(*found));
    }
  };
  contrast(ContrastKind::energy_fade, fade, {first, drift});
  contrast(ContrastKind::first_travel, first, {fade, drift});
  contrast(ContrastKind::drift, drift, {fade, first});
}

}  // namespace hysteron::contrast

// What a recording says of its own channels, whatever the model: the recorded velocity behind the slope of the recorded
// displacement. A filter or a delay of the channel leaves -lag a.
#include "diagnose/residual/contrast_panel.hpp"

namespace hysteron::contrast {

void add_channel_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  Panel panel(tracks, &Track::slip, placebos);
  if (panel.empty()) {
    return;
  }
  const Panel::Column v = panel.add([](const Track& t, std::size_t n) { return t.v[n]; });
  const Panel::Column later = panel.add([](const Track& t, std::size_t n) { return -t.a[n]; });
  if (std::optional<Contrast> found = panel.partial(ContrastKind::velocity_delay, std::vector{later}, std::vector{v})) {
    result.push_back(std::move(*found));
  }
}

}  // namespace hysteron::contrast

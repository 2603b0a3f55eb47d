#include "task/track.hpp"

#include <algorithm>

#include "task/coordinate_name.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr std::size_t most_instants = 400;

}  // namespace

json track_json(const RunResult& run, const Layout& layout, const std::vector<const Recording*>& recordings) {
  if (run.track.empty()) {
    return nullptr;
  }
  std::vector<double> begins{0.0};
  json files = json::array();
  for (const Recording* recording : recordings) {
    files.push_back({{"file", recording->file}, {"begins", begins.back()}});
    begins.push_back(begins.back() + recording->time.back() - recording->time.front());
  }
  json result = {{"time", json::array()}, {"recordings", files}, {"parameters", json::array()}};
  for (std::size_t c = 0; c < layout.dimension(); ++c) {
    result["parameters"].push_back({{"name", coordinate_name(layout, c, recordings.front()->drive_kind)},
                                    {"unit", layout.cards()[layout.coordinates()[c].parameter].unit},
                                    {"mean", json::array()},
                                    {"lower", json::array()},
                                    {"upper", json::array()}});
  }
  const std::size_t stride = (run.track.size() + most_instants - 1) / most_instants;
  // Backwards from the end, which is the result.
  std::vector<const Tracked*> shown;
  for (std::size_t k = run.track.size(); k > 0; k -= std::min(k, stride)) {
    shown.push_back(&run.track[k - 1]);
  }
  std::ranges::reverse(shown);
  for (const Tracked* tracked : shown) {
    const Recording& recording = *recordings[tracked->recording];
    result["time"].push_back(begins[tracked->recording] + recording.time[tracked->sample - 1] - recording.time.front());
    for (std::size_t c = 0; c < layout.dimension(); ++c) {
      const double mean = tracked->mean[c];
      const double band = 2.0 * tracked->deviation[c];
      json& row = result["parameters"][c];
      row["mean"].push_back(layout.physical(c, mean));
      row["lower"].push_back(layout.physical(c, mean - band));
      row["upper"].push_back(layout.physical(c, mean + band));
    }
  }
  return result;
}

}  // namespace hysteron

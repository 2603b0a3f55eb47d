#include "presets/preset.hpp"

#include <cmath>

namespace hysteron {

const Preset* find_preset(std::string_view id) {
  for (const Preset* preset : preset_catalogue()) {
    if (preset->id == id) {
      return preset;
    }
  }
  return nullptr;
}

std::vector<double> lagged(const std::vector<double>& time, const std::vector<double>& drive, double lag) {
  std::vector<double> result = drive;
  if (lag <= 0.0) {
    return result;
  }
  for (std::size_t n = 0; n + 1 < drive.size(); ++n) {
    const double h = time[n + 1] - time[n];
    const double slope = (drive[n + 1] - drive[n]) / h;
    // u = d(t) - slope lag + (u_n - d_n + slope lag) exp(-t / lag)
    result[n + 1] = drive[n + 1] - slope * lag + (result[n] - drive[n] + slope * lag) * std::exp(-h / lag);
  }
  return result;
}

}  // namespace hysteron

#include "app/page.hpp"

#include <fmt/format.h>

namespace hysteron::app {

using nlohmann::json;

namespace {

// At most this many points of a recording go into the page: enough for a screen, small enough for a phone.
constexpr std::size_t page_points = 1500;

}  // namespace

json recording_json(const Recording& recording, const Prediction& prediction, const std::string& role,
                    const std::vector<double>& baseline) {
  json row;
  row["file"] = recording.file;
  row["role"] = role;
  row["drive"] = recording.drive.empty() ? std::string("-")
                                         : fmt::format("{:.3g} {}", recording.drive[recording.size() / 2],
                                                       recording.drive_kind == DriveKind::voltage ? "V" : "A");
  row["nrmse"] = prediction.score.nrmse;
  row["rmse_n"] = prediction.score.rmse;
  row["fit_percent"] = prediction.score.fit_percent;
  const std::size_t stride = (recording.size() + page_points - 1) / page_points;
  for (const char* key : {"time", "displacement_mm", "velocity_mm_s", "force_n", "predicted_n"}) {
    row[key] = json::array();
  }
  for (std::size_t n = 0; n < recording.size(); n += stride) {
    row["time"].push_back(recording.time[n]);
    row["displacement_mm"].push_back(1e3 * recording.displacement[n]);
    row["velocity_mm_s"].push_back(1e3 * recording.velocity[n]);
    row["force_n"].push_back(recording.force[n]);
    row["predicted_n"].push_back(prediction.force[n]);
    if (!baseline.empty()) {
      row["baseline_n"].push_back(baseline[n]);
    }
  }
  return row;
}

json estimate_json(const Estimate& estimate, const Layout& layout) {
  const Parameter& card = layout.cards()[estimate.term.parameter];
  const bool constant = estimate.term.drive_power + estimate.term.frequency_power == 0;
  json row = {{"name", estimate.name},
              {"symbol", card.symbol},
              {"unit", estimate.unit},
              {"meaning", estimate.meaning},
              {"value", estimate.term.value},
              {"std_error", nullptr},
              {"ci95", nullptr},
              {"at_bound", estimate.at_bound ? json(*estimate.at_bound) : json(nullptr)},
              {"identifiable", estimate.identifiable}};
  row["lower"] = constant ? json(estimate.lower) : json(nullptr);
  row["upper"] = constant ? json(estimate.upper) : json(nullptr);
  if (estimate.std_error) {
    row["std_error"] = *estimate.std_error;
    row["ci95"] = {estimate.term.value - *estimate.half_width, estimate.term.value + *estimate.half_width};
  }
  return row;
}

}  // namespace hysteron::app

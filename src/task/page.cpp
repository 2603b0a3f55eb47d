#include "task/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/frequency.hpp"
#include "fit/layout.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

// At most this many points of a recording go into the page, enough for a screen and small enough for a phone; and this
// many of all recordings, so that a page of thousands loads at once; but this many of each.
constexpr std::size_t most_points = 1500;
constexpr std::size_t points_of_all = 600'000;
constexpr std::size_t fewest_points = 60;
// Fewer points of a period than the first are no curve; a part of the recording is shown then, with the second.
constexpr double fewest_of_period = 12.0;
constexpr double points_of_period = 40.0;

// The samples that the page shows.
struct Shown {
  std::size_t first;
  std::size_t last;
  std::size_t stride;
};

Shown shown_of(const Recording& recording, std::size_t recordings) {
  const std::size_t points =
      std::clamp(points_of_all / std::max<std::size_t>(recordings, 1), fewest_points, most_points);
  const std::size_t size = recording.size();
  const Shown whole{0, size, (size + points - 1) / points};
  const double frequency = dominant_frequency(recording);
  if (!(frequency > 0.0) || whole.stride < 2) {
    return whole;
  }
  const double duration = recording.time.back() - recording.time.front();
  const double of_period = static_cast<double>(size) / (duration * frequency);
  if (of_period / static_cast<double>(whole.stride) >= fewest_of_period) {
    return whole;
  }
  const auto stride = static_cast<std::size_t>(std::max(1.0, of_period / points_of_period));
  const std::size_t length = std::min(size, stride * points);
  const std::size_t first = (size - length) / 2;
  return {first, first + length, stride};
}

}  // namespace

json recording_json(const Recording& recording, const Prediction& prediction, const std::string& role,
                    std::size_t recordings, const std::vector<double>& baseline) {
  json row;
  row["file"] = recording.file;
  row["role"] = role;
  row["drive"] = recording.drive.empty() ? std::string()
                                         : fmt::format("{:.3g} {}", recording.drive[recording.size() / 2],
                                                       recording.drive_kind == DriveKind::voltage ? "V" : "A");
  row["nrmse"] = prediction.score.nrmse;
  row["rmse_n"] = prediction.score.rmse;
  row["fit_percent"] = prediction.score.fit_percent;
  const Shown shown = shown_of(recording, recordings);
  if (shown.last - shown.first < recording.size()) {
    row["part"] = {{"from", recording.time[shown.first]},
                   {"to", recording.time[shown.last - 1]},
                   {"duration", recording.time.back() - recording.time.front()}};
  }
  for (const char* key : {"time", "displacement_mm", "velocity_mm_s", "force_n", "predicted_n"}) {
    row[key] = json::array();
  }
  for (std::size_t n = shown.first; n < shown.last; n += shown.stride) {
    row["time"].push_back(recording.time[n]);
    row["displacement_mm"].push_back(1e3 * recording.displacement[n]);
    row["velocity_mm_s"].push_back(1e3 * recording.velocity[n]);
    row["force_n"].push_back(recording.force[n]);
    row["predicted_n"].push_back(prediction.force[n]);
    if (!prediction.motion.empty()) {
      row["simulated_mm"].push_back(1e3 * prediction.motion[n]);
    }
    if (!baseline.empty()) {
      row["baseline_n"].push_back(baseline[n]);
    }
  }
  return row;
}

json model_card_json(const CompositeModel& model) {
  std::vector<std::string> equations(model.law->equations.begin(), model.law->equations.end());
  for (const Part* effect : model.effects) {
    equations.insert(equations.end(), effect->equations.begin(), effect->equations.end());
  }
  return {{"id", model.law->id},
          {"title", model.law->title},
          {"equations", equations},
          {"reference", model.law->reference}};
}

json data_json(const Campaign& campaign) {
  json data = json::array();
  for (const Recording& recording : campaign.recordings) {
    data.push_back({{"file", recording.file}, {"sha256", recording.sha256}});
  }
  return data;
}

json estimate_json(const Estimate& estimate, const Layout& layout) {
  const Parameter& card = layout.cards()[estimate.term.parameter];
  const bool constant = estimate.term.constant();
  json row = {{"name", estimate.name},
              {"symbol", card.symbol},
              {"unit", estimate.unit},
              {"unit_text", estimate.unit_text},
              {"meaning", estimate.meaning},
              {"value", estimate.term.value},
              {"std_error", nullptr},
              {"ci95", nullptr},
              {"at_bound", estimate.at_bound ? json(word_of(*estimate.at_bound)) : json(nullptr)},
              {"identifiable", estimate.identifiable}};
  row["lower"] = constant ? json(estimate.lower) : json(nullptr);
  row["upper"] = constant ? json(estimate.upper) : json(nullptr);
  if (estimate.std_error) {
    row["std_error"] = *estimate.std_error;
  }
  if (estimate.ci95) {
    row["ci95"] = {estimate.ci95->lower, estimate.ci95->upper};
  }
  return row;
}

}  // namespace hysteron

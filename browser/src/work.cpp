// What the page calls: text in, text out, all of it JSON. Recordings are files of /recordings, results files of
// /results, both in the memory of the page.
#include <emscripten.h>
#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "io/file.hpp"
#include "io/format.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "report/terminal.hpp"
#include "request.hpp"
#include "simulate/part.hpp"
#include "task/diagnosis.hpp"
#include "task/diagnosis_text.hpp"
#include "task/json_text.hpp"
#include "task/load.hpp"

// Tells the page how far the work is; clang-format would take the script apart.
// clang-format off
EM_JS(void, tell_page, (const char* stage, double share, const char* detail), {
  Module.onProgress(UTF8ToString(stage), share, UTF8ToString(detail));
});
// clang-format on

namespace hysteron::browser {
namespace {

using nlohmann::json;

constexpr const char* recordings_folder = "/recordings";
const std::filesystem::path results_folder = "/results";

// What only the program reads needs its own words: to the readers here such files are of no format.
void refuse_formats_left_out() {
  for (const auto& entry : std::filesystem::directory_iterator(recordings_folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".mat" || ending == ".mf4" || ending == ".xlsx") {
      throw InputError(entry.path().filename().string() + ": files that end with " + ending +
                       " are read by the program and not by this page, expected " + list_of_endings());
    }
  }
}

Loaded loaded(const json& asked) {
  refuse_formats_left_out();
  ReadOptions options;
  options.columns = asked.value("columns", std::map<std::string, std::string>{});
  options.conditions = conditions_of(asked);
  return load_with_remarks({recordings_folder}, options, Required::motion_and_force);
}

std::vector<std::string> remarks_of(const Loaded& data) {
  std::vector<std::string> result;
  for (const Remark& remark : once_each(data.remarks)) {
    if (remark.kind != Remark::Kind::dialect) result.push_back(warning_of(remark));
  }
  return result;
}

void write_result(const char* name, const std::string& text) { write_file_atomically(results_folder / name, text); }

json fitted(const json& asked) {
  Loaded data = loaded(asked);
  FitRequest request = fit_request(asked);
  const std::vector<std::string> remarks = remarks_of(data);
  const FitData prepared = fit_data(std::move(data.campaign), request);
  FitResult fit =
      fit_campaign(prepared, request, remarks, command_of(asked),
                   [](const std::string& stage, const std::string& /*of*/, const RunResult& run) {
                     const std::string detail = fmt::format(
                         "{} of {} evaluations{}", run.evaluations, run.budget,
                         run.cost < diverged_cost ? ", best NRMSE " + format_number(run.cost, 4) : std::string{});
                     tell_page(stage.c_str(), static_cast<double>(run.evaluations) / static_cast<double>(run.budget),
                               detail.c_str());
                     return true;
                   });
  if (!fit.diverged.empty()) throw WorkError(fit.diverged);
  write_result("model.json", json_text(fit.model_file));
  write_result("fit.json", json_text(fit.fit_file));
  write_result("report.html", fit_report_html(std::move(fit.page)));
  return {{"files", {"report.html", "model.json", "fit.json"}}, {"warnings", fit.warnings}};
}

json diagnosed(const json& asked) {
  const Loaded data = loaded(asked);
  DiagnoseOptions options = diagnose_options(asked);
  check_diagnosis(data.campaign, options);
  const std::unique_ptr<Diagnosis> diagnosis = diagnose(
      data.campaign, options, [](double share, const std::string& stage) { tell_page(stage.c_str(), share, ""); });
  DiagnosisRecords records = records_of(*diagnosis, data.campaign, options, remarks_of(data), command_of(asked));
  write_result("diagnosis.json", json_text(records.diagnosis_file));
  write_result("model.json", json_text(records.model_file));
  write_result("report.html", fit_report_html(std::move(records.page)));
  return {{"files", {"report.html", "model.json", "diagnosis.json"}},
          {"text", diagnosis_text(records.diagnosis_file, "diagnosis.json")}};
}

// What a user has to know of the recordings before choosing.
json looked_at(const json& asked) {
  const Loaded data = loaded(asked);
  json rows = json::array();
  for (const Recording& recording : data.campaign.recordings) {
    double peak = 0.0;
    for (const double force : recording.force) peak = std::max(peak, std::abs(force));
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    rows.push_back({{"file", recording.file},
                    {"samples", recording.size()},
                    {"seconds", format_number(recording.time.back() - recording.time.front(), 3)},
                    {"stroke_mm", format_number(1e3 * (high - low), 3)},
                    {"peak_n", format_number(peak, 3)}});
  }
  const DriveKind drive = data.campaign.recordings.front().drive_kind;
  return {{"recordings", rows},
          {"drive", drive == DriveKind::current   ? "current"
                    : drive == DriveKind::voltage ? "voltage"
                                                  : ""},
          {"drive_varies", std::ranges::any_of(data.campaign.recordings, drive_varies)},
          {"model", data.campaign.model},
          {"warnings", remarks_of(data)}};
}

json catalogue() {
  json models = json::array();
  for (const Part* part : model_catalogue()) {
    json parameters = json::array();
    for (const Parameter& card : part->parameters) {
      if (!card.fixed) parameters.push_back({{"name", card.name}, {"meaning", card.meaning}});
    }
    models.push_back({{"id", part->id}, {"title", part->title}, {"parameters", parameters}});
  }
  json effects = json::array();
  for (const Part* part : effect_catalogue()) effects.push_back({{"id", part->id}, {"title", part->title}});
  return {{"version", HYSTERON_VERSION}, {"models", models}, {"effects", effects}, {"endings", list_of_endings()}};
}

json answered(const std::string& request) {
  const json asked = json::parse(request);
  const std::string work = asked.at("work");
  if (work == "catalogue") return catalogue();
  if (work == "look") return looked_at(asked);
  if (work == "fit") return fitted(asked);
  return diagnosed(asked);
}

}  // namespace
}  // namespace hysteron::browser

// The answer stays where it is until the next call.
extern "C" EMSCRIPTEN_KEEPALIVE const char* hysteron_do(const char* request);
const char* hysteron_do(const char* request) {
  static std::string answer;
  nlohmann::json result;
  try {
    result = hysteron::browser::answered(request);
  } catch (const std::exception& error) {
    result = {{"error", error.what()}};
  }
  answer = result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return answer.c_str();
}

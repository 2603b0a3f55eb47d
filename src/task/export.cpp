#include "task/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "core/error.hpp"
#include "core/message.hpp"
#include "export/names.hpp"
#include "export/targets.hpp"
#include "io/output.hpp"
#include "report/terminal.hpp"
#include "task/guesses.hpp"
#include "task/impossible_laws.hpp"
#include "task/remarks.hpp"
#include "task/result_file.hpp"

namespace hysteron {
namespace {

// As `name` says, else as the file that is written, else as the law.
std::string name_of(const ExportRequest& request, const StoredModel& stored, const std::string& file) {
  if (!request.name.empty()) {
    refuse_name(Option::name, request.name);
    return request.name;
  }
  const std::string name = identifier(file.empty() ? stored.model.law->id : file);
  refuse_name(Option::out, name);
  return name;
}

// By how much the exported code is expected to differ from simulate, and why; empty where it is not.
std::string about_force(const TestVector& vector) {
  constexpr double rounding = 1e-6;
  std::vector<std::string> sentences;
  if (vector.off_simulate > rounding || vector.steps_limited) {
    sentences.push_back(fmt::format(
        "{} the force differs from that of `simulate` by up to {:.2g} % of the largest force, on the motion of the "
        "test vector.",
        vector.steps_limited ? "In these steps" : "Marched from one sample to the next", 100.0 * vector.off_simulate));
    if (vector.corners > 0) {
      sentences.push_back(
          fmt::format("That motion has {}, where straight lines of it meet: `simulate` is told of them by later "
                      "samples, which exported code does not have.",
                      vector.corners == 1 ? "a corner" : fmt::format("{} corners", vector.corners)));
    }
  }
  if (vector.off_rounding > rounding) {
    sentences.push_back(fmt::format(
        "The model jumps on the motion of the test vector, as friction that sticks and slips does, at instants that "
        "rounding decides: that moves the force by up to {:.2g} % of the largest, and a replay may differ by twice as "
        "much.",
        100.0 * vector.off_rounding));
  }
  return sentences.empty() ? "" : wrapped(fmt::format("{}", fmt::join(sentences, " ")));
}

// Where the drive has to be known ahead; else empty.
std::string about_drive(const ExportedModel& exported) {
  const double ahead = exported.drive_ahead();
  return ahead > 0.0
             ? wrapped(fmt::format("The force leads the drive: give with every sample the drive of {} s after it, as "
                                   "the test vector does.",
                                   ahead))
             : "";
}

// A file of another kind is no folder that somebody wants.
void refuse_other_file(const std::filesystem::path& out, const ExportTarget& target) {
  static constexpr std::string_view endings[] = {".c", ".h",  ".fmu", ".zip",  ".slx",
                                                 ".m", ".mo", ".py",  ".json", ".csv"};
  const std::string ending = out.extension().string();
  if (ending.empty() || ending == target.extension || std::ranges::find(endings, ending) == std::end(endings) ||
      std::filesystem::is_directory(out)) {
    return;
  }
  throw OptionError(Option::out + " " + out.string() + ": " + std::string(target.id) + " is not written as " + ending +
                    ", expected a folder" +
                    (target.extension.empty() ? "" : " or a file that ends in " + std::string(target.extension)));
}

void refuse_more_than_most(const ExportRequest& request) {
  if (request.substeps <= request.most_substeps) return;
  throw OptionError(Option::substeps + fmt::format(" {}: more than ", request.substeps) + Option::most_substeps +
                    fmt::format(" {} allows, expected no more, or one of the two alone", request.most_substeps));
}

// "pressure = 2e5 Pa, valve = 30 %": what the conditions that laws follow are held at.
std::string held_at(const StoredModel& stored, const std::map<std::string, ConditionNumber>& at) {
  std::string text;
  for (const ConditionRange& condition : stored.conditions) {
    const auto found = at.find(condition.name);
    if (found == at.end()) continue;  // refused by hold_conditions
    text += fmt::format("{}{} = {}{}{}", text.empty() ? "" : ", ", condition.name, found->second.value,
                        condition.unit.empty() ? "" : " ", condition.unit);
  }
  return text;
}

}  // namespace

ModelExport export_model(StoredModel stored, const std::string& path, const std::map<std::string, ConditionNumber>& at,
                         const std::optional<Recording>& motion, const ExportRequest& request,
                         std::vector<std::string>& remarks) {
  const ExportTarget& target = export_target(request.to);
  refuse_more_than_most(request);
  const std::string conditions = held_at(stored, at);
  const std::vector<std::string> guessed = held_beyond_fitted(stored, path, at);
  hold_conditions(stored, at, "export");
  if (motion) {
    check_drive(stored, path, *motion);
    append(remarks, guesses_of(stored, path, {*motion}));
    append(remarks, beyond_fitted(stored, path, {*motion}));
  } else {
    append(remarks, units_assumed(stored, path));
    append(remarks, impossible_laws(stored, path));
  }
  append(remarks, guessed);
  ExportedModel exported{stored.model, stored.held, stored.terms, request.name};
  exported.tolerance = request.tolerance;
  exported.most_substeps = request.most_substeps;
  exported.substeps = request.substeps;
  exported.holds_at = conditions;
  exported.drive = stored.drive == DriveKind::none ? stored.fitted_over.drive_kind : stored.drive;
  const bool placed = !request.out.empty() && request.out != "-";
  const std::filesystem::path out(placed ? request.out : "");
  refuse_other_file(out, target);
  const bool one_file = !target.extension.empty() && out.extension() == target.extension;
  exported.name = name_of(request, stored, one_file ? out.stem().string() : "");
  const TestVector vector = test_vector(exported, motion ? *motion : motion_for_testing());
  Export written = target.write(exported, vector);
  ModelExport result;
  result.folder = (one_file ? out.parent_path() : out).string();
  result.note = written.note + "\n" + about_drive(exported) + about_force(vector);
  if (one_file && written.files.size() == 1) {
    result.files[out.filename().string()] = std::move(written.files.begin()->second);
  } else {
    result.files = std::move(written.files);
  }
  // An FMU is an archive, which does not say in words who wrote it, and replaced as one.
  if (placed && target.extension != ".fmu" && (!one_file || result.files.size() > 1)) {
    refuse_foreign(result.folder, result.files);
  }
  return result;
}

std::vector<std::string> write_export(const ModelExport& model) {
  if (!model.folder.empty()) {
    make_output_folder(model.folder);
  }
  std::vector<std::string> paths;
  for (const auto& [file, text] : model.files) {
    const std::filesystem::path path = std::filesystem::path(model.folder) / file;
    if (path.has_parent_path()) {
      make_output_folder(path.parent_path());
    }
    write_file_atomically(path, text);
    paths.push_back(path.string());
  }
  return paths;
}

}  // namespace hysteron

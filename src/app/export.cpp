// hysteron export: an identified model for use elsewhere, with a test vector.
#include "task/export.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string model;
  std::string motion;
  DataOptions data;
  ExportRequest request;
};

std::optional<Recording> motion_of(const Options& options) {
  if (options.motion.empty()) {
    return std::nullopt;
  }
  DataOptions data = options.data;
  data.data = {options.motion};
  data.at.clear();  // of the model
  data.taken = recordings_alone;
  const Campaign campaign = load(data, Required::motion);
  if (campaign.recordings.size() != 1) {
    throw InputError(options.motion + ": holds " + std::to_string(campaign.recordings.size()) +
                     " recordings, expected one");
  }
  return campaign.recordings[0];
}

void run(const Options& options) {
  const std::string& out = options.request.out;
  refuse_inputs(out, {options.model, options.motion});
  StoredModel stored = read_model(options.model);
  const std::optional<Recording> motion = motion_of(options);
  std::vector<std::string> remarks;
  ModelExport result;
  try {
    result = export_model(std::move(stored), options.model, numbers_at(options.data), motion, options.request, remarks);
  } catch (...) {
    warn_of(remarks);  // a force that runs away may do so for what they say
    throw;
  }
  warn_of(remarks);
  if (!is_standard_output(out)) {
    for (const std::string& path : write_export(result)) {
      fmt::print("{}\n", printable(path));
    }
    fmt::print("{}", result.note);
    return;
  }
  if (result.files.size() > 1) {
    std::string names;
    for (const auto& [file, text] : result.files) {
      names += (names.empty() ? "" : ", ") + file;
    }
    refuse_standard_output(out, names);
  }
  write_result(out, result.files.begin()->second);
  say_beside(out, result.note);
}

}  // namespace

void add_export(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("export", "an identified model for use elsewhere, with a test vector");
  command->add_option("MODEL", options->model, "model.json written by fit or diagnose")->required();
  command->add_option("--to", options->request.to, "c, fmu, simulink, modelica or python")
      ->required()
      ->check(one_of({"c", "fmu", "simulink", "modelica", "python"}));
  command
      ->add_option("--out", options->request.out,
                   "folder, or the file (.c, .fmu, .py) with its companions beside it; -: standard output for one file")
      ->required();
  command->add_option("--name", options->request.name,
                      "identifier in the code, in any of the languages; default that of the file or the law");
  command->add_option(
      "--motion", options->motion,
      "recording whose motion the test vector replays; default a motion of 10 mm and a drive about 0.5");
  add_reading_options(*command, options->data);
  add_at_option(*command, options->data);
  command->add_option("--tolerance", options->request.tolerance, "relative force error allowed to the integration")
      ->check(real_number(1e-10, 1e-2))
      ->capture_default_str();
  command
      ->add_option("--most-substeps", options->request.most_substeps,
                   "steps of the integration between two samples at most")
      ->transform(whole_number(1, default_most_substeps))
      ->capture_default_str();
  command
      ->add_option("--substeps", options->request.substeps,
                   "always so many steps between two samples, twice as many where the velocity changes sign; 0: as the "
                   "stiffness asks")
      ->transform(whole_number(0, default_most_substeps))
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  hysteron export out/model.json --to c --out damper/ --motion recordings/r1.csv\n"
      "  hysteron export out/model.json --to fmu --out damper.fmu");
  take_common_options(*command);
  command->callback([options, command] {
    if (options->motion.empty()) refuse_reading_options(*command, "--motion");
    run(*options);
  });
}

}  // namespace hysteron::app

// hysteron export: an identified model for use elsewhere, with a test vector.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "export/names.hpp"
#include "export/targets.hpp"
#include "io/output.hpp"
#include "report/terminal.hpp"
#include "task/model_file.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string model;
  std::string to;
  std::string out;
  std::string name;
  std::string motion;
  DataOptions data;
  double tolerance = 1e-4;
  int most_substeps = default_most_substeps;
  int substeps = 0;
};

Recording motion_of(const Options& options) {
  if (options.motion.empty()) {
    return motion_for_testing();
  }
  DataOptions data = options.data;
  data.data = {options.motion};
  data.at.clear();  // of the model
  const Campaign campaign = load(data, Required::motion);
  if (campaign.recordings.size() != 1) {
    throw InputError(options.motion + ": holds " + std::to_string(campaign.recordings.size()) +
                     " recordings, expected one");
  }
  return campaign.recordings[0];
}

// As --name says, else as the file that is written, else as the law.
std::string name_of(const Options& options, const StoredModel& stored, const std::string& file) {
  if (!options.name.empty()) {
    refuse_name("--name", options.name);
    return options.name;
  }
  const std::string name = identifier(file.empty() ? stored.model.law->id : file);
  refuse_name("--out", name);
  return name;
}

// What the steps asked for cost; empty where they are those of simulate.
std::string about_steps(const TestVector& vector) {
  if (!vector.off_simulate) {
    return "";
  }
  return wrapped(fmt::format(
      "In these steps the force differs from that of `simulate` by up to {:.2g} % of the largest force, on the "
      "motion of the test vector.",
      100.0 * *vector.off_simulate));
}

void run(const Options& options) {
  const ExportTarget& target = export_target(options.to);
  refuse_inputs(options.out, {options.model, options.motion});
  StoredModel stored = read_model(options.model);
  hold_conditions(stored, numbers_at(options.data), "export");
  ExportedModel exported{stored.model, stored.held, stored.terms, options.name};
  exported.tolerance = options.tolerance;
  exported.most_substeps = options.most_substeps;
  exported.substeps = options.substeps;
  const std::filesystem::path out(options.out);
  const bool one_file = !target.extension.empty() && out.extension() == target.extension;
  const std::filesystem::path folder = one_file ? out.parent_path() : out;
  exported.name = name_of(options, stored, one_file ? out.stem().string() : "");
  const TestVector vector = test_vector(exported, motion_of(options));
  const Export result = target.write(exported, vector);
  if (is_standard_output(options.out)) {
    if (result.files.size() > 1) {
      std::string names;
      for (const auto& [file, text] : result.files) {
        names += (names.empty() ? "" : ", ") + file;
      }
      refuse_standard_output(options.out, names);
    }
    write_result(options.out, result.files.begin()->second);
    say_beside(options.out, result.note + "\n" + about_steps(vector));
    return;
  }
  // An FMU is an archive, which does not say in words who wrote it, and replaced as one.
  if (target.extension != ".fmu" && (!one_file || result.files.size() > 1)) {
    refuse_foreign(folder, result.files);
  }
  if (!folder.empty()) {
    make_output_folder(folder);
  }
  for (const auto& [file, text] : result.files) {
    const std::filesystem::path path = one_file && result.files.size() == 1 ? out : folder / file;
    if (path.has_parent_path()) {
      make_output_folder(path.parent_path());
    }
    write_file_atomically(path, text);
    fmt::print("{}\n", path.string());
  }
  fmt::print("{}\n{}", result.note, about_steps(vector));
}

}  // namespace

void add_export(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("export", "an identified model for use elsewhere, with a test vector");
  command->add_option("MODEL", options->model, "model.json written by fit or diagnose")->required();
  command->add_option("--to", options->to, "c, fmu, simulink, modelica or python")->required();
  command
      ->add_option("--out", options->out,
                   "folder, or the file (.c, .fmu, .py) with its companions beside it; -: standard output for one file")
      ->required();
  command->add_option("--name", options->name,
                      "identifier in the code, in any of the languages; default that of the file or the law");
  command->add_option(
      "--motion", options->motion,
      "recording whose motion the test vector replays; default a motion of 10 mm and a drive about 0.5");
  add_reading_options(*command, options->data);
  add_at_option(*command, options->data);
  command->add_option("--tolerance", options->tolerance, "relative force error allowed to the integration")
      ->check(real_number(1e-10, 1e-2))
      ->capture_default_str();
  command->add_option("--most-substeps", options->most_substeps, "steps of the integration between two samples at most")
      ->transform(whole_number(1, default_most_substeps))
      ->capture_default_str();
  command
      ->add_option("--substeps", options->substeps,
                   "always so many steps between two samples, for a fixed time a sample; 0: as the stiffness asks")
      ->transform(whole_number(0, default_most_substeps))
      ->capture_default_str();
  command->footer(
      "Examples:\n"
      "  hysteron export out/model.json --to c --out damper/ --motion recordings/r1.csv\n"
      "  hysteron export out/model.json --to fmu --out damper.fmu");
  take_common_options(*command);
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

// hysteron compare: several models on the same recordings.
#include "task/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/output.hpp"
#include "report/html.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::vector<std::string> words;
  DataOptions data;
  std::string out;
  bool mat = false;
  CommonOptions common;
};

void run(const Options& options) {
  std::vector<std::string> files;
  DataOptions data = options.data;
  data.data.clear();
  for (const std::string& word : options.words) {
    (std::filesystem::path(word).extension() == ".json" ? files : data.data).push_back(word);
  }
  if (files.empty()) {
    const std::filesystem::path inside = std::filesystem::path(data.data.front()) / "model.json";
    throw InputError("compare: no model among what is given, expected files that end in .json, as " +
                     (std::filesystem::exists(inside) ? inside.string() : "out/model.json"));
  }
  if (options.mat && is_standard_output(options.out)) {
    throw InputError("--mat: with --out - no tables are written, expected a folder for them, or no --mat");
  }
  if (data.data.empty()) {
    throw InputError("compare: models alone are given, expected a recording or a folder of them besides");
  }
  const ObjectiveOptions objective = objective_options(options.common);
  std::vector<ComparedModel> models;
  for (const std::string& file : files) {
    models.push_back({file, read_model(file)});
  }
  std::vector<const StoredModel*> stored;
  for (const ComparedModel& model : models) {
    stored.push_back(&model.stored);
  }
  data.conditions = conditions_of(stored);
  data.follows_frequency = std::ranges::any_of(stored, &StoredModel::follows_frequency);
  data.taken = recordings_alone;
  refuse_unfollowed(stored, numbers_at(data));
  const Campaign campaign = load(data);
  if (!is_standard_output(options.out)) {
    check_output_folder(options.out);
    refuse_other_results(options.out, "compare.json");
    refuse_data_folder(options.out, data.data);
  }
  std::vector<std::string> remarks;
  ModelComparison comparison;
  try {
    comparison = compare_models(models, campaign.recordings, objective, command_line(), remarks);
  } catch (...) {
    warn_of(remarks);  // a simulation that runs away may do so for what they say
    throw;
  }
  warn_of(remarks);
  const std::filesystem::path out(options.out);
  if (is_standard_output(options.out)) {
    write_result(options.out, json_text(comparison.file));
  } else {
    make_output_folder(options.out);
    write_file_atomically(out / "compare.json", json_text(comparison.file));
    write_file_atomically(out / "report.html", compare_page_html(comparison.page));
    for (const auto& [name, text] : comparison_tables(comparison.file, options.mat)) {
      write_file_atomically(out / name, text);
    }
  }
  say_beside(options.out, comparison_text(comparison.file));
  if (!is_standard_output(options.out)) {
    fmt::print("report: {}\n", printable((out / "report.html").string()));
  }
}

}  // namespace

void add_compare(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("compare", "several models on the same recordings: errors, criteria, residuals, loops");
  command
      ->add_option("MODEL.json DATA", options->words,
                   "models written by fit or diagnose, and recordings or folders of them, in any order")
      ->required()
      ->expected(2, -1);
  add_keep_option(*command, options->data);
  add_reading_options(*command, options->data);
  command
      ->add_option(
          "--out", options->out,
          "folder for compare.json, models.csv, recordings.csv and report.html; -: compare.json on standard output")
      ->required();
  command->add_flag("--mat", options->mat, "also write the tables as tables.mat, for MATLAB");
  add_at_option(*command, options->data);
  add_without_time_option(*command, options->data);
  add_common_options(*command, options->common);
  command->footer("Example:\n  hysteron compare a/model.json b/model.json recordings/ --out comparison");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

// hysteron report: tables and page from the records of a study, summary and page from the record of a diagnosis.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "report/study.hpp"
#include "study/gather.hpp"
#include "task/diagnosis_text.hpp"
#include "task/study.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

// The page of `folder` with its recordings, where it has one; else what diagnosis.json tells alone.
json page_of(const std::filesystem::path& folder, const json& record) {
  const std::filesystem::path path = folder / "report.html";
  json page = std::filesystem::exists(path) ? data_of_page(read_file(path)) : json(nullptr);
  if (page.is_null()) {
    page = {{"title", "Diagnosis"}, {"version", HYSTERON_VERSION}};
  }
  page["diagnosis"] = record;
  return page;
}

void report_diagnosis(const std::filesystem::path& folder, const std::filesystem::path& out, bool as_json) {
  const std::string path = (folder / "diagnosis.json").string();
  const json record = read_diagnosis(path);
  const std::string text = diagnosis_text(record, path);
  const std::string page = fit_report_html(page_of(folder, record));
  make_output_folder(out);
  write_file_atomically(out / "report.html", page);
  fmt::print("{}", as_json ? json_text(record) : text + "report: " + printable((out / "report.html").string()) + "\n");
}

}  // namespace

void add_report(CLI::App& program) {
  struct Options {
    std::string folder;
    std::string out;
    bool times = false;
    bool ioh = false;
    bool mat = false;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "report", "tables and page from the records of a study, finished or not, or of a diagnosis");
  command->add_option("DIR", options->folder, "folder written by `hysteron bench` or `hysteron diagnose`")->required();
  command->add_option("--out", options->out, "folder for the report, default DIR");
  command->add_flag("--times", options->times, "times in the report too; without it equal studies give equal files");
  command->add_flag("--ioh", options->ioh, "also write ioh/ in the format of IOHprofiler");
  command->add_flag("--mat", options->mat, "also write runs, traces and parameters as tables.mat, for MATLAB");
  command->add_flag("--json", options->json, "the analysis, or the diagnosis, as JSON on standard output");
  command->footer("Example:\n  hysteron report out --times --ioh");
  take_common_options(*command);
  command->callback([options] {
    refuse_standard_output(options->out, "tables and a page");
    const std::filesystem::path folder = options->folder;
    if (!std::filesystem::exists(folder)) {
      static_cast<void>(read_file(folder));  // says so, with the nearest name
    }
    if (std::filesystem::exists(folder / "diagnosis.json")) {
      if (options->times || options->ioh || options->mat) {
        throw InputError("--times, --ioh and --mat are of a study, " + options->folder + " holds a diagnosis");
      }
      if (!options->out.empty()) refuse_other_results(options->out, "diagnosis.json");
      report_diagnosis(folder, options->out.empty() ? folder : std::filesystem::path(options->out), options->json);
      return;
    }
    const std::filesystem::path out = options->out.empty() ? options->folder : options->out;
    const Store store = open_gathered(options->folder);
    if (!options->out.empty()) refuse_other_results(options->out, "store.sqlite");
    const StudyView view = view_of(store, store.records(), options->folder);
    write_study_report(folder, out, view, {options->times, options->ioh, options->mat});
    if (options->json) {
      fmt::print("{}", json_text(view.analysis));
      return;
    }
    fmt::print("{}\n{}\n", study_terminal(view.analysis, view.times), printable((out / "report.html").string()));
  });
}

}  // namespace hysteron::app

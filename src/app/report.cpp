// hysteron report: tables and page from the records of a study.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/study_output.hpp"
#include "report/study.hpp"
#include "study/gather.hpp"

namespace hysteron::app {

void add_report(CLI::App& program) {
  struct Options {
    std::string folder;
    std::string out;
    bool times = false;
    bool ioh = false;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("report", "tables and page from the records of a study, finished or not");
  command->add_option("DIR", options->folder, "folder written by `hysteron bench`")->required();
  command->add_option("--out", options->out, "folder for the report, default DIR");
  command->add_flag("--times", options->times, "times in the report too; without it equal studies give equal files");
  command->add_flag("--ioh", options->ioh, "also write ioh/ in the format of IOHprofiler");
  command->add_flag("--json", options->json, "the analysis as JSON on standard output");
  command->footer("Example:\n  hysteron report out --times --ioh");
  command->callback([options] {
    const Store store = open_gathered(options->folder);
    const StudyView view = view_of(store, store.records(), options->folder);
    const std::filesystem::path out = options->out.empty() ? options->folder : options->out;
    write_study_report(out, view, options->times, options->ioh);
    if (options->json) {
      fmt::print("{}", json_text(view.analysis));
      return;
    }
    fmt::print("{}\n{}\n", study_terminal(view.analysis, view.times), (out / "report.html").string());
  });
}

}  // namespace hysteron::app

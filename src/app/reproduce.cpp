// hysteron reproduce: published tables made again, beside the published numbers.
#include "study/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/study_output.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "core/suggest.hpp"
#include "fit/solver.hpp"
#include "io/output.hpp"
#include "report/markdown.hpp"
#include "report/terminal.hpp"
#include "task/solver_settings.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

struct Options {
  std::string table;
  std::string out;
  std::size_t seeds = 0;
  std::size_t budget = 0;
  std::vector<std::string> data;
  std::vector<std::string> settings;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

std::string list(const std::string& title, const std::vector<std::string>& lines) {
  std::string text = lines.empty() ? "" : "\n" + title + "\n\n";
  for (const std::string& line : lines) text += "- " + line + "\n";
  return text;
}

json reproduction_json(const PublishedTable& entry, const Reproduction& result, const ReproduceOptions& used) {
  json tables = json::array();
  for (const StudyTable& one : result.tables) {
    tables.push_back(
        {{"id", one.id}, {"title", one.title}, {"note", one.note}, {"header", one.header}, {"rows", one.rows}});
  }
  return {{"schema", "hysteron.reproduction/1"},
          {"table", entry.id},
          {"title", entry.title},
          {"source", entry.source},
          {"seeds", used.seeds},
          {"budget", used.budget},
          {"tables", tables},
          {"findings", result.findings},
          {"remade", result.remade},
          {"not_remade", result.not_remade},
          {"provenance", {{"program", "hysteron " HYSTERON_VERSION}, {"command", command_line()}}}};
}

std::string effort_text(const ReproduceOptions& used) {
  return fmt::format("{} seed{}, {} evaluations a run", used.seeds, used.seeds == 1 ? "" : "s", used.budget);
}

std::string reproduction_markdown(const PublishedTable& entry, const Reproduction& result,
                                  const ReproduceOptions& used) {
  std::string text = fmt::format("# {}: {}\n\nSource: {}.\nMade by `{}` ({}).\n", entry.id, entry.title, entry.source,
                                 command_line(), effort_text(used));
  text += list("## What the numbers say", result.findings);
  for (const StudyTable& one : result.tables) {
    text += "\n## " + one.title + "\n\n" + (one.note.empty() ? "" : one.note + "\n\n") +
            markdown_table(one.header, one.rows);
  }
  for (const ReproducedPicture& picture : result.pictures) {
    text += fmt::format("\n## {}\n\n![{}]({}.svg)\n", picture.title, picture.title, picture.id);
  }
  text += list("## As published", result.remade);
  text += list("## Not as published", result.not_remade);
  return text;
}

// Gives the study's solvers these settings, each to those that know it and are not there as they ship. Returns what was
// changed, "pso: topology = 0".
std::vector<std::string> set(Study& study, const std::map<std::string, double>& settings) {
  std::vector<const SolverEntry*> taking;
  for (const SolverSpec& solver : study.solvers) {
    if (const SolverEntry* entry = find_solver(solver.id);
        !solver.shipped && std::ranges::find(taking, entry) == taking.end()) {
      taking.push_back(entry);
    }
  }
  check_settings(Option::set, taking, settings);
  std::vector<std::string> changed;
  for (const auto& [name, value] : settings) {
    for (SolverSpec& solver : study.solvers) {
      if (solver.shipped || find_setting(*find_solver(solver.id), name) == nullptr) continue;
      solver.settings[name] = value;
      changed.push_back(fmt::format("{}: {} = {:g}", solver.label, name, value));
    }
  }
  return changed;
}

// The table from its runs; nothing where it was interrupted.
std::optional<Reproduction> worked_out(const PublishedTable& entry, const Plan& plan,
                                       const std::vector<RunRecord>& records, bool quiet) {
  ProgressLine line(quiet);
  try {
    return entry.result(plan, records,
                        [&](double share) { line.show("working out the table from the runs", share, ""); });
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

void run(const Options& options) {
  const PublishedTable* entry = find_published_table(options.table);
  if (entry == nullptr) {
    std::vector<std::string> known;
    for (const PublishedTable& table : published_tables()) known.emplace_back(table.id);
    throw InputError("unknown table '" + options.table + "'" + suggestion(options.table, known) +
                     ", see `hysteron list tables`");
  }
  if (!options.data.empty() && !entry->takes_data) {
    throw InputError("--data: " + options.table +
                     " is tied to its own recordings, expected it with table-v, table-vi or table-vii");
  }
  refuse_standard_output(options.out, "records, a report and a table");
  if (!options.out.empty()) refuse_other_results(options.out, "store.sqlite");
  ReproduceOptions used{options.seeds > 0 ? options.seeds : entry->seeds,
                        options.budget > 0 ? options.budget : entry->budget, options.data};
  Study study = entry->study(used);
  const std::vector<std::string> changed = set(study, settings_of(options.settings));
  study.objective.stopped = interrupted;
  const Plan plan = make_plan(study, HYSTERON_VERSION);
  const std::filesystem::path out(options.out);
  Store store = options.out.empty() ? Store::memory() : Store::open(out, Store::Mode::write);
  RunOptions how;
  how.threads = options.threads;
  const RunProgress progress = run_with_progress(plan, store, how, options.quiet);
  if (progress.found + progress.done < progress.planned) {
    fmt::print(stderr, "interrupted: {} of {} runs done{}\n", progress.found + progress.done, progress.planned,
               options.out.empty() ? "; with --out DIR they would be kept" : " are kept in " + printable(options.out));
    return;
  }
  std::vector<RunRecord> records = store.records();
  std::optional<Reproduction> made = worked_out(*entry, plan, records, options.quiet);
  if (!made) {
    fmt::print(stderr, "interrupted: all runs are done{}\n",
               options.out.empty() ? "; with --out DIR they would be kept"
                                   : " and kept in " + printable(options.out) + ", the table is not made");
    return;
  }
  Reproduction result = std::move(*made);
  for (const std::string& line : changed) {
    result.not_remade.insert(result.not_remade.begin(), "set on the command line, " + line);
  }
  if (!options.out.empty()) {
    const StudyView view = view_of(store, std::move(records), out);
    write_study_report(out, out, view, {});
    write_file_atomically(out / (options.table + ".md"), reproduction_markdown(*entry, result, used));
    for (const ReproducedPicture& picture : result.pictures) {
      write_file_atomically(out / (picture.id + ".svg"), picture.svg);
    }
    write_file_atomically(out / (options.table + ".json"), json_text(reproduction_json(*entry, result, used)));
  }
  if (options.json) {
    fmt::print("{}", json_text(reproduction_json(*entry, result, used)));
    return;
  }
  fmt::print("{}\n{}\n{}\n\n", entry->title, entry->source, effort_text(used));
  for (const StudyTable& one : result.tables) fmt::print("{}\n{}\n", one.title, table(one.header, one.rows));
  for (const std::string& line : result.findings) fmt::print("{}\n", printable(line));
  for (const ReproducedPicture& picture : result.pictures) {
    fmt::print("picture: {}\n",
               options.out.empty() ? "with --out DIR" : printable((out / (picture.id + ".svg")).string()));
  }
  fmt::print("{}{}", list("As published:", result.remade), list("Not as published:", result.not_remade));
}

}  // namespace

void add_reproduce(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("reproduce", "makes a published table again, beside the published numbers");
  command->add_option("TABLE", options->table, "an id of `hysteron list tables`")->required();
  command->add_option("--seeds", options->seeds, "repeats of every run, default the table's")
      ->transform(whole_number(1, 100000));
  command->add_option("--budget", options->budget, "evaluations of a run, default the table's")
      ->transform(whole_number(10, 1000000000));
  command->add_option("--data", options->data, "recordings instead of the stand-in: table-v, table-vi, table-vii")
      ->allow_extra_args();
  command->add_option("--set", options->settings, "SETTING=NUMBER of the table's solvers that have it; repeatable")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "folder for records, report and table; an interrupted call is continued");
  command->add_option("--threads", options->threads, "runs beside each other; 0 takes OMP_NUM_THREADS or all cores")
      ->transform(whole_number(0, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "no progress on standard error");
  command->add_flag("--json", options->json, "JSON on standard output");
  command->footer(
      "Examples:\n  hysteron reproduce table-v\n  hysteron reproduce table-v --data recordings --seeds 31 --out real\n"
      "  hysteron reproduce table-v --set topology=0,vmax=1");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

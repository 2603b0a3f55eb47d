#include "app/study_output.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/output.hpp"
#include "report/study.hpp"
#include "report/terminal.hpp"
#include "study/analysis.hpp"
#include "study/export.hpp"
#include "study/identifiability.hpp"

namespace hysteron::app {

using nlohmann::json;

StudyProgress::StudyProgress(const Plan& plan, bool quiet) : plan_(plan), line_(quiet) {
  line_.show(plan.study.title, 0.0, fmt::format("{} runs", plan.runs.size()));
}

void StudyProgress::show(const RunProgress& now) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  const std::size_t todo = now.planned - now.found;
  if (now.nrmse) best_ = std::min(best_, *now.nrmse);
  line_.show(plan_.study.title, static_cast<double>(now.done) / static_cast<double>(todo),
             fmt::format("{} of {} runs{}, {:.1f} runs/s, best NRMSE {}, last {}", now.found + now.done, now.planned,
                         now.found > 0 ? fmt::format(" ({} found)", now.found) : "",
                         static_cast<double>(now.done) / std::max(seconds, 1e-9),
                         best_ < diverged_cost ? format_number(best_, 4) : "-", label_of(plan_, now.index)));
}

RunProgress run_with_progress(const Plan& plan, Store& store, const RunOptions& options, bool quiet) {
  for (const StudyProblem& problem : plan.problems) store.add_problem(problem.hash, problem.config);
  store.set_plan(plan_json(plan).dump());
  StudyProgress line(plan, quiet);
  const RunProgress progress =
      run_plan(plan, store, options, interrupted, [&](const RunProgress& now) { line.show(now); });
  line.finish();
  return progress;
}

void add_identifiability(const Plan& plan, Store& store, const std::vector<RunRecord>& records, int threads,
                         bool quiet) {
  std::vector<std::string> keys;
  for (const RunRecord* best : best_runs(plan_json(plan), records)) keys.push_back(best == nullptr ? "" : best->key);
  if (const auto stored = store.identifiability()) {
    std::vector<std::string> had;
    const json found = json::parse(*stored);
    for (const json& row : found.at("problems")) had.push_back(row.is_null() ? "" : row.at("key").get<std::string>());
    if (had == keys) return;
  }
  ProgressLine line(quiet);
  line.show("identifiability of the best fits", 0.0, "");
  const json found = identifiability(plan, records, threads, interrupted);
  line.finish();
  if (!found.at("problems").is_null()) store.set_identifiability(found.dump());
}

StudyView view_of(const Store& store, std::vector<RunRecord> of_store, const std::filesystem::path& folder) {
  const auto text = store.plan();
  if (!text)
    throw InputError(folder.string(), 0, "the store holds no plan yet, expected a study begun with `hysteron bench`");
  StudyView view;
  view.plan = json::parse(*text);
  view.records = std::move(of_store);
  const std::vector<RunRecord>& records = view.records;
  view.analysis = analyse(view.plan, records);
  if (const auto stored = store.identifiability()) {
    // Of the best runs of now, or not at all.
    const json found = json::parse(*stored);
    const std::vector<const RunRecord*> best = best_runs(view.plan, records);
    bool fits = found.at("problems").size() == best.size();
    for (std::size_t p = 0; fits && p < best.size(); ++p) {
      const json& row = found.at("problems").at(p);
      fits = row.is_null() ? best[p] == nullptr : best[p] != nullptr && row.at("key") == best[p]->key;
    }
    if (fits) view.analysis["identifiability"] = found.at("problems");
  }
  view.times = analyse_times(view.plan, view.analysis, records, store.timings());
  return view;
}

void write_study_report(const std::filesystem::path& folder, const StudyView& view, bool times, bool ioh) {
  make_output_folder(folder);
  const std::vector<RunRecord>& records = view.records;
  const json shown = times ? view.times : json(nullptr);
  write_file_atomically(folder / "analysis.json", json_text(view.analysis));
  write_file_atomically(folder / "report.html", study_html(view.analysis, shown));
  write_file_atomically(folder / "report.md", study_markdown(view.analysis, shown));
  write_file_atomically(folder / "tables.tex", study_latex(view.analysis, shown));
  write_file_atomically(folder / "runs.csv", runs_csv(view.plan, records));
  write_file_atomically(folder / "traces.csv", traces_csv(view.plan, records));
  write_file_atomically(folder / "parameters.csv", parameters_csv(view.plan, records));
  write_file_atomically(folder / "columns.csv", data_dictionary_csv());
  write_file_atomically(folder / "environment.json", json_text(view.times));
  if (ioh) {
    for (const auto& [name, content] : ioh_files(view.plan, records)) {
      const std::filesystem::path path = folder / "ioh" / name;
      make_output_folder(path.parent_path());
      write_file_atomically(path, content);
    }
  }
}

}  // namespace hysteron::app

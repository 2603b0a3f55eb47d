#include "task/study.hpp"

#include "core/error.hpp"
#include "io/csv_text.hpp"
#include "io/json_reader.hpp"
#include "io/mat5_writer.hpp"
#include "io/output.hpp"
#include "report/study.hpp"
#include "study/analysis.hpp"
#include "study/export.hpp"
#include "study/identifiability.hpp"
#include "study/stored_plan.hpp"
#include "study/times.hpp"
#include "task/json_text.hpp"

namespace hysteron {

using nlohmann::json;

void begin_study(const Plan& plan, Store& store) {
  for (const StudyProblem& problem : plan.problems) store.add_problem(problem.hash, problem.config);
  store.set_plan(plan_json(plan).dump());
}

void store_identifiability(const Plan& plan, Store& store, const std::vector<RunRecord>& records, int threads,
                           const std::function<bool()>& stop, const std::function<void()>& begun) {
  std::vector<std::string> keys;
  for (const RunRecord* best : best_runs(plan_json(plan), records)) keys.push_back(best == nullptr ? "" : best->key);
  if (const auto stored = store.identifiability()) {
    std::vector<std::string> had;
    const json found = json::parse(*stored);
    for (const json& row : found.at("problems")) had.push_back(row.is_null() ? "" : row.at("key").get<std::string>());
    if (had == keys) return;
  }
  begun();
  const json found = identifiability(plan, records, threads, stop);
  if (!found.at("problems").is_null()) store.set_identifiability(found.dump());
}

StudyView view_of(const Store& store, std::vector<RunRecord> records, const std::filesystem::path& folder) {
  const auto plan = store.plan();
  if (!plan)
    throw InputError(folder.string(), 0, "the store holds no plan yet, expected a study begun with `hysteron bench`");
  return view_of(*plan, store.identifiability(), std::move(records), store.timings(), folder);
}

StudyView view_of(const std::string& plan, const std::optional<std::string>& identifiability,
                  std::vector<RunRecord> of_store, const std::vector<RunTiming>& timings,
                  const std::filesystem::path& folder) {
  StudyView view;
  view.plan = parse_plan(plan, folder.string());
  view.records = std::move(of_store);
  const std::vector<RunRecord>& records = view.records;
  view.analysis = analyse(view.plan, records);
  if (identifiability) {
    const json found = parse_json(*identifiability, folder.string(), "expected what `hysteron bench` stores");
    // Of the best runs of now, or not at all.
    const std::vector<const RunRecord*> best = best_runs(view.plan, records);
    const json problems = found.is_object() ? found.value("problems", json(nullptr)) : json(nullptr);
    bool fits = problems.is_array() && problems.size() == best.size();
    for (std::size_t p = 0; fits && p < best.size(); ++p) {
      const json& row = problems.at(p);
      fits = row.is_null() ? best[p] == nullptr
                           : best[p] != nullptr && row.is_object() && row.value("key", json(nullptr)) == best[p]->key;
    }
    if (fits) view.analysis["identifiability"] = problems;
  }
  view.times = analyse_times(view.plan, view.analysis, records, timings);
  return view;
}

namespace {

// With the names of files and solvers as they stand in cells of tables.
json with_names_of_cells(json plan) {
  const auto rename = [](json& row, std::initializer_list<const char*> members) {
    for (const char* member : members) row.at(member) = name_cell(row.at(member).get<std::string>());
  };
  for (json& problem : plan.at("problems")) rename(problem, {"label", "model", "data"});
  for (json& solver : plan.at("solvers")) rename(solver, {"label"});
  return plan;
}

}  // namespace

std::map<std::string, std::string> study_report(const std::filesystem::path& folder, const StudyView& view,
                                                const StudyFiles& wanted) {
  const std::vector<RunRecord>& records = view.records;
  const json shown = wanted.times ? view.times : json(nullptr);
  std::map<std::string, std::string> files;
  try {
    files["analysis.json"] = json_text(view.analysis);
    files["report.html"] = study_html(view.analysis, shown);
    files["report.md"] = study_markdown(view.analysis, shown);
    files["tables.tex"] = study_latex(view.analysis, shown);
    files["runs.csv"] = runs_csv(with_names_of_cells(view.plan), records);
    files["traces.csv"] = traces_csv(view.plan, records);
    files["parameters.csv"] = parameters_csv(view.plan, records);
    files["columns.csv"] = data_dictionary_csv();
    files["environment.json"] = json_text(view.times);
    if (wanted.mat) {
      files["tables.mat"] = mat5_of({{"runs", mat_table(files["runs.csv"])},
                                     {"traces", mat_table(files["traces.csv"])},
                                     {"parameters", mat_table(files["parameters.csv"])}});
    }
    if (wanted.ioh) {
      for (auto& [name, content] : ioh_files(view.plan, records)) files["ioh/" + name] = std::move(content);
    }
  } catch (const json::exception&) {
    throw InputError(folder.string(), 0, "what the store says of the fits is not as `hysteron bench` stores it");
  }
  return files;
}

void write_study_report(const std::filesystem::path& from, const std::filesystem::path& folder, const StudyView& view,
                        const StudyFiles& wanted) {
  const std::map<std::string, std::string> files = study_report(from, view, wanted);
  make_output_folder(folder);
  for (const auto& [name, content] : files) {
    const std::filesystem::path path = folder / name;
    make_output_folder(path.parent_path());
    write_file_atomically(path, content);
  }
}

}  // namespace hysteron

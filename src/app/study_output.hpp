// Files of a study's report, and running a plan with a progress display: shared by bench, report, merge and reproduce.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "study/run.hpp"

namespace hysteron::app {

// Runs what the store does not hold yet, with a progress line. The plan is stored first.
RunProgress run_with_progress(const Plan& plan, Store& store, const RunOptions& options, bool quiet);

struct StudyView {
  nlohmann::json plan;
  nlohmann::json analysis;
  nlohmann::json times;
};
// Throws InputError for a store without a plan.
StudyView view_of(const Store& store, const std::filesystem::path& folder);

// report.html, report.md, tables.tex, runs.csv, traces.csv, parameters.csv, columns.csv, analysis.json, and
// environment.json with everything that varies between identical studies. `times` puts wall time into the report too.
void write_study_report(const Store& store, const std::filesystem::path& folder, const StudyView& view, bool times,
                        bool ioh);

}  // namespace hysteron::app

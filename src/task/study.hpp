// What `hysteron bench` and `hysteron report` do with a study's store beside its runs.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/run.hpp"

namespace hysteron {

// Stores the plan and its problems, which runs are done of.
void begin_study(const Plan& plan, Store& store);

// Works out what the data say of the parameters of the best fits, where the store does not have it for these runs;
// `begun` is called where there is work. Stores nothing when `stop` said so before the end.
void store_identifiability(const Plan& plan, Store& store, const std::vector<RunRecord>& records, int threads,
                           const std::function<bool()>& stop, const std::function<void()>& begun);

// NOLINTNEXTLINE(bugprone-exception-escape): a move of nlohmann::json does not throw, its assertions hide that.
struct StudyView {
  std::vector<RunRecord> records;
  nlohmann::json plan;
  nlohmann::json analysis;
  nlohmann::json times;
};
// `records` are those of the store. Throws InputError for a store without a plan, or with one that is none.
StudyView view_of(const Store& store, std::vector<RunRecord> records, const std::filesystem::path& folder);
// The same of what a store holds; `folder` opens the messages.
StudyView view_of(const std::string& plan, const std::optional<std::string>& identifiability,
                  std::vector<RunRecord> records, const std::vector<RunTiming>& timings,
                  const std::filesystem::path& folder);

// What a report of a study holds besides its tables and its page.
struct StudyFiles {
  bool times = false;  // wall time in the report too
  bool ioh = false;    // ioh/ in the format of IOHprofiler
  bool mat = false;    // tables.mat
};

// report.html, report.md, tables.tex, runs.csv, traces.csv, parameters.csv, columns.csv, analysis.json, and
// environment.json with everything that varies between identical studies. The study is that of the folder `from`.
void write_study_report(const std::filesystem::path& from, const std::filesystem::path& folder, const StudyView& view,
                        const StudyFiles& wanted);
// The names of these files in the folder and what is in them, all made before the first is written.
std::map<std::string, std::string> study_report(const std::filesystem::path& from, const StudyView& view,
                                                const StudyFiles& wanted);

}  // namespace hysteron

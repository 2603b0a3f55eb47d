// The records of a study for other programs.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/store.hpp"

namespace hysteron {

// runs.csv: one row a run of the plan that has a record, in the order of the plan.
[[nodiscard]] std::string runs_csv(const nlohmann::json& plan, const std::vector<RunRecord>& records);
// traces.csv: one row an improvement.
[[nodiscard]] std::string traces_csv(const nlohmann::json& plan, const std::vector<RunRecord>& records);
// parameters.csv: one row a parameter term of a run.
[[nodiscard]] std::string parameters_csv(const nlohmann::json& plan, const std::vector<RunRecord>& records);
// Every column of the files above: file, column, unit, meaning.
[[nodiscard]] std::string data_dictionary_csv();

// IOHprofiler format (IOHanalyzer reads it): file name inside the export folder -> content. A solver is an algorithm, a
// problem a function, a seed an instance; the largest budget only.
[[nodiscard]] std::map<std::string, std::string> ioh_files(const nlohmann::json& plan,
                                                           const std::vector<RunRecord>& records);

}  // namespace hysteron

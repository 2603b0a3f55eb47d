#include "study/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>

#include "report/csv.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

std::string digits(double value) { return fmt::format("{}", value); }
std::string digits(const std::optional<double>& value) { return value ? digits(*value) : std::string{}; }

struct Row {
  const json* run;
  const RunRecord* record;
};

// Runs of the plan that have a record, in the plan's order.
std::vector<Row> rows_of(const json& plan, const std::vector<RunRecord>& records) {
  std::map<std::string, const RunRecord*> by_key;
  for (const RunRecord& record : records) by_key[record.key] = &record;
  std::vector<Row> rows;
  for (const json& run : plan.at("runs")) {
    if (const auto found = by_key.find(run.at("key").get<std::string>()); found != by_key.end()) {
      rows.push_back({&run, found->second});
    }
  }
  return rows;
}

const json& problem_of(const json& plan, const json& run) {
  return plan.at("problems").at(run.at("problem").get<std::size_t>());
}
std::string solver_of(const json& plan, const json& run) {
  return plan.at("solvers").at(run.at("solver").get<std::size_t>()).at("label");
}

struct Column {
  const char* file;
  const char* name;
  const char* unit;
  const char* meaning;
};

constexpr std::array columns{
    Column{"runs.csv", "key", "", "sha256 of the run's whole configuration; names the run in every other file"},
    Column{"runs.csv", "problem", "", "label of model and data"},
    Column{"runs.csv", "model", "", "label of the model with its effects"},
    Column{"runs.csv", "data", "", "label of the recordings"},
    Column{"runs.csv", "dimension", "1", "number of searched coordinates"},
    Column{"runs.csv", "solver", "", "label of the solver with its settings"},
    Column{"runs.csv", "budget", "evaluations", "evaluations allowed"},
    Column{"runs.csv", "seed", "", "seed of the run's random stream"},
    Column{"runs.csv", "nrmse", "1", "best cost found; empty when no candidate stayed finite"},
    Column{"runs.csv", "nrmse_tight", "1", "the same parameters with a 256 times smaller integration tolerance"},
    Column{"runs.csv", "nrmse_heldout", "1", "over the recordings with the role validate; empty without any"},
    Column{"runs.csv", "evaluations", "evaluations", "spent; a point with derivatives costs 1 + dimension"},
    Column{"runs.csv", "diverged", "evaluations", "points whose simulation did not stay finite"},
    Column{"runs.csv", "stopped", "", "why the run ended: budget, or the solver's own reason"},
    Column{"traces.csv", "key", "", "the run"},
    Column{"traces.csv", "evaluations", "evaluations", "spent when the improvement was found"},
    Column{"traces.csv", "nrmse", "1", "best cost from there on"},
    Column{"parameters.csv", "key", "", "the run"},
    Column{"parameters.csv", "term", "", "parameter, or its coefficient: alpha*i is the slope with the drive"},
    Column{"parameters.csv", "value", "SI", "identified value; `hysteron describe MODEL` has units"},
};

std::vector<std::string> header_of(const std::string& file) {
  std::vector<std::string> header;
  for (const Column& column : columns) {
    if (file == column.file) header.emplace_back(column.name);
  }
  return header;
}

// File names that are the same everywhere.
std::string plain_name(const std::string& label) {
  std::string name;
  for (const char c : label) {
    const bool keep =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    name += keep ? c : '_';
  }
  return name;
}

// The improvements of a run, and its last evaluation, with which a block must end. A run without a finite candidate
// would be no run to the reader, and its solver without failures: it has the cost of a diverged candidate, as the
// solver was told, from its first evaluation on. The format counts evaluations from 1.
std::vector<TracePoint> ioh_rows(const RunRecord& record) {
  std::vector<TracePoint> rows = record.trace;
  if (rows.empty()) rows.push_back({1, diverged_cost});
  if (rows.back().evaluations < record.evaluations) rows.push_back({record.evaluations, rows.back().best});
  return rows;
}

}  // namespace

std::string runs_csv(const json& plan, const std::vector<RunRecord>& records) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [run, record] : rows_of(plan, records)) {
    const json& problem = problem_of(plan, *run);
    rows.push_back({record->key, problem.at("label"), problem.at("model"), problem.at("data"),
                    std::to_string(problem.at("dimension").get<std::size_t>()), solver_of(plan, *run),
                    std::to_string(run->at("budget").get<std::size_t>()),
                    std::to_string(run->at("seed").get<std::uint64_t>()), digits(record->nrmse),
                    digits(record->nrmse_tight), digits(record->nrmse_heldout), std::to_string(record->evaluations),
                    std::to_string(record->diverged), record->stopped});
  }
  return csv_table(header_of("runs.csv"), rows);
}

std::string traces_csv(const json& plan, const std::vector<RunRecord>& records) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [run, record] : rows_of(plan, records)) {
    for (const TracePoint& point : record->trace) {
      rows.push_back({record->key, std::to_string(point.evaluations), digits(point.best)});
    }
  }
  return csv_table(header_of("traces.csv"), rows);
}

std::string parameters_csv(const json& plan, const std::vector<RunRecord>& records) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [run, record] : rows_of(plan, records)) {
    const json parameters = json::parse(record->parameters);
    for (const auto& [term, value] : parameters.items()) {
      rows.push_back({record->key, term, digits(value.get<double>())});
    }
  }
  return csv_table(header_of("parameters.csv"), rows);
}

std::string data_dictionary_csv() {
  std::vector<std::vector<std::string>> rows;
  for (const Column& column : columns) rows.push_back({column.file, column.name, column.unit, column.meaning});
  return csv_table({"file", "column", "unit", "meaning"}, rows);
}

std::map<std::string, std::string> ioh_files(const json& plan, const std::vector<RunRecord>& records) {
  struct Block {
    std::string data;
    std::string summary;
  };
  const auto largest = plan.at("budgets").back().get<std::size_t>();
  std::map<std::pair<std::size_t, std::size_t>, Block> blocks;
  for (const auto& [run, record] : rows_of(plan, records)) {
    if (run->at("budget").get<std::size_t>() != largest) continue;
    Block& block = blocks[{run->at("solver").get<std::size_t>(), run->at("problem").get<std::size_t>()}];
    const std::vector<TracePoint> rows = ioh_rows(*record);
    block.data += "\"function evaluation\" \"best-so-far f(x)\"\n";
    for (const TracePoint& point : rows) block.data += fmt::format("{} {}\n", point.evaluations, point.best);
    block.summary +=
        fmt::format(", {}:{}|{}", run->at("seed").get<std::uint64_t>(), rows.back().evaluations, rows.back().best);
  }
  std::map<std::string, std::string> files;
  for (const auto& [where, block] : blocks) {
    const json& problem = plan.at("problems").at(where.second);
    const std::string label = plan.at("solvers").at(where.first).at("label");
    const auto function = where.second + 1;
    const auto dimension = problem.at("dimension").get<std::size_t>();
    const std::string folder = plain_name(label);
    const std::string data = fmt::format("data_f{}/IOHprofiler_f{}_DIM{}.dat", function, function, dimension);
    std::string algorithm = label;
    std::ranges::replace(algorithm, '\'', '_');
    files[folder + "/" + data] = block.data;
    files[fmt::format("{}/IOHprofiler_f{}.info", folder, function)] =
        fmt::format("suite = 'hysteron', funcId = {}, DIM = {}, algId = '{}'\n%{}\n{}{}\n", function, dimension,
                    algorithm, problem.at("label").get<std::string>(), data, block.summary);
  }
  return files;
}

}  // namespace hysteron

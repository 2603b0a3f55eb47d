// From a study to its runs: the problems with their data, and every run keyed by the hash of its configuration.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fit/objective.hpp"
#include "fit/solver.hpp"
#include "io/channels.hpp"
#include "study/study.hpp"

namespace hysteron {

// One model on one set of recordings.
struct StudyProblem {
  std::string label;   // model @ data
  std::string model;   // label of the model
  std::string data;    // label of the data
  std::string hash;    // sha256 of `config`
  std::string config;  // canonical JSON: recordings, model, effects, box, normalisation, tolerance
  Layout layout;
  std::vector<Recording> recordings;  // fitted
  std::vector<Recording> heldout;     // role "validate": scored, never fitted
};

struct PlannedRun {
  std::string key;     // sha256 of `config`
  std::string config;  // canonical JSON: problem hash, solver, all settings, budget, seed, start, version
  std::size_t problem;
  std::size_t solver;
  std::size_t budget;
  std::uint64_t seed;
};

struct Plan {
  Study study;
  std::vector<StudyProblem> problems;
  std::vector<PlannedRun> runs;      // problems, then budgets, then seeds, then solvers
  std::vector<Remark> remarks = {};  // of the readers, and on what recordings look like beside each other
};

// Reads the recordings and names every run. Throws InputError, at the study's line where it can, for data and models
// that do not fit together. `version` is the program's and part of every key.
[[nodiscard]] Plan make_plan(const Study& study, const std::string& version);

// What a report needs to know of a plan, without the data: labels, problems, runs. Canonical.
[[nodiscard]] nlohmann::json plan_json(const Plan& plan);

// Runs of shard `index` (from 1) of `count`: by key, so that a run stays in its shard when the study grows.
[[nodiscard]] bool in_shard(const std::string& key, std::size_t index, std::size_t count);

// The problem a solver sees: dimension, budget, the random stream of (problem, seed), the starting point.
[[nodiscard]] Problem solver_problem(const StudyProblem& problem, const PlannedRun& run, const Study& study);

}  // namespace hysteron

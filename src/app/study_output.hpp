// Running a plan with a progress display: shared by bench, merge and reproduce.
#pragma once

#include <chrono>
#include <vector>

#include "app/command.hpp"
#include "study/run.hpp"
#include "task/study.hpp"

namespace hysteron::app {

// What a progress line shows of a study under way.
class StudyProgress {
 public:
  StudyProgress(const Plan& plan, bool quiet);
  void show(const RunProgress& now);
  void finish() { line_.finish(); }

 private:
  const Plan& plan_;
  ProgressLine line_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  double best_ = diverged_cost;
};

// begin_study and run_plan, with a progress line.
RunProgress run_with_progress(const Plan& plan, Store& store, const RunOptions& options, bool quiet);

// As store_identifiability, with a progress line.
void add_identifiability(const Plan& plan, Store& store, const std::vector<RunRecord>& records, int threads,
                         bool quiet);

}  // namespace hysteron::app

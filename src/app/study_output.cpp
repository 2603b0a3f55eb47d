#include "app/study_output.hpp"

#include <fmt/format.h>

#include "report/terminal.hpp"

namespace hysteron::app {

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
  begin_study(plan, store);
  StudyProgress line(plan, quiet);
  const RunProgress progress =
      run_plan(plan, store, options, interrupted, [&](const RunProgress& now) { line.show(now); });
  line.finish();
  return progress;
}

void add_identifiability(const Plan& plan, Store& store, const std::vector<RunRecord>& records, int threads,
                         bool quiet) {
  ProgressLine line(quiet);
  store_identifiability(plan, store, records, threads, interrupted,
                        [&] { line.show("identifiability of the best fits", 0.0, ""); });
  line.finish();
}

}  // namespace hysteron::app

#include "study/dispatch.hpp"

#include <algorithm>

namespace hysteron {

std::vector<Assignment> assignments(const Plan& plan, const std::vector<std::size_t>& todo) {
  std::vector<double> samples(plan.problems.size(), 0.0);
  for (std::size_t p = 0; p < plan.problems.size(); ++p) {
    for (const Recording& recording : plan.problems[p].recordings) samples[p] += static_cast<double>(recording.size());
  }
  std::map<std::size_t, std::size_t> budgets;
  for (const std::size_t budget : plan.study.budgets) budgets.emplace(budget, budgets.size());
  std::vector<Assignment> result;
  for (const std::size_t k : todo) {
    const PlannedRun& run = plan.runs[k];
    const std::size_t kind =
        (run.problem * plan.study.solvers.size() + run.solver) * budgets.size() + budgets.at(run.budget);
    result.push_back({k, kind, static_cast<double>(run.budget) * samples[run.problem]});
  }
  return result;
}

Dispatcher::Dispatcher(std::vector<Assignment> todo, std::size_t workers)
    : todo_(std::move(todo)), workers_(static_cast<double>(workers)) {
  // Stable: runs of one problem stay together, and a rank makes the objective of a problem few times.
  std::ranges::stable_sort(todo_, std::ranges::greater{}, &Assignment::size);
  for (const Assignment& one : todo_) {
    by_run_[one.run] = &one;
    size_left_ += one.size;
  }
}

double Dispatcher::expected(const Assignment& assignment) const {
  if (const auto own = kinds_.find(assignment.kind); own != kinds_.end()) {
    return own->second.seconds / static_cast<double>(own->second.count);
  }
  return all_.seconds / all_.size * assignment.size;
}

std::vector<std::size_t> Dispatcher::take() {
  std::vector<std::size_t> batch;
  if (left() == 0) return batch;
  double room = 0.0;  // without any length known: one run
  if (all_.count > 0) room = std::min(longest, all_.seconds / all_.size * size_left_ / (4.0 * workers_));
  do {
    const Assignment& one = todo_[next_++];
    batch.push_back(one.run);
    size_left_ -= one.size;
    if (all_.count > 0) room -= expected(one);
  } while (left() > 0 && room > 0.0 && room >= 0.5 * expected(todo_[next_]));
  return batch;
}

void Dispatcher::finished(std::size_t run, double seconds) {
  const auto found = by_run_.find(run);
  if (found == by_run_.end()) return;
  const Assignment& one = *found->second;
  for (Mean* mean : {&kinds_[one.kind], &all_}) {
    mean->seconds += seconds;
    mean->size += one.size;
    ++mean->count;
  }
}

void Dispatcher::halt() { next_ = todo_.size(); }

}  // namespace hysteron

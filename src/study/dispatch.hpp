// Handing out runs to ranks: which, and how many at a time.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "study/plan.hpp"

namespace hysteron {

// A run as the dispatcher sees it.
struct Assignment {
  std::size_t run = 0;   // index in Plan::runs
  std::size_t kind = 0;  // runs of one kind take about the same time: one problem, solver and budget
  double size = 1.0;     // a guess of the work beforehand, in any unit
};

[[nodiscard]] std::vector<Assignment> assignments(const Plan& plan, const std::vector<std::size_t>& todo);

// Runs in batches whose expected length is a share of what is left (guided self-scheduling: Polychronopoulos and Kuck,
// IEEE Trans. Comput. 36 (1987) 1425-1439) and never more than `longest`: short runs share one message, long runs go
// out one by one, and the last ones are single, so that no rank holds work back while others stand idle. Lengths are
// learnt from runs that have ended; larger runs go first.
class Dispatcher {
 public:
  static constexpr double longest = 0.25;  // s

  Dispatcher(std::vector<Assignment> todo, std::size_t workers);
  // Indices in Plan::runs; none when nothing is left.
  [[nodiscard]] std::vector<std::size_t> take();
  void finished(std::size_t run, double seconds);
  // Nothing more is handed out.
  void halt();
  [[nodiscard]] std::size_t left() const { return todo_.size() - next_; }

 private:
  struct Mean {
    double seconds = 0.0;
    double size = 0.0;
    std::size_t count = 0;
  };
  [[nodiscard]] double expected(const Assignment& assignment) const;

  std::vector<Assignment> todo_;
  std::map<std::size_t, const Assignment*> by_run_;
  std::size_t next_ = 0;
  double size_left_ = 0.0;
  double workers_;
  std::map<std::size_t, Mean> kinds_;
  Mean all_;
};

}  // namespace hysteron

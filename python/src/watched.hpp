// Long work without Python's lock: Ctrl-C ends it, and a callable of the user's is told how far it is.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace hysteron::python {

// How far the work is; what does not apply is absent.
struct Progress {
  std::string stage;
  double share = 0.0;  // of the stage, or of the whole where the work knows it
  std::optional<std::size_t> evaluations = {};
  std::optional<std::size_t> budget = {};
  std::optional<double> nrmse = {};
};

// The work's view of whoever waits for it. Any thread of the work may call it.
class Watched {
 public:
  [[nodiscard]] bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
  void show(Progress progress);

 private:
  friend void watch(const std::function<void(Watched&)>& work, const pybind11::object& progress);

  std::atomic<bool> stopped_{false};
  std::mutex mutex_;  // of all below
  std::condition_variable ended_;
  bool done_ = false;
  std::optional<Progress> latest_;
};

// Does the work in a thread of its own while this one waits, with the lock of the interpreter released but for signals
// and for `progress`, a callable of (stage, share, evaluations, budget, nrmse) or None. What either of them raises is
// raised here, after the work has ended; what the work throws is thrown here.
void watch(const std::function<void(Watched&)>& work, const pybind11::object& progress);

}  // namespace hysteron::python

#include "watched.hpp"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace hysteron::python {
namespace py = pybind11;
namespace {

// Often enough for one who presses Ctrl-C.
constexpr std::chrono::milliseconds between_looks{50};

template <class T>
py::object number_or_none(const std::optional<T>& value) {
  return value ? py::cast(*value) : py::none();
}

void tell(const py::object& callable, const Progress& now) {
  callable(now.stage, now.share, number_or_none(now.evaluations), number_or_none(now.budget),
           number_or_none(now.nrmse));
}

}  // namespace

void Watched::show(Progress progress) {
  const std::scoped_lock lock(mutex_);
  latest_ = std::move(progress);
}

void watch(const std::function<void(Watched&)>& work, const py::object& progress) {
  Watched watched;
  std::exception_ptr failure;  // of the work
  std::exception_ptr raised;   // by Python
  std::thread thread([&] {
    try {
      work(watched);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::scoped_lock lock(watched.mutex_);
    watched.done_ = true;
    watched.ended_.notify_all();
  });
  for (bool done = false; !done;) {
    std::optional<Progress> latest;
    {
      const py::gil_scoped_release released;
      std::unique_lock lock(watched.mutex_);
      watched.ended_.wait_for(lock, between_looks, [&] { return watched.done_; });
      done = watched.done_;
      latest = std::exchange(watched.latest_, std::nullopt);
    }
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (latest && !progress.is_none()) tell(progress, *latest);
    } catch (...) {
      raised = std::current_exception();
      watched.stopped_ = true;
    }
  }
  thread.join();
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hysteron::python

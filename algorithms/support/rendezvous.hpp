// Lends a library's own evaluation loop to the ask/tell interface: the library runs in a thread of its own and meets
// the caller at every evaluation. At any time one of the two threads waits, so nothing runs concurrently; the thread is
// begun at the first ask, which also gives the library's thread-local random state to this solver alone.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "algorithms/support/population.hpp"
#include "fit/solver.hpp"

namespace hysteron::support {

// What the library's thread is told of one point.
struct Answer {
  double cost;                       // ordered, never NaN
  std::vector<double> gradient;      // J^T r, empty unless asked for
  std::vector<double> gauss_newton;  // J^T J, likewise
};

class ForeignSolver : public Solver {
 public:
  // Evaluates one point; nullopt: stop as soon as possible, no answer will come.
  using Evaluate = std::function<std::optional<Answer>(Point point, bool derivatives)>;
  // Runs in the thread; returns why it ended. Must return soon after a nullopt.
  using Body = std::function<std::string(const Evaluate& evaluate)>;

  explicit ForeignSolver(Body body) : body_(std::move(body)) {}
  ForeignSolver(const ForeignSolver&) = delete;
  ForeignSolver& operator=(const ForeignSolver&) = delete;
  ForeignSolver(ForeignSolver&&) = delete;
  ForeignSolver& operator=(ForeignSolver&&) = delete;
  ~ForeignSolver() override {
    {
      const std::lock_guard lock(mutex_);
      abandoned_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  Request ask() override {
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return asked_ || ended_; });
    if (!asked_) return {};
    Request request;
    request.points = point_;
    request.derivatives = derivatives_;
    return request;
  }

  // An empty answer leaves the question open.
  void tell(const Request& /*request*/, const Response& response) override {
    {
      const std::lock_guard lock(mutex_);
      if (!asked_ || response.cost.empty()) return;
      const auto d = static_cast<std::ptrdiff_t>(point_.size());
      answer_ = Answer{ordered_cost(response.cost[0]), {}, {}};
      if (derivatives_) {
        answer_->gradient.assign(response.gradient.begin(), response.gradient.begin() + d);
        answer_->gauss_newton.assign(response.gauss_newton.begin(), response.gauss_newton.begin() + d * d);
      }
      asked_ = false;
    }
    changed_.notify_all();
  }

  [[nodiscard]] std::string stopped_because() const override {
    const std::lock_guard lock(mutex_);
    return ended_ ? reason_ : std::string{};
  }

 private:
  void run() {
    std::string reason = body_([this](Point point, bool derivatives) -> std::optional<Answer> {
      std::unique_lock lock(mutex_);
      if (abandoned_) return std::nullopt;
      point_ = std::move(point);
      derivatives_ = derivatives;
      answer_.reset();
      asked_ = true;
      changed_.notify_all();
      changed_.wait(lock, [this] { return answer_.has_value() || abandoned_; });
      asked_ = false;
      return std::exchange(answer_, std::nullopt);
    });
    {
      const std::lock_guard lock(mutex_);
      reason_ = std::move(reason);
      ended_ = true;
    }
    changed_.notify_all();
  }

  Body body_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Point point_;
  bool derivatives_ = false;
  bool asked_ = false;
  bool ended_ = false;
  bool abandoned_ = false;
  std::optional<Answer> answer_;
  std::string reason_;
  std::thread thread_;
};

}  // namespace hysteron::support

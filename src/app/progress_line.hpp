// Progress on standard error.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace hysteron::app {

// What is left of a work, from the shares that were done and the seconds they took.
class TimeLeft {
 public:
  // After so many seconds so much is done; less than before: other work begins.
  void advance(double share, double spent);
  // Nothing before a quarter is done, before the whole that the shares promise has settled, and where the next share
  // is overdue: then it is known to be more, and not by how much.
  [[nodiscard]] std::optional<double> after(double spent) const;

 private:
  struct Step {
    double share;
    double spent;
  };
  std::vector<Step> steps_;  // the latest last
};

// "40 %  12 s, about 18 s left  stage  detail", no wider than the terminal.
std::string progress_text(const std::string& stage, double share, const std::string& detail, double spent,
                          std::optional<double> left, std::size_t width);

// On a terminal a line that is rewritten in place, every half second also where nothing new is shown; otherwise one
// plain line a stage.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;
  // `share` is of the whole work: where it falls, other work has begun, with a time of its own.
  void show(const std::string& stage, double share, const std::string& detail);
  void finish();

 private:
  void draw();

  bool quiet_;
  bool terminal_;
  std::mutex mutex_;  // of all below
  std::string stage_;
  std::string detail_;
  double share_ = 0.0;
  TimeLeft left_;
  std::chrono::steady_clock::time_point begun_;
  std::chrono::steady_clock::time_point drawn_;
  std::condition_variable_any over_;
  std::jthread ticker_;
};

}  // namespace hysteron::app

// Progress on standard error.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace hysteron::app {

// "40 %  12 s, about 18 s left  stage  detail", no wider than the terminal.
std::string progress_text(const std::string& stage, double share, const std::string& detail, double spent,
                          std::size_t width);

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
  std::chrono::steady_clock::time_point begun_;
  std::chrono::steady_clock::time_point drawn_;
  std::condition_variable_any over_;
  std::jthread ticker_;
};

}  // namespace hysteron::app

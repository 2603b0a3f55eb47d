#include "app/progress_line.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/printable.hpp"

namespace hysteron::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds tick{500};
constexpr std::chrono::milliseconds fastest{100};
// Before, what is left is a guess.
constexpr double least_spent = 4.0;
constexpr double least_share = 0.25;
// The whole has settled where the shares of the last of the work promised the same within this factor.
constexpr double looked_back = 0.15;
constexpr double settled_within = 1.25;
// Of what was left: without a further share for longer, it is more.
constexpr double overdue = 0.2;

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

// The first `width` characters of UTF-8 text.
std::string cut(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool begins = (static_cast<unsigned char>(text[k]) & 0xc0U) != 0x80U;
    if (begins && characters++ == width) return text.substr(0, k);
  }
  return text;
}

}  // namespace

void TimeLeft::advance(double share, double spent) {
  if (!steps_.empty() && share < steps_.back().share) steps_.clear();
  if (steps_.empty() || share > steps_.back().share) steps_.push_back({share, spent});
}

std::optional<double> TimeLeft::after(double spent) const {
  if (steps_.empty() || steps_.back().share < least_share || spent < least_spent) return std::nullopt;
  const Step& last = steps_.back();
  const double whole = last.spent / last.share;
  double shortest = whole;
  double longest = whole;
  for (auto step = steps_.rbegin(); step != steps_.rend() && step->share > 0.0; ++step) {
    shortest = std::min(shortest, step->spent / step->share);
    longest = std::max(longest, step->spent / step->share);
    if (step->share <= last.share - looked_back) break;
  }
  if (longest > settled_within * shortest) return std::nullopt;
  const double left = whole - last.spent;
  const double waited = spent - last.spent;
  if (waited > std::max(overdue * left, 1.0)) return std::nullopt;
  return std::max(left - waited, 0.0);
}

std::string progress_text(const std::string& stage, double share, const std::string& detail, double spent,
                          std::optional<double> left, std::size_t width) {
  // What is cut off a narrow terminal is the end of the words.
  std::string text = fmt::format("{:.0f} %  {}", 100.0 * share, duration_text(spent));
  if (left) text += *left < 1.0 ? ", nearly done" : ", about " + duration_text(*left) + " left";
  text += "  " + printable(stage);
  if (!detail.empty()) text += "  " + printable(detail);
  return cut(text, width);
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {
  if (quiet_ || !terminal_) return;
  ticker_ = std::jthread([this](const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!over_.wait_for(lock, stop, tick, [&] { return stop.stop_requested(); })) {
      if (!stage_.empty()) draw();
    }
  });
}

ProgressLine::~ProgressLine() { finish(); }

void ProgressLine::draw() {
  drawn_ = Clock::now();
  const double spent = std::chrono::duration<double>(drawn_ - begun_).count();
  // The last column stays free: some terminals begin a new line behind it.
  fmt::print(stderr, "\r\033[K{}",
             progress_text(stage_, share_, detail_, spent, left_.after(spent), terminal_width() - 1));
  std::fflush(stderr);
}

void ProgressLine::show(const std::string& stage, double share, const std::string& detail) {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  const bool fresh = stage != stage_;
  if (fresh && !terminal_) fmt::print(stderr, "{}\n", printable(stage));
  if (stage_.empty() || share < share_) {
    begun_ = Clock::now();
    left_ = {};
  }
  left_.advance(share, std::chrono::duration<double>(Clock::now() - begun_).count());
  stage_ = stage;
  detail_ = detail;
  share_ = share;
  if (terminal_ && (fresh || Clock::now() - drawn_ > fastest)) draw();
}

void ProgressLine::finish() {
  if (quiet_) return;
  const std::scoped_lock lock(mutex_);
  if (terminal_ && !stage_.empty()) {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
  stage_.clear();
  share_ = 0.0;
}

}  // namespace hysteron::app

#include "check/switched_drive.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/drive.hpp"
#include "core/extent.hpp"
#include "core/mean.hpp"

namespace hysteron {
namespace {

// What is smaller beside the largest drive does little to the force.
constexpr double least_share = 0.25;
// A hundred samples of normal noise spread over five standard deviations, more over more; two levels held alike often
// over two, a staircase, a sine and a triangle over up to three and a half.
constexpr double most_of_levels = 4.0;

bool goes_between_levels(const std::vector<double>& drive, double span, double mean) {
  double squares = 0.0;
  for (const double value : drive) squares += (value - mean) * (value - mean);
  return span * span * static_cast<double>(drive.size()) < most_of_levels * most_of_levels * squares;
}

}  // namespace

std::vector<Remark> remarks_on_switched_drives(const std::vector<Recording>& recordings) {
  std::vector<Remark> result;
  for (const Recording& recording : recordings) {
    if (recording.drive.empty() || varies(recording.drive)) continue;
    double largest = 0.0;
    for (const Recording& other : recordings) {
      if (other.drive_kind == recording.drive_kind) largest = std::max(largest, peak_of(other.drive));
    }
    const auto [low, high] = std::ranges::minmax(recording.drive);
    const double mean = mean_of(recording.drive);
    if (high - low < least_share * largest || !goes_between_levels(recording.drive, high - low, mean)) continue;
    const bool voltage = recording.drive_kind == DriveKind::voltage;
    result.push_back({recording.file, Remark::Kind::implausible, "switched drive",
                      fmt::format("the {0} goes between {2:.3g} {1} and {3:.3g} {1} within a few samples and counts as "
                                  "constant at its mean, {4:.3g} {1}: record more than eight samples of each level",
                                  voltage ? "voltage" : "current", voltage ? "V" : "A", low, high, mean)});
  }
  return result;
}

}  // namespace hysteron

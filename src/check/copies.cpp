#include "check/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "io/velocity.hpp"

namespace hysteron {
namespace {

// No two tests agree to this part of a channel's standard deviation: repeated forces differ by a hundredth at best.
constexpr double rounding = 1e-3;
// The noise of two recordings adds up in their difference; what is left of it at half its squares is of one recording.
constexpr double of_two_noises = 0.5;

double squares_about_mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value - values.front();
  const double mean = values.front() + sum / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares;
}

struct Channel {
  std::span<const double> time;
  std::span<const double> values;
};

// By which part of its standard deviation a channel differs from that of a copy; nothing where it is none.
std::optional<double> difference_of_copy(const Channel& one, const Channel& other) {
  const double own = squares_about_mean(one.values);
  double squares = 0.0;
  for (std::size_t n = 0; n < one.values.size(); ++n) {
    const double apart = one.values[n] - other.values[n];
    squares += apart * apart;
    if (squares > own) return std::nullopt;
  }
  const double part = own > 0.0 ? std::sqrt(squares / own) : 0.0;
  if (part <= rounding) return part;
  const double noise = std::hypot(channel_noise(one.time, one.values), channel_noise(other.time, other.values));
  const double limit = of_two_noises * noise * noise * static_cast<double>(one.values.size());
  return squares <= limit ? std::optional(part) : std::nullopt;
}

// The larger difference of the two channels.
std::optional<double> difference_of_copy(const Recording& one, const Recording& other) {
  if (one.size() != other.size() || one.displacement.empty() || one.force.empty() ||
      one.displacement.size() != other.displacement.size() || one.force.size() != other.force.size()) {
    return std::nullopt;
  }
  const auto force = difference_of_copy({one.time, one.force}, {other.time, other.force});
  if (!force) return std::nullopt;
  const auto displacement = difference_of_copy({one.time, one.displacement}, {other.time, other.displacement});
  if (!displacement) return std::nullopt;
  return std::max(*force, *displacement);
}

}  // namespace

std::vector<Remark> remarks_on_copies(const std::vector<Recording>& recordings) {
  std::vector<Remark> remarks;
  std::map<std::string, std::string> first;  // of the same bytes
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Recording& recording = recordings[k];
    const auto [known, fresh] = first.emplace(recording.sha256, recording.file);
    if (!fresh && !recording.sha256.empty()) {
      remarks.push_back({recording.file, Remark::Kind::implausible, "copy",
                         "holds the same bytes as " + known->second + ", so that neither is held out from the other"});
      continue;
    }
    for (std::size_t before = 0; before < k; ++before) {
      const auto part = difference_of_copy(recording, recordings[before]);
      if (!part) continue;
      remarks.push_back({recording.file, Remark::Kind::implausible, "near copy",
                         fmt::format("differs from {} by {:.2g} % of the standard deviation of displacement and force, "
                                     "sample by sample, as a copy does: neither is held out from the other",
                                     recordings[before].file, 100.0 * *part)});
      break;
    }
  }
  return remarks;
}

}  // namespace hysteron

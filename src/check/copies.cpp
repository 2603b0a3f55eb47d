#include "check/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include "check/rounded_copies.hpp"
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

// Finds stretches of samples that two recordings share. The force of every block of an earlier recording is known by
// its hash, and looked for at every sample of a later one.
class SharedSamples {
 public:
  explicit SharedSamples(const std::vector<Recording>& recordings) : recordings_(recordings) {
    for (std::size_t k = 0; k < block; ++k) highest_ *= factor;
  }

  // The longest one with an earlier recording, a quarter of the shorter of both at least: a common rest at the start of
  // simulated recordings is none.
  [[nodiscard]] std::optional<Shared> longest(std::size_t k) const {
    constexpr std::size_t part = 4;
    const std::vector<double>& force = recordings_[k].force;
    Shared best;
    std::size_t end = 0;  // of the stretch found last
    std::uint64_t hash = 0;
    for (std::size_t n = 0; n < force.size(); ++n) {
      hash = hash * factor + bits(force[n]);
      if (n >= block) hash -= highest_ * bits(force[n - block]);
      if (n + 1 < block || n < end) continue;
      const auto known = blocks_.find(hash);
      if (known == blocks_.end()) continue;
      const Shared found = extended(k, n + 1 - block, known->second);
      if (found.count < block) continue;
      end = found.first + found.count;
      const std::size_t shorter = std::min(force.size(), recordings_[found.recording].force.size());
      if (found.count > best.count && part * found.count >= shorter) best = found;
    }
    return best.count > 0 ? std::optional(best) : std::nullopt;
  }

  // From now on recording k is an earlier one.
  void add(std::size_t k) {
    const std::vector<double>& force = recordings_[k].force;
    if (recordings_[k].displacement.size() != force.size()) return;
    for (std::size_t first = 0; first + block <= force.size(); first += block) {
      if (!is_told_by(std::span(force).subspan(first, block))) continue;
      std::uint64_t hash = 0;
      for (std::size_t n = 0; n < block; ++n) hash = hash * factor + bits(force[first + n]);
      blocks_.emplace(hash, Place{k, first});
    }
  }

 private:
  static constexpr std::size_t block = 32;
  static constexpr std::uint64_t factor = 0x9E3779B97F4A7C15U;
  struct Place {
    std::size_t recording;
    std::size_t first;
  };

  static std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

  // A force at rest, or in few steps of a converter, may be that of any recording.
  static bool is_told_by(std::span<const double> values) {
    std::set<double> different(values.begin(), values.end());
    return 2 * different.size() > values.size();
  }

  [[nodiscard]] Shared extended(std::size_t k, std::size_t first, const Place& there) const {
    const Recording& one = recordings_[k];
    const Recording& other = recordings_[there.recording];
    const auto same = [&](std::size_t n, std::size_t m) {
      return one.force[n] == other.force[m] && one.displacement[n] == other.displacement[m];
    };
    std::size_t before = 0;
    while (before < first && before < there.first && same(first - before - 1, there.first - before - 1)) ++before;
    std::size_t behind = 0;
    while (first + behind < one.force.size() && there.first + behind < other.force.size() &&
           same(first + behind, there.first + behind)) {
      ++behind;
    }
    return {there.recording, first - before, there.first - before, before + behind};
  }

  const std::vector<Recording>& recordings_;
  std::uint64_t highest_ = 1;
  std::unordered_map<std::uint64_t, Place> blocks_;
};

}  // namespace

std::vector<Remark> remarks_on_copies(const std::vector<Recording>& recordings) {
  std::vector<Remark> remarks;
  std::map<std::string, std::string> first;  // of the same bytes
  SharedSamples samples(recordings);
  RoundedCopies rounded(recordings);
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Recording& recording = recordings[k];
    const auto [known, fresh] = first.emplace(recording.sha256, recording.file);
    if (!fresh && !recording.sha256.empty()) {
      remarks.push_back({recording.file, Remark::Kind::implausible, "copy",
                         "holds the same bytes as " + known->second + ", so that neither is held out from the other"});
      continue;
    }
    bool told = false;
    for (std::size_t before = 0; before < k; ++before) {
      const auto part = difference_of_copy(recording, recordings[before]);
      if (!part) continue;
      remarks.push_back({recording.file, Remark::Kind::implausible, "near copy",
                         fmt::format("differs from {} by {:.2g} % of the standard deviation of displacement and force, "
                                     "sample by sample, as a copy does: neither is held out from the other",
                                     recordings[before].file, 100.0 * *part)});
      told = true;
      break;
    }
    // A copy of it would share the same samples.
    if (told) continue;
    const bool has_both = recording.displacement.size() == recording.force.size();
    const std::optional<Shared> same = has_both ? samples.longest(k) : std::nullopt;
    if (const auto shared = same ? same : rounded.with_earlier(k)) {
      const auto last = [&](std::size_t from) { return from + shared->count; };
      remarks.push_back({recording.file, Remark::Kind::implausible, "shared samples",
                         fmt::format("samples {} to {} have the displacement and force of samples {} to {} of {}, {}, "
                                     "as a part cut out of one recording has: neither is held out from the other",
                                     shared->first + 1, last(shared->first), shared->first_there + 1,
                                     last(shared->first_there), recordings[shared->recording].file,
                                     same ? "digit for digit" : "but for the rounding of their digits")});
    }
    samples.add(k);
  }
  return remarks;
}

}  // namespace hysteron

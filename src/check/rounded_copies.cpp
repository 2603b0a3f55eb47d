#include "check/rounded_copies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/extent.hpp"
#include "core/squared.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A stretch counts from this part of the shorter recording on, as one of the same digits does, and from so many
// samples.
constexpr std::size_t part = 4;
constexpr std::size_t fewest_samples = 200;

// Stretches are looked for by blocks of so many samples that agree to this part of the spans of displacement and force;
// where digits are coarser than that the loop itself is hardly told.
constexpr std::size_t block = 32;
constexpr double loosely = 0.01;

// A rounded number is within half a step of what was rounded, which may be rounded itself, to a tenth of that step.
constexpr double half_a_step = 0.55;

// No two tests agree to this part of a channel's standard deviation: repeated forces differ by a hundredth at best.
constexpr double rounding = 1e-3;
// Of two tests with noise of their own so many samples would be rounded apart, and none is: enough where the noise of
// ten samples running is one.
constexpr double enough_apart = 100.0;
// What two draws of a standard normal differ by on average.
constexpr double mean_difference = 1.1284;
// Rounding alone looks like a noise of 0.3 steps, up to 0.4 where few samples tell it.
constexpr double noise_in_steps = 0.7;

// A channel of a recording beside the same one of another, of which either may have the coarser numbers, or the one
// among large values and the other among small ones.
class Pair {
 public:
  Pair(const std::vector<double>& one, const DifferentValues& of_one, const std::vector<double>& other,
       const DifferentValues& of_other)
      : one_(one), of_one_(of_one), other_(other), of_other_(of_other) {}

  [[nodiscard]] bool agrees(std::size_t n, std::size_t there) const {
    return std::fabs(one_[n] - other_[there]) <= half_a_step * step(n, there);
  }

  // By which part of its standard deviation over the stretch the channel differs.
  [[nodiscard]] double difference(const Shared& of) const {
    double squares = 0.0;
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (std::size_t n = 0; n < of.count; ++n) {
      const double value = one_[of.first + n] - one_[of.first];
      sum += value;
      sum_of_squares += squared(value);
      squares += squared(one_[of.first + n] - other_[of.first_there + n]);
    }
    const double about_mean = sum_of_squares - squared(sum) / static_cast<double>(of.count);
    return about_mean > 0.0 ? std::sqrt(squares / about_mean) : std::numeric_limits<double>::infinity();
  }

  // How many samples of the stretch would be rounded to another step if the two had noise `sigma` of their own.
  [[nodiscard]] double expected_apart(const Shared& of, double sigma) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < of.count; ++n) {
      const double in_steps = mean_difference * sigma / step(of.first + n, of.first_there + n);
      sum += std::clamp(in_steps - (half_a_step - 0.5), 0.0, 0.5);
    }
    return sum;
  }

 private:
  [[nodiscard]] double step(std::size_t n, std::size_t there) const {
    return std::max(of_one_.gap_at(one_[n]), of_other_.gap_at(other_[there]));
  }

  const std::vector<double>& one_;
  const DifferentValues& of_one_;
  const std::vector<double>& other_;
  const DifferentValues& of_other_;
};

// The noise of the force in the recording whose numbers have less of it, which is the finer one; none where that may be
// rounding alone.
double noise_of_finer(const Recording& one, const DifferentValues& of_one, const Recording& other,
                      const DifferentValues& of_other) {
  const double own = channel_noise(one.time, one.force);
  const double others = channel_noise(other.time, other.force);
  const DifferentValues& finer = own < others ? of_one : of_other;
  const double noise = std::min(own, others);
  return noise < noise_in_steps * finer.smallest_gap() ? 0.0 : noise;
}

// As far as both channels agree from these samples on, to and fro.
Shared extended(const Pair& displacement, const Pair& force, std::size_t size, std::size_t size_there, Shared from) {
  const auto same = [&](std::size_t n, std::size_t there) {
    return force.agrees(n, there) && displacement.agrees(n, there);
  };
  std::size_t before = 0;
  while (before < from.first && before < from.first_there &&
         same(from.first - before - 1, from.first_there - before - 1)) {
    ++before;
  }
  std::size_t behind = 0;
  while (from.first + behind < size && from.first_there + behind < size_there &&
         same(from.first + behind, from.first_there + behind)) {
    ++behind;
  }
  return {from.recording, from.first - before, from.first_there - before, before + behind};
}

// The block of [first, end) in which displacement and force change most, by the spans of theirs; nothing where the rod
// rests throughout, since any two rests are alike.
std::optional<std::size_t> liveliest_block(const Recording& recording, std::size_t first, std::size_t end,
                                           double stroke, double force) {
  std::optional<std::size_t> best;
  double most = loosely;
  for (std::size_t n = first; n + block <= end; n += block) {
    const double lively = span_of(std::span(recording.displacement).subspan(n, block)) / stroke +
                          span_of(std::span(recording.force).subspan(n, block)) / force;
    if (lively > most) {
      most = lively;
      best = n;
    }
  }
  return best;
}

// Calls `visit(place)` for all samples of `recording` from which it goes like the block of `other` from `first` on,
// until it returns true.
template <class Visit>
bool visit_likes(const Recording& other, std::size_t first, const Recording& recording, double stroke, double force,
                 Visit visit) {
  const auto like = [&](std::size_t k, std::size_t n) {
    return std::fabs(recording.force[n + k] - other.force[first + k]) <= loosely * force &&
           std::fabs(recording.displacement[n + k] - other.displacement[first + k]) <= loosely * stroke;
  };
  for (std::size_t n = 0; n + block <= recording.size(); ++n) {
    std::size_t k = 0;
    while (k < block && like(k, n)) ++k;
    if (k == block && visit(n)) return true;
  }
  return false;
}

bool has_both(const Recording& recording) {
  return !recording.force.empty() && recording.displacement.size() == recording.force.size();
}

}  // namespace

DifferentValues::DifferentValues(std::vector<double> values)
    : values_(std::move(values)), smallest_gap_(std::numeric_limits<double>::infinity()) {
  std::ranges::sort(values_);
  values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
  for (std::size_t n = 0; n + 1 < values_.size(); ++n) {
    smallest_gap_ = std::min(smallest_gap_, values_[n + 1] - values_[n]);
  }
}

double DifferentValues::gap_at(double value) const {
  const auto at = std::ranges::lower_bound(values_, value);
  double gap = std::numeric_limits<double>::infinity();
  if (at != values_.begin()) gap = value - *(at - 1);
  if (at != values_.end() && at + 1 != values_.end()) gap = std::min(gap, *(at + 1) - value);
  return gap;
}

const RoundedCopies::Values& RoundedCopies::values_of(std::size_t k) {
  const auto known = values_.find(k);
  if (known != values_.end()) return known->second;
  const Recording& recording = recordings_[k];
  return values_.emplace(k, Values{DifferentValues(recording.displacement), DifferentValues(recording.force)})
      .first->second;
}

std::optional<Shared> RoundedCopies::between(std::size_t k, std::size_t earlier) {
  const Recording& one = recordings_[k];
  const Recording& other = recordings_[earlier];
  const bool one_is_shorter = one.size() < other.size();
  const Recording& shorter = one_is_shorter ? one : other;
  const Recording& longer = one_is_shorter ? other : one;
  const std::size_t fewest = std::max(shorter.size() / part, fewest_samples);
  const double stroke = span_of(shorter.displacement);
  const double force = span_of(shorter.force);
  if (!(stroke > 0.0) || !(force > 0.0)) return std::nullopt;
  const auto judged = [&](std::size_t first, std::size_t first_there) -> std::optional<Shared> {
    const Values& own = values_of(k);
    const Values& others = values_of(earlier);
    const Pair displacements(one.displacement, own.displacement, other.displacement, others.displacement);
    const Pair forces(one.force, own.force, other.force, others.force);
    const Shared found = extended(displacements, forces, one.size(), other.size(), {earlier, first, first_there, 0});
    if (found.count < fewest) return std::nullopt;
    if (displacements.difference(found) <= rounding && forces.difference(found) <= rounding) return found;
    const double noise = noise_of_finer(one, own.force, other, others.force);
    return forces.expected_apart(found, noise) >= enough_apart ? std::optional(found) : std::nullopt;
  };
  // A stretch of `fewest` samples holds one of these parts.
  const std::size_t step = fewest / 2;
  std::optional<Shared> result;
  for (std::size_t first = 0; first + step <= shorter.size() && !result; first += step) {
    const auto place = liveliest_block(shorter, first, first + step, stroke, force);
    if (!place) continue;
    visit_likes(shorter, *place, longer, stroke, force, [&](std::size_t there) {
      result = one_is_shorter ? judged(*place, there) : judged(there, *place);
      return result.has_value();
    });
  }
  return result;
}

std::optional<Shared> RoundedCopies::with_earlier(std::size_t k) {
  if (!has_both(recordings_[k])) return std::nullopt;
  for (std::size_t earlier = 0; earlier < k; ++earlier) {
    if (!has_both(recordings_[earlier])) continue;
    if (const auto found = between(k, earlier)) return found;
  }
  return std::nullopt;
}

}  // namespace hysteron

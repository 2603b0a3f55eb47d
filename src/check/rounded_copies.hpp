// Recordings that share samples but for the digits of their numbers: a part cut out of one and written again.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Samples of a recording that are those of an earlier one.
struct Shared {
  std::size_t recording = 0;  // the earlier one
  std::size_t first = 0;
  std::size_t first_there = 0;
  std::size_t count = 0;
};

// The different values of a channel, in order: what its numbers are rounded to.
class DifferentValues {
 public:
  explicit DifferentValues(std::vector<double> values);
  // Between a value of the channel and the next one above or below, whichever is nearer.
  [[nodiscard]] double gap_at(double value) const;
  [[nodiscard]] double smallest_gap() const { return smallest_gap_; }

 private:
  std::vector<double> values_;
  double smallest_gap_;
};

class RoundedCopies {
 public:
  explicit RoundedCopies(const std::vector<Recording>& recordings) : recordings_(recordings) {}

  // A stretch of recording k, a quarter of the shorter one and two hundred samples at least, in which displacement and
  // force are at every sample what those of an earlier one are rounded to, or the other way round; nothing where two
  // tests with a noise like theirs might agree so.
  [[nodiscard]] std::optional<Shared> with_earlier(std::size_t k);

 private:
  struct Values {
    DifferentValues displacement;
    DifferentValues force;
  };
  const Values& values_of(std::size_t k);
  std::optional<Shared> between(std::size_t k, std::size_t earlier);

  const std::vector<Recording>& recordings_;
  std::map<std::size_t, Values> values_;  // of those that are asked for
};

}  // namespace hysteron

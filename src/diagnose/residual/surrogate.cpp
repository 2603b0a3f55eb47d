#include "diagnose/residual/surrogate.hpp"

#include <algorithm>

#include "core/frequency.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 16;  // of a block
constexpr double blocks_of_no_cycle = 8.0;  // of a motion that has no frequency

}  // namespace

std::vector<std::size_t> half_cycles(const Recording& recording, std::size_t from) {
  const double duration = recording.time.back() - recording.time[from];
  const double frequency = dominant_frequency(recording);
  const double half = frequency > 0.0 ? 0.5 / frequency : duration / blocks_of_no_cycle;
  std::vector<std::size_t> blocks = {0};
  double next = recording.time[from] + half;
  for (std::size_t n = from; n < recording.size(); ++n) {
    if (recording.time[n] >= next && n - from >= blocks.back() + fewest_samples) {
      blocks.push_back(n - from);
      next = recording.time[n] + half;
    }
  }
  // What is over joins the last block.
  const std::size_t size = recording.size() - from;
  if (blocks.size() > 1 && size < blocks.back() + fewest_samples) {
    blocks.back() = size;
  } else {
    blocks.push_back(size);
  }
  return blocks;
}

std::vector<double> surrogate(const std::vector<double>& values, const std::vector<std::size_t>& blocks,
                              const Stream& stream) {
  std::vector<double> result = values;
  for (std::size_t b = 0; b + 1 < blocks.size(); ++b) {
    const auto begin = result.begin() + static_cast<std::ptrdiff_t>(blocks[b]);
    const auto end = result.begin() + static_cast<std::ptrdiff_t>(blocks[b + 1]);
    std::rotate(begin, begin + static_cast<std::ptrdiff_t>(stream.below(blocks[b + 1] - blocks[b], b, 0)), end);
    if (stream.uniform(b, 1) < 0.5) {
      std::transform(begin, end, begin, [](double value) { return -value; });
    }
  }
  return result;
}

}  // namespace hysteron

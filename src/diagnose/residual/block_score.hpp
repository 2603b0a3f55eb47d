// How much better one fit predicts than another: the difference of log scores, block by block, with its standard error.
//   d_b = 1/2 [log(m_b(a) + floor_r) - log(m_b(b) + floor_r)]
// m_b is the mean square of a block of recording r, floor_r the recording's noise: where both are below it, neither is
// better. Blocks are stretches of the motion's own length, not of samples, and motions are the clusters, so that the
// score depends neither on the sampling rate nor on how long or how often a motion was recorded.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron {

// Mean squared residual over normaliser^2 of each block, recording by recording.
using BlockSquares = std::vector<std::vector<double>>;

struct BlockScore {
  double mean = 0.0;       // of d_b over blocks, then over clusters; above zero where b predicts better
  double std_error = 0.0;  // from the spread between clusters
  double agreement = 0.0;  // share of clusters in which b predicts better
  std::size_t clusters = 0;
  double saved = 0.0;  // share of the squared error that b takes off a, each recording weighing the same

  // Mean over standard error, 0 where fewer than two clusters tell nothing.
  [[nodiscard]] double z() const { return std_error > 0.0 ? mean / std_error : 0.0; }
};

// From so many on, motions are clusters, and recordings where fewer motions are; of fewer recordings blocks are.
constexpr std::size_t fewest_clusters = 4;

// `floor` of each recording, in the same units as the squares, and `motions`, the number of its motion. Values that are
// not finite count as the worst there is.
BlockScore block_score(const BlockSquares& a, const BlockSquares& b, const std::vector<double>& floor,
                       const std::vector<std::size_t>& motions);

// Numbers of a vector that differ.
std::size_t count_of(const std::vector<std::size_t>& motions);

// Blocks a recording is cut into: about a cycle of its motion each, between four and sixteen.
std::size_t block_count(double duration, double frequency);

}  // namespace hysteron

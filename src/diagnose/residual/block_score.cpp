#include "diagnose/residual/block_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace hysteron {
namespace {

constexpr std::size_t fewest_blocks = 4;  // of a recording
constexpr std::size_t most_blocks = 16;   // of a recording
// No block counts for more than this, however far a prediction went astray there.
constexpr double most_difference = 3.0;

double difference(double a, double b, double floor) {
  const auto log_of = [&](double squares) {
    return std::isfinite(squares) ? std::log(std::max(squares + floor, 1e-300)) : 700.0;
  };
  return std::clamp(0.5 * (log_of(a) - log_of(b)), -most_difference, most_difference);
}

}  // namespace

std::size_t count_of(const std::vector<std::size_t>& motions) {
  return std::set<std::size_t>(motions.begin(), motions.end()).size();
}

BlockScore block_score(const BlockSquares& a, const BlockSquares& b, const std::vector<double>& floor,
                       const std::vector<std::size_t>& motions) {
  const bool by_motion = count_of(motions) >= fewest_clusters;
  std::map<std::size_t, std::vector<double>> of_motions;
  std::vector<double> clusters;
  double before = 0.0;
  double after = 0.0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a[r].size(); ++k) {
      const double d = difference(a[r][k], b[r][k], floor[r]);
      sum += d;
      before += a[r][k] / static_cast<double>(a[r].size());
      after += b[r][k] / static_cast<double>(a[r].size());
      if (a.size() < fewest_clusters) {
        clusters.push_back(d);
      }
    }
    if (a.size() >= fewest_clusters && !a[r].empty()) {
      of_motions[by_motion ? motions[r] : r].push_back(sum / static_cast<double>(a[r].size()));
    }
  }
  for (const auto& [motion, scores] : of_motions) {
    clusters.push_back(std::accumulate(scores.begin(), scores.end(), 0.0) / static_cast<double>(scores.size()));
  }
  BlockScore result;
  result.clusters = clusters.size();
  result.saved = std::isfinite(before) && std::isfinite(after) && before > 0.0 ? 1.0 - after / before : 0.0;
  if (clusters.size() < 2) {
    return result;
  }
  const auto count = static_cast<double>(clusters.size());
  double better = 0.0;
  for (const double d : clusters) {
    result.mean += d / count;
    better += d > 0.0 ? 1.0 : 0.0;
  }
  double squares = 0.0;
  for (const double d : clusters) {
    squares += (d - result.mean) * (d - result.mean);
  }
  result.std_error = std::sqrt(squares / (count - 1.0) / count);
  result.agreement = better / count;
  return result;
}

std::size_t block_count(double duration, double frequency) {
  const double cycles = std::round(duration * frequency);
  return static_cast<std::size_t>(
      std::clamp(cycles, static_cast<double>(fewest_blocks), static_cast<double>(most_blocks)));
}

}  // namespace hysteron

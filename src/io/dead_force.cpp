#include "io/dead_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/extent.hpp"
#include "core/mean.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

// Share of the force's mean square that displacement, velocity and direction explain, from which on it follows the
// motion: they explain a hundredth and less of noise, and of the force of a damper nearly all.
constexpr double follows = 0.05;
// A tenth of the weakest other force at that speed: a damper is by less weaker in another test with the same setting,
// and where its current is off its force follows the motion.
constexpr double weaker = 0.1;
constexpr std::size_t fewest_samples = 50;

using Terms = std::array<std::vector<double>, 3>;

void centre(std::vector<double>& values) {
  const double mean = mean_of(values);
  for (double& value : values) value -= mean;
}

double product_of(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// By Gram and Schmidt, one term after the other.
double share_that_follows(const Recording& recording) {
  Terms terms = {recording.displacement, recording.velocity, recording.velocity};
  for (double& value : terms[2]) value = value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0);
  std::vector<double> force = recording.force;
  centre(force);
  const double all = product_of(force, force);
  if (!(all > 0.0)) return 0.0;
  double explained = 0.0;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    centre(terms[k]);
    const double whole = product_of(terms[k], terms[k]);
    for (std::size_t j = 0; j < k; ++j) {
      const double square = product_of(terms[j], terms[j]);
      if (!(square > 0.0)) continue;
      const double part = product_of(terms[k], terms[j]) / square;
      for (std::size_t n = 0; n < force.size(); ++n) terms[k][n] -= part * terms[j][n];
    }
    constexpr double rounded = 1e-12;
    const double own = product_of(terms[k], terms[k]);
    if (own > rounded * whole) explained += squared(product_of(force, terms[k])) / own;
  }
  return explained / all;
}

double rms_of(std::vector<double> values) {
  centre(values);
  return std::sqrt(product_of(values, values) / static_cast<double>(values.size()));
}

bool is_complete(const Recording& recording) {
  return recording.size() >= fewest_samples && recording.displacement.size() == recording.size() &&
         recording.velocity.size() == recording.size() && recording.force.size() == recording.size();
}

}  // namespace

std::vector<DeadForce> dead_forces_of(const std::vector<Recording>& recordings) {
  if (!std::ranges::all_of(recordings, is_complete)) return {};
  std::vector<std::size_t> alive;
  std::vector<std::size_t> silent;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    (share_that_follows(recordings[k]) < follows ? silent : alive).push_back(k);
  }
  if (silent.empty() || alive.size() <= silent.size()) return {};
  std::vector<DeadForce> dead;
  for (const std::size_t k : silent) {
    const double speed = rms_of(recordings[k].velocity);
    double shortest = std::numeric_limits<double>::infinity();
    double expected = std::numeric_limits<double>::infinity();
    for (const std::size_t j : alive) {
      shortest = std::min(shortest, span_of(recordings[j].displacement));
      // A force grows with the speed, or stays as it is.
      const double slower = std::min(1.0, speed / rms_of(recordings[j].velocity));
      expected = std::min(expected, slower * rms_of(recordings[j].force));
    }
    const double rms = rms_of(recordings[k].force);
    if (!(span_of(recordings[k].force) > 0.0)) continue;  // refused as constant
    if (span_of(recordings[k].displacement) >= shortest && rms < weaker * expected) dead.push_back({k, rms, expected});
  }
  return dead;
}

std::string sentence_of(const DeadForce& dead) {
  return fmt::format(
      "the force follows nothing of the motion and scatters by {:.3g} N (RMS), where the other recordings have "
      "{:.3g} N and more at such a speed: a load cell that was not connected looks so; leave this recording out",
      dead.rms, dead.expected);
}

}  // namespace hysteron

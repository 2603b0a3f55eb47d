#include "core/frequency.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/robust.hpp"

namespace hysteron {
namespace {

// Of the span, that the displacement goes back by where it has turned.
constexpr double least_swing = 0.1;
// Half periods within this share of their median, or within so many samples, belong to one frequency: where there is
// one, sampling alone makes them differ by a sample.
constexpr double alike_share = 0.05;
constexpr double alike_samples = 1.01;

// When the displacement turns at or beside this sample: the vertex of a parabola through it and its neighbours.
double turn_at(const Recording& recording, std::size_t n) {
  const std::vector<double>& x = recording.displacement;
  if (n == 0 || n + 1 >= x.size()) {
    return recording.time[n];
  }
  const double bend = x[n - 1] - 2.0 * x[n] + x[n + 1];
  const double off = bend != 0.0 ? std::clamp(0.5 * (x[n - 1] - x[n + 1]) / bend, -0.5, 0.5) : 0.0;
  return recording.time[n] + off * 0.5 * (recording.time[n + 1] - recording.time[n - 1]);
}

// Times at which the displacement turns, but for its ends.
std::vector<double> turns_of(const Recording& recording) {
  const auto& x = recording.displacement;
  if (x.size() < 3) {
    return {};
  }
  const auto [low, high] = std::ranges::minmax(x);
  const double threshold = least_swing * (high - low);
  if (!(threshold > 0.0)) {
    return {};
  }
  std::vector<double> turns;
  double extreme = x[0];
  std::size_t at = 0;
  int direction = 0;
  for (std::size_t n = 1; n < x.size(); ++n) {
    const bool further = direction >= 0 ? x[n] > extreme : x[n] < extreme;
    if (direction == 0) {
      if (std::fabs(x[n] - x[0]) > threshold) {
        direction = x[n] > x[0] ? 1 : -1;
        extreme = x[n];
        at = n;
      }
    } else if (further) {
      extreme = x[n];
      at = n;
    } else if (std::fabs(x[n] - extreme) > threshold) {
      turns.push_back(turn_at(recording, at));
      direction = -direction;
      extreme = x[n];
      at = n;
    }
  }
  return turns;
}

}  // namespace

double dominant_frequency(const Recording& recording) {
  const std::vector<double> turns = turns_of(recording);
  if (turns.size() < 2) {
    return 0.0;
  }
  std::vector<double> halves;
  for (std::size_t k = 1; k < turns.size(); ++k) {
    halves.push_back(turns[k] - turns[k - 1]);
  }
  const double median = median_of(halves);
  // In the mean of those like the median the errors of their ends cancel.
  const double step = (recording.time.back() - recording.time.front()) / static_cast<double>(recording.size() - 1);
  const double alike = std::max(alike_share * median, alike_samples * step);
  double sum = 0.0;
  double count = 0.0;
  for (const double half : halves) {
    if (std::fabs(half - median) <= alike) {
      sum += half;
      count += 1.0;
    }
  }
  return 0.5 * count / sum;
}

}  // namespace hysteron

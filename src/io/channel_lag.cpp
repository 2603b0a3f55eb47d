#include "io/channel_lag.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A velocity channel beside the slope of the displacement, both over the peak of the slope so that recordings count
// alike.
struct VelocityPair {
  const std::vector<double>* time;
  std::vector<double> recorded;
  std::vector<double> slope;
};

// y behind a first-order filter of time constant tau, for y straight between samples.
std::vector<double> filtered(const std::vector<double>& time, const std::vector<double>& y, double tau) {
  std::vector<double> result(y.size(), y.front());
  for (std::size_t n = 1; n < y.size(); ++n) {
    const double step = time[n] - time[n - 1];
    const double slope = (y[n] - y[n - 1]) / step;
    const double lagging = y[n - 1] - tau * slope;
    result[n] = y[n] - tau * slope + (result[n - 1] - lagging) * std::exp(-step / tau);
  }
  return result;
}

struct LagEquation {
  double cross = 0.0;       // zero at the lag; it falls with tau
  double energy = 0.0;      // sum of squared accelerations
  double squares = 0.0;     // of the differences of the channels
  double neighbours = 0.0;  // products of neighbouring differences
  std::size_t samples = 0;
};

// The differences of the channels against the acceleration, once the one ahead went through the filter: white noise of
// either does not correlate with its own slope, so that it does not shift the zero.
LagEquation lag_equation(const std::vector<VelocityPair>& pairs, bool recorded_lags, double tau) {
  LagEquation result;
  for (const VelocityPair& pair : pairs) {
    const std::vector<double>& time = *pair.time;
    const std::vector<double>& behind = recorded_lags ? pair.recorded : pair.slope;
    const std::vector<double>& ahead = recorded_lags ? pair.slope : pair.recorded;
    const std::vector<double> delayed = tau > 0.0 ? filtered(time, ahead, tau) : ahead;
    double before = 0.0;
    for (std::size_t n = 1; n + 1 < time.size(); ++n) {
      const double acceleration = (delayed[n + 1] - delayed[n - 1]) / (time[n + 1] - time[n - 1]);
      const double difference = behind[n] - delayed[n];
      result.cross -= difference * acceleration;
      result.energy += acceleration * acceleration;
      result.squares += difference * difference;
      result.neighbours += difference * before;
      before = difference;
      ++result.samples;
    }
  }
  return result;
}

}  // namespace

std::optional<ChannelLag> velocity_channel_lag(std::span<const Recording> recordings) {
  constexpr double longest = 0.2;  // s
  std::vector<VelocityPair> pairs;
  for (const Recording& recording : recordings) {
    if (!recording.velocity_measured || recording.size() < 16) {
      continue;
    }
    VelocityPair pair{&recording.time, recording.velocity, derive_velocity(recording.time, recording.displacement)};
    double peak = 1e-12;
    for (const double v : pair.slope) {
      peak = std::max(peak, std::fabs(v));
    }
    for (std::size_t n = 0; n < pair.slope.size(); ++n) {
      pair.recorded[n] /= peak;
      pair.slope[n] /= peak;
    }
    pairs.push_back(std::move(pair));
  }
  const LagEquation together = lag_equation(pairs, true, 0.0);
  if (together.samples == 0 || !(together.energy > 0.0)) {
    return std::nullopt;
  }
  const bool recorded_lags = together.cross > 0.0;
  double low = 0.0;
  double high = longest;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (low + high);
    (lag_equation(pairs, recorded_lags, middle).cross > 0.0 ? low : high) = middle;
  }
  const double lag = 0.5 * (low + high);
  const LagEquation at = lag_equation(pairs, recorded_lags, lag);
  const double r = at.squares > 0.0 ? std::clamp(at.neighbours / at.squares, 0.0, 0.99) : 0.0;
  const double variance = at.squares / static_cast<double>(at.samples);
  return ChannelLag{recorded_lags ? lag : -lag, std::sqrt(variance / at.energy * (1.0 + r) / (1.0 - r))};
}

}  // namespace hysteron

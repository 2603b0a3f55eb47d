#include "io/velocity.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "io/local_cubic.hpp"
#include "io/local_window.hpp"
#include "io/neighbours.hpp"

namespace hysteron {
namespace {

constexpr double most_on_a_side = 500.0;  // bounds the work; reached only by very long, very noisy cycles

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The step of a quantised signal, 0 when its increments are not multiples of the smallest one. Steps that mostly repeat
// the one before are a motion at constant speed, not a quantum.
double quantum_of(std::span<const double> x, double range) {
  const double nothing = 1e-9 * range;
  double smallest = range;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double step = std::abs(x[i] - x[i - 1]);
    if (step > nothing) smallest = std::min(smallest, step);
  }
  std::size_t multiples = 0;
  std::size_t moves = 0;
  std::size_t repeats = 0;
  double before = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double step = x[i] - x[i - 1];
    const double steps = std::abs(step) / smallest;
    if (std::abs(steps - std::round(steps)) < 0.05) ++multiples;
    if (std::abs(step) > nothing) {
      ++moves;
      if (std::abs(step - before) < 0.05 * smallest) ++repeats;
    }
    before = step;
  }
  if (repeats * 10 > moves * 9) return 0.0;
  return multiples * 20 >= (x.size() - 1) * 19 ? smallest : 0.0;
}

// Standard deviation of the displacement noise: each sample against the quintic through its six neighbours, by median.
double noise_of(std::span<const double> t, std::span<const double> x) {
  std::vector<double> errors;
  errors.reserve(x.size());
  for (std::size_t i = quintic_reach; i + quintic_reach < x.size(); ++i) errors.push_back(off_neighbours(t, x, i));
  return 1.4826 * quantile(errors, 0.5);
}

// Twice the tenth percentile of the times between reversals of more than `threshold`; the whole duration without any.
double short_period(std::span<const double> t, std::span<const double> x, double threshold) {
  std::vector<double> half_periods;
  double low = x[0];
  double high = x[0];
  double low_at = t[0];
  double high_at = t[0];
  double last = t[0];
  int direction = 0;
  int reversals = 0;
  // The stretch before the first reversal is not a half period.
  const auto reverse = [&](double at) {
    if (reversals++ > 0) half_periods.push_back(at - last);
    last = at;
  };
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > high) high = x[i], high_at = t[i];
    if (x[i] < low) low = x[i], low_at = t[i];
    if (direction >= 0 && high - x[i] > threshold) {
      if (direction > 0) reverse(high_at);
      direction = -1;
      low = x[i], low_at = t[i];
      high = x[i], high_at = t[i];
    } else if (direction <= 0 && x[i] - low > threshold) {
      if (direction < 0) reverse(low_at);
      direction = 1;
      low = x[i], low_at = t[i];
      high = x[i], high_at = t[i];
    }
  }
  return half_periods.empty() ? t.back() - t.front() : 2.0 * quantile(half_periods, 0.1);
}

// Samples on each side of the window; the formulas are those of a uniform grid of spacing dt.
double samples_on_a_side(std::span<const double> t, std::span<const double> x, double dt) {
  const auto [low, high] = std::ranges::minmax_element(x);
  const double range = *high - *low;
  constexpr auto fewest = static_cast<double>(fewest_on_a_side);
  if (range <= 0.0) return fewest;
  const double noise = channel_noise(t, x);
  const double period = short_period(t, x, std::max(0.05 * range, 6.0 * noise));

  // Peak velocity from chords of a twelfth of a period, long enough not to see the noise.
  std::vector<double> speeds;
  speeds.reserve(x.size());
  for (std::size_t i = 0, j = 0; j < x.size(); ++i) {
    while (j < x.size() && t[j] - t[i] < period / 12.0) ++j;
    if (j < x.size()) speeds.push_back(std::abs(x[j] - x[i]) / (t[j] - t[i]));
  }
  const double peak = quantile(speeds, 0.95);
  if (peak <= 0.0) return fewest;

  // A cubic over 2h+1 samples has velocity noise sqrt(75/8) noise / (dt h^1.5).
  const double unit_noise = std::sqrt(9.375) * noise / (dt * peak);
  const auto limit = [&](double part) { return std::clamp(period / (part * dt), fewest, most_on_a_side); };
  const double wanted = std::pow(unit_noise / 1e-3, 2.0 / 3.0);
  const double cap = limit(24.0);
  if (wanted <= cap) return std::max(fewest, std::ceil(wanted));
  const double tolerable = std::pow(unit_noise / 1e-2, 2.0 / 3.0);
  return std::floor(std::clamp(tolerable, cap, limit(12.0)));
}

// Straight line through samples [first, last].
struct Line {
  double middle;    // s
  double value;     // m, at the middle
  double slope;     // m/s
  double residual;  // m, RMS
};

Line line_through(std::span<const double> t, std::span<const double> x, std::size_t first, std::size_t last) {
  const auto count = static_cast<double>(last - first + 1);
  Line line{0.0, 0.0, 0.0, 0.0};
  for (std::size_t i = first; i <= last; ++i) {
    line.middle += (t[i] - t[first]) / count;
    line.value += (x[i] - x[first]) / count;
  }
  line.middle += t[first];
  line.value += x[first];
  double moment = 0.0;
  double spread = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    moment += (t[i] - line.middle) * (x[i] - line.value);
    spread += (t[i] - line.middle) * (t[i] - line.middle);
  }
  line.slope = moment / spread;
  for (std::size_t i = first; i <= last; ++i) {
    const double away = x[i] - line.value - line.slope * (t[i] - line.middle);
    line.residual += away * away / count;
  }
  line.residual = std::sqrt(line.residual);
  return line;
}

// What a sample differs by from a line beside it, over what the line's own residual or the noise explains; the line is
// the one through samples [first, last].
double off_line(std::span<const double> t, std::span<const double> x, std::size_t first, std::size_t last,
                std::size_t sample, double noise) {
  const Line line = line_through(t, x, first, last);
  const auto count = static_cast<double>(last - first + 1);
  double spread = 0.0;
  for (std::size_t i = first; i <= last; ++i) spread += (t[i] - line.middle) * (t[i] - line.middle);
  const double away = t[sample] - line.middle;
  const double deviation = std::max(noise, line.residual) * std::sqrt(1.0 + 1.0 / count + away * away / spread);
  return std::abs(x[sample] - line.value - line.slope * away) / deviation;
}

// Whether more than the sample nearest to a corner behind sample `last` is off its line on either side.
bool is_rounded(std::span<const double> t, std::span<const double> x, std::size_t last, std::size_t reach,
                double noise) {
  return std::max(off_line(t, x, last + 1 - reach, last - 2, last - 1, noise),
                  off_line(t, x, last + 3, last + reach, last + 2, noise)) > beyond_noise;
}

struct Corner {
  std::size_t last;  // sample before it
  double time;       // s
  double doubt;      // s, that its time is not known better than
  double speed;      // m/s, mean of before and after
};

// Corners of a displacement made of straight lines, as of triangle waves and ramps. `side` is the half window that
// would round them. A corner is where the lines through `reach` samples before and after it meet between these samples,
// bend by a good part of the speed, and miss their samples by so little of the bend that no arc as smooth as the window
// fits (an arc of constant curvature misses by 0.037 of it), nor one of four samples and more.
std::vector<Corner> corners_of(std::span<const double> t, std::span<const double> x, std::size_t side,
                               double median_step, double noise) {
  constexpr double least_bend = 0.2;  // of the peak speed
  constexpr double straight = 0.006;  // residual over bend times reach
  // Noise shifts the ends of lines through eight samples and more, and with them where they meet, by a residual over
  // the bend (standard deviation), an arc by three. Times in digits are not known better than a part of a step.
  constexpr double residuals = 3.0;
  constexpr double digits = 1e-3;
  constexpr std::size_t most_reach = 200;
  const std::size_t n = x.size();
  const std::size_t reach = std::clamp<std::size_t>(2 * side, 8, most_reach);
  std::vector<Corner> result;
  if (n < 2 * reach + 2) return result;
  std::vector<double> speeds;
  for (std::size_t i = 0; i + reach < n; i += reach / 4) {
    speeds.push_back(std::abs(x[i + reach] - x[i]) / (t[i + reach] - t[i]));
  }
  const double peak = quantile(speeds, 0.95);
  double best = 0.0;
  for (std::size_t i = reach - 1; i + reach < n; ++i) {
    // A stretch with a gap tells nothing of corners.
    if (t[i + reach] - t[i + 1 - reach] > 3.0 * static_cast<double>(reach) * median_step) continue;
    // Chords first: they cost nothing.
    const double before = (x[i] - x[i + 1 - reach]) / (t[i] - t[i + 1 - reach]);
    const double after = (x[i + reach] - x[i + 1]) / (t[i + reach] - t[i + 1]);
    if (!(std::abs(after - before) > 0.5 * least_bend * peak)) continue;
    const Line left = line_through(t, x, i + 1 - reach, i);
    const Line right = line_through(t, x, i + 1, i + reach);
    const double bend = right.slope - left.slope;
    if (!(std::abs(bend) > least_bend * peak)) continue;
    const double missed = std::max(left.residual, right.residual) / (std::abs(bend) * (right.middle - left.middle));
    if (missed > straight) continue;
    const double meet = (left.value - right.value - left.slope * left.middle + right.slope * right.middle) / bend;
    const double slack = 0.5 * (t[i + 1] - t[i]);
    if (meet < t[i] - slack || meet > t[i + 1] + slack) continue;
    if (is_rounded(t, x, i, reach, std::max(noise, digits * slack * std::abs(bend)))) continue;
    const double doubt = std::max(residuals * std::max(left.residual, right.residual) / std::abs(bend), digits * slack);
    const Corner corner{i, meet, doubt, 0.5 * (left.slope + right.slope)};
    if (!result.empty() && i - result.back().last < reach) {
      if (missed < best) result.back() = corner, best = missed;
    } else {
      result.push_back(corner);
      best = missed;
    }
  }
  return result;
}

double median_step_of(std::span<const double> time) {
  std::vector<double> steps(time.size());
  std::adjacent_difference(time.begin(), time.end(), steps.begin());
  steps.erase(steps.begin());
  return quantile(steps, 0.5);
}

// Slopes of y by `slopes_of` over windows of `side` samples on each side that do not reach across corners.
std::vector<double> slopes_between(const std::vector<Corner>& corners, decltype(local_cubic_slopes)& slopes_of,
                                   std::span<const double> time, std::span<const double> y, double side,
                                   double median_step, double noise) {
  std::vector<double> slopes(time.size(), 0.0);
  std::size_t first = 0;
  const auto derive_to = [&](std::size_t last) {
    const std::size_t count = last + 1 - first;
    slopes_of(time.subspan(first, count), y.subspan(first, count), side, median_step, noise,
              std::span(slopes).subspan(first, count));
    first = last + 1;
  };
  for (const Corner& corner : corners) derive_to(corner.last);
  derive_to(time.size() - 1);
  return slopes;
}

// Samples within `near` of a corner, s, and a quarter of a step: on it neither side's slope holds.
std::vector<std::size_t> samples_on(const Corner& corner, std::span<const double> time, double near) {
  const double most = std::min(near, 0.25 * (time[corner.last + 1] - time[corner.last]));
  std::vector<std::size_t> result;
  for (const std::size_t i : {corner.last, corner.last + 1}) {
    if (std::abs(corner.time - time[i]) < most) result.push_back(i);
  }
  return result;
}

}  // namespace

double channel_noise(std::span<const double> time, std::span<const double> samples) {
  assert(time.size() == samples.size());
  if (samples.size() < 8) return 0.0;
  return std::max(noise_of(time, samples), channel_quantum(samples) / std::sqrt(12.0));
}

double channel_quantum(std::span<const double> samples) {
  if (samples.size() < 2) return 0.0;
  const auto [low, high] = std::ranges::minmax_element(samples);
  return quantum_of(samples, *high - *low);
}

std::vector<double> derive_velocity(std::span<const double> time, std::span<const double> displacement) {
  assert(time.size() == displacement.size());
  const std::size_t n = time.size();
  if (n < 2) return std::vector<double>(n, 0.0);

  const double median_step = median_step_of(time);
  const double side = n > 7 ? samples_on_a_side(time, displacement, median_step) : 2.0;
  const double noise = channel_noise(time, displacement);
  const std::vector<Corner> corners =
      corners_of(time, displacement, static_cast<std::size_t>(side), median_step, noise);
  std::vector<double> velocity =
      slopes_between(corners, local_window_slopes, time, displacement, side, median_step, noise);
  // A sample on the corner has the speed of neither side: with the mean, the motion between samples does not overshoot.
  // One beside it, as far as can be told, has that of its own side.
  for (const Corner& corner : corners) {
    for (const std::size_t i : samples_on(corner, time, corner.doubt)) velocity[i] = corner.speed;
  }
  return velocity;
}

double derived_velocity_noise(std::span<const double> time, std::span<const double> displacement) {
  if (time.size() < 8) return 0.0;
  const double step = median_step_of(time);
  const std::vector<double> weights =
      uniform_weights(static_cast<std::size_t>(samples_on_a_side(time, displacement, step)));
  const double squares = std::inner_product(weights.begin(), weights.end(), weights.begin(), 0.0);
  return channel_noise(time, displacement) * std::sqrt(squares) / step;
}

std::vector<double> derive_acceleration(std::span<const double> time, std::span<const double> displacement,
                                        std::span<const double> velocity, bool measured) {
  assert(time.size() == velocity.size() && time.size() == displacement.size());
  constexpr std::array<std::size_t, 13> sides = {2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64, 91, 128};
  const std::size_t n = time.size();
  if (n < 2) return std::vector<double>(n, 0.0);
  const double step = median_step_of(time);
  const double of_velocity = n > 7 ? samples_on_a_side(time, displacement, step) : 2.0;
  const std::vector<Corner> corners =
      corners_of(time, displacement, static_cast<std::size_t>(of_velocity), step, channel_noise(time, displacement));
  // For the windows beside a corner the sample on it belongs to neither line. A sensor of the velocity rounds it.
  std::vector<double> beside(velocity.begin(), velocity.end());
  for (const Corner& corner : corners) {
    const double near = measured ? std::numeric_limits<double>::infinity() : corner.doubt;
    for (const std::size_t i : samples_on(corner, time, near)) {
      const bool before = i == corner.last;
      if (before ? i > 0 : i + 1 < n) beside[i] = velocity[before ? i - 1 : i + 1];
    }
  }
  // On a corner itself the change of velocity happens within as few samples as can show it.
  // The noise of a derived velocity is that of the displacement over its window, and alike over as many samples.
  const double end_noise = measured ? channel_noise(time, velocity)
                                    : std::sqrt(2.0 * 9.375) * channel_noise(time, displacement) / (step * of_velocity);
  const auto slopes_over = [&](double side) {
    std::vector<double> slopes = slopes_between(corners, local_cubic_slopes, time, beside, side, step, end_noise);
    for (const Corner& corner : corners) {
      for (std::size_t i = std::max<std::size_t>(corner.last, 2) - 1; i < std::min(corner.last + 3, n - 1); ++i) {
        slopes[i] = (velocity[i + 1] - velocity[i - 1]) / (time[i + 1] - time[i - 1]);
      }
    }
    return slopes;
  };
  if (!measured || n < 8) return slopes_over(of_velocity);

  std::vector<double> best = slopes_over(static_cast<double>(sides.front()));
  const std::vector<double> reference = best;
  const double noise = channel_noise(time, velocity) / step;
  const std::vector<double> shortest = uniform_weights(sides.front());
  double least = noise * noise * std::inner_product(shortest.begin(), shortest.end(), shortest.begin(), 0.0);
  for (const std::size_t side : std::span(sides).subspan(1)) {
    if (8 * side > n) break;
    const std::vector<double> weights = uniform_weights(side);
    double of_difference = 0.0;
    double of_noise = 0.0;
    for (std::size_t j = 0; j < weights.size(); ++j) {
      const std::size_t shift = side - sides.front();
      const double other = j < shift || j >= shift + shortest.size() ? 0.0 : shortest[j - shift];
      of_difference += (weights[j] - other) * (weights[j] - other);
      of_noise += weights[j] * weights[j];
    }
    std::vector<double> slopes = slopes_over(static_cast<double>(side));
    double difference = 0.0;
    for (std::size_t i = 0; i < n; ++i) difference += (slopes[i] - reference[i]) * (slopes[i] - reference[i]);
    const double bias = std::max(difference / static_cast<double>(n) - noise * noise * of_difference, 0.0);
    const double error = bias + noise * noise * of_noise;
    if (error < least) {
      least = error;
      best = std::move(slopes);
    }
  }
  return best;
}

}  // namespace hysteron

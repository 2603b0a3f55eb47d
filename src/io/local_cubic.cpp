#include "io/local_cubic.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// weights . x = slope at u = 0 of the least-squares cubic through (u, x), by orthogonal polynomials (Forsythe 1957).
// Points too clustered for a cubic get the highest degree they carry. Given x and its noise, the degree is the highest,
// at least one, whose part of x is more than twice the noise; returns the mean square of what the cubic leaves of x.
double slope_weights(std::span<const double> u, std::vector<double>& weights, std::vector<double>& p,
                     std::vector<double>& previous, std::span<const double> x = {}, double noise = 0.0) {
  const std::size_t n = u.size();
  std::vector<double> told;
  double left = 0.0;
  for (const double value : x) left += (value - x[0]) * (value - x[0]);
  weights.assign(n, 0.0);
  p.assign(n, 1.0);
  previous.assign(n, 0.0);
  double value = 1.0;  // of p and of the polynomial before it, at u = 0
  double value_before = 0.0;
  double slope = 0.0;
  double slope_before = 0.0;
  double norm_before = 1.0;
  double first_norm = 0.0;
  for (int degree = 0; degree <= 3; ++degree) {
    double norm = 0.0;
    double moment = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      norm += p[j] * p[j];
      moment += u[j] * p[j] * p[j];
    }
    if (degree == 0) first_norm = norm;
    if (norm < 1e-14 * first_norm) break;
    for (std::size_t j = 0; j < n; ++j) weights[j] += p[j] * slope / norm;
    if (!x.empty()) {
      double part = 0.0;
      for (std::size_t j = 0; j < n; ++j) part += p[j] * (x[j] - x[0]) / std::sqrt(norm);
      left -= part * part;
      if (degree <= 1 || std::abs(part) > 2.0 * noise) told = weights;
    }
    const double a = moment / norm;
    const double b = degree == 0 ? 0.0 : norm / norm_before;
    for (std::size_t j = 0; j < n; ++j) {
      const double next = (u[j] - a) * p[j] - b * previous[j];
      previous[j] = p[j];
      p[j] = next;
    }
    const double next_value = -a * value - b * value_before;
    const double next_slope = value - a * slope - b * slope_before;
    value_before = value;
    slope_before = slope;
    value = next_value;
    slope = next_slope;
    norm_before = norm;
  }
  if (!x.empty()) weights = told;
  return std::max(left, 0.0) / std::max(static_cast<double>(n) - 4.0, 1.0);
}

bool is_uniform(std::span<const double> t, double dt) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (std::abs(t[i] - t[0] - static_cast<double>(i) * dt) > 1e-3 * dt) return false;
  }
  return true;
}

// Slope at sample i, near an end, where the window is `length` steps long at most. There the cubic has no samples on
// one side: it passes on many times as much noise, and what it misses of a start or a stop. The window is halved until
// the cubic leaves no more than the noise, and the degree is what the noise allows to tell.
double slope_at_an_end(std::span<const double> t, std::span<const double> x, std::size_t i, std::size_t length,
                       double noise) {
  std::vector<double> u;
  std::vector<double> weights;
  std::vector<double> p;
  std::vector<double> previous;
  for (;;) {
    const std::size_t begin = std::min(i - std::min(i, length / 2), t.size() - 1 - length);
    const std::size_t count = length + 1;
    const double scale = t[begin + length] - t[begin];
    u.resize(count);
    for (std::size_t j = 0; j < count; ++j) u[j] = (t[begin + j] - t[i]) / scale;
    const double left = slope_weights(u, weights, p, previous, x.subspan(begin, count), noise);
    const double doubt = 3.0 * std::sqrt(2.0 / static_cast<double>(count));
    if (left <= (1.0 + doubt) * noise * noise || length < 4 * fewest_on_a_side) {
      double slope = 0.0;
      for (std::size_t j = 0; j < count; ++j) slope += weights[j] / scale * (x[begin + j] - x[i]);
      return slope;
    }
    length /= 2;
  }
}

}  // namespace

void local_cubic_slopes(std::span<const double> time, std::span<const double> displacement, double side,
                        double median_step, double noise, std::span<double> velocity) {
  const std::size_t n = time.size();
  if (n < 2) return;
  const auto h = static_cast<std::size_t>(side);
  const double half_width = (side + 0.25) * median_step;  // s; the quarter keeps rounded times inside

  const double mean_step = (time.back() - time.front()) / static_cast<double>(n - 1);
  const bool uniform = is_uniform(time, mean_step);

  std::vector<double> u;
  std::vector<double> weights;
  std::vector<double> p;
  std::vector<double> previous;
  bool weights_of_the_middle = false;
  std::size_t first = 0;
  std::size_t last = 0;  // inclusive
  for (std::size_t i = 0; i < n; ++i) {
    const bool middle = uniform && i >= h && i + h < n;
    if (uniform) {
      // At the ends the window keeps its length and stops at the first or last sample.
      first = i < h ? 0 : i - h;
      last = std::min(n - 1, first + 2 * h);
      first = last >= 2 * h ? last - 2 * h : 0;
    } else {
      while (time[first] < time[i] - half_width) ++first;
      last = std::max(last, i);
      while (last + 1 < n && time[last + 1] <= time[i] + half_width) ++last;
    }
    std::size_t begin = first;
    std::size_t end = last;
    if (!uniform) {
      // At the ends and beside gaps the window reaches twice as far on its other side, then to the nearest samples
      // until it holds five.
      const double half = 0.5 * half_width;
      const bool cut_left = time[i] - time[begin] < half;
      const bool cut_right = time[end] - time[i] < half;
      while (cut_left && end + 1 < n && time[end + 1] <= time[i] + 2.0 * half_width) ++end;
      while (cut_right && begin > 0 && time[begin - 1] >= time[i] - 2.0 * half_width) --begin;
      while (end - begin < 2 * fewest_on_a_side && (begin > 0 || end + 1 < n)) {
        const bool left = end + 1 == n || (begin > 0 && time[i] - time[begin - 1] <= time[end + 1] - time[i]);
        if (left) {
          --begin;
        } else {
          ++end;
        }
      }
    }
    if ((begin == 0 && i < h) || (end + 1 == n && i + h >= n)) {
      velocity[i] = slope_at_an_end(time, displacement, i, end - begin, noise);
      continue;
    }
    if (!(middle && weights_of_the_middle)) {
      const double scale = uniform ? mean_step * side : half_width;
      u.resize(end - begin + 1);
      for (std::size_t j = begin; j <= end; ++j) {
        u[j - begin] =
            (uniform ? (static_cast<double>(j) - static_cast<double>(i)) * mean_step : time[j] - time[i]) / scale;
      }
      slope_weights(u, weights, p, previous);
      for (double& weight : weights) weight /= scale;
      weights_of_the_middle = middle;
    }
    double slope = 0.0;
    for (std::size_t j = begin; j <= end; ++j) {
      slope += weights[j - begin] * (displacement[j] - displacement[i]);
    }
    velocity[i] = slope;
  }
}

std::vector<double> uniform_weights(std::size_t side) {
  std::vector<double> u(2 * side + 1);
  for (std::size_t j = 0; j < u.size(); ++j) u[j] = static_cast<double>(j) - static_cast<double>(side);
  std::vector<double> weights;
  std::vector<double> p;
  std::vector<double> previous;
  slope_weights(u, weights, p, previous);
  return weights;
}

}  // namespace hysteron

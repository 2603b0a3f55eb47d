#include "diagnose/signal/thin.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "fit/start.hpp"
#include "io/velocity.hpp"
#include "simulate/motion.hpp"

namespace hysteron {
namespace {

// Factors that are tried: all of these, then these times powers of two.
constexpr std::array<std::size_t, 12> factors = {2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 28};
constexpr std::size_t fewest_kept = 100;
constexpr double displacement_error = 1e-3;
constexpr double velocity_error = 1e-2;

double deviation(const std::vector<double>& values) {
  double sum = 0.0;
  double square = 0.0;
  for (const double value : values) {
    sum += value;
    square += value * value;
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(std::max(square / count - sum * sum / (count * count), 0.0));
}

// Whether the recording's motion follows from the part that holds every k-th sample. `x_noise` and `v_noise` are the
// noise of the recorded channels that the part does not have.
bool recovers(const Recording& whole, const Recording& part, std::size_t k, double x_noise, double v_noise) {
  const Motion motion = make_motion(part.time, part.displacement, part.velocity, {});
  double x_error = 0.0;
  double v_error = 0.0;
  double count = 0.0;
  for (std::size_t n = 0; n < motion.intervals.size(); ++n) {
    for (std::size_t m = 1; m < k && n * k + m < whole.size(); ++m) {
      const std::size_t at = n * k + m;
      const double theta = (whole.time[at] - part.time[n]) / motion.intervals[n].length;
      const MotionCourse& course = course_from(motion, motion.intervals[n], theta);
      const double x = cubic(course.x, theta) - whole.displacement[at];
      const double v = cubic(course.v, theta) - whole.velocity[at];
      x_error += x * x;
      v_error += v * v;
      count += 1.0;
    }
  }
  x_error = std::max(0.0, x_error / count - x_noise * x_noise);
  v_error = std::max(0.0, v_error / count - v_noise * v_noise);
  return std::sqrt(x_error) <= displacement_error * deviation(whole.displacement) &&
         std::sqrt(v_error) <= velocity_error * deviation(whole.velocity);
}

// Values at every k-th sample of cubics fitted by least squares to the samples within k of it.
std::vector<double> smoothed(const std::vector<double>& time, const std::vector<double>& values, std::size_t k) {
  std::vector<double> result;
  for (std::size_t n = 0; n < values.size(); n += k) {
    const std::size_t first = n - std::min(n, k);
    const std::size_t last = std::min(values.size() - 1, n + k);
    const double width = std::max(time[n] - time[first], time[last] - time[n]);
    Eigen::Matrix4d among = Eigen::Matrix4d::Zero();
    Eigen::Vector4d with = Eigen::Vector4d::Zero();
    for (std::size_t m = first; m <= last; ++m) {
      const double t = (time[m] - time[n]) / width;
      const Eigen::Vector4d row(1.0, t, t * t, t * t * t);
      among += row * row.transpose();
      with += (values[m] - values[n]) * row;
    }
    result.push_back(values[n] + among.ldlt().solve(with)[0]);
  }
  return result;
}

// Every k-th sample, if the motion can be told from them; smoothed where that takes it.
std::optional<Recording> thinner(const Recording& recording, std::size_t k, double x_noise, double v_noise) {
  Recording part = every_kth(recording, k);
  part.start = start_of(recording);
  if (part.size() < fewest_kept) {
    return std::nullopt;
  }
  if (recovers(recording, part, k, 0.0, 0.0)) {
    return part;
  }
  part.displacement = smoothed(recording.time, recording.displacement, k);
  if (recording.velocity_measured) {
    part.velocity = smoothed(recording.time, recording.velocity, k);
  }
  if (recovers(recording, part, k, x_noise, recording.velocity_measured ? v_noise : 0.0)) {
    return part;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Recording> thinned(const std::vector<Recording>& recordings, std::size_t total) {
  std::size_t samples = 0;
  for (const Recording& recording : recordings) {
    samples += recording.size();
  }
  std::vector<Recording> result;
  for (const Recording& recording : recordings) {
    Recording best = recording;
    // Long recordings give up more: each has an equal share of what is kept.
    const std::size_t share = std::max<std::size_t>(total / recordings.size(), 200);
    if (samples > total && best.size() > share) {
      const double x_noise = channel_noise(recording.time, recording.displacement);
      const double v_noise = channel_noise(recording.time, recording.velocity);
      for (std::size_t i = 0; best.size() > share; ++i) {
        const std::size_t k = i < factors.size() ? factors[i] : factors[8 + i % 4] << ((i - 8) / 4);
        std::optional<Recording> part = thinner(recording, k, x_noise, v_noise);
        if (!part) {
          break;
        }
        best = std::move(*part);
      }
    }
    result.push_back(std::move(best));
  }
  return result;
}

std::vector<Recording> spread(const std::vector<Recording>& recordings, std::size_t count) {
  if (recordings.size() <= count) {
    return recordings;
  }
  std::vector<std::tuple<double, double, std::size_t>> order;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    double speed = 0.0;
    for (const double velocity : recordings[k].velocity) {
      speed = std::max(speed, std::fabs(velocity));
    }
    order.emplace_back(recordings[k].drive.empty() ? 0.0 : recordings[k].drive[recordings[k].size() / 2], speed, k);
  }
  std::ranges::sort(order);
  std::vector<std::size_t> chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    chosen.push_back(std::get<2>(order[i * (order.size() - 1) / (count - 1)]));
  }
  std::ranges::sort(chosen);
  std::vector<Recording> result;
  result.reserve(chosen.size());
  for (const std::size_t k : chosen) {
    result.push_back(recordings[k]);
  }
  return result;
}

}  // namespace hysteron

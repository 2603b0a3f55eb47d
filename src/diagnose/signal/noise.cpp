#include "diagnose/signal/noise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/drive.hpp"
#include "core/frequency.hpp"
#include "core/random.hpp"
#include "core/robust.hpp"
#include "core/squared.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// Successive periods of the displacement differ by at most this part of its standard deviation, each a difference of
// two; a period that is being looked for by so much more.
constexpr double repeating = 0.03;
constexpr double nearly = 4.0;
// Within a stretch no piece differs by more than so many times what most do, or this part.
constexpr double usual_times = 3.0;
constexpr double least_tolerance = 1e-3;
// The displacement is compared in pieces of a period, and moves where its standard deviation over a period is this part
// of the largest one.
constexpr std::size_t pieces = 4;
constexpr double moving = 0.1;
// Periods left of a stretch without its first half period.
constexpr double fewest_periods = 2.0;
constexpr double run_in = 0.5;
// Samples of a motion that are compared, in all and a period.
constexpr double compared = 2000.0;
constexpr double compared_per_period = 32.0;
// Differences beyond this many robust deviations are outliers.
constexpr double cut = 6.0;

// The weights of the cubic Lagrange interpolation at times that do not fall.
class Interpolation {
 public:
  explicit Interpolation(const std::vector<double>& time) : time_(time) {}

  void to(double at) {
    while (first_ + 4 < time_.size() && time_[first_ + 2] <= at) {
      ++first_;
    }
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      weights_[k] = 1.0;
      for (std::size_t m = 0; m < weights_.size(); ++m) {
        if (m != k) {
          weights_[k] *= (at - time_[first_ + m]) / (time_[first_ + k] - time_[first_ + m]);
        }
      }
    }
  }
  [[nodiscard]] double of(const std::vector<double>& y) const {
    double value = 0.0;
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      value += weights_[k] * y[first_ + k];
    }
    return value;
  }
  // Adds the products of the weights with those `lag` samples further, for each lag.
  void add_products(std::array<double, 4>& products) const {
    for (std::size_t lag = 0; lag < weights_.size(); ++lag) {
      for (std::size_t k = 0; k + lag < weights_.size(); ++k) {
        products[lag] += weights_[k] * weights_[k + lag];
      }
    }
  }

 private:
  const std::vector<double>& time_;
  std::size_t first_ = 0;
  std::array<double, 4> weights_{};
};

// The standard deviation around zero without outliers.
double clipped_deviation(const std::vector<double>& values, double freedoms = 0.0) {
  const double robust = robust_deviation(values);
  double sum = 0.0;
  double count = 0.0;
  for (const double value : values) {
    if (robust <= 0.0 || std::fabs(value) <= cut * robust) {
      sum += value * value;
      count += 1.0;
    }
  }
  return count > freedoms ? std::sqrt(sum / (count - freedoms)) : 0.0;
}

// Samples of the recording that are compared: enough of each period.
std::size_t stride_of(const Recording& recording, double period) {
  const double periods = (recording.time.back() - recording.time.front()) / period;
  const double count = std::max(compared, compared_per_period * periods);
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(recording.size()) / count));
}

// Mean square of x(t + period) - x(t).
double misfold(const Recording& recording, double period, double begins, double ends) {
  double sum = 0.0;
  double count = 0.0;
  const std::size_t step = stride_of(recording, period);
  Interpolation later(recording.time);
  for (std::size_t n = 0; n < recording.size(); n += step) {
    const double t = recording.time[n];
    if (t < begins || t + period > ends) {
      continue;
    }
    later.to(t + period);
    const double d = later.of(recording.displacement) - recording.displacement[n];
    sum += d * d;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1e300;
}

// The period near the given one with which this part of the motion repeats best.
double refined(const Recording& recording, double period, double begins, double ends) {
  double best = misfold(recording, period, begins, ends);
  constexpr int zooms = 8;
  for (int zoom = 0; zoom < zooms; ++zoom) {
    const double width = 0.04 * std::pow(0.25, zoom);
    const double centre = period;
    for (int k = -4; k <= 4; ++k) {
      const double trial = centre * (1.0 + width * k / 4.0);
      const double error = misfold(recording, trial, begins, ends);
      if (error < best) {
        best = error;
        period = trial;
      }
    }
  }
  return period;
}

// A piece of a period: of what its displacements differ by from those a period later, and of themselves, the sums.
struct Piece {
  double count = 0.0;
  double compared = 0.0;
  double differences = 0.0;  // squared
  double drives = 0.0;       // of the drive, squared
  double sum = 0.0;
  double squares = 0.0;
};

struct Stretch {
  Periodicity cycle;
  double usual = 0.0;  // what its displacements differ by, in the middle of its pieces, as the tolerance counts
};

// A drive that varies within the recording, without its noise; empty where it is constant.
struct VaryingDrive {
  explicit VaryingDrive(const Recording& recording) {
    if (drive_varies(recording)) {
      values = quiet_drive(recording.drive);
      const auto count = static_cast<double>(values.size());
      const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
      for (const double value : values) {
        variance += squared(value - mean) / count;
      }
    }
  }
  std::vector<double> values;
  double variance = 0.0;  // over the recording
};

// The longest run of pieces of a period in which the displacement comes again a period later within `tolerance` of its
// standard deviation over the period from there on, and so does the drive within that of its own over the recording.
Stretch longest_stretch(const Recording& recording, const VaryingDrive& drive, double period, double tolerance) {
  const double start = recording.time.front();
  const double length = period / static_cast<double>(pieces);
  const auto count = static_cast<std::size_t>((recording.time.back() - start) / length) + 1;
  std::vector<Piece> row(count);
  const std::size_t step = stride_of(recording, period);
  Interpolation later(recording.time);
  for (std::size_t n = 0; n < recording.size(); n += step) {
    const double t = recording.time[n];
    const double x = recording.displacement[n] - recording.displacement[0];
    Piece& piece = row[std::min(count - 1, static_cast<std::size_t>((t - start) / length))];
    piece.sum += x;
    piece.squares += x * x;
    piece.count += 1.0;
    if (t + period <= recording.time.back()) {
      later.to(t + period);
      const double d = later.of(recording.displacement) - recording.displacement[n];
      piece.differences += d * d;
      piece.drives += drive.values.empty() ? 0.0 : squared(later.of(drive.values) - drive.values[n]);
      piece.compared += 1.0;
    }
  }
  if (count <= pieces) {
    return {};
  }
  std::vector<double> variance(count - pieces, 0.0);
  for (std::size_t k = 0; k < variance.size(); ++k) {
    Piece whole;
    for (std::size_t i = k; i < k + pieces; ++i) {
      whole.count += row[i].count;
      whole.sum += row[i].sum;
      whole.squares += row[i].squares;
    }
    if (whole.count > 0.0) {
      variance[k] = std::max(0.0, whole.squares / whole.count - std::pow(whole.sum / whole.count, 2));
    }
  }
  const double least = moving * moving * *std::ranges::max_element(variance);
  std::size_t longest = 0;
  std::size_t ended = 0;
  std::size_t run = 0;
  std::vector<double> error(variance.size(), 1e300);
  for (std::size_t k = 0; k < variance.size(); ++k) {
    if (row[k].compared > 0.0 && variance[k] > least) {
      const double of_drive = drive.variance > 0.0 ? row[k].drives / drive.variance : 0.0;
      error[k] = std::sqrt(0.5 * std::max(row[k].differences / variance[k], of_drive) / row[k].compared);
    }
    run = error[k] < tolerance ? run + 1 : 0;
    if (run > longest) {
      longest = run;
      ended = k + 1;
    }
  }
  Stretch found;
  Periodicity& result = found.cycle;
  result.begins = start + static_cast<double>(ended - longest) * length + run_in * period;
  result.ends = std::min(start + static_cast<double>(ended) * length + period, recording.time.back());
  if (longest == 0 || result.ends - result.begins < (fewest_periods - 1e-9) * period) {
    return {};
  }
  result.period = period;
  found.usual = median_of({error.begin() + static_cast<std::ptrdiff_t>(ended - longest),
                           error.begin() + static_cast<std::ptrdiff_t>(ended)});
  return found;
}

// What the force differs by from that a period later, less what follows the force itself (a fade, steady or not), a
// drift of its zero, and the motion's own differences, all to first order.
struct Differences {
  std::vector<double> left;
  double freedoms = 0.0;                // taken off
  std::array<double, 4> products = {};  // mean products of the interpolation's weights by lag
};

// Mean square of a difference of noise of deviation one. The interpolation smooths white noise and passes coloured
// noise: of AR(1) noise of correlation r it passes 1 + sum w_i w_j r^|i - j|, and r is what makes neighbouring
// differences correlate as they do.
double passed(const Differences& differences) {
  const std::array<double, 4>& p = differences.products;
  const auto square = [&](double r) { return 1.0 + p[0] + 2.0 * r * (p[1] + r * (p[2] + r * p[3])); };
  const auto product = [&](double r) {
    return r + p[0] * r + p[1] * (1.0 + r * r) + p[2] * r * (1.0 + r * r) + p[3] * r * r * (1.0 + r * r);
  };
  double squares = 0.0;
  double products = 0.0;
  const double limit = cut * robust_deviation(differences.left);
  for (std::size_t n = 1; n < differences.left.size(); ++n) {
    const double here = std::clamp(differences.left[n], -limit, limit);
    squares += here * here;
    products += here * std::clamp(differences.left[n - 1], -limit, limit);
  }
  double low = 0.0;
  double high = 1.0;
  for (int k = 0; k < 30 && squares > 0.0; ++k) {
    const double r = 0.5 * (low + high);
    (product(r) * squares < products * square(r) ? low : high) = r;
  }
  return square(low);
}

Differences differences_of(const Recording& recording, const Periodicity& cycle) {
  constexpr Eigen::Index terms = 7;
  std::vector<Eigen::Matrix<double, terms, 1>> rows;
  Differences result;
  Interpolation later(recording.time);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double t = recording.time[n];
    if (t < cycle.begins || t + cycle.period > cycle.ends) {
      continue;
    }
    later.to(t + cycle.period);
    const double force = later.of(recording.force);
    const double at = 2.0 * (t - cycle.begins) / (cycle.ends - cycle.begins - cycle.period) - 1.0;
    const double middle = 0.5 * (force + recording.force[n]);
    rows.emplace_back(1.0, at, middle, middle * at, middle * at * at,
                      later.of(recording.displacement) - recording.displacement[n],
                      later.of(recording.velocity) - recording.velocity[n]);
    result.left.push_back(force - recording.force[n]);
    later.add_products(result.products);
  }
  for (double& product : result.products) {
    product /= std::max(static_cast<double>(rows.size()), 1.0);
  }
  result.freedoms = static_cast<double>(terms);
  const std::vector<double> whole = result.left;
  // Once more without what is an outlier then.
  double limit = 1e300;
  for (int pass = 0; pass < 2 && !rows.empty(); ++pass) {
    Eigen::Matrix<double, terms, terms> among = Eigen::Matrix<double, terms, terms>::Zero();
    Eigen::Matrix<double, terms, 1> with = Eigen::Matrix<double, terms, 1>::Zero();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (std::fabs(result.left[k]) <= limit) {
        among += rows[k] * rows[k].transpose();
        with += whole[k] * rows[k];
      }
    }
    // In units of each term, so that the pivots tell which are none at all.
    const Eigen::Matrix<double, terms, 1> scale = among.diagonal().cwiseSqrt().cwiseMax(1e-300);
    const Eigen::Matrix<double, terms, terms> normal =
        scale.cwiseInverse().asDiagonal() * among * scale.cwiseInverse().asDiagonal();
    const Eigen::Matrix<double, terms, 1> weights =
        (normal.completeOrthogonalDecomposition().solve(with.cwiseQuotient(scale))).cwiseQuotient(scale);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      result.left[k] = whole[k] - weights.dot(rows[k]);
    }
    const double robust = robust_deviation(result.left);
    limit = robust > 0.0 ? cut * robust : 1e300;
  }
  return result;
}

}  // namespace

std::string_view word_of(NoiseMethod method) {
  switch (method) {
    case NoiseMethod::cycles:
      return "cycles";
    case NoiseMethod::high_pass:
      return "high-pass";
    case NoiseMethod::mixed:
      return "cycles where periodic, high-pass elsewhere";
    case NoiseMethod::unknown:
      break;
  }
  return "too few samples";
}

Periodicity periodicity(const Recording& recording) {
  const double frequency = dominant_frequency(recording);
  if (!(frequency > 0.0) || recording.size() < fewest_noise_samples) {
    return {};
  }
  const VaryingDrive drive(recording);
  // Ramps and rests shift the period with which the whole repeats best: the stretch tells it better, and is then told
  // better itself. Its ends reach into the ramps as far as the tolerance lets them: what is usual in it bounds it
  // closer.
  Periodicity best;
  constexpr int trials = 6;
  for (int k = -trials; k <= trials; ++k) {
    const double period = (1.0 + 0.04 * k / trials) / frequency;
    const Periodicity found = longest_stretch(recording, drive, period, nearly * repeating).cycle;
    if (found.ends - found.begins > best.ends - best.begins) {
      best = found;
    }
  }
  if (!(best.period > 0.0)) {
    return {};
  }
  Stretch found = longest_stretch(recording, drive, refined(recording, best.period, best.begins, best.ends), repeating);
  best = found.cycle;
  for (int pass = 0; pass < 2 && found.cycle.period > 0.0; ++pass) {
    const double tolerance = std::clamp(usual_times * found.usual, least_tolerance, repeating);
    found = longest_stretch(recording, drive, refined(recording, best.period, best.begins, best.ends), tolerance);
    best = found.cycle.period > 0.0 ? found.cycle : best;
  }
  return best;
}

NoiseFloor noise_floor(const Recording& recording) {
  NoiseFloor result;
  if (recording.size() < fewest_noise_samples) {
    return result;
  }
  const std::vector<double> fourth = fourth_differences(recording.force);
  result.white = robust_deviation(fourth);
  if (result.white <= 0.0) {
    result.white = clipped_deviation(fourth);
  }
  // Periods that repeat are rounded alike, and a force that rests on a step shows no differences.
  const double rounding = channel_quantum(recording.force) / std::sqrt(12.0);
  result.rounded = rounding >= result.white;
  result.white = std::max(result.white, rounding);
  const Periodicity cycle = periodicity(recording);
  if (cycle.period > 0.0) {
    const Differences differences = differences_of(recording, cycle);
    if (static_cast<double>(differences.left.size()) >=
        static_cast<double>(fewest_noise_samples) + differences.freedoms) {
      result.sigma = std::max(
          clipped_deviation(differences.left, differences.freedoms) / std::sqrt(passed(differences)), rounding);
      result.method = NoiseMethod::cycles;
      result.cycles = (cycle.ends - cycle.begins) / cycle.period;
      return result;
    }
  }
  result.sigma = result.white;
  result.method = NoiseMethod::high_pass;
  return result;
}

Recording shaken(const Recording& recording) {
  Recording result = recording;
  const Stream stream = Stream(1).child("noise of the motion");
  const double of_displacement = channel_noise(recording.time, recording.displacement);
  for (std::size_t n = 0; n < result.size(); ++n) {
    result.displacement[n] += of_displacement * stream.normal(n, 0);
  }
  if (recording.velocity_measured) {
    const double of_velocity = channel_noise(recording.time, recording.velocity);
    for (std::size_t n = 0; n < result.size(); ++n) {
      result.velocity[n] += of_velocity * stream.normal(n, 1);
    }
  } else {
    // A copy with fewer samples keeps the velocity of all: only the change is its own.
    const std::vector<double> before = derive_velocity(recording.time, recording.displacement);
    const std::vector<double> after = derive_velocity(recording.time, result.displacement);
    for (std::size_t n = 0; n < result.size(); ++n) {
      result.velocity[n] += after[n] - before[n];
    }
  }
  if (!recording.derived_acceleration.empty()) {
    result.derived_acceleration =
        derive_acceleration(recording.time, result.displacement, result.velocity, recording.velocity_measured);
  }
  // A rod that is held (io/stillness.hpp) has no velocity, whatever the noise.
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (recording.velocity[n] == 0.0) {
      result.velocity[n] = 0.0;
      if (!result.derived_acceleration.empty()) {
        result.derived_acceleration[n] = recording.derived_acceleration[n];
      }
    }
  }
  return result;
}

}  // namespace hysteron

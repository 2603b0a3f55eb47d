#include "respond/signal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/message.hpp"

namespace hysteron {
namespace {

constexpr int reach = 32;           // samples of the kernel to either side
constexpr double sharpness = 18.9;  // Kaiser's beta: 180 dB
constexpr int finer = 16;
constexpr int margin = 4;  // samples beyond the ends on the fine grid

double bessel_i0(double x) {
  double term = 1.0;
  double sum = 1.0;
  for (int k = 1; term > 1e-18 * sum; ++k) {
    term *= 0.25 * x * x / (static_cast<double>(k) * k);
    sum += term;
  }
  return sum;
}

double kernel(double t) {
  if (std::fabs(t) < 1e-12) {
    return 1.0;
  }
  const double u = t / reach;
  if (std::fabs(u) >= 1.0) {
    return 0.0;
  }
  const double angle = std::numbers::pi * t;
  return std::sin(angle) / angle * bessel_i0(sharpness * std::sqrt(1.0 - u * u)) / bessel_i0(sharpness);
}

// The sample number k of a signal that goes on beyond its ends.
double extended(const std::vector<double>& values, long k, bool periodic) {
  const long n = static_cast<long>(values.size());
  if (periodic) {
    return values[static_cast<std::size_t>(((k % n) + n) % n)];
  }
  if (k < 0) {
    return 2.0 * values.front() - values[static_cast<std::size_t>(std::min(-k, n - 1))];
  }
  if (k >= n) {
    return 2.0 * values.back() - values[static_cast<std::size_t>(std::max(2 * (n - 1) - k, 0L))];
  }
  return values[static_cast<std::size_t>(k)];
}

std::vector<double> refined(const std::vector<double>& values, bool periodic) {
  std::array<std::array<double, 2 * reach>, finer> weights{};
  for (int f = 0; f < finer; ++f) {
    for (int k = 0; k < 2 * reach; ++k) {
      weights[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)] =
          kernel(static_cast<double>(f) / finer - (k - reach + 1));
    }
  }
  const long samples = static_cast<long>(values.size()) + (periodic ? 1 : 0);
  std::vector<double> padded;
  for (long k = -margin - reach; k < samples + margin + reach + 1; ++k) {
    padded.push_back(extended(values, k, periodic));
  }
  std::vector<double> result;
  for (long n = -margin; n < samples + margin; ++n) {
    for (int f = 0; f < finer; ++f) {
      const auto& own = weights[static_cast<std::size_t>(f)];
      const double* first = padded.data() + (n + margin + 1);  // sample n - reach + 1
      double sum = 0.0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        sum += own[k] * first[k];
      }
      result.push_back(sum);
    }
  }
  return result;
}

bool uniform(const std::vector<double>& time) {
  const double mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (std::size_t n = 1; n < time.size(); ++n) {
    if (std::fabs(time[n] - time.front() - mean * static_cast<double>(n)) > 1e-3 * mean) {
      return false;
    }
  }
  return true;
}

}  // namespace

Interpolation interpolation_of(const std::string& word) {
  if (word == "linear") {
    return Interpolation::linear;
  }
  if (word == "cubic") {
    return Interpolation::cubic;
  }
  if (word == "band-limited") {
    return Interpolation::band_limited;
  }
  throw OptionError(Option::interpolation + ": '" + word + "' is not known, expected linear, cubic or band-limited");
}

std::string_view word_of(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::linear:
      return "linear";
    case Interpolation::band_limited:
      return "band-limited";
    case Interpolation::cubic:
      break;
  }
  return "cubic";
}

Signal::Signal(std::vector<double> time, std::vector<double> values, Interpolation interpolation, bool periodic)
    : time_(std::move(time)), values_(std::move(values)), interpolation_(interpolation) {
  const std::size_t n = time_.size();
  if (periodic) {
    period_ = (time_.back() - time_.front()) * static_cast<double>(n) / static_cast<double>(n - 1);
  }
  if (interpolation_ == Interpolation::band_limited) {
    if (!uniform(time_)) {
      throw OptionError(Option::interpolation +
                        " band-limited: the samples are not uniform in time, expected linear or cubic");
    }
    fine_ = refined(values_, periodic);
    return;
  }
  if (periodic) {
    time_.push_back(time_.front() + period_);
    values_.push_back(values_.front());
  }
  if (interpolation_ == Interpolation::cubic) {
    const std::size_t last = time_.size() - 1;
    slopes_.assign(last + 1, 0.0);
    const auto chord = [&](std::size_t k) { return (values_[k + 1] - values_[k]) / (time_[k + 1] - time_[k]); };
    for (std::size_t k = 1; k < last; ++k) {
      const double left = time_[k] - time_[k - 1];
      const double right = time_[k + 1] - time_[k];
      slopes_[k] = (chord(k - 1) * right + chord(k) * left) / (left + right);
    }
    if (periodic) {
      slopes_[0] = slopes_[last] = 0.5 * (chord(0) + chord(last - 1));
    } else {
      slopes_[0] = last > 1 ? 2.0 * chord(0) - slopes_[1] : chord(0);
      slopes_[last] = last > 1 ? 2.0 * chord(last - 1) - slopes_[last - 1] : chord(0);
    }
  }
}

double Signal::placed(double time) const {
  if (period_ > 0.0) {
    return time - std::floor((time - time_.front()) / period_) * period_;
  }
  return std::clamp(time, time_.front(), time_.back());
}

Signal::Point Signal::at(double time) const { return within(placed(time)); }

double Signal::bend(double time) const {
  constexpr double moment = 1e-6;
  const bool ends = period_ <= 0.0;
  const double from = ends ? std::max(time - moment, time_.front()) : time - moment;
  const double to = ends ? std::min(time + moment, time_.back()) : time + moment;
  return (slope(to) - slope(from)) / (to - from);
}

// Band-limited, which a simulated motion asks for at every stage of every step: Lagrange's weights without their
// slopes.
double Signal::value(double time) const {
  if (interpolation_ != Interpolation::band_limited) {
    return at(time).value;
  }
  const auto [first, u] = on_fine_grid(placed(time));
  const std::array<double, 6> d = {u + 2.0, u + 1.0, u, u - 1.0, u - 2.0, u - 3.0};
  constexpr std::array<double, 6> over = {-1.0 / 120.0, 1.0 / 24.0, -1.0 / 12.0, 1.0 / 12.0, -1.0 / 24.0, 1.0 / 120.0};
  std::array<double, 7> behind{};  // products of all further factors
  behind[6] = 1.0;
  for (std::size_t i = 6; i-- > 0;) {
    behind[i] = behind[i + 1] * d[i];
  }
  double before = 1.0;
  double result = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    result += over[i] * before * behind[i + 1] * fine_[first + i];
    before *= d[i];
  }
  return result;
}

Signal::Place Signal::on_fine_grid(double time) const {
  const double interval = (time_.back() - time_.front()) / static_cast<double>(time_.size() - 1) / finer;
  const double place = (time - time_.front()) / interval + margin * finer;
  const double base = std::floor(place);
  return {static_cast<std::size_t>(base) - 2, place - base};
}

Signal::Point Signal::within(double time) const {
  if (interpolation_ == Interpolation::band_limited) {
    // The quintic through the six nearest points of the fine grid.
    const double interval = (time_.back() - time_.front()) / static_cast<double>(time_.size() - 1) / finer;
    const auto [first, u] = on_fine_grid(time);
    Point result{0.0, 0.0};
    for (int i = -2; i <= 3; ++i) {
      double weight = 1.0;
      double weight_slope = 0.0;
      for (int j = -2; j <= 3; ++j) {
        if (j != i) {
          weight_slope = (weight_slope * (u - j) + weight) / (i - j);
          weight *= (u - j) / (i - j);
        }
      }
      const double value = fine_[first + static_cast<std::size_t>(i + 2)];
      result.value += weight * value;
      result.slope += weight_slope * value / interval;
    }
    return result;
  }
  const auto above = std::ranges::upper_bound(time_, time);
  const auto k =
      static_cast<std::size_t>(std::clamp<long>(above - time_.begin() - 1, 0, static_cast<long>(time_.size()) - 2));
  const double h = time_[k + 1] - time_[k];
  const double u = (time - time_[k]) / h;
  const double rise = values_[k + 1] - values_[k];
  if (interpolation_ == Interpolation::linear) {
    return {values_[k] + u * rise, rise / h};
  }
  const double a = h * slopes_[k];
  const double b = h * slopes_[k + 1];
  const double c2 = 3.0 * rise - 2.0 * a - b;
  const double c3 = a + b - 2.0 * rise;
  return {values_[k] + u * (a + u * (c2 + u * c3)), (a + u * (2.0 * c2 + 3.0 * u * c3)) / h};
}

}  // namespace hysteron

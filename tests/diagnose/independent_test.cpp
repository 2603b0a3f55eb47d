// The number of independent values does not depend on the sampling rate.
#include "diagnose/residual/independent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr double step = 5e-4;
constexpr std::size_t samples = 24001;  // 12 s
constexpr double two_pi = 2.0 * std::numbers::pi;

struct Left {
  std::vector<Recording> recordings;
  std::vector<Residual> residuals;
};

// Three sines of 0.6, 1 and 1.4 Hz and a residual of time and the sine's phase, drawn by `make` for each recording.
using Draw = std::function<double(double time, double phase)>;

Left left_of(const std::function<Draw(const Stream&)>& make) {
  Left result;
  for (const double frequency : {0.6, 1.0, 1.4}) {
    Recording recording;
    Residual residual;
    const Draw draw = make(Stream(9).child(static_cast<std::uint64_t>(10.0 * frequency)));
    for (std::size_t n = 0; n < samples; ++n) {
      const double t = step * static_cast<double>(n);
      recording.time.push_back(t);
      recording.displacement.push_back(0.01 * std::sin(two_pi * frequency * t));
      residual.force.push_back(draw(t, two_pi * frequency * t));
    }
    result.recordings.push_back(std::move(recording));
    result.residuals.push_back(std::move(residual));
  }
  return result;
}

double independent(const Left& left) {
  double sum = 0.0;
  for (std::size_t k = 0; k < left.recordings.size(); ++k) {
    sum += independent_values(left.recordings[k], left.residuals[k]);
  }
  return sum;
}

// Only the samples that `keeps` keeps.
Left part_of(const Left& left, const std::function<bool(std::size_t)>& keeps) {
  Left result;
  for (std::size_t k = 0; k < left.recordings.size(); ++k) {
    Recording recording;
    Residual residual;
    for (std::size_t n = 0; n < samples; ++n) {
      if (keeps(n)) {
        recording.time.push_back(left.recordings[k].time[n]);
        recording.displacement.push_back(left.recordings[k].displacement[n]);
        residual.force.push_back(left.residuals[k].force[n]);
      }
    }
    result.recordings.push_back(std::move(recording));
    result.residuals.push_back(std::move(residual));
  }
  return result;
}

void expect_the_same_at_every_rate(const Left& left, double expected) {
  const double whole = independent(left);
  EXPECT_NEAR(whole, expected, 0.2 * expected);
  for (const std::size_t k : {2U, 4U, 8U}) {
    EXPECT_NEAR(independent(part_of(left, [&](std::size_t n) { return n % k == 0; })), whole, 0.2 * whole) << k;
  }
  const Stream stream = Stream(4);
  const double uneven = independent(part_of(left, [&](std::size_t n) { return stream.uniform(n) < 0.3; }));
  EXPECT_NEAR(uneven, whole, 0.2 * whole) << "at random times";
}

TEST(Independent, SmoothResidualIsWorthTheSameAtEveryRate) {
  // The autocorrelation of a sine that goes three times a cycle, summed until it is negative: 2 / omega.
  const Left left = left_of([](const Stream&) { return [](double, double phase) { return std::sin(3.0 * phase); }; });
  expect_the_same_at_every_rate(left, 12.0 * 3.0 * 0.5 * two_pi * (0.6 + 1.0 + 1.4));
}

TEST(Independent, WhiteResidualIsWorthSoManyValuesAHalfCycle) {
  const Left left = left_of([](const Stream& stream) {
    return
        [stream](double time, double) { return stream.normal(static_cast<std::uint64_t>(std::lround(time / step))); };
  });
  expect_the_same_at_every_rate(left, 12.0 * 2.0 * (0.6 + 1.0 + 1.4) * values_per_half_cycle);
}

TEST(Independent, SlowNoiseIsWorthItsDurationOverItsCorrelationTime) {
  constexpr double tau = 0.03;  // s
  const Left left = left_of([](const Stream& stream) {
    double state = stream.normal(0, 1);
    return [stream, state](double time, double) mutable {
      const double r = std::exp(-step / tau);
      state = r * state + std::sqrt(1.0 - r * r) * stream.normal(static_cast<std::uint64_t>(std::lround(time / step)));
      return state;
    };
  });
  expect_the_same_at_every_rate(left, 3.0 * 12.0 / (2.0 * tau));
}

TEST(Independent, SlowNoiseUnderAWhiteOneIsSeen) {
  // A fifth of the square is slow: the correlation time is a fifth of that of the slow noise.
  constexpr double tau = 0.2;
  const Left left = left_of([](const Stream& stream) {
    double state = stream.normal(0, 1);
    return [stream, state](double time, double) mutable {
      const auto n = static_cast<std::uint64_t>(std::lround(time / step));
      const double r = std::exp(-step / tau);
      state = r * state + std::sqrt(1.0 - r * r) * stream.normal(n);
      return state + 2.0 * stream.normal(n, 2);
    };
  });
  EXPECT_LT(independent(left), 0.5 * 12.0 * 2.0 * 3.0 * values_per_half_cycle);
  EXPECT_NEAR(independent(left), 3.0 * 12.0 / (0.2 * 2.0 * tau), 0.35 * 3.0 * 12.0 / (0.2 * 2.0 * tau));
}

TEST(Independent, NothingLeftAndFewSamplesAreFinite) {
  Left left = left_of([](const Stream&) { return [](double, double) { return 0.0; }; });
  EXPECT_NEAR(independent(left), 12.0 * 2.0 * 3.0 * values_per_half_cycle, 1.0);
  left = part_of(left, [](std::size_t n) { return n < 5; });
  EXPECT_TRUE(std::isfinite(independent(left)));
}

}  // namespace
}  // namespace hysteron

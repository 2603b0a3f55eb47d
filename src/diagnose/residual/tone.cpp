#include "diagnose/residual/tone.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "core/robust.hpp"

namespace hysteron {
namespace {

constexpr std::size_t most_samples = 4096;  // of a recording; more are averaged
// Spectra have this many values for each that is independent.
constexpr double finer = 4.0;
// The neighbourhood of a frequency, in units of the resolution: without the line itself, whose window is two wide.
constexpr double neighbour_from = 3.0;
constexpr double neighbour_to = 15.0;
// Part of a tone's share of the residual that the force has there at least where the motion makes the tone.
constexpr double part_of_the_force = 0.01;
// Expected number of frequencies at which noise would do as well.
constexpr double by_chance = 1e-6;
constexpr double least_share = 0.1;  // of the squared residual

using Values = std::vector<double>;

// Uniform means over equal parts of the time; parts without a sample take the value before.
Values uniform(const Values& time, const Values& values, std::size_t parts) {
  Values sum(parts, 0.0);
  std::vector<std::size_t> count(parts, 0);
  const double span = time.back() - time.front();
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double at = (time[n] - time.front()) / span * static_cast<double>(parts - 1) + 0.5;
    const std::size_t k = std::min(parts - 1, static_cast<std::size_t>(at));
    sum[k] += values[n];
    ++count[k];
  }
  for (std::size_t k = 0; k < parts; ++k) {
    sum[k] = count[k] > 0 ? sum[k] / static_cast<double>(count[k]) : (k > 0 ? sum[k - 1] : 0.0);
  }
  return sum;
}

struct Spectrum {
  double step = 0.0;                // Hz between its values
  Values power;                     // |X|^2, with Hann's window
  Values beyond;                    // over the mean of the neighbourhood
  double amplitude_per_root = 0.0;  // of a sine, over the root of its power
  double variance = 0.0;

  [[nodiscard]] double amplitude(std::size_t at) const { return amplitude_per_root * std::sqrt(power[at]); }
  // Of the variance, what a sine at that frequency makes.
  [[nodiscard]] double share(std::size_t at) const { return 0.5 * amplitude(at) * amplitude(at) / variance; }
  [[nodiscard]] double independent() const { return static_cast<double>(power.size()) / finer; }
};

// Whether the motion can have made what the residual holds there.
bool is_of_the_motion(const Spectrum& residual, const Spectrum& force, std::size_t at) {
  return force.share(at) > part_of_the_force * residual.share(at);
}

Spectrum spectrum_of(const Values& values, double duration) {
  const std::size_t size = values.size();
  double mean = 0.0;
  for (const double value : values) {
    mean += value / static_cast<double>(size);
  }
  std::vector<std::complex<double>> padded(static_cast<std::size_t>(finer) * size);
  double weight = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const double w =
        0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(n) + 0.5) / static_cast<double>(size));
    padded[n] = w * (values[n] - mean);
    weight += w;
  }
  std::vector<std::complex<double>> transformed;
  Eigen::FFT<double> fft;
  fft.fwd(transformed, padded);
  Spectrum result;
  result.step = static_cast<double>(size - 1) / static_cast<double>(size) / (duration * finer);
  result.amplitude_per_root = 2.0 / weight;
  for (const double value : values) {
    result.variance += (value - mean) * (value - mean) / static_cast<double>(size);
  }
  result.variance = std::max(result.variance, 1e-300);
  const auto count = static_cast<std::size_t>(0.5 * finer * static_cast<double>(size));
  for (std::size_t k = 0; k < count; ++k) {
    result.power.push_back(std::norm(transformed[k]));
  }
  // The lower and the upper neighbourhood apart, the larger of both: a spectrum may fall. Of squares of a Gaussian
  // spectrum, which are exponential, the median is ln 2 of the mean.
  const auto from = static_cast<std::size_t>(neighbour_from * finer);
  const auto to = static_cast<std::size_t>(neighbour_to * finer);
  result.beyond.assign(count, 0.0);
  Values near(to - from);
  const auto median_from = [&](std::size_t first) {
    const auto begin = result.power.begin() + static_cast<std::ptrdiff_t>(first);
    std::copy(begin, begin + static_cast<std::ptrdiff_t>(near.size()), near.begin());
    return median_of(near);
  };
  for (std::size_t k = to; k + to < count; ++k) {
    const double mean_near = std::max(median_from(k - to), median_from(k + from)) / std::numbers::ln2;
    result.beyond[k] = mean_near > 0.0 ? result.power[k] / mean_near : 0.0;
  }
  return result;
}

// More than half of `count`.
std::size_t most_of(std::size_t count) { return count / 2 + 1; }

// That most of `count` independent exponential numbers of mean 1 exceed `value`: the upper tail of a binomial
// distribution.
double chance_of(double value, std::size_t count) {
  const double p = std::exp(-value);
  const auto n = static_cast<double>(count);
  double result = 0.0;
  for (std::size_t k = most_of(count); k <= count; ++k) {
    const auto r = static_cast<double>(k);
    const double ways = std::lgamma(n + 1.0) - std::lgamma(r + 1.0) - std::lgamma(n - r + 1.0);
    result += std::exp(ways - r * value) * std::pow(1.0 - p, n - r);
  }
  return result;
}

struct Pair {
  Spectrum residual;
  Spectrum force;
  double squares = 0.0;  // mean of the squared residual
};

Pair pair_of(const Leftover& one) {
  const std::size_t parts = std::min(one.time.size(), most_samples);
  const double duration = one.time.back() - one.time.front();
  Pair pair;
  pair.residual = spectrum_of(uniform(one.time, one.residual, parts), duration);
  pair.force = spectrum_of(uniform(one.time, one.force, parts), duration);
  for (const double value : one.residual) {
    pair.squares += value * value / static_cast<double>(one.residual.size());
  }
  return pair;
}

// The sine of one frequency by least squares, and the squares that it takes off.
struct Fitted {
  Sine sine;
  double taken = 0.0;
};
Fitted fitted(const Leftover& one, double frequency) {
  double cc = 0.0;
  double cs = 0.0;
  double ss = 0.0;
  double rc = 0.0;
  double rs = 0.0;
  for (std::size_t n = 0; n < one.time.size(); ++n) {
    const double phase = 2.0 * std::numbers::pi * frequency * one.time[n];
    const double c = std::cos(phase);
    const double s = std::sin(phase);
    cc += c * c;
    cs += c * s;
    ss += s * s;
    rc += one.residual[n] * c;
    rs += one.residual[n] * s;
  }
  const double determinant = cc * ss - cs * cs;
  Fitted result{{frequency, (rc * ss - rs * cs) / determinant, (rs * cc - rc * cs) / determinant}};
  result.taken = result.sine.cosine * rc + result.sine.sine * rs;
  return result;
}

}  // namespace

std::optional<Tone> tone_of(const std::vector<Leftover>& leftovers) {
  std::vector<Pair> pairs;
  for (const Leftover& one : leftovers) {
    if (one.time.size() < 2) {
      continue;
    }
    pairs.push_back(pair_of(one));
  }
  if (pairs.size() < 2) {
    return std::nullopt;  // one motion tells nothing of others
  }
  const auto finest = std::ranges::min_element(pairs, {}, [](const Pair& pair) { return pair.residual.step; });
  double squares = 0.0;
  for (const Pair& pair : pairs) {
    squares += pair.squares;
  }
  const std::size_t count = finest->residual.power.size();
  std::optional<Tone> best;
  for (std::size_t k = 0; k < count; ++k) {
    const double frequency = static_cast<double>(k) * finest->residual.step;
    Values beyond(pairs.size(), 0.0);
    double taken = 0.0;
    std::size_t seen = 0;
    Tone tone{frequency, 0.0, 0.0, 0, leftovers.size()};
    for (std::size_t r = 0; r < pairs.size(); ++r) {
      const Spectrum& residual = pairs[r].residual;
      const auto at = static_cast<std::size_t>(std::lround(frequency / residual.step));
      if (at >= residual.power.size() || is_of_the_motion(residual, pairs[r].force, at)) {
        continue;
      }
      ++seen;
      beyond[r] = residual.beyond[at];
      taken += 0.5 * residual.amplitude(at) * residual.amplitude(at);
      tone.recordings += beyond[r] > std::log(residual.independent()) ? 1 : 0;  // noise is expected to once
    }
    tone.share = taken / squares;
    if (!(tone.share > least_share)) {
      continue;
    }
    const auto reached = beyond.begin() + static_cast<std::ptrdiff_t>(most_of(pairs.size()) - 1);
    std::ranges::nth_element(beyond, reached, std::ranges::greater());
    tone.amplitude = std::sqrt(2.0 * taken / static_cast<double>(seen));
    const double chance = finest->residual.independent() * chance_of(*reached, pairs.size());
    if (chance < by_chance && (!best || tone.share > best->share)) {
      best = tone;
    }
  }
  return best;
}

double Sine::at(double time) const {
  const double phase = 2.0 * std::numbers::pi * frequency * time;
  return cosine * std::cos(phase) + sine * std::sin(phase);
}

std::optional<Sine> sine_of(const Leftover& leftover, double frequency) {
  if (leftover.time.size() < 2) {
    return std::nullopt;
  }
  const Pair pair = pair_of(leftover);
  const auto at = static_cast<std::size_t>(std::lround(frequency / pair.residual.step));
  if (at >= pair.residual.power.size() || is_of_the_motion(pair.residual, pair.force, at)) {
    return std::nullopt;
  }
  // The squares taken off have one summit within half a cycle over the recording on either side. Its place is known to
  // the root of the precision of these squares.
  const double half_cycle = 0.5 / (leftover.time.back() - leftover.time.front());
  const double best = boost::math::tools::brent_find_minima(
                          [&](double hertz) { return -fitted(leftover, hertz).taken; }, frequency - half_cycle,
                          frequency + half_cycle, std::numeric_limits<double>::digits / 2)
                          .first;
  return fitted(leftover, best).sine;
}

}  // namespace hysteron

#include "diagnose/residual/tone.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace hysteron {
namespace {

constexpr std::size_t fewest_samples = 64;    // of a recording that counts
constexpr std::size_t fewest_recordings = 3;  // with the tone; two may agree by chance
constexpr std::size_t most_samples = 4096;    // of a recording; more are averaged
// Spectra have this many values for each that is independent.
constexpr double finer = 4.0;
// The neighbourhood of a frequency, in units of the resolution: without the line itself, whose window is two wide.
constexpr double neighbour_from = 3.0;
constexpr double neighbour_to = 15.0;
// Times its neighbourhood, by which the force has a line that is no chance, and the part of a tone's share that the
// line has of the force at least where the motion makes the tone.
constexpr double line_of_the_force = 20.0;
constexpr double part_of_the_force = 0.01;
// Times its neighbourhood, by which a tone stands out in a recording, and at most what one recording counts.
constexpr double stands_out = 8.0;
constexpr double most_of_one = 20.0;
// Expected number of frequencies at which noise would do as well.
constexpr double by_chance = 1e-6;
constexpr double least_share = 0.1;  // of the squared residual
constexpr double highest = 0.8;      // of half the sampling frequency

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
};

// Whether the motion has a line there that can have made the one of the residual.
bool is_of_the_motion(const Spectrum& residual, const Spectrum& force, std::size_t at) {
  return force.beyond[at] > line_of_the_force && force.share(at) > part_of_the_force * residual.share(at);
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
  const auto count = static_cast<std::size_t>(highest * 0.5 * finer * static_cast<double>(size));
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
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
    std::ranges::nth_element(near, middle);
    return *middle;
  };
  for (std::size_t k = to; k + to < count; ++k) {
    const double mean_near = std::max(median_from(k - to), median_from(k + from)) / std::numbers::ln2;
    result.beyond[k] = mean_near > 0.0 ? result.power[k] / mean_near : 0.0;
  }
  return result;
}

// That the sum of `count` independent exponential numbers of mean 1 exceeds `sum`.
double chance_of(double sum, std::size_t count) {
  double term = std::exp(-sum);
  double result = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    result += term;
    term *= sum / static_cast<double>(k + 1);
  }
  return result;
}

struct Pair {
  Spectrum residual;
  Spectrum force;
  double squares = 0.0;  // mean of the squared residual
};

}  // namespace

std::optional<Tone> tone_of(const std::vector<Leftover>& leftovers) {
  std::vector<Pair> pairs;
  for (const Leftover& one : leftovers) {
    if (one.time.size() < fewest_samples) {
      continue;
    }
    const std::size_t parts = std::min(one.time.size(), most_samples);
    const double duration = one.time.back() - one.time.front();
    Pair pair;
    pair.residual = spectrum_of(uniform(one.time, one.residual, parts), duration);
    pair.force = spectrum_of(uniform(one.time, one.force, parts), duration);
    for (const double value : one.residual) {
      pair.squares += value * value / static_cast<double>(one.residual.size());
    }
    pairs.push_back(std::move(pair));
  }
  if (pairs.size() < fewest_recordings) {
    return std::nullopt;
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
    double sum = 0.0;
    double taken = 0.0;
    std::size_t seen = 0;
    Tone tone{frequency, 0.0, 0.0, 0, leftovers.size()};
    for (const Pair& pair : pairs) {
      const auto at = static_cast<std::size_t>(std::lround(frequency / pair.residual.step));
      if (at >= pair.residual.power.size() || is_of_the_motion(pair.residual, pair.force, at)) {
        continue;
      }
      ++seen;
      sum += std::min(pair.residual.beyond[at], most_of_one);
      taken += 0.5 * pair.residual.amplitude(at) * pair.residual.amplitude(at);
      tone.recordings += pair.residual.beyond[at] > stands_out ? 1 : 0;
    }
    if (tone.recordings < fewest_recordings || 2 * tone.recordings <= pairs.size()) {
      continue;
    }
    tone.share = taken / squares;
    tone.amplitude = std::sqrt(2.0 * taken / static_cast<double>(seen));
    const double chance = static_cast<double>(count) / finer * chance_of(sum, seen);
    if (tone.share > least_share && chance < by_chance && (!best || tone.share > best->share)) {
      best = tone;
    }
  }
  return best;
}

}  // namespace hysteron

#include "io/mains_hum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>

#include "core/frequency.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

constexpr std::array mains = {50.0, 60.0};  // Hz
// Grids keep to their frequency within this.
constexpr double wander = 0.5;
constexpr int tried = 10;  // frequencies on either side of the nominal one
// The motion is slower by this factor: what it holds of higher harmonics is small there.
constexpr double above_motion = 5.0;
// As much of a noise makes a damping a hundredth too small, which is told from there on too.
constexpr double least_share = 0.1;
// The amplitude is this many times that at any frequency around it: a sweep, a random motion and the harmonics of a
// corner have neighbours that are as large.
constexpr double alone = 5.0;
constexpr std::array around = {-8.0, -6.5, -5.0, -3.5, 3.5, 5.0, 6.5, 8.0};  // Hz
// The window leaves nothing of a tone more than two of the recording's own steps of frequency away.
constexpr double fewest_steps = 2.0;
// The force over the velocity at the tone, against what it is over the whole motion: a rod that vibrates so is resisted
// as elsewhere, or by the viscous part of it where friction is overcome already.
constexpr double follows = 0.25;

// Of a tone in the channel, under the window of Hann, which the sum of its weights is taken out of.
double amplitude_of(std::span<const double> time, std::span<const double> values, double mean, double frequency) {
  const double length = time.back() - time.front();
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double at = time[n] - time.front();
    const double weight = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * at / length);
    sum += weight * (values[n] - mean) * std::polar(1.0, -2.0 * std::numbers::pi * frequency * at);
    weights += weight;
  }
  return 2.0 * std::abs(sum) / weights;
}

// A hum runs throughout: so many samples tell it, of so long a time, in which a tone is as wide as what is tried.
constexpr std::size_t most_looked_at = 65536;
constexpr double longest = 20.0;  // s

std::size_t samples_looked_at(std::span<const double> time) {
  const auto end = std::ranges::upper_bound(time, time.front() + longest);
  return std::min(static_cast<std::size_t>(end - time.begin()), most_looked_at);
}

struct Channel {
  std::span<const double> time;
  std::span<const double> values;
  double mean = 0.0;
  double rms = 0.0;  // about it
  Channel(std::span<const double> of_time, std::span<const double> of_values)
      : time(of_time.first(samples_looked_at(of_time))), values(of_values.first(time.size())) {
    const auto count = static_cast<double>(values.size());
    for (const double value : values) mean += value / count;
    for (const double value : values) rms += squared(value - mean) / count;
    rms = std::sqrt(rms);
  }
  [[nodiscard]] double at(double frequency) const { return amplitude_of(time, values, mean, frequency); }
};

}  // namespace

std::optional<MainsHum> mains_hum_of(const Recording& recording) {
  if (recording.velocity_measured || !recording.timed || recording.displacement.size() != recording.size() ||
      recording.velocity.size() != recording.size() || recording.force.size() != recording.size() ||
      recording.size() < 16)
    return std::nullopt;
  const Channel velocity(recording.time, recording.velocity);
  const Channel force(recording.time, recording.force);
  const double length = velocity.time.back() - velocity.time.front();
  const double rate = static_cast<double>(velocity.time.size() - 1) / length;
  for (const double nominal : mains) {
    const double highest = nominal + around.back();
    if (rate < 2.0 * highest || length * (around.back() - around[around.size() - 2]) < fewest_steps) continue;
    MainsHum hum;
    double of_velocity = 0.0;
    for (int k = -tried; k <= tried; ++k) {
      const double frequency = nominal + wander * static_cast<double>(k) / static_cast<double>(tried);
      const double amplitude = velocity.at(frequency);
      if (amplitude > of_velocity) {
        of_velocity = amplitude;
        hum.frequency = frequency;
      }
    }
    hum.share = of_velocity / std::numbers::sqrt2 / velocity.rms;
    if (!(hum.share >= least_share)) continue;
    if (std::ranges::any_of(around, [&](double off) { return alone * velocity.at(hum.frequency + off) > of_velocity; }))
      continue;
    if (force.at(hum.frequency) * velocity.rms > follows * of_velocity * force.rms) continue;
    if (above_motion * dominant_frequency(recording) > nominal) continue;
    hum.amplitude = Channel(recording.time, recording.displacement).at(hum.frequency);
    return hum;
  }
  return std::nullopt;
}

}  // namespace hysteron

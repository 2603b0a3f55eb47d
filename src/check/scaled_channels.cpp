#include "check/scaled_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// With fewer others their noise may be alike by chance.
constexpr std::size_t fewest_others = 3;
// What the others measure differs by this factor at least, and their noise by its root at most: it does not follow.
constexpr double differ = 2.0;
// Two estimates of one noise, and two tests of a programme, are as near as that; figures of a channel that is not in
// question are as near as those of another test (check/beside_others.cpp).
constexpr double near = 1.25;
constexpr double ordinary = 2.0;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] bool holds(double value, double factor) const {
    return value * factor >= low && value <= factor * high;
  }
};

enum Figure : std::size_t { stroke, speed, force, frequency, drive, figure_count };
using Figures = std::array<double, figure_count>;

// Centimetres or inches taken for millimetres, and metres for centimetres; decanewtons, kilograms-force (as good as
// ten), and kilonewtons for decanewtons. A thousand needs no noise: check/beside_others.hpp.
struct Channel {
  std::string_view name;
  std::string_view what;
  Figure size;
  std::vector<double> Recording::*values;
  std::span<const double> factors;
  double told;  // a unit of the message in SI
  std::string_view unit;
};
constexpr std::array lengths = {10.0, 25.4, 100.0};
constexpr std::array forces = {10.0, 100.0};
constexpr std::array<Channel, 2> channels = {
    {{"displacement", "stroke", stroke, &Recording::displacement, lengths, 1e-3, "mm"},
     {"force", "force", force, &Recording::force, forces, 1.0, "N"}}};

Figures figures_of(const Recording& recording) {
  Figures result{};
  result[stroke] = span_of(recording.displacement);
  // A recorded one may have a unit of its own.
  result[speed] = recording.velocity_measured ? 0.0 : peak_of(recording.velocity);
  result[force] = peak_of(recording.force);
  result[frequency] = recording.timed ? dominant_frequency(recording) : 0.0;
  result[drive] = peak_of(recording.drive);
  return result;
}

// Of the values but that of recording k.
Range range_beside(const std::vector<double>& values, std::size_t k) {
  Range range;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (j != k) range.add(values[j]);
  }
  return range;
}

// Whether a value is `factor` times one of the others', and far from all of these.
bool is_scaled(double value, double factor, const Range& others) {
  const double far = std::sqrt(std::max(factor, 1.0 / factor));
  return !others.holds(value, far) && others.holds(value / factor, near);
}

class ScaledChannels {
 public:
  explicit ScaledChannels(const std::vector<Recording>& recordings) : recordings_(recordings) {
    for (const Recording& recording : recordings) {
      const Figures figures = figures_of(recording);
      for (std::size_t f = 0; f < figure_count; ++f) figures_[f].push_back(figures[f]);
    }
  }

  // What is to be said of the channel of recording k.
  [[nodiscard]] std::optional<std::string> told_of(const Channel& channel, std::size_t k) {
    const Range sizes = range_beside(figures_[channel.size], k);
    if (!(sizes.low > 0.0) || sizes.high < differ * sizes.low) return std::nullopt;
    for (const double factor : channel.factors) {
      for (const double wrong : {factor, 1.0 / factor}) {
        if (!explains_figures(channel, wrong, k)) continue;
        const std::vector<double>& noise = noise_of(channel);
        const Range others = range_beside(noise, k);
        const bool of_the_sensor = others.low > 0.0 && others.high <= others.low * std::sqrt(sizes.high / sizes.low);
        if (of_the_sensor && is_scaled(noise[k], wrong, others)) {
          return text_of(channel, wrong, figures_[channel.size][k], sizes, noise[k], others);
        }
      }
    }
    return std::nullopt;
  }

 private:
  // Whether a channel that is `factor` times too large explains the figures of recording k.
  [[nodiscard]] bool explains_figures(const Channel& channel, double factor, std::size_t k) const {
    if (!is_scaled(figures_[channel.size][k], factor, range_beside(figures_[channel.size], k))) return false;
    for (const Figure figure : {stroke, speed, force, frequency, drive}) {
      if (figure == channel.size) continue;
      const bool follows = channel.size == stroke && figure == speed;
      const double value = follows ? figures_[figure][k] / factor : figures_[figure][k];
      if (!range_beside(figures_[figure], k).holds(value, ordinary)) return false;
    }
    return true;
  }

  const std::vector<double>& noise_of(const Channel& channel) {
    std::vector<double>& noise = noise_[channel.size];
    if (noise.empty()) {
      for (const Recording& one : recordings_) noise.push_back(channel_noise(one.time, one.*channel.values));
    }
    return noise;
  }

  static std::string text_of(const Channel& channel, double factor, double size, const Range& sizes, double noise,
                             const Range& of_others) {
    const auto number = [&](double value) { return fmt::format("{:.3g}", value / channel.told); };
    const auto range = [&](const Range& of) {
      return number(of.low) == number(of.high) ? number(of.low) : number(of.low) + " to " + number(of.high);
    };
    return fmt::format(
        "a {} of {} {} with a noise of {} {}, and {} {} with {} {} in the other recordings, whose noise does not "
        "follow the {}: both about {:g} times too {}, as in another unit; check that of the {}",
        channel.what, number(size), channel.unit, number(noise), channel.unit, range(sizes), channel.unit,
        range(of_others), channel.unit, channel.what, std::max(factor, 1.0 / factor), factor > 1.0 ? "large" : "small",
        channel.name);
  }

  const std::vector<Recording>& recordings_;
  std::array<std::vector<double>, figure_count> figures_;  // of the recordings
  std::array<std::vector<double>, figure_count> noise_;    // by the figure of the size, where it was asked for
};

bool has_motion_and_force(const Recording& recording) {
  return recording.displacement.size() == recording.size() && recording.force.size() == recording.size();
}

}  // namespace

std::vector<Remark> remarks_on_scaled_channels(const std::vector<Recording>& recordings) {
  std::vector<Remark> remarks;
  if (recordings.size() <= fewest_others || !std::ranges::all_of(recordings, has_motion_and_force)) return remarks;
  ScaledChannels scaled(recordings);
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    for (const Channel& channel : channels) {
      if (const auto text = scaled.told_of(channel, k)) {
        remarks.push_back(
            {recordings[k].file, Remark::Kind::implausible, "unit of " + std::string(channel.name), *text});
      }
    }
  }
  return remarks;
}

}  // namespace hysteron

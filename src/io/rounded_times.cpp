#include "io/rounded_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/squared.hpp"

namespace hysteron {
namespace {

// With fewer samples two sizes of steps come by chance.
constexpr std::size_t fewest_samples = 50;
// A resolution that is finer against the step makes no velocity wrong by as much as a sensor is.
constexpr double coarse = 0.01;
// Of a resolution: what the arithmetic on numbers of the file adds, and what the grid of least squares leaves beside
// the half on either side.
constexpr double rounding = 1e-2;
constexpr double within = 1.2;
// The speed at a step is that of so many steps on either side of it.
constexpr std::size_t steps_beside = 3;
// How much of a longer step the displacement goes further, 0 where it is as long as the others and 1 where it is real,
// is told to so much, and is as near to 0.
constexpr double near = 0.25;

// Where the steps are of two sizes, one resolution apart, and multiples of it.
std::optional<double> resolution_of(const std::vector<double>& time) {
  double shortest = time[1] - time[0];
  double longest = shortest;
  for (std::size_t n = 0; n + 1 < time.size(); ++n) {
    shortest = std::min(shortest, time[n + 1] - time[n]);
    longest = std::max(longest, time[n + 1] - time[n]);
  }
  const double resolution = longest - shortest;
  if (resolution < coarse * longest) return std::nullopt;
  const double of_shortest = shortest / resolution;
  if (of_shortest < 1.0 - rounding || std::fabs(of_shortest - std::round(of_shortest)) > rounding) return std::nullopt;
  for (std::size_t n = 0; n + 1 < time.size(); ++n) {
    const double step = time[n + 1] - time[n];
    if (std::min(step - shortest, longest - step) > rounding * resolution) return std::nullopt;
  }
  return resolution;
}

// The even grid of least squares, where all times are within the resolution of it.
std::optional<RoundedTimes> grid_of(const std::vector<double>& time, double resolution) {
  const double middle = 0.5 * static_cast<double>(time.size() - 1);
  const auto from_middle = [&](std::size_t n) { return static_cast<double>(n) - middle; };
  double mean = 0.0;  // past the first time
  for (const double t : time) mean += (t - time.front()) / static_cast<double>(time.size());
  double product = 0.0;
  double squares = 0.0;
  for (std::size_t n = 0; n < time.size(); ++n) {
    product += from_middle(n) * (time[n] - time.front() - mean);
    squares += squared(from_middle(n));
  }
  const double step = product / squares;
  double before = 0.0;
  double behind = 0.0;
  for (std::size_t n = 0; n < time.size(); ++n) {
    const double off = time[n] - time.front() - mean - step * from_middle(n);
    before = std::min(before, off);
    behind = std::max(behind, off);
  }
  if (behind - before > within * resolution) return std::nullopt;
  return RoundedTimes{resolution, step, time.front() + mean - step * middle};
}

// Whether the displacement goes no further over the longer steps.
bool goes_evenly(const std::vector<double>& time, const std::vector<double>& displacement, double step) {
  double product = 0.0;
  double squares = 0.0;
  double missed = 0.0;
  std::size_t count = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t n = steps_beside; n + 1 + steps_beside < time.size(); ++n) {
      const double mean = (displacement[n + 1 + steps_beside] - displacement[n - steps_beside]) /
                          static_cast<double>(2 * steps_beside + 1);
      visit(displacement[n + 1] - displacement[n] - mean, mean * (time[n + 1] - time[n] - step) / step);
    }
  };
  each([&](double further, double expected) {
    product += further * expected;
    squares += squared(expected);
  });
  if (!(squares > 0.0)) return false;
  const double part = product / squares;
  each([&](double further, double expected) {
    missed += squared(further - part * expected);
    ++count;
  });
  const double error = std::sqrt(missed / static_cast<double>(count) / squares);
  return error < near && std::fabs(part) < near;
}

}  // namespace

std::optional<RoundedTimes> rounded_times_of(const std::vector<double>& time, const std::vector<double>& displacement) {
  if (time.size() < fewest_samples || displacement.size() != time.size()) return std::nullopt;
  const auto resolution = resolution_of(time);
  if (!resolution) return std::nullopt;
  const auto grid = grid_of(time, *resolution);
  return grid && goes_evenly(time, displacement, grid->step) ? grid : std::nullopt;
}

void even_out_rounded_times(Channels& channels, const ReadOptions& options, const std::string& file) {
  std::vector<double>& time = channels[static_cast<std::size_t>(Quantity::time)];
  const auto rounded = rounded_times_of(time, channels[static_cast<std::size_t>(Quantity::displacement)]);
  if (!rounded) return;
  if (options.remark) {
    options.remark(
        {file, Remark::Kind::implausible, "rounded times",
         fmt::format("the times are rounded to {:.3g} ms, which makes steps of {:.4g} and {:.4g} ms, and the "
                     "displacement goes no further over a long step than over a short one; the samples are taken as "
                     "evenly spaced, by {:.5g} ms",
                     1e3 * rounded->resolution,
                     1e3 * rounded->resolution * std::floor(rounded->step / rounded->resolution),
                     1e3 * rounded->resolution * std::ceil(rounded->step / rounded->resolution), 1e3 * rounded->step)});
  }
  for (std::size_t n = 0; n < time.size(); ++n) time[n] = rounded->start + static_cast<double>(n) * rounded->step;
}

}  // namespace hysteron

#include "io/time_packets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/robust.hpp"
#include "core/squared.hpp"

namespace hysteron {
namespace {

// A longer step is this many times the usual one at least; packets have so many samples, of two every second step would
// be long; there are so many packets, and this share of them has the same number of samples.
constexpr double longer = 1.5;
constexpr std::size_t fewest_samples = 3;
constexpr std::size_t fewest_packets = 4;
constexpr double alike = 0.9;
// The speed beside a longer step is that of so many steps on either side: of one alone its noise would be the
// displacement's.
constexpr std::size_t steps_beside = 4;
// The displacement goes by one step of its own over a longer one, and not by as many as that is longer, when it is
// nearer to the one by this part of what lies between, and by so much at most.
constexpr double near = 0.25;

struct LongSteps {
  std::vector<std::size_t> after;  // the steps from these samples on
  std::size_t apart = 0;           // usual number of samples from one to the next
  double usual = 0.0;              // s, of the other steps
};

std::optional<LongSteps> long_steps_of(const std::vector<double>& time) {
  constexpr std::size_t most_looked_at = 65536;
  if (time.size() < fewest_packets * fewest_samples) return std::nullopt;
  std::vector<double> steps;
  // Side by side: of every k-th step all might be long.
  for (std::size_t n = 0; n + 1 < std::min(time.size(), most_looked_at); ++n) steps.push_back(time[n + 1] - time[n]);
  LongSteps result;
  result.usual = median_of(std::move(steps));
  for (std::size_t n = 0; n + 1 < time.size(); ++n) {
    if (time[n + 1] - time[n] > longer * result.usual) result.after.push_back(n);
  }
  if (result.after.size() < fewest_packets) return std::nullopt;
  std::vector<double> apart;
  for (std::size_t k = 1; k < result.after.size(); ++k) {
    apart.push_back(static_cast<double>(result.after[k] - result.after[k - 1]));
  }
  const double most = median_of(apart);
  const auto same = static_cast<double>(std::ranges::count(apart, most));
  if (most < static_cast<double>(fewest_samples) || same < alike * static_cast<double>(apart.size())) {
    return std::nullopt;
  }
  result.apart = static_cast<std::size_t>(most);
  return result;
}

}  // namespace

std::optional<TimePackets> time_packets_of(const std::vector<double>& time, const std::vector<double>& displacement) {
  if (displacement.size() != time.size()) return std::nullopt;
  const auto steps = long_steps_of(time);
  if (!steps) return std::nullopt;
  const std::size_t reach = std::min(steps->apart - 1, steps_beside);
  std::vector<double> lengths;
  for (const std::size_t n : steps->after) lengths.push_back(time[n + 1] - time[n]);
  const double between = median_of(std::move(lengths));
  double over_over = 0.0;
  double over_beside = 0.0;
  double beside_beside = 0.0;
  for (const std::size_t n : steps->after) {
    // Where a packet is missing the displacement goes further.
    if (n < reach || n + 1 + reach >= time.size() || time[n + 1] - time[n] > longer * between) continue;
    const double over = displacement[n + 1] - displacement[n];
    const double beside =
        (displacement[n] - displacement[n - reach] + displacement[n + 1 + reach] - displacement[n + 1]) /
        static_cast<double>(2 * reach);
    over_over += squared(over);
    over_beside += over * beside;
    beside_beside += squared(beside);
  }
  if (!(over_over > 0.0) || !(beside_beside > 0.0)) return std::nullopt;
  TimePackets result;
  result.samples = steps->apart;
  result.within = steps->usual;
  result.between = between;
  // Regression of the one on the other, and how much it tells: noise alone tells nothing.
  const double ratio = result.between / result.within;
  const double by = over_beside / beside_beside;
  const double told = squared(over_beside) / (over_over * beside_beside);
  if (std::fabs(by - 1.0) > near * std::min(1.0, ratio - 1.0) || told < 0.5 + 0.5 / ratio) return std::nullopt;
  const std::size_t first = steps->after.front() + 1;
  const std::size_t last = steps->after.back() + 1;
  result.step = (time[last] - time[first]) / static_cast<double>(last - first);
  const double packet = result.step * static_cast<double>(result.samples);
  result.even = std::ranges::all_of(steps->after, [&](std::size_t n) {
    const double expected = time[first] + static_cast<double>(n + 1 - first) * result.step;
    return std::fabs(time[n + 1] - expected) <= 0.5 * packet && time[n + 1] - time[n] <= longer * between;
  });
  return result;
}

void even_out_packets(Channels& channels, const ReadOptions& options, const std::string& file) {
  std::vector<double>& time = channels[static_cast<std::size_t>(Quantity::time)];
  const auto packets = time_packets_of(time, channels[static_cast<std::size_t>(Quantity::displacement)]);
  if (!packets) return;
  if (options.remark) {
    const std::string what = fmt::format(
        "the times come in packets of {} samples, {:.4g} ms apart and {:.4g} ms to the next packet, and the "
        "displacement goes no further over a long step than over a short one: they tell when packets arrived",
        packets->samples, 1e3 * packets->within, 1e3 * packets->between);
    options.remark(
        {file, Remark::Kind::implausible, "packets",
         packets->even
             ? fmt::format("{}; the samples are taken as evenly spaced, by {:.4g} ms", what, 1e3 * packets->step)
             : what + ", and not all packets are there: velocities are wrong; record the times of the "
                      "samples"});
  }
  if (!packets->even) return;
  const double start = time.front();
  for (std::size_t n = 0; n < time.size(); ++n) time[n] = start + static_cast<double>(n) * packets->step;
}

}  // namespace hysteron

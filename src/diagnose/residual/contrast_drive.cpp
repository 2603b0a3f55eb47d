// What the force does with the drive: its lag after a change, what remains after a step down, its curvature over the
// levels. The sensitivity of the force to the drive is that of the simulated force, A'(i) F / A(i), with A its mean
// size at that drive.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/drive.hpp"
#include "core/extent.hpp"
#include "diagnose/residual/contrast_panel.hpp"

namespace hysteron::contrast {
namespace {

constexpr double channel_delay = 0.005;   // s: what a delay of the force channel does at a step as well is left out
constexpr double reference_lag = 0.02;    // s: small lags count by what the force lacks in sum
constexpr double half_play = 0.25;        // of the range of the drive, of the memory that is looked for
constexpr double least_size = 0.05;       // of the largest mean size of the force, that A(i) is kept above
constexpr double level = 0.08;            // of the range: drives nearer to one another are one level
constexpr std::size_t fewest_levels = 3;  // that tell a curve from a line

// The drive behind a first-order lag that the drive before the first sample has settled through; linear in between.
Values lagged(const Track& track) {
  Values result(track.drive.size());
  double state = track.drive.front();
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (n > 0) {
      const double elapsed = track.time[n] - track.time[n - 1];
      const double behind = (track.drive[n] - track.drive[n - 1]) / elapsed * reference_lag;
      state = track.drive[n] - behind + (state - track.drive[n - 1] + behind) * std::exp(-elapsed / reference_lag);
    }
    result[n] = state;
  }
  return result;
}

// The drive `delay` s earlier, linear between samples.
Values earlier(const Track& track, double delay) {
  Values result(track.drive.size());
  std::size_t k = 0;
  for (std::size_t n = 0; n < result.size(); ++n) {
    const double at = track.time[n] - delay;
    while (k + 1 < n && track.time[k + 1] <= at) {
      ++k;
    }
    const std::size_t next = std::min(k + 1, result.size() - 1);
    const double step = track.time[next] - track.time[k];
    const double part = step > 0.0 ? std::clamp((at - track.time[k]) / step, 0.0, 1.0) : 0.0;
    result[n] = track.drive[k] + part * (track.drive[next] - track.drive[k]);
  }
  return result;
}

// A play of half width `half` behind the drive, less the drive.
Values memory(const Track& track, double half) {
  Values result(track.drive.size());
  double state = track.drive.front();
  for (std::size_t n = 0; n < result.size(); ++n) {
    state = std::clamp(state, track.drive[n] - half, track.drive[n] + half);
    result[n] = state - track.drive[n];
  }
  return result;
}

}  // namespace

void add_drive_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  double low = tracks.front().drive.empty() ? 0.0 : tracks.front().drive.front();
  double high = low;
  for (const Track& track : tracks) {
    if (track.drive.empty()) {
      return;
    }
    for (const double drive : track.drive) {
      low = std::min(low, drive);
      high = std::max(high, drive);
    }
  }
  const double range = high - low;
  if (!(range > 0.02 * std::max(std::fabs(low), std::fabs(high)))) {
    return;
  }
  // A(i) = A_0 + A_1 (i - middle): the mean size of the simulated force over the drive.
  const double middle = 0.5 * (low + high);
  double weights = 0.0;
  double d = 0.0;
  double dd = 0.0;
  double s = 0.0;
  double ds = 0.0;
  std::set<long> levels;
  bool moves = false;
  for (const Track& track : tracks) {
    moves = moves || varies(track.drive);
    for (std::size_t n = track.from; n < track.drive.size(); ++n) {
      const double weight = track.duration[n] / (track.time.back() - track.time[track.from]);
      const double of = track.drive[n] - middle;
      weights += weight;
      d += weight * of;
      dd += weight * of * of;
      s += weight * std::fabs(track.simulated[n]);
      ds += weight * of * std::fabs(track.simulated[n]);
      levels.insert(std::lround((track.drive[n] - low) / (level * range)));
    }
  }
  const double determinant = weights * dd - d * d;
  if (!(determinant > 1e-9 * weights * dd)) {
    return;
  }
  const double slope = (weights * ds - d * s) / determinant;
  const double mean = (dd * s - d * ds) / determinant;
  const double largest = mean + std::fabs(slope) * 0.5 * range;
  const auto shape = [=](const Track& t, std::size_t n) {
    return t.simulated[n] / std::max(mean + slope * (t.drive[n] - middle), least_size * largest);
  };

  Panel panel(tracks, &Track::missing, placebos);
  const auto add = [&](auto&& value) { return panel.add(value); };
  const Panel::Column one = add([](const Track&, std::size_t) { return 1.0; });
  const Panel::Column x = add([](const Track& t, std::size_t n) { return t.x[n]; });
  const Panel::Column v = add([](const Track& t, std::size_t n) { return t.v[n]; });
  const Panel::Column vd = add([=](const Track& t, std::size_t n) { return t.v[n] * (t.drive[n] - middle); });
  const Panel::Column f = add([](const Track& t, std::size_t n) { return t.simulated[n]; });
  const Panel::Column yield = add(shape);
  const Panel::Column yield_d = add([=](const Track& t, std::size_t n) { return shape(t, n) * (t.drive[n] - middle); });
  const std::vector<Panel::Column> base = {one, x, v, vd, f, yield, yield_d};
  const auto contrast = [&](ContrastKind kind, Panel::Column signature, std::vector<Panel::Column> without,
                            std::initializer_list<Panel::Column> also) {
    without.insert(without.end(), also);
    if (std::optional<Contrast> found = panel.partial(kind, std::vector{signature}, without)) {
      // Most recordings are of one level: the curvature is over the levels of all.
      found->of_all = kind == ContrastKind::drive_bend;
      result.push_back(std::move(*found));
    }
  };
  if (levels.size() >= fewest_levels) {
    const Panel::Column bend = add([=](const Track& t, std::size_t n) {
      const double of = t.drive[n] - middle;
      return shape(t, n) * of * of;
    });
    contrast(ContrastKind::drive_bend, bend, base, {});
  }
  if (!moves) {
    return;
  }
  std::vector<Values> behind;
  std::vector<Values> remaining;
  std::vector<Values> delayed;
  for (const Track& track : tracks) {
    delayed.push_back(earlier(track, channel_delay));
    behind.push_back(lagged(track));
    remaining.push_back(memory(track, half_play * range));
  }
  const auto number = [&](const Track& t) { return static_cast<std::size_t>(&t - tracks.data()); };
  const Panel::Column lag = add([&](const Track& t, std::size_t n) {
    return slope * shape(t, n) * (behind[number(t)][n] - t.drive[n]) / reference_lag;
  });
  const Panel::Column stays =
      add([&](const Track& t, std::size_t n) { return slope * shape(t, n) * remaining[number(t)][n]; });
  const Panel::Column later = add([](const Track& t, std::size_t n) { return -t.slope[n]; });
  const Panel::Column shifted =
      add([&](const Track& t, std::size_t n) { return slope * shape(t, n) * (delayed[number(t)][n] - t.drive[n]); });
  contrast(ContrastKind::drive_lag, lag, base, {stays, later, shifted});
  // A play tells the way down from the way up where the drive goes both by its half width: of a drive that only rises,
  // or trembles about one value, what stays behind is less drive, and no memory.
  if (std::ranges::any_of(tracks, [&](const Track& t) { return turned_by(t.drive) > half_play * range; })) {
    contrast(ContrastKind::drive_memory, stays, base, {lag, later, shifted});
  }
}

}  // namespace hysteron::contrast

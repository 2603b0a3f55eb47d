#include "check/beside_others.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "core/apart.hpp"
#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "core/robust.hpp"

namespace hysteron {
namespace {

constexpr double thousand = 1e3;
// What is farther than this from the others is nearer to a thousand times their size.
const double far = std::sqrt(thousand);
// A recording of the right unit lies within the range of the others, or not far from it: by a factor of two.
constexpr double near = 2.0;
constexpr std::size_t fewest_alike = 2;

enum Figure : std::size_t { stroke, speed, force, frequency, step, figure_count };
using Figures = std::array<double, figure_count>;  // 0: not known

struct Range {
  double low = 0.0;
  double high = 0.0;
  [[nodiscard]] bool holds(double value, double factor) const {
    return value * factor >= low && value <= factor * high;
  }
};

// A channel, the power of its unit in every figure, and the figure that is told.
struct Suspect {
  std::string_view channel;
  std::array<int, figure_count> powers;
  Figure told;
  std::string_view what;
  double factor;  // to the unit told
  std::string_view unit;
};
constexpr std::array<Suspect, 3> suspects = {{
    {"displacement", {1, 1, 0, 0, 0}, stroke, "stroke", 1e3, "mm"},
    {"time", {0, -1, 0, -1, 1}, frequency, "main frequency", 1.0, "Hz"},
    {"force", {0, 0, 1, 0, 0}, force, "force", 1.0, "N"},
}};

Figures figures_of(const Recording& recording) {
  Figures result{};
  result[stroke] = span_of(recording.displacement);
  // A recorded one has a unit of its own, and is held against the slope of the displacement.
  result[speed] = recording.velocity_measured ? 0.0 : peak_of(recording.velocity);
  result[force] = peak_of(recording.force);
  if (recording.timed) {
    result[frequency] = dominant_frequency(recording);
    result[step] = (recording.time.back() - recording.time.front()) / static_cast<double>(recording.size() - 1);
  }
  return result;
}

std::optional<double> median_of(const std::vector<Figures>& all, std::size_t figure) {
  std::vector<double> values;
  for (const Figures& one : all) {
    if (one[figure] > 0.0) values.push_back(one[figure]);
  }
  if (values.empty()) return std::nullopt;
  return hysteron::median_of(std::move(values));
}

// The ranges of the recordings that are near the median in all figures; nothing where these are not most of them.
std::optional<std::array<Range, figure_count>> ranges_of_most(const std::vector<Figures>& all) {
  std::array<std::optional<double>, figure_count> medians;
  for (std::size_t f = 0; f < figure_count; ++f) medians[f] = median_of(all, f);
  std::array<Range, figure_count> ranges;
  std::size_t alike = 0;
  for (const Figures& one : all) {
    bool is_near = true;
    for (std::size_t f = 0; f < figure_count; ++f) {
      is_near = is_near && (one[f] == 0.0 || Range{*medians[f], *medians[f]}.holds(one[f], far));
    }
    if (!is_near) continue;
    ++alike;
    for (std::size_t f = 0; f < figure_count; ++f) {
      if (one[f] == 0.0) continue;
      ranges[f].low = ranges[f].low == 0.0 ? one[f] : std::min(ranges[f].low, one[f]);
      ranges[f].high = std::max(ranges[f].high, one[f]);
    }
  }
  return alike >= fewest_alike && 2 * alike > all.size() ? std::optional(ranges) : std::nullopt;
}

// Whether the suspect explains the figures with its unit `factor` times too large.
bool explains(const Suspect& suspect, double factor, const Figures& figures,
              const std::array<Range, figure_count>& ranges) {
  if (figures[suspect.told] == 0.0 || ranges[suspect.told].high == 0.0) return false;
  for (std::size_t f = 0; f < figure_count; ++f) {
    if (figures[f] == 0.0 || ranges[f].high == 0.0) continue;
    const int power = suspect.powers[f];
    if (power == 0 && f == step) continue;  // rates differ as they like
    if (power != 0 && ranges[f].holds(figures[f], far)) return false;
    if (!ranges[f].holds(figures[f] * std::pow(factor, -power), near)) return false;
  }
  return true;
}

// Units of displacement and force that are wrong together: the columns have no units, and were taken in SI.
struct Customary {
  double displacement;  // m
  double force;         // N
  std::string_view units;
};
constexpr std::array<Customary, 2> customary = {{
    {0.0254, 4.4482216152605, "inches and pounds-force"},
    {0.0254, 9.80665, "inches and kilograms-force"},
}};
// What a recording with these units has, stroke and speed this far beyond those of all others and a force as far on the
// other side of theirs, and how near it comes by the units. A drive within a twentieth is the same.
constexpr double far_together = 10.0;
constexpr double force_apart = 2.0;
constexpr double near_together = 1.5;
constexpr double same_drive = 1.05;

// The ranges of the recordings beside `k` whose drive is no reason for the force to differ so: where the stroke is too
// long (`sign` 1) and the force too small, theirs is no larger, else no smaller. Nothing where these are few.
std::optional<std::array<Range, figure_count>> ranges_of_others(const std::vector<Recording>& recordings,
                                                                const std::vector<Figures>& all, std::size_t k,
                                                                double sign) {
  std::array<Range, figure_count> ranges;
  std::size_t alike = 0;
  const double own = peak_of(recordings[k].drive);
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double drive = peak_of(recordings[j].drive);
    const bool no_reason = sign > 0.0 ? drive <= same_drive * own : own <= same_drive * drive;
    if (j == k || recordings[j].drive_kind != recordings[k].drive_kind || !no_reason) continue;
    ++alike;
    for (const Figure f : {stroke, speed, force}) {
      if (all[j][f] == 0.0) return std::nullopt;
      ranges[f].low = alike == 1 ? all[j][f] : std::min(ranges[f].low, all[j][f]);
      ranges[f].high = std::max(ranges[f].high, all[j][f]);
    }
  }
  return alike >= fewest_alike ? std::optional(ranges) : std::nullopt;
}

// A stroke and a speed far beyond those of all others with a smaller force, or far below them with a larger one:
// dampers do not so, and numbers in inches and pounds-force that are taken for SI do. Inches taken for millimetres, or
// kilograms-force for newtons alone, look like another test of the same damper.
std::optional<std::string> customary_units_of(const std::vector<Recording>& recordings, const std::vector<Figures>& all,
                                              std::size_t k) {
  const Figures& own = all[k];
  if (own[stroke] == 0.0 || own[speed] == 0.0 || own[force] == 0.0) return std::nullopt;
  for (const double sign : {1.0, -1.0}) {
    const auto others = ranges_of_others(recordings, all, k, sign);
    if (!others) continue;
    const Range& x = (*others)[stroke];
    const Range& v = (*others)[speed];
    const Range& f = (*others)[force];
    const bool apart = sign > 0.0 ? own[stroke] > far_together * x.high && own[speed] > far_together * v.high &&
                                        force_apart * own[force] < f.low
                                  : far_together * own[stroke] < x.low && far_together * own[speed] < v.low &&
                                        own[force] > force_apart * f.high;
    if (!apart) continue;
    const auto range = [](const Range& of, double factor) {
      const std::string low = fmt::format("{:.3g}", factor * of.low);
      const std::string high = fmt::format("{:.3g}", factor * of.high);
      return low == high ? low : low + " to " + high;
    };
    for (const Customary& units : customary) {
      const double to_metres = std::pow(units.displacement, sign);
      if (!x.holds(to_metres * own[stroke], near_together) || !v.holds(to_metres * own[speed], near_together) ||
          !f.holds(std::pow(units.force, sign) * own[force], near_together)) {
        continue;
      }
      return fmt::format(
          "a stroke of {:.3g} mm with a force of {:.3g} N, and {} mm with {} N in the other recordings, as where the "
          "numbers of {} are in {} and taken for m and N: check the units of displacement and force",
          1e3 * own[stroke], own[force], range(x, 1e3), range(f, 1.0), sign > 0.0 ? "this one" : "the others",
          units.units);
    }
  }
  return std::nullopt;
}

void tell_of_customary_units(const std::vector<Recording>& recordings, std::vector<Figures> all,
                             std::vector<Remark>& remarks) {
  // A recorded velocity has the unit of the displacement here, or is told where it is held against its slope.
  for (std::size_t k = 0; k < all.size(); ++k) all[k][speed] = peak_of(recordings[k].velocity);
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (const auto text = customary_units_of(recordings, all, k)) {
      remarks.push_back({recordings[k].file, Remark::Kind::implausible, "units of displacement and force", *text});
    }
  }
}

// The drive of the recordings of one kind. Apart from the other figures, because dampers are driven over decades, and
// one that is switched off has any small value.
std::vector<double> drives_of(const std::vector<Recording>& recordings, DriveKind kind) {
  std::vector<double> drives;
  drives.reserve(recordings.size());
  for (const Recording& recording : recordings) {
    drives.push_back(recording.drive_kind == kind ? peak_of(recording.drive) : 0.0);
  }
  return drives;
}

// The range of those near their median; nothing where these are not most of them.
std::optional<Range> range_of_most(const std::vector<double>& values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known), [](double value) { return value > 0.0; });
  if (known.empty()) return std::nullopt;
  const double median = hysteron::median_of(known);
  const std::size_t count = known.size();
  std::erase_if(known, [&](double value) { return !Range{median, median}.holds(value, far); });
  if (known.size() < fewest_alike || 2 * known.size() <= count) return std::nullopt;
  const auto [low, high] = std::ranges::minmax(known);
  return Range{low, high};
}

// Noise about zero, of a drive that is off, has no unit that is wrong.
bool is_off(const std::vector<double>& drive, const Range& others) {
  const auto [low, high] = std::ranges::minmax(drive);
  return low < 0.0 && high > 0.0 && peak_of(drive) < others.low;
}

bool has_another_unit(double value, const Range& others) {
  return value > 0.0 && !others.holds(value, far) &&
         (others.holds(value * thousand, near) || others.holds(value / thousand, near));
}

std::string text_of(const Suspect& suspect, double value, const Range& others) {
  const auto number = [&](double figure) { return fmt::format("{:.3g}", suspect.factor * figure); };
  const std::string low = number(others.low);
  const std::string high = number(others.high);
  return fmt::format(
      "a {} of {} {}, and {} {} in the other recordings, a factor of a thousand: check the unit of the {}",
      suspect.what, number(value), suspect.unit, low == high ? low : low + " to " + high, suspect.unit,
      suspect.channel);
}

void tell_of_zeros(const std::vector<Recording>& recordings, std::vector<Remark>& remarks) {
  for (const Apart& apart : apart_from_others(recordings)) {
    remarks.push_back(
        {recordings[apart.recording].file, Remark::Kind::implausible, "zero of displacement",
         fmt::format(
             "a displacement of {:.4g} to {:.4g} mm, and of {:.4g} to {:.4g} mm in all other recordings: if the "
             "sensor's zero was set differently, correct it; a stiffness, a gas spring or an end stop would be read "
             "from it",
             1e3 * apart.own.low, 1e3 * apart.own.high, 1e3 * apart.others.low, 1e3 * apart.others.high)});
  }
}

void tell_of_drives(const std::vector<Recording>& recordings, std::vector<Remark>& remarks) {
  for (const DriveKind kind : {DriveKind::current, DriveKind::voltage}) {
    const std::vector<double> drives = drives_of(recordings, kind);
    const std::optional<Range> most = range_of_most(drives);
    if (!most) continue;
    const std::string_view channel = kind == DriveKind::current ? "current" : "voltage";
    const Suspect suspect{channel, {}, {}, channel, 1.0, kind == DriveKind::current ? "A" : "V"};
    for (std::size_t k = 0; k < drives.size(); ++k) {
      if (!has_another_unit(drives[k], *most) || is_off(recordings[k].drive, *most)) continue;
      remarks.push_back({recordings[k].file, Remark::Kind::implausible, "unit of " + std::string(channel),
                         text_of(suspect, drives[k], *most)});
    }
  }
}

// The sign of a drive that is never of the other; 0 of one that is off or has both. Up to this part of the largest
// drive of the campaign it is the noise of a sensor.
constexpr double nearly_off = 0.02;
int sign_of(const std::vector<double>& drive, double largest) {
  if (drive.empty()) return 0;
  const auto [low, high] = std::ranges::minmax(drive);
  if (high > nearly_off * largest && low >= -nearly_off * largest) return 1;
  return low < -nearly_off * largest && high <= nearly_off * largest ? -1 : 0;
}

// A drive below zero in few recordings where most are driven above it, as far: leads that were exchanged. A damper that
// is driven both ways is so within a recording, or in about as many.
void tell_of_signs(const std::vector<Recording>& recordings, std::vector<Remark>& remarks) {
  constexpr std::size_t fewest_of_most = 3;
  constexpr std::size_t most_to_each = 3;
  for (const DriveKind kind : {DriveKind::current, DriveKind::voltage}) {
    const std::vector<double> drives = drives_of(recordings, kind);
    const double largest = peak_of(drives);
    std::array<std::vector<std::size_t>, 2> with;  // below zero, above
    bool both = false;
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      if (!(drives[k] > 0.0)) continue;
      const int sign = sign_of(recordings[k].drive, largest);
      if (sign != 0) with[sign > 0 ? 1 : 0].push_back(k);
      both = both || (sign == 0 && !(drives[k] <= nearly_off * largest));
    }
    const std::size_t few = with[0].size() < with[1].size() ? 0 : 1;
    const std::vector<std::size_t>& most = with[1 - few];
    if (both || with[few].empty() || most.size() < fewest_of_most || with[few].size() * most_to_each > most.size()) {
      continue;
    }
    const auto is_alike = [&](std::size_t k) {
      return std::ranges::any_of(most, [&](std::size_t other) {
        return std::max(drives[k], drives[other]) <= same_drive * std::min(drives[k], drives[other]);
      });
    };
    if (!std::ranges::all_of(with[few], is_alike)) continue;
    const std::string channel = kind == DriveKind::current ? "current" : "voltage";
    const std::string_view unit = kind == DriveKind::current ? "A" : "V";
    double low = drives[most.front()];
    double high = low;
    for (const std::size_t k : most) {
      low = std::min(low, drives[k]);
      high = std::max(high, drives[k]);
    }
    const double sign = few == 0 ? 1.0 : -1.0;  // of most
    for (const std::size_t k : with[few]) {
      remarks.push_back(
          {recordings[k].file, Remark::Kind::implausible, "sign of " + channel,
           fmt::format("a {} of {:.3g} {}, and of {:.3g} to {:.3g} {} in the others: a law in the {} takes both signs "
                       "for opposite settings; if the leads were exchanged, correct the sign",
                       channel, -sign * drives[k], unit, sign * (sign > 0.0 ? low : high),
                       sign * (sign > 0.0 ? high : low), unit, channel)});
    }
  }
}

}  // namespace

std::vector<Remark> remarks_beside_others(const std::vector<Recording>& recordings) {
  std::vector<Figures> all(recordings.size());
  std::ranges::transform(recordings, all.begin(), figures_of);
  std::vector<Remark> remarks;
  tell_of_drives(recordings, remarks);
  tell_of_signs(recordings, remarks);
  tell_of_zeros(recordings, remarks);
  tell_of_customary_units(recordings, all, remarks);
  const auto ranges = ranges_of_most(all);
  if (!ranges) return remarks;
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const Suspect& suspect : suspects) {
      if (!explains(suspect, thousand, all[k], *ranges) && !explains(suspect, 1.0 / thousand, all[k], *ranges))
        continue;
      remarks.push_back({recordings[k].file, Remark::Kind::implausible, "unit of " + std::string(suspect.channel),
                         text_of(suspect, all[k][suspect.told], (*ranges)[suspect.told])});
    }
  }
  return remarks;
}

}  // namespace hysteron

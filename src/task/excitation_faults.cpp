#include "task/excitation_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/extent.hpp"
#include "io/channel_faults.hpp"
#include "io/motion_faults.hpp"
#include "io/outliers.hpp"
#include "io/plausible.hpp"
#include "io/velocity.hpp"
#include "task/load.hpp"

namespace hysteron {
namespace {

// What remark_on_sizes says of a displacement alone, by these times.
std::vector<Remark> of_displacement(const Recording& recording, std::vector<double> displacement) {
  Recording motion;
  motion.time = recording.time;
  motion.velocity = derive_velocity(motion.time, displacement);
  motion.displacement = std::move(displacement);
  // Whether the file gave the units is not known any more: they count as given.
  const std::vector<Column> columns = {{"time", "time", "s", ""}, {"base", "base", "m", ""}};
  Sources sources;
  sources[static_cast<std::size_t>(Quantity::time)].column = 0;
  sources[static_cast<std::size_t>(Quantity::displacement)].column = 1;
  std::vector<Remark> remarks;
  ReadOptions options;
  options.force_required = false;
  options.remark = [&](const Remark& remark) { remarks.push_back(remark); };
  remark_on_sizes(motion, sources, columns, options, recording.file);
  return remarks;
}

// Whether the channel moves but for these samples: a blow from rest is meant.
bool moves_without(const std::vector<double>& values, const std::vector<std::size_t>& out) {
  std::vector<bool> is_out(values.size() + 1, false);
  for (const std::size_t n : out) is_out[n] = true;
  std::vector<double> others;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!is_out[n]) others.push_back(values[n]);
  }
  return span_of(others) > 0.0;
}

// `what` is such as "a force", in `unit`.
std::optional<Remark> spikes_of(const Recording& recording, const std::vector<double>& values, const std::string& what,
                                const std::string& unit) {
  std::vector<Outlier> beyond = outliers_of(recording.time, values);
  std::erase_if(beyond, [](const Outlier& one) { return !one.extreme; });
  std::size_t at = 0;
  double told = 0.0;
  std::size_t count = 0;
  std::vector<std::size_t> out;
  if (!beyond.empty()) {
    const auto furthest =
        std::ranges::max_element(beyond, {}, [&](const Outlier& one) { return std::fabs(values[one.at] - one.told); });
    at = furthest->at;
    told = furthest->told;
    count = beyond.size();
    for (const Outlier& one : beyond) out.push_back(one.at);
  } else if (const auto glitch = excursion_of(recording.time, values)) {
    at = glitch->at;
    told = glitch->from;
    count = glitch->count;
    out = {at, at + 1};
  }
  if (count == 0 || !moves_without(values, out)) return std::nullopt;
  return Remark{recording.file, Remark::Kind::implausible, what,
                fmt::format("{} of {:.3g} {} at {:.4g} s where its neighbours tell {:.3g} {}, {} sample{} like that: a "
                            "sensor that fails for a moment looks so; cut {}{}",
                            what, values[at], unit, recording.time[at], told, unit, count, count == 1 ? "" : "s",
                            count == 1 ? "it" : "them", unit == "N" ? " unless a blow is meant" : "")};
}

std::vector<Remark> of_force(const Recording& recording) {
  const std::vector<double>& force = recording.force;
  std::vector<Remark> remarks;
  const auto tell = [&](const std::string& key, const std::string& text) {
    remarks.push_back({recording.file, Remark::Kind::implausible, key, text});
  };
  if (const auto placeholder = placeholder_of(force)) {
    tell(
        "force placeholder",
        fmt::format("the force is exactly {:.6g} N in {} samples, first at {:.4g} s, and all others are from {:.3g} to "
                    "{:.3g} N: a number that stands for missing samples looks so; cut them",
                    placeholder->value, placeholder->count, recording.time[placeholder->first], placeholder->low,
                    placeholder->high));
  } else if (const auto spikes = spikes_of(recording, force, "a force", "N")) {
    remarks.push_back(*spikes);
  }
  if (const auto dropouts = dropouts_of(force)) {
    tell("dropouts of force",
         fmt::format("the force jumps to exactly 0 and back {} times, first at {:.4g} s, far beyond its other steps: a "
                     "sensor or a transmission that fails for moments looks so; cut these samples",
                     dropouts->count, recording.time[dropouts->first]));
  }
  return remarks;
}

}  // namespace

std::vector<Remark> faults_of_excitation(const Recording& recording, bool base) {
  std::vector<Remark> remarks;
  // Beside a displacement, or where it is the base itself, the reader has told the rest.
  const bool read_as_motion = !recording.displacement.empty();
  if (base && !recording.base.empty()) {
    for (const Remark& remark : of_displacement(recording, recording.base)) {
      // What is said of a fit to a damper's displacement and its slope is nothing to a base.
      static constexpr std::string_view of_dampers[] = {"velocity noise", "displacement outliers", "glitch"};
      if (std::ranges::find(of_dampers, remark.key) != std::end(of_dampers)) continue;
      if (read_as_motion && remark.key == "gap") continue;
      remarks.push_back(remark);
      if (remark.key != "gap") remarks.back().text = Message("base: ") + remark.text;
    }
    const bool placeholder = std::ranges::find(remarks, "displacement placeholder", &Remark::key) != remarks.end();
    const auto spikes = spikes_of(recording, recording.base, "a displacement of the base", "m");
    if (spikes && !placeholder) remarks.push_back(*spikes);
  } else if (!base && !read_as_motion) {
    // One that rests, for the gaps of its times.
    remarks = of_displacement(recording, std::vector<double>(recording.size(), 0.0));
    for (Remark& remark : of_force(recording)) remarks.push_back(std::move(remark));
  }
  return remarks;
}

std::vector<std::string> told_once(const std::vector<Remark>& remarks) {
  std::vector<std::string> result;
  for (const Remark& remark : once_each(remarks)) result.push_back(remark.file + ": " + remark.text.plain());
  return result;
}

std::vector<Remark> slowness_of(const Recording& recording, const Recording& response, bool base) {
  // As of a recording of a damper (io/plausible.hpp).
  constexpr double slow_m_s = 1e-3;
  constexpr double far_m = 1e-3;
  const std::vector<double> velocity = base ? derive_velocity(recording.time, recording.base) : response.velocity;
  const double stroke = span_of(base ? recording.base : response.displacement);
  const double speed = peak_of(velocity);
  if (!(stroke > far_m) || !(speed < slow_m_s)) return {};
  return {{recording.file, Remark::Kind::implausible, "time",
           fmt::format("{} moves by {:.3g} mm at {:.3g} mm/s at most: check the unit of the time, as in time [ms]",
                       base ? "the base" : "the mass", 1e3 * stroke, 1e3 * speed)}};
}

}  // namespace hysteron

#include "io/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/drive.hpp"
#include "core/extent.hpp"
#include "core/lower_case.hpp"
#include "core/robust.hpp"
#include "io/channel_faults.hpp"
#include "io/frozen_moments.hpp"
#include "io/held_ends.hpp"
#include "io/lost_samples.hpp"
#include "io/mains_hum.hpp"
#include "io/motion_faults.hpp"
#include "io/outliers.hpp"
#include "io/rectified.hpp"
#include "io/saturation.hpp"
#include "io/straight_pieces.hpp"
#include "io/text.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// What is believed of a quantity: `stated` where the file gives its unit, `assumed` where SI was taken for want of one.
// From the dampers of watches and instruments to those of bridges, and beyond.
struct Range {
  double low;
  double high;
  [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};
struct Believed {
  Range stated;
  Range assumed;
};
constexpr Believed stroke_m{{1e-6, 5.0}, {1e-5, 1.0}};
constexpr Believed speed_m_s{{0.0, 50.0}, {0.0, 10.0}};
constexpr Believed force_n{{1e-2, 5e7}, {1.0, 1e7}};
constexpr Believed power_w{{1e-7, 1e8}, {1e-4, 1e7}};
constexpr Believed current_a{{0.0, 1000.0}, {0.0, 50.0}};
constexpr Believed voltage_v{{0.0, 10000.0}, {0.0, 1000.0}};
constexpr Believed temperature_c{{-100.0, 400.0}, {-60.0, 200.0}};
// A movement through more than a millimetre that is slower than a millimetre a second, where seconds were assumed.
constexpr double slow_m_s = 1e-3;
constexpr double far_m = 1e-3;
// Velocity over the slope of the displacement: a channel is rarely calibrated worse, and coarse samples do not tell
// more.
constexpr Range slope{1.0 / 1.15, 1.15};

class Remarks {
 public:
  Remarks(const Sources& sources, const std::vector<Column>& columns, const ReadOptions& options,
          const std::string& file)
      : sources_(sources), columns_(columns), options_(options), file_(file) {}

  // `what` is such as "a stroke of 20 m".
  // `also` is what is to be checked beside the unit of the column.
  void judge(Quantity quantity, const Believed& believed, double value, const std::string& what,
             const std::string& also = {}) {
    const Source& source = sources_[static_cast<std::size_t>(quantity)];
    if (source.column < 0) return;
    const Range range = source.assumed ? believed.assumed : believed.stated;
    // A channel that is zero throughout is not one of a wrong unit.
    if (value == 0.0 || range.holds(value)) return;
    const std::string name(quantity_name(quantity));
    if (source.assumed) {
      const auto units = accepted_units(quantity);
      tell(name, fmt::format("{} has no unit and was taken in {}: {} is not of a damper's size; give the unit, as in ",
                             name, units.substr(0, units.find(',')), what) +
                     Option::column + fmt::format(" {}=\"{} [UNIT]\"", name, column(source)));
    } else {
      tell(name, fmt::format("{} is not of a damper's size: check the unit of column '{}'{}", what, column(source),
                             also.empty() ? "" : " " + also));
    }
  }

  void tell(const std::string& key, const Message& text) {
    told_ = true;
    options_.remark({file_, Remark::Kind::implausible, key, text});
  }

  [[nodiscard]] bool told() const { return told_; }
  [[nodiscard]] bool assumed(Quantity quantity) const { return sources_[static_cast<std::size_t>(quantity)].assumed; }

 private:
  [[nodiscard]] std::string column(const Source& source) const {
    return columns_[static_cast<std::size_t>(source.column)].text;
  }

  const Sources& sources_;
  const std::vector<Column>& columns_;
  const ReadOptions& options_;
  const std::string& file_;
  bool told_ = false;
};

// Velocity over the slope of the displacement, by the way over two samples of each (Simpson's rule): noise of the
// velocity makes the one regression too large, noise of the displacement and a lag the other too small. The truth lies
// between.
Range velocity_over_slope(const Recording& r) {
  double from_velocity = 0.0;
  double from_displacement = 0.0;
  double product = 0.0;
  for (std::size_t n = 1; n + 1 < r.size(); ++n) {
    const double way =
        (r.velocity[n - 1] + 4.0 * r.velocity[n] + r.velocity[n + 1]) / 6.0 * (r.time[n + 1] - r.time[n - 1]);
    const double change = r.displacement[n + 1] - r.displacement[n - 1];
    from_velocity += way * way;
    from_displacement += change * change;
    product += way * change;
  }
  if (product == 0.0) return {1.0, 1.0};
  return {product / from_displacement, from_velocity / product};
}

// The longest time between two samples where it is far longer than the others.
struct Gap {
  double at = 0.0;
  double length = 0.0;
  double usual = 0.0;
};
std::optional<Gap> gap_in(const std::vector<double>& time) {
  constexpr double far_longer = 20.0;
  constexpr std::size_t most_steps = 65536;  // that tell what is usual
  const std::size_t stride = time.size() / most_steps + 1;
  std::vector<double> steps;
  Gap gap;
  for (std::size_t n = 0; n + 1 < time.size(); ++n) {
    const double step = time[n + 1] - time[n];
    if (n % stride == 0) steps.push_back(step);
    if (step > gap.length) gap = {time[n], step, 0.0};
  }
  gap.usual = median_of(std::move(steps));
  return gap.length > far_longer * gap.usual ? std::optional(gap) : std::nullopt;
}

// Whether the force falls as the velocity grows, what follows the displacement aside: the damping c of the least
// squares F = c v + k x + f0 is negative and tells more than a quarter of what k and f0 leave.
bool drives_its_rig(const Recording& r) {
  const auto count = static_cast<double>(r.size());
  const auto mean = [&](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / count;
  };
  const double x0 = mean(r.displacement);
  const double v0 = mean(r.velocity);
  const double f0 = mean(r.force);
  double xx = 0.0, xv = 0.0, vv = 0.0, xf = 0.0, vf = 0.0, ff = 0.0;
  for (std::size_t n = 0; n < r.size(); ++n) {
    const double x = r.displacement[n] - x0;
    const double v = r.velocity[n] - v0;
    const double f = r.force[n] - f0;
    xx += x * x;
    xv += x * v;
    vv += v * v;
    xf += x * f;
    vf += v * f;
    ff += f * f;
  }
  if (!(xx > 0.0)) return false;
  // Without what follows the displacement.
  const double v_left = vv - xv * xv / xx;
  const double f_left = ff - xf * xf / xx;
  const double both = vf - xv * xf / xx;
  constexpr double share = 0.25;
  constexpr double rounding = 1e-4;
  return both < 0.0 && v_left > rounding * vv && f_left > rounding * ff && both * both > share * v_left * f_left;
}

constexpr std::string_view frequency_not_taken =
    "is not taken: laws in the frequency follow that of the motion, which the displacement tells";

// Of a channel that is set to a level, in the unit of its column.
void tell_of_setting(const std::string& column, const UnitConversion& unit, const std::vector<double>& time,
                     const std::vector<double>& values, Remarks& remarks) {
  std::vector<double> written(values.size());
  std::ranges::transform(values, written.begin(), [&](double value) { return unit.from_si(value); });
  if (const auto placeholder = placeholder_of_setting(written)) {
    remarks.tell(
        "placeholder of " + column,
        fmt::format("column '{}' is exactly {:.6g} in {} sample{}, first at {:.4g} s, and all others are {}: a "
                    "number that stands for missing samples looks so; cut them",
                    column, placeholder->value, placeholder->count, placeholder->count == 1 ? "" : "s",
                    time[placeholder->first],
                    placeholder->low == placeholder->high
                        ? fmt::format("{:.3g}", placeholder->low)
                        : fmt::format("from {:.3g} to {:.3g}", placeholder->low, placeholder->high)));
    return;
  }
  const std::vector<Outlier> out = outliers_of_setting(written);
  const auto furthest =
      std::ranges::max_element(out, {}, [&](const Outlier& one) { return std::fabs(written[one.at] - one.told); });
  if (furthest == out.end()) return;
  remarks.tell("outliers of " + column,
               fmt::format("column '{}' is {:.3g} at {:.4g} s where its neighbours tell {:.3g}, {} sample{} like that: "
                           "what follows it is taken to do so too",
                           column, written[furthest->at], time[furthest->at], furthest->told, out.size(),
                           out.size() == 1 ? "" : "s"));
}

// A first or last sample that is off the path of the others.
void tell_of_ends(const Recording& recording, Remarks& remarks) {
  const auto tell = [&](const std::string& name, const StrayEnd& end, double value, double told,
                        const std::string& unit) {
    const std::string_view which = end.first ? "first" : "last";
    const std::string number = std::to_string(end.count);
    remarks.tell("stray end of " + name,
                 fmt::format("the {} is {:.4g} {} in {}, at {:.4g} s, and the samples {} it tell {:.4g} {}, far beyond "
                             "their steps: a sensor that was not ready, or a row that is no sample, looks so; cut {}",
                             name, value, unit,
                             end.count == 1 ? fmt::format("the {} sample", which)
                                            : fmt::format("sample {}{}", number, end.first ? "" : " from the end"),
                             recording.time[end.at], end.first ? "behind" : "before", told, unit,
                             end.count == 1 ? "it" : fmt::format("the {} {} samples", which, number)));
  };
  // What the path tells has no more digits than a thousandth of what is off it.
  const auto rounded = [](double told, double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(std::fabs(value - told))) - 3.0);
    return digit * std::round(told / digit);
  };
  if (const auto end = stray_end_of(recording.time, recording.displacement)) {
    const double value = recording.displacement[end->at];
    tell("displacement", *end, 1e3 * value, 1e3 * rounded(end->told, value), "mm");
    return;
  }
  // A force begins with a jump where the rod does: to a friction, from the neutral state. Beyond all others is another
  // thing.
  constexpr double beyond = 0.1;
  const auto end = stray_end_of(recording.time, recording.force);
  if (!end) return;
  double low = end->told;
  double high = end->told;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    if (end->first ? n <= end->at : n >= end->at) continue;
    low = std::min(low, recording.force[n]);
    high = std::max(high, recording.force[n]);
  }
  const double value = recording.force[end->at];
  if (std::max(low - value, value - high) > beyond * (high - low))
    tell("force", *end, value, rounded(end->told, value), "N");
}

// A channel that was interpolated by straight lines, to more samples than its own.
void tell_of_straight_pieces(const Recording& recording, Remarks& remarks) {
  const double rate = static_cast<double>(recording.size() - 1) / (recording.time.back() - recording.time.front());
  for (const auto& [name, values, lost] :
       {std::tuple("displacement", &recording.displacement, "its slope goes in steps"),
        std::tuple("force", &recording.force, "what it did in between is lost")}) {
    const auto pieces = straight_pieces_of(*values);
    if (!pieces) continue;
    remarks.tell(std::string("straight pieces of ") + name,
                 fmt::format("the {} goes in straight lines of {} samples each: a channel of {:.4g} Hz that was "
                             "interpolated to {:.4g} Hz looks so, and {}; record it at {:.4g} Hz, or keep one sample "
                             "in {} of all channels",
                             name, *pieces, rate / static_cast<double>(*pieces), rate, lost, rate, *pieces));
  }
}

// Leaps unless they are behind a frozen moment, a counter that overflowed, glitches unless those beyond the range are
// told, channels slower than the log, and a velocity that is none.
void tell_of_motion(const Recording& recording, const Sources& sources, const std::optional<Wrap>& wrap,
                    const std::optional<FrozenMoments>& frozen, bool glitches_told, Remarks& remarks) {
  const std::vector<double>& time = recording.time;
  if (wrap) {
    remarks.tell(
        "wrap",
        fmt::format("the displacement jumps from {:.4g} to {:.4g} mm behind sample {}, at {:.4g} s, nearly its whole "
                    "range, and goes on at {:.3g} mm/s where it came at {:.3g} mm/s: a counter that overflows looks "
                    "so, {} time{} here; add its range, about {:.4g} mm, at each",
                    1e3 * recording.displacement[wrap->after], 1e3 * recording.displacement[wrap->after + 1],
                    wrap->after + 1, time[wrap->after], 1e3 * wrap->behind, 1e3 * wrap->before, wrap->count,
                    wrap->count == 1 ? "" : "s", 1e3 * wrap->range));
    glitches_told = true;
  } else if (const auto leap = leap_of(time, recording.displacement);
             leap && !(frozen && leap->after == frozen->last)) {
    remarks.tell("leap", fmt::format("the displacement leaps by {:.3g} mm between {:.4g} and {:.4g} s, far beyond its "
                                     "steps before and after: lost samples or two records joined look so; cut there",
                                     1e3 * leap->size, time[leap->after], time[leap->after + 1]));
  }
  for (const auto& [name, values] :
       {std::pair("displacement", &recording.displacement), std::pair("force", &recording.force)}) {
    if (const auto dropouts = dropouts_of(*values)) {
      remarks.tell(std::string("dropouts of ") + name,
                   fmt::format("the {} jumps to exactly 0 and back {} times, first at {:.4g} s, far beyond its other "
                               "steps: a sensor or a transmission that fails for moments looks so; cut these samples",
                               name, dropouts->count, time[dropouts->first]));
      glitches_told = glitches_told || values == &recording.displacement;
    }
  }
  const auto glitch = glitches_told ? std::nullopt : excursion_of(time, recording.displacement);
  if (glitch) {
    remarks.tell("glitch",
                 fmt::format("the displacement goes from {:.4g} to {:.4g} mm at {:.4g} s and back at once, far beyond "
                             "its steps before and after, {} time{} like that: a sensor or a transmission that fails "
                             "looks so; cut these samples",
                             1e3 * glitch->from, 1e3 * recording.displacement[glitch->at], time[glitch->at],
                             glitch->count, glitch->count == 1 ? "" : "s"));
  }
  if (!glitches_told && !glitch) tell_of_ends(recording, remarks);
  const double step = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  for (const auto& [name, values] :
       {std::pair("displacement", &recording.displacement), std::pair("force", &recording.force),
        std::pair("velocity", &recording.velocity)}) {
    const bool recorded = values != &recording.velocity || recording.velocity_measured;
    const auto held = recorded ? held_samples_of(*values) : std::nullopt;
    if (held) {
      remarks.tell(std::string("held ") + name,
                   fmt::format("the {} holds each value for {:.3g} samples: a sensor slower than the log looks so, and "
                               "is {:.3g} ms late on average; record all channels at its rate, or interpolate it by a "
                               "curve",
                               name, *held, 0.5e3 * (*held - 1.0) * step));
    }
  }
  tell_of_straight_pieces(recording, remarks);
  const auto& velocity = sources[static_cast<std::size_t>(Quantity::velocity)];
  if (velocity.column >= 0 && !recording.velocity_measured) {
    const auto set = std::ranges::find(recording.unused, set_velocity, &UnusedColumn::name);
    remarks.tell(
        "no velocity",
        set == recording.unused.end()
            ? "the velocity is 0 throughout while the displacement moves: it is taken from the displacement instead"
            : fmt::format("the velocity is {:.4g} m/s throughout while the displacement goes to and fro: a speed that "
                          "was set looks so; it is taken from the displacement instead",
                          set->mean));
  }
}

// Of one that has the sign and the gain of the slope.
void tell_of_velocity(const Recording& recording, Remarks& remarks) {
  // From here on a lag or an offset is seen in the parameters: six degrees, a hundredth of the speed, by which a
  // damping beside a friction is several times as far off. A gain that is not told (`slope`) shows in the mean as well,
  // where the rod does not come back.
  constexpr double least_phase = 0.1;  // rad
  constexpr double least_offset_share = 0.01;
  constexpr double errors = 5.0;
  const VelocityFault fault = velocity_fault_of(recording);
  const double mean_speed = std::fabs(recording.displacement.back() - recording.displacement.front()) /
                            (recording.time.back() - recording.time.front());
  const double not_told = errors * fault.offset_error + (slope.high - 1.0) * mean_speed;
  if (fault.offset_share > least_offset_share && std::fabs(fault.offset) > not_told) {
    remarks.tell(
        "velocity offset",
        fmt::format("the velocity is {:.3g} m/s off what displacement and time tell on average, {:.0f} % of its "
                    "largest: check the zero of the channel",
                    fault.offset, 100.0 * fault.offset_share));
  }
  if (fault.phase > least_phase) {
    remarks.tell(
        "velocity lag",
        fmt::format("the velocity is {} the slope of the displacement by {:.2g} ms: a phase of {:.2g} degrees, of "
                    "which the model makes a stiffness that is not there; correct it, or remove the column: the "
                    "slope is then taken",
                    fault.lag > 0.0 ? "behind" : "ahead of", 1e3 * std::fabs(fault.lag),
                    fault.phase * 180.0 / std::numbers::pi));
  }
}

// Noise that attenuates what is proportional to the velocity, from 1 % on.
void tell_of_noise(const Recording& recording, Remarks& remarks) {
  constexpr double least_share = 0.01;
  const double share = noise_share_of_velocity(recording);
  if (share < least_share) return;
  remarks.tell(
      "velocity noise",
      fmt::format("{:.0f} % of the {} is noise (RMS): a damping comes out about {:.2g} % too small, and what "
                  "follows a reversal is blurred; {}",
                  100.0 * std::sqrt(share),
                  recording.velocity_measured ? "velocity" : "velocity, derived from the displacement,", 100.0 * share,
                  recording.velocity_measured
                      ? "if the displacement has less noise, remove the column: its slope is then taken"
                      : "a larger stroke, or a sensor with less noise, mends it"));
}

// Of what the mass stands on, where the file gives no unit. What no unit would excuse is told where it excites
// (task/excitation_faults.hpp), where it is not known any more that this one was assumed. The limits of a damper's
// stroke and speed hold of it too: shake tables move by a metre or two, and the ground by less in all but the strongest
// earthquakes, at a tenth of 10 m/s.
void tell_of_base(const Recording& recording, Remarks& remarks) {
  if (recording.base.empty() || !remarks.assumed(Quantity::base)) return;
  const double stroke = span_of(recording.base);
  const double speed = peak_of(derive_velocity(recording.time, recording.base));
  if (!stroke_m.stated.holds(stroke) || !speed_m_s.stated.holds(speed)) return;
  if (stroke_m.assumed.holds(stroke)) {
    remarks.judge(Quantity::base, speed_m_s, speed, fmt::format("a speed of {:.3g} m/s, from base and time,", speed));
  } else {
    remarks.judge(Quantity::base, stroke_m, stroke, fmt::format("a stroke of {:.3g} m", stroke));
  }
}

// A tone of the mains is no noise to what tells that.
void tell_of_hum(const Recording& recording, Remarks& remarks) {
  const auto hum = mains_hum_of(recording);
  if (!hum) return;
  remarks.tell("mains hum",
               fmt::format("a tone of {:.3g} Hz and {:.2g} mm runs through the displacement and makes {:.0f} % of the "
                           "velocity that is derived from it (RMS), and the force does not follow it: mains hum looks "
                           "so, and a damping comes out about {:.2g} % too small; shield the sensor, or filter its "
                           "channel and the force alike",
                           hum->frequency, 1e3 * hum->amplitude, 100.0 * hum->share, 100.0 * hum->share * hum->share));
}

// Channels without their sign.
void tell_of_rectified(const Recording& recording, Remarks& remarks) {
  const auto tell = [&](const std::string& name, const std::string& meanwhile) {
    remarks.tell("rectified " + name,
                 fmt::format("the {} is never below 0 and turns up by a kink wherever it comes down to it, {}: one "
                             "without its sign looks so; give it its sign back",
                             name, meanwhile));
  };
  if (force_is_rectified(recording)) tell("force", "while the rod goes to and fro");
  if (displacement_is_rectified(recording)) tell("displacement", "and the force goes on through that");
}

void tell_of_held_end(const Recording& recording, Remarks& remarks) {
  const auto held = held_end_of(recording);
  if (!held || silence_of(recording.force)) return;  // zeros are told already
  remarks.tell("held end",
               fmt::format("displacement and force have exactly one value each in the {} {} samples, {} {:.4g} s, and "
                           "noise elsewhere: a file that was filled up with {} looks so; cut them",
                           held->first ? "first" : "last", held->count, held->first ? "until" : "from",
                           recording.time[held->first ? held->count - 1 : recording.size() - held->count],
                           held->first ? "its first values" : "its last values"));
}

// A channel that stays while the other one goes on.
void tell_of_motion_and_force(const Recording& recording, const std::optional<FrozenMoments>& moments,
                              Remarks& remarks) {
  const auto tell_frozen = [&](const std::string& name, double value, const std::string& unit, const Stretch& stretch,
                               const std::string& other) {
    if (stretch.count == recording.size()) {
      remarks.tell("frozen " + name, fmt::format("the {} is {:.4g} {} throughout and the {} changes: a channel that "
                                                 "was not connected looks so",
                                                 name, value, unit, other));
      return;
    }
    remarks.tell(
        "frozen " + name,
        fmt::format("the {} stays at exactly {:.4g} {} from {:.4g} to {:.4g} s while the {} goes on: a channel "
                    "that froze looks so; cut these samples",
                    name, value, unit, recording.time[stretch.first], recording.time[stretch.first + stretch.count - 1],
                    other));
  };
  // No force at all is that of a play, or silence.
  if (const auto frozen = frozen_stretch_of(recording.force, recording.displacement);
      frozen && recording.force[frozen->first] != 0.0) {
    tell_frozen("force", recording.force[frozen->first], "N", *frozen, "motion");
  }
  if (moments) remarks.tell("frozen moments", sentence_of(*moments, recording));
  if (const auto frozen = frozen_stretch_of(recording.displacement, recording.force);
      frozen && !(moments && moments->first == frozen->first)) {
    // A drive that is switched changes the force of a damper at rest.
    std::vector<double> drive;
    if (!recording.drive.empty()) {
      const auto first = recording.drive.begin() + static_cast<std::ptrdiff_t>(frozen->first);
      drive.assign(first, first + static_cast<std::ptrdiff_t>(frozen->count));
    }
    if (!varies(drive)) {
      tell_frozen("displacement", 1e3 * recording.displacement[frozen->first], "mm", *frozen, "force");
    }
  }
  if (const auto end = flat_end_of(recording.displacement);
      end && force_turns_at(end->value, recording.displacement, recording.force)) {
    remarks.tell("flat displacement",
                 fmt::format("the displacement stays at exactly {:.4g} mm, an end of its range, for {:.0f} % of the "
                             "samples while the force turns round: a channel that saturates looks so, and the motion "
                             "beyond is not known",
                             1e3 * end->value, 100.0 * end->share));
  }
}

}  // namespace

void remark_on_sizes(const Recording& recording, const Sources& sources, const std::vector<Column>& columns,
                     const ReadOptions& options, const std::string& file) {
  if (!options.remark) return;
  Remarks remarks(sources, columns, options, file);
  const bool moves = !recording.displacement.empty();  // an excitation may be a force alone
  const double stroke =
      moves ? std::ranges::max(recording.displacement) - std::ranges::min(recording.displacement) : 0.0;
  const double speed = peak_of(recording.velocity);
  const double force = peak_of(recording.force);
  const std::optional<Wrap> wrap = moves ? wrap_of(recording.time, recording.displacement) : std::nullopt;
  remarks.judge(Quantity::displacement, stroke_m, stroke, fmt::format("a stroke of {:.3g} m", stroke));
  if (!recording.force.empty()) {
    remarks.judge(Quantity::force, force_n, force, fmt::format("a force of {:.3g} N", force));
  }
  const auto& drive = recording.drive;
  const bool voltage = recording.drive_kind == DriveKind::voltage;
  remarks.judge(voltage ? Quantity::voltage : Quantity::current, voltage ? voltage_v : current_a, peak_of(drive),
                fmt::format("a {} of {:.3g} {}", voltage ? "voltage" : "current", peak_of(drive), voltage ? "V" : "A"));
  if (!recording.temperature.empty()) {
    const auto [cold, hot] = std::ranges::minmax(recording.temperature);
    const double far = std::fabs(cold) > std::fabs(hot) ? cold : hot;
    remarks.judge(Quantity::temperature, temperature_c, far, fmt::format("a temperature of {:.3g} degC", far));
  }
  if (recording.velocity_measured) {
    remarks.judge(Quantity::velocity, speed_m_s, speed, fmt::format("a speed of {:.3g} m/s", speed));
  } else if (!remarks.told() && !wrap) {
    // Where only one of the two has no unit, that one is in question; of both, the displacement rather.
    const bool assumed = remarks.assumed(Quantity::displacement);
    remarks.judge(assumed ? Quantity::displacement : Quantity::time, speed_m_s, speed,
                  fmt::format("a speed of {:.3g} m/s, from displacement and time,", speed),
                  "and that of the displacement, and that columns are not exchanged");
  }
  if (!remarks.told() && remarks.assumed(Quantity::time) && stroke > far_m && speed < slow_m_s) {
    remarks.tell("time",
                 fmt::format("time has no unit and was taken in s: a speed of {:.3g} m/s at most for a stroke of "
                             "{:.3g} m; give the unit, as in time [ms]",
                             speed, stroke));
  }
  tell_of_base(recording, remarks);
  if (!moves) return;
  double power = 0.0;
  for (std::size_t n = 0; n < recording.force.size(); ++n) {
    power = std::max(power, std::fabs(recording.force[n] * recording.velocity[n]));
  }
  if (!remarks.told() && !wrap && !recording.force.empty()) {
    remarks.judge(Quantity::force, power_w, power, fmt::format("a power of {:.3g} W, force times velocity,", power));
  }
  if (const auto gap = gap_in(recording.time)) {
    remarks.tell("gap", fmt::format("no samples for {:.3g} s from {:.4g} s on, {:.0f} times the usual spacing: the "
                                    "motion in between is taken to be smooth",
                                    gap->length, gap->at, gap->length / gap->usual));
  }
  bool glitches_told = false;
  for (const auto& [name, values, unit] :
       {std::tuple("displacement", &recording.displacement, "m"), std::tuple("force", &recording.force, "N")}) {
    const std::vector<double>& channel = *values;
    const auto placeholder = placeholder_of(channel);
    if (placeholder) {
      remarks.tell(std::string(name) + " placeholder",
                   fmt::format("the {} is exactly {:.6g} {} in {} samples, first at {:.4g} s, and all others are from "
                               "{:.3g} to {:.3g} {}: a number that stands for missing samples looks so; cut them",
                               name, placeholder->value, unit, placeholder->count, recording.time[placeholder->first],
                               placeholder->low, placeholder->high, unit));
    }
    std::vector<Outlier> out = outliers_of(recording.time, channel);
    std::erase_if(out, [&](const Outlier& one) {
      return !one.extreme || (placeholder && channel[one.at] == placeholder->value);
    });
    const auto furthest = std::ranges::max_element(
        out, {}, [&channel](const Outlier& one) { return std::fabs(channel[one.at] - one.told); });
    if (furthest != out.end()) {
      glitches_told = glitches_told || values == &recording.displacement;
      remarks.tell(std::string(name) + " outliers",
                   fmt::format("a {} of {:.3g} {} at {:.4g} s where its neighbours tell {:.3g} {}, {} samples like "
                               "that: outliers weigh on a fit and on its NRMSE",
                               name, (*values)[furthest->at], unit, recording.time[furthest->at], furthest->told, unit,
                               out.size()));
    }
  }
  // A mass may rest while the force on it changes, and swing under one that does not.
  const bool of_damper = options.force_required && !recording.force.empty();
  const std::optional<FrozenMoments> frozen = of_damper ? frozen_moments_of(recording) : std::nullopt;
  tell_of_motion(recording, sources, wrap, frozen, glitches_told, remarks);
  if (const auto end = flat_end_of(recording.force);
      end && !placeholder_of(recording.force) && !(end->in_noise && force_noise_is_of_motion(recording))) {
    remarks.tell("flat end",
                 fmt::format("the force stays at exactly {:.4g} N, an end of its range, for {:.0f} % of the "
                             "samples: a channel that saturates looks so, and a fit to it is too soft",
                             end->value, 100.0 * end->share));
  }
  if (const auto silence = silence_of(recording.force)) {
    const std::size_t last = silence->first + silence->count - 1;
    remarks.tell("silence",
                 fmt::format("the force is exactly 0 from {:.4g} to {:.4g} s, {} samples: a channel that was off "
                             "or a file that was padded looks so; cut them",
                             recording.time[silence->first], recording.time[last], silence->count));
  }
  if (const auto silence = silence_at_an_end_of(recording.force, recording.displacement)) {
    const bool first = silence->first == 0;
    remarks.tell(
        "silence",
        fmt::format("the force is exactly 0 in the {} {} samples, {} {:.4g} s, while the rod moves, and {} {:.4g} N at "
                    "once: a channel that was switched {} looks so; cut them",
                    first ? "first" : "last", silence->count, first ? "until" : "from",
                    recording.time[first ? silence->count - 1 : silence->first], first ? "then" : "before that",
                    recording.force[first ? silence->count : silence->first - 1], first ? "on late" : "off early"));
  }
  if (of_damper) {
    tell_of_motion_and_force(recording, frozen, remarks);
    if (const auto lost = lost_samples_of(recording)) remarks.tell("lost samples", sentence_of(*lost, recording));
    tell_of_held_end(recording, remarks);
    tell_of_rectified(recording, remarks);
    tell_of_hum(recording, remarks);
  }
  const Range ratio = recording.velocity_measured ? velocity_over_slope(recording) : Range{1.0, 1.0};
  // Where the velocity has the wrong sign the force may well follow the displacement.
  if (ratio.low > 0.0 && options.force_required && !recording.force.empty() && drives_its_rig(recording)) {
    remarks.tell(
        "sign",
        "the force falls as the velocity grows, as if the damper drove the rig: force or displacement has the "
        "other sign than the models, whose force resists a positive velocity with a positive value, or the two "
        "are exchanged");
  }
  if (recording.velocity_measured) {
    if (ratio.low < 0.0) {
      remarks.tell("slope", "the velocity runs against the displacement: check their signs");
    } else if (ratio.high < slope.low || ratio.low > slope.high) {
      remarks.tell(
          "slope",
          fmt::format("the velocity is {:.3g} times the slope of the displacement over time: check the units and "
                      "the calibration of the three",
                      std::sqrt(ratio.low * ratio.high)));
    } else {
      tell_of_velocity(recording, remarks);
      tell_of_noise(recording, remarks);
    }
  } else if (!recording.velocity.empty()) {
    tell_of_noise(recording, remarks);
  }
}

void remark_on_settings(const Sources& sources, const Channels& channels,
                        const std::vector<ConditionSource>& conditions, const std::vector<std::vector<double>>& values,
                        const std::vector<Column>& columns, const ReadOptions& options, const std::string& file) {
  if (!options.remark) return;
  Remarks remarks(sources, columns, options, file);
  const std::vector<double>& time = channels[static_cast<std::size_t>(Quantity::time)];
  for (const Quantity quantity : {Quantity::current, Quantity::voltage, Quantity::temperature}) {
    const auto q = static_cast<std::size_t>(quantity);
    if (sources[q].column < 0) continue;
    tell_of_setting(columns[static_cast<std::size_t>(sources[q].column)].text, sources[q].unit, time, channels[q],
                    remarks);
  }
  if (options.follows_frequency) {
    for (const Column& column : columns) {
      if (lower_case(column.name) != "frequency") continue;
      options.remark({file, Remark::Kind::dialect, "frequency column",
                      fmt::format("column '{}' {}", column.text, frequency_not_taken)});
    }
  }
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (conditions[c].column < 0) continue;
    tell_of_setting(columns[static_cast<std::size_t>(conditions[c].column)].text, conditions[c].unit.conversion, time,
                    values[c], remarks);
  }
}

void remark_on_numbers(const ReadOptions& options, const std::string& file) {
  if (!options.remark) return;
  if (options.follows_frequency && options.numbers.contains("frequency")) {
    const double value = options.numbers.at("frequency").value;
    options.remark({file, Remark::Kind::dialect, "frequency number",
                    fmt::format("the number frequency = {:.6g} {}", value, frequency_not_taken)});
  }
  struct Kind {
    std::string_view name;
    Range range;
    std::string_view unit;
    std::string_view as_in;
  };
  constexpr Range pressure_pa{1e3, 1e9};
  const std::array<Kind, 4> kinds = {{{"current", current_a.assumed, "A", "500 mA"},
                                      {"voltage", voltage_v.assumed, "V", "500 mV"},
                                      {"temperature", temperature_c.assumed, "degC", "293 K"},
                                      {"pressure", pressure_pa, "Pa", "2.1 bar"}}};
  for (const Kind& kind : kinds) {
    const auto given = options.numbers.find(std::string(kind.name));
    if (given == options.numbers.end() || !given->second.unit.empty() || given->second.value == 0.0) continue;
    const double value = kind.name == "temperature" ? given->second.value : std::fabs(given->second.value);
    if (kind.range.holds(value)) continue;
    options.remark(
        {file, Remark::Kind::implausible, std::string(kind.name) + " number",
         fmt::format("the number {} = {:.6g} has no unit and was taken in {}: that is not of a damper's size; "
                     "give the unit, as in {} = \"{}\"",
                     kind.name, given->second.value, kind.unit, kind.name, kind.as_in)});
  }
}

}  // namespace hysteron

#include "task/respond.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "respond/one_period.hpp"
#include "respond/settling.hpp"
#include "task/excitation_faults.hpp"
#include "task/guesses.hpp"
#include "task/remarks.hpp"

namespace hysteron {
namespace {

// A file that names a base has the displacement of the mass beside it, as what `respond` writes.
const std::vector<double>& ground_of(const Recording& recording) {
  return recording.base.empty() ? recording.displacement : recording.base;
}

std::string word_of(Excites excitation) { return excitation == Excites::base ? "base" : "force"; }

bool moves_base(const Recording& recording, Excites excitation) {
  const bool has_force = !recording.force.empty();
  const bool has_base = !ground_of(recording).empty();
  if (excitation == Excites::what_is_recorded && has_force == has_base) {
    if (has_force) {
      throw OptionError(recording.file + ": holds a force and a displacement of the base, expected " +
                        Option::excitation + " force or base");
    }
    throw OptionError(recording.file + ": no force and no base or displacement column" +
                      (recording.acceleration.empty() ? "" : " (an acceleration is not enough)") +
                      ", expected one of them, or " + Option::column + " force=NAME or base=NAME");
  }
  const bool base = excitation == Excites::what_is_recorded ? has_base : excitation == Excites::base;
  if (base ? !has_base : !has_force) {
    throw OptionError(recording.file + ": no " + (base ? "base or displacement" : "force") +
                      " column, expected one for " + Option::excitation + " " + word_of(excitation));
  }
  return base;
}

// Without a last sample that is the first of the next period.
void close_period(Recording& recording, bool base, std::vector<std::string>& remarks) {
  if (!last_repeats_first(base ? ground_of(recording) : recording.force)) return;
  for (std::vector<double>* channel : channels_of(recording)) {
    if (!channel->empty()) channel->pop_back();
  }
  remarks.push_back(recording.file +
                    ": the last sample repeats the first and is left out; it is taken as the start of the next period");
}

Excitation excitation_of(const Recording& recording, bool base, const ResponseRequest& request) {
  const bool periodic = request.periods > 0;
  Excitation excitation;
  excitation.time = periodic ? repeated_times(recording.time, request.periods) : recording.time;
  (base ? excitation.base : excitation.force) =
      Signal(recording.time, base ? ground_of(recording) : recording.force, request.interpolation, periodic);
  if (!std::isnan(request.drive)) {
    excitation.drive =
        Signal(recording.time, std::vector<double>(recording.size(), request.drive), Interpolation::linear, periodic);
  } else if (!recording.drive.empty()) {
    excitation.drive = Signal(recording.time, quiet_drive(recording.drive), Interpolation::linear, periodic);
  }
  excitation.conditions = condition_signals(recording, periodic);
  return excitation;
}

std::string percent(double share) {
  return share < 0.1 ? fmt::format("{:.2g} %", 100.0 * share) : fmt::format("{:.0f} %", 100.0 * share);
}

// In two digits, rounded up.
std::string about(double count) {
  const double digit = std::pow(10.0, std::floor(std::log10(count)) - 1.0);
  return fmt::format("{:.0f}", std::ceil(count / digit) * digit);
}

// What is to be known where a steady motion was asked for.
std::optional<std::string> unsteady(const MassMotion& motion, int periods, std::size_t samples) {
  // Of the largest displacement and velocity: a sensor is not calibrated better.
  constexpr double steady = 0.01;
  const Settling settling = settling_of(motion, periods, samples);
  const std::string change = fmt::format(
      "the motion is not steady in {}: its start and end differ by {} of the largest",
      periods == 1 ? "one period" : fmt::format("the last of {} periods", periods), percent(settling.change));
  if (!settling.left) {
    if (settling.change <= steady) return std::nullopt;
    return change + (periods == 1 ? "; expected more periods" : ", no less than in the period before");
  }
  if (std::max(*settling.left, settling.change) <= steady) return std::nullopt;
  const double more = std::max(std::log(steady / *settling.left) / std::log(*settling.factor), 1.0);
  return change +
         fmt::format(", and at the pace of the last two it is {} off the steady one; expected about {} periods",
                     percent(*settling.left), about(static_cast<double>(periods) + more));
}

// A drive or a frequency is given that no parameter follows.
std::vector<std::string> given_for_nothing(const StoredModel& stored, const std::string& path,
                                           const ResponseRequest& request) {
  std::vector<std::string> remarks;
  const auto tell = [&](const std::string& what) {
    remarks.push_back(path + ": a " + what +
                      " is given, and no parameter of the model follows one: it changes nothing");
  };
  if (!std::isnan(request.drive) && stored.drive == DriveKind::none) tell("drive");
  if (!std::isnan(request.frequency) && !stored.follows_frequency()) tell("frequency");
  return remarks;
}

// Of the last period, or of everything where none is repeated.
MassResponse table_of(const Recording& recording, const Excitation& excitation, const MassMotion& motion) {
  MassResponse result;
  result.base = excitation.base.has_value();
  const std::size_t first = excitation.time.size() - recording.size();
  const auto add = [&](std::string name, std::vector<double> column) {
    result.names.push_back(std::move(name));
    result.columns.push_back(std::move(column));
  };
  const auto last = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first), values.end());
  };
  const auto signal = [&](const Signal& of) {
    std::vector<double> values;
    for (std::size_t n = first; n < excitation.time.size(); ++n) values.push_back(of.value(excitation.time[n]));
    return values;
  };
  add("time [s]", recording.time);
  add("displacement [m]", last(motion.displacement));
  add("velocity [m/s]", last(motion.velocity));
  add("acceleration [m/s^2]", last(motion.acceleration));
  // By the names that an identification from the motion reads: its force is what excites the mass.
  if (excitation.force) add("force [N]", signal(*excitation.force));
  const std::vector<double> force = last(motion.force);
  add(std::string(damper_force) + " [N]", force);
  if (excitation.drive) {
    add(recording.drive_kind == DriveKind::voltage ? "voltage [V]" : "current [A]", signal(*excitation.drive));
  }
  if (result.base) {
    add("base [m]", signal(*excitation.base));
    std::vector<double> absolute = result.columns.back();
    for (std::size_t n = 0; n < absolute.size(); ++n) absolute[n] += result.columns[1][n];
    add("absolute displacement [m]", std::move(absolute));
  }
  const auto largest = [](const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::fabs(value));
    return most;
  };
  result.largest_displacement = largest(result.columns[1]);
  result.largest_force = largest(force);
  return result;
}

}  // namespace

std::string MassResponse::csv() const {
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  for (std::size_t n = 0; n < columns.front().size(); ++n) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      text += fmt::format("{}{}", k == 0 ? "" : ",", columns[k][n]);
    }
    text += '\n';
  }
  return text;
}

MassResponse response_to(StoredModel stored, const std::string& path, Recording recording,
                         const ResponseRequest& request, std::vector<std::string>& remarks) {
  follow_conditions(stored, {recording});
  if (std::isnan(request.drive)) check_drive(stored, path, recording);
  const bool base = moves_base(recording, request.excitation);
  if (base && request.interpolation == Interpolation::linear) {
    throw OptionError(Option::interpolation +
                      " linear: straight lines of a base have no acceleration, expected cubic or band-limited");
  }
  append(remarks, told_once(faults_of_excitation(recording, base)));
  if (request.periods > 0) close_period(recording, base, remarks);
  Recording as_motion = recording;
  as_motion.displacement = base ? ground_of(recording) : recording.force;
  append(remarks, given_for_nothing(stored, path, request));
  if (!std::isnan(request.drive)) {
    as_motion.drive.assign(recording.size(), request.drive);
    as_motion.drive_kind = stored.drive;
  }
  double frequency = request.frequency;
  if (std::isnan(frequency)) {
    frequency = dominant_frequency(as_motion);
  } else {
    stored.frequency_range.reset();  // the user's own choice
  }
  append(remarks, guesses_of(stored, path, {as_motion}));
  Oscillator oscillator;
  oscillator.mass = request.mass;
  oscillator.stiffness = request.stiffness;
  oscillator.damping = request.damping;
  oscillator.model = stored.model;
  oscillator.parameters = [&](double drive, std::span<const double> conditions) {
    return parameters_at(stored.held, stored.terms, drive, frequency, conditions);
  };
  const bool follows = std::ranges::any_of(stored.terms, [](const Term& term) { return term.drive_power > 0; });
  require_response(stored.model, parameters_at(stored.held, stored.terms, 0.0, frequency, middle_of(stored.conditions)),
                   follows && drive_varies(as_motion));
  Excitation excitation = excitation_of(recording, base, request);
  if (request.periods > 0) excitation.time.push_back(end_of_periods(recording.time, request.periods));
  MassMotion motion = respond(oscillator, excitation, request.respond);
  if (request.periods > 0) {
    if (const auto told = unsteady(motion, request.periods, recording.size())) {
      remarks.push_back(recording.file + ": " + *told);
    }
    // The last sample was for this alone.
    excitation.time.pop_back();
    for (std::vector<double>* channel : {&motion.displacement, &motion.velocity, &motion.acceleration, &motion.force}) {
      channel->pop_back();
    }
  }
  as_motion.displacement = motion.displacement;
  as_motion.velocity = motion.velocity;
  append(remarks, beyond_fitted(stored, path, {as_motion}));
  if (recording.displacement.empty()) append(remarks, told_once(slowness_of(recording, as_motion, base)));
  return table_of(recording, excitation, motion);
}

}  // namespace hysteron

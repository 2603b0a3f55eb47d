#include "task/respond.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/frequency.hpp"
#include "respond/one_period.hpp"
#include "task/guesses.hpp"

namespace hysteron {
namespace {

void append(std::vector<std::string>& remarks, std::vector<std::string> more) {
  remarks.insert(remarks.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// A file that names a base has the displacement of the mass beside it, as what `respond` writes.
const std::vector<double>& ground_of(const Recording& recording) {
  return recording.base.empty() ? recording.displacement : recording.base;
}

std::string word_of(Excites excitation) { return excitation == Excites::base ? "base" : "force"; }

bool moves_base(const Recording& recording, Excites excitation) {
  const bool has_force = !recording.force.empty();
  const bool has_base = !ground_of(recording).empty();
  if (excitation == Excites::what_is_recorded && has_force == has_base) {
    throw InputError(recording.file +
                     (has_force ? ": holds a force and a displacement of the base, expected --excitation force or base"
                                : ": holds neither a force nor a base or displacement, expected one of them"));
  }
  const bool base = excitation == Excites::what_is_recorded ? has_base : excitation == Excites::base;
  if (base ? !has_base : !has_force) {
    throw InputError(recording.file + ": no " + (base ? "base or displacement" : "force") +
                     " column, expected one for --excitation " + word_of(excitation));
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

// The table of the last period, or of everything where none is repeated.
MassResponse table_of(const Recording& recording, const Excitation& excitation, const MassMotion& motion) {
  MassResponse result;
  result.base = excitation.base.has_value();
  std::string& text = result.csv;
  text = "time [s],displacement [m],velocity [m/s],acceleration [m/s^2],force [N]";
  text += excitation.drive ? (recording.drive_kind == DriveKind::voltage ? ",voltage [V]" : ",current [A]") : "";
  text += result.base ? ",base [m],absolute displacement [m]\n" : "\n";
  result.samples = recording.size();
  const std::size_t first = excitation.time.size() - recording.size();
  for (std::size_t n = first; n < excitation.time.size(); ++n) {
    const double time = excitation.time[n];
    text += fmt::format("{},{},{},{},{}", recording.time[n - first], motion.displacement[n], motion.velocity[n],
                        motion.acceleration[n], motion.force[n]);
    if (excitation.drive) text += fmt::format(",{}", excitation.drive->value(time));
    if (result.base) {
      const double b = excitation.base->value(time);
      text += fmt::format(",{},{}", b, b + motion.displacement[n]);
    }
    text += '\n';
    result.largest_displacement = std::max(result.largest_displacement, std::fabs(motion.displacement[n]));
    result.largest_force = std::max(result.largest_force, std::fabs(motion.force[n]));
  }
  return result;
}

}  // namespace

MassResponse response_to(StoredModel stored, const std::string& path, Recording recording,
                         const ResponseRequest& request, std::vector<std::string>& remarks) {
  follow_conditions(stored, {recording});
  if (std::isnan(request.drive)) check_drive(stored, path, recording);
  const bool base = moves_base(recording, request.excitation);
  if (base && request.interpolation == Interpolation::linear) {
    throw InputError(
        "--interpolation linear: straight lines of a base have no acceleration, expected cubic or band-limited");
  }
  if (request.periods > 0) close_period(recording, base, remarks);
  Recording as_motion = recording;
  as_motion.displacement = base ? ground_of(recording) : recording.force;
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
                   follows && drive_varies(recording));
  const Excitation excitation = excitation_of(recording, base, request);
  const MassMotion motion = respond(oscillator, excitation, request.respond);
  as_motion.displacement = motion.displacement;
  as_motion.velocity = motion.velocity;
  append(remarks, beyond_fitted(stored, path, {as_motion}));
  return table_of(recording, excitation, motion);
}

}  // namespace hysteron

// hysteron respond: motion of a mass on a model under a force or a base motion.
#include "respond/respond.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/frequency.hpp"
#include "respond/one_period.hpp"
#include "task/guesses.hpp"
#include "task/model_file.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string model;
  DataOptions data;
  Oscillator oscillator;
  RespondOptions respond;
  std::string excitation = "auto";
  std::string interpolation = "cubic";
  int periods = 0;
  double frequency = std::nan("");
  double drive = std::nan("");
  std::string out;
};

Recording read_excitation(const Options& options, const StoredModel& stored) {
  DataOptions data = options.data;
  data.conditions = conditions_of({&stored});
  refuse_unfollowed({&stored}, numbers_at(data));
  const Campaign campaign = load(data, Required::nothing);
  if (campaign.recordings.size() != 1) {
    throw InputError(options.data.data[0] + ": holds " + std::to_string(campaign.recordings.size()) +
                     " recordings, expected one");
  }
  return campaign.recordings[0];
}

void run(Options& options) {
  check_table(options.out, {options.model, options.data.data.front()});
  StoredModel stored = read_model(options.model);
  Recording recording = read_excitation(options, stored);
  follow_conditions(stored, {recording});
  if (std::isnan(options.drive)) {
    check_drive(stored, options.model, recording);
  }
  const bool has_force = !recording.force.empty();
  // A file that names a base has the displacement of the mass beside it, as what `respond` writes.
  const std::vector<double>& ground = recording.base.empty() ? recording.displacement : recording.base;
  const bool has_base = !ground.empty();
  if (options.excitation == "auto" && has_force == has_base) {
    throw InputError(recording.file +
                     (has_force ? ": holds a force and a displacement of the base, expected --excitation force or base"
                                : ": holds neither a force nor a base or displacement, expected one of them"));
  }
  const bool base = options.excitation == "auto" ? has_base : options.excitation == "base";
  if (base ? !has_base : !has_force) {
    throw InputError(recording.file + ": no " + (base ? "base or displacement" : "force") +
                     " column, expected one for --excitation " + options.excitation);
  }
  const Interpolation interpolation = interpolation_of(options.interpolation);
  if (base && interpolation == Interpolation::linear) {
    throw InputError(
        "--interpolation linear: straight lines of a base have no acceleration, expected cubic or band-limited");
  }
  const bool periodic = options.periods > 0;
  if (periodic && last_repeats_first(base ? ground : recording.force)) {
    for (std::vector<double>* channel : channels_of(recording)) {
      if (!channel->empty()) {
        channel->pop_back();
      }
    }
    warn_of({recording.file +
             ": the last sample repeats the first and is left out; it is taken as the start of the next "
             "period"});
  }
  double frequency = options.frequency;
  Recording as_motion = recording;
  as_motion.displacement = base ? ground : recording.force;
  if (!std::isnan(options.drive)) {
    as_motion.drive.assign(recording.size(), options.drive);
    as_motion.drive_kind = stored.drive;
  }
  if (std::isnan(frequency)) {
    frequency = dominant_frequency(as_motion);
  } else {
    stored.frequency_range.reset();  // the user's own choice
  }
  warn_of(guesses_of(stored, options.model, {as_motion}));
  Oscillator& oscillator = options.oscillator;
  oscillator.model = stored.model;
  oscillator.parameters = [&](double drive, std::span<const double> conditions) {
    return parameters_at(stored.held, stored.terms, drive, frequency, conditions);
  };
  const bool follows = std::ranges::any_of(stored.terms, [](const Term& term) { return term.drive_power > 0; });
  require_response(stored.model, parameters_at(stored.held, stored.terms, 0.0, frequency, middle_of(stored.conditions)),
                   follows && drive_varies(recording));
  Excitation excitation;
  excitation.time = periodic ? repeated_times(recording.time, options.periods) : recording.time;
  (base ? excitation.base : excitation.force) =
      Signal(recording.time, base ? ground : recording.force, interpolation, periodic);
  if (!std::isnan(options.drive)) {
    excitation.drive =
        Signal(recording.time, std::vector<double>(recording.size(), options.drive), Interpolation::linear, periodic);
  } else if (!recording.drive.empty()) {
    excitation.drive = Signal(recording.time, quiet_drive(recording.drive), Interpolation::linear, periodic);
  }
  excitation.conditions = condition_signals(recording, periodic);
  options.respond.stopped = interrupted;
  const MassMotion response = respond(oscillator, excitation, options.respond);
  as_motion.displacement = response.displacement;
  as_motion.velocity = response.velocity;
  warn_of(beyond_fitted(stored, options.model, {as_motion}));

  std::string text = "time [s],displacement [m],velocity [m/s],acceleration [m/s^2],force [N]";
  text += excitation.drive ? (recording.drive_kind == DriveKind::voltage ? ",voltage [V]" : ",current [A]") : "";
  text += base ? ",base [m],absolute displacement [m]\n" : "\n";
  const std::size_t count = excitation.time.size();
  const std::size_t first = periodic ? count - recording.size() : 0;
  double peak = 0.0;
  double force_peak = 0.0;
  for (std::size_t n = first; n < count; ++n) {
    const double time = excitation.time[n];
    text += fmt::format("{},{},{},{},{}", recording.time[n - first], response.displacement[n], response.velocity[n],
                        response.acceleration[n], response.force[n]);
    if (excitation.drive) {
      text += fmt::format(",{}", excitation.drive->value(time));
    }
    if (base) {
      const double b = excitation.base->value(time);
      text += fmt::format(",{},{}", b, b + response.displacement[n]);
    }
    text += '\n';
    peak = std::max(peak, std::fabs(response.displacement[n]));
    force_peak = std::max(force_peak, std::fabs(response.force[n]));
  }
  write_table(options.out, text);
  say_beside(options.out,
             fmt::format("{} samples, largest displacement {:.6g} mm{}, largest force of the model {:.6g} N\n",
                         count - first, 1e3 * peak, base ? " relative to the base" : "", force_peak));
}

}  // namespace

void add_respond(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("respond", "motion of a mass on a fitted model under a force or a base motion");
  command->add_option("MODEL", options->model, "model.json written by fit or diagnose")->required();
  command
      ->add_option("EXCITATION", options->data.data,
                   "file with time and a force on the mass, or a displacement of the base")
      ->required()
      ->expected(1);
  add_reading_options(*command, options->data);
  add_at_option(*command, options->data);
  command->add_option("--mass", options->oscillator.mass, "kg")->required()->check(real_number(1e-9, 1e12));
  command->add_option("--stiffness", options->oscillator.stiffness, "N/m, of a spring beside the model")
      ->check(real_number(-1e15, 1e15));
  command->add_option("--damping", options->oscillator.damping, "N s/m, of a dashpot beside the model")
      ->check(real_number(-1e15, 1e15));
  command
      ->add_option("--excitation", options->excitation,
                   "force: on the mass; base: displacement of the ground; auto: what the file holds")
      ->check(one_of({"auto", "force", "base"}))
      ->capture_default_str();
  command
      ->add_option("--interpolation", options->interpolation,
                   "of the excitation between its samples: linear, cubic, band-limited")
      ->check(one_of({"linear", "cubic", "band-limited"}))
      ->capture_default_str();
  command
      ->add_option(
          "--periods", options->periods,
          "the excitation is one period: it is repeated so many times and the last response is written; a last "
          "sample that repeats the first is left out")
      ->transform(whole_number(0, 10000));
  command->add_option("--x0", options->respond.displacement, "displacement at the start, m, relative to the base")
      ->check(real_number(-farthest_motion, farthest_motion));
  command->add_option("--v0", options->respond.velocity, "velocity at the start, m/s, relative to the base")
      ->check(real_number(-1e9, 1e9));
  command->add_option("--drive", options->drive, "constant current or voltage, instead of the file's")
      ->check(real_number(-1e9, 1e9));
  command
      ->add_option("--frequency", options->frequency,
                   "Hz, for parameters that follow it; default the excitation's dominant one")
      ->check(real_number(0.0, 1e9));
  command->add_option("--tolerance", options->respond.tolerance, "relative error of a step")
      ->check(real_number(1e-13, 1e-2))
      ->capture_default_str();
  command
      ->add_option(
          "--out", options->out,
          "file to write, CSV, or MAT by its ending .mat: motion relative to the base, force of the model; -: standard "
          "output")
      ->required();
  command->footer(
      "Examples:\n"
      "  hysteron respond out/model.json load.csv --mass 250 --stiffness 2e4 --out motion.csv\n"
      "  hysteron respond out/model.json quake.csv --mass 250 --excitation base --interpolation band-limited --out "
      "motion.csv");
  take_common_options(*command);
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

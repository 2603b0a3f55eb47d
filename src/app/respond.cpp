// hysteron respond: motion of a mass on a model under a force or a base motion.
#include "task/respond.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string model;
  DataOptions data;
  ResponseRequest request;
  std::string excitation = "auto";
  std::string interpolation = "cubic";
  std::string out;
};

Recording read_excitation(const Options& options, const StoredModel& stored) {
  DataOptions data = options.data;
  data.conditions = conditions_of({&stored});
  data.taken = recordings_alone;
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
  const StoredModel stored = read_model(options.model);
  const Recording recording = read_excitation(options, stored);
  ResponseRequest& request = options.request;
  request.excitation = excites_of(options.excitation);
  request.interpolation = interpolation_of(options.interpolation);
  request.respond.stopped = interrupted;
  std::vector<std::string> remarks;
  MassResponse response;
  try {
    response = response_to(stored, options.model, recording, request, remarks);
  } catch (...) {
    warn_of(remarks);  // a motion that runs away may do so for what they say
    throw;
  }
  warn_of(remarks);
  write_table(options.out, response.csv());
  say_beside(options.out,
             fmt::format("{} samples, largest displacement {:.6g} mm{}, largest force of the model {:.6g} N\n",
                         response.columns.front().size(), 1e3 * response.largest_displacement,
                         response.base ? " relative to the base" : "", response.largest_force));
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
  command->add_option("--mass", options->request.mass, "kg")->required()->check(real_number(1e-9, 1e12));
  command->add_option("--stiffness", options->request.stiffness, "N/m, of a spring beside the model")
      ->check(real_number(-1e15, 1e15));
  command->add_option("--damping", options->request.damping, "N s/m, of a dashpot beside the model")
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
          "--periods", options->request.periods,
          "the excitation is one period: it is repeated so many times and the last response is written; a last "
          "sample that repeats the first is left out")
      ->transform(whole_number(0, 10000));
  command
      ->add_option("--x0", options->request.respond.displacement, "displacement at the start, m, relative to the base")
      ->check(real_number(-farthest_motion, farthest_motion));
  command->add_option("--v0", options->request.respond.velocity, "velocity at the start, m/s, relative to the base")
      ->check(real_number(-1e9, 1e9));
  command->add_option("--drive", options->request.drive, "constant current or voltage, instead of the file's")
      ->check(real_number(-1e9, 1e9));
  command
      ->add_option("--frequency", options->request.frequency,
                   "Hz, for parameters that follow it; default the excitation's dominant one")
      ->check(real_number(0.0, 1e9));
  command->add_option("--tolerance", options->request.respond.tolerance, "relative error of a step")
      ->check(real_number(1e-13, 1e-2))
      ->capture_default_str();
  command
      ->add_option(
          "--out", options->out,
          "file to write, CSV, or MAT by its ending .mat: motion relative to the base, force on the mass or base, "
          "force of the model; -: standard output")
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

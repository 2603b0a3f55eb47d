// hysteron simulate: the force of an identified model on a recording's motion.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/model_file.hpp"
#include "core/error.hpp"
#include "io/output.hpp"

namespace hysteron::app {

void add_simulate(CLI::App& program) {
  struct Options {
    std::string model;
    DataOptions data;
    std::string out;
    double tolerance = 1e-4;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("simulate", "predicted force of a fitted model on the motion of a recording");
  command->add_option("MODEL", options->model, "model.json written by fit or diagnose")->required();
  command->add_option("RECORDING", options->data.data, "one CSV or MAT file; its force may be missing")->required()->expected(1);
  command->add_option("--column", options->data.columns, "channel=NAME [UNIT] of a column; repeatable")->allow_extra_args(false);
  command->add_option("--out", options->out, "CSV to write: time [s],force [N]")->required();
  command->add_option("--tolerance", options->tolerance, "relative force error allowed to the integration")
      ->check(CLI::Range(1e-10, 1e-2))
      ->capture_default_str();
  command->footer("Example:\n  hysteron simulate out/model.json recordings/r1.csv --out prediction.csv");
  command->callback([options] {
    const StoredModel stored = read_model(options->model);
    const Campaign campaign = load(options->data, false);
    if (campaign.recordings.size() != 1) {
      throw InputError(options->data.data[0] + ": holds " + std::to_string(campaign.recordings.size()) +
                       " recordings, expected one");
    }
    Recording recording = campaign.recordings[0];
    recording.force.clear();
    ObjectiveOptions objective;
    objective.tolerance = options->tolerance;
    const Target target = make_target(recording, objective);
    write_file_atomically(options->out,
                          csv_of_prediction(recording.time, predict(stored.model, stored.held, stored.terms, target)));
  });
}

}  // namespace hysteron::app

// hysteron score: how well an identified model predicts recordings.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "core/error.hpp"
#include "report/terminal.hpp"
#include "task/finite.hpp"
#include "task/predict.hpp"

namespace hysteron::app {

void add_score(CLI::App& program) {
  struct Options {
    std::string model;
    DataOptions data;
    CommonOptions common;
    std::string out;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("score", "errors of a fitted model on recordings it need not have seen");
  command->add_option("MODEL", options->model, "model.json written by fit or diagnose")->required();
  add_data_options(*command, options->data);
  add_keep_option(*command, options->data);
  add_at_option(*command, options->data);
  add_without_time_option(*command, options->data);
  add_common_options(*command, options->common);
  command->add_option("--out", options->out, "file for the table of recordings, CSV, or MAT by its ending .mat");
  command->add_flag("--json", options->json, "JSON on standard output");
  command->footer("Example:\n  hysteron score out/model.json other-recordings/ --json");
  command->callback([options] {
    if (is_standard_output(options->out)) {
      throw InputError("--out -: the scores are on standard output already, expected a file");
    }
    std::vector<std::string> inputs = options->data.data;
    inputs.push_back(options->model);
    check_table(options->out, inputs);
    const ObjectiveOptions objective = objective_options(options->common);
    StoredModel stored = read_model(options->model);
    options->data.conditions = conditions_of({&stored});
    options->data.follows_frequency = stored.follows_frequency();
    options->data.taken = recordings_alone;
    refuse_unfollowed({&stored}, numbers_at(options->data));
    const Campaign campaign = load(options->data);
    std::vector<std::string> remarks;
    const CampaignScore result = score_campaign(stored, options->model, campaign.recordings, objective, remarks);
    warn_of(remarks);
    const std::vector<Score>& scores = result.recordings;
    if (!options->out.empty()) {
      write_table(options->out, score_csv(result, campaign.recordings));
    }
    if (options->json) {
      fmt::print("{}", json_text(score_json(result, campaign.recordings, objective.normalisation)));
      return;
    }
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < scores.size(); ++k) {
      rows.push_back({campaign.recordings[k].file, format_number(scores[k].nrmse, 4), format_number(scores[k].rmse, 4),
                      percent_text(scores[k].fit_percent)});
    }
    fmt::print("{}\noverall NRMSE {} ({} weighting, normalised by {})\n",
               table({"recording", "NRMSE", "RMSE [N]", "fit [%]"}, rows), format_number(result.overall, 4),
               options->common.weighting, word_of(objective.normalisation));
  });
}

}  // namespace hysteron::app

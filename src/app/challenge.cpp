// hysteron challenge: concealed campaigns, sealed answers, diagnosis, opening of the seal, score.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "challenge/concealed.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/output.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string out;
  int campaigns = 300;
  std::vector<std::string> levels;
  std::vector<std::string> effects;
  int jobs = 0;
  bool generate_only = false;
  bool score_only = false;
  CommonOptions common;
};

std::vector<challenge::Task> tasks_of(const Options& options) {
  std::vector<challenge::Level> levels;
  for (const std::string& name : options.levels) levels.push_back(challenge::level_of(name));
  for (const std::string& id : options.effects) static_cast<void>(challenge::hidden_effect(id));
  return challenge::plan(options.campaigns, levels, options.effects, options.common.seed);
}

// Makes the campaigns and seals the answers. Campaigns are independent of one another and of the number of jobs.
void generate(const Options& options, const std::vector<challenge::Task>& tasks, ProgressLine& progress) {
  const std::filesystem::path out(options.out);
  std::vector<nlohmann::json> answers(tasks.size());
  std::exception_ptr failure;
  std::size_t done = 0;
  const int jobs = options.jobs > 0 ? options.jobs : options.common.threads > 0 ? options.common.threads : 2;
#pragma omp parallel for schedule(dynamic) num_threads(jobs)
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (interrupted()) continue;
    try {
      const challenge::Concealed concealed = challenge::make_concealed(tasks[k], options.common.seed);
      challenge::write_recordings(concealed, (out / concealed.name).string(), options.common.seed);
      answers[k] = challenge::answer_of(concealed);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
#pragma omp critical
    progress.show("making campaigns", static_cast<double>(++done) / static_cast<double>(tasks.size()),
                  fmt::format("{} of {}", done, tasks.size()));
  }
  progress.finish();
  if (failure) std::rethrow_exception(failure);
  if (interrupted()) throw WorkError("interrupted before the answers were sealed");
  const nlohmann::json all = {{"schema", "hysteron.answers/1"}, {"seed", options.common.seed}, {"campaigns", answers}};
  fmt::print("sealed {} campaigns, sha256 of the answers {}\n", tasks.size(), challenge::seal(all, out));
}

void run(const Options& options) {
  const std::vector<challenge::Task> tasks = tasks_of(options);
  make_output_folder(options.out);
  ProgressLine progress(options.common.quiet);
  if (!options.score_only) generate(options, tasks, progress);
}

}  // namespace

void add_challenge(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "challenge", "makes campaigns with concealed physics, seals the answers, diagnoses, opens the seal, scores");
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_option("--campaigns", options->campaigns, "number of campaigns")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command
      ->add_option("--level", options->levels,
                   "only these levels: plain, buried, absorbed, pairs, wrong-base, foreign, none, unexcited")
      ->delimiter(',');
  command->add_option("--effect", options->effects, "only these effects")->delimiter(',');
  command->add_option("--jobs", options->jobs, "campaigns at a time")->check(CLI::NonNegativeNumber);
  command->add_flag("--generate-only", options->generate_only, "stop after the answers are sealed");
  command->add_flag("--score-only", options->score_only, "score what has been diagnosed");
  add_common_options(*command, options->common);
  command->footer(
      "Examples:\n"
      "  hysteron challenge --out challenge --campaigns 300 --seed 1\n"
      "  hysteron challenge --out clear --campaigns 10 --level plain --effect clearance,inertia --generate-only");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

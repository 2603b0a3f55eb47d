// hysteron challenge: concealed campaigns, sealed answers, diagnosis, opening of the seal, score.
#include "report/challenge.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "challenge/effects.hpp"
#include "challenge/run.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/file.hpp"
#include "io/output.hpp"

extern char** environ;

namespace hysteron::app {
namespace {

struct Options {
  std::string out;
  int campaigns = 300;
  std::vector<std::string> levels;
  std::vector<std::string> effects;
  std::uint64_t seed = 1;
  int jobs = 2;
  int threads = 1;
  bool quiet = false;
  bool generate_only = false;
  bool score_only = false;
};

std::vector<challenge::Task> tasks_of(const Options& options) {
  std::vector<challenge::Level> levels;
  for (const std::string& name : options.levels) levels.push_back(challenge::level_of(name));
  for (const std::string& id : options.effects) static_cast<void>(challenge::hidden_effect(id));
  return challenge::plan(options.campaigns, levels, options.effects, options.seed);
}

std::string last_line(const std::filesystem::path& path) {
  std::string text = std::filesystem::exists(path) ? read_file(path) : "";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const auto begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

// `hysteron diagnose` as a process of its own: a diagnosis sees the folder of recordings and nothing else, and one that
// dies takes no other with it.
challenge::Diagnose diagnose_by_process(const Options& options) {
  return [options](const std::filesystem::path& data, const std::filesystem::path& out) {
    const std::filesystem::path messages = out / "messages.txt";
    std::vector<std::string> words = {"hysteron",
                                      "diagnose",
                                      data.string(),
                                      "--out",
                                      out.string(),
                                      "--seed",
                                      std::to_string(options.seed),
                                      "--threads",
                                      std::to_string(options.threads)};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    pid_t child = 0;
    const int started = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (started != 0) throw WorkError("cannot start the diagnosis of " + data.string());
    int status = 0;
    bool told = false;
    while (waitpid(child, &status, WNOHANG) == 0) {
      if (interrupted() && !told) {
        kill(child, SIGTERM);
        told = true;
      }
      usleep(20000);
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
      throw WorkError(WIFEXITED(status) ? last_line(messages) : "ended by signal " + std::to_string(WTERMSIG(status)));
    }
    if (!std::filesystem::exists(out / "diagnosis.json")) throw WorkError("no diagnosis.json was written");
  };
}

void run(const Options& options) {
  make_output_folder(options.out);
  const std::filesystem::path out(options.out);
  std::string hash;
  {
    ProgressLine line(options.quiet);
    challenge::Steps steps;
    steps.jobs = options.jobs;
    steps.interrupted = [] { return interrupted(); };
    steps.progress = [&line](const std::string& stage, double share, const std::string& detail) {
      line.show(stage, share, detail);
    };
    if (!options.score_only) {
      hash = challenge::make_all(out, tasks_of(options), options.seed, steps);
      line.finish();
      fmt::print("sha256 of the sealed answers: {}\n", hash);
      std::fflush(stdout);
      if (options.generate_only) return;
      const int failed = challenge::diagnose_all(out, diagnose_by_process(options), steps);
      line.finish();
      if (failed > 0) fmt::print(stderr, "{} diagnoses failed, see {}/diagnoses/*/failed.txt\n", failed, options.out);
    }
  }
  const nlohmann::json result = challenge::score_all(out, hash);
  write_file_atomically(out / "challenge.json", json_text(result));
  const std::string text = challenge_markdown(result);
  write_file_atomically(out / "challenge.md", text);
  write_file_atomically(out / "report.html", challenge_html(result));
  fmt::print("{}", text);
}

}  // namespace

void add_challenge(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "challenge", "makes campaigns with concealed physics, seals the answers, diagnoses, opens the seal, scores");
  command->add_option("--out", options->out, "folder to write; what an interrupted call left is gone on with")
      ->required();
  command->add_option("--campaigns", options->campaigns, "number of campaigns")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command
      ->add_option("--level", options->levels,
                   "only these levels: plain, buried, absorbed, pairs, wrong-base, foreign, none, unexcited")
      ->delimiter(',');
  command->add_option("--effect", options->effects, "only these effects")->delimiter(',');
  command->add_option("--seed", options->seed, "seed of everything that is drawn")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "campaigns at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "threads of one diagnosis")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "no progress on standard error");
  command->add_flag("--generate-only", options->generate_only, "stop after the answers are sealed");
  command->add_flag("--score-only", options->score_only, "open the seal and score what has been diagnosed")
      ->excludes("--generate-only");
  command->footer(
      "Examples:\n"
      "  hysteron challenge --out challenge --campaigns 300 --seed 1\n"
      "  hysteron challenge --out some --campaigns 10 --level plain --effect clearance,inertia --generate-only");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

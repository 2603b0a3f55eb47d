// hysteron challenge: concealed campaigns, sealed answers, diagnosis, opening of the seal, score.
#include "report/challenge.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "challenge/effects.hpp"
#include "challenge/hide.hpp"
#include "challenge/hide_run.hpp"
#include "challenge/run.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/campaign.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "report/hidden.hpp"
#include "report/markdown.hpp"

namespace hysteron::app {
namespace {

struct Options {
  std::string out;
  std::vector<std::string> data;  // recordings to hide effects in; empty: simulated campaigns
  std::string model;
  std::string by_current;
  std::vector<double> sizes = {0.3, 1.0, 3.0};
  int placebos = -1;  // 60, or none where effects are named
  int campaigns = 300;
  bool stops = false;
  int most_recordings = 0;  // 0: all
  std::vector<std::string> levels;
  std::vector<std::string> effects;
  challenge::FormChoice choice;
  std::uint64_t seed = 1;
  int jobs = 2;
  int threads = 1;
  bool quiet = false;
  bool generate_only = false;
  bool score_only = false;
  bool list = false;
  bool as_json = false;
};

// At the level `none` nothing is hidden that could be chosen.
void refuse_choice_of_nothing(const Options& options, const std::vector<challenge::Level>& levels) {
  const bool hidden =
      std::ranges::any_of(levels, [](challenge::Level level) { return level != challenge::Level::none; });
  if (levels.empty() || hidden) return;
  for (const auto& [option, ids] : {std::pair{"--effect", &options.effects},
                                    {"--forms", &options.choice.only},
                                    {"--without-forms", &options.choice.without},
                                    {"--foreign", &options.choice.foreign}}) {
    if (ids->empty()) continue;
    throw InputError(fmt::format("{} {}: at --level none nothing is hidden, expected another level, or no {}", option,
                                 fmt::join(*ids, ","), option));
  }
}

std::vector<challenge::Task> tasks_of(const Options& options) {
  std::vector<challenge::Level> levels;
  for (const std::string& name : options.levels) levels.push_back(challenge::level_of(name));
  for (const std::string& id : options.effects) static_cast<void>(challenge::hidden_effect(id));
  refuse_choice_of_nothing(options, levels);
  std::vector<challenge::Task> tasks =
      challenge::plan(options.campaigns, levels, options.effects, options.seed, options.choice);
  for (challenge::Task& task : tasks) {
    task.most_recordings = options.most_recordings;
    task.stops = options.stops;
  }
  return tasks;
}

std::string last_line(const std::filesystem::path& path) {
  std::string text = std::filesystem::exists(path) ? read_file(path) : "";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const auto begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

// This program as a process of its own; a WorkError with its last message when it fails.
void run_self(std::vector<std::string> words, const std::filesystem::path& messages, const std::string& what) {
  words.insert(words.begin(), "hysteron");
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  pid_t child = 0;
  const int started = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (started != 0) throw WorkError("cannot start " + what);
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
}

// A diagnosis sees the folder of recordings and nothing else, and one that dies takes no other with it.
challenge::Diagnose diagnose_by_process(const Options& options) {
  return [options](const std::filesystem::path& data, const std::filesystem::path& out) {
    run_self({"diagnose", data.string(), "--out", out.string(), "--seed", std::to_string(options.seed), "--threads",
              std::to_string(options.threads)},
             out / "messages.txt", "the diagnosis of " + data.string());
    if (!std::filesystem::exists(out / "diagnosis.json")) throw WorkError("no diagnosis.json was written");
  };
}

// What the base law, fitted to the recordings, leaves of their force.
challenge::BaseResidual residual_by_process(const Options& options) {
  return [options](const std::filesystem::path& data) {
    const std::filesystem::path out = std::filesystem::path(options.out) / "base";
    std::filesystem::create_directories(out);
    run_self({"fit", data.string(), "--out", out.string(), "--seed", std::to_string(options.seed), "--threads",
              std::to_string(options.threads)},
             out / "messages.txt", "the fit of " + data.string());
    const nlohmann::json fit = nlohmann::json::parse(read_file(out / "fit.json"));
    double squares = 0.0;
    const nlohmann::json& rows = fit.at("recordings");
    for (const nlohmann::json& row : rows) squares += std::pow(row.at("rmse_n").get<double>(), 2.0);
    return std::sqrt(squares / static_cast<double>(rows.size()));
  };
}

// What is hidden in recordings of a real damper: what --effect names, else everything that can be, and the placebos.
struct Hidden {
  Campaign campaign;
  std::vector<challenge::HideTask> tasks;
};

Hidden hidden_of(const Options& options) {
  Hidden result;
  Campaign& campaign = result.campaign;
  DataOptions data;
  data.data = options.data;
  data.taken.model = options.model.empty();
  if (!options.by_current.empty()) data.taken.other_laws = {"current"};
  campaign = load(data);
  if (!options.model.empty()) campaign.model = options.model;
  if (campaign.model.empty()) campaign.model = "bouc-wen";
  if (!options.by_current.empty()) campaign.by_current = parse_orders("--by-current", options.by_current);
  std::vector<std::string> ids = options.effects;
  for (const std::string& id : ids) challenge::check_hideable(id);
  if (ids.empty()) {
    // Most laws have an offset of their own.
    for (const std::string_view id : challenge::hideable()) {
      if (id != "offset-force") ids.emplace_back(id);
    }
  }
  const int placebo_count = options.placebos >= 0 ? options.placebos : options.effects.empty() ? 60 : 0;
  result.tasks = challenge::hide_tasks(ids, options.sizes, placebo_count, campaign);
  return result;
}

void write_hidden(const std::filesystem::path& out, const std::string& hash) {
  const nlohmann::json result = challenge::score_hidden(out, hash);
  write_file_atomically(out / "hidden.json", json_text(result));
  const std::string text = hidden_markdown(result);
  write_file_atomically(out / "hidden.md", text);
  fmt::print("{}", text);
}

// A score of some forms only stands beside that of all campaigns.
void write_simulated(const std::filesystem::path& out, const std::string& hash, const challenge::FormChoice& choice) {
  const nlohmann::json result = challenge::score_all(out, hash, choice);
  const bool some = !(choice.only.empty() && choice.without.empty() && choice.foreign.empty());
  write_file_atomically(out / (some ? "selected.json" : "challenge.json"), json_text(result));
  const std::string text = challenge_markdown(result);
  write_file_atomically(out / (some ? "selected.md" : "challenge.md"), text);
  write_file_atomically(out / (some ? "selected.html" : "report.html"), challenge_html(result));
  fmt::print("{}", text);
}

// Every effect with its forms, and the foreign causes.
void print_list(bool as_json) {
  nlohmann::json list = nlohmann::json::array();
  std::vector<std::vector<std::string>> rows;
  for (const challenge::HiddenEffect& effect : challenge::hidden_effects()) {
    for (const challenge::HiddenForm& form : effect.forms) {
      list.push_back({{"effect", effect.id}, {"form", form.id}, {"words", form.words}, {"foreign", effect.foreign}});
      rows.push_back({effect.foreign ? "(none)" : std::string(effect.id), form.id, std::string(form.words)});
    }
  }
  fmt::print("{}", as_json ? json_text(list) : markdown_table({"effect", "form", "what it is"}, rows));
}

// What shapes campaigns that are made would change nothing in a score of those that are there, nor in the list. A seed
// and threads are taken by every command, and jobs go with them.
void refuse_making(const CLI::App& command, const Options& options) {
  const auto refuse = [&](std::initializer_list<const char*> names, const char* beside) {
    for (const char* name : names) {
      if (command.get_option(name)->count() > 0) throw CLI::ExcludesError(name, beside);
    }
  };
  if (options.list) refuse({"--forms", "--without-forms", "--foreign", "--generate-only", "--score-only"}, "--list");
  if (!options.list && !options.score_only) return;
  refuse({"--in", "--model", "--by-current", "--sizes", "--placebos", "--campaigns", "--level", "--recordings",
          "--stops", "--effect"},
         options.list ? "--list" : "--score-only");
}

// What is hidden in recordings of a real damper has no forms to choose from.
void refuse_forms_of_hidden(const Options& options, bool hidden) {
  if (!hidden) return;
  for (const auto& [option, ids] : {std::pair{"--forms", &options.choice.only},
                                    {"--without-forms", &options.choice.without},
                                    {"--foreign", &options.choice.foreign}}) {
    if (ids->empty()) continue;
    throw InputError(
        fmt::format("{} {}: {} holds effects hidden in recordings, which are scored together, expected no "
                    "{}",
                    option, fmt::join(*ids, ","), options.out, option));
  }
}

void run(const Options& options) {
  if (options.list) return print_list(options.as_json);
  if (options.out.empty()) throw InputError("--out is required");
  refuse_standard_output(options.out, "campaigns, diagnoses and their score");
  const std::filesystem::path out(options.out);
  const bool hidden = options.score_only ? challenge::is_hidden_in_recordings(out) : !options.data.empty();
  // What is wrong with the options is said before a folder is made.
  for (const auto* list : {&options.choice.only, &options.choice.without, &options.choice.foreign}) {
    for (const std::string& id : *list) static_cast<void>(challenge::hidden_form(id));
  }
  refuse_forms_of_hidden(options, hidden);
  std::optional<Hidden> hiding;
  std::vector<challenge::Task> tasks;
  if (hidden && !options.score_only) {
    hiding = hidden_of(options);
  } else if (!hidden && !options.score_only) {
    tasks = tasks_of(options);
  }
  // What is hidden in recordings of a real damper has no report.html.
  if (!hidden) refuse_other_results(out, "seal.sha256");
  make_output_folder(options.out);
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
      hash = hidden
                 ? challenge::hide_all(out, hiding->campaign, hiding->tasks, options.seed, residual_by_process(options))
                 : challenge::make_all(out, tasks, options.seed, steps);
      line.finish();
      fmt::print("sha256 of the sealed answers: {}\n", hash);
      std::fflush(stdout);
      if (options.generate_only) return;
      const int failed = challenge::diagnose_all(out, diagnose_by_process(options), steps);
      line.finish();
      if (failed > 0) {
        fmt::print(stderr, "{} diagnoses failed, see {}/diagnoses/*/failed.txt\n", failed, printable(options.out));
      }
    }
  }
  if (hidden) return write_hidden(out, hash);
  // Campaigns that were made of some forms are all scored.
  write_simulated(out, hash, options.score_only ? options.choice : challenge::FormChoice{});
}

}  // namespace

void add_challenge(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "challenge", "makes campaigns with concealed physics, seals the answers, diagnoses, opens the seal, scores");
  command->add_option("--out", options->out, "folder to write; rerun an interrupted command to resume it");
  CLI::Option* data = command->add_option(
      "--in", options->data, "hide effects in these recordings of a real damper instead of simulating one");
  command->add_option("--model", options->model, "base damper law, with --in; default campaign.toml's, else bouc-wen")
      ->needs(data);
  command->add_option("--by-current", options->by_current, "laws of its parameters in the drive, with --in")
      ->needs(data);
  command
      ->add_option(
          "--sizes", options->sizes,
          "with --in: RMS of the hidden change of force over what the fitted base law leaves; 0: 0.1 to 0.3 of "
          "the force, drawn")
      ->delimiter(',')
      ->check(real_number(0.0, 100.0))
      ->capture_default_str()
      ->needs(data);
  command->add_option("--placebos", options->placebos, "with --in: number of placebos; default 60, none with --effect")
      ->transform(whole_number(0, 9000))
      ->needs(data);
  command->add_option("--campaigns", options->campaigns, "number of campaigns")
      ->transform(whole_number(1, 9999))
      ->capture_default_str()
      ->excludes(data);
  command
      ->add_option("--level", options->levels,
                   "only these levels: plain, buried, absorbed, pairs, wrong-base, foreign, beside, none, unexcited")
      ->delimiter(',')
      ->excludes(data);
  command
      ->add_option("--recordings", options->most_recordings,
                   "each campaign keeps one to so many of its recordings; default all")
      ->transform(whole_number(1, 100))
      ->excludes(data);
  command->add_flag("--stops", options->stops, "each recording ends at rest; not in the levels absorbed and unexcited")
      ->excludes(data);
  command->add_option("--effect", options->effects, "only these effects; with --in several at once as A+B")
      ->delimiter(',');
  command->add_option("--forms", options->choice.only, "only these forms of the effects, as EFFECT/FORM")
      ->delimiter(',')
      ->excludes(data);
  command->add_option("--without-forms", options->choice.without, "all but these forms and foreign causes")
      ->delimiter(',')
      ->excludes(data);
  command->add_option("--foreign", options->choice.foreign, "only these foreign causes")
      ->delimiter(',')
      ->excludes(data);
  command->add_option("--seed", options->seed, "seed of everything that is drawn")
      ->transform(seed_number())
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "campaigns at a time")
      ->transform(whole_number(1, 1024))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "threads of one diagnosis")
      ->transform(whole_number(1, 1024))
      ->capture_default_str();
  CLI::Option* list = command->add_flag("--list", options->list, "list effects, forms and foreign causes, and stop");
  command->add_flag("--json", options->as_json, "the list as JSON")->needs(list);
  command->add_flag("--quiet", options->quiet, "no progress on standard error");
  command->add_flag("--generate-only", options->generate_only, "stop after the answers are sealed");
  command
      ->add_flag("--score-only", options->score_only,
                 "open the seal and score what has been diagnosed; with --forms, --without-forms or --foreign only "
                 "campaigns of "
                 "these, into selected.json, .md and .html")
      ->excludes("--generate-only");
  command->footer(
      "Examples:\n"
      "  hysteron challenge --out challenge --campaigns 300 --seed 1\n"
      "  hysteron challenge --out some --campaigns 10 --level plain --effect clearance,inertia --generate-only\n"
      "  hysteron challenge --out challenge --score-only --forms clearance/hertz,inertia/entrained\n"
      "  hysteron challenge --in recordings/ --model bouc-wen --by-current alpha:1,c0:1 --out hidden\n"
      "  hysteron challenge --in recordings/ --effect inertia,asymmetry+compliance --sizes 1,3 --placebos 20 --out "
      "hidden");
  command->callback([options, command] {
    refuse_making(*command, *options);
    run(*options);
  });
}

}  // namespace hysteron::app

// hysteron diagnose: names the physics a model leaves out, writes diagnosis.json, model.json, report.html.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>

#include "app/command.hpp"
#include "app/laws.hpp"
#include "app/result.hpp"
#include "app/unfinished.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/checkpoint.hpp"
#include "io/output.hpp"
#include "report/html.hpp"
#include "task/diagnosis.hpp"
#include "task/diagnosis_text.hpp"

namespace hysteron::app {
namespace {

struct Options {
  DataOptions data;
  CommonOptions common;
  std::string model;
  LawOptions follow;
  std::vector<std::string> effects;
  std::vector<std::string> laws;
  int most_effects = 5;
  bool json = false;
  std::string out;
};

void tell_found(const Checkpoint& checkpoint, bool quiet) {
  const std::string path = printable(checkpoint.path().string());
  switch (checkpoint.found()) {
    case Checkpoint::Found::nothing:
    case Checkpoint::Found::in_use:  // trouble(), which is told with what else may go wrong
      return;
    case Checkpoint::Found::pieces:
      if (!quiet) {
        fmt::print(stderr, "resuming: {} finished pieces of work are in {}\n", checkpoint.pieces(), path);
      }
      return;
    case Checkpoint::Found::of_another_command:
      fmt::print(stderr, "{} is of other recordings, options or another program: starting afresh\n", path);
      return;
    case Checkpoint::Found::damaged:
      fmt::print(stderr, "{} is damaged: starting afresh\n", path);
      return;
  }
}

// Share of the time that the diagnosis takes; then its records are made.
constexpr double of_diagnosis = 0.69;

// Nothing where it was interrupted, which is said: what is known so far, and that rerunning the command resumes.
std::unique_ptr<Diagnosis> diagnosed(const Campaign& campaign, DiagnoseOptions options, Checkpoint* checkpoint,
                                     ProgressLine& progress) {
  Unfinished unfinished;
  bool told = false;
  const auto tell_trouble = [&] {
    if (checkpoint == nullptr || told || checkpoint->trouble().empty()) {
      return;
    }
    progress.finish();
    fmt::print(stderr, "warning: {} cannot be kept: {}; an interruption would lose the work\n",
               printable(checkpoint->path().string()), checkpoint->trouble());
    told = true;
  };
  options.checkpoint = checkpoint;
  options.stopped = interrupted;
  options.stands = [&](const Fit& fit) {
    if (!interrupted()) {  // then fits end before their end
      unfinished.stands(fit);
    }
  };
  std::unique_ptr<Diagnosis> result;
  try {
    result = diagnose(campaign, options, [&](double share, const std::string& stage) {
      if (interrupted()) {
        throw Stopped{};
      }
      progress.show(stage, of_diagnosis * share, "");
      unfinished.stage(of_diagnosis * share, stage);
      tell_trouble();
    });
  } catch (const Stopped&) {
    result.reset();
  } catch (const InputError&) {
    if (checkpoint != nullptr) {
      checkpoint->remove();
    }
    throw;
  }
  tell_trouble();
  if (!interrupted()) {
    return result;
  }
  progress.finish();
  const std::size_t pieces = checkpoint == nullptr || told ? 0 : checkpoint->pieces();
  if (pieces > 0) {
    unfinished.write(checkpoint->path().parent_path() / "interrupted.json", pieces);
  }
  fmt::print(stderr, "interrupted {}; {}\n", printable(unfinished.sentence()),
             pieces > 0 ? fmt::format("{} finished pieces of work are in {}; rerun the command to resume", pieces,
                                      printable(checkpoint->path().string()))
                        : "nothing was written");
  return nullptr;
}

void run(const Options& options) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<std::string> remarks;
  DataOptions from = options.data;
  ask_conditions(options.follow, from);
  from.taken.model = options.model.empty();
  const Campaign campaign = load(from, Required::motion_and_force, &remarks);
  DiagnoseOptions diagnose_with;
  diagnose_with.model = options.model;
  set_laws(options.follow, diagnose_with.layout);
  diagnose_with.objective = objective_options(options.common);
  diagnose_with.seed = options.common.seed;
  diagnose_with.most_effects = options.most_effects;
  diagnose_with.candidates = options.effects;
  if (options.laws == std::vector<std::string>{"none"}) {
    diagnose_with.laws.clear();
  } else if (!options.laws.empty()) {
    diagnose_with.laws = options.laws;
  }
  // Wrong names are told before any work.
  check_diagnosis(campaign, diagnose_with);
  const bool to_files = !is_standard_output(options.out);
  const std::filesystem::path out(options.out);
  std::optional<Checkpoint> checkpoint;
  if (to_files) {
    check_output_folder(out);
    warn_or_refuse_other_results(out, "diagnosis.json", "fit.json");
    checkpoint.emplace(out / "diagnosis.partial", identity_of(campaign, diagnose_with));
    tell_found(*checkpoint, options.common.quiet);
  }
  ProgressLine progress(options.common.quiet);
  const std::unique_ptr<Diagnosis> diagnosis =
      diagnosed(campaign, diagnose_with, checkpoint ? &*checkpoint : nullptr, progress);
  if (diagnosis == nullptr) {
    return;
  }
  if (to_files) {
    make_output_folder(out);
  }

  const auto [diagnosis_file, model_file, page] = records_of(
      *diagnosis, campaign, diagnose_with, remarks, command_line(),
      [&](double share) { progress.show("preparing the report", of_diagnosis + (1.0 - of_diagnosis) * share, ""); });
  progress.finish();

  if (!to_files) {
    write_result(options.out, json_text(diagnosis_file));
    say_beside(options.out, diagnosis_text(diagnosis_file, "diagnosis.json"));
    return;
  }
  // diagnosis.json last: it says that all are there.
  write_file_atomically(out / "model.json", json_text(model_file));
  write_file_atomically(out / "report.html", fit_report_html(page));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  write_file_atomically(out / "environment.json", json_text(environment(options.common.threads, seconds)));
  write_file_atomically(out / "diagnosis.json", json_text(diagnosis_file));
  std::error_code ignored;
  std::filesystem::remove(out / "interrupted.json", ignored);
  checkpoint->remove();
  if (options.json) {
    fmt::print("{}", json_text(diagnosis_file));
  } else {
    fmt::print("{}report: {}\n", diagnosis_text(diagnosis_file, (out / "diagnosis.json").string()),
               printable((out / "report.html").string()));
  }
}

}  // namespace

void add_diagnose(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("diagnose", "finds where recording and simulation differ and names the missing physics");
  add_data_options(*command, options->data);
  add_keep_option(*command, options->data);
  command->add_option("--model", options->model, "base damper law; default campaign.toml's, else bouc-wen");
  add_law_options(*command, options->follow);
  command->add_option("--effects", options->effects, "effects to consider; default all, see `hysteron list effects`")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--laws", options->laws,
                   "damper laws to compare with the base law; `none`: the base law is taken for right")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--most-effects", options->most_effects, "effects the augmented model may have")
      ->transform(whole_number(1, 7))
      ->capture_default_str();
  command->add_flag("--json", options->json, "diagnosis.json on standard output too");
  command
      ->add_option("--out", options->out,
                   "folder for diagnosis.json, model.json, report.html; -: diagnosis.json on standard output")
      ->required();
  add_common_options(*command, options->common);
  command->footer("Example:\n  hysteron diagnose recordings/ --model bouc-wen --by-current alpha:1,c0:1 --out out");
  command->callback([options] { run(*options); });
}

}  // namespace hysteron::app

// What the subcommands share: options, input, progress, output files.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/progress_line.hpp"
#include "core/recording.hpp"
#include "fit/identify.hpp"
#include "io/channels.hpp"
#include "task/json_text.hpp"
#include "task/load.hpp"

namespace hysteron::app {

// Options of every command that reads recordings.
struct DataOptions {
  std::vector<std::string> data;
  std::vector<std::string> columns;     // force="CH1 [kgf]"
  std::string group;                    // group or sheet of files that have them
  int skip = 0;                         // lines at the head of every CSV file, rows of a sheet
  std::size_t keep_samples = 0;         // of all recordings together, 0 for all
  std::vector<std::string> conditions;  // columns that laws follow, beside those of campaign.toml
  bool follows_frequency = false;       // laws do
  bool without_time = false;            // where a file has none
  std::vector<std::string> at;          // NAME=NUMBER [UNIT], of every recording
  TakenOfCampaign taken;                // of a campaign.toml
};
void add_data_options(CLI::App& command, DataOptions& options);
// --column, --group and --skip, for commands that name their recordings in another way.
void add_reading_options(CLI::App& command, DataOptions& options);
// Refuses them where no recording is read, as they would change nothing: expected `beside` beside them.
void refuse_reading_options(const CLI::App& command, const std::string& beside);
// For commands that identify; the others take every sample.
void add_keep_option(CLI::App& command, DataOptions& options);
// --at, for commands that take a model whose laws may follow what the recordings do not hold.
void add_at_option(CLI::App& command, DataOptions& options);
// For commands that take recordings without a time column (task/rate.hpp).
void add_without_time_option(CLI::App& command, DataOptions& options);
// The name of a condition without the unit that may stand behind it: `valve` of "Valve [%]". InputError, opened by the
// option, as condition_name has it.
std::string name_asked(const std::string& text, const std::string& option);
// The numbers of --at, by name.
std::map<std::string, ConditionNumber> numbers_at(const DataOptions& options);
// Says on standard error what readers remark, once for all recordings alike, and puts it into `warnings`.
void tell(const std::vector<Remark>& remarks, std::vector<std::string>* warnings = nullptr);
// What the readers remark is said on standard error, once for all recordings alike, and put into `warnings`.
Campaign load(const DataOptions& options, Required required = Required::motion_and_force,
              std::vector<std::string>* warnings = nullptr);

// "warning: ..." on standard error, a line each.
void warn_of(const std::vector<std::string>& remarks);
// Likewise of solvers of the user's own that did not end well. Not of an interrupted command, which interrupts them
// too.
void warn_of_failed_ends();

struct CommonOptions {
  std::uint64_t seed = 1;
  int threads = 0;
  bool quiet = false;
  std::string normalisation = "max-abs";
  std::string weighting = "per-recording";
  double tolerance = 1e-4;
};
void add_common_options(CLI::App& command, CommonOptions& options);
// For commands that draw nothing, share no work and measure no error: the options that scripts give to every command
// are taken, their values checked, and change nothing.
void take_common_options(CLI::App& command);
ObjectiveOptions objective_options(const CommonOptions& options);

// "alpha:1,c0:2" -> orders; InputError naming the option and the word that is wrong.
std::map<std::string, int> parse_orders(const std::string& option, const std::string& text);

// --solver-command NAME=COMMAND: solvers that are programs of the user's own (external/external_solver.hpp), to be
// added before their names are looked for.
void add_solver_option(CLI::App& command, std::vector<std::string>& commands);
void add_solver_commands(const std::vector<std::string>& commands);
// A program that is never started would be taken for the one that found the result. `expected` goes before its name.
void refuse_unused_commands(const std::vector<std::string>& commands, const std::vector<std::string>& solvers,
                            const std::string& expected);

// Ends the program with a status, when all has been said: by another process where several work together.
struct Ended {
  int status;
};

// Set by SIGINT and SIGTERM; long work checks it between generations. A second signal, a second later, ends the
// program.
bool interrupted();
void catch_interrupts();

// `--out -`: the one result goes to standard output, and words go to standard error.
bool is_standard_output(const std::string& out);
// Throws InputError for `-` where several files are written.
void refuse_standard_output(const std::string& out, const std::string& files);

// Facts that vary between identical runs: host, threads, wall time.
nlohmann::json environment(int threads, double seconds);

// The command line as typed, without the folder of the program.
void remember_command(int count, char** arguments);
const std::string& command_line();

// Of the program, in the order of --help.
std::vector<const CLI::App*> commands_of(const CLI::App& program);

void add_fit(CLI::App& program);
void add_simulate(CLI::App& program);
void add_score(CLI::App& program);
void add_export(CLI::App& program);
void add_manual(CLI::App& program);
void add_completion(CLI::App& program);
void add_profile(CLI::App& program);
void add_minimise(CLI::App& program);
void add_compare(CLI::App& program);
void add_respond(CLI::App& program);
void add_catalogue(CLI::App& program);
void add_generate(CLI::App& program);
void add_diagnose(CLI::App& program);
void add_challenge(CLI::App& program);
void add_bench(CLI::App& program);
void add_report(CLI::App& program);
void add_merge(CLI::App& program);
void add_reproduce(CLI::App& program);

}  // namespace hysteron::app

#include "app/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string_view>

#include "app/option_name.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "external/external_solver.hpp"
#include "external/line_program.hpp"
#include "fit/parallel.hpp"
#include "fit/weighting.hpp"
#include "io/block_means.hpp"
#include "io/campaign_file.hpp"
#include "io/channels.hpp"
#include "io/condition_faults.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/sha256.hpp"
#include "task/command_text.hpp"
#include "task/load.hpp"

namespace hysteron::app {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;
timespec interrupt_time{};

// Of a monotonic clock.
double seconds_since(const timespec& then) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - then.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - then.tv_nsec);
}

// What sends one signal may send it twice, as `timeout` does.
constexpr double same_interrupt = 1.0;  // s

extern "C" void on_interrupt(int /*signal*/) {
  if (interrupt_seen == 0) {
    clock_gettime(CLOCK_MONOTONIC, &interrupt_time);
    interrupt_seen = 1;
  } else if (seconds_since(interrupt_time) > same_interrupt) {
    constexpr std::string_view words = "\nerror: interrupted twice: ended where it was, nothing more is kept\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
    _exit(130);
  }
}
std::string typed;

}  // namespace

void add_data_options(CLI::App& command, DataOptions& options) {
  command
      .add_option("DATA", options.data,
                  "CSV, MAT, TDMS, MDF 4, RPC III or xlsx files, or folders of them with an optional campaign.toml")
      ->required();
  add_reading_options(command, options);
}

void add_reading_options(CLI::App& command, DataOptions& options) {
  command
      .add_option("--column", options.columns, "channel=NAME [UNIT] of a column, e.g. force=\"CH1 [kgf]\"; repeatable")
      ->allow_extra_args(false);
  command.add_option("--group", options.group,
                     "group of TDMS and MDF files, or sheet of workbooks, that is read alone");
  command
      .add_option("--skip", options.skip, "lines at the head of every CSV file, or rows of a sheet, that are not read")
      ->transform(whole_number(0, 100000));
}

void refuse_reading_options(const CLI::App& command, const std::string& beside) {
  for (const char* name : {"--column", "--group", "--skip"}) {
    if (command.get_option(name)->count() > 0) throw CLI::RequiresError(name, beside);
  }
}

void add_keep_option(CLI::App& command, DataOptions& options) {
  options.keep_samples = default_keep_samples;
  command
      .add_option("--keep-samples", options.keep_samples,
                  "samples kept of all recordings together; of more, several in a row are averaged to one")
      ->transform(whole_number(2000, 1000000000))
      ->capture_default_str();
}

void add_at_option(CLI::App& command, DataOptions& options) {
  command
      .add_option("--at", options.at,
                  "NAME=NUMBER [UNIT] of what laws follow and no column holds, e.g. pressure=\"2.1 bar\"; repeatable")
      ->allow_extra_args(false);
}

void add_without_time_option(CLI::App& command, DataOptions& options) {
  command.add_flag("--without-time", options.without_time,
                   "files may have no time column: for laws whose force does not depend on the rate");
}

std::string name_asked(const std::string& text, const std::string& option) {
  const Column column = split_column(text);
  return condition_name(column.unit.empty() ? text : column.name, option);
}

std::map<std::string, ConditionNumber> numbers_at(const DataOptions& options) {
  std::map<std::string, ConditionNumber> result;
  for (const std::string& text : options.at) {
    const auto [word, value] = split_pair("--at", text, "NAME=NUMBER [UNIT], e.g. pressure=\"2.1 bar\"");
    std::optional<ConditionNumber> number = condition_number(value);
    std::string with_unit = value;
    // "pressure [bar]=2.1"
    if (const std::string unit = split_column(word).unit; number && number->unit.empty() && !unit.empty()) {
      with_unit += " " + unit;
      number = condition_number(with_unit);
    }
    if (!number) {
      throw InputError("--at: '" + value + "' of " + word + " is not a number with a unit, expected e.g. 2.1e5 or " +
                       "\"2.1 bar\"");
    }
    number->file = "--at";
    const std::string name = name_asked(word, "--at");
    if (const std::string fault = fault_of_condition(name, with_unit); !fault.empty()) {
      throw InputError("--at: " + fault);
    }
    if (!result.emplace(name, *number).second) {
      throw InputError("--at: '" + name + "' is given twice, expected each once");
    }
  }
  return result;
}

namespace {

// `--column time=t displacement=x`: the second mapping stands where a file is expected.
void refuse_mappings_as_files(const std::vector<std::string>& data) {
  for (const std::string& text : data) {
    const auto equals = text.find('=');
    std::error_code code;
    if (equals != std::string::npos && quantity_of_name(text.substr(0, equals)) &&
        !std::filesystem::exists(text, code)) {
      throw InputError("'" + text + "' is no file, expected --column before each mapping: --column '" + text + "'");
    }
  }
}

ReadOptions read_options(const DataOptions& options) {
  refuse_mappings_as_files(options.data);
  ReadOptions read;
  read.group = options.group;
  read.skip = options.skip;
  read.keep_samples = options.keep_samples;
  read.conditions = options.conditions;
  read.follows_frequency = options.follows_frequency;
  read.without_time = options.without_time;
  std::ranges::sort(read.conditions);
  read.numbers = numbers_at(options);
  for (const std::string& mapping : options.columns) {
    const auto equals = mapping.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == mapping.size()) {
      throw InputError("--column: '" + mapping + "' is not a mapping, expected CHANNEL=NAME, e.g. force=\"CH1 [kgf]\"");
    }
    if (!read.columns.emplace(mapping.substr(0, equals), mapping.substr(equals + 1)).second) {
      throw InputError("--column: '" + mapping.substr(0, equals) + "' is mapped twice, expected each channel once");
    }
  }
  return read;
}

}  // namespace

void tell(const std::vector<Remark>& remarks, std::vector<std::string>* warnings) {
  for (const Remark& remark : once_each(remarks)) {
    fmt::print(stderr, "warning: {}: {}\n", printable(remark.file), printable(remark.text.with(option_name)));
    if (warnings != nullptr) warnings->push_back(warning_of(remark));
  }
}

Campaign load(const DataOptions& options, Required required, std::vector<std::string>* warnings) {
  Loaded loaded = load_with_remarks(options.data, read_options(options), required, options.taken);
  tell(loaded.remarks, warnings);
  return std::move(loaded.campaign);
}

void warn_of(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) fmt::print(stderr, "warning: {}\n", printable(remark));
}

void warn_of_failed_ends() {
  if (!interrupted()) warn_of(take_failed_ends());
}

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--seed", options.seed, "seed of every random stream")
      ->transform(seed_number())
      ->capture_default_str();
  command.add_option("--threads", options.threads, "worker threads; 0 takes OMP_NUM_THREADS or all cores")
      ->transform(whole_number(0, 1024))
      ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "no progress on standard error");
  command
      .add_option("--normalisation", options.normalisation, "what RMSE is divided by: max-abs, range, std, mean-abs")
      ->capture_default_str();
  command
      .add_option("--weighting", options.weighting,
                  "per-recording: each recording weighs the same; pooled: each sample")
      ->check(one_of({"per-recording", "pooled"}))
      ->capture_default_str();
  command.add_option("--tolerance", options.tolerance, "relative force error allowed to the integration")
      ->check(real_number(1e-10, 1e-2))
      ->capture_default_str();
}

void take_common_options(CLI::App& command) {
  const std::string group = "Options of every command, without effect in this one";
  const auto take = [&](const std::string& name, CLI::Validator value, const std::string& meaning) {
    if (command.get_option_no_throw(name) == nullptr) {
      command
          .add_option_function<std::string>(
              name, [](const std::string&) {}, meaning)
          ->check(std::move(value))
          ->group(group);
    }
  };
  take("--seed", seed_number(), "nothing is drawn");
  take("--threads", whole_number(0, 1024), "no work is shared");
  take("--normalisation", one_of({"max-abs", "range", "std", "mean-abs"}), "no error is measured");
  if (command.get_option_no_throw("--quiet") == nullptr) {
    command
        .add_flag_function(
            "--quiet", [](std::int64_t) {}, "no progress is shown")
        ->group(group);
  }
}

ObjectiveOptions objective_options(const CommonOptions& options) {
  ObjectiveOptions result;
  result.normalisation = normalisation_of(options.normalisation);
  result.weighting = weighting_of(options.weighting);
  result.tolerance = options.tolerance;
  result.threads = options.threads;
  return result;
}

std::map<std::string, int> parse_orders(const std::string& option, const std::string& text) {
  std::map<std::string, int> result;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::size_t colon = word.find(':');
    const std::string order = colon == std::string::npos ? "" : word.substr(colon + 1);
    if (colon == 0 || order.size() != 1 || order[0] < '0' || order[0] > '0' + highest_order) {
      throw InputError(option + ": '" + word + "' is wrong, expected PARAMETER:ORDER with an order from 0 to " +
                       std::to_string(highest_order) + ", e.g. alpha:1,c0:1");
    }
    if (!result.emplace(word.substr(0, colon), order[0] - '0').second) {
      throw InputError(option + ": '" + word.substr(0, colon) + "' is given twice, expected each parameter once");
    }
    begin = end + 1;
  }
  return result;
}

void add_solver_option(CLI::App& command, std::vector<std::string>& commands) {
  command
      .add_option("--solver-command", commands,
                  "NAME=COMMAND: a solver that is a program of your own, see docs/own-solver.md; repeatable")
      ->allow_extra_args(false);
}

void add_solver_commands(const std::vector<std::string>& commands) {
  for (const std::string& text : commands) {
    const auto [name, command] = split_pair("--solver-command", text, "NAME=COMMAND, e.g. mine=\"python3 mine.py\"");
    ExternalProgram program{words_of_command(command), {}};
    for (const std::string& word : program.words) {
      if (std::filesystem::is_regular_file(word)) program.files[word] = sha256_hex(read_file(word));
    }
    add_external_solver(name, std::move(program));
  }
}

void refuse_unused_commands(const std::vector<std::string>& commands, const std::vector<std::string>& solvers,
                            const std::string& expected) {
  for (const std::string& text : commands) {
    const std::string name = text.substr(0, text.find('='));
    if (std::ranges::find(solvers, name) != solvers.end()) continue;
    throw InputError("--solver-command: '" + name + "' is not among the solvers asked for, expected " + expected +
                     name);
  }
}

bool interrupted() { return interrupt_seen != 0; }

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file beyond the limit of its size is then an error of writing it, and no temporary file is left.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_standard_output(const std::string& out) { return out == "-"; }

void refuse_standard_output(const std::string& out, const std::string& files) {
  if (is_standard_output(out)) {
    throw InputError("--out -: several files are written (" + files + "), expected a folder for them");
  }
}

nlohmann::json environment(int threads, double seconds) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  return {{"schema", "hysteron.environment/1"}, {"host", host},
          {"threads", team_size(threads)},      {"wall_seconds", seconds},
          {"lanes_vector_bytes", vector_bytes}, {"compiler", __VERSION__}};
}

void remember_command(int count, char** arguments) {
  typed = command_text(std::vector<std::string>(arguments + std::min(count, 1), arguments + count));
}

const std::string& command_line() { return typed; }

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

}  // namespace hysteron::app

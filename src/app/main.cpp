// The command line: exit status 0 done, 1 the work failed, 2 wrong input, 130 interrupted.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>

#include "app/command.hpp"
#include "app/complaint.hpp"
#include "app/mistyped.hpp"
#include "app/option_name.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/printable.hpp"
#include "mpi/mpi_peers.hpp"
#include "plugin/plugin.hpp"

namespace {

// Before anything reads the catalogue: the --plugin options in front of the subcommand.
void load_plugins(int count, char** arguments) {
  for (int k = 1; k < count; ++k) {
    const std::string word = arguments[k];
    if (word == "--plugin" && k + 1 < count) {
      hysteron::load_plugin(arguments[++k]);
    } else if (word.starts_with("--plugin=")) {
      hysteron::load_plugin(word.substr(9));
    } else {
      return;
    }
  }
}

// Names tell how many words there are; a count behind them, as in "MODEL RECORDING(1x)", does not.
class WithoutCounts : public CLI::Formatter {
 public:
  std::string make_option_usage(const CLI::Option* option) const override {
    std::string text = Formatter::make_option_usage(option);
    const auto count = text.rfind('(');
    if (count != std::string::npos && text.find("x)", count) != std::string::npos) {
      const auto end = text.find("x)", count) + 2;
      text.erase(count, end - count);
    }
    return text;
  }
};

int run(int count, char** arguments) {
  using namespace hysteron;
  app::remember_command(count, arguments);
  app::catch_interrupts();
  CLI::App program{
      "Hysteron identifies damper models from recordings, compares identification algorithms, and finds missing "
      "physics.",
      "hysteron"};
  program.formatter(std::make_shared<WithoutCounts>());  // before the commands, which take it over
  program.set_version_flag("--version", "hysteron " HYSTERON_VERSION);
  program.require_subcommand(1);
  std::vector<std::string> plugins;
  program
      .add_option("--plugin", plugins,
                  "library with models, effects or solvers of your own, see docs/plugins.md; repeatable")
      ->allow_extra_args(false);
  program.footer(
      "First steps, with data that ship with the program:\n"
      "  hysteron generate rd8040-twin --only 2.0Hz --out twin\n"
      "  hysteron fit twin --model bouc-wen --by-current alpha:2,c0:2 --out out\n"
      "  hysteron generate rd8041-voltage-twin --out steps\n"
      "  hysteron diagnose steps --out diagnosis\n"
      "fit and diagnose write report.html; open it in a browser. For recordings of your own, give a folder of CSV\n"
      "files in place of twin and steps. Every command has its own --help, with examples.");
  // Of several processes with one command line the first speaks.
  const auto started = launched();
  const auto complain = [&](const std::string& message) {
    if (!started || started->rank == 0) fmt::print(stderr, "error: {}\n", printable(message));
  };
  app::add_fit(program);
  app::add_simulate(program);
  app::add_score(program);
  app::add_compare(program);
  app::add_respond(program);
  app::add_export(program);
  app::add_catalogue(program);
  app::add_generate(program);
  app::add_diagnose(program);
  app::add_challenge(program);
  app::add_bench(program);
  app::add_report(program);
  app::add_merge(program);
  app::add_reproduce(program);
  app::add_minimise(program);
  app::add_profile(program);
  app::add_manual(program);
  app::add_completion(program);
  try {
    load_plugins(count, arguments);
    std::vector<std::string> words = app::understood(program, count, arguments);
    std::ranges::reverse(words);  // CLI11 takes them from the end
    program.parse(words);
  } catch (const CLI::Success& success) {
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    complain(app::complaint(program, error));
    return 2;
  } catch (const OptionError& error) {
    complain(error.message().with(app::option_name));
    return 2;
  } catch (const InputError& error) {
    complain(error.what());
    return 2;
  } catch (const WorkError& error) {
    complain(error.what());
    return app::interrupted() ? 130 : 1;
  } catch (const app::Ended& ended) {
    return ended.status;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
    return 1;
  } catch (const std::exception& error) {
    // {fmt} throws where standard output cannot be written, which main says.
    if (std::ferror(stdout) == 0) complain(std::string("internal: ") + error.what());
    return 1;
  }
  return app::interrupted() ? 130 : 0;
}

}  // namespace

// A standard descriptor that is closed would be given to the first file opened, which then gets what is printed.
void occupy_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1) continue;
    // The lowest free number is this one. Results that nobody can read are a failure, messages are not.
    if (open(descriptor == STDOUT_FILENO ? "/dev/full" : "/dev/null", O_RDWR) != descriptor) std::_Exit(1);
  }
}

// Results are on standard output, or the work has failed.
int flushed(int status) {
  errno = 0;
  std::cout.flush();
  const bool good = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (good || status == 2) return status;
  fmt::print(stderr, "error: standard output cannot be written{}\n",
             errno == 0 ? "" : " (" + std::system_category().message(errno) + ")");
  return status == 0 ? 1 : status;
}

int main(int count, char** arguments) {
  try {
    occupy_standard_descriptors();
    return flushed(run(count, arguments));
  } catch (...) {
    std::fputs("error: internal: unknown exception\n", stderr);
    return 1;
  }
}

#include "app/mistyped.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::app {
namespace {

std::vector<std::string> commands_of(const CLI::App& program) {
  std::vector<std::string> result;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    result.push_back(command->get_name());
  }
  return result;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> result;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      result.push_back("--" + name);
    }
  }
  return result;
}

void refuse_unknown_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> known = commands_of(program);
  known.insert(known.end(), {"help", "version"});
  if (std::ranges::find(known, word) == known.end()) {
    throw InputError("there is no command '" + word + "'" + suggestion(word, known) + ", see hysteron --help");
  }
}

// Words behind the command. A value that begins with two dashes is written --option=VALUE.
void refuse_unknown_options(const CLI::App& command, const std::vector<std::string>& words, std::size_t from) {
  const std::vector<std::string> known = options_of(command);
  for (std::size_t k = from; k < words.size() && words[k] != "--"; ++k) {
    const std::string option = words[k].substr(0, words[k].find('='));
    if (option.starts_with("--") && std::ranges::find(known, option) == known.end()) {
      throw InputError(command.get_name() + " has no option '" + option + "'" + suggestion(option, known) +
                       ", see hysteron " + command.get_name() + " --help");
    }
  }
}

}  // namespace

std::vector<std::string> understood(const CLI::App& program, int count, char** arguments) {
  std::vector<std::string> words(arguments + 1, arguments + count);
  std::size_t k = 0;
  while (k < words.size() && words[k].starts_with("-")) {
    k += words[k] == "--plugin" ? 2 : 1;
  }
  if (words.empty()) {
    return {"--help"};
  }
  if (k >= words.size()) {
    return words;
  }
  refuse_unknown_command(program, words[k]);
  if (words[k] == "version") {
    words[k] = "--version";
  } else if (words[k] == "help" && k + 1 < words.size()) {
    refuse_unknown_command(program, words[k + 1]);
    words[k] = words[k + 1];
    words[k + 1] = "--help";
  } else if (words[k] == "help") {
    words[k] = "--help";
  } else {
    refuse_unknown_options(*program.get_subcommand(words[k]), words, k + 1);
  }
  return words;
}

std::string see_help(const CLI::App& program) {
  const std::vector<CLI::App*> typed = program.get_subcommands();
  return "see hysteron " + (typed.empty() ? std::string() : typed.front()->get_name() + " ") + "--help";
}

}  // namespace hysteron::app

#include "app/mistyped.hpp"

#include <algorithm>
#include <cctype>

#include "app/command.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::app {
namespace {

std::vector<std::string> names_of_commands(const CLI::App& program) {
  std::vector<std::string> result;
  for (const CLI::App* command : commands_of(program)) result.push_back(command->get_name());
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
  std::vector<std::string> known = names_of_commands(program);
  known.insert(known.end(), {"help", "version"});
  if (std::ranges::find(known, word) == known.end()) {
    throw InputError("there is no command '" + word + "'" + suggestion(word, known) + ", see hysteron --help");
  }
}

// "--budget" of "--budget=5"; empty for words that are no options: values, negative numbers, and "-", the standard
// output. Words of one dash and a letter are none but -h.
std::string option_in(const std::string& word) {
  const bool dashed = word.starts_with("--") ||
                      (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0);
  return dashed ? word.substr(0, word.find('=')) : std::string();
}

bool knows(const CLI::App& command, const std::string& option) {
  const std::vector<std::string> known = options_of(command);
  return option == "-h" || std::ranges::find(known, option) != known.end();
}

// Words behind the command. A value that begins with two dashes is written --option=VALUE.
void refuse_unknown_options(const CLI::App& command, const std::vector<std::string>& words, std::size_t from) {
  for (std::size_t k = from; k < words.size() && words[k] != "--"; ++k) {
    const std::string option = option_in(words[k]);
    if (!option.empty() && !knows(command, option)) {
      throw InputError(command.get_name() + " has no option '" + option + "'" +
                       suggestion(option, options_of(command)) + ", see hysteron " + command.get_name() + " --help");
    }
  }
}

// A word in front of the command, or without one.
void refuse_unknown_option(const CLI::App& program, const std::string& word) {
  const std::string option = option_in(word);
  if (option.empty() || knows(program, option)) return;
  for (const CLI::App* command : commands_of(program)) {
    if (knows(*command, option)) {
      throw InputError("'" + option + "' stands before a command, expected it behind one that has it, as in hysteron " +
                       command->get_name() + " " + option);
    }
  }
  throw InputError("hysteron has no option '" + option + "'" + suggestion(option, options_of(program)) +
                   ", see hysteron --help");
}

}  // namespace

std::vector<std::string> understood(const CLI::App& program, int count, char** arguments) {
  std::vector<std::string> words(arguments + 1, arguments + count);
  std::size_t k = 0;
  while (k < words.size() && words[k].starts_with("-")) {
    refuse_unknown_option(program, words[k]);
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

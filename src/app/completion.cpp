// hysteron completion: completes commands, options and their words in a shell, from the description of the command line
// that --help prints and the catalogue.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/values.hpp"
#include "export/targets.hpp"
#include "fit/solver.hpp"
#include "simulate/part.hpp"
#include "task/catalogue.hpp"

namespace hysteron::app {
namespace {

// The words an option takes: the choices that its check names, or ids of the catalogue.
std::vector<std::string> values_of(const CLI::App& command, const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string name = option.get_name();
  const std::string& of = command.get_name();
  const auto rows = [&](const char* kind) {
    for (const CatalogueRow& row : catalogue_rows(kind)) words.push_back(row.id);
  };
  const auto parts = [&](std::span<const Part* const> catalogue) {
    for (const Part* part : catalogue) {
      words.emplace_back(part->id);
    }
  };
  if (name == "--model") {
    parts(model_catalogue());
  } else if (name == "--effects" || name == "--effect") {
    parts(effect_catalogue());
  } else if (name == "--solver") {
    for (const SolverEntry* solver : solver_catalogue()) {
      words.emplace_back(solver->id);
    }
  } else if (of == "export" && name == "--to") {
    for (const ExportTarget& target : export_targets()) words.emplace_back(target.id);
  } else if (of == "describe" && option.get_positional()) {
    words = describable_ids();
  } else if (of == "generate" && option.get_positional()) {
    rows("datasets");
  } else if (of == "reproduce" && option.get_positional()) {
    rows("tables");
  } else {
    // "TEXT:{one,two}"
    const std::string type = option.get_type_name();
    const auto open = type.find('{');
    const auto close = type.find('}', open);
    if (open != std::string::npos && close != std::string::npos) {
      std::size_t begin = open + 1;
      while (begin < close) {
        const std::size_t end = std::min(type.find(',', begin), close);
        words.push_back(type.substr(begin, end - begin));
        begin = end + 1;
      }
    }
  }
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

// Long options of a command, those among them whose values are known, those that stand alone; and the words that the
// command takes in front of them.
struct Words {
  std::vector<std::string> options;
  std::vector<std::pair<std::string, std::vector<std::string>>> values;
  std::vector<std::string> flags;
  std::vector<std::string> arguments;
};
Words words_of(const CLI::App& command) {
  Words result;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      const std::vector<std::string> values = values_of(command, *option);
      result.arguments.insert(result.arguments.end(), values.begin(), values.end());
    }
    for (const std::string& name : option->get_lnames()) {
      result.options.push_back("--" + name);
      if (option->get_items_expected_max() == 0) result.flags.push_back("--" + name);
      if (const std::vector<std::string> values = values_of(command, *option); !values.empty()) {
        result.values.emplace_back("--" + name, values);
      }
    }
  }
  return result;
}

std::string bash_of(const CLI::App& program) {
  std::vector<std::string> names;
  std::string cases;
  for (const CLI::App* command : commands_of(program)) {
    const Words words = words_of(*command);
    names.push_back(command->get_name());
    cases += fmt::format("    {})\n      case \"$previous\" in\n", command->get_name());
    for (const auto& [option, values] : words.values) {
      cases += fmt::format("        {}) words=\"{}\" ;;\n", option, joined(values));
    }
    if (!words.arguments.empty()) {
      std::string before = command->get_name();  // an argument follows the command itself or what stands alone
      for (const std::string& flag : words.flags) before += "|" + flag;
      cases += fmt::format("        {}) words=\"{}\"; [[ $current == -* ]] && words=\"{}\" ;;\n", before,
                           joined(words.arguments), joined(words.options));
    }
    cases += fmt::format("        *) [[ $current == -* ]] && words=\"{}\" ;;\n      esac ;;\n", joined(words.options));
  }
  return fmt::format(
      "# Completion of hysteron for bash; files where nothing else fits.\n"
      "_hysteron() {{\n"
      "  local current=\"${{COMP_WORDS[COMP_CWORD]}}\" previous=\"${{COMP_WORDS[COMP_CWORD-1]}}\" command=\"\" "
      "words=\"\" "
      "word\n"
      "  for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    case \" {0} \" in *\" $word \"*) command=\"$word\"; break ;; esac\n"
      "  done\n"
      "  case \"$command\" in\n"
      "    \"\") words=\"{0} --help --version --plugin\" ;;\n{1}"
      "  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}}\n"
      "complete -o default -F _hysteron hysteron\n",
      joined(names), cases);
}

std::string zsh_of(const CLI::App& program) {
  return "#compdef hysteron\nautoload -U +X bashcompinit && bashcompinit\n" + bash_of(program);
}

// Text in single quotes for fish.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    result += letter == '\'' || letter == '\\' ? std::string("\\") + letter : std::string(1, letter);
  }
  return result + "'";
}

std::string fish_of(const CLI::App& program) {
  std::string text = "# Completion of hysteron for fish.\n";
  for (const CLI::App* command : commands_of(program)) {
    text += fmt::format("complete -c hysteron -n __fish_use_subcommand -a {} -d {}\n", command->get_name(),
                        quoted(command->get_description()));
    if (const std::string arguments = joined(words_of(*command).arguments); !arguments.empty()) {
      text += fmt::format(
          "complete -c hysteron -n '__fish_seen_subcommand_from {0}; and not __fish_seen_subcommand_from {1}' -f -a "
          "{2}\n",
          command->get_name(), arguments, quoted(arguments));
    }
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        const std::vector<std::string> values = values_of(*command, *option);
        text += fmt::format("complete -c hysteron -n '__fish_seen_subcommand_from {}' -l {} -d {}{}\n",
                            command->get_name(), name, quoted(option->get_description()),
                            values.empty() ? "" : " -x -a " + quoted(joined(values)));
      }
    }
  }
  return text;
}

}  // namespace

void add_completion(CLI::App& program) {
  auto shell = std::make_shared<std::string>();
  CLI::App* completion = program.add_subcommand("completion", "prints the completion of commands for a shell");
  completion->add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
  completion->footer("Example:\n  source <(hysteron completion bash)");
  completion->callback([&program, shell] {
    fmt::print("{}", *shell == "bash" ? bash_of(program) : *shell == "zsh" ? zsh_of(program) : fish_of(program));
  });
}

}  // namespace hysteron::app

// hysteron man and hysteron completion: the manual page and the completion of shells, from the description of the
// command line that --help prints.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command.hpp"
#include "app/values.hpp"
#include "fit/solver.hpp"
#include "simulate/part.hpp"

namespace hysteron::app {
namespace {

// --- the manual page

// Text that roff takes as it stands.
std::string roff(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else if ((letter == '.' || letter == '\'') && (result.empty() || result.back() == '\n')) {
      result += std::string("\\&") + letter;
    } else {
      result += letter;
    }
  }
  return result;
}

std::string option_text(const CLI::Option& option) {
  std::string text = ".TP\n.B " + roff(option.get_name(option.get_positional()));
  if (!option.get_positional() && option.get_items_expected_max() > 0 && !option.get_type_name().empty()) {
    text += " \\fI" + roff(option.get_type_name()) + "\\fR";
  }
  text += "\n" + roff(option.get_description());
  if (!option.get_default_str().empty()) {
    text += roff(" (default " + option.get_default_str() + ")");
  }
  return text + "\n";
}

std::string manual_of(const CLI::App& program) {
  std::string text = ".TH HYSTERON 1 \"\" \"hysteron " HYSTERON_VERSION
                     "\" \"User commands\"\n.SH NAME\nhysteron \\- " +
                     roff("identifies damper models from recordings") + "\n.SH SYNOPSIS\n.B hysteron\n" +
                     roff("[--plugin LIBRARY]... COMMAND [OPTION]...") + "\n.SH DESCRIPTION\n" +
                     roff(program.get_description()) + "\n";
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) {
    text += ".SS " + roff("hysteron " + command->get_name()) + "\n" + roff(command->get_description()) + ".\n";
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_name() != "--help") {
        text += option_text(*option);
      }
    }
    if (!command->get_footer().empty()) {
      text += ".PP\n.nf\n" + roff(command->get_footer()) + "\n.fi\n";
    }
  }
  text += ".SH EXIT STATUS\n" +
          roff("0 done, 1 the work failed, 2 the command line or an input is wrong, 130 interrupted.") +
          "\n.SH ENVIRONMENT\n.TP\n.B OMP_NUM_THREADS\nthreads where " + roff("--threads") +
          " is not given\n.TP\n.B NO_COLOR\nno colours\n.SH EXAMPLES\n.nf\n" + roff(program.get_footer()) + "\n.fi\n";
  return text;
}

// --- completion

// The words an option takes: the choices that its check names, or ids of the catalogue.
std::vector<std::string> values_of(const CLI::App& command, const CLI::Option& option) {
  std::vector<std::string> words;
  const std::string name = option.get_name();
  const auto parts = [&](std::span<const Part* const> catalogue) {
    for (const Part* part : catalogue) {
      words.emplace_back(part->id);
    }
  };
  if (name == "--model") {
    parts(model_catalogue());
  } else if (name == "--effects") {
    parts(effect_catalogue());
  } else if (name == "--solver") {
    for (const SolverEntry* solver : solver_catalogue()) {
      words.emplace_back(solver->id);
    }
  } else if (command.get_name() == "export" && name == "--to") {
    words = {"c", "fmu", "simulink", "modelica", "python"};
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

// Long options of a command, and those among them whose values are known.
struct Words {
  std::vector<std::string> options;
  std::vector<std::pair<std::string, std::vector<std::string>>> values;
};
Words words_of(const CLI::App& command) {
  Words result;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      result.options.push_back("--" + name);
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

void add_manual(CLI::App& program) {
  CLI::App* manual = program.add_subcommand("man", "prints the manual page, for `man -l -`");
  manual->footer("Example:\n  hysteron man | man -l -");
  manual->callback([&program] { fmt::print("{}", manual_of(program)); });
  auto shell = std::make_shared<std::string>();
  CLI::App* completion = program.add_subcommand("completion", "prints the completion of commands for a shell");
  completion->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  completion->footer("Example:\n  source <(hysteron completion bash)");
  completion->callback([&program, shell] {
    fmt::print("{}", *shell == "bash" ? bash_of(program) : *shell == "zsh" ? zsh_of(program) : fish_of(program));
  });
}

}  // namespace hysteron::app

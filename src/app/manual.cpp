// hysteron man: the manual page, from the description of the command line that --help prints.
#include <fmt/format.h>

#include "app/command.hpp"

namespace hysteron::app {
namespace {

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

}  // namespace

void add_manual(CLI::App& program) {
  CLI::App* manual = program.add_subcommand("man", "prints the manual page, for `man -l -`");
  manual->footer("Example:\n  hysteron man | man -l -");
  manual->callback([&program] { fmt::print("{}", manual_of(program)); });
}

}  // namespace hysteron::app

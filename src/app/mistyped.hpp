// Words of the command line that are no command and no option, told before anything else of it is read, with the
// nearest ones there are; and the words `help` and `version` as people type them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hysteron::app {

// Arguments behind the name of the program, as CLI11 is to read them: no word at all and `help` become --help, `help
// fit` becomes `fit --help`, `version` becomes --version. Throws InputError for an unknown command or option.
std::vector<std::string> understood(const CLI::App& program, int count, char** arguments);

// "see hysteron fit --help", of the command that was typed, else of the program.
std::string see_help(const CLI::App& program);

}  // namespace hysteron::app

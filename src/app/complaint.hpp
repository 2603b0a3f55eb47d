// What the parser of the command line refuses, in the words of the rest of the program: what is wrong, what is
// expected.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hysteron::app {

// One line, without "error: ", that ends with the command's --help.
std::string complaint(const CLI::App& program, const CLI::ParseError& error);

}  // namespace hysteron::app

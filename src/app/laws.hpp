// Options that say which parameters are polynomials in what: --by-current, --by-frequency, --by NAME=...
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fit/layout.hpp"

namespace hysteron::app {

struct LawOptions {
  std::string by_current;
  std::string by_frequency;
  std::vector<std::string> by;  // NAME=PARAMETER:ORDER,...; current and frequency are those above
};
void add_law_options(CLI::App& command, LawOptions& options);

// Names of the conditions that --by asks for, to be read with the recordings. InputError for words that are wrong.
std::vector<std::string> conditions_asked(const LawOptions& options);

// The laws of the command line.
void set_laws(const LawOptions& options, LayoutOptions& layout);

}  // namespace hysteron::app

// Options that say which parameters are polynomials in what: --by-current, --by-frequency, --by NAME=...
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "fit/layout.hpp"

namespace hysteron::app {

struct LawOptions {
  std::string by_current;
  std::string by_frequency;
  std::vector<std::string> by;  // NAME=PARAMETER:ORDER,...; current and frequency are those above
};
void add_law_options(CLI::App& command, LawOptions& options);

// The conditions that --by asks for are read with the recordings: their names, and the columns of those that are named
// with a unit. Of campaign.toml other laws are taken. InputError for words that are wrong.
void ask_conditions(const LawOptions& options, DataOptions& data);

// The laws of the command line.
void set_laws(const LawOptions& options, LayoutOptions& layout);

}  // namespace hysteron::app

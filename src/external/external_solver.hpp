// A solver of the user's own, in any language: a program that is asked for points and told their costs by lines of
// JSON on its standard input and output. docs/own-solver.md has the protocol; box, budget and counting are those of
// every other solver.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

struct ExternalProgram {
  std::vector<std::string> words;            // the program and its arguments
  std::map<std::string, std::string> files;  // words that are files, with the sha256 of what they hold

  bool operator==(const ExternalProgram&) const = default;
};

// Adds a solver `id` to the catalogue, which starts the program anew for every run; nothing where it is there already
// with the same program. Throws InputError when the id is empty or taken.
void add_external_solver(const std::string& id, ExternalProgram program);

// Which of these programs, since the last call, ended with another exit status than 0 or by a signal once their input
// had ended, one sentence for all that ended alike: nothing in a run's result shows it.
std::vector<std::string> take_failed_ends();

// nullptr where the solver is none of these.
const ExternalProgram* external_program(std::string_view id);

}  // namespace hysteron

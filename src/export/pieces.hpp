// What C and Python are told alike of an exported model.
#pragma once

#include <string>
#include <vector>

#include "export/exported.hpp"
#include "export/writer.hpp"

namespace hysteron {

struct ChainFacts {
  bool series = false;   // some link needs the force of those below, or deflects them
  bool settles = false;  // some state may rest at its bound
  bool recalls = false;  // some link sees the drive of another instant
  bool alone = true;     // no effect bends the motion that the law sees
  int memories = 0;      // links that remember the drive
};
ChainFacts facts_of(const std::vector<ExportedLink>& links);

// Parameter number k of the model in terms of `drive` and `frequency`.
std::string expression_of_parameter(const ExportedModel& exported, std::size_t k);

// Numbers of the parameters that occur, ascending.
std::vector<int> parameters_used(const Statements& statements);

// x to jerk, as members of what a part sees.
const char* motion_member(Argument argument);

// Seven numbers of a sample with commas between them; one force a line, indented, with a comma behind it.
std::string literals(const TestSample& sample);
std::string lines_of(const std::vector<double>& force);

}  // namespace hysteron

// The equations of an exported model as a Modelica block that any tool's solver integrates.
#pragma once

#include <string>

#include "export/exported.hpp"

namespace hysteron {

struct ModelicaBlock {
  std::string text;    // block Damper, and functions that remember the drive, indented once
  bool drive = false;  // whether it is an input, as the next two
  bool acceleration = false;
  bool jerk = false;
  bool samples = false;  // whether what remembers the drive is updated at samples
};

// Throws InputError as links_of does, and for a delay of the drive that follows the drive.
ModelicaBlock modelica_block(const ExportedModel& exported, const TestVector& vector);

// block Test, which replays the test vector.
std::string modelica_test(const TestVector& vector, const ModelicaBlock& block);

}  // namespace hysteron

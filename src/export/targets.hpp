// The languages and tools that `export` writes for.
#pragma once

#include <span>
#include <string>

#include "export/c_source.hpp"

namespace hysteron {

struct Export {
  ExportedFiles files;
  std::string note;  // one line for the user: how to use them
};

struct ExportTarget {
  std::string_view id;
  std::string_view extension;  // of its main file, with the dot; empty: always a folder
  Export (*write)(const ExportedModel& exported, const TestVector& vector);
};

std::span<const ExportTarget> export_targets();
// Throws InputError for an unknown word.
const ExportTarget& export_target(const std::string& id);

Export export_c(const ExportedModel& exported, const TestVector& vector);
Export export_fmu(const ExportedModel& exported, const TestVector& vector);
Export export_simulink(const ExportedModel& exported, const TestVector& vector);
Export export_modelica(const ExportedModel& exported, const TestVector& vector);
Export export_python(const ExportedModel& exported, const TestVector& vector);

}  // namespace hysteron

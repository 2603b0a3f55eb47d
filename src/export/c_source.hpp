// C99: a model in one source file with its header, and a program that replays a test vector.
#pragma once

#include <map>
#include <string>

#include "export/exported.hpp"

namespace hysteron {

// File name -> text.
using ExportedFiles = std::map<std::string, std::string>;

struct CSource {
  std::string header;
  std::string source;  // includes NAME.h
};
CSource c_source(const ExportedModel& exported, const TestVector& vector);

// NAME.h, NAME.c, NAME_test.c.
ExportedFiles c_files(const ExportedModel& exported, const TestVector& vector);

// A runtime text (runtime.hpp) with @name@ and @NAME@ put in.
std::string with_name(std::string_view text, const std::string& name);
std::string replaced(std::string text, const std::string& what, const std::string& with);

}  // namespace hysteron

// The one result of a command.
#pragma once

#include <string>
#include <string_view>

#include "task/result_file.hpp"

namespace hysteron::app {

// To a file as write_file_atomically does, or, for `-`, to standard output, whose failure main tells.
void write_result(const std::string& out, std::string_view bytes);
// As table_bytes has it.
void write_table(const std::string& out, const std::string& csv);
// What is said beside it: on standard output, which the result takes where `out` is `-`; then on standard error.
void say_beside(const std::string& out, std::string_view text);

}  // namespace hysteron::app

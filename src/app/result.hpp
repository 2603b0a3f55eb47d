// The one result of a command.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron::app {

// Throws InputError where `out` is one of the files read, or the file of a recording in one of the folders read, which
// the result would replace.
void refuse_inputs(const std::string& out, const std::vector<std::string>& inputs);
// Throws InputError where a file of `folder` that would be written is there, differs, and does not say that hysteron
// wrote it.
void refuse_foreign(const std::filesystem::path& folder, const std::map<std::string, std::string>& files);
// As refuse_inputs for a table, whose ending must not be that of another kind of file.
void check_table(const std::string& out, const std::vector<std::string>& inputs);
// To a file as write_file_atomically does, or, for `-`, to standard output, whose failure main tells.
void write_result(const std::string& out, std::string_view bytes);
// A table as CSV text with units behind its names: as it is, or as a MAT file of one vector a column where `out` ends
// in .mat.
void write_table(const std::string& out, const std::string& csv);
// What is said beside it: on standard output, which the result takes where `out` is `-`; then on standard error.
void say_beside(const std::string& out, std::string_view text);

}  // namespace hysteron::app

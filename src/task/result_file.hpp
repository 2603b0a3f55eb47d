// Files that results are written to.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hysteron {

// Throws InputError where `out` is one of the files read, or the file of a recording in one of the folders read, which
// the result would replace.
void refuse_inputs(const std::string& out, const std::vector<std::string>& inputs);
// Throws InputError where one of these files is there, differs, and does not say that hysteron wrote it; `texts` are
// by their path below `folder`.
void refuse_foreign(const std::filesystem::path& folder, const std::map<std::string, std::string>& texts);
// As refuse_inputs for a table, whose ending must not be that of another kind of file.
void check_table(const std::string& out, const std::vector<std::string>& inputs);
// A table as CSV text with units behind its names: as it is, or as a MAT file of one vector a column where `out` ends
// in .mat.
std::string table_bytes(const std::string& out, const std::string& csv);

}  // namespace hysteron

// The one result of a command.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "task/result_file.hpp"

namespace hysteron::app {

// To a file as write_file_atomically does, or, for `-`, to standard output, whose failure main tells.
void write_result(const std::string& out, std::string_view bytes);
// As table_bytes has it.
void write_table(const std::string& out, const std::string& csv);
// What is said beside it: on standard output, which the result takes where `out` is `-`; then on standard error.
void say_beside(const std::string& out, std::string_view text);

// Throws InputError where the folder holds results of another command, whose report.html would be replaced: `own` is
// the file that tells this command's, as "compare.json". Where that is there already nothing is refused.
void refuse_other_results(const std::filesystem::path& folder, std::string_view own);
// The same, but where the folder holds `other`, which has a model.json too, that is told: a fit and a diagnosis of the
// same recordings may go to one folder, and the last model stays.
void warn_or_refuse_other_results(const std::filesystem::path& folder, std::string_view own, std::string_view other);
// Throws InputError where a recording, or a folder of them, that is read lies in the folder: tables written there would
// be read as recordings.
void refuse_data_folder(const std::filesystem::path& folder, const std::vector<std::string>& data);

}  // namespace hysteron::app

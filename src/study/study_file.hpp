// The study file, schema "hysteron.study/1".
#pragma once

#include <filesystem>

#include "study/study.hpp"

namespace hysteron {

// Unknown keys, names, settings, wrong types and values are InputErrors at file:line, with what was expected. Paths of
// recordings are taken relative to the study file. Whether recordings exist is not looked at.
[[nodiscard]] Study read_study_file(const std::filesystem::path& path);
// The same of the text of a file; `path` opens the messages.
[[nodiscard]] Study parse_study_file(const std::string& text, const std::filesystem::path& path);

}  // namespace hysteron

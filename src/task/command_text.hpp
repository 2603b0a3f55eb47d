#pragma once

#include <string>
#include <vector>

namespace hysteron {

// A word as a shell takes it: in quotes where it holds a blank.
std::string quoted_word(const std::string& word);

// "hysteron WORDS": the command line as provenance. Without --threads, --out and --quiet, which do not change results
// and would make identical runs differ, and without the folders of absolute paths.
std::string command_text(const std::vector<std::string>& words);

}  // namespace hysteron

#pragma once

#include <string>
#include <vector>

namespace hysteron {

// "hysteron WORDS": the command line as provenance. Without --threads and --out, which do not change results and would
// make identical runs differ, and without the folders of absolute paths.
std::string command_text(const std::vector<std::string>& words);

}  // namespace hysteron

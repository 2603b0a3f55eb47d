// A zip archive in memory, the same bytes for the same files.
#pragma once

#include <map>
#include <string>

namespace hysteron {

// Path in the archive -> bytes. Throws WorkError.
std::string zip_of(const std::map<std::string, std::string>& files);

}  // namespace hysteron

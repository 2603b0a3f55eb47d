// The C compiler of this machine, for an FMU's binary.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hysteron {

// Bytes of a shared library made of these files (name -> text) in a folder of its own; `sources` are compiled. Nothing
// where there is no cc or it fails.
std::optional<std::string> shared_library(const std::map<std::string, std::string>& files,
                                          const std::vector<std::string>& sources);

// "linux64" as FMI 2.0 names it; empty on platforms it has no name for.
std::string fmi_platform();

}  // namespace hysteron

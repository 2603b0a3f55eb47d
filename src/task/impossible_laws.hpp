// Values that the laws of a model give a parameter and that it cannot have.
#pragma once

#include <string>
#include <vector>

#include "task/model_file.hpp"

namespace hysteron {

// A remark for each parameter that a law in drive, frequency or conditions makes what its card excludes, such as a
// damping below zero, at a node of the range that the laws were fitted over: a fit keeps its values there inside of its
// bounds, so somebody has written them. A constant that is impossible is refused when the file is read.
std::vector<std::string> impossible_laws(const StoredModel& stored, const std::string& path);

}  // namespace hysteron

// "did you mean": the nearest known word for a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// " (did you mean 'x'?)" or empty when nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace hysteron

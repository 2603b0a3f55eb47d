// What the recordings show, whatever its cause: signature contrasts that speak, in words.
#pragma once

#include <string>
#include <vector>

#include "diagnose/judge/verdict.hpp"

namespace hysteron {

// Of contrasts that speak for nothing in `names`, loudest first: of what the law asked for leaves, with those that are
// gone behind the law in its place, and of what shows only behind that one. Empty where none speaks.
std::string sentence_of_contrasts(const Evidence& evidence, const std::vector<Named>& names);

}  // namespace hysteron

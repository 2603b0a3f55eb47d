// What the recordings show, whatever its cause: signature contrasts that speak, in words.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/judge/verdict.hpp"

namespace hysteron {

// "3 of 4 recordings": those whose own value has the sign of all; "one value of all 4 recordings".
std::string recordings_text(const Signature& row);

// Units that hold the drive's, where it is known: "N/A^2".
void name_units(Evidence& evidence, DriveKind drive);

// Of contrasts that speak for nothing in `names`, loudest first: of what the law asked for leaves, with those that are
// gone behind the law in its place, and of what shows only behind that one. Empty where none speaks.
std::string sentence_of_contrasts(const Evidence& evidence, const std::vector<Named>& names);

}  // namespace hysteron

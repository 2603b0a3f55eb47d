// Words of how recordings weigh.
#pragma once

#include <string>
#include <string_view>

#include "fit/score.hpp"

namespace hysteron {

// Throws InputError for an unknown word.
Weighting weighting_of(const std::string& word);
std::string_view word_of(Weighting weighting);

}  // namespace hysteron

// The sentences that a diagnosis opens with: a paragraph on the terminal, a list on its page.
#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnose.hpp"

namespace hysteron {

// Sentences: what is known and how sure, what has no name, what it is worth, where the rest sits, what would explain
// the strongest away; last the recording to make next.
std::vector<std::string> summary_of(const Diagnosis& diagnosis);

// Whether a tone that runs whatever the motion is all that is told beside the noise: it has no place in the motion.
bool only_a_tone(const Diagnosis& diagnosis);

}  // namespace hysteron

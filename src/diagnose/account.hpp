// What a diagnosis says of its verdict in words.
#pragma once

#include <string>
#include <vector>

#include "diagnose/diagnose.hpp"

namespace hysteron {

// "a, b and c" with " and " for `last`.
std::string joined(const std::vector<std::string>& words, const std::string& last);

// What speaks for a named effect: parameters with intervals, held-out errors, what cannot be told from it, what comes
// next.
std::string sentence_of(const Diagnosis& diagnosis, const Named& named,
                        const std::vector<ParameterInterval>& parameters);

// Effects that were tried and not named, with reasons.
std::vector<Rejected> rejected_of(const Diagnosis& diagnosis);
// A recording that would decide or confirm.
std::string experiment_after(const Diagnosis& diagnosis);
// Whether the augmented model leaves clearly more than the noise floor, fitted or held out.
bool above_noise_floor(const Diagnosis& diagnosis);
// Adds why the verdict is what it is, and what the augmented model holds without being offered as a cause.
void note_verdict(Diagnosis& diagnosis);

}  // namespace hysteron

// What a diagnosis says of its verdict in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnose/diagnose.hpp"

namespace hysteron {

// The signature contrast that speaks for an effect most, with its values recording by recording; null where none does.
const Contrast* contrast_of(const Diagnosis& diagnosis, const Named& named);

// What explains most in the place of a named effect of the effects that the recordings tell from it: neither of its set
// nor one that does as well and is less likely. Null where nothing else was tried there.
const Contender* nearest_rival(const Named& named, const Evidence& evidence);

// A recording that would tell a named effect from what is mistaken for it.
std::string experiment_for(const Diagnosis& diagnosis, const Named& named);

// "gap = 0.40 mm": the sizes of an effect, at most so many, in engineers' units.
std::string sizes_text(const std::vector<ParameterInterval>& parameters, std::size_t most);

// What speaks for a named effect: parameters with intervals, held-out errors, what cannot be told from it, what comes
// next.
std::string sentence_of(const Diagnosis& diagnosis, const Named& named,
                        const std::vector<ParameterInterval>& parameters);

// Whether held-out recordings show what takes their error from `before` to `after`: less than a fiftieth is chance.
bool held_out_shows(double before, double after);

// "predict" or, where the augmented model predicts held-out recordings hardly better than the base model, "fit": what
// shapes that are no causes do better.
std::string_view what_shapes_do(const Diagnosis& diagnosis);

// What it would take to explain a name away (robustness_value), without a full stop; `it` is what the name is called.
std::string sentence_of_robustness(const Named& named, std::string_view it);

// Effects that were tried and not named, with reasons.
std::vector<Rejected> rejected_of(const Diagnosis& diagnosis);
// A recording for the likeliest name or suggestion, without any for the likeliest shape: what would tell it from what
// does as well in its place, else from its nearest rival.
std::string experiment_to_decide(const Verdict& verdict, const Evidence& evidence, DriveKind drive);
// The next recording to make.
std::string experiment_after(const Diagnosis& diagnosis);
// Whether the augmented model leaves clearly more than the noise floor, fitted or held out.
bool above_noise_floor(const Diagnosis& diagnosis);
// Adds what is to be known beside the summary.
void note_verdict(Diagnosis& diagnosis);

}  // namespace hysteron

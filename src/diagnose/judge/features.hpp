// What a probability is computed from: a few numbers of the evidence, each of which can only speak for a name (or for
// missing physics) the larger it is.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "diagnose/judge/evidence.hpp"

namespace hysteron {

struct Feature {
  std::string_view name;
  std::string_view meaning;
};

// Of a name.
inline constexpr std::array<Feature, 9> name_features = {{
    {"agreement", "share of the motions left out in turn that are predicted better with it than without it"},
    {"no_other_law",
     "1 less the share of what all effects take off that another damper law, without it as a part of its own, takes "
     "off without any and explains its contrast too"},
    {"over_rest", "gain over itself and what stays and follows the motion, beyond chance"},
    {"inside", "1 less the share of its parameters that sit on an end of their box"},
    {"contrast",
     "standard errors of the signature contrast that speaks for it, in its sense, of what is left without it, from one "
     "(0) to four (1); 0 where 5 % of its placebos say as much, a half where none can be taken"},
    {"alone",
     "gain alone behind the base model over that in the augmented one: what only makes up for others has none"},
    {"no_relative",
     "1 less the gain of a related effect of the model over that and its own: what a form misses looks like a "
     "relative"},
    {"motions",
     "different ones that were fitted, from one (0) to four and more (1): what few show may be theirs alone"},
    {"evenness",
     "log10 of one over the share that one size leaves, to 3, of what sizes of its own in each quarter of the cycle of "
     "each recording left out would take off: what covers for something else is too large here and too small there"},
}};
using NameFeatures = std::array<double, name_features.size()>;
NameFeatures features_of(const Candidate& candidate, const Evidence& evidence);

// Of a name that stands for itself alone: these, and how many others do as well.
inline constexpr Feature of_set = {"of_set",
                                   "1 over the number of effects that do as well in its place, it among them"};
using AloneFeatures = std::array<double, name_features.size() + 1>;
AloneFeatures alone_features_of(const Candidate& candidate, const Evidence& evidence);

// Of something missing at all.
inline constexpr std::array<Feature, 6> missing_features = {{
    {"structure", "log10 of 1 + what repeats beyond the noise over the noise, base model"},
    {"predictable", "share that the motion predicts within each recording, base model"},
    {"recurring", "share that follows the motion over all recordings, over the most of the surrogates, base model"},
    {"spoken", "1 where a signature contrast of what the base model leaves speaks"},
    {"improved", "log of 1 + block score of the augmented over the base model over its standard error"},
    {"gained", "share of the squares that the augmented model takes off"},
}};
using MissingFeatures = std::array<double, missing_features.size()>;
MissingFeatures features_of(const Evidence& evidence);

// Cinelli and Hazlett, J. R. Statist. Soc. B 82 (2020) 39: unmodelled physics would have to explain this share of what
// stays and share this much of the effect's shape to explain it away; f2 is gain over what stays beyond the noise.
double robustness_value(double f2);
double robustness_of(const Candidate& candidate, const Evidence& evidence);

// What takes off this part of what something else takes off does as well: another law beside effects, or an effect
// beside a related one.
inline constexpr double does_as_well = 0.9;

// Related and unrelated effects that do as well in the candidate's place: the candidate predicts recordings left out no
// better than two standard errors, or it ends as the other, or is the limit of it that the data do not tell apart, or
// the other is related and takes off nine tenths of what it does, whatever the recordings prefer.
std::vector<const Contender*> equally_good(const Candidate& candidate);

// Whose base a candidate is weighed against: that of the law asked for, where it is a part of the law that took its
// place.
const Evidence& evidence_of_base(const Candidate& candidate, const Evidence& evidence);

// Of the candidates behind the law asked for, those that the law in its place has as parts of its own and that are not
// judged as such: what it does better may be their doing.
std::vector<std::size_t> parts_of_the_law(const Evidence& evidence);

}  // namespace hysteron

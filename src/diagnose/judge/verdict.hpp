// What the evidence allows to say, and never more.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "diagnose/judge/evidence.hpp"
#include "diagnose/judge/speaking.hpp"

namespace hysteron {

enum class Answer { complete, missing_physics, ambiguous, unattributed };
std::string_view name_of(Answer answer);

// By the probability that the name, or the set it stands for, is in the truth.
enum class Grade { established, supported, suggested, none };
inline constexpr double established_from = 0.95;  // probability
inline constexpr double supported_from = 0.80;    // probability, from which an effect is named
inline constexpr double suggested_from = 0.50;    // probability: more likely than not
Grade grade_of(double probability);
std::string_view name_of(Grade grade);

// A candidate, or one that does as well in its place.
struct Named {
  std::string id;
  Grade grade = Grade::none;  // of the set where others do as well, else of the name
  double confidence = 0.0;    // probability that the id or one of indistinguishable_from is in the truth
  double alone = 0.0;         // that the id itself is
  std::vector<std::string> indistinguishable_from;
  std::vector<std::string> less_likely;    // that do as well in its place, where it is named alone all the same
  double robustness = 0.0;                 // robustness value
  double share_of_misfit = 0.0;            // gain over what the base model leaves beyond the noise
  std::size_t candidate = 0;               // of the evidence, or of what was found behind the law asked for
  std::optional<std::string> in_place_of;  // the candidate's id, of another member of its set
  // The law that took the place of the one asked for and has the candidate as a part of its own.
  std::optional<std::string> of_law = {};
  bool behind_asked = false;  // judged by what was found behind the law asked for
  bool had_by_law = false;    // Candidate::had_by_law: no cause, whatever it takes off
};

// By this much probability a set must be surer than the one effect that was found, to be told in its place: a wrong
// name is as bad as ten sets in the place of names. What other worths would do: results/grades.md.
inline constexpr double worth_of_a_set = 0.1;

// Whether an effect is told alone: it would be listed by the probability `alone` that it is in the truth as well as by
// that of its set, which is at most `worth` surer.
bool stands_alone(double alone, double of_all, double worth);

// The evidence that a name was judged by, and the candidate there.
const Evidence& evidence_for(const Named& named, const Evidence& evidence);
const Candidate& candidate_of(const Named& named, const Evidence& evidence);
// The contrast that speaks for it, of what is left without the candidate.
std::optional<Speaking> speaking_for(const Named& named, const Evidence& evidence);

struct Verdict {
  Answer answer = Answer::complete;
  std::vector<Named> effects;      // supported or better, strongest first
  std::vector<Named> suggestions;  // at least as likely as not
  std::vector<Named> doubtful;     // in the augmented model, and neither
  double missing = 0.0;            // probability that physics is missing
  // Of the base model's misfit beyond the noise: what nothing named or suggested explains. 0 where nothing but noise is
  // left, 1 where more is and nothing is named or suggested.
  double unknown_share = 0.0;
  bool remaining_structure = false;
  std::string reason;  // why nothing, or not more, was named; may be empty
};

Verdict verdict_of(const Evidence& evidence);

// Another damper law that does as well without effects as the law asked for with them; empty where none does.
std::string better_law(const Evidence& evidence);

}  // namespace hysteron

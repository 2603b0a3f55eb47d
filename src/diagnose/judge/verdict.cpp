#include "diagnose/judge/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "core/probability_text.hpp"
#include "diagnose/judge/features.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/judge/table.hpp"

namespace hysteron {
namespace {

// What stays beyond the noise shows structure where it is this part of the noise, an estimate of the noise being no
// better.
constexpr double structure_over_noise = 0.3;

bool structure_remains(const Left& left) {
  return left.structure > structure_over_noise * std::max(left.squares - left.structure, 1e-300);
}

// Told by the channels alone: a contrast that needs no model speaks for it.
bool is_told_by_channels(const Candidate& candidate) {
  const std::optional<Speaking> speaking = speaking_for(candidate);
  return candidate.as_channels && speaking && speaks(*speaking);
}

// The candidate with its probabilities, and the others of its set in order of their share; alone where it is listed
// alike by itself and hardly less sure.
std::vector<Named> named(std::size_t index, const Evidence& evidence) {
  const Candidate& candidate = evidence.candidates[index];
  Named first;
  first.id = candidate.id;
  first.candidate = index;
  first.share_of_misfit =
      std::clamp(candidate.gain / std::max(evidence_of_base(candidate, evidence).base.excess(), 1e-300), 0.0, 1.0);
  first.had_by_law = candidate.had_by_law;
  if (first.had_by_law) {
    return {first};
  }
  std::vector<const Contender*> others = equally_good(candidate);
  first.alone = alone_table().probability(alone_features_of(candidate, evidence), candidate.id);
  if (is_told_by_channels(candidate)) {
    first.alone = std::max(first.alone, channel_probability());
  }
  const double of_all = std::max(first.alone, name_table().probability(features_of(candidate, evidence), candidate.id));
  // The channels tell a lag of one of them from a delay of the force.
  if (candidate.as_channels) {
    others.clear();
  }
  if (stands_alone(first.alone, of_all, worth_of_a_set)) {
    for (const Contender* other : others) {
      first.less_likely.push_back(other->id);
    }
    others.clear();
  }
  first.confidence = others.empty() ? first.alone : of_all;
  first.grade = grade_of(first.confidence);
  first.robustness = robustness_of(candidate, evidence);
  if (candidate.of_law) {
    first.of_law = evidence.model;
  }
  for (const Contender* other : others) {
    first.indistinguishable_from.push_back(other->id);
  }
  std::vector<Named> result = {first};
  for (const Contender* other : others) {
    Named row = first;
    row.id = other->id;
    row.in_place_of = candidate.id;
    row.alone = (first.confidence - first.alone) / static_cast<double>(others.size());
    row.share_of_misfit = first.share_of_misfit * std::clamp(other->share, 0.0, 1.0);
    std::erase(row.indistinguishable_from, row.id);
    row.indistinguishable_from.insert(row.indistinguishable_from.begin(), candidate.id);
    result.push_back(std::move(row));
  }
  return result;
}

// One effect may be a member of two sets: it is listed once, where it is surer.
void append(std::vector<Named>& list, const std::vector<Named>& rows, const std::vector<Named>& surer) {
  const auto listed = [](const std::vector<Named>& in, const Named& row) {
    return std::ranges::find(in, row.id, &Named::id) != in.end();
  };
  for (const Named& row : rows) {
    if (!listed(list, row) && !listed(surer, row)) {
      list.push_back(row);
    }
  }
}

// Of the base model's misfit beyond the noise: what stays, and of what the augmented model takes off the part of
// effects that are neither named nor suggested. Effects may explain the same, so that their own shares part it in
// proportion; but what is named explains no more than it does alone or in the augmented model, the larger of both: the
// rest is due to richer laws, which have no name.
double unknown_share(const Verdict& verdict, const Evidence& evidence) {
  if (verdict.answer == Answer::complete) {
    return 0.0;
  }
  double known = 0.0;
  double most = 0.0;
  double doubted = 0.0;
  for (const std::vector<Named>* list : {&verdict.effects, &verdict.suggestions}) {
    for (const Named& row : *list) {
      if (!row.in_place_of && !row.of_law) {
        known += row.share_of_misfit;
        most += std::max(row.share_of_misfit,
                         evidence.candidates[row.candidate].gain_alone / std::max(evidence.base.excess(), 1e-300));
      }
    }
  }
  for (const Named& row : verdict.doubtful) {
    doubted += row.of_law ? 0.0 : row.share_of_misfit;
  }
  if (known <= 0.0) {
    return 1.0;
  }
  const double stays = evidence.augmented.excess() / std::max(evidence.base.excess(), 1e-300);
  const double taken = std::max(1.0 - stays, 0.0);
  return std::clamp(1.0 - std::min(taken * known / (known + doubted), most), 0.0, 1.0);
}

}  // namespace

bool stands_alone(double alone, double of_all, double worth) {
  const bool listed_alike = (alone >= supported_from) == (of_all >= supported_from) && alone >= suggested_from;
  return listed_alike && of_all - alone <= worth;
}

const Evidence& evidence_for(const Named& named, const Evidence& evidence) {
  return named.behind_asked ? evidence.behind_asked.front() : evidence;
}

const Candidate& candidate_of(const Named& named, const Evidence& evidence) {
  return evidence_for(named, evidence).candidates[named.candidate];
}

std::optional<Speaking> speaking_for(const Named& named, const Evidence& evidence) {
  return speaking_for(named.id, candidate_of(named, evidence).signatures);
}

std::string_view name_of(Answer answer) {
  switch (answer) {
    case Answer::missing_physics:
      return "missing-physics";
    case Answer::ambiguous:
      return "ambiguous";
    case Answer::unattributed:
      return "unattributed";
    case Answer::complete:
      break;
  }
  return "complete";
}

Grade grade_of(double probability) {
  return probability >= established_from ? Grade::established
         : probability >= supported_from ? Grade::supported
         : probability >= suggested_from ? Grade::suggested
                                         : Grade::none;
}

std::string_view name_of(Grade grade) {
  switch (grade) {
    case Grade::established:
      return "established";
    case Grade::supported:
      return "supported";
    case Grade::suggested:
      return "suggested";
    case Grade::none:
      break;
  }
  return "none";
}

std::string better_law(const Evidence& evidence) {
  const double all = evidence.base_compared - evidence.augmented_compared;
  const double asked = evidence.candidates.empty() ? evidence.base_compared - evidence.base.floor : all;
  // Nothing is missing in a law that leaves the noise, and no other law describes it better.
  if (evidence.base_compared <= evidence.base.floor) {
    return {};
  }
  const OtherLaw* best = nullptr;
  for (const OtherLaw& law : evidence.other_laws) {
    if (!law.has_what_was_found && evidence.base_compared - law.squares > does_as_well * asked &&
        (best == nullptr || law.squares < best->squares)) {
      best = &law;
    }
  }
  return best == nullptr ? std::string{} : best->model;
}

namespace {

// Why no effect of the augmented model is named: how likely the likeliest is.
std::string likeliest(const Verdict& verdict) {
  const Named* best = nullptr;
  for (const std::vector<Named>* list : {&verdict.suggestions, &verdict.doubtful}) {
    for (const Named& named : *list) {
      if (best == nullptr || named.confidence > best->confidence) {
        best = &named;
      }
    }
  }
  return best == nullptr ? "no effect of the augmented model is likely"
                         : "the likeliest, " + best->id +
                               (best->indistinguishable_from.empty() ? "" : " or another that does as well") +
                               ", is there with " + probability_text(best->confidence) + ", and a name is given from " +
                               probability_text(supported_from);
}

// All but the share that has no name.
Verdict answer_of(const Evidence& evidence) {
  Verdict verdict;
  verdict.remaining_structure = structure_remains(evidence.augmented);
  verdict.missing = missing_table().probability(features_of(evidence));
  bool alone = false;
  std::vector<std::vector<Named>> suggested;
  std::vector<std::vector<Named>> found;
  for (const std::size_t k : parts_of_the_law(evidence)) {
    std::vector<Named> rows = named(k, evidence.behind_asked.front());
    for (Named& row : rows) {
      row.of_law = evidence.model;
      row.behind_asked = true;
    }
    // Else it is no shape of the augmented model either: the law has it.
    if (rows.front().grade != Grade::none && evidence.doubt_of_data.empty()) {
      found.push_back(std::move(rows));
    }
  }
  for (std::size_t k = 0; k < evidence.candidates.size(); ++k) {
    found.push_back(named(k, evidence));
  }
  for (const std::vector<Named>& rows : found) {
    const Grade grade = rows.front().grade;
    if (grade == Grade::none || !evidence.doubt_of_data.empty()) {
      verdict.doubtful.push_back(rows.front());
      continue;
    }
    if (grade == Grade::suggested) {
      suggested.push_back(rows);
      continue;
    }
    append(verdict.effects, rows, {});
    alone = alone || rows.size() == 1;
  }
  for (const std::vector<Named>& rows : suggested) {
    append(verdict.suggestions, rows, verdict.effects);
  }
  if (!evidence.doubt_of_data.empty()) {
    verdict.answer = Answer::unattributed;
    verdict.reason = evidence.doubt_of_data;
    return verdict;
  }
  if (!verdict.effects.empty()) {
    verdict.answer = alone ? Answer::missing_physics : Answer::ambiguous;
    return verdict;
  }
  if (!evidence.doubt_of_completeness.empty()) {
    verdict.answer = Answer::unattributed;
    verdict.reason =
        evidence.doubt_of_completeness +
        (verdict.suggestions.empty() && evidence.candidates.empty() ? "; no effect that was tried explains it" : "");
    return verdict;
  }
  if (!evidence.asked_for.empty()) {
    verdict.answer = Answer::unattributed;
    verdict.reason = evidence.model + " describes what " + evidence.asked_for + " misses";
    return verdict;
  }
  // Where an effect is more likely there than not, so is something.
  verdict.answer =
      verdict.missing >= suggested_from || !verdict.suggestions.empty() ? Answer::unattributed : Answer::complete;
  if (verdict.answer == Answer::unattributed) {
    verdict.reason = evidence.candidates.empty() ? "no effect that was tried explains the misfit" : likeliest(verdict);
  }
  return verdict;
}

}  // namespace

Verdict verdict_of(const Evidence& evidence) {
  Verdict verdict = answer_of(evidence);
  verdict.unknown_share = unknown_share(verdict, evidence);
  return verdict;
}

}  // namespace hysteron

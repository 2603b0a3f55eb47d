#include "diagnose/judge/evidence.hpp"

#include <nlohmann/json.hpp>

namespace hysteron {

// Each field stands in the record by its own name, and nowhere else in the code.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Left, squares, floor, white, structure, predictable, unevenness,
                                   unevenness_by_chance, recurring, recurring_by_chance, recurring_at_most, independent)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Comparison, mean, std_error, agreement, clusters)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SizeOfPart, recording, quarter, size, weight)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Contender, id, law, kin, share, refitted, squares, behind, evenness,
                                   holds_the_candidate, held_by_the_candidate, apart, ended_as, follows_drive,
                                   as_channels)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Signature, id, what, unit, value, std_error, z, consistency, placebo_quantile,
                                   recordings, speaks_for, sign, of_all)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GainBehindLaw, law, share)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Candidate, id, gain, score, sizes, gain_alone, gain_of_relative, contenders,
                                   behind_laws, parameters, on_bound, as_channels, of_law, had_by_law, signatures)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OtherLaw, model, squares, has_what_was_found, has)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ContrastLeft, effect, signature, instead, law, z)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FirstLook, id, gain, refitted)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Evidence, model, asked_for, recordings, motions, base, augmented, first_stage,
                                   candidates, base_compared, augmented_compared, augmented_over_base, other_laws,
                                   signatures, signatures_left, contrasts_left, behind_asked, doubt_of_completeness,
                                   doubt_of_data)

bool Comparison::surely_better() const {
  // Quantile of Student's distribution for that of the normal at two, in powers of one over the degrees of freedom
  // (Fisher and Cornish 1960).
  const double few = clusters > 1 ? 1.0 / static_cast<double>(clusters - 1) : 1.0;
  return z() > 2.0 + few * (2.5 + few * (3.0625 + few * 2.859375));
}

nlohmann::json evidence_json(const Evidence& evidence) { return evidence; }

namespace {

void complete_signatures(nlohmann::json& signatures) {
  for (nlohmann::json& row : signatures) {
    row.emplace("of_all", false);
  }
}

// Records of earlier programs hold none of these.
void complete(nlohmann::json& evidence) {
  complete_signatures(evidence.at("signatures"));
  evidence.emplace("signatures_left", evidence.at("signatures"));
  evidence.emplace("motions", evidence.at("recordings"));
  evidence.emplace("contrasts_left", nlohmann::json::array());
  evidence.emplace("behind_asked", nlohmann::json::array());
  for (nlohmann::json& candidate : evidence.at("candidates")) {
    candidate.emplace("signatures", evidence.at("signatures"));
    complete_signatures(candidate.at("signatures"));
    for (nlohmann::json& contender : candidate.at("contenders")) {
      contender.emplace("evenness", 0.0);
    }
    candidate.emplace("sizes", nlohmann::json::array());
    candidate.emplace("of_law", false);
    candidate.emplace("had_by_law", false);
    candidate.emplace("behind_laws", nlohmann::json::array());
  }
  for (nlohmann::json& row : evidence.at("contrasts_left")) {
    row.emplace("signature", "");
  }
  for (nlohmann::json& behind : evidence.at("behind_asked")) {
    complete(behind);
  }
}

}  // namespace

Evidence evidence_from(const nlohmann::json& json) {
  nlohmann::json whole = json;
  complete(whole);
  return whole.get<Evidence>();
}

}  // namespace hysteron

#include "diagnose/record.hpp"

#include "diagnose/judge/evidence.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

json drift_json(const Diagnosis& diagnosis) {
  json conditions = json::array();
  for (std::size_t k = 0; k < diagnosis.drift_of_base.recordings.size(); ++k) {
    json row = {{"recording", diagnosis.drift_of_base.recordings[k]}};
    for (std::size_t v = 0; v < drift_variables.size(); ++v) {
      row[drift_variables[v]] = diagnosis.drift_of_base.conditions[k][v];
    }
    conditions.push_back(std::move(row));
  }
  const auto parameters = [](const Drift& drift) {
    json rows = json::array();
    for (const DriftOfParameter& parameter : drift.parameters) {
      rows.push_back({{"name", parameter.name},
                      {"relative_change", parameter.change},
                      {"std_error", parameter.std_error},
                      {"follows", parameter.follows.empty() ? json(nullptr) : json(parameter.follows)},
                      {"rank_correlation", parameter.rank_correlation}});
    }
    return rows;
  };
  return {{"recordings", conditions},
          {"base", parameters(diagnosis.drift_of_base)},
          {"augmented", parameters(diagnosis.drift_of_augmented)}};
}

}  // namespace

namespace {

json named_json(const Diagnosis& diagnosis, const Named& named, std::size_t index) {
  json parameters = json::array();
  for (const ParameterInterval& p : diagnosis.parameters[index]) {
    parameters.push_back(
        {{"name", p.name},
         {"value", p.value},
         {"unit", p.unit},
         {"ci95", p.half_width ? json{p.value - *p.half_width, p.value + *p.half_width} : json(nullptr)}});
  }
  return {{"id", named.id},
          {"grade", name_of(named.grade)},
          {"confidence", named.confidence},
          {"confidence_alone", named.alone},
          {"indistinguishable_from", named.indistinguishable_from},
          {"sentence", diagnosis.sentences[index]},
          {"robustness_value", named.robustness},
          {"parameters", parameters},
          {"nrmse_heldout_before", without_of(diagnosis.search, named).heldout},
          {"nrmse_heldout_after", fit_of(diagnosis.search, named).heldout},
          {"share_of_misfit", named.share_of_misfit}};
}

}  // namespace

json diagnosis_json(const Diagnosis& diagnosis) {
  const Search& search = diagnosis.search;
  json effects = json::array();
  json suggestions = json::array();
  const std::vector<Named> names = listed(diagnosis.verdict);
  for (std::size_t k = 0; k < names.size(); ++k) {
    (k < diagnosis.verdict.effects.size() ? effects : suggestions).push_back(named_json(diagnosis, names[k], k));
  }
  json locations = json::array();
  for (const Location& location : diagnosis.locations) {
    locations.push_back({{"where", location.where},
                         {"variable", location.variable},
                         {"from", location.from},
                         {"to", location.to},
                         {"unit", location.unit},
                         {"share_of_misfit", location.share_of_misfit},
                         {"share_of_samples", location.share_of_samples},
                         {"recordings", location.recordings}});
  }
  json rejected = json::array();
  for (const Rejected& row : diagnosis.rejected) {
    rejected.push_back({{"id", row.id}, {"reason", row.reason}});
  }
  json hidden = json::array();
  for (const Unobservable& row : diagnosis.not_observable) {
    if (row.reason.empty()) {
      hidden.push_back({{"id", row.id}, {"detection_limit", row.detection_limit}});
    } else {
      hidden.push_back({{"id", row.id}, {"reason", row.reason}});
    }
  }
  return {{"schema", "hysteron.diagnosis/2"},
          {"baseline",
           {{"model", search.base.what.model},
            {"nrmse_fit", search.base.cost},
            {"nrmse_heldout", search.base.heldout},
            {"noise_floor_nrmse", diagnosis.noise_floor},
            {"noise_floor_heldout_nrmse", diagnosis.noise_floor_heldout},
            {"noise_floor_method", word_of(diagnosis.noise_floor_method)}}},
          {"verdict", name_of(diagnosis.verdict.answer)},
          {"effects", effects},
          {"suggestions", suggestions},
          {"unknown_share", diagnosis.verdict.unknown_share},
          {"locations", locations},
          {"rejected", rejected},
          {"not_observable", hidden},
          {"alias_map", {{"effects", diagnosis.alias.effects}, {"cosine", diagnosis.alias.cosine}}},
          {"augmented",
           {{"model", search.augmented.what.model},
            {"effects", search.augmented.what.effects},
            {"richer_laws", search.augmented.what.richer},
            {"nrmse_fit", search.augmented.cost},
            {"nrmse_heldout", search.augmented.heldout},
            {"remaining_structure", diagnosis.verdict.remaining_structure}}},
          {"evidence", evidence_json(diagnosis.evidence)},
          {"drift", drift_json(diagnosis)},
          {"next_experiment", diagnosis.next_experiment},
          {"notes", diagnosis.notes}};
}

}  // namespace hysteron

#include "diagnose/record.hpp"

#include <algorithm>

#include "diagnose/account.hpp"
#include "diagnose/judge/evidence.hpp"
#include "diagnose/judge/speaking.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"

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

json parameters_json(const std::vector<ParameterInterval>& parameters) {
  json rows = json::array();
  for (const ParameterInterval& p : parameters) {
    rows.push_back({{"name", p.name},
                    {"value", p.value},
                    {"unit", p.unit},
                    {"ci95", p.ci95 ? json{p.ci95->lower, p.ci95->upper} : json(nullptr)}});
  }
  return rows;
}

json family_json(const std::string& effect) {
  const std::string_view family = knowledge_of(effect).family.id;
  return family.empty() ? json(nullptr) : json(family);
}

// Null where none can be taken from these recordings.
json contrast_json(const Diagnosis& diagnosis, const Named& named) {
  const std::optional<Speaking> speaking = speaking_for(named, diagnosis.evidence);
  if (!speaking) {
    return nullptr;
  }
  const Signature& row = *speaking->signature;
  json result = {{"id", row.id},
                 {"what", row.what},
                 {"value", row.value},
                 {"std_error", row.std_error},
                 {"unit", row.unit},
                 {"z", row.z},
                 {"z_for", speaking->z},
                 {"placebo_quantile", row.placebo_quantile},
                 {"shown", shows(*speaking)},
                 {"consistency", row.consistency},
                 {"recordings", row.recordings},
                 {"of_all", row.of_all},
                 {"of_recordings", json::array()}};
  if (const Contrast* contrast = contrast_of(diagnosis, named)) {
    for (const ContrastOfRecording& one : contrast->of_recordings) {
      result["of_recordings"].push_back(
          {{"file", diagnosis.bench.split().fit[one.recording].file}, {"value", one.value}});
    }
  }
  return result;
}

json rival_json(const Diagnosis& diagnosis, const Named& named) {
  const Contender* rival = named.in_place_of ? nullptr : nearest_rival(named, diagnosis.evidence);
  return rival == nullptr ? json(nullptr)
                          : json{{"id", rival->id},
                                 {"share_of_gain", std::clamp(rival->share, 0.0, 1.0)},
                                 {"refitted", rival->refitted}};
}

json laws_json(const Diagnosis& diagnosis, const Named& named) {
  json rows = json::array();
  if (!named.in_place_of) {
    for (const GainBehindLaw& row : candidate_of(named, diagnosis.evidence).behind_laws) {
      rows.push_back({{"model", row.law}, {"share_of_gain", std::clamp(row.share, 0.0, 1.0)}});
    }
  }
  return rows;
}

json view_json(const Diagnosis& diagnosis, const std::optional<ContrastView>& view) {
  return view ? json{{"recording", diagnosis.bench.split().fit[view->recording].file},
                     {"from", view->from},
                     {"to", view->to},
                     {"over", word_of(view->over)}}
              : json(nullptr);
}

json rig_cause_json(const Diagnosis& diagnosis, const Named& named) {
  const std::string cause = worded(knowledge_of(named.id).rig_cause, diagnosis.drive);
  return cause.empty() ? json(nullptr) : json(cause);
}

json named_json(const Diagnosis& diagnosis, const Named& named, std::size_t index) {
  return {{"id", named.id},
          {"title", title_of(named.id)},
          {"family", family_json(named.id)},
          {"grade", name_of(named.grade)},
          {"confidence", named.confidence},
          {"confidence_alone", named.alone},
          {"indistinguishable_from", named.indistinguishable_from},
          {"less_likely", named.less_likely},
          {"in_place_of", named.in_place_of ? json(*named.in_place_of) : json(nullptr)},
          {"of_law", named.of_law ? json(*named.of_law) : json(nullptr)},
          {"sentence", diagnosis.sentences[index]},
          {"contrast", contrast_json(diagnosis, named)},
          {"view", view_json(diagnosis, diagnosis.views[index])},
          {"robustness_value", named.robustness},
          {"nearest_rival", rival_json(diagnosis, named)},
          {"experiment", experiment_for(diagnosis, named)},
          {"rig_cause", rig_cause_json(diagnosis, named)},
          {"behind_other_laws", laws_json(diagnosis, named)},
          {"parameters", parameters_json(diagnosis.parameters[index])},
          {"nrmse_heldout_before", without_of(diagnosis, named).heldout},
          {"nrmse_heldout_after", has_fit(diagnosis, named) ? json(fit_of(diagnosis, named).heldout) : json(nullptr)},
          {"share_of_misfit", named.share_of_misfit}};
}

json locations_json(const std::vector<Location>& locations) {
  json rows = json::array();
  for (const Location& location : locations) {
    rows.push_back({{"where", location.where},
                    {"variable", location.variable},
                    {"from", location.from},
                    {"to", location.to},
                    {"unit", location.unit},
                    {"share_of_misfit", location.share_of_misfit},
                    {"share_of_samples", location.share_of_samples},
                    {"recordings", location.recordings}});
  }
  return rows;
}

// What the augmented model holds without a name.
json shapes_json(const Diagnosis& diagnosis) {
  json rows = json::array();
  for (std::size_t k = 0; k < diagnosis.verdict.doubtful.size(); ++k) {
    const Named& shape = diagnosis.verdict.doubtful[k];
    rows.push_back({{"id", shape.id},
                    {"title", title_of(shape.id)},
                    {"family", family_json(shape.id)},
                    {"confidence", shape.confidence},
                    {"contrast", contrast_json(diagnosis, shape)},
                    {"parameters", parameters_json(diagnosis.shapes[k])}});
  }
  return rows;
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
          {"summary", diagnosis.summary},
          {"effects", effects},
          {"suggestions", suggestions},
          {"unknown_share", diagnosis.verdict.unknown_share},
          {"locations", locations_json(diagnosis.locations)},
          {"rejected", rejected},
          {"not_observable", hidden},
          {"alias_map", {{"effects", diagnosis.alias.effects}, {"cosine", diagnosis.alias.cosine}}},
          {"augmented",
           {{"model", search.augmented.what.model},
            {"effects", search.augmented.what.effects},
            {"richer_laws", search.augmented.what.richer},
            {"nrmse_fit", search.augmented.cost},
            {"nrmse_heldout", search.augmented.heldout},
            {"remaining_structure", diagnosis.verdict.remaining_structure},
            {"shapes", shapes_json(diagnosis)},
            {"locations", locations_json(diagnosis.locations_left)}}},
          {"evidence", evidence_json(diagnosis.evidence)},
          {"drift", drift_json(diagnosis)},
          {"groups", mixed(diagnosis.belonging) ? groups_json(*diagnosis.belonging) : json(nullptr)},
          {"followed_column", diagnosis.column ? column_json(*diagnosis.column) : json(nullptr)},
          {"next_experiment", diagnosis.next_experiment},
          {"notes", diagnosis.notes}};
}

}  // namespace hysteron

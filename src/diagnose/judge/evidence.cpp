#include "diagnose/judge/evidence.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

json misfit_json(const Misfit& misfit) {
  return {{"squares", misfit.squares},
          {"structure", misfit.structure},
          {"white", misfit.white},
          {"floor", misfit.floor},
          {"floor_of_motion", misfit.motion},
          {"predictable", misfit.predictable},
          {"unevenness", misfit.evenness.deviation},
          {"unevenness_by_chance", misfit.evenness.by_chance},
          {"independent_samples", misfit.independent}};
}

Misfit misfit_from(const json& row) {
  Misfit misfit;
  misfit.squares = row.at("squares");
  misfit.structure = row.at("structure");
  misfit.noise = misfit.squares - misfit.structure;
  misfit.white = row.at("white");
  misfit.floor = row.at("floor");
  misfit.motion = row.at("floor_of_motion");
  misfit.predictable = row.at("predictable");
  misfit.evenness = {row.at("unevenness"), row.at("unevenness_by_chance")};
  misfit.independent = row.at("independent_samples");
  return misfit;
}

json contender_json(const Contender& row) {
  return {{"id", row.id},
          {"share_of_gain", row.share},
          {"evidence", row.evidence},
          {"nrmse_heldout", row.heldout},
          {"apart", row.apart},
          {"ended_as", row.ended_as},
          {"as_channels_show", row.as_channels},
          {"follows_drive", row.follows_drive}};
}

Contender contender_from(const json& row) {
  return {row.at("id"),    row.at("share_of_gain"), row.at("evidence"),         row.at("nrmse_heldout"),
          row.at("apart"), row.at("ended_as"),      row.at("as_channels_show"), row.at("follows_drive")};
}

json locality_json(const std::optional<Locality>& locality) {
  if (!locality) {
    return nullptr;
  }
  return {{"share_of_samples", locality->share},
          {"squares_without", locality->before},
          {"squares", locality->after},
          {"floor", locality->noise}};
}

json finding_json(const Finding& one) {
  json rivals = json::array();
  for (const Contender& row : one.contenders) {
    rivals.push_back(contender_json(row));
  }
  return {{"id", one.id},
          {"gain", one.gain},
          {"evidence", one.evidence},
          {"nrmse_fit_without", one.without.fit},
          {"nrmse_heldout_without", one.without.heldout},
          {"share_of_misfit", one.share_of_misfit},
          {"as_channels_show", one.as_channels},
          {"where_it_acts", locality_json(one.locality)},
          {"rivals", rivals}};
}

Finding finding_from(const json& row) {
  Finding one;
  one.id = row.at("id");
  one.gain = row.at("gain");
  one.evidence = row.at("evidence");
  one.without = {row.at("nrmse_fit_without"), row.at("nrmse_heldout_without")};
  one.share_of_misfit = row.at("share_of_misfit");
  one.as_channels = row.at("as_channels_show");
  if (const json where = row.value("where_it_acts", json()); where.is_object()) {
    one.locality = {where.at("share_of_samples"), where.at("squares_without"), where.at("squares"), where.at("floor")};
  }
  for (const json& rival : row.at("rivals")) {
    one.contenders.push_back(contender_from(rival));
  }
  return one;
}

}  // namespace

json findings_json(const Findings& findings) {
  json found = json::array();
  for (const Finding& one : findings.found) {
    found.push_back(finding_json(one));
  }
  json laws = json::array();
  for (const OtherLaw& law : findings.other_laws) {
    laws.push_back({{"model", law.model}, {"squares", law.squares}, {"has_found", law.has_found}});
  }
  json trials = json::array();
  for (const Trial& trial : findings.trials) {
    trials.push_back(
        {{"id", findings.tried}, {"under", trial.under}, {"share_of_gain", trial.share}, {"evidence", trial.evidence}});
  }
  return {{"model", findings.model},
          {"nrmse", {findings.base.fit, findings.base.heldout}},
          {"nrmse_augmented", {findings.augmented.fit, findings.augmented.heldout}},
          {"base", misfit_json(findings.base_misfit)},
          {"augmented", misfit_json(findings.misfit)},
          {"recurrence",
           {{"share", findings.recurrence.share},
            {"mean_by_chance", findings.recurrence.mean_by_chance},
            {"most_by_chance", findings.recurrence.most_by_chance}}},
          {"squares_compared", {findings.quick_base, findings.quick_augmented}},
          {"richer_laws", findings.richer},
          {"found", found},
          {"further", findings.further ? json(*findings.further) : json(nullptr)},
          {"other_laws", laws},
          {"trials", trials},
          {"doubt_of_completeness", findings.doubt_of_completeness},
          {"doubt_of_data", findings.doubt_of_data}};
}

Findings findings_from(const json& row) {
  Findings result;
  result.model = row.at("model");
  result.base = {row.at("nrmse").at(0), row.at("nrmse").at(1)};
  result.augmented = {row.at("nrmse_augmented").at(0), row.at("nrmse_augmented").at(1)};
  result.base_misfit = misfit_from(row.at("base"));
  result.misfit = misfit_from(row.at("augmented"));
  const json& recurrence = row.at("recurrence");
  result.recurrence = {recurrence.at("share"), recurrence.at("mean_by_chance"), recurrence.at("most_by_chance")};
  result.quick_base = row.at("squares_compared").at(0);
  result.quick_augmented = row.at("squares_compared").at(1);
  result.richer = row.at("richer_laws");
  for (const json& one : row.at("found")) {
    result.found.push_back(finding_from(one));
  }
  if (row.at("further").is_number()) {
    result.further = row.at("further").get<double>();
  }
  for (const json& law : row.at("other_laws")) {
    result.other_laws.push_back({law.at("model"), law.at("squares"), law.at("has_found")});
  }
  for (const json& trial : row.at("trials")) {
    result.tried = trial.at("id");
    result.trials.push_back({trial.at("under"), trial.at("share_of_gain"), trial.at("evidence")});
  }
  result.doubt_of_completeness = row.at("doubt_of_completeness");
  result.doubt_of_data = row.at("doubt_of_data");
  return result;
}

}  // namespace hysteron

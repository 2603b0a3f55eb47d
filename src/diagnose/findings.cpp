#include "diagnose/findings.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/relatives.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

// A fitted lag of the velocity channel and the one between the channels agree within this share, or within the interval
// of the one or the other.
constexpr double channel_agreement = 0.25;
// What was found with less than this part of the strongest effect's gain could not be named beside it.
constexpr double negligible_gain = 0.05;

// Whether the lag of the velocity channel that a fit found is the one that the channels show.
bool as_channels_show(const Fit& fit, const Circumstances& known) {
  const std::vector<ParameterInterval> intervals = known.intervals(fit, channel_lag);
  if (!known.channel || intervals.empty()) {
    return false;
  }
  const double error = std::fabs(intervals.front().value - known.channel->lag);
  return error < std::max({channel_agreement * std::fabs(known.channel->lag), 3.0 * known.channel->std_error,
                           intervals.front().half_width.value_or(0.0)});
}

// Whether the parameter by which a wider form differs from its limit is surely not at the limit.
bool stands_apart(const Fit& fit, const std::string& wider, const std::string& parameter, const Circumstances& known) {
  if (parameter.empty()) {
    return true;
  }
  const std::vector<ParameterInterval> intervals = known.intervals(fit, wider);
  const auto at = std::ranges::find(intervals, parameter, &ParameterInterval::name);
  return at != intervals.end() && at->half_width && std::fabs(at->value) > *at->half_width;
}

// Whether the effect ends as the other one: the parameter that tells them apart has no interval, or one that reaches
// the end of its box where they are the same.
bool ends_as(const Fit& fit, const std::string& effect, const std::string& other, const Circumstances& known) {
  const std::string parameter = bound_parameter(effect, other);
  if (parameter.empty()) {
    return false;
  }
  const std::vector<ParameterInterval> intervals = known.intervals(fit, effect);
  const auto at = std::ranges::find(intervals, parameter, &ParameterInterval::name);
  return at != intervals.end() && (!at->half_width || at->value - *at->half_width <= at->lower);
}

// A parameter that follows the drive in the base model.
bool follows_drive(const Fit& base, const std::string& parameter) {
  return base.layout != nullptr && std::ranges::any_of(base.layout->laws(), [&](const ParameterLaw& law) {
           return base.layout->names()[law.parameter] == parameter && law.drive_nodes.size() > 1;
         });
}

Contender contender_of(const Rival& rival, const Found& found, const Search& search, const Circumstances& known) {
  Contender row;
  row.id = rival.id;
  row.share = rival.share;
  row.evidence = rival.evidence;
  row.heldout = rival.fit.heldout;
  if (is_limit(found.id, rival.id)) {
    row.apart = stands_apart(rival.fit, rival.id, limit_parameter(found.id, rival.id), known);
  } else if (is_limit(rival.id, found.id)) {
    row.apart = stands_apart(search.augmented, found.id, limit_parameter(rival.id, found.id), known);
  }
  row.ended_as = ends_as(search.augmented, found.id, rival.id, known);
  row.as_channels = rival.id == channel_lag && as_channels_show(rival.fit, known);
  row.follows_drive = is_law(rival.id) && follows_drive(search.base, rival.id.substr(4));
  return row;
}

json misfit_json(const Misfit& misfit) {
  return {{"squares", misfit.squares},
          {"structure", misfit.structure},
          {"white", misfit.white},
          {"floor", misfit.floor},
          {"floor_of_motion", misfit.motion},
          {"predictable", misfit.predictable},
          {"unevenness", misfit.evenness.deviation},
          {"unevenness_by_chance", misfit.evenness.by_chance},
          {"correlation", misfit.correlation},
          {"effective_samples", misfit.effective},
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
  misfit.correlation = row.at("correlation");
  misfit.effective = row.at("effective_samples");
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
  for (const json& rival : row.at("rivals")) {
    one.contenders.push_back(contender_from(rival));
  }
  return one;
}

}  // namespace

Findings findings_of(const Search& search, const Circumstances& known) {
  Findings result;
  result.model = search.base.what.model;
  result.base = {search.base.cost, search.base.heldout};
  result.augmented = {search.augmented.cost, search.augmented.heldout};
  result.base_misfit = search.base_misfit;
  result.misfit = search.misfit;
  result.quick_base = squared(search.quick_base.cost);
  result.quick_augmented = squared(search.quick_augmented.cost);
  result.richer = !search.richer.empty();
  for (const Found& found : search.found) {
    Finding one;
    one.id = found.id;
    one.gain = found.gain;
    one.evidence = found.evidence;
    one.without = {found.without.cost, found.without.heldout};
    one.share_of_misfit = found.share_of_misfit;
    one.as_channels = found.id == channel_lag && as_channels_show(search.augmented, known);
    for (const Rival& rival : found.rivals) {
      one.contenders.push_back(contender_of(rival, found, search, known));
    }
    result.found.push_back(std::move(one));
  }
  result.further = search.further;
  for (const Fit& law : search.other_laws) {
    const bool has_found = !search.found.empty() && std::ranges::all_of(search.found, [&](const Found& found) {
      return found.gain < negligible_gain * search.found.front().gain ||
             (is_part_of(found.id, law.what.model) && !is_part_of(found.id, result.model));
    });
    result.other_laws.push_back({law.what.model, squared(law.cost), has_found});
  }
  result.tried = search.tried;
  result.trials = search.trials;
  return result;
}

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

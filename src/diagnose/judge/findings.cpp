#include "diagnose/judge/findings.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/relatives.hpp"

namespace hysteron {

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

// Whether the effect ends as the other one: the parameter that tells them apart sits on the end of its box where they
// are the same, or, at the lower end, has no interval or one that reaches it.
bool ends_as(const Fit& fit, const std::string& effect, const std::string& other, const Circumstances& known) {
  const BoxLimit* limit = box_limit(effect, other);
  if (limit == nullptr) {
    return false;
  }
  const std::vector<ParameterInterval> intervals = known.intervals(fit, effect);
  const auto at = std::ranges::find(intervals, limit->parameter, &ParameterInterval::name);
  if (at == intervals.end()) {
    return false;
  }
  return limit->end == BoxEnd::upper ? at->bound == "upper"
                                     : !at->half_width || at->value - *at->half_width <= at->lower;
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
  row.follows_drive = is_law(rival.id) && follows_drive(search.base, parameter_of_law(rival.id));
  return row;
}

}  // namespace

Findings findings_of(const Search& search, const Circumstances& known) {
  Findings result;
  result.model = search.base.what.model;
  result.base = {search.base.cost, search.base.heldout};
  result.augmented = {search.augmented.cost, search.augmented.heldout};
  result.base_misfit = search.base_misfit;
  result.misfit = search.misfit;
  result.recurrence = search.recurrence;
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
    one.locality = found.locality;
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

}  // namespace hysteron

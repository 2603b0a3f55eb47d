// model.json of an identified model.
#include <algorithm>

#include "fit/layout.hpp"
#include "io/conditions.hpp"
#include "io/value_hash.hpp"
#include "task/model_file.hpp"
#include "task/words.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

// Of parameters that the model has: another law may stand in the place of the one that laws in the drive were asked
// for.
LawOrders of_parameters(LawOrders orders, const std::vector<std::string>& names) {
  std::erase_if(orders, [&](const auto& law) { return std::ranges::find(names, law.first) == names.end(); });
  return orders;
}

// What laws follow beside drive and frequency: unit, the range fitted over, order of every parameter.
json by_json(const Layout& layout) {
  json result = json::object();
  for (std::size_t c = 0; c < layout.conditions().size(); ++c) {
    const ConditionRange& condition = layout.conditions()[c];
    json orders = json::object();
    for (const ParameterLaw& law : layout.laws()) {
      const std::size_t nodes = law.condition_nodes[c].size();
      if (nodes > 1) orders[layout.names()[law.parameter]] = nodes - 1;
    }
    if (!orders.empty()) {
      result[condition.name] = {
          {"unit", condition.unit}, {"from", condition.low}, {"to", condition.high}, {"parameters", orders}};
    }
  }
  return result;
}

// Lowest and highest of a channel over the fitted recordings; null where one of them has none.
template <class Channel>
json range_of(const std::vector<std::size_t>& fitted, const Campaign& campaign, Channel channel) {
  json result;
  for (const std::size_t k : fitted) {
    const std::vector<double>& values = channel(campaign.recordings[k]);
    if (values.empty()) return nullptr;
    const auto [low, high] = std::ranges::minmax(values);
    result = result.is_null() ? json{low, high}
                              : json{std::min(low, result[0].get<double>()), std::max(high, result[1].get<double>())};
  }
  return result;
}

json fitted_over_json(const std::vector<std::size_t>& fitted, const Campaign& campaign) {
  json result = {
      {"displacement_m",
       range_of(fitted, campaign, [](const Recording& r) -> const std::vector<double>& { return r.displacement; })},
      {"velocity_m_s",
       range_of(fitted, campaign, [](const Recording& r) -> const std::vector<double>& { return r.velocity; })}};
  // A time that was made for the want of one makes speeds that say nothing.
  if (std::ranges::any_of(fitted, [&](std::size_t k) { return !campaign.recordings[k].timed; })) {
    result["velocity_m_s"] = nullptr;
  }
  // Of two kinds there is no range.
  const DriveKind kind = fitted.empty() ? DriveKind::none : campaign.recordings[fitted.front()].drive_kind;
  const bool one = kind != DriveKind::none && std::ranges::all_of(fitted, [&](std::size_t k) {
                     return campaign.recordings[k].drive_kind == kind;
                   });
  if (one)
    result[drive_key(kind)] =
        range_of(fitted, campaign, [](const Recording& r) -> const std::vector<double>& { return r.drive; });
  return result;
}

json powers_json(const Term& term, const Layout& layout) {
  json result = json::object();
  for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
    if (term.condition_powers[c] > 0) result[layout.conditions()[c].name] = term.condition_powers[c];
  }
  return result;
}

}  // namespace

json model_json(const Identification& result, const Campaign& campaign, const IdentifyOptions& options,
                const std::string& command) {
  json parameters = json::array();
  for (const Estimate& estimate : result.estimates) {
    parameters.push_back({{"name", estimate.name},
                          {"parameter", result.layout.names()[estimate.term.parameter]},
                          {"drive_power", estimate.term.drive_power},
                          {"frequency_power", estimate.term.frequency_power},
                          {"value", estimate.term.value},
                          {"unit", estimate.unit},
                          {"std_error", estimate.std_error ? json(*estimate.std_error) : json(nullptr)},
                          {"at_bound", estimate.at_bound ? json(word_of(*estimate.at_bound)) : json(nullptr)},
                          {"identifiable", estimate.identifiable}});
    if (json powers = powers_json(estimate.term, result.layout); !powers.empty()) {
      parameters.back()["condition_powers"] = std::move(powers);
    }
  }
  for (std::size_t j = 0; j < result.layout.cards().size(); ++j) {
    const bool searched =
        std::ranges::any_of(result.layout.laws(), [&](const ParameterLaw& law) { return law.parameter == j; });
    if (!searched) {
      parameters.push_back({{"name", result.layout.names()[j]},
                            {"parameter", result.layout.names()[j]},
                            {"drive_power", 0},
                            {"frequency_power", 0},
                            {"value", result.layout.held()[j]},
                            {"unit", result.layout.cards()[j].unit},
                            {"std_error", nullptr},
                            {"at_bound", nullptr},
                            {"fixed", true}});
    }
  }
  json fitted = json::array();
  for (const std::size_t index : result.fitted) {
    const Recording& recording = campaign.recordings[index];
    fitted.push_back(
        {{"file", recording.file}, {"sha256", recording.sha256}, {"values_sha256", sha256_of_values(recording)}});
  }
  json effects = json::array();
  for (const Part* effect : result.layout.model().effects) {
    effects.push_back(effect->id);
  }
  json range = json::object();
  for (const ParameterLaw& law : result.layout.laws()) {
    if (law.drive_nodes.size() > 1) range["drive"] = {law.drive_nodes.front(), law.drive_nodes.back()};
    if (law.frequency_nodes.size() > 1) {
      range["frequency_hz"] = {law.frequency_nodes.front(), law.frequency_nodes.back()};
    }
  }
  json file = {{"schema", "hysteron.model/1"},
               {"model", result.layout.model().law->id},
               {"effects", effects},
               {"by_current", of_parameters(options.layout.by_current, result.layout.names())},
               {"by_frequency", of_parameters(options.layout.by_frequency, result.layout.names())},
               {"laws_fitted_over", range},
               {"fitted_over", fitted_over_json(result.fitted, campaign)},
               {"parameters", parameters},
               {"fitted_on", fitted},
               {"nrmse",
                {{"normalisation", word_of(options.objective.normalisation)},
                 {"fit", result.cost},
                 {"heldout", result.nrmse_heldout ? json(*result.nrmse_heldout) : json(nullptr)}}},
               {"provenance",
                {{"program", "hysteron " HYSTERON_VERSION},
                 {"command", command},
                 {"seed", options.seed},
                 {"solver", result.solvers[result.chosen].run.solver}}}};
  if (json by = by_json(result.layout); !by.empty()) {
    if (by.contains(clock_condition)) {
      if (const auto since = clock_since(campaign.recordings)) by[std::string(clock_condition)]["since"] = *since;
    }
    file["by"] = std::move(by);
  }
  return file;
}

}  // namespace hysteron

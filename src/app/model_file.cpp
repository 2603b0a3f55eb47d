#include "app/model_file.hpp"

#include <algorithm>
#include <cmath>

#include "app/command.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "io/file.hpp"

namespace hysteron::app {

using nlohmann::json;

json model_json(const Identification& result, const Campaign& campaign, const IdentifyOptions& options) {
  json parameters = json::array();
  for (const Estimate& estimate : result.estimates) {
    parameters.push_back({{"name", estimate.name},
                          {"parameter", result.layout.names()[estimate.term.parameter]},
                          {"drive_power", estimate.term.drive_power},
                          {"frequency_power", estimate.term.frequency_power},
                          {"value", estimate.term.value},
                          {"unit", estimate.unit},
                          {"std_error", estimate.std_error ? json(*estimate.std_error) : json(nullptr)},
                          {"at_bound", estimate.at_bound ? json(*estimate.at_bound) : json(nullptr)},
                          {"identifiable", estimate.identifiable}});
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
    fitted.push_back({{"file", campaign.recordings[index].file}, {"sha256", campaign.recordings[index].sha256}});
  }
  json effects = json::array();
  for (const Part* effect : result.layout.model().effects) {
    effects.push_back(effect->id);
  }
  return {{"schema", "hysteron.model/1"},
          {"model", result.layout.model().law->id},
          {"effects", effects},
          {"by_current", options.layout.by_current},
          {"by_frequency", options.layout.by_frequency},
          {"parameters", parameters},
          {"fitted_on", fitted},
          {"nrmse",
           {{"normalisation", word_of(options.objective.normalisation)},
            {"fit", result.cost},
            {"heldout", result.nrmse_heldout ? json(*result.nrmse_heldout) : json(nullptr)}}},
          {"provenance",
           {{"program", "hysteron " HYSTERON_VERSION},
            {"command", command_line()},
            {"seed", options.seed},
            {"solver", result.solvers[result.chosen].run.solver}}}};
}

StoredModel read_model(const std::string& path) {
  const std::string text = read_file(path);
  json root;
  try {
    root = json::parse(text);
  } catch (const json::parse_error& error) {
    const auto line =
        1 +
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size())), '\n');
    throw InputError(path, static_cast<int>(line), "not valid JSON, expected a model.json written by hysteron");
  } catch (const json::out_of_range&) {
    throw InputError(path, 0, "holds a number beyond the range of a double, expected a model.json written by hysteron");
  }
  const auto wrong = [&](const std::string& what) { return InputError(path, 0, what); };
  if (!root.is_object() || !root.contains("schema") || !root["schema"].is_string()) {
    throw wrong("no schema, expected \"hysteron.model/1\"");
  }
  if (root["schema"] != "hysteron.model/1") {
    throw wrong("schema " + root["schema"].dump() + " is not known to this version, expected \"hysteron.model/1\"");
  }
  StoredModel result;
  try {
    result.model = make_model(root.at("model").get<std::string>(), root.value("effects", std::vector<std::string>{}));
    const std::vector<std::string> names = result.model.parameter_names();
    for (const Parameter& card : result.model.parameters()) {
      result.held.push_back(card.initial);
    }
    std::vector<bool> seen(names.size(), false);
    for (const json& entry : root.at("parameters")) {
      const auto name = entry.value("parameter", entry.at("name").get<std::string>());
      const auto found = std::ranges::find(names, name);
      if (found == names.end()) {
        throw wrong("model " + root.at("model").get<std::string>() + " has no parameter '" + name + "'" +
                    suggestion(name, names));
      }
      const auto index = static_cast<std::size_t>(found - names.begin());
      const auto value = entry.at("value").get<double>();
      if (!std::isfinite(value)) {
        throw wrong("parameter '" + name + "' is not finite");
      }
      const int drive_power = entry.value("drive_power", 0);
      const int frequency_power = entry.value("frequency_power", 0);
      if (drive_power < 0 || drive_power > 9 || frequency_power < 0 || frequency_power > 9) {
        throw wrong("parameter '" + name + "' has a power outside 0 to 9");
      }
      if (std::ranges::any_of(result.terms, [&](const Term& term) {
            return term.parameter == index && term.drive_power == drive_power &&
                   term.frequency_power == frequency_power;
          })) {
        throw wrong("parameter '" + term_name(name, drive_power, frequency_power) + "' is given twice");
      }
      result.terms.push_back({index, drive_power, frequency_power, value});
      seen[index] = true;
    }
    const auto fixed = result.model.parameters();
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!seen[k] && !fixed[k].fixed) {
        throw wrong("parameter '" + names[k] + "' is missing");
      }
    }
  } catch (const json::exception&) {
    throw wrong("not a complete model, expected the members model and parameters of hysteron.model/1");
  }
  return result;
}

}  // namespace hysteron::app

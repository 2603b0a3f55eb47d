#include "task/model_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "core/unit_text.hpp"
#include "io/file.hpp"
#include "io/json_reader.hpp"
#include "task/words.hpp"

namespace hysteron {

using nlohmann::json;

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
  json range = json::object();
  for (const ParameterLaw& law : result.layout.laws()) {
    if (law.drive_nodes.size() > 1) range["drive"] = {law.drive_nodes.front(), law.drive_nodes.back()};
    if (law.frequency_nodes.size() > 1) {
      range["frequency_hz"] = {law.frequency_nodes.front(), law.frequency_nodes.back()};
    }
  }
  return {{"schema", "hysteron.model/1"},
          {"model", result.layout.model().law->id},
          {"effects", effects},
          {"by_current", options.layout.by_current},
          {"by_frequency", options.layout.by_frequency},
          {"laws_fitted_over", range},
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
}

namespace {

// A power of the drive or the frequency: a whole number from 0 to 9.
int power_of(const json& entry, const char* key, const std::string& name) {
  if (!entry.contains(key)) return 0;
  const json& power = entry.at(key);
  if (!power.is_number_integer() || power < 0 || power > 9) {
    throw InputError("parameter '" + name + "' has " + key + " " + power.dump() +
                     ", expected a whole number from 0 to 9");
  }
  return power.get<int>();
}

// [lowest, highest] of what laws were fitted over, if the file states it.
std::optional<std::pair<double, double>> stated_range(const json& root, const char* key) {
  if (!root.contains("laws_fitted_over") || !root.at("laws_fitted_over").contains(key)) return std::nullopt;
  const json& ends = root.at("laws_fitted_over").at(key);
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number() || !(ends[0] < ends[1])) {
    throw InputError(std::string("laws_fitted_over, ") + key + ", is " + ends.dump() +
                     ", expected the lowest and the highest value");
  }
  return std::pair(ends[0].get<double>(), ends[1].get<double>());
}

// Order of a parameter's law in by_current or by_frequency, if the file states one.
std::optional<int> stated_order(const json& root, const char* key, const std::string& name) {
  if (!root.contains(key) || !root.at(key).contains(name)) return std::nullopt;
  const json& order = root.at(key).at(name);
  if (!order.is_number_integer() || order < 0 || order > 9) {
    throw InputError(std::string(key) + " of '" + name + "' is " + order.dump() +
                     ", expected a whole number from 0 to 9");
  }
  return order.get<int>();
}

// The terms of every parameter fill the grid of its powers, and are as many as its stated laws say.
void check_terms(const json& root, const StoredModel& stored) {
  const std::vector<std::string> names = stored.model.parameter_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    int drive = -1;
    int frequency = -1;
    std::size_t count = 0;
    for (const Term& term : stored.terms) {
      if (term.parameter != k) continue;
      ++count;
      drive = std::max(drive, term.drive_power);
      frequency = std::max(frequency, term.frequency_power);
    }
    if (count == 0) throw InputError("parameter '" + names[k] + "' is missing");
    const int by_drive = stated_order(root, "by_current", names[k]).value_or(drive);
    const int by_frequency = stated_order(root, "by_frequency", names[k]).value_or(frequency);
    if (drive > by_drive || frequency > by_frequency) {
      throw InputError("parameter '" + names[k] + "' has more terms than its law in by_current or by_frequency");
    }
    for (int p = 0; p <= by_drive; ++p) {
      for (int q = 0; q <= by_frequency; ++q) {
        const bool there = std::ranges::any_of(stored.terms, [&](const Term& term) {
          return term.parameter == k && term.drive_power == p && term.frequency_power == q;
        });
        if (!there) throw InputError("parameter '" + term_name(names[k], p, q) + "' is missing");
      }
    }
  }
}

}  // namespace

StoredModel read_model(const std::string& path) { return parse_model(read_file(path), path); }

StoredModel parse_model(std::string_view text, const std::string& path) {
  const json root = parse_json(text, path, "expected a model.json written by hysteron");
  const auto wrong = [&](const std::string& what) { return InputError(path, 0, what); };
  if (!root.is_object() || !root.contains("schema") || !root["schema"].is_string()) {
    throw wrong("no schema, expected \"hysteron.model/1\"");
  }
  if (root["schema"] != "hysteron.model/1") {
    throw wrong("schema " + root["schema"].dump() + " is not known to this version, expected \"hysteron.model/1\"");
  }
  StoredModel result;
  try {
    const auto effects = root.value("effects", std::vector<std::string>{});
    refuse_repeats("effects", effects);
    result.model = make_model(root.at("model").get<std::string>(), effects);
    const std::vector<std::string> names = result.model.parameter_names();
    const std::vector<Parameter> cards = result.model.parameters();
    for (const Parameter& card : cards) {
      result.held.push_back(card.initial);
    }
    for (const json& entry : root.at("parameters")) {
      const auto name = entry.value("parameter", entry.at("name").get<std::string>());
      const auto found = std::ranges::find(names, name);
      if (found == names.end()) {
        throw InputError("model " + root.at("model").get<std::string>() + " has no parameter '" + name + "'" +
                         suggestion(name, names));
      }
      const auto index = static_cast<std::size_t>(found - names.begin());
      const auto value = entry.at("value").get<double>();
      if (!std::isfinite(value)) {
        throw InputError("parameter '" + name + "' is not finite");
      }
      const int drive_power = power_of(entry, "drive_power", name);
      const int frequency_power = power_of(entry, "frequency_power", name);
      if (std::ranges::any_of(result.terms, [&](const Term& term) {
            return term.parameter == index && term.drive_power == drive_power &&
                   term.frequency_power == frequency_power;
          })) {
        throw InputError("parameter '" + term_name(name, drive_power, frequency_power) + "' is given twice");
      }
      const std::string unit =
          entry.value("unit", term_unit(cards[index].unit, drive_power, frequency_power, result.drive));
      if (drive_power > 0 && result.drive == DriveKind::none) {
        result.drive = unit.find("/V") == std::string::npos ? DriveKind::current : DriveKind::voltage;
      }
      const std::string expected = term_unit(cards[index].unit, drive_power, frequency_power, result.drive);
      if (unit != expected) {
        throw InputError("parameter '" + term_name(name, drive_power, frequency_power) + "' has the unit '" + unit +
                         "', expected '" + expected + "'");
      }
      result.terms.push_back({index, drive_power, frequency_power, value});
      result.searched += entry.value("fixed", false) ? 0 : 1;
    }
    for (const json& entry : root.value("fitted_on", json::array())) {
      if (entry.is_object() && entry.contains("sha256") && entry.at("sha256").is_string()) {
        result.fitted_on.insert(entry.at("sha256").get<std::string>());
      }
    }
    result.drive_range = stated_range(root, "drive");
    result.frequency_range = stated_range(root, "frequency_hz");
    check_terms(root, result);
  } catch (const json::exception&) {
    throw wrong("not a complete model, expected the members model and parameters of hysteron.model/1");
  } catch (const InputError& error) {
    throw wrong(error.what());
  }
  return result;
}

void check_drive(const StoredModel& stored, const std::string& path, const Recording& recording) {
  if (stored.drive == DriveKind::none || stored.drive == recording.drive_kind) return;
  if (recording.drive_kind == DriveKind::none) return;
  const auto word = [](DriveKind kind) { return std::string(kind == DriveKind::voltage ? "voltage" : "current"); };
  throw InputError(recording.file, 0,
                   "records a " + word(recording.drive_kind) + ", expected a " + word(stored.drive) +
                       ": parameters of " + path + " follow the " + word(stored.drive));
}

}  // namespace hysteron

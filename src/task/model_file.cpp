#include "task/model_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/suggest.hpp"
#include "fit/layout.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/json_reader.hpp"
#include "task/words.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr std::size_t most_terms = 10000;  // of one law

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

// [lowest, highest] in a member of the file, if it states it.
std::optional<std::pair<double, double>> stated_range(const json& root, const char* member, const char* key) {
  if (!root.contains(member) || !root.at(member).contains(key) || root.at(member).at(key).is_null())
    return std::nullopt;
  const json& ends = root.at(member).at(key);
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number() || ends[0] > ends[1]) {
    throw InputError(std::string(member) + ", " + key + ", is " + ends.dump() +
                     ", expected the lowest and the highest value");
  }
  return std::pair(ends[0].get<double>(), ends[1].get<double>());
}

FittedOver stated_fitted_over(const json& root) {
  FittedOver result{stated_range(root, "fitted_over", "displacement_m"),
                    stated_range(root, "fitted_over", "velocity_m_s"),
                    {},
                    DriveKind::none};
  for (const DriveKind kind : {DriveKind::current, DriveKind::voltage}) {
    const auto range = stated_range(root, "fitted_over", drive_key(kind));
    if (!range) continue;
    result.drive = range;
    result.drive_kind = kind;
  }
  return result;
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

// In older files a diagnosis that put another law in the place of the one asked for kept what was asked of that.
bool of_another_law(const json& root, const std::string& name) {
  const json provenance = root.value("provenance", json::object());
  return provenance.is_object() && provenance.value("command", "").starts_with("hysteron diagnose") &&
         std::ranges::any_of(model_catalogue(), [&](const Part* law) {
           return std::ranges::find(law->parameters, name, &Parameter::name) != law->parameters.end();
         });
}

// Whose name a law is given under must be there: a mistyped one would be the law of nothing.
void refuse_laws_of_nothing(const json& root, const std::vector<std::string>& names) {
  for (const char* key : {"by_current", "by_frequency"}) {
    const json laws = root.value(key, json::object());
    if (laws.is_null()) continue;
    if (!laws.is_object()) {
      throw InputError(std::string(key) + " is " + laws.dump(-1, ' ', true) + ", expected an order for each parameter");
    }
    for (const auto& [name, order] : laws.items()) {
      if (std::ranges::find(names, name) != names.end() || of_another_law(root, name)) continue;
      throw InputError(std::string(key) + ": the model has no parameter '" + name + "'" + suggestion(name, names));
    }
  }
}

void refuse_impossible(const Parameter& card, const std::string& name, double value) {
  if (card.limits.hold(value)) return;
  throw InputError("parameter '" + name + "' is " + number_text(value) + ", expected " + limits_text(card));
}

// The terms of every parameter fill the grid of its powers, and are as many as its stated laws say.
void check_terms(const json& root, const StoredModel& stored) {
  const std::vector<std::string> names = stored.model.parameter_names();
  const std::vector<Parameter> cards = stored.model.parameters();
  for (std::size_t k = 0; k < names.size(); ++k) {
    // Highest power in drive, frequency and every condition: as found, then as stated.
    std::vector<int> highest(2 + stored.conditions.size(), -1);
    const auto powers_of = [&](const Term& term) {
      std::vector<int> powers{term.drive_power, term.frequency_power};
      powers.insert(powers.end(), term.condition_powers.begin(), term.condition_powers.end());
      powers.resize(highest.size(), 0);
      return powers;
    };
    for (const Term& term : stored.terms) {
      if (term.parameter != k) continue;
      const std::vector<int> powers = powers_of(term);
      for (std::size_t axis = 0; axis < highest.size(); ++axis) highest[axis] = std::max(highest[axis], powers[axis]);
    }
    if (highest[0] < 0) throw InputError("parameter '" + names[k] + "' is missing");
    std::vector<int> stated{stated_order(root, "by_current", names[k]).value_or(highest[0]),
                            stated_order(root, "by_frequency", names[k]).value_or(highest[1])};
    for (const ConditionRange& condition : stored.conditions) {
      const json& orders = root.at("by").at(condition.name).at("parameters");
      stated.push_back(orders.contains(names[k]) ? orders.at(names[k]).get<int>() : 0);
    }
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < highest.size(); ++axis) {
      if (highest[axis] > stated[axis]) {
        throw InputError("parameter '" + names[k] + "' has more terms than its law in by_current, by_frequency or by");
      }
      count *= static_cast<std::size_t>(stated[axis] + 1);
      if (count > most_terms) throw InputError("parameter '" + names[k] + "' has a law of too many terms");
    }
    if (count == 1) refuse_impossible(cards[k], names[k], std::ranges::find(stored.terms, k, &Term::parameter)->value);
    for (std::size_t n = 0; n < count; ++n) {
      Term wanted{k, 0, 0, 0.0, {}};
      std::size_t rest = n;
      for (std::size_t axis = 0; axis < stated.size(); ++axis) {
        const auto size = static_cast<std::size_t>(stated[axis] + 1);
        const int power = static_cast<int>(rest % size);
        rest /= size;
        if (axis == 0) {
          wanted.drive_power = power;
        } else if (axis == 1) {
          wanted.frequency_power = power;
        } else {
          wanted.condition_powers.push_back(power);
        }
      }
      const bool there = std::ranges::any_of(
          stored.terms, [&](const Term& term) { return term.parameter == k && term.same_powers(wanted); });
      if (!there) throw InputError("parameter '" + term_name(names[k], wanted, stored.conditions) + "' is missing");
    }
  }
}

// The member `by`: what it does not know it refuses, since the force would be another.
std::vector<ConditionRange> conditions_in(const json& root, const std::vector<std::string>& names) {
  std::vector<ConditionRange> result;
  if (!root.contains("by")) return result;
  for (const auto& [name, law] : root.at("by").items()) {
    if (name.empty() || name != condition_name(name, "by")) {
      throw InputError("by: '" + name + "' is not the name of a condition, expected lower case, e.g. pressure");
    }
    for (const auto& [key, value] : law.items()) {
      const bool known = key == "unit" || key == "from" || key == "to" || key == "parameters";
      if (!known && !(name == clock_condition && key == "since")) {
        throw InputError("by." + name + " has an unknown member '" + key + "', expected unit, from, to, parameters");
      }
    }
    for (const auto& [parameter, order] : law.at("parameters").items()) {
      if (std::ranges::find(names, parameter) == names.end()) {
        throw InputError("by." + name + ": the model has no parameter '" + parameter + "'" +
                         suggestion(parameter, names));
      }
      if (!order.is_number_integer() || order < 0 || order > 9) {
        throw InputError("by." + name + " of '" + parameter + "' is " + order.dump() +
                         ", expected a whole number from 0 to 9");
      }
    }
    const ConditionRange range{name, law.at("unit").get<std::string>(), law.at("from").get<double>(),
                               law.at("to").get<double>()};
    if (!std::isfinite(range.low) || !std::isfinite(range.high)) {
      throw InputError("by." + name + " has a range that is not finite");
    }
    result.push_back(range);
  }
  return result;
}

// Powers of the conditions in a parameter's entry.
std::vector<int> condition_powers_of(const json& entry, const std::vector<ConditionRange>& conditions,
                                     const std::string& name) {
  std::vector<int> result(conditions.size(), 0);
  if (!entry.contains("condition_powers")) return result;
  for (const auto& [key, value] : entry.at("condition_powers").items()) {
    const auto at = std::ranges::find(conditions, key, &ConditionRange::name);
    if (at == conditions.end()) {
      throw InputError("parameter '" + name + "' follows '" + key + "', which is not in by");
    }
    result[static_cast<std::size_t>(at - conditions.begin())] =
        power_of(entry.at("condition_powers"), key.c_str(), name);
  }
  return result;
}

// The member `response`: on a base the recordings hold no force that is not the damper's.
void read_response(const json& root, StoredModel& stored) {
  const json response = root.value("response", json::object());
  if (!response.is_object() || response.value("excitation", "") != "force") return;
  stored.from_response = true;
  for (const json& entry : response.value("recordings", json::array())) {
    stored.excited.insert(entry.at("sha256").get<std::string>());
  }
}

}  // namespace

StoredModel read_model(const std::string& path) {
  std::error_code code;
  const std::filesystem::path inside = std::filesystem::path(path) / "model.json";
  if (std::filesystem::is_regular_file(inside, code)) {
    throw InputError(path, 0, "is a folder, expected the file in it: " + inside.string());
  }
  return parse_model(read_file(path), path);
}

StoredModel parse_model(std::string_view text, const std::string& path) {
  const json root = parse_json(text, path, "expected a model.json written by hysteron");
  const auto wrong = [&](const std::string& what) { return InputError(path, 0, what); };
  if (!root.is_object() || !root.contains("schema") || !root["schema"].is_string()) {
    throw wrong("no schema, expected \"hysteron.model/1\"");
  }
  if (root["schema"] != "hysteron.model/1") {
    const auto& schema = root["schema"].get_ref<const std::string&>();
    if (schema.starts_with("hysteron.") && !schema.starts_with("hysteron.model/")) {
      throw wrong("schema " + root["schema"].dump() +
                  " is another kind of result, expected a model.json, which fit and diagnose write beside it");
    }
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
    refuse_laws_of_nothing(root, names);
    result.conditions = conditions_in(root, names);
    if (const json clock = root.value("by", json::object()).value(std::string(clock_condition), json::object());
        clock.contains("since")) {
      result.clock_since = clock["since"].get<double>();
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
      const Term read{index, drive_power, frequency_power, value, condition_powers_of(entry, result.conditions, name)};
      if (std::ranges::any_of(result.terms,
                              [&](const Term& term) { return term.parameter == index && term.same_powers(read); })) {
        throw InputError("parameter '" + term_name(name, read, result.conditions) + "' is given twice");
      }
      const std::string unit = entry.value("unit", term_unit(cards[index].unit, read, result.conditions, result.drive));
      if (drive_power > 0 && result.drive == DriveKind::none) {
        result.drive = unit.find("/V") == std::string::npos ? DriveKind::current : DriveKind::voltage;
      }
      const std::string expected = term_unit(cards[index].unit, read, result.conditions, result.drive);
      if (unit != expected) {
        throw InputError("parameter '" + term_name(name, read, result.conditions) + "' has the unit '" + unit +
                         "', expected '" + expected + "'");
      }
      if (!entry.contains("unit")) {
        result.assumed_units.emplace_back(term_name(name, read, result.conditions), expected);
      }
      result.terms.push_back(read);
      result.searched += entry.value("fixed", false) ? 0 : 1;
    }
    for (const json& entry : root.value("fitted_on", json::array())) {
      if (entry.is_object() && entry.contains("sha256") && entry.at("sha256").is_string()) {
        result.fitted_on.insert(entry.at("sha256").get<std::string>());
        const std::string values = entry.value("values_sha256", "");
        if (!values.empty()) result.fitted_values.insert(values);
      }
    }
    result.drive_range = stated_range(root, "laws_fitted_over", "drive");
    result.frequency_range = stated_range(root, "laws_fitted_over", "frequency_hz");
    result.fitted_over = stated_fitted_over(root);
    read_response(root, result);
    check_terms(root, result);
  } catch (const json::exception&) {
    throw wrong("not a complete model, expected the members model and parameters of hysteron.model/1");
  } catch (const InputError& error) {
    throw wrong(error.what());
  }
  return result;
}

}  // namespace hysteron

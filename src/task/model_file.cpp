#include "task/model_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/number_text.hpp"
#include "core/suggest.hpp"
#include "core/unit_text.hpp"
#include "fit/layout.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/json_reader.hpp"
#include "io/value_hash.hpp"
#include "task/rate.hpp"
#include "task/words.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

// Where the clock of recordings counts from, s since 1970, if it is that of their starts: of the first of them, unless
// a number was given in its place.
std::optional<double> clock_since(const std::vector<Recording>& recordings) {
  std::optional<double> since;
  for (const Recording& recording : recordings) {
    const auto clock = std::ranges::find(recording.conditions, clock_condition, &ConditionChannel::name);
    if (clock == recording.conditions.end() || clock->values.size() != 1 || !recording.started) return std::nullopt;
    const double zero = *recording.started - clock->values.front();
    constexpr double rounding = 1e-3;  // s
    if (since && std::fabs(zero - *since) > rounding) return std::nullopt;
    since = since.value_or(zero);
  }
  return since;
}

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

constexpr const char* drive_key(DriveKind kind) { return kind == DriveKind::voltage ? "voltage_v" : "current_a"; }

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

bool StoredModel::follows_frequency() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.frequency_power > 0; });
}

std::vector<std::string> conditions_of(const std::vector<const StoredModel*>& models) {
  std::set<std::string> result;
  for (const StoredModel* model : models) {
    for (const ConditionRange& condition : model->conditions) result.insert(condition.name);
  }
  return {result.begin(), result.end()};
}

namespace {

// What --at gives but none of these names.
void refuse_others(const std::map<std::string, ConditionNumber>& values, const std::vector<std::string>& followed) {
  for (const auto& [name, number] : values) {
    if (std::ranges::find(followed, name) != followed.end()) continue;
    std::string expected;
    for (const std::string& one : followed) {
      expected += (expected.empty() ? "" : &one == &followed.back() ? " or " : ", ") + one;
    }
    throw OptionError(Option::at + ": no parameter of the model follows '" + name + "'" + suggestion(name, followed) +
                      ", expected " +
                      (expected.empty() ? "no " + Option::at + ", since they follow nothing that it gives" : expected));
  }
}

// What the motion and its drive give all along is no number, though parameters follow it.
void refuse_number_for(const std::string& name, bool followed, const std::map<std::string, ConditionNumber>& values,
                       const std::string& why) {
  if (!followed || !values.contains(name)) return;
  throw OptionError(Option::at + ": the " + name + " " + why + ", expected no number for it");
}

// Terms that followed `from` and now follow `to`, which holds them all.
void reorder(StoredModel& stored, const std::vector<ConditionRange>& to) {
  for (Term& term : stored.terms) {
    std::vector<int> powers(to.size(), 0);
    for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
      const auto at = std::ranges::find(to, stored.conditions[c].name, &ConditionRange::name);
      powers[static_cast<std::size_t>(at - to.begin())] = term.condition_powers[c];
    }
    term.condition_powers = std::move(powers);
  }
  stored.conditions = to;
}

// Laws in the clock count from `since`, as that of the recordings does: (clock + later)^k, multiplied out.
void count_clock_from(StoredModel& stored, double since) {
  const auto clock = std::ranges::find(stored.conditions, clock_condition, &ConditionRange::name);
  const auto c = static_cast<std::size_t>(clock - stored.conditions.begin());
  const double later = since - *stored.clock_since;
  const std::vector<Term> terms = std::move(stored.terms);
  stored.terms.clear();
  for (const Term& term : terms) {
    const int power = c < term.condition_powers.size() ? term.condition_powers[c] : 0;
    double factor = term.value;  // binomial coefficient and power of `later`
    for (int k = power; k >= 0; --k) {
      Term part = term;
      part.value = factor;
      if (power > 0) part.condition_powers[c] = k;
      const auto same = std::ranges::find_if(stored.terms, [&](const Term& other) {
        return other.parameter == part.parameter && other.same_powers(part);
      });
      if (same == stored.terms.end()) {
        stored.terms.push_back(part);
      } else {
        same->value += part.value;
      }
      factor *= later * k / (power - k + 1);
    }
  }
  clock->low -= later;
  clock->high -= later;
  stored.clock_since = since;
}

void refuse_other_unit(const ConditionRange& condition, const std::string& unit, const Message& where) {
  if (!unit.empty() && !condition.unit.empty() && unit != condition.unit) {
    throw OptionError(where + ": the " + condition.name + " is in '" + unit + "', expected '" + condition.unit +
                      "' as the model has it");
  }
}

}  // namespace

void refuse_unfollowed(const std::vector<const StoredModel*>& models,
                       const std::map<std::string, ConditionNumber>& values) {
  std::vector<std::string> followed = conditions_of(models);
  refuse_number_for("frequency", std::ranges::any_of(models, &StoredModel::follows_frequency), values,
                    "that parameters follow is the motion's own");
  for (const auto& [drive, name] : {std::pair{DriveKind::current, "current"}, {DriveKind::voltage, "voltage"}}) {
    if (std::ranges::find(models, drive, &StoredModel::drive) != models.end()) followed.emplace_back(name);
  }
  refuse_others(values, followed);
}

void follow_conditions(StoredModel& stored, const std::vector<Recording>& recordings) {
  if (recordings.empty()) return;
  const std::vector<ConditionChannel>& first = recordings.front().conditions;
  for (const Recording& recording : recordings) {
    for (const ConditionRange& condition : stored.conditions) {
      const auto here = std::ranges::find(recording.conditions, condition.name, &ConditionChannel::name);
      if (here == recording.conditions.end()) {
        throw InputError(recording.file + ": read without the " + condition.name +
                         ", which parameters of the model follow, expected a column or a number for it");
      }
      refuse_other_unit(condition, here->unit, recording.file);
      if (here->unit != condition.unit) {
        const auto in = [](const std::string& unit) { return unit.empty() ? "has no unit" : "is in '" + unit + "'"; };
        throw InputError(recording.file + ": the " + condition.name + " " + in(here->unit) + ", and " +
                         in(condition.unit) + " in the model, expected a unit in both or in neither");
      }
    }
    if (!std::ranges::equal(recording.conditions, first, {}, &ConditionChannel::name, &ConditionChannel::name)) {
      throw InputError(recording.file + ": other conditions than " + recordings.front().file +
                       ", expected the same in all recordings");
    }
  }
  if (const auto since = stored.clock_since ? clock_since(recordings) : std::nullopt) count_clock_from(stored, *since);
  std::vector<ConditionRange> all;
  for (const ConditionChannel& channel : first) {
    const auto own = std::ranges::find(stored.conditions, channel.name, &ConditionRange::name);
    all.push_back(own == stored.conditions.end() ? ConditionRange{channel.name, channel.unit, 0.0, 0.0} : *own);
  }
  reorder(stored, all);
}

void hold_conditions(StoredModel& stored, const std::map<std::string, ConditionNumber>& values,
                     const std::string& command) {
  std::vector<double> at;
  for (const ConditionRange& condition : stored.conditions) {
    const auto found = values.find(condition.name);
    if (found == values.end()) {
      throw OptionError(command + ": parameters follow the " + condition.name + ", expected its value by " +
                        Option::at + " \"" + condition.name + "=NUMBER" +
                        (condition.unit.empty() ? "" : " " + condition.unit) + "\"");
    }
    refuse_other_unit(condition, found->second.unit, Option::at);
    at.push_back(found->second.value);
  }
  for (const auto& [name, followed] : {std::pair{"current", stored.drive == DriveKind::current},
                                       {"voltage", stored.drive == DriveKind::voltage},
                                       {"frequency", stored.follows_frequency()}}) {
    refuse_number_for(name, followed, values, "stays an input of the exported model");
  }
  refuse_others(values, conditions_of({&stored}));
  if (stored.conditions.empty()) return;
  std::vector<Term> held;
  for (Term& term : stored.terms) {
    for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
      for (int k = 0; k < term.condition_powers[c]; ++k) term.value *= at[c];
    }
    term.condition_powers.clear();
    const auto same = std::ranges::find_if(
        held, [&](const Term& other) { return other.parameter == term.parameter && other.same_powers(term); });
    if (same == held.end()) {
      held.push_back(std::move(term));
    } else {
      same->value += term.value;
    }
  }
  stored.terms = std::move(held);
  stored.conditions.clear();
}

bool was_fitted_on(const StoredModel& stored, const Recording& recording) {
  return stored.fitted_on.contains(recording.sha256) ||
         (!stored.fitted_values.empty() && stored.fitted_values.contains(sha256_of_values(recording)));
}

void check_rate(const StoredModel& stored, const std::vector<Recording>& recordings) {
  std::vector<bool> may_act(stored.held.size(), false);
  for (const Term& term : stored.terms) {
    may_act[term.parameter] = may_act[term.parameter] || term.value != 0.0;
  }
  require_no_rate(stored.model, may_act, stored.follows_frequency(), recordings, "a recording with time");
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

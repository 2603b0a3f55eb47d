#include "io/campaign_file.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "io/clock_time.hpp"
#include "io/condition_faults.hpp"
#include "io/conditions.hpp"
#include "io/file.hpp"
#include "io/text.hpp"
#include "io/toml_reader.hpp"

namespace hysteron {
namespace {

constexpr std::string_view schema = "hysteron.campaign/1";

class CampaignParser : private TomlReader {
 public:
  using TomlReader::TomlReader;

  CampaignFile run(const std::string& text) {
    const toml::table root = parse(text, schema);
    check_keys(root, {"schema", "model", "by_current", "by_frequency", "by", "recording"}, "");
    CampaignFile result;
    if (const auto* node = root.get("model")) {
      result.model = text_of(*node, "model");
      if (result.model.empty()) fail(*node, "'model' is empty, expected the name of a model");
    }
    if (const auto* node = root.get("by_current"))
      result.by_current = orders_of(*node, "by_current", "current", result);
    if (const auto* node = root.get("by_frequency"))
      result.by_frequency = orders_of(*node, "by_frequency", "frequency", result);
    if (const auto* node = root.get("by")) add_laws(*node, result);
    if (const auto* node = root.get("recording")) result.entries = entries_of(*node);
    return result;
  }

 private:
  // Of the table `name`, whose laws follow `what`.
  [[nodiscard]] LawOrders orders_of(const toml::node& node, const std::string& name, const std::string& what,
                                    CampaignFile& result) const {
    const auto* table = node.as_table();
    if (table == nullptr) fail(node, "'" + name + "' is not a table, expected [" + name + "] with PARAMETER = ORDER");
    LawOrders orders;
    for (const auto& [key, value] : *table) {
      const auto* order = value.as_integer();
      if (order == nullptr || order->get() < 0 || order->get() > highest_order) {
        fail(value, "the order of " + in_quotes(key.str()) + " in [" + name + "] is not a whole number from 0 to " +
                        std::to_string(highest_order) + ", expected for example 1");
      }
      orders[std::string(key.str())] = static_cast<int>(order->get());
      result.lines_of_laws[{what, std::string(key.str())}] = line_of(value);
    }
    return orders;
  }

  // [by.NAME] for every NAME; current and frequency are those of the tables of their own.
  void add_laws(const toml::node& node, CampaignFile& result) const {
    const auto* table = node.as_table();
    if (table == nullptr) fail(node, "'by' is not a table, expected [by.NAME] with PARAMETER = ORDER");
    for (const auto& [key, orders] : *table) {
      const std::string text(key.str());
      const std::string name = name_of(orders, text, "[by]");
      LawOrders& into = name == "current"     ? result.by_current
                        : name == "frequency" ? result.by_frequency
                                              : result.by[name];
      if (!into.empty()) fail(orders, "two tables of laws in the " + name + ", expected one");
      into = orders_of(orders, "by." + text, name, result);
    }
  }

  [[nodiscard]] std::string name_of(const toml::node& node, const std::string& key, const std::string& where) const {
    try {
      return condition_name(key, where);
    } catch (const InputError& error) {
      fail(node, error.what());
    }
  }

  // A key of [[recording]] beside file and role: a number of the whole recording.
  [[nodiscard]] ConditionNumber number_of(const toml::key& key, const toml::node& node) const {
    std::optional<ConditionNumber> number;
    if (const auto whole = node.as_integer()) {
      number = ConditionNumber{static_cast<double>(whole->get()), {}, {}, 0};
    } else if (const auto real = node.as_floating_point()) {
      if (std::isfinite(real->get())) number = ConditionNumber{real->get(), {}, {}, 0};
    } else if (const auto text = node.as_string()) {
      const std::string fault = fault_of_condition(key.str(), text->get());
      if (!fault.empty()) fail(node, fault);
      number = condition_number(text->get());
    }
    if (!number || !(std::abs(number->value) <= largest_value)) {
      fail_at(static_cast<int>(key.source().begin.line),
              "unknown key " + in_quotes(key.str()) + " in [[recording]]" +
                  suggestion(key.str(), {"file", "role", "start"}) +
                  ", expected file, role, start, or a number of the recording such as pressure = 2.1e5 or \"2.1 bar\"");
    }
    number->file = this->file();
    number->line = static_cast<int>(key.source().begin.line);
    return *number;
  }

  // Numbers of one name have one unit in all recordings. A plain number is in SI where the name says of what.
  void refuse_other_unit(const ConditionNumber& number, const ConditionNumber& first, std::string_view name) const {
    const bool in_si = !unit_of_plain(lower_case(name)).empty();
    if (number.unit == first.unit || (in_si && (number.unit.empty() || first.unit.empty()))) return;
    const auto text = [](const std::string& unit) { return unit.empty() ? "without a unit" : "in " + in_quotes(unit); };
    fail_at(number.line, in_quotes(name) + " is given " + text(number.unit) + " and in line " +
                             std::to_string(first.line) + " " + text(first.unit) + ", expected one unit");
  }

  [[nodiscard]] std::vector<CampaignEntry> entries_of(const toml::node& node) const {
    const auto* array = node.as_array();
    if (array == nullptr) fail(node, "'recording' is not an array of tables, expected [[recording]]");
    std::vector<CampaignEntry> entries;
    std::set<std::string> seen;
    std::map<std::string, ConditionNumber> first;
    for (const auto& element : *array) {
      const auto* table = element.as_table();
      if (table == nullptr) fail(element, "'recording' is not an array of tables, expected [[recording]]");
      const auto* file = table->get("file");
      if (file == nullptr) fail(element, "[[recording]] without 'file', expected file = \"NAME.csv\"");
      CampaignEntry entry;
      entry.line = line_of(*file);
      const std::filesystem::path path(text_of(*file, "file"));
      if (path.empty() || path.is_absolute()) {
        fail(*file, "'file' is " + in_quotes(path.string()) + ", expected a name relative to the folder");
      }
      entry.file = path.lexically_normal().generic_string();
      if (entry.file == ".." || entry.file.starts_with("../")) {
        fail(*file, "'file' is " + in_quotes(path.string()) + ", which leaves the folder, expected a name inside it");
      }
      if (!seen.insert(entry.file).second) {
        fail(*file, "recording " + in_quotes(entry.file) + " is listed twice, expected each once");
      }
      if (const auto* role = table->get("role")) {
        entry.role = role_of(*role);
        entry.role_line = line_of(*role);
      }
      for (const auto& [key, value] : *table) {
        if (key.str() == "file" || key.str() == "role") continue;
        if (key.str() == "start") {
          const std::string text = start_text(value);
          entry.start = start_of(value, text);
          entry.start_has_zone = has_zone(text);
          entry.start_line = line_of(value);
          continue;
        }
        const ConditionNumber number = number_of(key, value);
        refuse_other_unit(number, first.emplace(lower_case(key.str()), number).first->second, key.str());
        if (!entry.numbers.emplace(name_of(value, std::string(key.str()), "[[recording]]"), number).second) {
          fail(value, in_quotes(key.str()) + " is given twice, expected each once");
        }
      }
      entries.push_back(std::move(entry));
    }
    return entries;
  }

  // A date-time of TOML, or one in quotes.
  [[nodiscard]] static std::string start_text(const toml::node& node) {
    if (const auto* stated = node.as_date_time()) {
      std::ostringstream out;
      out << stated->get();
      return out.str();
    }
    const auto* quoted = node.as_string();
    return quoted == nullptr ? std::string() : quoted->get();
  }

  [[nodiscard]] double start_of(const toml::node& node, const std::string& text) const {
    const auto start = clock_time(text);
    if (!start) fail(node, "'start' is not a date and time, expected for example 2026-11-24T14:50:58");
    return *start;
  }

  [[nodiscard]] Role role_of(const toml::node& node) const {
    const auto role = text_of(node, "role");
    if (role == "fit") return Role::fit;
    if (role == "validate") return Role::validate;
    fail(node, "unknown role " + in_quotes(role) + ", expected 'fit' or 'validate'");
  }
};

}  // namespace

CampaignFile read_campaign_file(const std::filesystem::path& path) {
  return parse_campaign_file(read_file(path), path);
}

CampaignFile parse_campaign_file(const std::string& text, const std::filesystem::path& path) {
  return CampaignParser(path).run(text);
}

}  // namespace hysteron

#include "io/campaign_file.hpp"

#include <set>
#include <string_view>

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
    check_keys(root, {"schema", "model", "by_current", "by_frequency", "recording"}, "");
    CampaignFile result;
    if (const auto* node = root.get("model")) {
      result.model = text_of(*node, "model");
      if (result.model.empty()) fail(*node, "'model' is empty, expected the name of a model");
    }
    if (const auto* node = root.get("by_current")) result.by_current = orders_of(*node, "by_current");
    if (const auto* node = root.get("by_frequency")) result.by_frequency = orders_of(*node, "by_frequency");
    if (const auto* node = root.get("recording")) result.entries = entries_of(*node);
    return result;
  }

 private:
  [[nodiscard]] std::map<std::string, int> orders_of(const toml::node& node, const std::string& name) const {
    const auto* table = node.as_table();
    if (table == nullptr) fail(node, "'" + name + "' is not a table, expected [" + name + "] with PARAMETER = ORDER");
    std::map<std::string, int> orders;
    for (const auto& [key, value] : *table) {
      const auto* order = value.as_integer();
      if (order == nullptr || order->get() < 0 || order->get() > highest_order) {
        fail(value, "the order of " + in_quotes(key.str()) + " in [" + name + "] is not a whole number from 0 to " +
                        std::to_string(highest_order) + ", expected for example 1");
      }
      orders[std::string(key.str())] = static_cast<int>(order->get());
    }
    return orders;
  }

  [[nodiscard]] std::vector<CampaignEntry> entries_of(const toml::node& node) const {
    const auto* array = node.as_array();
    if (array == nullptr) fail(node, "'recording' is not an array of tables, expected [[recording]]");
    std::vector<CampaignEntry> entries;
    std::set<std::string> seen;
    for (const auto& element : *array) {
      const auto* table = element.as_table();
      if (table == nullptr) fail(element, "'recording' is not an array of tables, expected [[recording]]");
      check_keys(*table, {"file", "role"}, " in [[recording]]");
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
      if (const auto* role = table->get("role")) entry.role = role_of(*role);
      entries.push_back(std::move(entry));
    }
    return entries;
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

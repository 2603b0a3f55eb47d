#include "task/laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "core/message.hpp"
#include "core/suggest.hpp"
#include "io/file.hpp"
#include "io/text.hpp"
#include "io/toml_reader.hpp"

namespace hysteron {
namespace {

// Laws in the current, the frequency or a condition.
struct LawsIn {
  std::string what;
  LawOrders orders;
  Option option;  // that gives others
};

// Those that add_laws_of would add.
std::vector<LawsIn> added_laws(const Campaign& campaign, const LayoutOptions& asked) {
  std::vector<LawsIn> result;
  if (asked.by_current.empty()) result.push_back({"current", campaign.by_current, Option::by_current});
  if (asked.by_frequency.empty()) result.push_back({"frequency", campaign.by_frequency, Option::by_frequency});
  for (const auto& [condition, orders] : campaign.by) {
    if (!asked.by.contains(condition)) result.push_back({condition, orders, Option::by});
  }
  return result;
}

// Of a law in [by_current] or [by.current]; 0 where the file has none.
int line_of_law(const std::filesystem::path& file, const std::string& what, const std::string& parameter) {
  const auto line_in = [&](const toml::node& laws) {
    const toml::table* table = laws.as_table();
    const toml::node* law = table == nullptr ? nullptr : table->get(parameter);
    return law == nullptr ? 0 : TomlReader::line_of(*law);
  };
  const toml::table root = TomlReader(file).parse(read_file(file), "hysteron.campaign/1");
  if (const toml::node* laws = root.get("by_" + what)) {
    if (const int line = line_in(*laws); line > 0) return line;
  }
  const toml::node* by = root.get("by");
  if (by == nullptr || !by->is_table()) return 0;
  for (const auto& [name, laws] : *by->as_table()) {
    if (lower_case(trimmed(name.str())) != what) continue;
    if (const int line = line_in(laws); line > 0) return line;
  }
  return 0;
}

struct Place {
  std::string file = "campaign.toml";
  int line = 0;
};

// Where the campaign.toml of a folder among `data` gives a law.
Place place_of_law(const std::vector<std::string>& data, const std::string& what, const std::string& parameter) {
  for (const std::string& folder : data) {
    const std::filesystem::path file = std::filesystem::path(folder) / "campaign.toml";
    std::error_code code;
    if (!std::filesystem::exists(file, code)) continue;
    if (const int line = line_of_law(file, what, parameter); line > 0) return {file.string(), line};
  }
  return {};
}

}  // namespace

void add_laws_of(const Campaign& campaign, LayoutOptions& asked) {
  if (asked.by_current.empty()) asked.by_current = campaign.by_current;
  if (asked.by_frequency.empty()) asked.by_frequency = campaign.by_frequency;
  asked.by.insert(campaign.by.begin(), campaign.by.end());
}

void refuse_laws_of_other_model(const Campaign& campaign, const LayoutOptions& asked, const CompositeModel& model,
                                const std::vector<std::string>& data) {
  const std::vector<std::string> names = model.parameter_names();
  for (const LawsIn& laws : added_laws(campaign, asked)) {
    for (const auto& [parameter, order] : laws.orders) {
      if (std::ranges::find(names, parameter) != names.end()) continue;
      const Place place = place_of_law(data, laws.what, parameter);
      throw OptionError(
          place.file, place.line,
          fmt::format("a law in the {} of '{}', which {} does not have{}, expected one of {}, or ", laws.what,
                      parameter, model.law->id, suggestion(parameter, names), fmt::join(names, ", ")) +
              laws.option + " with other laws");
    }
  }
}

}  // namespace hysteron

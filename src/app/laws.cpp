#include "app/laws.hpp"

#include <algorithm>
#include <map>

#include "app/command.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "io/conditions.hpp"
#include "io/text.hpp"

namespace hysteron::app {
namespace {

// By the names of what they follow.
std::map<std::string, LawOrders> parsed(const LawOptions& options) {
  std::map<std::string, LawOrders> result;
  const auto add = [&](const std::string& option, const std::string& name, const std::string& orders) {
    if (!result.emplace(name, parse_orders(option, orders)).second) {
      throw InputError(option + ": laws in the " + name + " are given twice, expected them together: " + option +
                       (option == "--by" ? " " + name + "=alpha:1,c0:1" : " alpha:1,c0:1"));
    }
  };
  if (!options.by_current.empty()) add("--by-current", "current", options.by_current);
  if (!options.by_frequency.empty()) add("--by-frequency", "frequency", options.by_frequency);
  for (const std::string& text : options.by) {
    const auto [name, orders] = split_pair("--by", text, "NAME=PARAMETER:ORDER,..., e.g. pressure=alpha:1,c0:1");
    if (orders.empty()) throw InputError("--by: '" + text + "' names no parameter, expected pressure=alpha:1,c0:1");
    add("--by", name_asked(name, "--by"), orders);
  }
  return result;
}

}  // namespace

void add_law_options(CLI::App& command, LawOptions& options) {
  command.add_option("--by-current", options.by_current,
                     "parameters that are polynomials in the drive, e.g. alpha:1,c0:1");
  command.add_option("--by-frequency", options.by_frequency, "parameters that are polynomials in frequency");
  command
      .add_option("--by", options.by,
                  "NAME=PARAMETER:ORDER,...: polynomials in a column or a number of campaign.toml, e.g. "
                  "pressure=alpha:1,c0:1; repeatable")
      ->allow_extra_args(false);
}

void ask_conditions(const LawOptions& options, DataOptions& data) {
  data.conditions.clear();
  data.taken.other_laws.clear();
  for (const auto& [name, orders] : parsed(options)) {
    data.taken.other_laws.insert(name);
    if (name == "frequency") data.follows_frequency = true;
    if (name != "current" && name != "frequency") data.conditions.push_back(name);
  }
  for (const std::string& text : options.by) {
    const std::string column = text.substr(0, text.find('='));
    const std::string name = name_asked(column, "--by");
    const bool mapped = std::ranges::any_of(data.columns, [&](const std::string& mapping) {
      return lower_case(trimmed(mapping.substr(0, mapping.find('=')))) == name;
    });
    // The unit belongs to the column.
    if (name != condition_name(column, "--by") && !mapped) data.columns.push_back(name + "=" + column);
  }
}

void set_laws(const LawOptions& options, LayoutOptions& layout) {
  for (const auto& [name, orders] : parsed(options)) {
    (name == "current" ? layout.by_current : name == "frequency" ? layout.by_frequency : layout.by[name]) = orders;
  }
}

}  // namespace hysteron::app

#include "task/laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/message.hpp"
#include "core/suggest.hpp"
#include "fit/identify.hpp"
#include "fit/one_level.hpp"

namespace hysteron {
namespace {

// Laws in the current, the frequency or a condition.
struct LawsIn {
  std::string what;
  LawOrders orders;
  Option option;  // that gives others

  // The option with a parameter: "--by pressure=alpha".
  [[nodiscard]] Message of(const std::string& parameter) const {
    return option + (option == Option::by ? " " + what + "=" : " ") + parameter;
  }
};

std::vector<LawsIn> laws_asked(const LayoutOptions& asked) {
  std::vector<LawsIn> result = {{"current", asked.by_current, Option::by_current},
                                {"frequency", asked.by_frequency, Option::by_frequency}};
  for (const auto& [condition, orders] : asked.by) result.push_back({condition, orders, Option::by});
  return result;
}

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

LineOfFile place_of(const Campaign& campaign, const std::string& what, const std::string& parameter) {
  const auto found = campaign.lines_of_laws.find({what, parameter});
  return found == campaign.lines_of_laws.end() ? LineOfFile{"campaign.toml"} : found->second;
}

}  // namespace

void add_laws_of(const Campaign& campaign, LayoutOptions& asked) {
  if (asked.by_current.empty()) asked.by_current = campaign.by_current;
  if (asked.by_frequency.empty()) asked.by_frequency = campaign.by_frequency;
  asked.by.insert(campaign.by.begin(), campaign.by.end());
}

void refuse_laws_of_other_model(const Campaign& campaign, const LayoutOptions& asked, const CompositeModel& model,
                                const std::set<std::string>& others) {
  const std::vector<std::string> names = model.parameter_names();
  for (const LawsIn& laws : added_laws(campaign, asked)) {
    for (const auto& [parameter, order] : laws.orders) {
      if (std::ranges::find(names, parameter) != names.end() || others.contains(parameter)) continue;
      const LineOfFile place = place_of(campaign, laws.what, parameter);
      throw OptionError(
          place.file, place.line,
          fmt::format("a law in the {} of '{}', which {} does not have{}, expected one of {}, or ", laws.what,
                      parameter, model.law->id, suggestion(parameter, names), fmt::join(names, ", ")) +
              laws.option + " with other laws");
    }
  }
}

DataScale scale_of_fitted(const Campaign& campaign) {
  std::vector<std::size_t> fitted;
  for (std::size_t k = 0; k < campaign.recordings.size(); ++k) {
    if (campaign.roles[k] != Role::validate) fitted.push_back(k);
  }
  return scale_of(fitted.empty() ? campaign.recordings : pick(campaign.recordings, fitted));
}

void refuse_laws_of_one_level(const Campaign& campaign, const LayoutOptions& asked, const DataScale& fitted) {
  const DataScale all = scale_of(campaign.recordings);
  const auto whose = [&](const std::string& what) {
    return lack_of_levels(all, what).empty() ? "the recordings that are fitted" : "the recordings";
  };
  for (const LawsIn& laws : laws_asked(asked)) {
    // Else the layout refuses it, once the parameter is known.
    if (!lack_of_levels(all, laws.what).empty()) continue;
    for (const auto& [parameter, order] : laws.orders) {
      refuse_one_level(fitted, laws.what, laws.of(parameter), order, "the recordings that are fitted");
    }
  }
  for (const LawsIn& laws : added_laws(campaign, asked)) {
    const std::string lack = lack_of_levels(fitted, laws.what, whose(laws.what));
    if (lack.empty()) continue;
    for (const auto& [parameter, order] : laws.orders) {
      if (order == 0) continue;
      const LineOfFile place = place_of(campaign, laws.what, parameter);
      throw OptionError(
          place.file, place.line,
          fmt::format("a law in the {} of '{}', and {}, or ", laws.what, parameter, lack) + laws.of(parameter) + ":0");
    }
  }
}

}  // namespace hysteron

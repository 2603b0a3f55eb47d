#include "diagnose/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnose/residual/conditions.hpp"
#include "diagnose/search/wording.hpp"

namespace hysteron {
std::optional<ColumnTold> unused_column(const Workbench& bench, const ByRecording& base) {
  const std::vector<RecordedCondition> conditions = conditions_of(bench.split().fit);
  if (!base.told() || std::ranges::none_of(conditions, &RecordedCondition::unused)) {
    return {};
  }
  const std::vector<Handle>& handles = base.handles;
  const Layout& layout = *base.joint.layout;
  const std::optional<FollowedColumn> found = followed_column(base.quadratics, conditions);
  if (!found) {
    return {};
  }
  ColumnTold result{found->name,   found->low, found->high, std::sqrt(found->together), std::sqrt(found->along),
                    found->chance, {}};
  std::vector<std::size_t> order(handles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t h) { return found->cost(static_cast<Eigen::Index>(h)); });
  for (const std::size_t h : order) {
    const auto at = static_cast<Eigen::Index>(h);
    if (found->cost(at) > least_difference * (found->together - found->along)) {
      const Parameter& card = layout.cards()[handles[h].parameter];
      result.changes.push_back({layout.names()[handles[h].parameter], std::string(name_of(card.role)),
                                handles[h].factor ? "" : std::string(card.unit), found->change(at)});
    }
  }
  return result;
}

std::string sentence_of(const ColumnTold& column) {
  std::vector<std::string> changes;
  for (const ColumnTold::Change& row : column.changes) {
    const std::string name = row.meaning.empty() ? row.parameter : row.meaning + " (" + row.parameter + ")";
    changes.push_back(row.unit.empty()
                          ? fmt::format("{} {:+.0f} %", name, 100.0 * row.value)
                          : fmt::format("{} {:+.3g}{}", name, row.value, row.unit == "1" ? "" : " " + row.unit));
  }
  return fmt::format(
      "the parameters follow the recorded '{}', which no model uses: from {:.3g} to {:.3g} {}; all recordings together "
      "NRMSE {:.2g}, with parameters that follow it about {:.2g}; dealt to the recordings by lot, it does as well "
      "with a probability of {:.1g}",
      column.name, column.low, column.high, joined(changes, " and "), column.together, column.along, column.chance);
}

nlohmann::json column_json(const ColumnTold& column) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const ColumnTold::Change& row : column.changes) {
    parameters.push_back({{"name", row.parameter},
                          {"change", row.value},
                          {"unit", row.unit.empty() ? nlohmann::json(nullptr) : nlohmann::json(row.unit)}});
  }
  return {{"name", column.name},         {"from", column.low},
          {"to", column.high},           {"nrmse_together", column.together},
          {"nrmse_along", column.along}, {"chance", column.chance},
          {"parameters", parameters}};
}

}  // namespace hysteron

#include "task/fit_quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "task/coordinate_name.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

// A list of more is in the map.
constexpr std::size_t most_pairs_told = 3;

std::string note_of(const std::vector<Correlations::Pair>& pairs, const std::vector<std::string>& names) {
  const auto told = [&](const Correlations::Pair& pair) {
    return fmt::format("{} and {} (r = {:.3f})", names[pair.first], names[pair.second], pair.r);
  };
  const auto count = static_cast<std::size_t>(
      std::ranges::count_if(pairs, [](const Correlations::Pair& pair) { return std::fabs(pair.r) >= inseparable; }));
  if (count == 0) {
    return "These recordings separate every two parameters; the strongest correlation is that of " +
           told(pairs.front()) + ".";
  }
  std::string list;
  for (std::size_t k = 0; k < std::min(count, most_pairs_told); ++k) {
    list += (k == 0 ? "" : "; ") + told(pairs[k]);
  }
  if (count > most_pairs_told) {
    list += fmt::format("; and {} more {}", count - most_pairs_told, count - most_pairs_told == 1 ? "pair" : "pairs");
  }
  return "These recordings do not separate " + list +
         ": they fix a combination of the two, and either may be wrong as long as the other makes up for it.";
}

}  // namespace

json correlation_json(const Identification& result, DriveKind drive) {
  if (!result.correlations || result.correlations->coordinates.size() < 2) {
    return nullptr;
  }
  const Correlations& found = *result.correlations;
  std::vector<std::string> names;
  for (const std::size_t c : found.coordinates) {
    names.push_back(coordinate_name(result.layout, c, drive));
  }
  json values = json::array();
  for (Eigen::Index i = 0; i < found.values.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < found.values.cols(); ++j) {
      row.push_back(found.values(i, j));
    }
    values.push_back(std::move(row));
  }
  const std::vector<Correlations::Pair> pairs = found.pairs();
  json together = json::array();
  for (const Correlations::Pair& pair : pairs) {
    if (std::fabs(pair.r) >= inseparable) {
      together.push_back({{"parameters", {names[pair.first], names[pair.second]}}, {"r", pair.r}});
    }
  }
  return {{"names", names}, {"values", values}, {"inseparable", together}, {"note", note_of(pairs, names)}};
}

json sensitivity_json(const Identification& result) {
  json rows = json::array();
  for (const ScaledSensitivity& one : result.sensitivities) {
    rows.push_back({{"parameter", result.layout.names()[one.parameter]},
                    {"value", std::isfinite(one.value) ? json(one.value) : json(nullptr)}});
  }
  return rows;
}

json starts_json(const RunResult& run) {
  if (run.ends.cost.size() < 2) {
    return nullptr;
  }
  std::vector<double> costs = run.ends.cost;
  std::ranges::sort(costs);
  const auto reached =
      std::ranges::count_if(costs, [&](double cost) { return cost <= costs.front() * (1.0 + run.ends.same); });
  return {{"costs", costs},
          {"reached", reached},
          {"same", run.ends.same},
          {"screened", run.ends.screened},
          {"diverged", run.ends.diverged}};
}

}  // namespace hysteron

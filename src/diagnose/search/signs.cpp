#include "diagnose/search/signs.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/squared.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/stage.hpp"

namespace hysteron {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;  // coordinates

// Of a parameter that follows nothing and is searched.
std::optional<std::size_t> coordinate_of(const Layout& layout, const std::string& name) {
  const auto law = std::ranges::find_if(layout.laws(), [&](const ParameterLaw& one) {
    return layout.names()[one.parameter] == name && one.count() == 1;
  });
  return law == layout.laws().end() ? std::nullopt : std::optional(law->first);
}

bool opposed(const Layout& layout, const std::vector<double>& point, const Pair& pair) {
  return layout.physical(pair.first, point[pair.first]) * layout.physical(pair.second, point[pair.second]) < 0.0;
}

std::vector<Pair> opposed_pairs(const Fit& fit) {
  std::vector<Pair> result;
  for (const std::string& effect : fit.what.effects) {
    for (const SameSign& said : knowledge_of(effect).same_sign) {
      const auto one = coordinate_of(*fit.layout, effect + "." + std::string(said.parameter));
      const auto other = coordinate_of(*fit.layout, effect + "." + std::string(said.other));
      if (one && other && opposed(*fit.layout, fit.point, {*one, *other})) result.emplace_back(*one, *other);
    }
  }
  return result;
}

std::vector<double> mirrored(const Layout& layout, std::vector<double> point, std::size_t coordinate) {
  point[coordinate] = std::clamp(layout.unit(coordinate, -layout.physical(coordinate, point[coordinate])), 0.0, 1.0);
  return point;
}

}  // namespace

std::optional<Fit> turned_round(const Workbench& bench, const Fit& fit) {
  std::optional<Fit> result;
  for (const Pair& pair : opposed_pairs(fit)) {
    const Fit& from = result ? *result : fit;
    const Starts starts{
        from.layout,
        {mirrored(*from.layout, from.point, pair.first), mirrored(*from.layout, from.point, pair.second)},
        from.point,
        {}};
    Fit turned = bench.from_starts(from.what, starts, fitting_rounds, starts.points.size());
    const bool as_good = squared(turned.cost) <= (1.0 + least_gain_of_a_place) * squared(from.cost);
    if (as_good && !opposed(*turned.layout, turned.point, pair)) result = std::move(turned);
  }
  return result;
}

}  // namespace hysteron

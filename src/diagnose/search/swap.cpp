#include "diagnose/search/swap.hpp"

#include <algorithm>

#include "diagnose/residual/misfit.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr int adding_rounds = 4;     // of the descent after each effect that is added
constexpr int comparing_rounds = 6;  // of the descents that are compared
// Other laws behind which the effects are tried: fewer where a simulation takes several times as long.
constexpr std::size_t laws_tried = 2;
constexpr std::size_t laws_tried_in_series = 1;

Swap swapped(const Workbench& bench, const Fit& law, const std::vector<std::string>& effects) {
  Fit full = law;
  for (const std::string& effect : effects) {
    full = bench.from_fit(with(full.what, effect_extension(effect)), full, adding_rounds);
  }
  full = bench.polished(full, comparing_rounds);
  Swap result{law.what.model, squared(law.cost), squared(full.cost), {}};
  std::vector<Hypothesis> less;
  for (const std::string& effect : effects) {
    less.push_back(without(full.what, effect_extension(effect)));
  }
  if (less.size() == 1) {
    result.without = {squared(law.cost)};
    return result;
  }
  for (const Fit& fit : bench.from_fit(less, full, comparing_rounds)) {
    result.without.push_back(squared(fit.cost));
  }
  return result;
}

}  // namespace

std::vector<Swap> swaps(const Workbench& bench, const Fit& base, const std::vector<Fit>& laws,
                        const std::vector<std::string>& effects) {
  std::vector<const Fit*> order;
  for (const Fit& law : laws) {
    if (squared(law.cost) < comparable * squared(base.cost)) {
      order.push_back(&law);
    }
  }
  std::ranges::stable_sort(order, {}, [](const Fit* fit) { return fit->cost; });
  const bool series = std::ranges::any_of(effects, in_series);
  order.resize(std::min(order.size(), series ? laws_tried_in_series : laws_tried));
  std::vector<Swap> result(order.size());
  const Workbench each = bench.shared_by(order.size());
  parallel_for(order.size(), bench.options().threads,
               [&](std::size_t k) { result[k] = swapped(each, *order[k], effects); });
  return result;
}

}  // namespace hysteron

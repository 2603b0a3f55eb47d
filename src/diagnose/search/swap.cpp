#include "diagnose/search/swap.hpp"

#include <algorithm>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/counting.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr int adding_rounds = 4;     // of the descent after each effect that is added
constexpr int comparing_rounds = 6;  // of the descents that are compared
// Other laws behind which the effects are tried: fewer where a simulation takes several times as long.
constexpr std::size_t laws_tried = 2;
constexpr std::size_t laws_tried_in_series = 1;

// Descents of `swapped`: all effects are added in turn, polished together, and of several each is taken out.
std::size_t descents_of(const std::vector<std::string>& effects) {
  return effects.size() + 1 + (effects.size() > 1 ? effects.size() : 0);
}

Swap swapped(const Workbench& bench, const Fit& law, const std::vector<std::string>& effects, Counting& counting) {
  Fit full = law;
  for (const std::string& effect : effects) {
    full = bench.from_fit(with(full.what, effect_extension(effect)), full, adding_rounds);
    counting.add();
  }
  full = bench.polished(full, comparing_rounds);
  counting.add();
  Swap result{law.what.model, squared(law.cost), squared(full.cost), {}};
  std::vector<Hypothesis> less;
  for (const std::string& effect : effects) {
    less.push_back(without(full.what, effect_extension(effect)));
  }
  if (less.size() == 1) {
    result.without = {squared(law.cost)};
    return result;
  }
  result.without.resize(less.size());
  const Workbench each = bench.shared_by(less.size());
  parallel_for(less.size(), bench.options().threads, [&](std::size_t k) {
    result.without[k] = squared(each.from_fit(less[k], full, comparing_rounds).cost);
    counting.add();
  });
  return result;
}

}  // namespace

std::vector<Swap> swaps(const Workbench& bench, const Fit& base, const std::vector<Fit>& laws,
                        const std::vector<std::string>& effects, const std::function<void(double share)>& done) {
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
  Counting counting(order.size() * descents_of(effects), done);
  parallel_for(order.size(), bench.options().threads,
               [&](std::size_t k) { result[k] = swapped(each, *order[k], effects, counting); });
  return result;
}

}  // namespace hysteron

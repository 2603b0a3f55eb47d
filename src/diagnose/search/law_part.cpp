#include "diagnose/search/law_part.hpp"

#include <algorithm>

#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/swap.hpp"

namespace hysteron {
namespace {

// `model` with the effects and richer laws of `what` that it can have.
Hypothesis behind(const std::string& model, Hypothesis what) {
  what.model = model;
  const std::vector<std::string> names = make_model(model, what.effects).parameter_names();
  std::erase_if(what.richer, [&](const std::string& name) { return std::ranges::find(names, name) == names.end(); });
  return what;
}

std::vector<Extension> effects_but(const Extension& part, const std::vector<std::string>& ids) {
  std::vector<Extension> result;
  for (const std::string& id : ids) {
    if (effect_extension(id) != part) {
      result.push_back(effect_extension(id));
    }
  }
  return result;
}

// The fit of `law` alone, of those at hand.
const Fit* fit_of_law(const std::string& law, const Search& asked) {
  if (asked.base.what.model == law) return &asked.quick_base;
  const auto at = std::ranges::find_if(asked.other_laws, [&](const Fit& fit) {
    return fit.what == Hypothesis{law, {}, {}};
  });
  return at == asked.other_laws.end() ? nullptr : &*at;
}

}  // namespace

void take_parts_of_law(Search& behind_law, const Search& asked, const Workbench& quick, const SearchOptions& options,
                       const SearchProgress& progress) {
  const Fit& full = behind_law.quick_augmented;
  const std::string& law = full.what.model;
  const std::string& lacking = asked.base.what.model;
  for (const std::string& id : options.candidates) {
    const Extension part = effect_extension(id);
    const std::string rest = rest_of_law(id, law);
    if (rest.empty() || is_part_of(id, lacking) || contains(full.what, part)) {
      continue;
    }
    const Fit* rest_alone = fit_of_law(rest, asked);
    if (rest_alone == nullptr) {
      continue;
    }
    progress(0.0, "what " + law + " gains by " + name_of(part));
    Found found;
    found.part = part;
    found.of_law = law;
    const Hypothesis less = behind(rest, full.what);
    found.without = quick.from_fit(less, full, fitting_rounds, rest_alone);
    if (rest == lacking) {
      Fit from_asked = quick.from_fit(less, full, fitting_rounds, &asked.quick_augmented);
      if (from_asked.cost < found.without.cost) found.without = std::move(from_asked);
    }
    found.gain = squared(found.without.cost) - squared(full.cost);
    if (found.gain <= 0.0) {
      continue;
    }
    found.evidence = evidence(squared(found.without.cost), squared(full.cost),
                              static_cast<double>(full.dimension()) - static_cast<double>(found.without.dimension()),
                              behind_law.independent);
    found.alone = squared(rest_alone->cost) - squared(behind_law.quick_base.cost);
    const auto setting = [&](double share) {
      progress(0.5 + 0.5 * share, "setting " + name_of(part) + " against its rivals");
    };
    setting(0.0);
    for (const Tried& tried : stage(quick, found.without, effects_but(part, options.candidates), behind_law.independent,
                                    nullptr, effects_but(part, relatives(id)), setting)) {
      Rival rival{tried.part, tried.gain / found.gain, 0.0, tried.fit};
      if (tried.fit) {
        rival.evidence = evidence(squared(tried.fit->cost), squared(full.cost),
                                  static_cast<double>(full.dimension()) - static_cast<double>(tried.fit->dimension()),
                                  behind_law.independent);
      }
      found.rivals.push_back(std::move(rival));
    }
    std::ranges::stable_sort(found.rivals, [](const Rival& a, const Rival& b) { return a.share > b.share; });
    behind_law.found.push_back(std::move(found));
  }
}

}  // namespace hysteron

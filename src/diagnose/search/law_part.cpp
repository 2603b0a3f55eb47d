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

std::vector<Extension> in_its_place(const Extension& part, const Hypothesis& less, const SearchOptions& options) {
  std::vector<Extension> result;
  for (const std::string& id : options.candidates) {
    const Extension other = effect_extension(id);
    if (other != part && !contains(less, other)) {
      result.push_back(other);
    }
  }
  return result;
}

}  // namespace

void take_parts_of_law(Search& behind_law, const Search& asked, const Workbench& quick, const SearchOptions& options,
                       const SearchProgress& progress) {
  const Fit& with = behind_law.quick_augmented;
  const std::string& law = with.what.model;
  for (const std::string& id : options.candidates) {
    const Extension part = effect_extension(id);
    if (rest_of_law(id, law) != asked.base.what.model || contains(with.what, part)) {
      continue;
    }
    progress(0.0, "what " + law + " gains by " + name_of(part));
    Found found;
    found.part = part;
    found.of_law = law;
    const Hypothesis less = behind(asked.base.what.model, with.what);
    found.without = quick.from_fit(less, with, fitting_rounds, &asked.quick_augmented);
    found.gain = squared(found.without.cost) - squared(with.cost);
    if (found.gain <= 0.0) {
      continue;
    }
    found.evidence = evidence(squared(found.without.cost), squared(with.cost),
                              static_cast<double>(with.dimension()) - static_cast<double>(found.without.dimension()),
                              behind_law.independent);
    found.alone = squared(asked.quick_base.cost) - squared(behind_law.quick_base.cost);
    progress(0.3, "setting " + name_of(part) + " against its rivals");
    std::vector<Extension> kin;
    for (const std::string& relative : relatives(id)) {
      kin.push_back(effect_extension(relative));
    }
    for (const Tried& tried :
         stage(quick, found.without, in_its_place(part, less, options), behind_law.independent, nullptr, kin)) {
      Rival rival{tried.part, tried.gain / found.gain, 0.0, tried.fit};
      if (tried.fit) {
        rival.evidence = evidence(squared(tried.fit->cost), squared(with.cost),
                                  static_cast<double>(with.dimension()) - static_cast<double>(tried.fit->dimension()),
                                  behind_law.independent);
      }
      found.rivals.push_back(std::move(rival));
    }
    std::ranges::stable_sort(found.rivals, [](const Rival& a, const Rival& b) { return a.share > b.share; });
    behind_law.found.push_back(std::move(found));
    // With the part as an effect behind laws that lack it.
    behind_law.swaps = swaps(quick, behind_law.quick_base, behind_law.other_laws, effects_of(behind_law.found));
  }
}

}  // namespace hysteron

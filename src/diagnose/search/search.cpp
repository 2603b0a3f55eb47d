#include "diagnose/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/search/grow.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/observe.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/settle.hpp"
#include "diagnose/search/wording.hpp"

namespace hysteron {
namespace {

// Part of the misfit beyond the noise that another law takes off, above which this one is in question, and the effects
// that are looked for then.
constexpr double most_of_the_misfit = 0.5;
constexpr int effects_beside_a_better_law = 2;

// Richer laws that were found are no effects, but for a yield force that saturates.
void name_laws(Search& result) {
  std::erase_if(result.found, [&](Found& found) {
    if (!found.part.is_law()) {
      return false;
    }
    result.richer.push_back(found.part.parameters.front());
    if (!saturates(result.base, result.augmented, result.richer.back(), result.first_stage)) {
      return true;
    }
    found.by_law = result.richer.back();
    found.part = effect_extension(saturation);
    std::erase_if(found.rivals, [&](const Rival& rival) { return rival.part == found.part; });
    return false;
  });
}

}  // namespace

std::string Search::richer_dependence() const {
  std::set<std::string> parameters(richer.begin(), richer.end());
  for (const Found& one : found) {
    if (one.by_law) parameters.erase(*one.by_law);  // told as an effect
  }
  if (parameters.empty()) return {};
  return "a richer dependence of " + joined(parameters, " and ") + " on the drive";
}

Search search(const Workbench& bench, const Workbench& fine, const Hypothesis& base, const SearchOptions& options,
              const SearchProgress& progress) {
  Search result;
  progress(0.0, "fitting " + base.model);
  result.quick_base = bench.from_anywhere(base, options.base_budget);
  result.base = fine.polished(result.quick_base, fitting_rounds);
  result.base_misfit = misfit_of(fine, result.base);
  options.stands(result.quick_base);

  result.had_by_law = had_by_the_law(bench, result.quick_base, options.candidates);
  std::vector<Extension> effects;
  for (const std::string& id : options.candidates) {
    effects.push_back(effect_extension(id));
  }
  Course course{bench, base, result.quick_base, result.quick_base, options.stands, noise_of(bench)};
  for (const std::string& id : options.told) {
    course.told.push_back(effect_extension(id));
  }
  const Misfit left = misfit_of(bench, course.current);
  course.independent = left.independent;
  double tried = 0.0;
  double best_law = squared(result.quick_base.cost);
  for (const std::string& law : options.laws) {
    progress(0.05 + 0.05 * tried / static_cast<double>(options.laws.size()), "fitting other damper laws");
    tried += 1.0;
    if (base.model != law) {
      result.other_laws.push_back(bench.from_anywhere({law, {}, {}}, options.base_budget / 4));
      best_law = std::min(best_law, squared(result.other_laws.back().cost));
    }
  }
  // Where another law takes most of the misfit off, effects behind this one are mostly shapes of that: few are enough
  // to hold the two against each other.
  const double excess = std::max(left.squares - left.floor, 1e-300);
  const bool another = squared(result.quick_base.cost) - best_law > most_of_the_misfit * excess;
  result.limited = another && !options.in_full;
  // Then the search behind the other law is the longer part.
  const SearchProgress rest = result.limited ? within(progress, 0.05, 0.2) : progress;
  grow(course, effects,
       result.limited ? std::min(options.most_effects, effects_beside_a_better_law) : options.most_effects, rest);
  if (!course.stages.empty()) {
    result.first_stage = course.stages.front();
  }

  result.augmented = confirmed(course, fine, result.base, effects, rest, result.found);
  const Fit& current = course.current;
  result.independent = course.independent;
  result.quick_augmented = current;
  result.misfit = misfit_of(fine, result.augmented);
  for (Found& found : result.found) {
    if (found.without.what == base) {
      found.without = result.base;
    }
  }
  name_laws(result);
  std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
  return result;
}

void try_behind_other_laws(Search& search, const Workbench& quick, const std::function<void(double share)>& done) {
  double best_law = squared(search.quick_base.cost);
  for (const Fit& law : search.other_laws) {
    best_law = std::min(best_law, squared(law.cost));
  }
  const bool parts_of_law =
      std::ranges::any_of(search.found, [](const Found& found) { return found.of_law.has_value(); });
  // A law that does as well without them is tried with a search of its own.
  if (search.found.size() == 1 || parts_of_law ||
      (!search.found.empty() && best_law > squared(search.quick_augmented.cost))) {
    search.swaps = swaps(quick, search.quick_base, search.other_laws, effects_of(search.found), done);
  }
}

SearchProgress within(const SearchProgress& progress, double from, double to, const std::string& before) {
  return [&progress, from, to, before](double share, const std::string& stage) {
    progress(from + (to - from) * share, before + stage);
  };
}

}  // namespace hysteron

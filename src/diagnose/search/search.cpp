#include "diagnose/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// Rivals set against an effect in its place: the best of all stages.
constexpr std::size_t rival_count = 6;
// A form that holds a simpler one as its limit is taken for it only above this.
constexpr double wider_evidence = 3.0;
// Times that a rival takes the place of an effect: two could go on taking each other's.
constexpr int most_swaps = 3;
// No further effects are looked for once this is all that the last one added to what was explained: the next could not
// be named ...
constexpr double negligible = 0.05;
// ... or once only this part of the noise is left above it, which it is not known to.
constexpr double unsure_of_noise = 0.05;
// Where the effects take less than this many times what they leave off the squared error, the verdict asks whether
// anything else would help.
constexpr double near_what_stays = 2.0;

// The same parts, whatever their order of discovery.
bool same_parts(const Hypothesis& a, const Hypothesis& b) {
  return a.model == b.model && std::ranges::is_permutation(a.effects, b.effects) &&
         std::ranges::is_permutation(a.richer, b.richer);
}

const ParameterLaw* law_of(const Layout& layout, const std::string& parameter) {
  const auto at = std::ranges::find_if(
      layout.laws(), [&](const ParameterLaw& law) { return layout.names()[law.parameter] == parameter; });
  return at == layout.laws().end() ? nullptr : &*at;
}

// A yield force that follows the drive in the base model, and in the richer one rises ever less with it: that is what
// magnetic saturation is, where the damping does not saturate with it.
bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter) {
  if (contains(augmented.what, saturation)) {
    return false;
  }
  const ParameterLaw* before = law_of(*base.layout, parameter);
  const ParameterLaw* law = law_of(*augmented.layout, parameter);
  if (before == nullptr || law == nullptr || before->drive_nodes.size() < 2) {
    return false;
  }
  if (augmented.layout->cards()[law->parameter].role != PhysicalRole::yield_force) {
    return false;
  }
  const double low = law->drive_nodes.front();
  const double high = law->drive_nodes.back();
  std::array<double, 5> values{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double drive = low + (high - low) * static_cast<double>(k) / static_cast<double>(values.size() - 1);
    values[k] =
        parameters_at(augmented.layout->held(), augmented.terms, drive, law->frequency_nodes.front())[law->parameter];
  }
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    if (values[k + 1] - values[k] > values[k] - values[k - 1] || values[k + 1] < values[k]) {
      return false;
    }
  }
  return true;
}

// The hypotheses that came closest at any stage.
std::vector<std::string> closest(const std::vector<std::vector<Tried>>& stages, std::size_t count) {
  std::vector<std::pair<double, std::string>> ranked;
  for (const std::vector<Tried>& stage : stages) {
    for (const Tried& tried : stage) {
      const double best = std::max(stage.front().gain, 1e-300);
      const auto known = std::ranges::find(ranked, tried.id, &std::pair<double, std::string>::second);
      if (known == ranked.end()) {
        ranked.emplace_back(-tried.gain / best, tried.id);
      } else {
        known->first = std::min(known->first, -tried.gain / best);
      }
    }
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<double, std::string>::first);
  std::vector<std::string> result;
  for (std::size_t k = 0; k < std::min(count, ranked.size()); ++k) {
    result.push_back(ranked[k].second);
  }
  return result;
}

// A search as it goes.
struct Course {
  const Workbench& bench;
  const Hypothesis& base;
  const Fit& quick_base;
  Fit current;
  double effective = 0.0;                       // samples worth of independent information
  double strongest = 0.0;                       // the largest gain of a stage whose form may be missed in part
  std::vector<std::vector<Tried>> stages = {};  // in the order tried
  std::vector<Hypothesis> behind = {};          // what each was tried behind
  std::vector<Fit> seen = {};                   // all fits so far
  int swaps = 0;                                // of an effect for its rival
};

// Adds the best candidate while one is worth a place and more than noise is left.
void grow(Course& course, const std::vector<std::string>& candidates, int most_effects,
          const SearchProgress& progress) {
  const auto count = static_cast<double>(candidates.size());
  for (int depth = 0; depth < most_effects; ++depth) {
    progress(0.1 + 0.6 * depth / most_effects, "trying " + std::to_string(candidates.size()) + " hypotheses behind " +
                                                   std::to_string(course.current.what.effects.size()) + " effects");
    std::vector<Tried> tried = stage(course.bench, course.current, candidates, course.effective);
    // What a good model leaves tells the independent samples better than what a bad one does.
    if (!tried.empty()) {
      course.effective = std::max(course.effective, misfit_of(course.bench, tried.front().fit).independent);
      for (Tried& one : tried) {
        one = weighed(one.id, one.fit, course.current, course.effective);
      }
      std::ranges::stable_sort(tried, [](const Tried& a, const Tried& b) { return a.evidence > b.evidence; });
    }
    course.stages.push_back(tried);
    course.behind.push_back(course.current.what);
    const auto chosen =
        std::ranges::find_if(tried, [&](const Tried& one) { return worth(one, course.current, count); });
    if (chosen == tried.end()) {
      return;
    }
    course.current = chosen->fit;
    if (!has_one_form(chosen->id)) {
      course.strongest = std::max(course.strongest, chosen->gain);
    }
    if (chosen->gain < negligible * course.strongest) {
      return;  // what is left could not be named beside what was found
    }
    const Misfit left = misfit_of(course.bench, course.current);
    if (!structured(left) && left.squares < (1.0 + unsure_of_noise) * left.floor) {
      return;
    }
  }
}

// What the current model loses without one of its parts, the rest refitted.
Found taken_out(const Course& course, const std::string& id) {
  const Hypothesis less = without(course.current.what, id);
  Found found;
  found.id = id;
  found.without = less == course.base ? course.quick_base : course.bench.from_fit(less, course.current, fitting_rounds);
  if (found.without.cost > course.quick_base.cost) {
    // The base is among what is left: the descent from the fuller model went astray.
    found.without = course.bench.from_fit(less, course.quick_base, fitting_rounds);
  }
  // Descents go astray; what was reached before with the same parts is no less true.
  for (const Fit& fit : course.seen) {
    if (same_parts(fit.what, less) && fit.cost < found.without.cost) {
      found.without = fit;
    }
  }
  found.gain = squared(found.without.cost) - squared(course.current.cost);
  found.evidence =
      evidence(squared(found.without.cost), squared(course.current.cost),
               static_cast<double>(course.current.dimension()) - static_cast<double>(found.without.dimension()),
               course.effective);
  return found;
}

// Everything that is set in the place of a part: what came closest, and its relatives among the candidates. A rival is
// judged from the best start it can have: the damper's parameters without the effect, and with it.
std::vector<Tried> rivals_of(const Course& course, const Found& found, const std::vector<std::string>& candidates) {
  std::vector<std::string> others;
  for (const std::string& other : closest(course.stages, rival_count)) {
    if (other != found.id && !contains(course.current.what, other)) {
      others.push_back(other);
    }
  }
  for (const std::string& other : relatives(found.id)) {
    if (std::ranges::find(candidates, other) != candidates.end() && std::ranges::find(others, other) == others.end() &&
        !contains(course.current.what, other)) {
      others.push_back(other);
    }
  }
  std::vector<Tried> rivals = stage(course.bench, found.without, others, course.effective, &course.current);
  if (same_parts(found.without.what, course.base) && !course.stages.empty()) {
    for (const Tried& tried : course.stages.front()) {
      const auto again = std::ranges::find(rivals, tried.id, &Tried::id);
      if (again == rivals.end()) {
        rivals.push_back(tried);
      } else if (tried.fit.cost < again->fit.cost) {
        *again = tried;
      }
    }
  }
  std::erase_if(rivals, [&](const Tried& rival) { return rival.id == found.id; });
  return rivals;
}

// Sets the part against its rivals. The fit with one in its place that does clearly better, if any.
std::optional<Fit> contested(Course& course, Found& found, const std::vector<std::string>& candidates) {
  std::optional<Fit> better;
  for (const Tried& rival : rivals_of(course, found, candidates)) {
    Rival row;
    row.id = rival.id;
    row.share = rival.gain / found.gain;
    row.fit = rival.fit;
    course.seen.push_back(rival.fit);
    row.evidence = evidence(
        squared(rival.fit.cost), squared(course.current.cost),
        static_cast<double>(course.current.dimension()) - static_cast<double>(rival.fit.dimension()), course.effective);
    // A wider form must be worth its further parameters.
    const double asked = is_limit(rival.id, found.id) ? wider_evidence : -least_evidence_of_a_place;
    if (row.evidence < asked && (!better || rival.fit.cost < better->cost)) {
      better = rival.fit;
    }
    found.rivals.push_back(row);
  }
  std::ranges::stable_sort(found.rivals, [](const Rival& a, const Rival& b) { return a.share > b.share; });
  return better;
}

// The effects of a hypothesis, and its richer laws, each once however many orders it has more.
std::vector<std::string> parts_of(const Hypothesis& what) {
  std::vector<std::string> parts = what.effects;
  for (const std::string& name : what.richer) {
    if (const std::string id = law_of_parameter(name); std::ranges::find(parts, id) == parts.end()) {
      parts.push_back(id);
    }
  }
  return parts;
}

// A richer law taken out with all its orders, of which the highest may add little to the others; any other part as it
// was.
Found taken_out_wholly(const Course& course, Found found) {
  if (!is_law(found.id)) {
    return found;
  }
  const std::string id = found.id;
  const std::string name = parameter_of_law(id);
  std::string orders = id;
  for (auto k = std::ranges::count(course.current.what.richer, name); k > 1; --k) {
    orders += "," + name;
  }
  if (orders != id) {
    found = taken_out(course, orders);
    found.id = id;
  }
  return found;
}

// Every part of the current model taken out in turn, until none is found that stopped helping; such a one is dropped.
std::vector<Found> worth_their_place(Course& course) {
  std::vector<Found> result;
  for (bool dropped = true; dropped;) {
    dropped = false;
    result.clear();
    for (const std::string& id : parts_of(course.current.what)) {
      Found found = taken_out(course, id);
      if (found.evidence < least_evidence_of_a_place ||
          found.gain < least_gain_of_a_place * squared(found.without.cost)) {
        course.current = found.without;
        dropped = true;
        break;
      }
      result.push_back(taken_out_wholly(course, std::move(found)));
    }
  }
  return result;
}

// Drops what stopped helping, sets each part against its rivals, and takes a rival that does clearly better; again
// until nothing changes.
std::vector<Found> settled(Course& course, const std::vector<std::string>& candidates) {
  for (const std::vector<Tried>& tried : course.stages) {
    for (const Tried& one : tried) {
      course.seen.push_back(one.fit);
    }
  }
  while (true) {
    std::vector<Found> result = worth_their_place(course);
    double strongest = 0.0;
    for (const Found& found : result) {
      if (!has_one_form(found.id)) {
        strongest = std::max(strongest, found.gain);
      }
    }
    bool swapped = false;
    for (Found& found : result) {
      if (found.gain < negligible * strongest) {
        continue;
      }
      const std::optional<Fit> better = contested(course, found, candidates);
      if (better && course.swaps < most_swaps) {
        ++course.swaps;
        course.current = *better;
        swapped = true;
        break;
      }
    }
    if (!swapped) {
      return result;
    }
  }
}

// Evidence of the best further hypothesis behind the current model.
double best_further(const Course& course, const std::vector<std::string>& candidates) {
  const auto at = std::ranges::find_if(course.behind,
                                       [&](const Hypothesis& what) { return same_parts(what, course.current.what); });
  const std::vector<Tried> next = at == course.behind.end()
                                      ? stage(course.bench, course.current, candidates, course.effective)
                                      : course.stages[static_cast<std::size_t>(at - course.behind.begin())];
  return next.empty() ? 0.0 : std::max(0.0, next.front().evidence);
}

// Richer laws that were found are no effects, but for a yield force that saturates.
void name_laws(Search& result) {
  std::erase_if(result.found, [&](Found& found) {
    if (!is_law(found.id)) {
      return false;
    }
    result.richer.push_back(parameter_of_law(found.id));
    if (!saturates(result.base, result.augmented, result.richer.back())) {
      return true;
    }
    found.by_law = result.richer.back();
    found.id = saturation;
    std::erase_if(found.rivals, [](const Rival& rival) { return rival.id == saturation; });
    return false;
  });
}

}  // namespace

Search search(const Workbench& bench, const Workbench& fine, const Hypothesis& base, const SearchOptions& options,
              const SearchProgress& progress) {
  Search result;
  progress(0.0, "fitting " + base.model);
  result.quick_base = bench.from_anywhere(base, options.base_budget);
  result.base = fine.polished(result.quick_base, fitting_rounds);
  result.base_misfit = misfit_of(fine, result.base);

  std::vector<std::string> candidates = options.candidates;
  const std::vector<std::string> laws = law_candidates(bench, base);
  candidates.insert(candidates.end(), laws.begin(), laws.end());

  Course course{bench, base, result.quick_base, result.quick_base};
  course.effective = misfit_of(bench, course.current).independent;
  grow(course, candidates, options.most_effects, progress);
  if (!course.stages.empty()) {
    result.first_stage = course.stages.front();
    result.promising = promising(course.stages.back());
  }

  progress(0.7, "setting each effect against its rivals");
  result.found = settled(course, options.candidates);
  const Fit& current = course.current;
  if (!result.found.empty() && squared(result.quick_base.cost) < (1.0 + near_what_stays) * squared(current.cost)) {
    result.further = best_further(course, candidates);
  }

  if (!result.found.empty() || structured(result.base_misfit)) {
    progress(0.75, "fitting other damper laws");
    for (const char* law : {"bouc-wen", "hyperbolic-tangent", "algebraic-hysteresis", "modified-dahl", "lugre"}) {
      if (base.model == law || find_model(law) == nullptr) {
        continue;
      }
      result.other_laws.push_back(bench.from_anywhere({law, {}, {}}, options.base_budget / 2));
    }
  }
  if (!result.found.empty()) {
    const auto strong = std::ranges::max_element(result.found, {}, &Found::gain);
    if (!is_law(strong->id)) {
      result.tried = strong->id;
      std::vector<Fit> judges = result.other_laws;
      std::erase_if(judges, [&](const Fit& law) { return is_part_of(strong->id, law.what.model); });
      result.trials =
          trials_of(bench, strong->id, current, strong->without, result.quick_base, judges, course.effective);
    }
  }

  progress(0.8, "fitting the augmented model to more samples");
  result.effective = course.effective;
  result.quick_augmented = current;
  for (Found& found : result.found) {
    if (acts_in_a_part(found.id)) {
      found.locality = locality_of(bench, current, found.without, found.id);
    }
  }
  result.augmented = current.what == base ? result.base : fine.polished(current, screening_rounds);
  result.misfit = misfit_of(fine, result.augmented);
  if (!result.found.empty()) {
    result.recurrence = recurrence_of(fine, result.augmented);
  }
  for (Found& found : result.found) {
    if (found.without.what == base) {
      found.without = result.base;
    }
    found.share_of_misfit = std::clamp(
        found.gain / std::max(result.base_misfit.squares - result.misfit.squares + result.misfit.structure, 1e-300),
        0.0, 1.0);
  }
  name_laws(result);
  std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
  return result;
}

}  // namespace hysteron

#include "diagnose/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// Rivals set against an effect in its place: the best of all stages.
constexpr std::size_t rival_count = 6;
// A form that holds a simpler one as its limit is taken for it only above this.
constexpr double wider_evidence = 3.0;
// Times that a rival takes the place of an effect: two could go on taking each other's.
constexpr int most_swaps = 3;
// No further effects are looked for once this is all that the last one added to what was explained ...
constexpr double negligible = 0.05;
// ... or once only this part of the noise is left above it, which it is not known to.
constexpr double unsure_of_noise = 0.05;
// Where this many times the squares of the noise stay, the model is asked for more, down to small gains.
constexpr double far_from_noise = 4.0;
// Stages of a search, richer laws among them.
constexpr std::size_t most_stages = 8;
// Part of the misfit beyond the noise that another law takes off, above which this one is in question, and the effects
// that are looked for then.
constexpr double most_of_the_misfit = 0.5;
constexpr int effects_beside_a_better_law = 2;
// Other laws behind which the effects are tried.
constexpr std::size_t laws_tried = 2;

const ParameterLaw* law_of(const Layout& layout, const std::string& parameter) {
  const auto at = std::ranges::find_if(
      layout.laws(), [&](const ParameterLaw& law) { return layout.names()[law.parameter] == parameter; });
  return at == layout.laws().end() ? nullptr : &*at;
}

// A yield force that follows the drive in the base model, and in the richer one rises ever less with it: that is what
// magnetic saturation is, where the damping does not saturate with it.
bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter) {
  if (contains(augmented.what, effect_extension(saturation))) {
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

// The effects that came closest at any stage.
std::vector<Extension> closest(const std::vector<std::vector<Tried>>& stages, std::size_t count) {
  std::vector<std::pair<double, Extension>> ranked;
  for (const std::vector<Tried>& stage : stages) {
    double best = 1e-300;
    for (const Tried& tried : stage) {
      best = std::max(best, tried.gain);
    }
    for (const Tried& tried : stage) {
      const auto known = std::ranges::find(ranked, tried.part, &std::pair<double, Extension>::second);
      if (known == ranked.end()) {
        ranked.emplace_back(-tried.gain / best, tried.part);
      } else {
        known->first = std::min(known->first, -tried.gain / best);
      }
    }
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<double, Extension>::first);
  std::vector<Extension> result;
  for (std::size_t k = 0; k < std::min(count, ranked.size()); ++k) {
    result.push_back(ranked[k].second);
  }
  return result;
}

bool cannot_be_missed(const Extension& part) { return !part.is_law() && has_one_form(part.effect); }

std::string joined_names(const Hypothesis& what) {
  std::string text;
  for (const Extension& part : extensions_of(what)) {
    text += (text.empty() ? "" : " + ") + name_of(part);
  }
  return text;
}

// A search as it goes.
struct Course {
  const Workbench& bench;
  const Hypothesis& base;
  const Fit& quick_base;
  Fit current;
  std::vector<double> noise;                    // of each recording
  double independent = 0.0;                     // samples worth of independent information
  double strongest = 0.0;                       // the largest gain of a stage whose form may be missed in part
  std::vector<std::vector<Tried>> stages = {};  // in the order tried
  std::vector<Fit> seen = {};                   // all fits so far
  int swaps = 0;                                // of an effect for its rival
};

// By the noise of the force alone: what the noise of the motion makes of the model's force, another model need not.
bool is_far(const Misfit& left) { return left.squares > far_from_noise * (left.floor - left.motion); }

// Everything that may join the current model: effects, one order more for a parameter law, and where much is left, all
// parameters that follow the drive by a richer curve.
std::vector<Extension> open_to(const Course& course, const std::vector<Extension>& effects, const Misfit& left) {
  std::vector<Extension> result;
  const bool far = is_far(left);
  const bool has_series = std::ranges::any_of(course.current.what.effects, in_series);
  for (const Extension& effect : effects) {
    // A second element in series only where much is left: what is small behind the first is its form.
    if (far || !has_series || !in_series(effect.effect)) {
      result.push_back(effect);
    }
  }
  std::vector<Extension> laws = law_candidates(course.bench, course.current.what);
  if (far) {
    const std::vector<Extension> joint = joint_law_candidates(course.bench, course.current.what);
    laws.insert(laws.end(), joint.begin(), joint.end());
  }
  result.insert(result.end(), laws.begin(), laws.end());
  return result;
}

// Adds the best candidate while one is worth a place, predicts recordings left out better, and more than noise is left.
void grow(Course& course, const std::vector<Extension>& effects, int most_effects, const SearchProgress& progress) {
  LeftOut before = left_out(course.bench, course.current);
  Misfit left = misfit_of(course.bench, course.current);
  int added = 0;
  while (added < most_effects && course.stages.size() < most_stages) {
    const std::vector<Extension> candidates = open_to(course, effects, left);
    const auto count = static_cast<double>(candidates.size());
    progress(0.1 + 0.5 * added / most_effects, added == 0
                                                   ? "looking at " + std::to_string(candidates.size()) + " hypotheses"
                                                   : "looking for more behind " + joined_names(course.current.what));
    std::vector<Tried> tried = stage(course.bench, course.current, candidates, course.independent);
    // What a good model leaves tells the independent samples better than what a bad one does.
    if (!tried.empty() && tried.front().fit) {
      course.independent = std::max(course.independent, misfit_of(course.bench, *tried.front().fit).independent);
      for (Tried& one : tried) {
        if (one.fit) {
          one = weighed(one.part, *one.fit, one.gain + squared(one.fit->cost), course.current.dimension(),
                        course.independent);
        }
      }
      std::ranges::stable_sort(tried, better);
    }
    course.stages.push_back(tried);
    std::optional<LeftOut> after;
    const auto chosen = std::ranges::find_if(tried, [&](const Tried& one) {
      if (!one.fit || one.gain < least_gain_of_a_place * squared(course.current.cost)) {
        return false;
      }
      after = left_out(course.bench, *one.fit);
      const bool is_series = in_series(one.part.effect);
      const LeftOut without = is_series ? left_out_beside(course.bench, course.current, one.part) : before;
      return worth(one, course.current, count, block_score(without.predicted, after->predicted, course.noise),
                   is_far(left));
    });
    if (chosen == tried.end()) {
      return;
    }
    course.current = *chosen->fit;
    before = std::move(*after);
    added += chosen->part.is_law() ? 0 : 1;
    if (!cannot_be_missed(chosen->part)) {
      course.strongest = std::max(course.strongest, chosen->gain);
    }
    left = misfit_of(course.bench, course.current);
    if (!is_far(left) && chosen->gain < negligible * course.strongest) {
      return;  // what is left could not be named beside what was found
    }
    if (!structured(left) && left.squares < (1.0 + unsure_of_noise) * left.floor) {
      return;
    }
  }
}

// What the current model loses without one of its parts, the rest refitted.
Found taken_out(const Course& course, const Extension& part) {
  const Hypothesis less = without(course.current.what, part);
  Found found;
  found.part = part;
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
  const std::optional<Fit> neutral = course.bench.beside(found.without, part);
  const double squares = squared(std::min(found.without.cost, neutral ? neutral->cost : found.without.cost));
  found.gain = squares - squared(course.current.cost);
  found.evidence =
      evidence(squares, squared(course.current.cost),
               static_cast<double>(course.current.dimension()) - static_cast<double>(found.without.dimension()),
               course.independent);
  return found;
}

// What is set in the place of a part: what came closest, and its relatives among the candidates. A rival is judged from
// the best start it can have: the damper's parameters without the effect, and with it.
std::vector<Tried> rivals_of(const Course& course, const Found& found, const std::vector<Extension>& candidates) {
  std::vector<Extension> others;
  for (const Extension& other : closest(course.stages, rival_count)) {
    if (other != found.part && !contains(course.current.what, other)) {
      others.push_back(other);
    }
  }
  std::vector<Extension> kin;
  if (!found.part.is_law()) {
    for (const std::string& id : relatives(found.part.effect)) {
      const Extension other = effect_extension(id);
      if (std::ranges::find(candidates, other) != candidates.end() && !contains(course.current.what, other)) {
        kin.push_back(other);
        if (std::ranges::find(others, other) == others.end()) {
          others.push_back(other);
        }
      }
    }
  }
  std::vector<Tried> rivals = stage(course.bench, found.without, others, course.independent, &course.current, kin);
  if (same_parts(found.without.what, course.base) && !course.stages.empty()) {
    for (const Tried& tried : course.stages.front()) {
      const auto again = std::ranges::find(rivals, tried.part, &Tried::part);
      if (again == rivals.end()) {
        rivals.push_back(tried);
      } else if (tried.fit && (!again->fit || tried.fit->cost < again->fit->cost)) {
        *again = tried;
      }
    }
  }
  std::erase_if(rivals, [&](const Tried& rival) { return rival.part == found.part; });
  return rivals;
}

// Sets the part against its rivals. The fit with one in its place that does clearly better, if any.
std::optional<Fit> contested(Course& course, Found& found, const std::vector<Extension>& candidates) {
  std::optional<Fit> better;
  for (const Tried& rival : rivals_of(course, found, candidates)) {
    Rival row{rival.part, rival.gain / found.gain, 0.0, rival.fit};
    if (!rival.fit) {
      found.rivals.push_back(row);
      continue;
    }
    course.seen.push_back(*rival.fit);
    row.evidence =
        evidence(squared(rival.fit->cost), squared(course.current.cost),
                 static_cast<double>(course.current.dimension()) - static_cast<double>(rival.fit->dimension()),
                 course.independent);
    // A wider form must be worth its further parameters.
    const bool wider = !rival.part.is_law() && !found.part.is_law() && is_limit(rival.part.effect, found.part.effect);
    const double asked = wider ? wider_evidence : -least_evidence_of_a_place;
    if (row.evidence < asked && (!better || rival.fit->cost < better->cost)) {
      better = rival.fit;
    }
    found.rivals.push_back(std::move(row));
  }
  std::ranges::stable_sort(found.rivals, [](const Rival& a, const Rival& b) { return a.share > b.share; });
  return better;
}

// A richer law taken out with all its orders, of which the highest may add little to the others; any other part as it
// was.
Found taken_out_wholly(const Course& course, const Extension& part, Found found) {
  if (part.is_law() && part.parameters.size() > 1) {
    found = taken_out(course, part);
  }
  return found;
}

// Every part of the current model taken out in turn, until none is found that stopped helping; such a one is dropped.
std::vector<Found> worth_their_place(Course& course) {
  std::vector<Found> result;
  for (bool dropped = true; dropped;) {
    dropped = false;
    result.clear();
    const LeftOut with = left_out(course.bench, course.current);
    const bool far = is_far(misfit_of(course.bench, course.current));
    for (const Extension& part : extensions_of(course.current.what)) {
      Found found = taken_out(course, part.is_law() ? law_extension({part.parameters.front()}) : part);
      const BlockScore score =
          block_score(left_out_beside(course.bench, found.without, part).predicted, with.predicted, course.noise);
      if (!worth_keeping(found.evidence, found.gain, squared(found.without.cost), score, far)) {
        course.current = found.without;
        dropped = true;
        break;
      }
      result.push_back(taken_out_wholly(course, part, std::move(found)));
    }
  }
  return result;
}

// Drops what stopped helping, sets each part against its rivals, and takes a rival that does clearly better; again
// until nothing changes.
std::vector<Found> settled(Course& course, const std::vector<Extension>& candidates, const SearchProgress& progress) {
  for (const std::vector<Tried>& tried : course.stages) {
    for (const Tried& one : tried) {
      if (one.fit) {
        course.seen.push_back(*one.fit);
      }
    }
  }
  while (true) {
    std::vector<Found> result = worth_their_place(course);
    bool swapped = false;
    double done = 0.0;
    double strongest = 0.0;
    for (const Found& found : result) {
      strongest = std::max(strongest, found.gain);
    }
    for (Found& found : result) {
      if (found.gain < negligible * strongest) {
        continue;  // too small beside the strongest to be told from what its form misses
      }
      progress(0.6 + 0.15 * done / static_cast<double>(result.size()),
               "setting " + name_of(found.part) + " against its rivals");
      done += 1.0;
      const std::optional<Fit> replacement = contested(course, found, candidates);
      if (replacement && course.swaps < most_swaps) {
        ++course.swaps;
        course.current = *replacement;
        swapped = true;
        break;
      }
    }
    if (!swapped) {
      return result;
    }
  }
}

// A part that is worth its place on the samples that hypotheses are compared on and not on the finer ones, or the
// weakest one where the model runs away there; the end where there is none.
std::vector<Found>::const_iterator unconfirmed(const Workbench& fine, const Fit& augmented,
                                               const std::vector<Found>& found) {
  if (augmented.cost >= diverged_cost) {
    return std::ranges::min_element(found, {}, &Found::gain);
  }
  if (found.empty()) {
    return found.end();
  }
  const double with = left_out(fine, augmented).squares;
  return std::ranges::find_if(found, [&](const Found& one) {
    const double without = left_out_beside(fine, one.without, one.part).squares;
    return without - with < least_gain_of_a_place * without;
  });
}

// The settled model on the finer samples, less what these do not confirm.
Fit confirmed(Course& course, const Workbench& fine, const Fit& fine_base, const std::vector<Extension>& candidates,
              const SearchProgress& progress, std::vector<Found>& found) {
  while (true) {
    found = settled(course, candidates, progress);
    progress(0.85, "fitting the augmented model to more samples");
    Fit augmented = course.current.what == course.base ? fine_base : fine.polished(course.current, screening_rounds);
    const auto idle = unconfirmed(fine, augmented, found);
    if (idle == found.end()) {
      return augmented;
    }
    course.current = idle->without;
  }
}

// Richer laws that were found are no effects, but for a yield force that saturates.
void name_laws(Search& result) {
  std::erase_if(result.found, [&](Found& found) {
    if (!found.part.is_law()) {
      return false;
    }
    result.richer.push_back(found.part.parameters.front());
    if (!saturates(result.base, result.augmented, result.richer.back())) {
      return true;
    }
    found.by_law = result.richer.back();
    found.part = effect_extension(saturation);
    std::erase_if(found.rivals, [&](const Rival& rival) { return rival.part == found.part; });
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

  std::vector<Extension> effects;
  for (const std::string& id : options.candidates) {
    effects.push_back(effect_extension(id));
  }
  Course course{bench, base, result.quick_base, result.quick_base, noise_of(bench)};
  const Misfit left = misfit_of(bench, course.current);
  course.independent = left.independent;
  progress(0.05, "fitting other damper laws");
  double best_law = squared(result.quick_base.cost);
  for (const std::string& law : options.laws) {
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
  grow(course, effects,
       result.limited ? std::min(options.most_effects, effects_beside_a_better_law) : options.most_effects, progress);
  if (!course.stages.empty()) {
    result.first_stage = course.stages.front();
  }

  result.augmented = confirmed(course, fine, result.base, effects, progress, result.found);
  const Fit& current = course.current;
  result.independent = course.independent;
  result.quick_augmented = current;
  for (Found& found : result.found) {
    if (!found.part.is_law() && acts_in_a_part(found.part.effect)) {
      found.locality = locality_of(bench, current, found.without, found.part.effect);
    }
  }
  result.misfit = misfit_of(fine, result.augmented);
  for (Found& found : result.found) {
    if (found.without.what == base) {
      found.without = result.base;
    }
  }
  name_laws(result);
  std::ranges::stable_sort(result.found, [](const Found& a, const Found& b) { return a.gain > b.gain; });
  if (!result.found.empty()) {
    progress(0.9, "trying the effects behind other damper laws");
    std::vector<std::string> found;
    for (const Found& one : result.found) {
      found.push_back(one.part.effect);
    }
    const std::size_t laws = std::ranges::any_of(found, in_series) ? 1 : laws_tried;
    // A law that does as well without them is tried with a search of its own.
    if (best_law > squared(current.cost) || found.size() == 1) {
      result.swaps = swaps(bench, result.quick_base, result.other_laws, found, laws);
    }
    const std::vector<Scored> next = scored(bench, current, effects);
    result.further = next.empty() ? 0.0 : next.front().gain;
  }
  return result;
}

}  // namespace hysteron

#include "diagnose/search/settle.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/judge/evidence.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/signs.hpp"

namespace hysteron {
namespace {

// Rivals set against an effect in its place: the best of all stages.
constexpr std::size_t rival_count = 6;
// A form that holds a simpler one as its limit is taken for it only above this.
constexpr double wider_evidence = 3.0;
// Times that a rival takes the place of an effect: two could go on taking each other's.
constexpr int most_swaps = 3;

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

// What the current model loses without one of its parts, the rest refitted.
Found taken_out(const Course& course, const Extension& part) {
  const Hypothesis less = without(course.current.what, part);
  Found found;
  found.part = part;
  found.told = course.is_told(part);
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
std::vector<Tried> rivals_of(const Course& course, const Found& found, const std::vector<Extension>& candidates,
                             const std::function<void(double share)>& done) {
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
  std::vector<Tried> rivals =
      stage(course.bench, found.without, others, course.independent, &course.current, kin, done);
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
  // What may do as well is refitted: the first order promises more than many a shape holds.
  std::vector<Extension> promising;
  for (const Tried& rival : rivals) {
    if (!rival.fit && !rival.part.is_law() && rival.gain > may_do_as_well * found.gain) {
      promising.push_back(rival.part);
    }
  }
  std::erase_if(rivals,
                [&](const Tried& rival) { return std::ranges::find(promising, rival.part) != promising.end(); });
  std::ranges::move(stage(course.bench, found.without, promising, course.independent, &course.current, promising, {}),
                    std::back_inserter(rivals));
  // The rounds of a first refit end short in the curved valley between a series element and the law's own stiffness.
  polish(course.bench, rivals, rivals.size(), found.without.dimension(), course.independent);
  return rivals;
}

// Sets the part against its rivals. The fit with one in its place that does clearly better, if any.
std::optional<Fit> contested(Course& course, Found& found, const std::vector<Extension>& candidates,
                             const std::function<void(double share)>& done) {
  std::optional<Fit> better;
  for (const Tried& rival : rivals_of(course, found, candidates, done)) {
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
std::vector<Found> worth_their_place(Course& course, const std::function<void(double share)>& done) {
  std::vector<Found> result;
  for (bool dropped = true; dropped;) {
    dropped = false;
    result.clear();
    const LeftOut with = left_out(course.bench, course.current);
    const bool far = is_far(misfit_of(course.bench, course.current));
    const std::vector<Extension> parts = extensions_of(course.current.what);
    for (const Extension& part : parts) {
      done(static_cast<double>(result.size()) / static_cast<double>(parts.size()));
      Found found = taken_out(course, part.is_law() ? law_extension({part.parameters.front()}) : part);
      const BlockScore score = block_score(
          left_out_beside(course.bench, found.without, part, left_out(course.bench, found.without)).predicted,
          with.predicted, course.noise, course.bench.motions());
      if (!found.told && !worth_keeping(found.evidence, found.gain, squared(found.without.cost), score, far)) {
        course.current = found.without;
        course.stands(course.current);
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
    if (std::optional<Fit> possible = turned_round(course.bench, course.current)) {
      course.current = std::move(*possible);
      course.stands(course.current);
    }
    std::vector<Found> result = worth_their_place(
        course, [&](double share) { progress(0.45 + 0.2 * share, "taking out each part of the augmented model"); });
    bool swapped = false;
    double before = 0.0;
    for (Found& found : result) {
      const auto done = [&](double share) {
        progress(0.65 + 0.2 * (before + share) / static_cast<double>(result.size()),
                 "setting " + name_of(found.part) + " against its rivals");
      };
      done(0.0);
      const std::optional<Fit> replacement = contested(course, found, candidates, done);
      before += 1.0;
      if (replacement && course.swaps < most_swaps && !found.told) {
        ++course.swaps;
        course.current = *replacement;
        course.stands(course.current);
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
    if (one.told) {
      return false;
    }
    const double without = left_out_beside(fine, one.without, one.part, left_out(fine, one.without)).squares;
    return without - with < least_gain_of_a_place * without;
  });
}

// What the part takes off alone behind the base. A first look from the base's own parameters may have gone astray where
// the augmented model, which knows the part's size and shape, has not.
double gain_alone(const Course& course, const Extension& part) {
  const Hypothesis alone = with(course.base, part);
  double cost = course.quick_base.cost;
  for (const Fit& fit : course.seen) {
    if (same_parts(fit.what, alone)) {
      cost = std::min(cost, fit.cost);
    }
  }
  if (!same_parts(course.current.what, alone)) {
    cost = std::min(cost, course.bench.from_fit(alone, course.current, fitting_rounds).cost);
  } else {
    cost = std::min(cost, course.current.cost);
  }
  return squared(course.quick_base.cost) - squared(cost);
}

}  // namespace

Fit confirmed(Course& course, const Workbench& fine, const Fit& fine_base, const std::vector<Extension>& candidates,
              const SearchProgress& progress, std::vector<Found>& found) {
  while (true) {
    found = settled(course, candidates, progress);
    const auto fitting = [&](double share) {
      progress(0.85 + 0.15 * share, "fitting the augmented model to more samples");
    };
    fitting(0.0);
    Fit augmented = course.current.what == course.base ? fine_base : fine.polished(course.current, screening_rounds);
    fitting(0.3);
    const auto idle = unconfirmed(fine, augmented, found);
    if (idle == found.end()) {
      double looked_at = 0.0;
      for (Found& one : found) {
        fitting(0.6 + 0.4 * looked_at++ / static_cast<double>(found.size()));
        // A richer law is no name, and one of another effect's parameter is nothing without that effect.
        one.alone = one.part.is_law() ? 0.0 : gain_alone(course, one.part);
      }
      return augmented;
    }
    course.current = idle->without;
    course.stands(course.current);
  }
}

}  // namespace hysteron

#include "diagnose/search/grow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/signs.hpp"

namespace hysteron {
namespace {

// No further effects are looked for once only this part of the noise is left above it, which it is not known to.
constexpr double unsure_of_noise = 0.05;
// Where this many times the squares of the noise stay, the model is asked for more, down to small gains.
constexpr double far_from_noise = 4.0;
// Stages of a search, richer laws among them.
constexpr std::size_t most_stages = 8;

bool cannot_be_missed(const Extension& part) { return !part.is_law() && has_one_form(part.effect); }

std::string joined_names(const Hypothesis& what) {
  std::string text;
  for (const Extension& part : extensions_of(what)) {
    text += (text.empty() ? "" : " + ") + name_of(part);
  }
  return text;
}

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

}  // namespace

// By the noise of the force alone: what the noise of the motion makes of the model's force, another model need not.
bool is_far(const Misfit& left) { return left.squares > far_from_noise * (left.floor - left.motion); }

void grow(Course& course, const std::vector<Extension>& effects, int most_effects, const SearchProgress& progress) {
  LeftOut before = left_out(course.bench, course.current);
  Misfit left = misfit_of(course.bench, course.current);
  int added = 0;
  while (added < most_effects && course.stages.size() < most_stages) {
    const std::vector<Extension> candidates = open_to(course, effects, left);
    const auto count = static_cast<double>(candidates.size());
    const std::string what = added == 0 ? "looking at " + std::to_string(candidates.size()) + " hypotheses"
                                        : "looking for more behind " + joined_names(course.current.what);
    const auto done = [&](double share) { progress(0.1 + 0.35 * (added + share) / most_effects, what); };
    // Half of it looks and refits, the other compares on recordings left out.
    done(0.0);
    std::vector<Tried> tried = stage(course.bench, course.current, candidates, course.independent, nullptr, course.told,
                                     [&](double share) { done(0.5 * share); });
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
    // What the channels tell joins before what is worth most.
    std::stable_partition(tried.begin(), tried.end(), [&](const Tried& one) { return course.is_told(one.part); });
    std::optional<LeftOut> after;
    double compared = 0.0;
    const auto refitted =
        static_cast<double>(std::ranges::count_if(tried, [](const Tried& one) { return one.fit.has_value(); }));
    const auto chosen = std::ranges::find_if(tried, [&](const Tried& one) {
      const bool told = course.is_told(one.part);
      if (!one.fit || one.gain <= (told ? 0.0 : least_gain_of_a_place * squared(course.current.cost))) {
        return false;
      }
      done(0.5 + 0.5 * compared++ / refitted);
      after = left_out(course.bench, *one.fit);
      if (told) {
        return true;
      }
      const LeftOut without = left_out_beside(course.bench, course.current, one.part, before);
      return worth(one, course.current, count,
                   block_score(without.predicted, after->predicted, course.noise, course.bench.motions()),
                   is_far(left));
    });
    if (chosen == tried.end()) {
      return;
    }
    course.current = *chosen->fit;
    before = std::move(*after);
    if (std::optional<Fit> possible = turned_round(course.bench, course.current)) {
      course.current = std::move(*possible);
      before = left_out(course.bench, course.current);
    }
    course.stands(course.current);
    added += chosen->part.is_law() ? 0 : 1;
    if (!cannot_be_missed(chosen->part)) {
      course.strongest = std::max(course.strongest, chosen->gain);
    }
    left = misfit_of(course.bench, course.current);
    if (course.is_told(chosen->part)) {
      continue;
    }
    if (!is_far(left) && chosen->gain < negligible * course.strongest) {
      return;  // what is left could not be named beside what was found
    }
    if (!structured(left) && left.squares < (1.0 + unsure_of_noise) * left.floor) {
      return;
    }
  }
}

}  // namespace hysteron

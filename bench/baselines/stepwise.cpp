#include "baselines/stepwise.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>

#include "core/squared.hpp"
#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/stage.hpp"
#include "fit/parallel.hpp"

namespace hysteron::baselines {
namespace {

double gain_of(const Step& step, double values) { return evidence(step.before, step.after, step.more, values); }

std::vector<Extension> extensions_of(const std::vector<std::string>& effects) {
  std::vector<Extension> result;
  result.reserve(effects.size());
  for (const std::string& effect : effects) {
    result.push_back(effect_extension(effect));
  }
  return result;
}

}  // namespace

double p_of(const Step& step, double values) {
  const double freedom = values - step.remaining - step.more;
  if (freedom < 1.0 || step.more < 1.0 || !(step.after < step.before)) {
    return 1.0;
  }
  if (!(step.after > 0.0)) {
    return 0.0;
  }
  const double f = (step.before - step.after) / step.more / (step.after / freedom);
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(step.more, freedom), f));
}

std::vector<std::string> significant(std::vector<Step> steps, double values, double level) {
  std::ranges::stable_sort(steps, {}, [&](const Step& step) { return p_of(step, values); });
  std::size_t held = 0;
  while (held < steps.size() && p_of(steps[held], values) <= level / static_cast<double>(steps.size() - held)) {
    ++held;
  }
  steps.resize(held);
  std::ranges::stable_sort(steps,
                           [&](const Step& a, const Step& b) { return gain_of(a, values) > gain_of(b, values); });
  std::vector<std::string> names;
  names.reserve(held);
  for (const Step& step : steps) {
    names.push_back(step.effect);
  }
  return names;
}

std::vector<Fit> refits(const Workbench& bench, const Fit& before, const std::vector<std::string>& effects) {
  const std::vector<Scored> scores = scored(bench, before, extensions_of(effects));
  std::vector<Fit> result(effects.size());
  const Workbench each = bench.shared_by(scores.size());
  parallel_for(scores.size(), bench.options().threads, [&](std::size_t k) {
    const Starts& starts = scores[k].starts;
    const auto at = std::ranges::find(effects, scores[k].part.effect) - effects.begin();
    result[static_cast<std::size_t>(at)] = each.from_starts(with(before.what, scores[k].part), starts, screening_rounds,
                                                            Workbench::starts_of_a_pack(starts.layout->dimension()));
  });
  return result;
}

Step step_of(const Fit& before, const Fit& after) {
  return {after.what.effects.back(), squared(before.cost), squared(after.cost),
          static_cast<double>(after.dimension()) - static_cast<double>(before.dimension()),
          static_cast<double>(before.dimension())};
}

std::vector<std::string> forward(const Workbench& bench, const Fit& base, const std::vector<Fit>& first,
                                 const std::vector<std::string>& effects, double values, std::size_t most) {
  Fit current = base;
  std::vector<Fit> tried = first;
  while (current.what.effects.size() < most && !tried.empty()) {
    const auto best =
        std::ranges::max_element(tried, {}, [&](const Fit& fit) { return gain_of(step_of(current, fit), values); });
    if (gain_of(step_of(current, *best), values) <= 0.0) {
      break;
    }
    const Fit next = *best;
    tried.clear();
    if (next.what.effects.size() < most) {
      for (const Tried& one : stage(bench, next, extensions_of(effects), values)) {
        if (one.fit) {
          tried.push_back(*one.fit);
        }
      }
    }
    current = next;
  }
  return current.what.effects;
}

}  // namespace hysteron::baselines

#include "diagnose/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/relatives.hpp"

namespace hysteron {
namespace {

// The largest of `sense` times the displacement.
double farthest(const std::vector<Recording>& recordings, double sense) {
  double result = -std::numeric_limits<double>::infinity();
  for (const Recording& recording : recordings) {
    for (const double x : recording.displacement) result = std::max(result, sense * x);
  }
  return result;
}

std::vector<Estimate> estimates_of(const Workbench& bench, const Fit& fit) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  Identification identification{*fit.layout, fit.terms, {}, {}, 0, fit.cost, {}, {}, {}, false, {}};
  estimate(identification, objective, fit.point, bench.split().fit.front().drive_kind);
  return identification.estimates;
}

// A stop at the end of the motion stops nothing: any place beyond does as well, whatever the slope on the near side
// says.
void forget_places_not_reached(std::vector<ParameterInterval>& rows, const std::string& effect,
                               const std::vector<Recording>& recordings) {
  const Part* part = find_effect(effect);
  if (part == nullptr || knowledge_of(effect).acts != Acts::at_ends) {
    return;
  }
  for (ParameterInterval& row : rows) {
    const auto card = std::ranges::find(part->parameters, row.name, &Parameter::name);
    if (card == part->parameters.end() || card->place == 0.0 || !row.half_width) {
      continue;
    }
    const double reached = farthest(recordings, card->place);
    if (row.ci95 && row.ci95->upper >= reached) {
      row.ci95.reset();
    }
    if (row.value + *row.half_width >= reached) {
      row.half_width.reset();
      row.ci95.reset();
    }
  }
}

}  // namespace

const Estimates::Known& Estimates::of(const Fit& fit) {
  const auto known =
      std::ranges::find_if(known_, [&](const Known& one) { return one.what == fit.what && one.point == fit.point; });
  if (known != known_.end()) {
    return *known;
  }
  const Recurrence again = recurrence_of(*bench_, fit);
  const double recurring = std::max(again.share - again.mean_by_chance, 0.0) * misfit_of(*bench_, fit).squares;
  return known_.emplace_back(Known{fit.what, fit.point, estimates_of(*bench_, fit), std::sqrt(recurring)});
}

std::vector<ParameterInterval> Estimates::intervals(const Fit& fit, const std::string& effect) {
  const bool joined = contains(fit.what, effect_extension(effect));
  const PartOfLaw* part = joined ? nullptr : part_of_law(effect, fit.what.model);
  const std::string own(part == nullptr ? std::string_view{} : part->parameter);
  const std::string prefix = effect + ".";
  std::vector<ParameterInterval> result;
  const Known& known = of(fit);
  for (const Estimate& row : known.estimates) {
    const bool of_law = !own.empty() && (row.name == own || row.name.starts_with(own + "*"));
    if (!of_law && !row.name.starts_with(prefix)) {
      continue;
    }
    std::optional<Interval> ci95;
    if (row.half_width) {
      ci95 = interval_of(row.term, fit.layout->cards()[row.term.parameter],
                         std::hypot(*row.half_width, known.unmodelled * row.per_misfit.value_or(0.0)));
    }
    result.push_back({of_law ? row.name : row.name.substr(prefix.size()), row.unit, row.term.value, row.half_width,
                      ci95, row.at_bound, row.lower});
  }
  forget_places_not_reached(result, effect, bench_->split().fit);
  return result;
}

}  // namespace hysteron

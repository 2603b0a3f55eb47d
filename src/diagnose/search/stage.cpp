#include "diagnose/search/stage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "diagnose/residual/misfit.hpp"

namespace hysteron {
namespace {

// Hypotheses of a stage that are taken further.
constexpr std::size_t survivors = 5;
// The highest order of a law in the drive where it varies within recordings.
constexpr int most_order = 3;
// Effects that promise to take more off behind others: so many of the best.
constexpr std::size_t promising_count = 8;
constexpr std::string_view law_prefix = "law:";

bool is_series(const std::string& id) {
  const Part* part = find_effect(id);
  return part != nullptr && part->in_series();
}

std::vector<std::string> parameters_of(const std::string& law) {
  std::vector<std::string> result;
  std::size_t from = law_prefix.size();
  while (from <= law.size()) {
    const std::size_t comma = std::min(law.find(',', from), law.size());
    result.push_back(law.substr(from, comma - from));
    from = comma + 1;
  }
  return result;
}

// The highest order of a law in the drive that the recordings can tell.
int highest_order(const std::vector<Recording>& recordings) {
  std::set<long> levels;
  bool varies = false;
  for (const Recording& recording : recordings) {
    if (recording.drive.empty()) {
      return 0;
    }
    const auto [low, high] = std::ranges::minmax(recording.drive);
    varies = varies || drive_varies(recording);
    levels.insert(std::lround(1e3 * 0.5 * (low + high)));
  }
  return varies ? most_order : static_cast<int>(levels.size()) - 1;
}

}  // namespace

bool is_law(const std::string& id) { return id.starts_with(law_prefix); }

std::string law_of_parameter(const std::string& parameter) { return std::string(law_prefix) + parameter; }

std::string parameter_of_law(const std::string& id) { return parameters_of(id).front(); }

Hypothesis with(const Hypothesis& what, const std::string& id) {
  Hypothesis result = what;
  if (is_law(id)) {
    std::ranges::copy(parameters_of(id), std::back_inserter(result.richer));
  } else {
    result.effects.push_back(id);
  }
  return result;
}

Hypothesis without(const Hypothesis& what, const std::string& id) {
  Hypothesis result = what;
  std::erase(result.effects, id);
  if (is_law(id)) {
    for (const std::string& name : parameters_of(id)) {
      const auto found = std::ranges::find(result.richer, name);
      if (found != result.richer.end()) {
        result.richer.erase(found);
      }
    }
  }
  return result;
}

bool contains(const Hypothesis& what, const std::string& id) {
  if (!is_law(id)) {
    return std::ranges::find(what.effects, id) != what.effects.end();
  }
  return std::ranges::all_of(parameters_of(id), [&](const std::string& name) {
    return std::ranges::find(what.richer, name) != what.richer.end();
  });
}

std::vector<std::string> law_candidates(const Workbench& bench, const Hypothesis& what) {
  std::vector<std::string> result;
  const int highest = highest_order(bench.split().fit);
  const Layout layout = bench.layout(what);
  for (const ParameterLaw& law : layout.laws()) {
    if (static_cast<int>(law.drive_nodes.size()) <= highest) {
      result.push_back(law_of_parameter(layout.names()[law.parameter]));
    }
  }
  return result;
}

std::vector<std::string> joint_law_candidates(const Workbench& bench, const Hypothesis& what) {
  std::vector<std::string> result;
  const int highest = std::min(most_order, highest_order(bench.split().fit));
  const Layout layout = bench.layout(what);
  for (int orders = 1; orders <= 2; ++orders) {
    std::string id;
    for (const ParameterLaw& law : layout.laws()) {
      const int order = static_cast<int>(law.drive_nodes.size()) - 1;
      for (int more = 0; order > 0 && more < std::min(orders, highest - order); ++more) {
        id += (id.empty() ? std::string(law_prefix) : ",") + layout.names()[law.parameter];
      }
    }
    if (!id.empty() && (result.empty() || id != result.back())) {
      result.push_back(id);
    }
  }
  return result;
}

Tried weighed(const std::string& id, const Fit& fit, const Fit& before, double effective) {
  Tried tried;
  tried.id = id;
  tried.fit = fit;
  tried.gain = squared(before.cost) - squared(fit.cost);
  tried.heldout_gain = squared(before.heldout) - squared(fit.heldout);
  tried.evidence = evidence(squared(before.cost), squared(fit.cost),
                            static_cast<double>(fit.dimension()) - static_cast<double>(before.dimension()), effective);
  return tried;
}

std::vector<Tried> stage(const Workbench& bench, const Fit& before, const std::vector<std::string>& candidates,
                         double effective, const Fit* also) {
  std::vector<std::string> ids;
  std::vector<Hypothesis> hypotheses;
  // Two elements in series share one force and are told apart by their sum only.
  const bool has_series = std::ranges::any_of(before.what.effects, is_series);
  for (const std::string& id : candidates) {
    if ((!contains(before.what, id) || is_law(id)) && !(is_series(id) && has_series)) {
      ids.push_back(id);
      hypotheses.push_back(with(before.what, id));
    }
  }
  std::vector<Fit> fits = bench.from_fit(hypotheses, before, screening_rounds, also);
  std::vector<std::size_t> order(fits.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return fits[k].cost; });
  const std::size_t count = std::min(survivors, order.size());
  std::vector<Fit> best;
  for (std::size_t k = 0; k < count; ++k) {
    best.push_back(fits[order[k]]);
  }
  best = bench.polished(best, fitting_rounds);
  std::vector<Tried> result;
  for (std::size_t k = 0; k < order.size(); ++k) {
    result.push_back(weighed(ids[order[k]], k < count ? best[k] : fits[order[k]], before, effective));
  }
  std::ranges::stable_sort(result, [](const Tried& a, const Tried& b) { return a.evidence > b.evidence; });
  return result;
}

std::vector<std::string> promising(const std::vector<Tried>& tried) {
  std::vector<std::string> result;
  for (const Tried& one : tried) {
    if (!is_law(one.id) && result.size() < promising_count) {
      result.push_back(one.id);
    }
  }
  return result;
}

bool worth(const Tried& tried, const Fit& before, double candidates) {
  const double bearable = std::max(0.005 * squared(before.heldout), 0.02 * tried.gain);
  return tried.evidence > least_evidence_of_a_place + 2.0 * std::log(candidates) &&
         tried.gain > least_gain_of_a_place * squared(before.cost) && tried.heldout_gain > -bearable;
}

}  // namespace hysteron

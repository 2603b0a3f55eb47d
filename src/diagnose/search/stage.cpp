#include "diagnose/search/stage.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/counting.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/signs.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// Extensions of a stage that are refitted: so many of the best scores, and all that come within this part of the best.
constexpr std::size_t refitted_at_least = 4;
constexpr std::size_t refitted_at_most = 10;
constexpr double near_the_best = 0.6;
// Of these, so many are taken further.
constexpr std::size_t survivors = 2;
// Behind a series element, whose force balance is solved in every step, a simulation takes several times as long: fewer
// are refitted.
constexpr std::size_t refitted_behind_series = 4;
constexpr std::size_t starts_behind_series = 8;
// Block score over its standard error of a surely better prediction: three standard errors.
constexpr double steady = 3.0;
// Far from the noise: shares of the squared error taken off the fitted recordings, and off recordings left out.
constexpr double plain_gain = 0.03;
constexpr double plain_gain_left_out = 0.01;
// Below zero by so many, recordings left out refute what the fitted ones ask for.
constexpr double refuted = 2.0;
// Effects in series that a hypothesis may have.
constexpr std::ptrdiff_t most_in_series = 2;
// The highest order of a law in the drive where it varies within recordings.
constexpr int most_order = 3;

// Tells `done` of a part of its work; empty where it is.
std::function<void(double share)> part_of(const std::function<void(double share)>& done, double from, double to) {
  if (!done) return {};
  return [&done, from, to](double share) { done(from + (to - from) * share); };
}

// The highest order of a law in the drive that the recordings can tell.
int highest_order(const std::vector<Recording>& recordings) {
  if (std::ranges::any_of(recordings, [](const Recording& recording) { return recording.drive.empty(); })) {
    return 0;
  }
  return std::ranges::any_of(recordings, drive_varies) ? most_order : static_cast<int>(drive_levels(recordings)) - 1;
}

// Which of the scored, best first, are refitted: the best, what comes near it, and kin of the very best, which the
// first order may rank wrongly among themselves.
std::vector<bool> chosen(const std::vector<Scored>& scores, const std::vector<Extension>& always, std::size_t most) {
  std::vector<bool> result(scores.size(), false);
  std::size_t count = 0;
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const bool near = scores[k].gain > near_the_best * scores.front().gain;
    const bool kin = !scores.front().part.is_law() && !scores[k].part.is_law() &&
                     is_kin(scores.front().part.effect, scores[k].part.effect);
    const bool asked = std::ranges::find(always, scores[k].part) != always.end();
    result[k] = count < most && (k < refitted_at_least || near || kin || asked);
    count += result[k] ? 1 : 0;
  }
  return result;
}

}  // namespace

std::vector<Extension> law_candidates(const Workbench& bench, const Hypothesis& what) {
  std::vector<Extension> result;
  const int highest = highest_order(bench.split().fit);
  const Layout layout = bench.layout(what);
  const std::vector<Parameter> cards = layout.model().parameters();
  for (const ParameterLaw& law : layout.laws()) {
    // What is a force, a damping or a stiffness may follow the field; a time, a place or a share does not: a yield
    // displacement that grows with the field is what a spring in series does.
    const bool may = cards[law.parameter].role != PhysicalRole::none;
    if (may && static_cast<int>(law.drive_nodes.size()) <= highest) {
      result.push_back(law_extension({layout.names()[law.parameter]}));
    }
  }
  return result;
}

std::vector<Extension> joint_law_candidates(const Workbench& bench, const Hypothesis& what) {
  std::vector<Extension> result;
  const int highest = std::min(most_order, highest_order(bench.split().fit));
  const Layout layout = bench.layout(what);
  for (int orders = 1; orders <= 2; ++orders) {
    Extension all;
    for (const ParameterLaw& law : layout.laws()) {
      const int order = static_cast<int>(law.drive_nodes.size()) - 1;
      for (int more = 0; order > 0 && more < std::min(orders, highest - order); ++more) {
        all.parameters.push_back(layout.names()[law.parameter]);
      }
    }
    if (!all.parameters.empty() && (result.empty() || all != result.back())) {
      result.push_back(all);
    }
  }
  return result;
}

bool better(const Tried& a, const Tried& b) {
  return a.fit.has_value() != b.fit.has_value() ? a.fit.has_value() : a.evidence > b.evidence;
}

Tried weighed(const Extension& part, const Fit& fit, double squares_before, std::size_t dimension_before,
              double independent) {
  return {part, squares_before - squared(fit.cost),
          evidence(squares_before, squared(fit.cost),
                   static_cast<double>(fit.dimension()) - static_cast<double>(dimension_before), independent),
          fit};
}

void polish(const Workbench& bench, std::vector<Tried>& tried, std::size_t most, std::size_t dimension_before,
            double independent) {
  std::vector<Tried*> refitted;
  std::vector<Fit> fits;
  for (Tried& one : tried) {
    if (one.fit && fits.size() < most) {
      refitted.push_back(&one);
      fits.push_back(*one.fit);
    }
  }
  fits = bench.polished(fits, fitting_rounds);
  for (std::size_t k = 0; k < fits.size(); ++k) {
    Tried& one = *refitted[k];
    if (fits[k].cost < one.fit->cost) {
      one = weighed(one.part, fits[k], one.gain + squared(one.fit->cost), dimension_before, independent);
    }
  }
}

std::vector<Tried> stage(const Workbench& bench, const Fit& before, const std::vector<Extension>& candidates,
                         double independent, const Fit* also, const std::vector<Extension>& always,
                         const std::function<void(double share)>& done) {
  std::vector<Extension> open;
  const auto elements = std::ranges::count_if(before.what.effects, in_series);
  const bool series_is_full = elements >= most_in_series;
  const std::vector<std::string> names = make_model(before.what.model, before.what.effects).parameter_names();
  for (const Extension& candidate : candidates) {
    // What the law has as a part of its own is there as well.
    const bool has = !candidate.is_law() &&
                     (contains(before.what, candidate) || part_of_law(candidate.effect, before.what.model) != nullptr);
    // A law of an effect that is not there has nothing to act on.
    const bool acts = std::ranges::all_of(candidate.parameters, [&](const std::string& parameter) {
      return std::ranges::find(names, parameter) != names.end();
    });
    if (acts && !has && !(series_is_full && in_series(candidate.effect))) {
      open.push_back(candidate);
    }
  }
  // Shares of the time that the first look takes, and that with the refits.
  constexpr double of_looks = 0.4;
  constexpr double of_refits = 0.85;
  const std::vector<Scored> scores = scored(
      bench, before, open, also, elements > 0 ? starts_behind_series : std::size_t{0}, part_of(done, 0.0, of_looks));
  const std::vector<bool> refit = chosen(scores, always, elements > 0 ? refitted_behind_series : refitted_at_most);
  std::vector<Tried> result(scores.size());
  std::vector<std::size_t> refitted;
  for (std::size_t k = 0; k < scores.size(); ++k) {
    if (refit[k]) {
      refitted.push_back(k);
      continue;
    }
    const double after = std::max(squared(before.cost) - scores[k].gain, 1e-12 * squared(before.cost));
    const double more =
        static_cast<double>(scores[k].starts.layout->dimension()) - static_cast<double>(before.dimension());
    result[k] = {scores[k].part, squared(before.cost) - after, evidence(squared(before.cost), after, more, independent),
                 std::nullopt};
  }
  const Workbench each = bench.shared_by(refitted.size());
  const std::function<void(double)> done_with_refits = part_of(done, of_looks, of_refits);
  Counting counting(refitted.size(), done_with_refits);
  parallel_for(refitted.size(), bench.options().threads, [&](std::size_t task) {
    const std::size_t k = refitted[task];
    const Starts& starts = scores[k].starts;
    Fit fit = each.from_starts(with(before.what, scores[k].part), starts, screening_rounds,
                               Workbench::starts_of_a_pack(starts.layout->dimension()));
    if (std::optional<Fit> possible = turned_round(each, fit)) {
      fit = std::move(*possible);
    }
    const std::optional<Fit> neutral = each.beside(before, scores[k].part);
    const double squares = squared(std::min(before.cost, neutral ? neutral->cost : before.cost));
    result[k] = weighed(scores[k].part, fit, squares, before.dimension(), independent);
    counting.add();
  });
  std::ranges::stable_sort(result, better);
  polish(bench, result, elements > 0 ? 1 : survivors, before.dimension(), independent);
  std::ranges::stable_sort(result, better);
  return result;
}

namespace {

bool predicts(double share, const BlockScore& left_out) {
  return share > plain_gain && left_out.saved > plain_gain_left_out;
}

}  // namespace

bool worth(const Tried& tried, const Fit& before, double candidates, const BlockScore& left_out, bool far) {
  const bool asked_for = tried.evidence > least_evidence_of_a_place + 2.0 * std::log(candidates);
  return tried.gain > least_gain_of_a_place * squared(before.cost) &&
         ((asked_for && left_out.z() > -refuted) || left_out.z() > steady ||
          (far && predicts(tried.gain / squared(before.cost), left_out)));
}

bool worth_keeping(double evidence, double gain, double squares_without, const BlockScore& left_out, bool far) {
  return gain > least_gain_of_a_place * squares_without &&
         (evidence > least_evidence_of_a_place || left_out.z() > steady ||
          (far && predicts(gain / squares_without, left_out)));
}

}  // namespace hysteron

#include "fit/identify.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "core/suggest.hpp"
#include "fit/law_start.hpp"
#include "fit/no_candidate.hpp"

namespace hysteron {
namespace {

std::string final_stage(bool refit) {
  return refit ? "final fit on all recordings" : "final descent on the same recordings";
}

}  // namespace

std::vector<std::size_t> Identification::compared_on(std::size_t count) const {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < count; ++k) {
    if (std::ranges::find(heldout, k) == heldout.end()) {
      result.push_back(k);
    }
  }
  return result;
}

std::vector<Recording> pick(const std::vector<Recording>& recordings, const std::vector<std::size_t>& indices) {
  std::vector<Recording> result;
  result.reserve(indices.size());
  for (const std::size_t index : indices) {
    result.push_back(recordings[index]);
  }
  return result;
}

double predicted_nrmse(const Layout& layout, const std::vector<Term>& terms,
                       const std::vector<const Recording*>& recordings, const ObjectiveOptions& options,
                       const std::vector<const Recording*>& normalised_by) {
  std::vector<Score> scores;
  for (const Recording* recording : recordings) {
    const Target target = make_target(*recording, options);
    scores.push_back(score(predict(layout.model(), layout.held(), terms, target), *recording, options.normalisation));
  }
  return overall(scores, recordings, options.normalisation, options.weighting, normalised_by);
}

Problem make_problem(const Objective& objective, const SolverEntry& entry, const IdentifyOptions& options,
                     const std::string& stage, std::vector<double> start) {
  Problem problem;
  problem.dimension = objective.layout().dimension();
  problem.budget = options.budget;
  problem.stream = Stream(options.seed).child(stage).child(entry.id);
  problem.linear = objective.layout().linear();
  problem.start = std::move(start);
  problem.screening = true;
  objective.describe_data(problem);
  for (const auto& [name, value] : options.settings) {
    const bool known =
        std::ranges::any_of(entry.settings, [&name = name](const Setting& row) { return row.name == name; });
    if (known || options.solvers.size() == 1) {
      problem.settings[name] = value;
    }
  }
  return problem;
}

std::vector<std::size_t> choose_heldout(const std::vector<Recording>& recordings) {
  const std::size_t count = recordings.size();
  if (count < 4) {
    return {};
  }
  struct Key {
    double drive;
    double severity;
    std::size_t index;
  };
  std::vector<Key> keys;
  for (std::size_t k = 0; k < count; ++k) {
    const Recording& recording = recordings[k];
    double speed = 0.0;
    for (const double velocity : recording.velocity) {
      speed = std::max(speed, std::fabs(velocity));
    }
    keys.push_back({recording.drive.empty() ? 0.0 : recording.drive[recording.size() / 2], speed, k});
  }
  std::ranges::sort(keys, [](const Key& a, const Key& b) {
    return std::tie(a.drive, a.severity, a.index) < std::tie(b.drive, b.severity, b.index);
  });
  const std::size_t wanted = std::max<std::size_t>(1, count / 5);
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < wanted; ++k) {
    result.push_back(keys[(2 * k + 1) * count / (2 * wanted)].index);
  }
  std::ranges::sort(result);
  return result;
}

namespace {

// The winner once more with a tighter integration: a difference is the integrator's, not the model's.
void check_integration(Identification& result, const std::vector<double>& best, const Campaign& campaign,
                       const IdentifyOptions& options) {
  ObjectiveOptions tight = options.objective;
  tight.tolerance = options.objective.tolerance / 256.0;
  try {
    const double tight_cost =
        Objective(result.layout, refer_to(campaign.recordings, result.fitted), tight).evaluate({best, false}).cost[0];
    if (std::fabs(tight_cost - result.cost) > 1e-3 * result.cost) {
      result.warnings.push_back("a four times finer integration moves the NRMSE from " + number_text(result.cost, 5) +
                                " to " + number_text(tight_cost, 5) + ": use a smaller tolerance");
    }
  } catch (const Stopped&) {
    result.warnings.emplace_back("interrupted before the integration was checked");
  }
}

}  // namespace

std::vector<std::string> warnings_of(const std::vector<Estimate>& estimates) {
  std::vector<std::string> result;
  for (const Estimate& estimate : estimates) {
    if (!estimate.term.constant()) {
      continue;
    }
    if (!estimate.identifiable) {
      result.push_back("parameter " + estimate.name + " is not identifiable from these recordings");
    }
  }
  return result;
}

Identification identify(const Campaign& campaign, const std::string& model, const IdentifyOptions& options,
                        const Progress& progress) {
  std::vector<std::size_t> all(campaign.recordings.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> fitted;
  std::vector<std::size_t> heldout;
  const bool roles = std::ranges::any_of(campaign.roles, [](Role role) { return role != Role::unassigned; });
  if (roles) {
    for (const std::size_t index : all) {
      (campaign.roles[index] == Role::validate ? heldout : fitted).push_back(index);
    }
    if (fitted.empty()) {
      throw InputError("campaign.toml: every recording has the role validate, expected at least one to fit");
    }
  } else {
    heldout = choose_heldout(campaign.recordings);
    std::ranges::set_difference(all, heldout, std::back_inserter(fitted));
  }
  std::vector<const SolverEntry*> entries;
  for (const std::string& id : options.solvers) {
    const SolverEntry* entry = find_solver(id);
    if (entry == nullptr) {
      std::vector<std::string> known;
      for (const SolverEntry* one : solver_catalogue()) {
        known.emplace_back(one->id);
      }
      throw InputError("unknown solver '" + id + "'" + suggestion(id, known) + ", see `hysteron list solvers`");
    }
    entries.push_back(entry);
  }
  // One box for both fits, so that a held-out check is of the same model.
  const DataScale scale = scale_of(pick(campaign.recordings, roles ? fitted : all));
  const Layout layout(make_model(model, options.effects), scale, options.layout);
  if (layout.dimension() == 0) {
    throw InputError("every parameter is fixed, expected at least one to identify");
  }
  Identification result{layout, {}, {}, {}, 0, 0.0, {}, fitted, heldout, roles, {}};

  // Descents begin at what the law reaches without the effects; what that takes is of the budget of each.
  LawStart law{layout.initial(), 0};
  if (std::ranges::any_of(entries, &SolverEntry::uses_derivatives)) {
    law = start_at_law(
        layout, model, scale, refer_to(campaign.recordings, fitted), options,
        [&](const RunResult& partial) { return !progress || progress(model + " without effects", partial); });
  }

  // Beside the error of what the model is fitted to in the end.
  const auto heldout_nrmse = [&](const std::vector<double>& point) {
    return predicted_nrmse(layout, layout.terms(point), refer_to(campaign.recordings, heldout), options.objective,
                           refer_to(campaign.recordings, roles ? fitted : all));
  };

  // One objective at a time: they are as large as the recordings. Some is evaluated whether it was interrupted or not.
  bool calm = false;
  ObjectiveOptions with = options.objective;
  if (options.objective.stopped) {
    with.stopped = [&] { return !calm && options.objective.stopped(); };
  }
  std::optional<Objective> objective(std::in_place, layout, refer_to(campaign.recordings, fitted), with);
  const auto calm_cost = [&](const std::vector<double>& point) {
    calm = true;
    const double cost = objective->evaluate({point, false}).cost[0];
    calm = false;
    return cost;
  };
  std::vector<double> best;
  for (const SolverEntry* entry : entries) {
    const std::string stage = heldout.empty() || roles ? "fit" : "fit without the held-out recordings";
    const auto observe = [&](const RunResult& partial) {
      return !progress || progress(std::string(entry->id) + ": " + stage, partial);
    };
    const LawStart start = entry->uses_derivatives ? law : LawStart{layout.initial(), 0};
    IdentifyOptions rest = options;
    rest.budget -= start.evaluations;
    RunResult run = run_solver(
        *entry, make_problem(*objective, *entry, rest, "fit", start.point),
        [&](const Request& request) { return objective->evaluate(request); }, observe);
    run.evaluations += start.evaluations;
    run.budget = options.budget;
    for (TracePoint& point : run.trace) {
      point.evaluations += start.evaluations;
    }
    if (run.best.empty() && run.ended_by == EndedBy::interruption) {
      if (!result.solvers.empty()) {
        break;
      }
      // Where every search starts: something to keep.
      run.best = start.point;
      run.evaluations = start.evaluations + 1;
      run.cost = calm_cost(run.best);
    }
    if (run.best.empty() || run.cost >= diverged_cost) {
      throw_without_candidate("", run, layout, options.layout, start.evaluations);
    }
    SolverOutcome outcome{std::move(run), {}};
    if (!heldout.empty()) {
      outcome.nrmse_heldout = heldout_nrmse(outcome.run.best);
    }
    result.solvers.push_back(std::move(outcome));
  }
  for (std::size_t k = 1; k < result.solvers.size(); ++k) {
    if (result.solvers[k].run.cost < result.solvers[result.chosen].run.cost) {
      result.chosen = k;
    }
  }
  best = result.solvers[result.chosen].run.best;
  result.nrmse_heldout = result.solvers[result.chosen].nrmse_heldout;
  result.cost = result.solvers[result.chosen].run.cost;

  const bool refit = !roles && !heldout.empty();
  const bool descends = entries[result.chosen]->uses_derivatives;
  if (refit) {
    objective.emplace(layout, refer_to(campaign.recordings, all), with);
  }
  if (refit || (!descends && result.solvers[result.chosen].run.ended_by != EndedBy::interruption)) {
    // From what was found; other starts only where the chosen solver descends too. Without recordings to add, a solver
    // that does not descend still leaves the bottom of the valley to a descent.
    const SolverEntry* entry = find_solver(refit && descends ? "multistart-lm" : "lm");
    IdentifyOptions polish = options;
    polish.settings.clear();
    RunResult run = run_solver(
        *entry, make_problem(*objective, *entry, polish, "refit", best),
        [&](const Request& request) { return objective->evaluate(request); },
        [&](const RunResult& partial) {
          return !progress || progress(std::string(entry->id) + ": " + final_stage(refit), partial);
        });
    // Interrupted before it came as far, the fit is what it started from.
    const double before = refit ? calm_cost(best) : result.cost;
    result.cost = std::min(before, run.cost);
    if (run.cost < before) {
      best = run.best;
      if (!refit && !heldout.empty()) {
        result.nrmse_heldout = heldout_nrmse(best);
      }
    }
    if (refit) {
      result.fitted = all;
    }
    result.final_stage = final_stage(refit);
    result.final_run = std::move(run);
  }
  result.terms = layout.terms(best);
  estimate(result, *objective, best, campaign.recordings.front().drive_kind);
  objective.reset();

  check_integration(result, best, campaign, options);
  for (std::string& warning : warnings_of(result.estimates)) {
    result.warnings.push_back(std::move(warning));
  }
  return result;
}

}  // namespace hysteron

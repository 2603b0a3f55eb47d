// Descents of a workbench, from anywhere and from given points.
#include <algorithm>

#include "core/squared.hpp"
#include "diagnose/search/workbench.hpp"
#include "fit/driver.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// Rounds after which only the best starts go on.
constexpr int race_rounds = 2;
// A descent whose squared cost fell by less than this part of itself in two steps running has arrived, as far as a
// comparison of hypotheses can tell.
constexpr double arrived = 1e-4;

}  // namespace

std::size_t Workbench::starts_of_a_pack(std::size_t dimension) {
  const std::size_t sweeps = (dimension + sweep_directions - 1) / sweep_directions;
  return std::max<std::size_t>(2, static_cast<std::size_t>(lane_count) / sweeps);
}

// Independent descents in step, so that their points share packs.
Workbench::Reached Workbench::reached(const Layout& layout, const Objective& objective,
                                      const std::vector<std::vector<double>>& starts, int rounds) const {
  const SolverEntry* entry = find_solver("lm");
  struct Run {
    std::unique_ptr<Solver> solver;
    std::vector<double> best;
    double cost = diverged_cost;
    int idle = 0;  // steps running that were taken and gained next to nothing
  };
  std::vector<Run> runs;
  for (const std::vector<double>& start : starts) {
    Problem problem;
    problem.dimension = layout.dimension();
    problem.budget = static_cast<std::size_t>(rounds + 1) * (layout.dimension() + 1);
    problem.stream = Stream(seed_);
    problem.linear = layout.linear();
    problem.start = start;
    runs.push_back({entry->make(problem), start, diverged_cost, 0});
  }
  for (int round = 0; round < rounds; ++round) {
    if (const std::size_t survivors = starts_of_a_pack(layout.dimension());
        round == race_rounds && runs.size() > survivors) {
      std::ranges::stable_sort(runs, {}, &Run::cost);
      runs.resize(survivors);
    }
    Request batch;
    batch.derivatives = true;
    std::vector<std::size_t> asked;
    std::vector<Request> requests(runs.size());
    for (std::size_t k = 0; k < runs.size(); ++k) {
      if (runs[k].idle >= 2) {
        continue;
      }
      requests[k] = runs[k].solver->ask();
      if (!requests[k].points.empty()) {
        asked.push_back(k);
        batch.points.insert(batch.points.end(), requests[k].points.begin(), requests[k].points.end());
      }
    }
    if (asked.empty() || stopped_()) {
      break;
    }
    const Response answer = objective.evaluate(batch);
    const std::size_t d = layout.dimension();
    for (std::size_t i = 0; i < asked.size(); ++i) {
      Run& run = runs[asked[i]];
      const auto slice = [&](const std::vector<double>& values, std::size_t width) {
        return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(i * width),
                                   values.begin() + static_cast<std::ptrdiff_t>((i + 1) * width));
      };
      const double gained = squared(run.cost) - squared(answer.cost[i]);
      // A step that is taken back shortens the next one; it does not tell that there is nothing to gain.
      if (gained >= 0.0) run.idle = gained < arrived * squared(run.cost) ? run.idle + 1 : 0;
      if (answer.cost[i] < run.cost) {
        run.cost = answer.cost[i];
        run.best = requests[asked[i]].points;
      }
      run.solver->tell(requests[asked[i]],
                       {{answer.cost[i]}, slice(answer.gradient, d), slice(answer.gauss_newton, d * d), {}, {}});
    }
  }
  const auto best = std::ranges::min_element(runs, {}, &Run::cost);
  return {best->best, best->cost};
}

Fit Workbench::descended(const Hypothesis& what, const Layout& layout, const std::vector<std::vector<double>>& starts,
                         int rounds, const std::vector<Recording>* others) const {
  ByteWriter key;
  key.text("descents");
  add_layout(key, layout);
  key.whole(static_cast<std::uint64_t>(rounds));
  key.whole(starts.size());
  for (const std::vector<double>& start : starts) {
    key.numbers(start);
  }
  if (others != nullptr && checkpoint_ != nullptr) {
    add_recordings(key, *others);
  }
  return fit_piece(key, what, layout, [&] {
    const Reached best =
        reached(layout, Objective(layout, others != nullptr ? *others : split_->fit, options_), starts, rounds);
    return finished(what, layout, best.point, best.cost);
  });
}

Fit Workbench::from_anywhere(const Hypothesis& what, std::size_t budget) const {
  const Layout layout = this->layout(what);
  ByteWriter key;
  key.text("from anywhere");
  add_layout(key, layout);
  key.whole(budget);
  return fit_piece(key, what, layout, [&] { return searched(what, layout, budget); });
}

Fit Workbench::searched(const Hypothesis& what, const Layout& layout, std::size_t budget) const {
  const Objective objective(layout, split_->fit, options_);
  Problem problem;
  problem.dimension = layout.dimension();
  problem.budget = budget;
  problem.stream = Stream(seed_).child("base").child(what.model);
  problem.linear = layout.linear();
  problem.start = layout.initial();
  problem.screening = true;
  const RunResult run = run_solver(
      *find_solver("multistart-lm"), problem, [&](const Request& request) { return objective.evaluate(request); },
      [&](const RunResult&) { return !stopped_(); });
  if (run.best.empty() && stopped_()) {
    throw Stopped{};  // before the first point
  }
  return finished(what, layout, run.best, run.cost);
}

// The point that descents reach under the measured force.
std::vector<double> Workbench::under_measured_force(const Starts& starts, int rounds) const {
  ByteWriter key;
  key.text("under the measured force");
  add_layout(key, *starts.layout);
  key.whole(static_cast<std::uint64_t>(rounds));
  for (const std::vector<double>& start : starts.points) {
    key.numbers(start);
  }
  const std::string bytes = piece(key, [&] {
    ObjectiveOptions options = options_;
    options.under_measured_force = true;
    ByteWriter result;
    result.numbers(
        reached(*starts.layout, Objective(*starts.layout, split_->fit, options), starts.points, rounds).point);
    return result.bytes();
  });
  return ByteReader(bytes).numbers();
}

Fit Workbench::from_starts(const Hypothesis& what, const Starts& given, int rounds, std::size_t most) const {
  Starts starts = given;
  if (!starts.sizes.empty()) {
    starts.points = eased(given);
  }
  starts.points.resize(std::min(starts.points.size(), most));
  const bool balances =
      std::ranges::any_of(what.effects, [](const std::string& id) { return find_effect(id)->balances(); });
  if (!balances || starts.points.size() < 2) {
    return descended(what, *starts.layout, starts.points, rounds);
  }
  // What the descents reach without solving for the balance of forces, or the best start as it is: the better one goes
  // on with the balance solved. It is near, so that half the rounds do.
  std::vector<double> reached = under_measured_force(starts, rounds);
  std::vector<double> both = starts.points.front();
  both.insert(both.end(), reached.begin(), reached.end());
  const std::vector<double> cost = Objective(*starts.layout, split_->fit, options_).evaluate({both, false}).cost;
  return descended(what, *starts.layout, {cost[1] < cost[0] ? std::move(reached) : starts.points.front()},
                   (rounds + 1) / 2);
}

Fit Workbench::from_fit(const Hypothesis& what, const Fit& warm, int rounds, const Fit* also) const {
  return from_starts(what, starts(what, warm, also), rounds, start_count);
}

Fit Workbench::polished(const Fit& fit, int rounds) const {
  return descended(fit.what, *fit.layout, {fit.point}, rounds);
}

Fit Workbench::on_all(const Fit& fit, const std::vector<Recording>& all, int rounds) const {
  Fit result = descended(fit.what, *fit.layout, {fit.point}, rounds, &all);
  result.heldout = fit.heldout;
  return result;
}

std::vector<Fit> Workbench::from_fit(const std::vector<Hypothesis>& what, const Fit& warm, int rounds,
                                     const Fit* also) const {
  std::vector<Fit> fits(what.size());
  const Workbench each = shared_by(what.size());
  parallel_for(what.size(), options_.threads,
               [&](std::size_t k) { fits[k] = each.from_fit(what[k], warm, rounds, also); });
  return fits;
}

std::vector<Fit> Workbench::polished(const std::vector<Fit>& fits, int rounds) const {
  std::vector<Fit> result(fits.size());
  const Workbench each = shared_by(fits.size());
  parallel_for(fits.size(), options_.threads, [&](std::size_t k) { result[k] = each.polished(fits[k], rounds); });
  return result;
}

}  // namespace hysteron

#include "diagnose/search/workbench.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/squared.hpp"
#include "diagnose/residual/conditions.hpp"
#include "diagnose/search/relatives.hpp"
#include "fit/driver.hpp"
#include "fit/identify.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr std::size_t start_count = 8;  // sizes that a refit starts from
// Times that the size of a start is halved, to a sixteenth.
constexpr int most_halvings = 4;
// Rounds after which only the best starts go on.
constexpr int race_rounds = 2;
// Of a node of a richer law, part of its box.
constexpr double law_push = 0.03;
// A descent whose squared cost fell by less than this part of itself in two rounds running has arrived, as far as a
// comparison of hypotheses can tell.
constexpr double arrived = 1e-4;

// Values for the parameters of an effect that a fit does not have, from a kindred effect that it has; whether there are
// any.
bool take_over_kindred(const Fit& from, const Layout& to, std::vector<double>& point) {
  bool any = false;
  const std::vector<std::string>& known = from.layout->names();
  for (const ParameterLaw& law : to.laws()) {
    const std::string& name = to.names()[law.parameter];
    if (std::ranges::find(known, name) != known.end()) {
      continue;
    }
    for (const Kindred& row : kindred()) {
      const auto found = row.to == name ? std::ranges::find(known, row.from) : known.end();
      if (found == known.end()) {
        continue;
      }
      const double value =
          parameters_at(from.layout->held(), from.terms, law.drive_nodes.front(), law.frequency_nodes.front(),
                        middle_of(to.conditions()))[static_cast<std::size_t>(found - known.begin())];
      for (std::size_t k = 0; k < law.count(); ++k) {
        point[law.first + k] = std::clamp(to.unit(law.first + k, row.factor * value), 0.0, 1.0);
      }
      any = true;
    }
  }
  return any;
}

// Radical inverse: evenly spread numbers in (0, 1).
double halton(std::size_t index, std::size_t base) {
  double result = 0.0;
  double part = 1.0 / static_cast<double>(base);
  for (std::size_t i = index + 1; i > 0; i /= base) {
    result += part * static_cast<double>(i % base);
    part /= static_cast<double>(base);
  }
  return result;
}

}  // namespace

Workbench::Workbench(const DataScale& scale, Split split, LayoutOptions layout, ObjectiveOptions objective,
                     std::uint64_t seed, std::function<bool()> stopped)
    : scale_(scale),
      split_(std::make_shared<const Split>(std::move(split))),
      layout_(std::move(layout)),
      options_(std::move(objective)),
      seed_(seed),
      stopped_(std::move(stopped)) {
  noise_.reserve(split_->fit.size());
  for (const Recording& recording : split_->fit) {
    noise_.push_back(noise_floor(recording));
  }
  motions_ = motions_of(split_->fit);
}

void Workbench::take_noise_and_motions_of(const Workbench& whole) {
  for (std::size_t k = 0; k < split_->fit.size(); ++k) {
    const auto at = std::ranges::find(whole.split_->fit, split_->fit[k].file, &Recording::file);
    if (at != whole.split_->fit.end()) {
      noise_[k] = whole.noise_[static_cast<std::size_t>(at - whole.split_->fit.begin())];
      motions_[k] = whole.motions_[static_cast<std::size_t>(at - whole.split_->fit.begin())];
    }
  }
}

std::size_t Workbench::starts_of_a_pack(std::size_t dimension) {
  const std::size_t sweeps = (dimension + sweep_directions - 1) / sweep_directions;
  return std::max<std::size_t>(2, static_cast<std::size_t>(lane_count) / sweeps);
}

Workbench Workbench::shared_by(std::size_t tasks) const {
  Workbench result = *this;
  if (tasks > 1) {
    result.options_.threads = 1;
  }
  return result;
}

Layout Workbench::layout(const Hypothesis& what) const {
  LayoutOptions options = layout_;
  const CompositeModel model = make_model(what.model, what.effects);
  const std::vector<std::string> names = model.parameter_names();
  // Another base law need not have the parameters of the first. Its yield force then follows the drive as theirs.
  int lost = 0;
  std::erase_if(options.by_current, [&](const auto& law) {
    const bool absent = std::ranges::find(names, law.first) == names.end();
    lost = absent ? std::max(lost, law.second) : lost;
    return absent;
  });
  for (const Parameter& parameter : model.law->parameters) {
    if (lost > 0 && parameter.role == PhysicalRole::yield_force && !parameter.fixed) {
      options.by_current.try_emplace(std::string(parameter.name), lost);
    }
  }
  options = only_of(names, std::move(options));
  // A damping that an effect takes away or adds follows the drive as the law's own does.
  const std::vector<Parameter> cards = model.parameters();
  int order = 0;
  for (const auto& [name, power] : options.by_current) {
    const auto at = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    order = cards[at].role == PhysicalRole::damping ? std::max(order, power) : order;
  }
  for (std::size_t k = model.law->parameters.size(); k < names.size() && order > 0; ++k) {
    if (cards[k].role == PhysicalRole::damping && !cards[k].fixed) {
      options.by_current[names[k]] = order;
    }
  }
  for (const std::string& name : what.richer) {
    options.by_current[name] += 1;
  }
  return Layout(model, scale_, options);
}

Fit Workbench::carried_over(const Fit& fit, Hypothesis what) const {
  Fit result;
  result.what = std::move(what);
  result.layout = std::make_shared<const Layout>(layout(result.what));
  result.point = result.layout->initial();
  carry_over(*fit.layout, fit.terms, *result.layout, result.point);
  result.terms = result.layout->terms(result.point);
  return result;
}

Fit Workbench::with_neutral(const Fit& fit, const std::string& effect) const {
  Fit result = carried_over(fit, with(fit.what, effect_extension(effect)));
  result.cost = fit.cost;
  result.heldout = fit.heldout;
  return result;
}

Fit Workbench::less(const Fit& fit, const std::string& effect) const {
  return carried_over(fit, without(fit.what, effect_extension(effect)));
}

std::optional<Fit> Workbench::beside(const Fit& fit, const Extension& part) const {
  if (!in_series(part.effect) || std::ranges::any_of(fit.what.effects, in_series)) {
    return std::nullopt;
  }
  return scored(with_neutral(fit, part.effect));
}

Fit Workbench::finished(const Hypothesis& what, const Layout& layout, std::vector<double> point, double cost) const {
  Fit fit;
  fit.what = what;
  fit.layout = std::make_shared<const Layout>(layout);
  fit.terms = layout.terms(point);
  fit.point = std::move(point);
  fit.cost = cost;
  double sum = 0.0;
  for (const Judged& judged : split_->judge) {
    const double norm = normaliser(judged.recording, options_.normalisation);
    sum += residual(fit, judged.recording).mean_square(judged.from) / (norm * norm);
  }
  fit.heldout = std::sqrt(sum / static_cast<double>(split_->judge.size()));
  if (!std::isfinite(fit.heldout)) {
    fit.heldout = diverged_cost;
  }
  return fit;
}

// Independent descents in step, so that their points share packs.
Workbench::Reached Workbench::reached(const Layout& layout, const Objective& objective,
                                      const std::vector<std::vector<double>>& starts, int rounds) const {
  const SolverEntry* entry = find_solver("lm");
  struct Run {
    std::unique_ptr<Solver> solver;
    std::vector<double> best;
    double cost = diverged_cost;
    int idle = 0;  // rounds running in which next to nothing was gained
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
      run.idle = gained < arrived * squared(run.cost) ? run.idle + 1 : 0;
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

Starts Workbench::starts(const Hypothesis& what, const Fit& warm, const Fit* also) const {
  auto shared = std::make_shared<const Layout>(layout(what));
  const Layout& layout = *shared;
  std::vector<double> known = layout.initial();
  const std::vector<bool> fresh = carry_over(*warm.layout, warm.terms, layout, known);
  std::vector<double> known_also = layout.initial();
  if (also != nullptr) {
    carry_over(*also->layout, also->terms, layout, known_also);
  }
  std::vector<std::vector<double>> starts;
  std::array<double, start_count> pushes = {0.01, -0.02, 0.05, -0.1, 0.003, -0.005, 0.3, -0.3};
  // The effect that is new, if it is one and not a richer law.
  const bool known_before =
      what.effects.empty() || std::ranges::find(warm.what.effects, what.effects.back()) != warm.what.effects.end();
  const Part* added_effect = known_before ? nullptr : find_effect(what.effects.back());
  if (added_effect != nullptr && !added_effect->starts.empty()) {
    std::ranges::copy(added_effect->starts, pushes.begin());
  }
  constexpr std::array<std::size_t, 4> bases = {2, 3, 5, 7};
  std::vector<std::size_t> sizes;
  std::size_t shapes = 0;
  for (std::size_t c = 0, part = 0; c < known.size(); ++c) {
    if (fresh[c]) {
      const bool size = part++ == 0 || layout.coordinates()[c].linear;
      shapes += size ? 0 : 1;
      if (size) {
        sizes.push_back(c);
      }
    }
  }
  const std::size_t count = shapes > 0 ? 2 * start_count : start_count;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> start = also != nullptr && k % 2 == 1 ? known_also : known;
    std::size_t part = 0;
    for (std::size_t c = 0; c < start.size(); ++c) {
      if (!fresh[c]) {
        continue;
      }
      const bool first_of_part = part == 0;
      ++part;
      const double neutral = start[c];
      if (first_of_part || layout.coordinates()[c].linear) {
        // The size of the effect: away from nothing, to either side where there is one.
        const double by = pushes[k % start_count];
        const double push = neutral < 0.02 ? std::fabs(by) : (neutral > 0.98 ? -std::fabs(by) : by);
        start[c] = std::clamp(neutral + push, 0.0, 1.0);
      } else if (k > 1) {
        start[c] = 0.05 + 0.9 * halton(k, bases[std::min<std::size_t>(part - 1, bases.size() - 1)]);
      }
    }
    starts.push_back(std::move(start));
  }
  const auto added = static_cast<std::size_t>(std::ranges::count(fresh, true));
  if (added == 0) {
    starts.resize(1);
    // Only laws in the drive are richer, each node of which may move.
    for (const ParameterLaw& law : layout.laws()) {
      const std::string& name = layout.names()[law.parameter];
      const bool richer = std::ranges::count(what.richer, name) > std::ranges::count(warm.what.richer, name);
      for (std::size_t k = 0; richer && k < law.count(); ++k) {
        starts.push_back(known);
        double& node = starts.back()[law.first + k];
        node += node > 0.5 ? -law_push : law_push;
      }
    }
  } else if (added == 1 && also == nullptr && added_effect != nullptr && added_effect->starts.empty()) {
    starts.resize(starts_of_a_pack(layout.dimension()));  // one size: where it starts from matters little
  }
  if (also != nullptr && take_over_kindred(*also, layout, known_also)) {
    starts.push_back(known_also);
  }
  return {std::move(shared), std::move(starts), std::move(known), std::move(sizes)};
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

// The size of what is new is known to first order at best, and far too large a one is no place to descend from: it is
// halved until the start is no worse than nothing new, a few times.
std::vector<std::vector<double>> Workbench::eased(const Starts& starts) const {
  ByteWriter key;
  key.text("eased starts");
  add_layout(key, *starts.layout);
  key.numbers(starts.neutral);
  for (const std::vector<double>& start : starts.points) {
    key.numbers(start);
  }
  const std::string bytes = piece(key, [&] {
    const Objective objective(*starts.layout, split_->fit, options_);
    const double nothing = objective.evaluate({starts.neutral, false}).cost[0];
    std::vector<std::vector<double>> points = starts.points;
    std::vector<double> costs(points.size(), diverged_cost);
    for (int k = 0; k <= most_halvings; ++k) {
      Request request;
      std::vector<std::size_t> asked;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (k == 0 || costs[i] > nothing) {
          asked.push_back(i);
          for (const std::size_t c : k == 0 ? std::vector<std::size_t>{} : starts.sizes) {
            points[i][c] = 0.5 * (points[i][c] + starts.neutral[c]);
          }
          request.points.insert(request.points.end(), points[i].begin(), points[i].end());
        }
      }
      if (asked.empty()) {
        break;
      }
      const Response answer = objective.evaluate(request);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        costs[asked[i]] = answer.cost[i];
      }
    }
    ByteWriter result;
    for (std::size_t i = 0; i < points.size(); ++i) {
      result.numbers(points[i]);
      result.number(costs[i]);
    }
    return result.bytes();
  });
  ByteReader read(bytes);
  std::vector<std::pair<double, std::vector<double>>> sorted;
  for (std::size_t i = 0; i < starts.points.size(); ++i) {
    std::vector<double> point = read.numbers();
    sorted.emplace_back(read.number(), std::move(point));
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<double, std::vector<double>>::first);
  std::vector<std::vector<double>> result;
  result.reserve(sorted.size());
  for (auto& [cost, point] : sorted) {
    result.push_back(std::move(point));
  }
  return result;
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

Fit Workbench::scored(const Fit& fit) const {
  ByteWriter key;
  key.text("costs");
  add_fit(key, fit);
  return fit_piece(key, fit.what, *fit.layout, [&] {
    const Objective objective(*fit.layout, split_->fit, options_);
    return finished(fit.what, *fit.layout, fit.point, objective.evaluate({fit.point, false}).cost[0]);
  });
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

Residual Workbench::residual(const Fit& fit, const Recording& recording) const {
  // Recordings of the workbench are known by where they lie; others may be gone when the next one lies there.
  const std::vector<Recording>& own = split_->fit;
  const std::less<> before;
  if (own.empty() || before(&recording, own.data()) || !before(&recording, own.data() + own.size())) {
    return simulated(fit, recording);
  }
  ByteWriter key;
  add_parameters(key, fit);
  key.whole(static_cast<std::uint64_t>(&recording - own.data()));
  return residuals_->get(key.bytes(), [&] { return simulated(fit, recording); });
}

Residual Workbench::simulated(const Fit& fit, const Recording& recording) const {
  const Target target = make_target(recording, options_);
  Residual result{predict(fit.layout->model(), fit.layout->held(), fit.terms, target), target.run_in};
  for (std::size_t n = 0; n < result.force.size(); ++n) {
    result.force[n] = n < result.from ? 0.0 : result.force[n] - recording.force[n];
  }
  return result;
}

std::vector<Residual> Workbench::plain_residuals(const Fit& fit) const {
  std::vector<Residual> result(split_->fit.size());
  parallel_for(result.size(), options_.threads, [&](std::size_t k) { result[k] = residual(fit, split_->fit[k]); });
  return result;
}

Residuals Workbench::residuals(const Fit& fit) const {
  const std::vector<Recording>& recordings = split_->fit;
  Residuals result;
  result.of.resize(recordings.size());
  result.passed_on.resize(recordings.size());
  result.noise = noise_;
  for (const Recording& recording : recordings) {
    result.norms.push_back(normaliser(recording, options_.normalisation));
  }
  std::vector<Residual> shaken_too(recordings.size());
  parallel_for(2 * recordings.size(), options_.threads, [&](std::size_t task) {
    const std::size_t k = task / 2;
    if (task % 2 == 0) {
      result.of[k] = residual(fit, recordings[k]);
    } else {
      shaken_too[k] = residual(fit, shaken(recordings[k]));
    }
  });
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    // Both are compared with the same recorded force: the difference is that of the simulated ones.
    Residual& change = shaken_too[k];
    change.from = std::max(change.from, result.of[k].from);
    for (std::size_t n = 0; n < change.force.size(); ++n) {
      change.force[n] -= result.of[k].force[n];
    }
    result.passed_on[k] = change.mean_square();
  }
  return result;
}

std::vector<Sensitivity> Workbench::sensitivities(const Fit& fit, const Residuals& residuals) const {
  constexpr double step = 1e-3;  // relative, of the parameter
  std::vector<Sensitivity> result;
  for (const ParameterLaw& law : fit.layout->laws()) {
    const std::string& name = fit.layout->names()[law.parameter];
    // Of what may be zero no relative change can be told.
    if (name.find('.') != std::string::npos || fit.layout->cards()[law.parameter].box.lower < 0.0) {
      continue;
    }
    Fit moved = fit;
    for (Term& term : moved.terms) {
      if (term.parameter == law.parameter) {
        term.value *= 1.0 + step;
      }
    }
    Sensitivity row{name, std::vector<std::vector<double>>(split_->fit.size())};
    parallel_for(split_->fit.size(), options_.threads, [&](std::size_t k) {
      row.slope[k] = residual(moved, split_->fit[k]).force;
      for (std::size_t n = 0; n < row.slope[k].size(); ++n) {
        row.slope[k][n] = (row.slope[k][n] - residuals.of[k].force[n]) / step;
      }
    });
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace hysteron

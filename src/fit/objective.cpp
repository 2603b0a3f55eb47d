#include "fit/objective.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "fit/march_target.hpp"
#include "fit/pack.hpp"
#include "fit/parallel.hpp"

namespace hysteron {

namespace {

// Of one pack on one target, in packs (Objective::sum_costs, sum_derivatives).
std::size_t sums_size(std::size_t dimension, bool derivatives) {
  return 2 + (derivatives ? dimension + dimension * (dimension + 1) / 2 : 0);
}

// Sum over the parts of their bounds of |d rate / d state|, 1/s. A series element has none of its own: its state is
// solved for together with the force.
double stiffness_bound(const CompositeModel& model, const double* p, double speed) {
  double bound = 0.0;
  model.for_links([&](const Link& link) {
    const auto stiffness = link.part->on_double.stiffness;
    if (stiffness != nullptr) bound += stiffness(p + link.parameter, speed);
  });
  return bound;
}

}  // namespace

Objective::Objective(const Layout& layout, const std::vector<Recording>& recordings, const ObjectiveOptions& options)
    : Objective(layout, refer_to(recordings), options) {}

Objective::Objective(const Layout& layout, const std::vector<const Recording*>& recordings,
                     const ObjectiveOptions& options)
    : layout_(layout), threads_(options.threads), stopped_(options.stopped) {
  double total = 0.0;
  double pooled_normaliser = 0.0;
  std::size_t samples = 0;
  for (const Recording* recording : recordings) {
    samples += recording->size();
  }
  for (const Recording* at : recordings) {
    const Recording& recording = *at;
    Target target = make_target(recording, options, samples > options.most_prepared_samples);
    target.normaliser = normaliser(recording, options.normalisation);
    pooled_normaliser = std::max(pooled_normaliser, target.normaliser);
    total += static_cast<double>(recording.size() - target.run_in);
    targets_.push_back(std::move(target));
  }
  for (Target& target : targets_) {
    if (options.weighting == Weighting::pooled) {
      target.weight = 1.0 / (total * pooled_normaliser * pooled_normaliser);
    } else {
      target.weight = 1.0 / (static_cast<double>(target.force.size() - target.run_in) *
                             static_cast<double>(targets_.size()) * target.normaliser * target.normaliser);
    }
  }
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    screening_targets_.push_back(make_screening_target(targets_[k], *recordings[k], options));
  }
}

std::size_t Objective::samples() const {
  std::size_t total = 0;
  for (const Target& target : targets_) {
    total += target.force.size();
  }
  return total;
}

void Objective::describe_data(Problem& problem) const {
  problem.recordings.clear();
  for (const Target& target : targets_) {
    problem.recordings.push_back(target.force.size());
  }
  problem.states = static_cast<std::size_t>(layout_.model().states());
}

void Objective::check_stopped() const {
  if (stopped_ && stopped_()) {
    throw Stopped{};
  }
}

void Objective::sum_costs(const std::vector<double>& points, Rows rows, const Target& target, double* sums) const {
  const std::size_t d = layout_.dimension();
  const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
  std::vector<Lanes> nodes(d);
  for (std::size_t c = 0; c < d; ++c) {
    nodes[c] = lanes_of(points, rows, layout_, c, false, candidate);
  }
  const Lanes limit(1e12 * target.normaliser);
  Lanes squares;
  Lanes alive;
  march_target<Lanes>(
      layout_.model(), target,
      [&](const auto& drive, std::span<const double> conditions, Lanes* p) {
        parameters_of_pack(layout_, nodes, drive, target.frequency, conditions, p);
      },
      [&](std::size_t begin, std::size_t samples, const Lanes* out) {
        check_stopped();
        for (std::size_t k = 0; k < samples; ++k) {
          const Lanes residual = out[k] - Lanes(target.force[begin + k]);
          if (begin + k >= target.run_in) {
            squares = fma(residual, residual, squares);
          }
          alive += select(abs(residual) < limit, Lanes(1.0), Lanes(0.0));
        }
      },
      [&](std::size_t begin, std::size_t samples, const Lanes* out) {
        for (std::size_t k = 0; k < samples; ++k) {
          alive += select(abs(out[k] - Lanes(target.force[begin + k])) < limit, Lanes(1.0), Lanes(0.0));
        }
      });
  for (int lane = 0; lane < lane_count; ++lane) {
    sums[lane] = squares.lane(lane) * target.weight;
    sums[lane_count + lane] = alive.lane(lane);
  }
}

// A pack takes as long as its stiffest lane, so candidates are packed in the order of their stiffness. No lane depends
// on its company: the order changes no result.
std::vector<std::size_t> Objective::packing(const std::vector<double>& points) const {
  const std::size_t d = layout_.dimension();
  std::vector<std::size_t> order(points.size() / d);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const CompositeModel& model = layout_.model();
  if (order.size() <= lane_count || model.states() == 0) {
    return order;
  }
  const Target& target = targets_.front();
  const std::vector<double> conditions = target.conditions_at(0);
  std::vector<double> stiffness(order.size());
  std::vector<double> nodes(d);
  std::vector<double> p(model.parameter_count());
  for (std::size_t row = 0; row < order.size(); ++row) {
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = layout_.physical(c, points[row * d + c]);
    }
    parameters_of_pack(layout_, nodes, target.drive, target.frequency, conditions, p.data());
    const double bound = stiffness_bound(model, p.data(), target.fastest);
    stiffness[row] = std::isfinite(bound) ? bound : 1e300;
  }
  std::ranges::sort(
      order, [&](std::size_t a, std::size_t b) { return std::tie(stiffness[a], a) < std::tie(stiffness[b], b); });
  return order;
}

Response Objective::evaluate(const Request& request) const {
  if (request.window) {
    return evaluate_window(request);
  }
  const std::size_t d = layout_.dimension();
  const std::size_t points = request.points.size() / d;
  const std::size_t packs = (points + lane_count - 1) / lane_count;
  const std::size_t size = sums_size(d, request.derivatives) * lane_count;
  const std::vector<Target>& targets = request.screening ? screening_targets_ : targets_;
  const std::size_t tasks = packs * targets.size();
  const std::vector<std::size_t> order = packing(request.points);
  std::vector<double> sums(tasks * size);
  parallel_for(tasks, threads_, [&](std::size_t task) {
    const std::size_t first = task / targets.size() * lane_count;
    const Rows rows = Rows(order).subspan(first, std::min<std::size_t>(lane_count, points - first));
    const Target& target = targets[task % targets.size()];
    if (request.derivatives) {
      sum_derivatives(request.points, rows, target, sums.data() + task * size);
    } else {
      sum_costs(request.points, rows, target, sums.data() + task * size);
    }
  });
  double total = 0.0;
  for (const Target& target : targets) {
    total += static_cast<double>(target.force.size() + target.preroll);
  }
  Response response;
  response.cost.resize(points);
  if (request.derivatives) {
    response.gradient.assign(points * d, 0.0);
    response.gauss_newton.assign(points * d * d, 0.0);
  }
  for (std::size_t at = 0; at < points; ++at) {
    const std::size_t row = order[at];
    const std::size_t lane = at % lane_count;
    double squares = 0.0;
    double alive = 0.0;
    const auto sum = [&](std::size_t target, std::size_t slot) {
      return sums[(at / lane_count * targets.size() + target) * size + slot * lane_count + lane];
    };
    for (std::size_t target = 0; target < targets.size(); ++target) {
      squares += sum(target, 0);
      alive += sum(target, 1);
    }
    // A candidate that ran away is worse the earlier it did so.
    const bool finite = alive == total && squares < diverged_cost;
    response.cost[row] = finite ? std::sqrt(squares) : diverged_cost * (2.0 - alive / total);
    if (!request.derivatives || !finite) {
      continue;
    }
    for (std::size_t target = 0; target < targets.size(); ++target) {
      std::size_t slot = 2;
      for (std::size_t a = 0; a < d; ++a) {
        response.gradient[row * d + a] += sum(target, slot++);
      }
      for (std::size_t a = 0; a < d; ++a) {
        for (std::size_t b = a; b < d; ++b) {
          response.gauss_newton[(row * d + a) * d + b] += sum(target, slot++);
        }
      }
    }
    for (std::size_t a = 0; a < d; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        response.gauss_newton[(row * d + a) * d + b] = response.gauss_newton[(row * d + b) * d + a];
      }
    }
  }
  return response;
}

}  // namespace hysteron

#include "fit/objective.hpp"

#include <algorithm>
#include <cmath>

#include "fit/march_target.hpp"
#include "fit/packing.hpp"
#include "fit/parallel.hpp"

namespace hysteron {

namespace {

// Of one pack on one target, in packs (Objective::sum_costs, sum_derivatives).
std::size_t sums_size(std::size_t dimension, bool derivatives) {
  return 2 + (derivatives ? dimension + dimension * (dimension + 1) / 2 : 0);
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

template <class P>
void Objective::sum_costs(const std::vector<double>& points, Rows rows, const Target& target, double* sums,
                          std::size_t next_pack) const {
  const std::size_t d = layout_.dimension();
  const auto candidate = [&](std::size_t lane) { return std::min(lane, rows.size() - 1); };
  std::vector<P> nodes(d);
  for (std::size_t c = 0; c < d; ++c) {
    nodes[c] = lanes_of<P>(points, rows, layout_, c, false, candidate);
  }
  const P limit(1e12 * target.normaliser);
  P squares;
  P alive;
  march_target<P>(
      layout_.model(), target,
      [&](const auto& drive, std::span<const double> conditions, P* p) {
        parameters_of_pack(layout_, nodes, drive, target.frequency, conditions, p);
      },
      [&](std::size_t begin, std::size_t samples, const P* out) {
        check_stopped();
        for (std::size_t k = 0; k < samples; ++k) {
          const P residual = out[k] - P(target.force[begin + k]);
          if (begin + k >= target.run_in) {
            squares = fma(residual, residual, squares);
          }
          alive += select(abs(residual) < limit, P(1.0), P(0.0));
        }
      },
      [&](std::size_t begin, std::size_t samples, const P* out) {
        for (std::size_t k = 0; k < samples; ++k) {
          alive += select(abs(out[k] - P(target.force[begin + k])) < limit, P(1.0), P(0.0));
        }
      });
  for (int lane = 0; lane < P::lanes; ++lane) {
    double* own = sums + static_cast<std::size_t>(lane / lane_count) * next_pack + lane % lane_count;
    own[0] = squares.lane(lane) * target.weight;
    own[lane_count] = alive.lane(lane);
  }
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
  const std::size_t target_count = targets.size();
  // Pairs of packs leave work for every thread.
  const bool in_pairs = !request.derivatives && layout_.model().has_wide_march() &&
                        (packs + 1) / 2 * target_count >= static_cast<std::size_t>(team_size(threads_));
  const Packing packing = pack_candidates(layout_, request.points, targets_.front(), in_pairs);
  std::vector<double> sums(packs * target_count * size);
  parallel_for(packing.deals.size() * target_count, threads_, [&](std::size_t task) {
    const Deal& deal = packing.deals[task / target_count];
    const std::size_t target_at = task % target_count;
    const Target& target = targets[target_at];
    double* own = sums.data() + (deal.first_pack * target_count + target_at) * size;
    if (request.derivatives) {
      sum_derivatives(request.points, packing.rows(deal), target, own);
    } else if (deal.packs == 2) {
      sum_costs<WideLanes>(request.points, packing.rows(deal), target, own, target_count * size);
    } else {
      sum_costs<Lanes>(request.points, packing.rows(deal), target, own, 0);
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
    const std::size_t row = packing.order[at];
    const std::size_t lane = at % lane_count;
    double squares = 0.0;
    double alive = 0.0;
    const auto sum = [&](std::size_t target, std::size_t slot) {
      return sums[(at / lane_count * target_count + target) * size + slot * lane_count + lane];
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

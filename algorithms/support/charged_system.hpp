// The population of charged particles shared by css and adaptive-css; see css.cpp for equations and sources.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/support/population.hpp"

namespace hysteron::support {

struct ChargedSettings {
  double radius = 0.1;  // a, in terms of the dimensionless separation
  double separation_eps = 1e-8;
  double attract = 1.0;       // share of attracting forces
  bool worse_attract = true;  // some of the worse attract the better
  double memory_rate = 0.95;  // CMCR
  double pitch_rate = 0.1;    // PAR
  double bandwidth = 0.001;   // of the range
  std::size_t memory_size = 5;
};

class ChargedSystem {
 public:
  void configure(const ChargedSettings& options) { options_ = options; }

  // A new population at rest. Memory, best and worst are kept from before.
  void place(const std::vector<Point>& points, const std::vector<double>& cost) {
    position_ = points;
    cost_ = cost;
    velocity_.assign(points.size(), Point(points.empty() ? 0 : points.front().size(), 0.0));
    note(points, cost);
  }

  // The population after one move inside the box [lower, upper]; `progress` is t / T.
  std::vector<Point> moved(const Stream& stream, std::uint64_t generation, double progress, const Point& lower,
                           const Point& upper) const {
    const double velocity_weight = 0.5 * (1.0 - progress);
    const double force_weight = 0.5 * (1.0 + progress);
    std::vector<Point> next;
    for (std::size_t j = 0; j < position_.size(); ++j) {
      Draws draws(stream, generation, j);
      if (best_cost() >= diverged_cost) {
        // Without a finite cost there is neither charge nor force, and a population at rest would stay at rest.
        Point anywhere(lower.size());
        for (std::size_t d = 0; d < anywhere.size(); ++d) anywhere[d] = draws.uniform(lower[d], upper[d]);
        next.push_back(clamped(std::move(anywhere)));
        continue;
      }
      const Point force = force_per_charge(j, draws);
      Point point = position_[j];
      for (std::size_t d = 0; d < point.size(); ++d) {
        const double first = draws.uniform();
        const double second = draws.uniform();
        point[d] += first * force_weight * force[d] + second * velocity_weight * velocity_[j][d];
        if (point[d] < lower[d] || point[d] > upper[d]) point[d] = component_inside(d, lower[d], upper[d], draws);
      }
      next.push_back(std::move(point));
    }
    return next;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      for (std::size_t d = 0; d < points[j].size(); ++d) velocity_[j][d] = points[j][d] - position_[j][d];
    }
    position_ = points;
    cost_ = cost;
    note(points, cost);
  }

  [[nodiscard]] const Point& best() const { return memory_.front(); }
  [[nodiscard]] double best_cost() const { return memory_cost_.front(); }
  [[nodiscard]] const std::vector<Point>& memory() const { return memory_; }

 private:
  // Charged memory, sorted, best first; and the worst cost seen among the candidates that did not diverge.
  void note(const std::vector<Point>& points, const std::vector<double>& cost) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cost[i] < diverged_cost) worst_cost_ = std::max(worst_cost_, cost[i]);
      if (memory_.size() >= options_.memory_size && cost[i] >= memory_cost_.back()) continue;
      const auto place_of = std::upper_bound(memory_cost_.begin(), memory_cost_.end(), cost[i]);
      const auto index = place_of - memory_cost_.begin();
      memory_cost_.insert(place_of, cost[i]);
      memory_.insert(memory_.begin() + index, points[i]);
      if (memory_.size() > options_.memory_size) {
        memory_.pop_back();
        memory_cost_.pop_back();
      }
    }
  }

  [[nodiscard]] double charge(double cost) const {
    if (cost >= diverged_cost) return 0.0;
    const double span = worst_cost_ - memory_cost_.front();
    return span > 0.0 ? std::clamp((worst_cost_ - cost) / span, 0.0, 1.0) : 1.0;
  }

  // Whether a particle of cost `source` acts on one of cost `target`.
  bool acts(double source, double target, Draws& draws) const {
    if (source < target) return true;
    if (!options_.worse_attract || !(source > target) || source >= diverged_cost) return false;
    return target - best_cost() > draws.uniform() * (source - target);
  }

  Point force_per_charge(std::size_t j, Draws& draws) const {
    Point force(position_[j].size(), 0.0);
    for (std::size_t i = 0; i < position_.size(); ++i) {
      if (!acts(cost_[i], cost_[j], draws)) continue;
      double middle_square = 0.0;
      for (std::size_t d = 0; d < force.size(); ++d) {
        const double offset = 0.5 * (position_[i][d] + position_[j][d]) - memory_.front()[d];
        middle_square += offset * offset;
      }
      const double between = distance(position_[i], position_[j]);
      if (!(between > 0.0)) continue;
      const double separation = between / (std::sqrt(middle_square) + options_.separation_eps);
      const double a = options_.radius;
      const double field = separation < a ? separation / (a * a * a) : 1.0 / (separation * separation);
      double strength = charge(cost_[i]) * field;
      if (options_.attract < 1.0 && draws.uniform() >= options_.attract) strength = -strength;
      for (std::size_t d = 0; d < force.size(); ++d) force[d] += strength * (position_[i][d] - position_[j][d]);
    }
    return force;
  }

  double component_inside(std::size_t d, double lower, double upper, Draws& draws) const {
    if (draws.uniform() >= options_.memory_rate) return draws.uniform(lower, upper);
    double value = memory_[draws.below(memory_.size())][d];
    if (draws.uniform() < options_.pitch_rate) {
      value += options_.bandwidth * (upper - lower) * (2.0 * draws.uniform() - 1.0);
    }
    return std::clamp(value, lower, upper);
  }

  ChargedSettings options_;
  std::vector<Point> position_;
  std::vector<Point> velocity_;
  std::vector<double> cost_;
  std::vector<Point> memory_;
  std::vector<double> memory_cost_;
  double worst_cost_ = -1e300;
};

}  // namespace hysteron::support

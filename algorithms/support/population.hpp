// Tools shared by the sampling solvers: addressed draws, the unit box, ranking, and the ask/tell bookkeeping.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fit/solver.hpp"

namespace hysteron::support {

using Point = std::vector<double>;

// A cursor over the draws of one individual in one generation, so that every draw has the address
// (generation, individual, draw) and no draw is used twice.
class Draws {
 public:
  Draws(const Stream& stream, std::uint64_t generation, std::size_t individual)
      : stream_(&stream), generation_(generation), individual_(static_cast<std::uint32_t>(individual)) {}
  double uniform() { return stream_->uniform(generation_, individual_, next_++); }
  double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }
  double normal() { return stream_->normal(generation_, individual_, next_++); }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(stream_->below(n, generation_, individual_, next_++));
  }

 private:
  const Stream* stream_;
  std::uint64_t generation_;
  std::uint32_t individual_;
  std::uint32_t next_ = 0;
};

inline double clamp_unit(double value) { return std::clamp(value, 0.0, 1.0); }

inline Point clamped(Point point) {
  for (double& coordinate : point) coordinate = clamp_unit(coordinate);
  return point;
}

// Reflection into [0, 1], repeated as often as needed: the even extension with period 2.
inline double mirror_unit(double value) {
  if (value >= 0.0 && value <= 1.0) return value;
  double folded = std::fmod(std::fabs(value), 2.0);
  if (folded > 1.0) folded = 2.0 - folded;
  return clamp_unit(folded);
}

inline Point random_point(Draws& draws, std::size_t dimension) {
  Point point(dimension);
  for (double& coordinate : point) coordinate = draws.uniform();
  return point;
}

// Uniform points, individual by individual; the first one is the caller's start if there is one.
inline std::vector<Point> random_population(const Problem& problem, const Stream& stream, std::uint64_t generation,
                                            std::size_t count) {
  std::vector<Point> population;
  population.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Draws draws(stream, generation, i);
    population.push_back(random_point(draws, problem.dimension));
  }
  if (!problem.start.empty() && !population.empty()) population.front() = clamped(problem.start);
  return population;
}

inline double distance(const Point& first, const Point& second) {
  double sum = 0.0;
  for (std::size_t d = 0; d < first.size(); ++d) sum += (first[d] - second[d]) * (first[d] - second[d]);
  return std::sqrt(sum);
}

// Index of the smallest value; the first of equals.
inline std::size_t argmin(std::span<const double> values) {
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
}

inline std::size_t argmax(std::span<const double> values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

// Indices from best to worst, ties by index.
inline std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&values](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

// Fisher-Yates with addressed draws.
template <class Item>
void shuffle(std::vector<Item>& items, Draws& draws) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[draws.below(i)]);
}

// Costs are compared, subtracted and averaged below: an infinite or enormous cost would turn a difference into NaN.
inline double ordered_cost(double cost) {
  constexpr double largest = 1e100;
  return cost <= largest ? cost : largest;  // NaN too ends at the largest
}

// Ask/tell bookkeeping: an answered generation is passed to accept(); a shorter answer means that the budget is
// used, and the solver stops. ask() repeated without tell() returns the same request.
class SamplingSolver : public Solver {
 public:
  Request ask() final {
    if (!stopped_.empty()) return {};
    if (!pending_) {
      proposed_ = propose();
      pending_ = true;
      if (proposed_.empty() && stopped_.empty()) stopped_ = "points to propose: 0 < 1";
    }
    Request request;
    if (proposed_.empty()) return request;
    request.points.reserve(proposed_.size() * proposed_.front().size());
    for (const Point& point : proposed_) request.points.insert(request.points.end(), point.begin(), point.end());
    return request;
  }

  void tell(const Request& /*request*/, const Response& response) final {
    if (!pending_ || !stopped_.empty()) return;
    pending_ = false;
    evaluations_ += response.cost.size();
    if (response.cost.size() < proposed_.size()) {
      stopped_ = "points evaluated " + std::to_string(response.cost.size()) + " < points asked " +
                 std::to_string(proposed_.size()) + ": budget used";
      return;
    }
    std::vector<double> cost(proposed_.size());
    for (std::size_t i = 0; i < cost.size(); ++i) cost[i] = ordered_cost(response.cost[i]);
    const std::vector<Point> points = std::move(proposed_);
    proposed_.clear();
    accept(points, cost);
  }

  [[nodiscard]] std::string stopped_because() const final { return stopped_; }

 protected:
  // Next points, at least one.
  virtual std::vector<Point> propose() = 0;
  // Their costs, all of them.
  virtual void accept(const std::vector<Point>& points, const std::vector<double>& cost) = 0;

  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

 private:
  std::vector<Point> proposed_;
  bool pending_ = false;
  std::size_t evaluations_ = 0;
  std::string stopped_;
};

}  // namespace hysteron::support

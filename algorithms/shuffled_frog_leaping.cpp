// Shuffled frog leaping.
//
//   Frogs sorted by cost are dealt to m memeplexes: frog k to memeplex k mod m. In a memeplex, `steps` times: q frogs
//   are drawn, the one of rank j with probability 2 (n + 1 - j) / (n (n + 1)); the worst of them, U_w, leaps
//     S = min(rand (P_B - U_w), Smax) (and > -Smax),   U_w + S
//   with P_B the best of the q; if that is not better, with P_B the best of all frogs; if that is not better either, a
//   random point takes its place. Then all frogs are shuffled together and sorted again.
//
// Source: M. M. Eusuff, K. E. Lansey, J. Water Resour. Plann. Manage. 129(3):210-225, 2003, doi
//   10.1061/(ASCE)0733-9496(2003)129:3(210); M. Eusuff, K. Lansey, F. Pasha, Eng. Optim. 38(2):129-154, 2006, doi
//   10.1080/03052150500384759.
// Deviations and choices:
// - One rand per coordinate and leaps up to twice as long (`componentwise` 1, `stretch` 2), as later programs have.
//   With one rand per leap, as in the source (`componentwise` 0, `stretch` 1), frogs move on the lines between them
//   only; the memeplexes collapse into few such lines, and the method ends above random search (results/defaults.md).
//   Smax is a fraction of the range (setting `leap`, default 1: no limit in effect).
// - A leap out of the box counts as not better (as in the source) and costs no evaluation.
// - The memeplexes leap in step with each other, so that one request holds one frog of each. They share nothing between
//   shuffles except the best of all, which is that of the last shuffle.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_shuffled_frog_leaping;

namespace {

using support::Draws;
using support::Point;

constexpr Setting settings[] = {
    {"memeplexes", 0.0, 0.0, 1000.0,
     "memeplexes (m); 0: 5, or as many as a tenth of the budget has frogs for, at least 2"},
    {"frogs", 8.0, 2.0, 1000.0, "frogs in a memeplex (n)"},
    {"subset", 5.0, 2.0, 1000.0, "frogs drawn for one leap (q), at most n"},
    {"steps", 8.0, 1.0, 10000.0, "leaps in a memeplex between two shuffles"},
    {"stretch", 2.0, 0.1, 4.0, "factor of the leap; 1 as in the source"},
    {"componentwise", 1.0, 0.0, 1.0, "0 one random number per leap as in the source, 1 one per coordinate"},
    {"leap", 1.0, 1e-9, 1.0, "largest leap of a coordinate as a fraction of the range"},
};

enum class Leap { to_subset_best, to_overall_best, random };

struct Memeplex {
  std::vector<Point> frog;  // sorted, best first
  std::vector<double> cost;
  std::uint64_t step = 0;
  Leap leap = Leap::to_subset_best;
  std::size_t best = 0;   // of the drawn subset
  std::size_t worst = 0;  // likewise
};

class FrogLeaping final : public support::SamplingSolver {
 public:
  explicit FrogLeaping(const Problem& problem)
      : problem_(problem),
        frogs_(support::whole_setting(problem, solver_shuffled_frog_leaping, "frogs")),
        memeplexes_(memeplexes(problem, frogs_)),
        subset_(std::min(frogs_, support::whole_setting(problem, solver_shuffled_frog_leaping, "subset"))),
        steps_(support::whole_setting(problem, solver_shuffled_frog_leaping, "steps")),
        stretch_(setting(problem, solver_shuffled_frog_leaping, "stretch")),
        componentwise_(support::whole_setting(problem, solver_shuffled_frog_leaping, "componentwise") == 1),
        largest_leap_(setting(problem, solver_shuffled_frog_leaping, "leap")),
        subsets_(problem.stream.child("subsets")),
        leaps_(problem.stream.child("leaps")) {}

 protected:
  std::vector<Point> propose() override {
    if (groups_.empty()) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, memeplexes_ * frogs_);
    }
    std::vector<Point> points;
    active_.clear();
    for (std::size_t m = 0; m < memeplexes_; ++m) {
      if (groups_[m].step >= steps_) continue;
      active_.push_back(m);
      points.push_back(candidate(m));
    }
    return points;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (groups_.empty()) {
      deal(points, cost);
      return;
    }
    bool finished = true;
    for (std::size_t k = 0; k < active_.size(); ++k) {
      Memeplex& group = groups_[active_[k]];
      if (group.leap != Leap::random && cost[k] >= group.cost[group.worst]) {
        group.leap = group.leap == Leap::to_subset_best ? Leap::to_overall_best : Leap::random;
        continue;
      }
      replace(group, points[k], cost[k]);
      ++group.step;
      if (group.step < steps_) draw_subset(active_[k]);
    }
    for (const Memeplex& group : groups_) finished = finished && group.step >= steps_;
    if (!finished) return;
    std::vector<Point> all;
    std::vector<double> all_cost;
    for (const Memeplex& group : groups_) {
      all.insert(all.end(), group.frog.begin(), group.frog.end());
      all_cost.insert(all_cost.end(), group.cost.begin(), group.cost.end());
    }
    ++shuffle_;
    deal(all, all_cost);
  }

 private:
  void deal(const std::vector<Point>& frogs, const std::vector<double>& cost) {
    groups_.assign(memeplexes_, Memeplex{});
    const std::vector<std::size_t> order = support::ascending(cost);
    for (std::size_t k = 0; k < order.size(); ++k) {
      groups_[k % memeplexes_].frog.push_back(frogs[order[k]]);
      groups_[k % memeplexes_].cost.push_back(cost[order[k]]);
    }
    overall_best_ = frogs[order.front()];
    for (std::size_t m = 0; m < memeplexes_; ++m) draw_subset(m);
  }

  std::uint64_t address(const Memeplex& group) const { return shuffle_ * steps_ + group.step; }

  // Ranks without replacement, the triangular probabilities renormalised over those not drawn yet.
  void draw_subset(std::size_t m) {
    Memeplex& group = groups_[m];
    Draws draws(subsets_, address(group), m);
    std::vector<std::size_t> remaining(frogs_);
    for (std::size_t rank = 0; rank < frogs_; ++rank) remaining[rank] = rank;
    group.best = frogs_;
    group.worst = 0;
    for (std::size_t k = 0; k < subset_; ++k) {
      double total = 0.0;
      for (const std::size_t rank : remaining) total += static_cast<double>(frogs_ - rank);
      double pointer = total * draws.uniform();
      std::size_t chosen = 0;
      while (chosen + 1 < remaining.size() && pointer >= static_cast<double>(frogs_ - remaining[chosen])) {
        pointer -= static_cast<double>(frogs_ - remaining[chosen]);
        ++chosen;
      }
      group.best = std::min(group.best, remaining[chosen]);
      group.worst = std::max(group.worst, remaining[chosen]);
      remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    group.leap = Leap::to_subset_best;
  }

  // The next leap of the memeplex that stays in the box; the random point always does.
  Point candidate(std::size_t m) {
    Memeplex& group = groups_[m];
    const Point& worst = group.frog[group.worst];
    for (; group.leap != Leap::random;
         group.leap = group.leap == Leap::to_subset_best ? Leap::to_overall_best : Leap::random) {
      const bool near = group.leap == Leap::to_subset_best;
      const Point& goal = near ? group.frog[group.best] : overall_best_;
      const std::uint64_t stage = 3 * address(group) + (near ? 0 : 1);
      Draws draws(leaps_, stage, m);
      double share = draws.uniform();
      Point point = worst;
      bool inside = true;
      for (std::size_t d = 0; d < point.size(); ++d) {
        if (componentwise_ && d > 0) share = draws.uniform();
        point[d] += std::clamp(stretch_ * share * (goal[d] - worst[d]), -largest_leap_, largest_leap_);
        inside = inside && point[d] >= 0.0 && point[d] <= 1.0;
      }
      if (inside && support::distance(point, worst) > 0.0) return point;
    }
    Draws draws(leaps_, 3 * address(group) + 2, m);
    return support::random_point(draws, problem_.dimension);
  }

  // The worst of the subset is replaced and the memeplex sorted again.
  void replace(Memeplex& group, const Point& point, double cost) const {
    group.frog.erase(group.frog.begin() + static_cast<std::ptrdiff_t>(group.worst));
    group.cost.erase(group.cost.begin() + static_cast<std::ptrdiff_t>(group.worst));
    const auto place = std::upper_bound(group.cost.begin(), group.cost.end(), cost);
    group.frog.insert(group.frog.begin() + (place - group.cost.begin()), point);
    group.cost.insert(place, cost);
  }

  static std::size_t memeplexes(const Problem& problem, std::size_t frogs) {
    const std::size_t set = support::whole_setting(problem, solver_shuffled_frog_leaping, "memeplexes");
    return set > 0 ? set : support::population_within(problem.budget, {.usual = 5 * frogs, .least = 2 * frogs}) / frogs;
  }

  Problem problem_;
  std::size_t frogs_;
  std::size_t memeplexes_;
  std::size_t subset_;
  std::uint64_t steps_;
  double stretch_;
  bool componentwise_;
  double largest_leap_;
  Stream subsets_;
  Stream leaps_;
  std::uint64_t shuffle_ = 0;
  std::vector<Memeplex> groups_;
  std::vector<std::size_t> active_;
  Point overall_best_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_shuffled_frog_leaping);
  return std::make_unique<FrogLeaping>(problem);
}

}  // namespace

const SolverEntry solver_shuffled_frog_leaping = {
    "shuffled-frog-leaping",
    "Shuffled frog leaping",
    "Eusuff & Lansey, J. Water Resour. Plann. Manage. 129(3):210-225, 2003, doi\n"
    "10.1061/(ASCE)0733-9496(2003)129:3(210); Eusuff, Lansey & Pasha, Eng. Optim. 38(2):129-154, 2006, doi\n"
    "10.1080/03052150500384759",
    "Memeplexes of frogs; the worst of a drawn subset leaps towards the best of the subset, then of all, else to a\n"
    "random point; all are shuffled after a number of steps. The memeplexes leap side by side.",
    false,
    settings,
    make,
};

}  // namespace hysteron

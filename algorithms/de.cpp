// Differential evolution with success history and linear population reduction: L-SHADE, and jSO.
//
//   v_i = x_i + F_i (x_pbest - x_i) + F_i (x_r1 - x_r2),   r2 from population and archive;   binomial crossover CR_i
//   CR_i ~ N(M_CR, 0.1) cut to [0, 1];   F_i ~ Cauchy(M_F, 0.1), redrawn while <= 0, cut at 1
//   memory: weighted Lehmer mean sum w S^2 / sum w S with w ~ cost gain;   N = round(N0 + (4 - N0) used / budget)
//
// Sources: R. Tanabe, A. S. Fukunaga, Proc. CEC 2014, pp. 1658-1665, doi 10.1109/CEC.2014.6900380 (L-SHADE: N0 = 18 n,
//   H = 6, archive rate 2.6, p = 0.11, terminal value of M_CR); J. Brest, M. S. Maucec, B. Boskovic, Proc. CEC 2017,
//   pp. 1311-1318, doi 10.1109/CEC.2017.7969456 (jSO: N0 = 25 ln(n) sqrt(n), H = 5, archive rate 1, p from 0.25 to
//   0.125, M_F = 0.3, M_CR = 0.8, last slot 0.9, F weight 0.7 / 0.8 / 1.2 on the pbest term, limits on early F and CR).
// Deviations and doubts:
// - N0 is at most budget / 10 and at least 10: the formulas give 0 (jSO, n = 1) or more than a small budget holds.
// - F is redrawn at most 100 times, then set to 0.01; that branch is reached with probability below 1e-9.
// - jSO: the paper limits CR below in the first half and F above in the first 60 % of the budget; M_F and M_CR are
//   means of the old and the new value, as in the authors' code.
// - The schedule needs the whole budget in advance: another budget is another run, not a longer one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "algorithms/support/population.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_de;

namespace {

using support::Draws;
using support::Point;

constexpr std::size_t smallest_population = 4;
constexpr double terminal = -1.0;  // M_CR of a slot whose successes all had CR = 0

constexpr Setting settings[] = {
    {"jso", 0.0, 0.0, 1.0, "0 L-SHADE, 1 jSO"},
    {"population", 0.0, 0.0, 100000.0, "initial population; 0: 18 n (jSO 25 ln(n) sqrt(n)), at most budget / 10"},
    {"memory", 0.0, 0.0, 1000.0, "slots of the success history; 0: 6 (jSO 5)"},
    {"archive_rate", 0.0, 0.0, 10.0, "archive size relative to the population; 0: 2.6 (jSO 1)"},
    {"p", 0.11, 0.0, 1.0, "share of the best taken for pbest (L-SHADE; jSO has its own schedule)"},
};

class SuccessHistory final : public support::SamplingSolver {
 public:
  explicit SuccessHistory(const Problem& problem)
      : problem_(problem),
        jso_(support::whole_setting(problem, solver_de, "jso") == 1),
        first_count_(support::whole_setting(problem, solver_de, "population")),
        archive_rate_(setting(problem, solver_de, "archive_rate")),
        share_(setting(problem, solver_de, "p")),
        trials_(problem.stream.child("trials")),
        archive_draws_(problem.stream.child("archive")) {
    const double n = static_cast<double>(problem.dimension);
    if (first_count_ == 0) {
      const double wanted = jso_ ? std::round(25.0 * std::log(n) * std::sqrt(n)) : 18.0 * n;
      first_count_ = std::max<std::size_t>(10, std::min(static_cast<std::size_t>(wanted), problem.budget / 10));
    }
    first_count_ = std::max(first_count_, smallest_population);
    std::size_t slots = support::whole_setting(problem, solver_de, "memory");
    if (slots == 0) slots = jso_ ? 5 : 6;
    if (archive_rate_ <= 0.0) archive_rate_ = jso_ ? 1.0 : 2.6;
    memory_f_.assign(slots, jso_ ? 0.3 : 0.5);
    memory_cr_.assign(slots, jso_ ? 0.8 : 0.5);
  }

 protected:
  std::vector<Point> propose() override {
    if (generation_ == 0) {
      return support::random_population(problem_, problem_.stream.child("positions"), 0, first_count_);
    }
    const std::vector<std::size_t> order = support::ascending(cost_);
    const std::size_t count = population_.size();
    const double used = share_used();
    const double share = jso_ ? 0.25 - 0.125 * used : share_;
    const std::size_t best_count = std::min(
        count, std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(share * static_cast<double>(count)))));
    f_.assign(count, 0.0);
    cr_.assign(count, 0.0);
    std::vector<Point> trials;
    for (std::size_t i = 0; i < count; ++i) {
      Draws draws(trials_, generation_, i);
      draw_parameters(i, used, draws);
      trials.push_back(trial(i, order, best_count, used, draws));
    }
    return trials;
  }

  void accept(const std::vector<Point>& points, const std::vector<double>& cost) override {
    if (generation_ == 0) {
      population_ = points;
      cost_ = cost;
    } else {
      select(points, cost);
    }
    ++generation_;
  }

 private:
  [[nodiscard]] double share_used() const {
    if (problem_.budget == 0) return 1.0;
    return std::min(1.0, static_cast<double>(evaluations()) / static_cast<double>(problem_.budget));
  }

  void draw_parameters(std::size_t i, double used, Draws& draws) {
    const std::size_t slot = draws.below(memory_f_.size());
    const bool fixed = jso_ && slot + 1 == memory_f_.size();
    const double mean_f = fixed ? 0.9 : memory_f_[slot];
    const double mean_cr = fixed ? 0.9 : memory_cr_[slot];
    const double normal = draws.normal();
    double crossover = mean_cr == terminal ? 0.0 : support::clamp_unit(mean_cr + 0.1 * normal);
    if (jso_ && used < 0.25) {
      crossover = std::max(crossover, 0.7);
    } else if (jso_ && used < 0.5) {
      crossover = std::max(crossover, 0.6);
    }
    double factor = 0.0;
    for (int attempt = 0; attempt < 100 && factor <= 0.0; ++attempt) {
      factor = mean_f + 0.1 * std::tan(std::numbers::pi * (draws.uniform() - 0.5));
    }
    if (factor <= 0.0) factor = 0.01;
    factor = std::min(factor, 1.0);
    if (jso_ && used < 0.6) factor = std::min(factor, 0.7);
    f_[i] = factor;
    cr_[i] = crossover;
  }

  Point trial(std::size_t i, const std::vector<std::size_t>& order, std::size_t best_count, double used,
              Draws& draws) const {
    const std::size_t count = population_.size();
    std::size_t pbest = order[draws.below(best_count)];
    if (jso_ && used < 0.5) {
      while (pbest == i) pbest = order[draws.below(best_count)];  // best_count >= 2
    }
    std::size_t r1 = draws.below(count);
    while (r1 == i) r1 = draws.below(count);
    std::size_t r2 = draws.below(count + archive_.size());
    while (r2 == i || r2 == r1) r2 = draws.below(count + archive_.size());
    const Point& parent = population_[i];
    const Point& subtracted = r2 < count ? population_[r2] : archive_[r2 - count];
    double pull = f_[i];
    if (jso_) pull *= used < 0.2 ? 0.7 : used < 0.4 ? 0.8 : 1.2;
    const std::size_t forced = draws.below(problem_.dimension);
    Point point = parent;
    for (std::size_t d = 0; d < point.size(); ++d) {
      const bool crossed = draws.uniform() < cr_[i] || d == forced;
      if (!crossed) continue;
      double value =
          parent[d] + pull * (population_[pbest][d] - parent[d]) + f_[i] * (population_[r1][d] - subtracted[d]);
      if (value < 0.0) value = 0.5 * parent[d];
      if (value > 1.0) value = 0.5 * (1.0 + parent[d]);
      point[d] = value;
    }
    return point;
  }

  void select(const std::vector<Point>& points, const std::vector<double>& cost) {
    std::vector<double> gain;
    std::vector<double> good_f;
    std::vector<double> good_cr;
    const std::size_t archive_limit = archive_size(population_.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (cost[i] > cost_[i]) continue;
      if (cost[i] < cost_[i]) {
        Draws draws(archive_draws_, generation_, i);
        if (archive_.size() < archive_limit) {
          archive_.push_back(population_[i]);
        } else if (!archive_.empty()) {
          archive_[draws.below(archive_.size())] = population_[i];
        }
        gain.push_back(cost_[i] - cost[i]);
        good_f.push_back(f_[i]);
        good_cr.push_back(cr_[i]);
      }
      population_[i] = points[i];
      cost_[i] = cost[i];
    }
    if (!gain.empty()) remember(gain, good_f, good_cr);
    shrink();
  }

  void remember(const std::vector<double>& gain, const std::vector<double>& good_f,
                const std::vector<double>& good_cr) {
    // Gains are scaled by their largest so that neither 1e10 nor a denormal can overflow or vanish.
    const double largest = gain[support::argmax(gain)];
    double f1 = 0.0, f2 = 0.0, cr1 = 0.0, cr2 = 0.0;
    for (std::size_t i = 0; i < gain.size(); ++i) {
      const double weight = gain[i] / largest;
      f1 += weight * good_f[i];
      f2 += weight * good_f[i] * good_f[i];
      cr1 += weight * good_cr[i];
      cr2 += weight * good_cr[i] * good_cr[i];
    }
    const double old_f = memory_f_[slot_];
    const double old_cr = memory_cr_[slot_];
    const double new_f = f2 / f1;
    const bool ended = old_cr == terminal || good_cr[support::argmax(good_cr)] <= 0.0 || !(cr1 > 0.0);
    memory_f_[slot_] = jso_ ? 0.5 * (old_f + new_f) : new_f;
    if (ended) {
      memory_cr_[slot_] = terminal;
    } else {
      memory_cr_[slot_] = jso_ ? 0.5 * (old_cr + cr2 / cr1) : cr2 / cr1;
    }
    slot_ = (slot_ + 1) % memory_f_.size();
  }

  [[nodiscard]] std::size_t archive_size(std::size_t count) const {
    return static_cast<std::size_t>(std::lround(archive_rate_ * static_cast<double>(count)));
  }

  void shrink() {
    const double first = static_cast<double>(first_count_);
    const double wanted = first + (static_cast<double>(smallest_population) - first) * share_used();
    const std::size_t target = std::max(smallest_population, static_cast<std::size_t>(std::lround(wanted)));
    if (target < population_.size()) {
      std::vector<std::size_t> kept = support::ascending(cost_);
      kept.resize(target);
      std::sort(kept.begin(), kept.end());
      for (std::size_t i = 0; i < target; ++i) {
        if (kept[i] == i) continue;
        population_[i] = population_[kept[i]];
        cost_[i] = cost_[kept[i]];
      }
      population_.resize(target);
      cost_.resize(target);
    }
    // Random entries leave the archive.
    Draws draws(archive_draws_, generation_, archive_individual);
    while (archive_.size() > archive_size(population_.size())) {
      const std::size_t leaving = draws.below(archive_.size());
      archive_[leaving] = std::move(archive_.back());
      archive_.pop_back();
    }
  }

  // The number under which the archive draws: beyond every individual's.
  static constexpr std::size_t archive_individual = 1000000;

  Problem problem_;
  bool jso_;
  std::size_t first_count_;
  double archive_rate_;
  double share_;
  Stream trials_;
  Stream archive_draws_;
  std::uint64_t generation_ = 0;
  std::size_t slot_ = 0;
  std::vector<double> memory_f_;
  std::vector<double> memory_cr_;
  std::vector<double> f_;
  std::vector<double> cr_;
  std::vector<Point> population_;
  std::vector<double> cost_;
  std::vector<Point> archive_;
};

std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_de);
  return std::make_unique<SuccessHistory>(problem);
}

}  // namespace

const SolverEntry solver_de = {
    "de",
    "Differential evolution: L-SHADE, or jSO",
    "Tanabe & Fukunaga, CEC 2014, doi 10.1109/CEC.2014.6900380; Brest et al., CEC 2017, doi\n"
    "10.1109/CEC.2017.7969456",
    "current-to-pbest/1/bin with archive, success-history adaptation of F and CR, population reduced linearly from\n"
    "18 n to 4 over the budget. Initial population at most a tenth of the budget and at least 10.",
    false,
    settings,
    make,
};

}  // namespace hysteron

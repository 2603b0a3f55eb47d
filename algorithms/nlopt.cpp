// Every algorithm of the NLopt library as nlopt:NAME, with the names of the library.
//
//   minimise cost(u)^2 over the unit box; the gradient, where the algorithm wants one, is 2 J^T r
//
// The square is what the library is told because it is smooth at a perfect fit, where the cost itself has a kink. A
// problem without recordings may have costs of any sign, whose squares are in another order: of those the library is
// told the cost itself, by algorithms without derivatives (the others are given a sum of squares anyway).
// Source: S. G. Johnson, The NLopt nonlinear-optimization package; the papers behind each algorithm are in its manual.
// Algorithms the installed library was built without (StoGO, AGS in the distributions' packages) are not listed.
// What is done here and not by the library:
// - One external counter: the library asks point by point and is cut off at the budget, wherever it is.
// - Starts from the problem's start, else the centre of the box, step lengths and population by the library's own
// rules.
// - A point outside the box (PRAXIS and NEWUOA may ask for one) is evaluated at its projection onto the box.
// - A diverged candidate is answered with ten times the largest squared cost seen, of costs themselves with the largest
// seen and nine times their size or spread more: quadratic models do not survive 1e20.
// - MLSL descends with BOBYQA or L-BFGS, the augmented Lagrangian (without constraints here) minimises with them.
// - The library's random state is local to a thread; the run has its own thread and seeds it from its stream.
#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/support/rendezvous.hpp"
#include "algorithms/support/settings.hpp"
#include "fit/solver.hpp"

namespace hysteron {

extern const SolverEntry solver_nlopt;

namespace {

using support::ForeignSolver;
using support::Point;

constexpr Setting settings[] = {
    {"population", 0.0, 0.0, 100000.0, "population or starts a round of global algorithms; 0: the library's choice"},
    {"step", 0.0, 0.0, 1.0, "initial step of local algorithms as a share of the box; 0: the library's choice"},
    {"xtol", 1e-8, 0.0, 1.0, "stop when a step is smaller, relative to the point"},
    {"ftol", 1e-12, 0.0, 1.0, "stop when the squared cost (minimise: the cost) changes less, relative to it"},
};

struct OptimiserDeleter {
  void operator()(nlopt_opt opt) const { nlopt_destroy(opt); }
};
using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, OptimiserDeleter>;

// The objective as the library calls it.
struct Call {
  const ForeignSolver::Evaluate* evaluate;
  nlopt_opt opt;
  bool squares = true;  // the library is told squared costs
  // Lowest and largest value told of a candidate that did not diverge.
  double least = std::numeric_limits<double>::infinity();
  double worst = -std::numeric_limits<double>::infinity();
  // Calls before which the library must not be told to stop: the original DIRECT then reads outside its arrays.
  std::size_t uninterruptible = 0;
  std::size_t calls = 0;
  bool stopped = false;
};

// Above every value told of a candidate that did not diverge, and below the 1e20 from which the original DIRECT takes a
// value for none: told only of such values it reads outside its arrays.
constexpr double worthless = 1e19;

// Of a diverged candidate.
double penalty(const Call& call) {
  if (call.squares) return call.worst > 0.0 ? 10.0 * call.worst : worthless;
  if (!std::isfinite(call.worst)) return worthless;
  const double size = std::max(std::fabs(call.worst), call.worst - call.least);
  return call.worst + 9.0 * (size > 0.0 ? size : 1.0);
}

double objective(unsigned dimension, const double* x, double* gradient, void* data) {
  auto& call = *static_cast<Call*>(data);
  const bool wanted = gradient != nullptr;
  if (wanted) std::fill(gradient, gradient + dimension, 0.0);
  ++call.calls;
  if (call.stopped) {
    if (call.calls > call.uninterruptible) nlopt_force_stop(call.opt);
    return worthless;
  }
  Point point(dimension);
  for (unsigned d = 0; d < dimension; ++d) point[d] = std::isfinite(x[d]) ? support::clamp_unit(x[d]) : 0.5;
  const std::optional<support::Answer> answer = (*call.evaluate)(std::move(point), wanted);
  if (!answer) {
    call.stopped = true;
    if (call.calls > call.uninterruptible) nlopt_force_stop(call.opt);
    return worthless;
  }
  if (answer->cost >= diverged_cost) return penalty(call);
  const double value = call.squares ? answer->cost * answer->cost : answer->cost;
  call.least = std::min(call.least, value);
  call.worst = std::max(call.worst, value);
  if (wanted) {
    for (unsigned d = 0; d < dimension; ++d) gradient[d] = 2.0 * answer->gradient[d];
  }
  return value;
}

void configure(nlopt_opt opt, const Problem& problem, int evaluations) {
  nlopt_set_lower_bounds1(opt, 0.0);
  nlopt_set_upper_bounds1(opt, 1.0);
  nlopt_set_xtol_rel(opt, setting(problem, solver_nlopt, "xtol"));
  nlopt_set_ftol_rel(opt, setting(problem, solver_nlopt, "ftol"));
  nlopt_set_maxeval(opt, evaluations);
  if (const double step = setting(problem, solver_nlopt, "step"); step > 0.0) nlopt_set_initial_step1(opt, step);
}

// Whether the algorithm's own name says that it needs another one for its local searches.
bool nests(const char* name) { return std::strstr(name, "MLSL") != nullptr || std::strstr(name, "AUGLAG") != nullptr; }

// The undecorated MLSL and AUGLAG take the kind of their local algorithm: without derivatives here.
bool wants_gradient(const char* name) { return name[1] == 'D' && name[2] == '_'; }

std::string optimise(nlopt_algorithm algorithm, const Problem& problem, const ForeignSolver::Evaluate& evaluate) {
  const auto dimension = static_cast<unsigned>(problem.dimension);
  const char* name = nlopt_algorithm_to_string(algorithm);
  nlopt_srand(static_cast<unsigned long>(problem.stream.below(0x7fffffffU, 0) + 1));
  const Optimiser opt(nlopt_create(algorithm, dimension));
  if (!opt) return "nlopt_create failed: the installed NLopt has no " + std::string(name);
  const int evaluations = static_cast<int>(std::min<std::size_t>(problem.budget, 1000000000U));
  configure(opt.get(), problem, evaluations);
  Call call{&evaluate, opt.get(), !problem.recordings.empty() || wants_gradient(name)};
  if (std::strstr(name, "ORIG_DIRECT") != nullptr) call.uninterruptible = 2 * problem.dimension + 2;
  nlopt_set_min_objective(opt.get(), objective, &call);
  if (nests(name)) {
    const Optimiser local(nlopt_create(wants_gradient(name) ? NLOPT_LD_LBFGS : NLOPT_LN_BOBYQA, dimension));
    configure(local.get(), problem, evaluations);
    nlopt_set_local_optimizer(opt.get(), local.get());
  }
  const auto population = support::whole_setting(problem, solver_nlopt, "population");
  if (population > 0) nlopt_set_population(opt.get(), static_cast<unsigned>(population));
  Point x(problem.dimension, 0.5);
  if (!problem.start.empty()) x = support::clamped(problem.start);
  double value = 0.0;
  const nlopt_result result = nlopt_optimize(opt.get(), x.data(), &value);
  const char* word = nlopt_result_to_string(result);
  return "NLopt: " + std::string(word != nullptr ? word : "unknown result");
}

template <int A>
std::unique_ptr<Solver> make(const Problem& problem) {
  support::check_problem(problem, solver_nlopt);
  return std::make_unique<ForeignSolver>([problem](const ForeignSolver::Evaluate& evaluate) {
    return optimise(static_cast<nlopt_algorithm>(A), problem, evaluate);
  });
}

struct Algorithms {
  std::vector<std::string> texts;
  std::vector<SolverEntry> entries;
  std::vector<const SolverEntry*> rows;

  template <int... A>
  explicit Algorithms(std::integer_sequence<int, A...> /*all*/) {
    texts.reserve(2 * sizeof...(A));
    entries.reserve(sizeof...(A));
    (add(A, &make<A>), ...);
    for (const SolverEntry& entry : entries) rows.push_back(&entry);
  }

 private:
  void add(int index, std::unique_ptr<Solver> (*maker)(const Problem&)) {
    const auto algorithm = static_cast<nlopt_algorithm>(index);
    const char* name = nlopt_algorithm_to_string(algorithm);
    // The library says in the long name what it was built without.
    const std::string title = nlopt_algorithm_name(algorithm);
    if (name == nullptr || title.find("NOT COMPILED") != std::string::npos) return;
    if (std::strcmp(name, "LD_LBFGS_NOCEDAL") == 0) return;  // a name without code since NLopt 2.7
    const std::string& id = texts.emplace_back("nlopt:" + std::string(name));
    const std::string& full = texts.emplace_back("NLopt: " + title);
    entries.push_back(
        {id, full, solver_nlopt.reference, solver_nlopt.description, wants_gradient(name), settings, maker});
  }
};

std::span<const SolverEntry* const> members() {
  static const Algorithms algorithms(std::make_integer_sequence<int, NLOPT_NUM_ALGORITHMS>{});
  return algorithms.rows;
}

}  // namespace

const SolverEntry solver_nlopt = {
    "nlopt:*",
    "Algorithms of the NLopt library",
    "S. G. Johnson, The NLopt nonlinear-optimization package, version 2.7; its manual cites the paper of each "
    "algorithm",
    "Minimises the squared cost over the unit box from the start given, else the centre, point by point; the budget "
    "is\n"
    "cut by the program's own counter. Ends by the library's tolerances. A diverged candidate is answered with ten "
    "times\n"
    "the largest squared cost seen; a point outside the box is evaluated at its projection onto it. In `minimise`, "
    "whose\n"
    "costs may be negative, it is the cost itself that is minimised.",
    false,
    settings,
    nullptr,
    members,
};

}  // namespace hysteron

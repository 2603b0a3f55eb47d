// What an identification algorithm is: a pure function of box dimension, budget and random stream that is asked
// for points of the unit box and told their costs. It owns no clock, no global and no evaluation loop, so that it
// can be stopped anywhere and resumed by telling it again what it was told before.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.hpp"

namespace hysteron {

// Points a solver wants evaluated, row by row, in unit-box coordinates [0, 1]^dimension.
struct Request {
  std::vector<double> points;
  bool derivatives = false;  // ask for gradient and Gauss-Newton matrix too
  // A first look by a coarse integration over thinned samples, where Problem::screening allows it. Counts as any
  // evaluation, but its costs are only compared with each other and never reported.
  bool screening = false;
};

// Answer to a request, in the order of its points. `cost` is finite or a large ordered value for diverged
// candidates (>= diverged_cost), never NaN. For a sum of squares objective, cost^2 = sum r^2.
struct Response {
  std::vector<double> cost;
  std::vector<double> gradient;      // J^T r, count x dimension, only when derivatives were asked
  std::vector<double> gauss_newton;  // J^T J, count x dimension x dimension (row-major), likewise
};

inline constexpr double diverged_cost = 1e10;

// Everything a solver may know of its problem.
struct Problem {
  std::size_t dimension = 0;
  // Budget in evaluations; a request with derivatives costs (1 + dimension) evaluations per point.
  std::size_t budget = 0;
  Stream stream{0};
  // Coordinates in which the residual is affine (they may be projected out); one flag per coordinate.
  std::vector<bool> linear;
  // Requests for screening are understood.
  bool screening = false;
  // A starting point in the unit box, if the caller has one (warm start).
  std::vector<double> start;
  // Settings by name; a solver rejects unknown names when it is made.
  std::map<std::string, double> settings;
};

class Solver {
 public:
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  Solver(Solver&&) = delete;
  Solver& operator=(Solver&&) = delete;
  virtual ~Solver() = default;

  // Next points; empty when the solver has finished by itself. The driver truncates the request to what is left of
  // the budget and tells only the part that was evaluated; a solver must cope with a shorter answer.
  virtual Request ask() = 0;
  virtual void tell(const Request& request, const Response& response) = 0;
  // Why the solver stopped by itself, with its inequality; empty while it runs.
  [[nodiscard]] virtual std::string stopped_because() const { return {}; }
};

struct Setting {
  std::string_view name;
  double value;
  double lower;
  double upper;
  std::string_view meaning;
};

// A catalogue row. The file algorithms/NAME_WITH_UNDERSCORES.cpp defines `extern const SolverEntry solver_NAME...`.
struct SolverEntry {
  std::string_view id;  // as in the contract
  std::string_view title;
  std::string_view reference;    // source with DOI where known
  std::string_view description;  // a few lines: operators, deviations from the source
  bool uses_derivatives = false;
  std::span<const Setting> settings;
  std::unique_ptr<Solver> (*make)(const Problem&) = nullptr;
  // A family (id "nlopt:*") has its members instead of a maker: one entry each, found by their own ids.
  std::span<const SolverEntry* const> (*members)() = nullptr;
};

// Value of a setting: the problem's if given, else the entry's default.
double setting(const Problem& problem, const SolverEntry& entry, std::string_view name);

// What the files of algorithms/ define, families unopened.
std::span<const SolverEntry* const> solver_files();
// Every solver that can be made: files that are no family, then the members of families, then added ones.
std::span<const SolverEntry* const> solver_catalogue();
// nullptr when there is none. A family is no solver.
const SolverEntry* find_solver(std::string_view id);
// nullptr when there is none: "nlopt" or "nlopt:*".
const SolverEntry* find_solver_family(std::string_view id);
// Adds a solver from outside the tree; `entry` must outlive the program. Not while the catalogue is being read.
// Throws InputError when its id is taken.
void add_solver(const SolverEntry* entry);

}  // namespace hysteron

// What an identification algorithm is: a pure function of box dimension, budget and random stream that is asked
// for points of the unit box and told their costs. It owns no clock, no global and no evaluation loop, so that it
// can be stopped anywhere and resumed by telling it again what it was told before.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.hpp"

namespace hysteron {

// Part of the data, in time order: samples [begin, end) of a recording.
struct Window {
  std::size_t recording = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Points a solver wants evaluated, row by row, in unit-box coordinates [0, 1]^dimension.
struct Request {
  std::vector<double> points;
  bool derivatives = false;  // ask for gradient and Gauss-Newton matrix too
  // A first look by a coarse integration over thinned samples, where Problem::screening allows it. Counts as any
  // evaluation, but its costs are only compared with each other and never reported.
  bool screening = false;
  // For solvers that follow the data in time order: only this part, answered by its residuals. A point costs the share
  // of an evaluation that the window is of the data. Derivatives and screening are not asked with it.
  std::optional<Window> window = {};
  // State variables of every point at the first sample of the window, count x Problem::states. Not read where the
  // window begins a recording: there the simulation starts as it does for the cost.
  std::vector<double> states = {};
};

// Thrown out of an evaluation that was asked to stop.
struct Stopped {};

// Answer to a request, in the order of its points. `cost` is finite or a large ordered value for diverged
// candidates (>= diverged_cost), never NaN. For a sum of squares objective, cost^2 = sum r^2.
struct Response {
  std::vector<double> cost;
  std::vector<double> gradient;      // J^T r, count x dimension, only when derivatives were asked
  std::vector<double> gauss_newton;  // J^T J, count x dimension x dimension (row-major), likewise
  // With a window: its weighted residuals r, count x samples, `cost` being the root of their sum of squares, so that
  // cost^2 of the whole is the sum over all windows; and the state variables at the window's end. Zero where diverged.
  std::vector<double> residual;
  std::vector<double> states;
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
  // Samples of each recording in time order; empty where the data are not recordings: then one window {0, 0, 0} stands
  // for all residuals, at the price of one evaluation.
  std::vector<std::size_t> recordings;
  std::size_t states = 0;  // state variables of the simulation
  // A starting point in the unit box, if the caller has one (warm start).
  std::vector<double> start;
  // Settings by name; a solver rejects unknown names when it is made.
  std::map<std::string, double> settings;
};

// What a solver that follows the data believes after the samples before `sample` of a recording: mean and standard
// deviation of every coordinate of the unit box.
struct Tracked {
  std::size_t recording;
  std::size_t sample;
  std::vector<double> mean;
  std::vector<double> deviation;
};

// Where the descents of a solver that starts more than once ended.
struct Ends {
  std::vector<double> cost;  // in their order, without those that diverged
  std::size_t diverged = 0;  // starts
  bool screened = false;     // the costs are those of screening, which are only compared with each other
  double same = 1e-4;        // costs that differ by no more than this share are of one optimum

  void add(double end) {
    if (end < diverged_cost) {
      cost.push_back(end);
    } else {
      ++diverged;
    }
  }
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
  // Its belief against time, of the pass through the data that gave the result; empty for other solvers.
  [[nodiscard]] virtual std::vector<Tracked> track() const { return {}; }
  // Those so far; none for a solver that starts once.
  [[nodiscard]] virtual Ends ends() const { return {}; }
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
  std::function<std::unique_ptr<Solver>(const Problem&)> make;
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

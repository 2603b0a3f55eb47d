// hysteron_bbob: solvers of the program on the BBOB functions, logged as COCO's post-processing reads it.
//   hysteron_bbob --out DIR [--solvers cma-es,de,pso] [--functions 1,2] [--dimensions 2,5] [--instances 5] [--budget
//   1000]
// DIR/SOLVER is one experiment each; `python3 -m cocopp DIR/cma-es DIR/de ...` (COCO's own) draws them beside archived
// ones. The box is [-5, 5]^n and solvers stay in it. --markdown FILE writes how many runs reached 1e-8 by group.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/bbob_functions.hpp"
#include "bench/bbob_log.hpp"
#include "bench/program.hpp"
#include "core/error.hpp"
#include "fit/driver.hpp"
#include "io/output.hpp"

namespace hysteron::bbob {
namespace {

constexpr double solved = 1e-8;

struct Group {
  const char* name;
  int first;
  int last;
};
constexpr Group groups[] = {{"separable, 1-5", 1, 5},
                            {"moderate, 6-9", 6, 9},
                            {"ill-conditioned, 10-14", 10, 14},
                            {"multimodal, 15-19", 15, 19},
                            {"weak structure, 20-24", 20, 24}};

struct Tally {
  std::size_t runs = 0;
  std::size_t successes = 0;
  double spent = 0.0;  // evaluations of all runs, of the successful ones up to the target
};

// One run; whether it reached the target, and the evaluations until then or until its end.
std::pair<bool, std::size_t> run(const SolverEntry& entry, const Function& function, std::size_t budget, Log& log) {
  const std::size_t n = function.dimension();
  Problem problem;
  problem.dimension = n;
  problem.budget = budget;
  problem.stream = Stream(static_cast<std::uint64_t>(function.instance()))
                       .child("bbob")
                       .child(std::to_string(function.number()) + "/" + std::to_string(n));
  problem.linear.assign(n, false);
  log.begin(function);
  std::size_t reached = 0;
  std::vector<double> x(n);
  run_solver(
      entry, problem,
      [&](const Request& request) {
        Response response;
        for (std::size_t first = 0; first < request.points.size(); first += n) {
          for (std::size_t k = 0; k < n; ++k) x[k] = 2.0 * half_side * (request.points[first + k] - 0.5);
          const double value = function(x);
          log.evaluated(x, value);
          if (reached == 0 && log.best() <= solved) reached = log.evaluations();
          // Costs are compared as they are; a solver that weighs them sees the height above the optimum's own scale.
          response.cost.push_back(std::min(value - function.optimum(), 0.1 * diverged_cost));
        }
        return response;
      },
      [&](const RunResult&) { return reached == 0; });
  log.end();
  return {reached > 0, reached > 0 ? reached : log.evaluations()};
}

int run_all(int argc, char** argv) {
  std::vector<std::string> solvers{"cma-es", "de",          "aco-r",          "spso-2011",    "pso",
                                   "ga",     "nelder-mead", "pattern-search", "random-search"};
  std::vector<int> functions;
  std::vector<std::size_t> dimensions{2, 5};
  int instances = 5;
  std::size_t budget = 1000;
  std::string out;
  std::string markdown;
  CLI::App program("solvers of Hysteron on the BBOB functions, logged for COCO");
  program.add_option("--solvers", solvers, "ids of solvers without derivatives")->delimiter(',');
  program.add_option("--functions", functions, "1 to 24, default all")->delimiter(',')->check(CLI::Range(1, 24));
  program.add_option("--dimensions", dimensions, "of the search space")->delimiter(',')->check(CLI::Range(2, 40));
  program.add_option("--instances", instances, "1 to this")->check(CLI::Range(1, 1000));
  program.add_option("--budget", budget, "evaluations, times the dimension")->check(CLI::Range(1, 10000000));
  program.add_option("--out", out, "folder to write")->required();
  program.add_option("--markdown", markdown, "file for the table of successes");
  CLI11_PARSE(program, argc, argv);
  if (functions.empty()) {
    for (int k = 1; k <= function_count; ++k) functions.push_back(k);
  }
  std::map<std::string, std::map<std::size_t, std::map<int, Tally>>> tallies;  // solver, dimension, function
  for (const std::string& id : solvers) {
    const SolverEntry* entry = find_solver(id);
    if (entry == nullptr) throw InputError("unknown solver '" + id + "', see `hysteron list solvers`");
    if (entry->uses_derivatives) throw InputError("solver '" + id + "' wants derivatives, expected one without");
    Log log("hysteron " + id);
    for (const std::size_t dimension : dimensions) {
      for (const int number : functions) {
        for (int instance = 1; instance <= instances; ++instance) {
          const Function function(number, dimension, instance);
          const auto [reached, spent] = run(*entry, function, budget * dimension, log);
          Tally& tally = tallies[id][dimension][number];
          ++tally.runs;
          tally.successes += reached ? 1 : 0;
          tally.spent += static_cast<double>(spent);
        }
      }
    }
    const std::filesystem::path folder = std::filesystem::path(out) / id;
    for (const auto& [name, content] : log.files()) {
      std::filesystem::create_directories((folder / name).parent_path());
      write_file_atomically(folder / name, content);
    }
  }
  if (markdown.empty()) return 0;
  std::string text = fmt::format(
      "# BBOB: solvers of the program on the 24 noiseless functions\n\n"
      "Made by `build/release/bench/hysteron_bbob --out DIR --markdown results/bbob.md`: {} instances, {} evaluations "
      "times the dimension a run, defaults as shipped, the box [-5, 5]^n as a bound. Runs that came within 1e-8 of the "
      "optimum, and the expected evaluations for it over the dimension (all evaluations / successes / n), by group of "
      "functions. A few successes say little of the expected number.\n\n"
      "DIR holds the logs in COCO's format, whose post-processing draws them beside archived experiments; that has not "
      "been done here.\n",
      instances, budget);
  for (const std::size_t dimension : dimensions) {
    text += fmt::format("\n## Dimension {}\n\n| solver |", dimension);
    for (const Group& group : groups) text += fmt::format(" {} |", group.name);
    text += " all |\n|---|" + std::string("--:|--:|--:|--:|--:|--:|\n");
    for (const std::string& id : solvers) {
      text += "| " + id + " |";
      Tally all;
      const auto cell = [&](const Tally& tally) {
        return tally.runs == 0 ? std::string(" - |")
               : tally.successes == 0
                   ? fmt::format(" 0 of {} |", tally.runs)
                   : fmt::format(" {} of {}, {:.0f} |", tally.successes, tally.runs,
                                 tally.spent / static_cast<double>(tally.successes) / static_cast<double>(dimension));
      };
      for (const Group& group : groups) {
        Tally sum;
        for (const auto& [number, tally] : tallies[id][dimension]) {
          if (number < group.first || number > group.last) continue;
          sum.runs += tally.runs;
          sum.successes += tally.successes;
          sum.spent += tally.spent;
        }
        all.runs += sum.runs;
        all.successes += sum.successes;
        all.spent += sum.spent;
        text += cell(sum);
      }
      text += cell(all) + "\n";
    }
  }
  write_file_atomically(markdown, text);
  return 0;
}

}  // namespace
}  // namespace hysteron::bbob

int main(int argc, char** argv) { return hysteron::bench::guarded(hysteron::bbob::run_all, argc, argv); }

// Checks that every solver makes of its problem when it is made.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "core/error.hpp"
#include "fit/solver.hpp"

namespace hysteron::support {

inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

// Refuses unknown setting names, values outside their range, an empty box and a start of the wrong size.
inline void check_problem(const Problem& problem, const SolverEntry& entry) {
  const std::string id(entry.id);
  if (problem.dimension == 0) throw InputError("solver " + id + ": dimension 0, expected at least 1");
  if (!problem.start.empty() && problem.start.size() != problem.dimension) {
    throw InputError("solver " + id + ": start has " + std::to_string(problem.start.size()) +
                     " coordinates, expected " + std::to_string(problem.dimension));
  }
  for (const double coordinate : problem.start) {
    if (!std::isfinite(coordinate)) throw InputError("solver " + id + ": start is not finite");
  }
  for (const auto& [name, value] : problem.settings) {
    const auto row = std::find_if(entry.settings.begin(), entry.settings.end(),
                                  [&name = name](const Setting& known) { return known.name == name; });
    if (row == entry.settings.end()) {
      std::string known_names;
      for (const Setting& known : entry.settings) {
        known_names += (known_names.empty() ? "" : ", ") + std::string(known.name);
      }
      throw InputError("solver " + id + ": unknown setting '" + name + "', expected " +
                       (known_names.empty() ? "none" : "one of: " + known_names));
    }
    // Written so that NaN is refused as well.
    if (!(value >= row->lower && value <= row->upper)) {
      throw InputError("solver " + id + ": setting " + name + " = " + number_text(value) + ", expected " +
                       number_text(row->lower) + " to " + number_text(row->upper));
    }
  }
}

// A setting that counts or selects: must be a whole number, not negative.
inline std::size_t whole_setting(const Problem& problem, const SolverEntry& entry, std::string_view name) {
  const double value = setting(problem, entry, name);
  if (!(value >= 0.0) || value != std::floor(value)) {
    throw InputError("solver " + std::string(entry.id) + ": setting " + std::string(name) + " = " + number_text(value) +
                     ", expected a whole number");
  }
  return static_cast<std::size_t>(value);
}

// A size of a population: the usual one, but so many generations at least, and no fewer individuals than `least`.
struct PopulationRule {
  std::size_t usual;
  std::size_t generations = 10;
  std::size_t least = 4;
};

// Where the budget is not known (0), the usual size.
inline std::size_t population_within(std::size_t budget, const PopulationRule& rule) {
  return budget == 0 ? rule.usual : std::max(rule.least, std::min(rule.usual, budget / rule.generations));
}

// The setting `population`, where 0 stands for what the rule says. Throws InputError for 1: no method here has one
// individual.
inline std::size_t population_size(const Problem& problem, const SolverEntry& entry, const PopulationRule& rule) {
  const std::size_t set = whole_setting(problem, entry, "population");
  if (set == 1) {
    throw InputError("solver " + std::string(entry.id) + ": setting population = 1, expected 0 or at least 2");
  }
  return set == 0 ? population_within(problem.budget, rule) : set;
}

}  // namespace hysteron::support

#include "task/solver_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/suggest.hpp"

namespace hysteron {
namespace {

// "'pso' has no setting 'size' (did you mean ...?), see ...".
std::string unknown(const std::vector<const SolverEntry*>& solvers, const std::string& name) {
  std::vector<std::string> ids;
  std::vector<std::string> known;
  for (const SolverEntry* solver : solvers) {
    ids.emplace_back(solver->id);
    for (const Setting& one : solver->settings) known.emplace_back(one.name);
  }
  const std::string see = ids.size() == 1 ? ids.front() : "SOLVER";
  const std::string who = ids.empty()       ? "no solver here has a"
                          : ids.size() == 1 ? "'" + ids.front() + "' has no"
                                            : fmt::format("none of {} has a", fmt::join(ids, ", "));
  return fmt::format("{} setting '{}'{}, see `hysteron describe {}`", who, name, suggestion(name, known), see);
}

}  // namespace

const Setting* find_setting(const SolverEntry& solver, const std::string& name) {
  const auto row = std::ranges::find(solver.settings, name, &Setting::name);
  return row == solver.settings.end() ? nullptr : &*row;
}

void check_settings(const Message& option, const std::vector<const SolverEntry*>& solvers,
                    const std::map<std::string, double>& settings) {
  for (const auto& [name, value] : settings) {
    bool known = false;
    for (const SolverEntry* solver : solvers) {
      const Setting* row = find_setting(*solver, name);
      if (row == nullptr) continue;
      known = true;
      // Written so that NaN is refused as well.
      if (!(value >= row->lower && value <= row->upper)) {
        throw OptionError(option + fmt::format(": {} is {:g}, expected a number from {:g} to {:g} for {}", name, value,
                                               row->lower, row->upper, solver->id));
      }
    }
    if (!known) throw OptionError(option + (": " + unknown(solvers, name)));
  }
}

void check_settings(const Message& option, const std::vector<std::string>& solvers,
                    const std::map<std::string, double>& settings) {
  std::vector<const SolverEntry*> entries;
  for (const std::string& id : solvers) {
    const SolverEntry* entry = find_solver(id);
    if (entry == nullptr) return;
    entries.push_back(entry);
  }
  check_settings(option, entries, settings);
}

}  // namespace hysteron

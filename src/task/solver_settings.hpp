// Settings given to solvers that are chosen by somebody: each goes to those that know it, and somebody must.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/message.hpp"
#include "fit/solver.hpp"

namespace hysteron {

// nullptr where the solver has no such setting.
const Setting* find_setting(const SolverEntry& solver, const std::string& name);

// InputError, opened by `option`, for a setting that none of the solvers has, with the nearest that one of them has,
// and for a number beyond the range of one that has it.
void check_settings(const Message& option, const std::vector<const SolverEntry*>& solvers,
                    const std::map<std::string, double>& settings);
// The same of solvers by their ids. Ids of no solver are passed over: whoever makes them refuses them.
void check_settings(const Message& option, const std::vector<std::string>& solvers,
                    const std::map<std::string, double>& settings);

}  // namespace hysteron

// Curves of a study: distributions of run times, profiles, convergence, final costs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/cells.hpp"

namespace hysteron {

// Share of (problem, seed, target) reached within so many evaluations, by solver.
nlohmann::json ecdf(const Cells& study);
// Performance profiles (Dolan and More 2002) and data profiles (More and Wild 2009).
nlohmann::json profiles(const Cells& study);
// Quartiles of the best cost over the evaluations, by problem and solver.
nlohmann::json convergence(const Cells& study);
// Final costs in rising order, by problem and solver.
nlohmann::json waterfall(const Cells& study);

}  // namespace hysteron

// Pictures of catalogue entries for their pages, made of nothing but the catalogue.
#pragma once

#include <string>

#include "fit/solver.hpp"
#include "simulate/part.hpp"

namespace hysteron::app {

// Force of a law against displacement and velocity in its settled cycle, with the default parameters of the reference
// device, at three amplitudes.
std::string loop_figure(const Part& model);

// Best cost against evaluations of a solver, on Bouc-Wen and one recording of the simulated damper, from several random
// starts.
std::string convergence_figure(const SolverEntry& solver);

}  // namespace hysteron::app

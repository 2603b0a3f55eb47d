// What an effect adds to the force of a fit at a finite size, and what of it the fit's own parameters imitate.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Parts of the box of an effect's first parameter, off its neutral value, to try one after the other.
constexpr std::array<double, 8> effect_sizes = {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8};

// Residuals of all fitted recordings over their norms, the run-in left out.
Eigen::VectorXd stacked(const Workbench& bench, const Fit& fit);

// The fit with these coordinates moved, in units of their boxes.
Fit moved(Fit fit, const std::vector<std::size_t>& coordinates, double by);

// Coordinates of the size of an effect that the fit holds; empty where it is held at a value.
std::vector<std::size_t> size_of(const Fit& fit, const std::string& effect);

// The fit with the effect beside it at its neutral size. Its shape is the initial one or, where a small size of that is
// too stiff to be simulated on these recordings, the first of the starts of a refit that is not.
Fit at_neutral_size(const Workbench& bench, const Fit& fit, const std::string& effect);

// An orthonormal basis of what the parameters of the fit can do, to first order; `at` is stacked(bench, fit).
Eigen::MatrixXd imitable(const Workbench& bench, const Fit& fit, const Eigen::VectorXd& at);

}  // namespace hysteron

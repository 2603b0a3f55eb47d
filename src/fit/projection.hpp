// Variable projection for solvers that know nothing of it: the problem without the coordinates in which the residual is
// affine. At every point of the others, their optimum in the box is exact (Golub and Pereyra 1973,
// doi 10.1137/0710036):
//   minimise over 0 <= l <= 1:  |r + J (l - a)|^2 = |r|^2 + 2 (J'r).(l - a) + (l - a).J'J.(l - a),   a the middle of
//   the box
#pragma once

#include <Eigen/Core>

#include "fit/driver.hpp"

namespace hysteron {

// Minimiser s of g.s + s.A.s / 2 with lower <= s <= upper by an active set (bounded least squares after Stark and
// Parker, Comput. Stat. 10 (1995) 129-141); A symmetric and positive semidefinite.
[[nodiscard]] Eigen::VectorXd bounded_minimiser(const Eigen::MatrixXd& a, const Eigen::VectorXd& g,
                                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

// As run_solver, the solver seeing only the coordinates that are not affine. `evaluate` is asked for derivatives, of
// which the columns of the m affine coordinates are used: a point is charged 1 + m evaluations, and one more at the end
// is that of the result, whose cost is the objective's own. `best` and the dimension of the result are those of the
// whole problem. Throws InputError for a solver that uses derivatives or follows the recordings: the former project by
// themselves.
RunResult run_projected(const SolverEntry& entry, const Problem& problem, const Evaluate& evaluate,
                        const Observer& observer = {});

// Why `run_projected` refuses a solver; empty where it does not.
[[nodiscard]] std::string projection_refusal(const SolverEntry& entry);

}  // namespace hysteron

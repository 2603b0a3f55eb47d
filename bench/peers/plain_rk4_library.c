/* plain_rk4.h as a shared library, for scipy_peers.py through ctypes. */
#include "plain_rk4.h"

double plain_nrmse(const plain_problem* problem, const double* unit, double* residuals);

double plain_nrmse(const plain_problem* problem, const double* unit, double* residuals) {
  return plain_residuals(problem, unit, residuals);
}

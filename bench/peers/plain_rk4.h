/* The objective as a user of a general optimisation library writes it: the modified Bouc-Wen model marched by classical
 * Runge-Kutta, one step a sample, inputs at mid-step by linear interpolation, pow from libm. C and C++; the shared
 * library for SciPy and the C++ peers compile the same lines. Model and normal form as in models/modified_bouc_wen.cpp.
 */
#ifndef HYSTERON_BENCH_PEERS_PLAIN_RK4_H
#define HYSTERON_BENCH_PEERS_PLAIN_RK4_H

#include <math.h>
#include <stddef.h>

enum { plain_dimension = 8 }; /* alpha, c0, c1, k0, k1, x_y, share, n */

typedef struct {
  size_t samples;
  const double* time;         /* s */
  const double* displacement; /* m */
  const double* velocity;     /* m/s */
  const double* force;        /* N, measured */
  double normaliser;          /* max |force| */
  double lower[plain_dimension];
  double upper[plain_dimension];
  int logarithmic[plain_dimension];
} plain_problem;

static inline void plain_rates(const double* p, double x, double v, double y, double z, double* y_rate,
                               double* z_rate) {
  const double yr = (p[0] * z + p[1] * v + p[3] * (x - y)) / (p[1] + p[2]);
  const double u = v - yr;
  const double grip = pow(fabs(z), p[7]);
  const double sign = z < 0.0 ? -1.0 : 1.0;
  *y_rate = yr;
  *z_rate = (u - grip * (p[6] * fabs(u) * sign + (1.0 - p[6]) * u)) / p[5];
}

/* Residuals in units of the normaliser (may be NULL) at a point of the unit box; returns the NRMSE, 1e10 when the
 * simulation diverges. */
static inline double plain_residuals(const plain_problem* q, const double* unit, double* residuals) {
  double p[plain_dimension];
  for (int k = 0; k < plain_dimension; ++k) {
    p[k] = q->logarithmic[k] ? q->lower[k] * exp(unit[k] * log(q->upper[k] / q->lower[k]))
                             : q->lower[k] + unit[k] * (q->upper[k] - q->lower[k]);
  }
  double y = q->displacement[0];
  double z = 0.0;
  double sum = 0.0;
  for (size_t n = 0; n < q->samples; ++n) {
    const double x = q->displacement[n];
    const double v = q->velocity[n];
    double ky[4];
    double kz[4];
    plain_rates(p, x, v, y, z, &ky[0], &kz[0]);
    const double residual = (p[2] * ky[0] + p[4] * x - q->force[n]) / q->normaliser;
    if (residuals) {
      residuals[n] = residual;
    }
    sum += residual * residual;
    if (n + 1 == q->samples) {
      break;
    }
    const double h = q->time[n + 1] - q->time[n];
    const double xm = 0.5 * (x + q->displacement[n + 1]);
    const double vm = 0.5 * (v + q->velocity[n + 1]);
    plain_rates(p, xm, vm, y + 0.5 * h * ky[0], z + 0.5 * h * kz[0], &ky[1], &kz[1]);
    plain_rates(p, xm, vm, y + 0.5 * h * ky[1], z + 0.5 * h * kz[1], &ky[2], &kz[2]);
    plain_rates(p, q->displacement[n + 1], q->velocity[n + 1], y + h * ky[2], z + h * kz[2], &ky[3], &kz[3]);
    y += h / 6.0 * (ky[0] + 2.0 * ky[1] + 2.0 * ky[2] + ky[3]);
    z += h / 6.0 * (kz[0] + 2.0 * kz[1] + 2.0 * kz[2] + kz[3]);
    if (!(fabs(z) < 1e6) || !(fabs(y) < 1e6)) {
      for (size_t m = n + 1; residuals && m < q->samples; ++m) {
        residuals[m] = 1e3;
      }
      return 1e10;
    }
  }
  return sqrt(sum / (double)q->samples);
}

#endif

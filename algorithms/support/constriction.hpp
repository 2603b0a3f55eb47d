// The constriction coefficient and the particle update of Clerc & Kennedy (2002), as pure functions.
#pragma once

#include <cmath>

namespace hysteron::support {

// chi = 2 k / |2 - phi - sqrt(phi^2 - 4 phi)| for phi >= 4, and k below (type 1'' of the paper).
inline double constriction_coefficient(double phi, double k) {
  if (phi < 4.0) return k;
  return 2.0 * k / std::fabs(2.0 - phi - std::sqrt(phi * phi - 4.0 * phi));
}

struct ParticleState {
  double position;
  double velocity;
};

// One coordinate of one particle. `own_weight` and `informant_weight` are the products of the random factors and
// phi / 2, drawn afresh for every coordinate by the caller; `speed_limit` bounds |v|.
inline ParticleState constricted_move(ParticleState state, double own_best, double informant_best, double own_weight,
                                      double informant_weight, double chi, double speed_limit) {
  double velocity = chi * (state.velocity + own_weight * (own_best - state.position) +
                           informant_weight * (informant_best - state.position));
  if (velocity > speed_limit) velocity = speed_limit;
  if (velocity < -speed_limit) velocity = -speed_limit;
  return {state.position + velocity, velocity};
}

}  // namespace hysteron::support

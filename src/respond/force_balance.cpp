#include "respond/force_balance.hpp"

#include <cmath>
#include <vector>

#include "core/extent.hpp"
#include "core/squared.hpp"
#include "io/velocity.hpp"
#include "respond/motion_windows.hpp"

namespace hysteron {
namespace {

// Means over windows, one of each, of what the recording tells of the forces on the mass.
struct Forces {
  std::vector<double> inertia;  // m x''
  std::vector<double> springs;  // C x' + K x
};

std::optional<Forces> forces_of(const Recording& recording, const Rig& rig, const MotionWindows& windows) {
  if (windows.few()) return std::nullopt;
  Forces result{windows.bends_of(recording.displacement), windows.slopes_of(recording.displacement)};
  // A tenth of the acceleration may be noise of the displacement: no more is asked of it than its size.
  constexpr double most_noise = 0.01;  // of mean squares
  const double noise = channel_noise(recording.time, recording.displacement) * windows.noise_of_bends();
  if (!(squared(noise) < most_noise * mean_square_about_mean(result.inertia))) return std::nullopt;
  const std::vector<double> displacement = windows.means_of(recording.displacement);
  for (std::size_t n = 0; n < displacement.size(); ++n) {
    result.inertia[n] *= rig.mass;
    result.springs[n] = rig.damping * result.springs[n] + rig.stiffness * displacement[n];
  }
  return result;
}

bool acts(const Recording& recording, const Rig& rig) { return !rig.base && peak_of(recording.force) > 0.0; }

}  // namespace

bool is_of_damper(const Recording& recording, const Rig& rig) {
  if (!acts(recording, rig)) return false;
  const MotionWindows windows(recording);
  const auto forces = forces_of(recording, rig, windows);
  if (!forces) return false;
  std::vector<double> of_damper = forces->inertia;
  for (std::size_t n = 0; n < of_damper.size(); ++n) of_damper[n] = -of_damper[n] - forces->springs[n];
  const Following following = following_of(of_damper, windows.means_of(recording.force));
  // Alike within what mass, stiffness and a load cell are known to.
  constexpr double least_shared = 0.95;
  constexpr double worst_gain = 1.15;
  return following.shared > least_shared && following.gain < worst_gain && following.gain > 1.0 / worst_gain;
}

std::optional<double> inertia_over_known(const Recording& recording, const Rig& rig) {
  if (!acts(recording, rig) && rig.stiffness == 0.0 && rig.damping == 0.0) return std::nullopt;
  const MotionWindows windows(recording);
  const auto forces = forces_of(recording, rig, windows);
  if (!forces) return std::nullopt;
  std::vector<double> known = forces->springs;
  for (double& value : known) value = -value;
  if (acts(recording, rig)) {
    const std::vector<double> force = windows.means_of(recording.force);
    for (std::size_t n = 0; n < known.size(); ++n) known[n] += force[n];
  }
  const double square = mean_square_about_mean(known);
  if (!(square > 0.0)) return std::nullopt;
  return std::sqrt(mean_square_about_mean(forces->inertia) / square);
}

}  // namespace hysteron

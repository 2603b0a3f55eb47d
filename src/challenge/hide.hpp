// Effects hidden in recordings of a real damper, by arithmetic on their channels: no model and no integration is used,
// so that nothing is known of the damper but what it did. Placebos disorder the channels instead: no effect explains
// them.
//   inertia          F + m a
//   sensor-delay     F(t - lag)
//   force-drift      F + r t
//   cubic-stiffness  F + k3 x^3
//   asymmetry        F (1 + e sgn v)
//   end-stop         F + k_b (x - x_s)+ - k_b (-x - x_s)+
//   compliance       x + C F: the recorded motion holds a deflection that the damper does not see
//   clearance        x + (gap / 2) tanh(F / f_c), f_c 2 % of the peak force: likewise, with the play crossed at no
//   force x of the middle between the extremes of all recordings; a and v by smoothing the displacement
//   (io/velocity.hpp).
// Placebos: `shuffled-drive` (within a recording where it varies, else among the recordings), `flipped-velocity` (the
// velocity channel with the wrong sign), `swapped-forces` (every recording with the force of the next one).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "challenge/draws.hpp"
#include "core/recording.hpp"

namespace hysteron::challenge {

// What can be hidden, and the placebos; the check throws InputError for anything else.
[[nodiscard]] const std::vector<std::string_view>& hideable();
[[nodiscard]] const std::vector<std::string_view>& placebos();
void check_hideable(const std::string& id);

struct HiddenParameter {
  std::string name;
  std::string unit;
  double value;
};

// Recordings with something hidden in them. `share`: RMS of the change of force over RMS of the force, over all
// recordings; of the deflection over the amplitude of the smallest stroke for compliance and clearance; 0 for placebos.
struct Altered {
  std::string id;
  double share = 0.0;
  std::vector<HiddenParameter> parameters;
  std::vector<Recording> recordings;
};

// `id`: of hideable() or placebos(); else an InputError. Sizes are drawn.
[[nodiscard]] Altered alter(const std::vector<Recording>& recordings, const std::string& id, Draws& draws);

}  // namespace hysteron::challenge

// Effects hidden in recordings of a real damper, by arithmetic on their channels: no model and no integration is used,
// so that nothing is known of the damper but what it did. Placebos disorder the channels instead: no effect explains
// them.
//   inertia            F + m a
//   sensor-delay       F(t - lag)
//   force-drift        F + r t
//   cubic-stiffness    F + k3 x^3
//   gas-spring         F + f_g (1 / (1 - g x) - 1)
//   offset-force       F + f0
//   coulomb-friction   F + fc tanh(v / v_f), v_f 0.5 % of the largest speed
//   quadratic-damping  F + d2 v |v|
//   asymmetry          F (1 + e sgn v)
//   pinching           F (1 - p / (1 + y^4)), y = (x - x_p) / w
//   stiction           F (1 + a / (1 + s / L)^2), s the path since the start
//   degradation        F (1 - d n / N), n the turns so far, N the most of a recording
//   end-stop           F + k_b (x - x_s)+ - k_b (-x - x_s)+
//   compliance         x + C F: the recorded motion holds a deflection that the damper does not see
//   clearance          x + (gap / 2) tanh(F / f_c), f_c 2 % of the peak force: likewise, with the play crossed at no
//                      force
//   entrapped-gas      x + L F / (P + |F|): likewise, an isothermal pocket
//   series-dashpot     x + e integral of F: likewise, a leak
// x of the middle between the extremes of all recordings; a and v by smoothing the displacement (io/velocity.hpp).
// Several at once: their ids joined by +, one put in after the other.
// Placebos, as many of each as wanted, "kind#number": `shuffled-drive` (within a recording where it varies, else among
// the recordings), `flipped-velocity` (the velocity channel with the wrong sign; one), `swapped-forces` (every
// recording with the force of another one), `swapped-like-forces` (the same among recordings of about one amplitude),
// `reversed-forces` (backwards in time, from a place that is drawn), `shuffled-strokes` (every stroke between two turns
// with the force of another one).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "challenge/draws.hpp"
#include "core/recording.hpp"

namespace hysteron::challenge {

// What can be hidden, and the kinds of placebos; the check throws InputError for anything else.
[[nodiscard]] const std::vector<std::string_view>& hideable();
[[nodiscard]] const std::vector<std::string_view>& placebos();
void check_hideable(const std::string& id);
[[nodiscard]] bool is_placebo(const std::string& id);
// The ids of an id that is joined by +.
[[nodiscard]] std::vector<std::string> parts_of(const std::string& id);

struct HiddenParameter {
  std::string name;
  std::string unit;
  double value;
};

// Recordings with something hidden in them. `share`: RMS of the change of force over RMS of the force, over all
// recordings; of the deflection under the peak force over the amplitude of the smallest stroke for what is in series; 0
// for placebos; the largest of several.
struct Altered {
  std::string id;
  double share = 0.0;
  std::vector<HiddenParameter> parameters;
  std::vector<Recording> recordings;
};

// `id`: of hideable() or placebos(); else an InputError. The size is drawn where `share` is 0.
[[nodiscard]] Altered alter(const std::vector<Recording>& recordings, const std::string& id, Draws& draws,
                            double share = 0.0);

// RMS of the force over all recordings, N.
[[nodiscard]] double force_of(const std::vector<Recording>& recordings);

}  // namespace hysteron::challenge

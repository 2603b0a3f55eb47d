// A Bouc-Wen damper whose yield force and damping follow a lagged voltage, driven by steps of it:
//   u' = -eta (u - v),   alpha(u) = alpha_a + alpha_b u,   c0(u) = c0a + c0b u
#pragma once

#include <string>

#include "core/random.hpp"
#include "core/recording.hpp"

namespace hysteron {

// In the form of the Levenberg-Marquardt study, SI units and volts; gamma multiplies |v| z.
struct VoltageDamper {
  double c0a, c0b;          // N s/m, N s/(m V)
  double k0, x0;            // N/m, m
  double alpha_a, alpha_b;  // N/m, N/(m V)
  double beta, gamma;       // m^-n
  double A, n;
  double eta;  // 1/s
};
// Table 1 of that study. The printed c0a (kN s/m) and alpha_a (kN/m) would be hundreds of kN for a damper of 2.4 kN and
// are read as N s/m and N/m, the others as printed.
inline constexpr VoltageDamper rd8040_1 = {3146.5,  614.5,   279.5,  0.05, 4404.5, 64.5,
                                           22148.0, 22148.0, 1092.5, 2.2,  157.0};
inline constexpr VoltageDamper rd8041_1 = {8186.5,  994.5,   279.5,  0.05, 5114.5, 64.5,
                                           34848.0, 34848.0, 1091.0, 2.2,  157.0};

// Sines of 1, 2 and 3 Hz at 15, 10 and 5 mm, 1000 samples a second for 3 s from rest; the voltage steps every 0.17 s
// through 0 to 5 V, so that steps meet all phases of the motion, and half a second of 0 V opens each recording. The
// last one, 1.5 Hz and 12 mm with other steps, has the role validate. White noise of `noise` times the peak force on
// the force.
[[nodiscard]] Campaign stepped_voltage_campaign(const VoltageDamper& damper, double noise, const Stream& stream);

}  // namespace hysteron

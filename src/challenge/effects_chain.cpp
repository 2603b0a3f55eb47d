// Effects of the measuring chain.
#include "challenge/effect_list.hpp"
#include "challenge/forms_electric.hpp"

namespace hysteron::challenge {

void add_chain(Effects& list) {
  list.push_back({.id = "sensor-delay",
                  .group = Group::phase,
                  .needs = needs::frequencies,
                  .laws = all_laws,
                  .least = 0.01,
                  .most = 1.0});
  list.back().forms = {form("sensor-delay/transport", "pure delay",
                            [](const Device&, double s, Draws) { return part<ForceTransport>(0.02 * s); }),
                       form("sensor-delay/low-pass", "first order",
                            [](const Device&, double s, Draws) { return part<ForceLowPass>(0.02 * s); }),
                       form("sensor-delay/bessel", "second order",
                            [](const Device&, double s, Draws) { return part<ForceBessel>(0.02 * s); })};

  list.push_back({.id = "velocity-lag",
                  .group = Group::phase,
                  .needs = needs::frequencies,
                  .needs_velocity_channel = true,
                  .laws = {Law::bouc_wen, Law::bingham, Law::lugre},
                  .least = 0.01,
                  .most = 1.0});
  list.back().forms = {form("velocity-lag/transport", "pure delay",
                            [](const Device&, double s, Draws) { return part<VelocityTransport>(0.02 * s); }),
                       form("velocity-lag/bessel", "second order",
                            [](const Device&, double s, Draws) { return part<VelocityBessel>(0.02 * s); }),
                       form("velocity-lag/window", "one-sided window",
                            [](const Device&, double s, Draws) { return part<VelocityWindow>(0.02 * s); })};
}

}  // namespace hysteron::challenge

// Effects between the command and the field.
#include "challenge/effect_list.hpp"
#include "challenge/forms_electric.hpp"

namespace hysteron::challenge {

void add_electric(Effects& list) {
  list.push_back({.id = "coil-lag",
                  .group = Group::drive_path,
                  .needs = needs::steps,
                  .starved = needs::constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.01,
                  .most = 1.2});
  list.back().forms = {form("coil-lag/eddy-currents", "two time constants",
                            [](const Device&, double s, Draws shape) {
                              const double fast = 0.12 * s;
                              const double ratio = shape.uniform(4.0, 9.0);
                              return part<EddyCoil>(fast, ratio * fast, shape.uniform(0.2, 0.5));
                            }),
                       form("coil-lag/saturable", "inductance falls with the current",
                            [](const Device& d, double s, Draws shape) {
                              return part<SaturableCoil>(0.35 * s, d.level * shape.uniform(0.5, 1.2));
                            }),
                       form("coil-lag/current-loop", "second order", [](const Device&, double s, Draws shape) {
                         const double damping = shape.uniform(0.5, 0.9);
                         return part<LoopCoil>(2.0 * damping / (0.25 * s), damping);
                       })};

  list.push_back({.id = "magnetic-saturation",
                  .group = Group::drive_path,
                  .needs = {.levels = 4},
                  .starved = needs::constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.1,
                  .most = 4.0});
  list.back().forms = {form("magnetic-saturation/arctan", "arctangent",
                            [](const Device& d, double s, Draws) { return part<ArctanSaturation>(d.level / s); }),
                       form("magnetic-saturation/langevin", "Langevin function",
                            [](const Device& d, double s, Draws) { return part<LangevinSaturation>(d.level / s); }),
                       form("magnetic-saturation/froehlich", "hyperbola",
                            [](const Device& d, double s, Draws) { return part<FroehlichSaturation>(d.level / s); }),
                       form("magnetic-saturation/knee", "piecewise linear", [](const Device& d, double s, Draws) {
                         return part<KneeSaturation>(d.level / (1.0 + s));
                       })};

  list.push_back({.id = "magnetic-remanence",
                  .group = Group::drive_path,
                  .needs = needs::steps,
                  .starved = needs::constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.005,
                  .most = 0.5});
  list.back().forms = {form("magnetic-remanence/plays", "four plays",
                            [](const Device& d, double s, Draws) { return part<PlaysRemanence>(s * d.level); }),
                       form("magnetic-remanence/jiles", "follows the path of the current",
                            [](const Device& d, double s, Draws) { return part<JilesRemanence>(s * d.level); }),
                       form("magnetic-remanence/last-extreme", "offset by the last turn",
                            [](const Device& d, double s, Draws) { return part<LastExtremeRemanence>(s * d.level); })};
}

}  // namespace hysteron::challenge

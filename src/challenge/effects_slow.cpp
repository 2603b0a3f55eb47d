// Effects that act slowly.
#include <algorithm>
#include <numbers>

#include "challenge/effect_list.hpp"
#include "challenge/forms_slow.hpp"

namespace hysteron::challenge {

void add_slow(Effects& list) {
  list.push_back({.id = "self-heating",
                  .group = Group::slow,
                  .needs = needs::long_runs,
                  .laws = all_laws,
                  .least = 1e-3,
                  .most = 4.0});
  list.back().forms = {form("self-heating/damping", "of the viscous damping only",
                            [](const Device& d, double s, Draws shape) {
                              return part<DampingHeat>(d.energy, shape.log_uniform(20.0, 300.0), 1.5 * s);
                            }),
                       form("self-heating/yield", "of the yield force only",
                            [](const Device& d, double s, Draws shape) {
                              return part<YieldHeat>(d.energy, shape.log_uniform(20.0, 300.0), s);
                            }),
                       form("self-heating/arrhenius", "Arrhenius's law, yield force by a part",
                            [](const Device& d, double s, Draws shape) {
                              const double cooling = shape.log_uniform(20.0, 300.0);
                              return part<ArrheniusHeat>(d.energy, cooling, s, shape.uniform(0.4, 1.0));
                            }),
                       form("self-heating/two-stores", "fluid and body", [](const Device& d, double s, Draws shape) {
                         const double exchange = shape.log_uniform(1.5, 6.0);
                         const double cooling = shape.log_uniform(30.0, 300.0);
                         const double ratio = shape.uniform(0.1, 0.4);
                         return part<TwoStoreHeat>(d.energy, exchange, cooling, ratio, 1.5 * s,
                                                   shape.uniform(0.4, 1.0));
                       })};

  list.push_back({.id = "degradation",
                  .group = Group::slow,
                  .needs = needs::long_runs,
                  .laws = all_laws,
                  .least = 1e-3,
                  .most = 3.0});
  list.back().forms = {
      form("degradation/energy", "by dissipated energy, and ends",
           [](const Device& d, double s, Draws shape) {
             return part<EnergyWear>(std::min(s, 0.95), d.energy * shape.uniform(0.3, 1.0));
           }),
      form("degradation/path", "by travelled path",
           [](const Device& d, double s, Draws) { return part<PathWear>(0.6 * d.speed * d.longest / s); }),
      form("degradation/cycles", "by turns of the motion", [](const Device& d, double s, Draws) {
        // About one turn a quarter of the time that the fastest motion takes for its stroke and back.
        const double turns = std::max(d.longest * d.speed / (6.0 * d.amplitude), 2.0);
        return part<CycleWear>(s / turns, 0.2 * d.smallest_amplitude);
      })};

  list.push_back({.id = "stiction",
                  .group = Group::slow,
                  .needs = {.from_rest = true},
                  .laws = all_laws,
                  .least = 1e-3,
                  .most = 3.0});
  list.back().forms = {
      form("stiction/path", "fades with the path",
           [](const Device& d, double s, Draws shape) {
             return part<PathStiction>(s, d.amplitude * shape.log_uniform(1.0, 5.0));
           }),
      form("stiction/time", "fades with time",
           [](const Device&, double s, Draws shape) { return part<TimeStiction>(s, shape.log_uniform(0.15, 0.8)); }),
      form("stiction/thixotropic", "broken down by shear, built up at rest",
           [](const Device& d, double s, Draws shape) {
             const double length = d.amplitude * shape.log_uniform(0.5, 3.0);
             return part<ThixotropicStiction>(s, length, shape.log_uniform(5.0, 60.0));
           })};

  list.push_back({.id = "force-drift", .group = Group::slow, .needs = needs::long_runs, .laws = all_laws});
  static const auto sense = [](Draws& shape) { return shape.chance(0.5) ? 1.0 : -1.0; };
  list.back().forms = {form("force-drift/settling", "exponential",
                            [](const Device& d, double s, Draws shape) {
                              const double f = sense(shape) * s * d.force;
                              return part<SettlingDrift>(f, d.longest * shape.uniform(0.25, 0.8));
                            }),
                       form("force-drift/slow-sine", "less than half a cycle",
                            [](const Device& d, double s, Draws shape) {
                              const double omega = 2.0 * std::numbers::pi * shape.uniform(0.15, 0.45) / d.longest;
                              return part<SlowSineDrift>(s * d.force, omega,
                                                         shape.uniform(0.0, 2.0 * std::numbers::pi));
                            }),
                       form("force-drift/walk", "smoothed random walk", [](const Device& d, double s, Draws shape) {
                         std::vector<double> phases;
                         phases.reserve(64);
                         for (int k = 0; k < 64; ++k) phases.push_back(shape.uniform(0.0, 2.0 * std::numbers::pi));
                         return part<WalkDrift>(0.5 * s * d.force, 2.0 * std::numbers::pi * 0.3 / d.longest, phases);
                       })};
}

}  // namespace hysteron::challenge

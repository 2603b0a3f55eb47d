// Effects of the fluid.
#include "challenge/effect_list.hpp"
#include "challenge/forms_fluid.hpp"

namespace hysteron::challenge {

void add_fluid(Effects& list) {
  list.push_back({.id = "quadratic-damping",
                  .group = Group::curvature,
                  .needs = needs::frequencies,
                  .laws = all_laws,
                  .most = 2.0});
  list.back().forms = {form("quadratic-damping/turbulent", "power 1.75",
                            [](const Device& d, double s, Draws) { return part<TurbulentDrag>(s * d.force, d.speed); }),
                       form("quadratic-damping/laminar-transition", "laminar at low speed",
                            [](const Device& d, double s, Draws shape) {
                              return part<TransitionDrag>(s * d.force, d.speed, d.speed * shape.uniform(0.1, 0.35));
                            }),
                       form("quadratic-damping/opening-shim", "area that grows with the flow",
                            [](const Device& d, double s, Draws shape) {
                              return part<ShimDrag>(s * d.force, d.speed, d.speed * shape.uniform(1.5, 4.0));
                            })};

  list.push_back({.id = "shear-thinning",
                  .group = Group::curvature,
                  .needs = needs::frequencies,
                  .laws = all_laws,
                  .least = 0.02,
                  .most = 0.95});
  list.back().forms = {form("shear-thinning/power-law", "Ostwald-de Waele above a speed",
                            [](const Device& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.06, 0.25);
                              return part<PowerLawThinning>(s, speed, shape.uniform(0.2, 0.6));
                            }),
                       form("shear-thinning/cross", "Cross law",
                            [](const Device& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.08, 0.3);
                              return part<CrossThinning>(s, speed, shape.uniform(0.8, 1.6));
                            }),
                       form("shear-thinning/carreau-yasuda", "Carreau-Yasuda law, bend away from 2",
                            [](const Device& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.08, 0.3);
                              const double index = shape.uniform(0.05, 0.4);
                              return part<CarreauYasudaThinning>(
                                  s, speed, index,
                                  shape.chance(0.5) ? shape.uniform(0.7, 1.2) : shape.uniform(4.0, 6.0));
                            }),
                       form("shear-thinning/papanastasiou", "plastic fluid without a sharp yield point",
                            [](const Device& d, double s, Draws shape) {
                              return part<PapanastasiouThinning>(s, d.speed * shape.log_uniform(0.05, 0.25));
                            }),
                       form("shear-thinning/eyring", "Powell-Eyring law", [](const Device& d, double s, Draws shape) {
                         return part<EyringThinning>(s, d.speed * shape.log_uniform(0.03, 0.12));
                       })};

  static const auto sense = [](Draws& shape) { return shape.chance(0.5) ? 1.0 : -1.0; };
  list.push_back({.id = "asymmetry", .group = Group::even, .needs = needs::anything, .laws = all_laws, .most = 0.9});
  list.back().forms = {
      form("asymmetry/damping", "of the viscous damping only",
           [](const Device& d, double s, Draws shape) {
             const double e = sense(shape) * s;
             return part<DampingAsymmetry>(e, d.speed * shape.log_uniform(0.01, 0.1));
           }),
      form("asymmetry/yield", "of the yield force only, without a jump",
           [](const Device&, double s, Draws shape) { return part<YieldAsymmetry>(sense(shape) * s); }),
      form("asymmetry/unequal", "of yield force and damping, by different shares",
           [](const Device&, double s, Draws shape) {
             const double e = sense(shape) * s;
             return part<UnequalAsymmetry>(0.6 * e,
                                           shape.chance(0.5) ? shape.uniform(0.3, 0.7) : shape.uniform(1.3, 1.6));
           }),
      form("asymmetry/smooth", "comes with the speed", [](const Device& d, double s, Draws shape) {
        const double e = sense(shape) * s;
        return part<SmoothAsymmetry>(e, d.speed * shape.uniform(0.1, 0.35));
      })};

  list.push_back({.id = "pinching",
                  .group = Group::stop,
                  .needs = needs::anything,
                  .laws = all_laws,
                  .least = 0.02,
                  .most = 0.95});
  list.back().forms = {form("pinching/rational", "flat notch around a place",
                            [](const Device& d, double s, Draws shape) {
                              const double centre = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                              return part<RationalPinch>(s, centre, d.amplitude * shape.uniform(0.15, 0.4));
                            }),
                       form("pinching/one-sided", "weaker beyond a place",
                            [](const Device& d, double s, Draws shape) {
                              const double place = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                              return part<OneSidedPinch>(s, place, d.amplitude * shape.uniform(0.03, 0.12));
                            }),
                       form("pinching/groove", "groove of finite length", [](const Device& d, double s, Draws shape) {
                         const double centre = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                         return part<GroovePinch>(s, centre, d.amplitude * shape.uniform(0.3, 0.7));
                       })};
}

}  // namespace hysteron::challenge

// Effects parallel to the damper: offsets, springs, drags, frictions, masses and stops.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "challenge/effect_list.hpp"
#include "challenge/forms_fluid.hpp"
#include "challenge/forms_friction.hpp"
#include "challenge/forms_springs.hpp"

namespace hysteron::challenge {

void add_parallel(Effects& list) {
  list.push_back(
      {.id = "offset-force", .group = Group::even, .needs = needs::anything, .laws = {Law::modified_bouc_wen}});
  list.back().forms = {
      form("offset-force/scattering-preload", "differs a little from test to test",
           [](const Device& d, double s, Draws shape) {
             return part<ScatteringPreload>(s * d.force, scatter_of(shape, 0.07));
           }),
      form("offset-force/settling", "creeps after the start",
           [](const Device& d, double s, Draws shape) {
             const double share = shape.uniform(0.05, 0.2);
             return part<SettlingPreload>(s * d.force, share, shape.uniform(1.0, 4.0));
           }),
      form("offset-force/soft-spring", "charge of a large accumulator", [](const Device& d, double s, Draws shape) {
        return part<SoftSpringPreload>(s * d.force, d.amplitude * shape.uniform(8.0, 30.0));
      })};

  list.push_back(
      {.id = "linear-stiffness", .group = Group::stiffness, .needs = needs::anything, .laws = {Law::bingham}});
  list.back().forms = {
      form("linear-stiffness/softening", "a little softer at the ends",
           [](const Device& d, double s, Draws shape) {
             return part<SofteningSpring>(s * d.force / d.amplitude,
                                          (d.amplitude + std::abs(d.middle)) * shape.uniform(2.3, 4.0));
           }),
      form("linear-stiffness/elastomer", "relaxes a little",
           [](const Device& d, double s, Draws shape) {
             const double share = shape.uniform(0.1, 0.3);
             return part<ElastomerSpring>(s * d.force / d.amplitude, share, shape.log_uniform(0.03, 0.3));
           }),
      form("linear-stiffness/unequal", "stiffer to one side", [](const Device& d, double s, Draws shape) {
        return part<UnequalSpring>(s * d.force / d.amplitude, shape.uniform(-0.15, 0.15));
      })};

  list.push_back({.id = "viscous-damping",
                  .group = Group::curvature,
                  .needs = needs::levels_and_frequencies,
                  .laws = {Law::modified_bouc_wen},
                  .most = 1.5});
  list.back().forms = {
      form("viscous-damping/eddy-drag", "magnetic brake below its peak",
           [](const Device& d, double s, Draws shape) {
             return part<EddyDrag>(s * d.force / d.speed, d.speed * shape.uniform(2.5, 5.0));
           }),
      form("viscous-damping/ambient", "differs a little from test to test",
           [](const Device& d, double s, Draws shape) {
             return part<AmbientDrag>(s * d.force / d.speed, scatter_of(shape, 0.05));
           }),
      form("viscous-damping/viscoelastic", "dashpot on a stiff mount", [](const Device& d, double s, Draws shape) {
        return part<ViscoelasticDrag>(s * d.force / d.speed, shape.uniform(0.002, 0.006));
      })};

  list.push_back({.id = "coulomb-friction",
                  .group = Group::friction,
                  .needs = needs::small,
                  .laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis}});
  list.back().forms = {
      form("coulomb-friction/maxwell-slip", "contacts that slip one after another",
           [](const Device& d, double s, Draws) { return part<CoulombMaxwellSlip>(s * d.force, knee_of(d)); }),
      form("coulomb-friction/film", "arctangent of the speed",
           [](const Device& d, double s, Draws shape) {
             return part<CoulombFilm>(s * d.force, 0.5 * film_of(d, shape));
           }),
      form("coulomb-friction/rate-hardening", "grows with the logarithm of the speed",
           [](const Device& d, double s, Draws shape) {
             const double film = film_of(d, shape);
             return part<CoulombRateHardening>(s * d.force, film, shape.uniform(0.03, 0.1));
           })};

  list.push_back({.id = "seal-friction",
                  .group = Group::friction,
                  .needs = {.levels = 2, .frequencies = 2, .speed_decade = true},
                  .laws = all_laws});
  list.back().forms = {
      form("seal-friction/lugre", "bristles, hump exponential in the speed",
           [](const Device& d, double s, Draws shape) {
             const double hump = shape.uniform(1.5, 2.5);
             return part<SealLugre>(s * d.force, hump * s * d.force, stribeck_speed(d, shape), 0.5 * knee_of(d));
           }),
      form("seal-friction/film", "smooth film, rational hump",
           [](const Device& d, double s, Draws shape) {
             const double excess = shape.uniform(0.5, 1.5);
             const double speed = stribeck_speed(d, shape);
             return part<SealFilm>(s * d.force, excess * s * d.force, speed, 0.3 * speed);
           }),
      form("seal-friction/maxwell-slip", "contacts that slip one after another, Gaussian hump",
           [](const Device& d, double s, Draws shape) {
             const double excess = shape.uniform(0.5, 1.5);
             return part<SealMaxwellSlip>(s * d.force, excess * s * d.force, stribeck_speed(d, shape), knee_of(d));
           })};

  list.push_back({.id = "pre-yield-hysteresis",
                  .group = Group::friction,
                  .needs = needs::small,
                  .laws = {Law::bingham, Law::tanh_hysteresis}});
  list.back().forms = {
      form("pre-yield-hysteresis/iwan", "contacts of equal stiffness that slip one after another",
           [](const Device& d, double s, Draws shape) {
             return part<PreYieldIwan>(s * d.force, 2.0 * d.amplitude * shape.log_uniform(0.05, 0.2));
           }),
      form("pre-yield-hysteresis/sharp-knee", "Bouc-Wen with an exponent above 1",
           [](const Device& d, double s, Draws shape) {
             const double length = d.amplitude * shape.log_uniform(0.05, 0.2);
             return part<PreYieldSharpKnee>(s * d.force, length, shape.uniform(1.5, 3.0));
           }),
      form("pre-yield-hysteresis/creeping", "relaxes at rest", [](const Device& d, double s, Draws shape) {
        const double length = d.amplitude * shape.log_uniform(0.05, 0.2);
        return part<PreYieldCreeping>(s * d.force, length, shape.log_uniform(0.4, 2.0));
      })};

  const auto swept = [](const Device& d, Draws& shape) {
    return shape.uniform(0.45, 0.75) / (d.amplitude + std::abs(d.middle));
  };
  static const auto gas_swept = swept;
  list.push_back({.id = "gas-spring", .group = Group::even, .needs = needs::anything, .laws = all_laws, .most = 3.0});
  list.back().forms = {
      form("gas-spring/heat-exchange", "isothermal when slow, adiabatic when fast",
           [](const Device& d, double s, Draws shape) {
             const double g = gas_swept(d, shape);
             return part<HeatExchangingGas>(s * d.force, g, 1.4, shape.log_uniform(0.05, 1.0));
           }),
      form("gas-spring/dissolved", "isothermal, gas goes into solution",
           [](const Device& d, double s, Draws shape) {
             const double g = gas_swept(d, shape);
             const double solubility = shape.uniform(0.1, 0.3);
             return part<DissolvedGas>(s * d.force, g, solubility, shape.log_uniform(0.3, 3.0));
           }),
      form("gas-spring/one-sided", "piston on its stop for part of the stroke",
           [](const Device& d, double s, Draws shape) {
             const double from = d.middle + d.amplitude * shape.uniform(-0.5, 0.0);
             return part<OneSidedGas>(s * d.force, shape.uniform(0.4, 0.65) / (d.middle + d.amplitude - from), from);
           }),
      form("gas-spring/elastic-bag", "isothermal in a bag that widens", [](const Device& d, double s, Draws shape) {
        const double g = gas_swept(d, shape);
        return part<ElasticBagGas>(s * d.force, g, shape.uniform(0.1, 0.4));
      })};

  list.push_back({.id = "inertia",
                  .group = Group::phase,
                  .needs = needs::frequencies,
                  .starved = needs::one_frequency,
                  .can_starve = true,
                  .laws = {Law::bouc_wen, Law::tanh_hysteresis, Law::lugre},
                  .most = 2.0});
  list.back().forms = {
      form("inertia/of-place", "fluid mass that changes over the stroke",
           [](const Device& d, double s, Draws shape) {
             const double slope = shape.uniform(0.15, 0.5) * (shape.chance(0.5) ? 1.0 : -1.0);
             return part<MassOfPlace>(s * d.force / d.acceleration, slope, d.amplitude);
           }),
      form("inertia/sprung-fixture", "mass on a stiff fixture",
           [](const Device& d, double s, Draws shape) {
             const double omega = 2.0 * std::numbers::pi * shape.uniform(25.0, 60.0);
             return part<SprungMass>(s * d.force / d.acceleration, omega, shape.uniform(0.1, 0.4));
           }),
      form("inertia/entrained", "history of the motion entrains more", [](const Device& d, double s, Draws shape) {
        const double more = shape.uniform(0.2, 0.6);
        const double fast = shape.log_uniform(0.01, 0.03);
        return part<EntrainedMass>(s * d.force / d.acceleration, more, fast, 4.0 * fast);
      })};

  list.push_back(
      {.id = "cubic-stiffness", .group = Group::stiffness, .needs = needs::anything, .laws = all_laws, .most = 2.0});
  list.back().forms = {
      form("cubic-stiffness/sinh", "hyperbolic sine",
           [](const Device& d, double s, Draws shape) {
             const double reach = shape.uniform(2.5, 4.0);
             return part<SinhSpring>(s * d.force / std::sinh(reach), (d.amplitude + std::abs(d.middle)) / reach);
           }),
      form("cubic-stiffness/tan", "tangent",
           [](const Device& d, double s, Draws shape) {
             return part<TangentSpring>(0.3 * s * d.force,
                                        (d.amplitude + std::abs(d.middle)) * shape.uniform(1.15, 1.4));
           }),
      form("cubic-stiffness/quintic", "third and fifth power", [](const Device& d, double s, Draws shape) {
        return part<QuinticSpring>(s * d.force, d.amplitude + std::abs(d.middle), shape.uniform(0.3, 0.8));
      })};

  static const auto stops = [](const Device& d, Draws& shape) {
    return StopPlaces{d.middle + shape.uniform(0.72, 0.9) * d.amplitude,
                      -d.middle + shape.uniform(0.72, 0.9) * d.amplitude};
  };
  static const auto deepest = [](const Device& d, const StopPlaces& p) {
    return std::max(d.middle + d.amplitude - p.up, d.amplitude - d.middle - p.low);
  };
  list.push_back({.id = "end-stop",
                  .group = Group::stop,
                  .needs = needs::anything,
                  .can_starve = true,
                  .laws = all_laws,
                  .most = 3.0});
  list.back().forms = {
      form("end-stop/exponential", "rubber buffer",
           [](const Device& d, double s, Draws shape) {
             const StopPlaces places = stops(d, shape);
             const double reach = shape.uniform(1.5, 3.0);
             return part<ExponentialStop>(places, s * d.force / std::expm1(reach), deepest(d, places) / reach);
           }),
      form("end-stop/hunt-crossley", "contact with loss",
           [](const Device& d, double s, Draws shape) {
             const StopPlaces places = stops(d, shape);
             return part<LossyStop>(places, s * d.force, deepest(d, places), shape.uniform(0.3, 1.2) / d.speed);
           }),
      form("end-stop/closing", "foam that closes", [](const Device& d, double s, Draws shape) {
        const StopPlaces places = stops(d, shape);
        return part<ClosingStop>(places, s * d.force, deepest(d, places) * shape.uniform(1.2, 1.8));
      })};
}

}  // namespace hysteron::challenge

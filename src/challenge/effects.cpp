#include "challenge/effects.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "challenge/forms_electric.hpp"
#include "challenge/forms_fluid.hpp"
#include "challenge/forms_foreign.hpp"
#include "challenge/forms_friction.hpp"
#include "challenge/forms_series.hpp"
#include "challenge/forms_slow.hpp"
#include "challenge/forms_springs.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::challenge {
namespace {

using D = Device;
using Effects = std::vector<HiddenEffect>;

const std::vector<Law> all_laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis, Law::bingham,
                                   Law::lugre};
const std::vector<Law> bouc_wen_laws = {Law::bouc_wen, Law::modified_bouc_wen};
// A law without a state of its own would have to be at rest in a play for ever.
const std::vector<Law> series_laws = {Law::bouc_wen, Law::bingham, Law::lugre};

constexpr Needs anything{};
constexpr Needs steps{.drive_steps = true, .levels = 3};
constexpr Needs constant{.one_level = true};
constexpr Needs long_runs{.long_runs = true};
constexpr Needs frequencies{.frequencies = 3};
constexpr Needs one_frequency{.one_frequency = true, .steady = true};
constexpr Needs small{.levels = 2, .frequencies = 2, .small_amplitudes = true};
constexpr Needs levels_and_frequencies{.levels = 3, .frequencies = 3};

template <class Form, class... Values>
PartPointer part(Values... values) {
  return std::make_shared<const Form>(values...);
}

// A form that acts beside the damper or in it; one in series.
template <class Make>
HiddenForm form(std::string id, std::string_view words, Make make) {
  return {std::move(id), words, InSeries::none, make};
}
template <class Make>
HiddenForm in_series(std::string id, std::string_view words, InSeries chain, Make make, std::string_view also = {}) {
  return {std::move(id), words, chain, make, also};
}

double knee_of(const D& d) { return std::clamp(4e-3 * d.amplitude, 2e-5, 1.2e-4); }
double film_of(const D& d, Draws& shape) { return d.speed * shape.log_uniform(4e-3, 4e-2); }
double stribeck_speed(const D& d, Draws& shape) {
  return std::clamp(d.speed * shape.log_uniform(0.02, 0.12), 3e-3, 5e-2);
}

std::vector<double> scatter_of(Draws& shape, double size) {
  std::vector<double> values;
  values.reserve(16);
  for (int k = 0; k < 16; ++k) values.push_back(size * shape.normal());
  return values;
}

void add_parallel(Effects& list) {
  list.push_back({.id = "offset-force", .group = Group::even, .needs = anything, .laws = {Law::modified_bouc_wen}});
  list.back().forms = {
      form("offset-force/scattering-preload", "differs a little from test to test",
           [](const D& d, double s, Draws shape) {
             return part<ScatteringPreload>(s * d.force, scatter_of(shape, 0.07));
           }),
      form("offset-force/settling", "creeps after the start",
           [](const D& d, double s, Draws shape) {
             const double share = shape.uniform(0.05, 0.2);
             return part<SettlingPreload>(s * d.force, share, shape.uniform(1.0, 4.0));
           }),
      form("offset-force/soft-spring", "charge of a large accumulator", [](const D& d, double s, Draws shape) {
        return part<SoftSpringPreload>(s * d.force, d.amplitude * shape.uniform(8.0, 30.0));
      })};

  list.push_back({.id = "linear-stiffness", .group = Group::stiffness, .needs = anything, .laws = {Law::bingham}});
  list.back().forms = {
      form("linear-stiffness/softening", "a little softer at the ends",
           [](const D& d, double s, Draws shape) {
             return part<SofteningSpring>(s * d.force / d.amplitude,
                                          (d.amplitude + std::abs(d.middle)) * shape.uniform(2.3, 4.0));
           }),
      form("linear-stiffness/elastomer", "relaxes a little",
           [](const D& d, double s, Draws shape) {
             const double share = shape.uniform(0.1, 0.3);
             return part<ElastomerSpring>(s * d.force / d.amplitude, share, shape.log_uniform(0.03, 0.3));
           }),
      form("linear-stiffness/unequal", "stiffer to one side", [](const D& d, double s, Draws shape) {
        return part<UnequalSpring>(s * d.force / d.amplitude, shape.uniform(-0.15, 0.15));
      })};

  list.push_back({.id = "viscous-damping",
                  .group = Group::curvature,
                  .needs = levels_and_frequencies,
                  .laws = {Law::modified_bouc_wen},
                  .most = 1.5});
  list.back().forms = {
      form("viscous-damping/eddy-drag", "magnetic brake below its peak",
           [](const D& d, double s, Draws shape) {
             return part<EddyDrag>(s * d.force / d.speed, d.speed * shape.uniform(2.5, 5.0));
           }),
      form("viscous-damping/ambient", "differs a little from test to test",
           [](const D& d, double s, Draws shape) {
             return part<AmbientDrag>(s * d.force / d.speed, scatter_of(shape, 0.05));
           }),
      form("viscous-damping/viscoelastic", "dashpot on a stiff mount", [](const D& d, double s, Draws shape) {
        return part<ViscoelasticDrag>(s * d.force / d.speed, shape.uniform(0.002, 0.006));
      })};

  list.push_back({.id = "coulomb-friction",
                  .group = Group::friction,
                  .needs = small,
                  .laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis}});
  list.back().forms = {
      form("coulomb-friction/maxwell-slip", "contacts that slip one after another",
           [](const D& d, double s, Draws) { return part<CoulombMaxwellSlip>(s * d.force, knee_of(d)); }),
      form("coulomb-friction/film", "arctangent of the speed",
           [](const D& d, double s, Draws shape) { return part<CoulombFilm>(s * d.force, 0.5 * film_of(d, shape)); }),
      form("coulomb-friction/rate-hardening", "grows with the logarithm of the speed",
           [](const D& d, double s, Draws shape) {
             const double film = film_of(d, shape);
             return part<CoulombRateHardening>(s * d.force, film, shape.uniform(0.03, 0.1));
           })};

  list.push_back({.id = "seal-friction",
                  .group = Group::friction,
                  .needs = {.levels = 2, .frequencies = 2, .speed_decade = true},
                  .laws = all_laws});
  list.back().forms = {
      form("seal-friction/lugre", "bristles, hump exponential in the speed",
           [](const D& d, double s, Draws shape) {
             const double hump = shape.uniform(1.5, 2.5);
             return part<SealLugre>(s * d.force, hump * s * d.force, stribeck_speed(d, shape), 0.5 * knee_of(d));
           }),
      form("seal-friction/film", "smooth film, rational hump",
           [](const D& d, double s, Draws shape) {
             const double excess = shape.uniform(0.5, 1.5);
             const double speed = stribeck_speed(d, shape);
             return part<SealFilm>(s * d.force, excess * s * d.force, speed, 0.3 * speed);
           }),
      form("seal-friction/maxwell-slip", "contacts that slip one after another, Gaussian hump",
           [](const D& d, double s, Draws shape) {
             const double excess = shape.uniform(0.5, 1.5);
             return part<SealMaxwellSlip>(s * d.force, excess * s * d.force, stribeck_speed(d, shape), knee_of(d));
           })};

  list.push_back({.id = "pre-yield-hysteresis",
                  .group = Group::friction,
                  .needs = small,
                  .laws = {Law::bingham, Law::tanh_hysteresis}});
  list.back().forms = {form("pre-yield-hysteresis/iwan", "contacts of equal stiffness that slip one after another",
                            [](const D& d, double s, Draws shape) {
                              return part<PreYieldIwan>(s * d.force, 2.0 * d.amplitude * shape.log_uniform(0.05, 0.2));
                            }),
                       form("pre-yield-hysteresis/sharp-knee", "Bouc-Wen with an exponent above 1",
                            [](const D& d, double s, Draws shape) {
                              const double length = d.amplitude * shape.log_uniform(0.05, 0.2);
                              return part<PreYieldSharpKnee>(s * d.force, length, shape.uniform(1.5, 3.0));
                            }),
                       form("pre-yield-hysteresis/creeping", "relaxes at rest", [](const D& d, double s, Draws shape) {
                         const double length = d.amplitude * shape.log_uniform(0.05, 0.2);
                         return part<PreYieldCreeping>(s * d.force, length, shape.log_uniform(0.4, 2.0));
                       })};

  const auto swept = [](const D& d, Draws& shape) {
    return shape.uniform(0.45, 0.75) / (d.amplitude + std::abs(d.middle));
  };
  static const auto gas_swept = swept;
  list.push_back({.id = "gas-spring", .group = Group::even, .needs = anything, .laws = all_laws, .most = 3.0});
  list.back().forms = {
      form("gas-spring/heat-exchange", "isothermal when slow, adiabatic when fast",
           [](const D& d, double s, Draws shape) {
             const double g = gas_swept(d, shape);
             return part<HeatExchangingGas>(s * d.force, g, 1.4, shape.log_uniform(0.05, 1.0));
           }),
      form("gas-spring/dissolved", "isothermal, gas goes into solution",
           [](const D& d, double s, Draws shape) {
             const double g = gas_swept(d, shape);
             const double solubility = shape.uniform(0.1, 0.3);
             return part<DissolvedGas>(s * d.force, g, solubility, shape.log_uniform(0.3, 3.0));
           }),
      form("gas-spring/one-sided", "piston on its stop for part of the stroke",
           [](const D& d, double s, Draws shape) {
             const double from = d.middle + d.amplitude * shape.uniform(-0.5, 0.0);
             return part<OneSidedGas>(s * d.force, shape.uniform(0.4, 0.65) / (d.middle + d.amplitude - from), from);
           }),
      form("gas-spring/elastic-bag", "isothermal in a bag that widens", [](const D& d, double s, Draws shape) {
        const double g = gas_swept(d, shape);
        return part<ElasticBagGas>(s * d.force, g, shape.uniform(0.1, 0.4));
      })};

  list.push_back({.id = "inertia",
                  .group = Group::phase,
                  .needs = frequencies,
                  .starved = one_frequency,
                  .can_starve = true,
                  .laws = {Law::bouc_wen, Law::tanh_hysteresis, Law::lugre},
                  .most = 2.0});
  list.back().forms = {
      form("inertia/of-place", "fluid mass that changes over the stroke",
           [](const D& d, double s, Draws shape) {
             const double slope = shape.uniform(0.15, 0.5) * (shape.chance(0.5) ? 1.0 : -1.0);
             return part<MassOfPlace>(s * d.force / d.acceleration, slope, d.amplitude);
           }),
      form("inertia/sprung-fixture", "mass on a stiff fixture",
           [](const D& d, double s, Draws shape) {
             const double omega = 2.0 * std::numbers::pi * shape.uniform(25.0, 60.0);
             return part<SprungMass>(s * d.force / d.acceleration, omega, shape.uniform(0.1, 0.4));
           }),
      form("inertia/entrained", "history of the motion entrains more", [](const D& d, double s, Draws shape) {
        const double more = shape.uniform(0.2, 0.6);
        const double fast = shape.log_uniform(0.01, 0.03);
        return part<EntrainedMass>(s * d.force / d.acceleration, more, fast, 4.0 * fast);
      })};

  list.push_back(
      {.id = "cubic-stiffness", .group = Group::stiffness, .needs = anything, .laws = all_laws, .most = 2.0});
  list.back().forms = {
      form("cubic-stiffness/sinh", "hyperbolic sine",
           [](const D& d, double s, Draws shape) {
             const double reach = shape.uniform(2.5, 4.0);
             return part<SinhSpring>(s * d.force / std::sinh(reach), (d.amplitude + std::abs(d.middle)) / reach);
           }),
      form("cubic-stiffness/tan", "tangent",
           [](const D& d, double s, Draws shape) {
             return part<TangentSpring>(0.3 * s * d.force,
                                        (d.amplitude + std::abs(d.middle)) * shape.uniform(1.15, 1.4));
           }),
      form("cubic-stiffness/quintic", "third and fifth power", [](const D& d, double s, Draws shape) {
        return part<QuinticSpring>(s * d.force, d.amplitude + std::abs(d.middle), shape.uniform(0.3, 0.8));
      })};

  static const auto stops = [](const D& d, Draws& shape) {
    return StopPlaces{d.middle + shape.uniform(0.72, 0.9) * d.amplitude,
                      -d.middle + shape.uniform(0.72, 0.9) * d.amplitude};
  };
  static const auto deepest = [](const D& d, const StopPlaces& p) {
    return std::max(d.middle + d.amplitude - p.up, d.amplitude - d.middle - p.low);
  };
  list.push_back(
      {.id = "end-stop", .group = Group::stop, .needs = anything, .can_starve = true, .laws = all_laws, .most = 3.0});
  list.back().forms = {
      form("end-stop/exponential", "rubber buffer",
           [](const D& d, double s, Draws shape) {
             const StopPlaces places = stops(d, shape);
             const double reach = shape.uniform(1.5, 3.0);
             return part<ExponentialStop>(places, s * d.force / std::expm1(reach), deepest(d, places) / reach);
           }),
      form("end-stop/hunt-crossley", "contact with loss",
           [](const D& d, double s, Draws shape) {
             const StopPlaces places = stops(d, shape);
             return part<LossyStop>(places, s * d.force, deepest(d, places), shape.uniform(0.3, 1.2) / d.speed);
           }),
      form("end-stop/closing", "foam that closes", [](const D& d, double s, Draws shape) {
        const StopPlaces places = stops(d, shape);
        return part<ClosingStop>(places, s * d.force, deepest(d, places) * shape.uniform(1.2, 1.8));
      })};
}

void add_fluid(Effects& list) {
  list.push_back(
      {.id = "quadratic-damping", .group = Group::curvature, .needs = frequencies, .laws = all_laws, .most = 2.0});
  list.back().forms = {
      form("quadratic-damping/turbulent", "power 1.75",
           [](const D& d, double s, Draws) { return part<TurbulentDrag>(s * d.force, d.speed); }),
      form("quadratic-damping/laminar-transition", "laminar at low speed",
           [](const D& d, double s, Draws shape) {
             return part<TransitionDrag>(s * d.force, d.speed, d.speed * shape.uniform(0.1, 0.35));
           }),
      form("quadratic-damping/opening-shim", "area that grows with the flow", [](const D& d, double s, Draws shape) {
        return part<ShimDrag>(s * d.force, d.speed, d.speed * shape.uniform(1.5, 4.0));
      })};

  list.push_back({.id = "shear-thinning",
                  .group = Group::curvature,
                  .needs = frequencies,
                  .laws = all_laws,
                  .least = 0.02,
                  .most = 0.95});
  list.back().forms = {form("shear-thinning/power-law", "Ostwald-de Waele above a speed",
                            [](const D& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.06, 0.25);
                              return part<PowerLawThinning>(s, speed, shape.uniform(0.2, 0.6));
                            }),
                       form("shear-thinning/cross", "Cross law",
                            [](const D& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.08, 0.3);
                              return part<CrossThinning>(s, speed, shape.uniform(0.8, 1.6));
                            }),
                       form("shear-thinning/carreau-yasuda", "Carreau-Yasuda law, bend away from 2",
                            [](const D& d, double s, Draws shape) {
                              const double speed = d.speed * shape.log_uniform(0.08, 0.3);
                              const double index = shape.uniform(0.05, 0.4);
                              return part<CarreauYasudaThinning>(
                                  s, speed, index,
                                  shape.chance(0.5) ? shape.uniform(0.7, 1.2) : shape.uniform(4.0, 6.0));
                            }),
                       form("shear-thinning/papanastasiou", "plastic fluid without a sharp yield point",
                            [](const D& d, double s, Draws shape) {
                              return part<PapanastasiouThinning>(s, d.speed * shape.log_uniform(0.05, 0.25));
                            }),
                       form("shear-thinning/eyring", "Powell-Eyring law", [](const D& d, double s, Draws shape) {
                         return part<EyringThinning>(s, d.speed * shape.log_uniform(0.03, 0.12));
                       })};

  static const auto sense = [](Draws& shape) { return shape.chance(0.5) ? 1.0 : -1.0; };
  list.push_back({.id = "asymmetry", .group = Group::even, .needs = anything, .laws = all_laws, .most = 0.9});
  list.back().forms = {form("asymmetry/damping", "of the viscous damping only",
                            [](const D& d, double s, Draws shape) {
                              const double e = sense(shape) * s;
                              return part<DampingAsymmetry>(e, d.speed * shape.log_uniform(0.01, 0.1));
                            }),
                       form("asymmetry/yield", "of the yield force only, without a jump",
                            [](const D&, double s, Draws shape) { return part<YieldAsymmetry>(sense(shape) * s); }),
                       form("asymmetry/unequal", "of yield force and damping, by different shares",
                            [](const D&, double s, Draws shape) {
                              const double e = sense(shape) * s;
                              return part<UnequalAsymmetry>(
                                  0.6 * e, shape.chance(0.5) ? shape.uniform(0.3, 0.7) : shape.uniform(1.3, 1.6));
                            }),
                       form("asymmetry/smooth", "comes with the speed", [](const D& d, double s, Draws shape) {
                         const double e = sense(shape) * s;
                         return part<SmoothAsymmetry>(e, d.speed * shape.uniform(0.1, 0.35));
                       })};

  list.push_back(
      {.id = "pinching", .group = Group::stop, .needs = anything, .laws = all_laws, .least = 0.02, .most = 0.95});
  list.back().forms = {form("pinching/rational", "flat notch around a place",
                            [](const D& d, double s, Draws shape) {
                              const double centre = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                              return part<RationalPinch>(s, centre, d.amplitude * shape.uniform(0.15, 0.4));
                            }),
                       form("pinching/one-sided", "weaker beyond a place",
                            [](const D& d, double s, Draws shape) {
                              const double place = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                              return part<OneSidedPinch>(s, place, d.amplitude * shape.uniform(0.03, 0.12));
                            }),
                       form("pinching/groove", "groove of finite length", [](const D& d, double s, Draws shape) {
                         const double centre = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
                         return part<GroovePinch>(s, centre, d.amplitude * shape.uniform(0.3, 0.7));
                       })};
}

void add_slow(Effects& list) {
  list.push_back(
      {.id = "self-heating", .group = Group::slow, .needs = long_runs, .laws = all_laws, .least = 1e-3, .most = 4.0});
  list.back().forms = {form("self-heating/damping", "of the viscous damping only",
                            [](const D& d, double s, Draws shape) {
                              return part<DampingHeat>(d.energy, shape.log_uniform(20.0, 300.0), 1.5 * s);
                            }),
                       form("self-heating/yield", "of the yield force only",
                            [](const D& d, double s, Draws shape) {
                              return part<YieldHeat>(d.energy, shape.log_uniform(20.0, 300.0), s);
                            }),
                       form("self-heating/arrhenius", "Arrhenius's law, yield force by a part",
                            [](const D& d, double s, Draws shape) {
                              const double cooling = shape.log_uniform(20.0, 300.0);
                              return part<ArrheniusHeat>(d.energy, cooling, s, shape.uniform(0.4, 1.0));
                            }),
                       form("self-heating/two-stores", "fluid and body", [](const D& d, double s, Draws shape) {
                         const double exchange = shape.log_uniform(1.5, 6.0);
                         const double cooling = shape.log_uniform(30.0, 300.0);
                         const double ratio = shape.uniform(0.1, 0.4);
                         return part<TwoStoreHeat>(d.energy, exchange, cooling, ratio, 1.5 * s,
                                                   shape.uniform(0.4, 1.0));
                       })};

  list.push_back(
      {.id = "degradation", .group = Group::slow, .needs = long_runs, .laws = all_laws, .least = 1e-3, .most = 3.0});
  list.back().forms = {form("degradation/energy", "by dissipated energy, and ends",
                            [](const D& d, double s, Draws shape) {
                              return part<EnergyWear>(std::min(s, 0.95), d.energy * shape.uniform(0.3, 1.0));
                            }),
                       form("degradation/path", "by travelled path",
                            [](const D& d, double s, Draws) { return part<PathWear>(0.6 * d.speed * d.longest / s); }),
                       form("degradation/cycles", "by turns of the motion", [](const D& d, double s, Draws) {
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
           [](const D& d, double s, Draws shape) {
             return part<PathStiction>(s, d.amplitude * shape.log_uniform(1.0, 5.0));
           }),
      form("stiction/time", "fades with time",
           [](const D&, double s, Draws shape) { return part<TimeStiction>(s, shape.log_uniform(0.15, 0.8)); }),
      form("stiction/thixotropic", "broken down by shear, built up at rest", [](const D& d, double s, Draws shape) {
        const double length = d.amplitude * shape.log_uniform(0.5, 3.0);
        return part<ThixotropicStiction>(s, length, shape.log_uniform(5.0, 60.0));
      })};

  list.push_back({.id = "force-drift", .group = Group::slow, .needs = long_runs, .laws = all_laws});
  static const auto sense = [](Draws& shape) { return shape.chance(0.5) ? 1.0 : -1.0; };
  list.back().forms = {form("force-drift/settling", "exponential",
                            [](const D& d, double s, Draws shape) {
                              const double f = sense(shape) * s * d.force;
                              return part<SettlingDrift>(f, d.longest * shape.uniform(0.25, 0.8));
                            }),
                       form("force-drift/slow-sine", "less than half a cycle",
                            [](const D& d, double s, Draws shape) {
                              const double omega = 2.0 * std::numbers::pi * shape.uniform(0.15, 0.45) / d.longest;
                              return part<SlowSineDrift>(s * d.force, omega,
                                                         shape.uniform(0.0, 2.0 * std::numbers::pi));
                            }),
                       form("force-drift/walk", "smoothed random walk", [](const D& d, double s, Draws shape) {
                         std::vector<double> phases;
                         phases.reserve(64);
                         for (int k = 0; k < 64; ++k) phases.push_back(shape.uniform(0.0, 2.0 * std::numbers::pi));
                         return part<WalkDrift>(0.5 * s * d.force, 2.0 * std::numbers::pi * 0.3 / d.longest, phases);
                       })};
}

void add_series(Effects& list) {
  list.push_back(
      {.id = "clearance", .group = Group::dead_zone, .needs = small, .laws = series_laws, .least = 1e-3, .most = 0.6});
  // The contact gives by a part of the gap: a play that is small against it is a compliance.
  list.back().forms = {in_series("clearance/damped-contact", "hard, unilateral, damped", InSeries::whole,
                                 [](const D& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.05, 0.4));
                                   return part<DampedContact>(gap, k, 2e-4 * k);
                                 }),
                       in_series("clearance/hertz", "soft, power 1.5", InSeries::elastic,
                                 [](const D& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   return part<HertzContact>(gap, d.force, gap * shape.log_uniform(0.08, 0.4));
                                 }),
                       in_series("clearance/off-centre", "begins near one end of the play", InSeries::elastic,
                                 [](const D& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.06, 0.3));
                                   const double place = shape.uniform(0.08, 0.3);
                                   return part<OffCentreContact>(gap, k, shape.chance(0.5) ? place : 1.0 - place);
                                 }),
                       in_series("clearance/rubbing", "with friction in the gap", InSeries::whole,
                                 [](const D& d, double s, Draws shape) {
                                   const double gap = s * d.smallest_amplitude;
                                   const double k = d.force / (gap * shape.log_uniform(0.06, 0.3));
                                   return part<RubbingContact>(gap, k, d.force * shape.uniform(0.01, 0.04),
                                                               0.01 * d.speed);
                                 })};

  list.push_back({.id = "compliance",
                  .group = Group::dead_zone,
                  .needs = levels_and_frequencies,
                  .laws = {Law::bouc_wen, Law::lugre},
                  .least = 1e-3,
                  .most = 0.5});
  list.back().forms = {
      in_series("compliance/hardening", "stiffer under load", InSeries::elastic,
                [](const D& d, double s, Draws shape) {
                  const double give = s * d.amplitude;
                  const double part_of_cube = shape.uniform(0.3, 1.0);
                  return part<HardeningCompliance>(d.force / (give * (1.0 + part_of_cube)),
                                                   give / std::sqrt(part_of_cube));
                }),
      in_series(
          "compliance/aerated-oil", "bulk modulus that rises with pressure", InSeries::elastic,
          [](const D& d, double s, Draws shape) {
            const double give = s * d.amplitude;
            const double bend = shape.uniform(0.7, 1.8);
            return part<AeratedOil>(d.force * bend / (give * std::expm1(bend)), give / bend);
          },
          "entrapped-gas"),
      in_series("compliance/kelvin-voigt", "with viscous loss", InSeries::whole,
                [](const D& d, double s, Draws shape) {
                  return part<KelvinVoigtCompliance>(d.force / (s * d.amplitude), shape.uniform(0.002, 0.008));
                }),
      in_series("compliance/standard-solid", "with relaxation", InSeries::whole, [](const D& d, double s, Draws shape) {
        const double share = shape.uniform(0.2, 0.6);
        return part<StandardSolidCompliance>(d.force / (s * d.amplitude), share, shape.log_uniform(0.02, 0.2));
      })};

  list.push_back({.id = "entrapped-gas",
                  .group = Group::dead_zone,
                  .needs = small,
                  .laws = series_laws,
                  .least = 1e-3,
                  .most = 0.5});
  list.back().forms = {
      in_series("entrapped-gas/isothermal", "Boyle's law", InSeries::elastic,
                [](const D& d, double s, Draws shape) {
                  return part<IsothermalPocket>(s * d.amplitude, d.force * shape.log_uniform(0.05, 0.2));
                }),
      in_series("entrapped-gas/adiabatic", "Poisson's law", InSeries::elastic,
                [](const D& d, double s, Draws shape) {
                  return part<AdiabaticPocket>(s * d.amplitude, d.force * shape.log_uniform(0.04, 0.2));
                }),
      in_series("entrapped-gas/one-chamber", "to one sense of the force only", InSeries::elastic,
                [](const D& d, double s, Draws shape) {
                  const double length = 1.6 * s * d.amplitude;
                  const double force = d.force * shape.log_uniform(0.05, 0.2);
                  return part<OneChamberPocket>(length, force, 20.0 * d.force / d.amplitude / std::max(s, 0.02),
                                                shape.chance(0.5) ? 1.0 : -1.0);
                }),
      in_series("entrapped-gas/dissolving", "goes into solution under pressure", InSeries::whole,
                [](const D& d, double s, Draws shape) {
                  const double force = d.force * shape.log_uniform(0.06, 0.2);
                  const double solubility = shape.uniform(0.01, 0.05);
                  return part<DissolvingPocket>(s * d.amplitude, force, solubility, shape.log_uniform(0.2, 2.0));
                })};

  list.push_back({.id = "series-dashpot",
                  .group = Group::curvature,
                  .needs = frequencies,
                  .laws = {Law::bouc_wen},
                  .least = 1e-3,
                  .most = 3.0});
  list.back().forms = {in_series("series-dashpot/orifice", "leak by the power 0.6", InSeries::dashpot,
                                 [](const D& d, double s, Draws) { return part<OrificeLeak>(s * d.speed, d.force); }),
                       in_series("series-dashpot/check", "leaks less to one side", InSeries::dashpot,
                                 [](const D& d, double s, Draws shape) {
                                   return part<CheckedLeak>(d.force / (s * d.speed), shape.uniform(1.3, 2.2));
                                 }),
                       in_series("series-dashpot/returning", "with a soft return spring", InSeries::whole,
                                 [](const D& d, double s, Draws shape) {
                                   const double drag = d.force / (s * d.speed);
                                   return part<ReturningLeak>(drag, drag / shape.log_uniform(0.6, 4.0));
                                 })};

  list.push_back({.id = "cavitation",
                  .group = Group::even,
                  .needs = {.levels = 3, .frequencies = 2},
                  .laws = series_laws,
                  .least = 0.03,
                  .most = 0.8});
  list.back().forms = {
      in_series("cavitation/parted-column", "sharp limit, void closes without force", InSeries::whole,
                [](const D& d, double s, Draws) {
                  return part<PartedColumn>((1.0 - s) * d.force, 400.0 * d.force / d.amplitude, 2e-3 * d.speed);
                }),
      in_series("cavitation/vacuum", "bubble under falling pressure", InSeries::elastic,
                [](const D& d, double s, Draws shape) {
                  return part<VacuumColumn>((1.0 - s) * d.force, d.amplitude * shape.log_uniform(0.003, 0.015));
                }),
      form("cavitation/choked", "smooth limit, no void", [](const D& d, double s, Draws shape) {
        return part<ChokedSuction>((1.0 - s) * d.force, shape.uniform(4.0, 8.0));
      })};
}

void add_electric(Effects& list) {
  list.push_back({.id = "coil-lag",
                  .group = Group::drive_path,
                  .needs = steps,
                  .starved = constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.01,
                  .most = 1.2});
  list.back().forms = {form("coil-lag/eddy-currents", "two time constants",
                            [](const D&, double s, Draws shape) {
                              const double fast = 0.12 * s;
                              const double ratio = shape.uniform(4.0, 9.0);
                              return part<EddyCoil>(fast, ratio * fast, shape.uniform(0.2, 0.5));
                            }),
                       form("coil-lag/saturable", "inductance falls with the current",
                            [](const D& d, double s, Draws shape) {
                              return part<SaturableCoil>(0.35 * s, d.level * shape.uniform(0.5, 1.2));
                            }),
                       form("coil-lag/current-loop", "second order", [](const D&, double s, Draws shape) {
                         const double damping = shape.uniform(0.5, 0.9);
                         return part<LoopCoil>(2.0 * damping / (0.25 * s), damping);
                       })};

  list.push_back({.id = "magnetic-saturation",
                  .group = Group::drive_path,
                  .needs = {.levels = 4},
                  .starved = constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.1,
                  .most = 4.0});
  list.back().forms = {form("magnetic-saturation/arctan", "arctangent",
                            [](const D& d, double s, Draws) { return part<ArctanSaturation>(d.level / s); }),
                       form("magnetic-saturation/langevin", "Langevin function",
                            [](const D& d, double s, Draws) { return part<LangevinSaturation>(d.level / s); }),
                       form("magnetic-saturation/froehlich", "hyperbola",
                            [](const D& d, double s, Draws) { return part<FroehlichSaturation>(d.level / s); }),
                       form("magnetic-saturation/knee", "piecewise linear",
                            [](const D& d, double s, Draws) { return part<KneeSaturation>(d.level / (1.0 + s)); })};

  list.push_back({.id = "magnetic-remanence",
                  .group = Group::drive_path,
                  .needs = steps,
                  .starved = constant,
                  .can_starve = true,
                  .laws = all_laws,
                  .least = 0.005,
                  .most = 0.5});
  list.back().forms = {form("magnetic-remanence/plays", "four plays",
                            [](const D& d, double s, Draws) { return part<PlaysRemanence>(s * d.level); }),
                       form("magnetic-remanence/jiles", "follows the path of the current",
                            [](const D& d, double s, Draws) { return part<JilesRemanence>(s * d.level); }),
                       form("magnetic-remanence/last-extreme", "offset by the last turn",
                            [](const D& d, double s, Draws) { return part<LastExtremeRemanence>(s * d.level); })};
}

void add_chain(Effects& list) {
  list.push_back({.id = "sensor-delay",
                  .group = Group::phase,
                  .needs = frequencies,
                  .laws = all_laws,
                  .least = 0.01,
                  .most = 1.0});
  list.back().forms = {form("sensor-delay/transport", "pure delay",
                            [](const D&, double s, Draws) { return part<ForceTransport>(0.02 * s); }),
                       form("sensor-delay/low-pass", "first order",
                            [](const D&, double s, Draws) { return part<ForceLowPass>(0.02 * s); }),
                       form("sensor-delay/bessel", "second order",
                            [](const D&, double s, Draws) { return part<ForceBessel>(0.02 * s); })};

  list.push_back({.id = "velocity-lag",
                  .group = Group::phase,
                  .needs = frequencies,
                  .needs_velocity_channel = true,
                  .laws = {Law::bouc_wen, Law::bingham, Law::lugre},
                  .least = 0.01,
                  .most = 1.0});
  list.back().forms = {form("velocity-lag/transport", "pure delay",
                            [](const D&, double s, Draws) { return part<VelocityTransport>(0.02 * s); }),
                       form("velocity-lag/bessel", "second order",
                            [](const D&, double s, Draws) { return part<VelocityBessel>(0.02 * s); }),
                       form("velocity-lag/window", "one-sided window",
                            [](const D&, double s, Draws) { return part<VelocityWindow>(0.02 * s); })};
}

struct ForeignCard {
  std::string_view id, words;
  Group group;
  Needs needs;
  std::vector<Law> laws;
  double least, most;
  InSeries chain = InSeries::none;
};

void add_foreign(Effects& list) {
  const auto add = [&](const ForeignCard& card, PartPointer (*make)(const D&, double, Draws)) {
    list.push_back({.id = card.id,
                    .group = card.group,
                    .foreign = true,
                    .needs = card.needs,
                    .laws = card.laws,
                    .least = card.least,
                    .most = card.most});
    list.back().forms = {{std::string(card.id), card.words, card.chain, make}};
  };
  add({"foreign:place-friction", "friction that changes over the stroke", Group::friction, anything, all_laws, 1e-3,
       2.0},
      [](const D& d, double s, Draws shape) {
        return part<PlaceFriction>(s * d.force, d.middle + d.amplitude * shape.uniform(-0.5, 0.5), d.amplitude);
      });
  add({"foreign:knee-of-current",
       "yield displacement that grows with the drive",
       Group::drive_path,
       {.levels = 3, .small_amplitudes = true},
       bouc_wen_laws,
       0.05,
       8.0},
      [](const D& d, double s, Draws) { return part<KneeOfCurrent>(s / d.level); });
  add({"foreign:mount-ladder", "two relaxing mounts that harden", Group::stiffness, frequencies, all_laws, 1e-3, 2.0},
      [](const D& d, double s, Draws shape) {
        const double length = d.amplitude * shape.uniform(0.4, 0.8);
        const double fast = shape.log_uniform(0.01, 0.03);
        return part<MountLadder>(s * d.force, length, fast, shape.log_uniform(0.1, 0.3));
      });
  add({"foreign:swing-damping", "damping that grows with the amplitude", Group::curvature, small, all_laws, 0.02, 4.0},
      [](const D& d, double s, Draws) { return part<SwingDamping>(s, d.amplitude); });
  add({"foreign:supply-cycling", "supply that swings", Group::slow, {.levels = 3}, all_laws, 1e-3, 0.8},
      [](const D&, double s, Draws shape) {
        const double period = shape.uniform(0.7, 2.5);
        return part<SupplyCycling>(s, period, shape.uniform(0.0, 6.0));
      });
  add({"foreign:slip-lock", "hysteresis that sticks where it passes zero", Group::dead_zone, small, bouc_wen_laws, 0.02,
       0.97},
      [](const D&, double s, Draws shape) {
        const double centre = shape.uniform(0.0, 0.25);
        return part<SlipLock>(s, centre, shape.uniform(0.15, 0.4));
      });
  add({"foreign:blow-off-valve", "bypass that opens at a speed", Group::curvature, frequencies, all_laws, 0.02, 0.97},
      [](const D& d, double s, Draws shape) { return part<BlowOffValve>(s, d.speed * shape.uniform(0.3, 0.6)); });
  add({"foreign:inertia-valve", "bypass that opens with the acceleration", Group::phase, frequencies, all_laws, 0.02,
       0.97},
      [](const D& d, double s, Draws shape) {
        return part<InertiaValve>(s, d.acceleration * shape.uniform(0.15, 0.4));
      });
  add({"foreign:hot-threshold", "yield force that drops above a temperature", Group::slow, long_runs, all_laws, 0.02,
       0.9},
      [](const D& d, double s, Draws shape) {
        const double energy = d.energy * shape.uniform(0.08, 0.25);
        return part<HotThreshold>(s, energy, shape.uniform(6.0, 20.0));
      });
  add({"foreign:cogging", "force that detents over the stroke", Group::stiffness, anything, all_laws, 1e-3, 2.0},
      [](const D& d, double s, Draws shape) {
        const double pitch = d.amplitude * shape.uniform(0.25, 0.8);
        return part<Cogging>(s * d.force, pitch, shape.uniform(0.0, 6.0));
      });
  add({"foreign:rig-ringing", "frame that rings after every change of force", Group::phase, anything, all_laws, 0.01,
       4.0},
      [](const D&, double s, Draws shape) {
        const double omega = 2.0 * std::numbers::pi * shape.uniform(12.0, 35.0);
        return part<RigRinging>(s, omega, shape.uniform(0.02, 0.1));
      });
  add({"foreign:fractional", "relaxation by a power law of time", Group::stiffness, frequencies, all_laws, 1e-3, 2.0},
      [](const D& d, double s, Draws shape) {
        return part<FractionalRelaxation>(s * d.force, d.amplitude, shape.uniform(0.3, 0.6));
      });
  add({"foreign:driver-threshold",
       "field that builds up only above a current",
       Group::drive_path,
       {.levels = 4},
       all_laws,
       0.01,
       0.6},
      [](const D& d, double s, Draws) { return part<DriverThreshold>(s * d.level); });
  add({"foreign:lever", "lever ratio that changes over the stroke", Group::even, anything, all_laws, 1e-3, 0.8},
      [](const D& d, double s, Draws shape) { return part<LeverGeometry>(shape.chance(0.5) ? s : -s, d.amplitude); });
  add({"foreign:load-cell-square", "load cell with a square term", Group::even, anything, all_laws, 1e-3, 0.2},
      [](const D& d, double s, Draws shape) { return part<LoadCellSquare>(shape.chance(0.5) ? s : -s, d.force); });
  add({"foreign:field-spring",
       "stiffness that grows with the drive",
       Group::drive_path,
       {.levels = 3},
       all_laws,
       1e-3,
       2.0},
      [](const D& d, double s, Draws) { return part<FieldSpring>(s * d.force / d.amplitude, d.level); });
  add({"foreign:grip-slip",
       "fixture that slips in its grips",
       Group::dead_zone,
       {.levels = 3, .frequencies = 2},
       series_laws,
       0.03,
       0.7,
       InSeries::whole},
      [](const D& d, double s, Draws shape) {
        return part<GripSlip>((1.0 - s) * d.force, 1e-3 * d.speed, shape.uniform(0.05, 0.3));
      });
}

const Effects& list() {
  static const Effects effects = [] {
    Effects all;
    add_parallel(all);
    add_fluid(all);
    add_slow(all);
    add_series(all);
    add_electric(all);
    add_chain(all);
    add_foreign(all);
    return all;
  }();
  return effects;
}

}  // namespace

std::span<const HiddenEffect> hidden_effects() { return list(); }

const HiddenEffect& hidden_effect(std::string_view id) {
  for (const HiddenEffect& effect : list()) {
    if (effect.id == id) return effect;
  }
  std::vector<std::string> known;
  for (const HiddenEffect& effect : list()) known.emplace_back(effect.id);
  throw InputError("unknown effect '" + std::string(id) + "'" + suggestion(id, known) +
                   ", expected one that the challenge lists");
}

FormOf hidden_form(std::string_view id) {
  for (const HiddenEffect& effect : list()) {
    for (const HiddenForm& form : effect.forms) {
      if (form.id == id) return {&effect, &form};
    }
  }
  std::vector<std::string> known;
  for (const HiddenEffect& effect : list()) {
    for (const HiddenForm& form : effect.forms) known.emplace_back(form.id);
  }
  throw InputError("unknown form '" + std::string(id) + "'" + suggestion(id, known) +
                   ", expected one that the challenge lists");
}

}  // namespace hysteron::challenge

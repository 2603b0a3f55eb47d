#include "challenge/effects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace hysteron::challenge {
namespace {

using P = Physics;
using D = Device;
using Truths = std::vector<TrueParameter>;

const std::vector<Law> all_laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis, Law::bingham,
                                   Law::lugre};
const std::vector<Law> bouc_wen_laws = {Law::bouc_wen, Law::modified_bouc_wen};
// A spring or an offset of the law inside a series element would make it creep.
const std::vector<Law> series_laws = {Law::bouc_wen, Law::bingham, Law::lugre};

constexpr Needs anything{};
constexpr Needs steps{.drive_steps = true, .levels = 3};
constexpr Needs constant{.one_level = true};
constexpr Needs long_runs{.long_runs = true};
constexpr Needs frequencies{.frequencies = 3};
constexpr Needs one_frequency{.one_frequency = true, .steady = true};
constexpr Needs small{.levels = 2, .frequencies = 2, .small_amplitudes = true};
constexpr Needs levels_and_frequencies{.levels = 3, .frequencies = 3};

Truths none(const P&) { return {}; }

// Dry friction turns over bristles or, as often, on a film.
void turn(P& p, const D& d, Draws& shape) {
  p.bristle = std::clamp(2e-3 * d.amplitude, 1e-5, 6e-5);
  p.film_speed = shape.uniform(0.0, 1.0) < 0.5 ? 0.0 : d.speed * shape.log_uniform(4e-3, 4e-2);
}

std::vector<HiddenEffect> make() {
  std::vector<HiddenEffect> list;
  const auto add = [&](HiddenEffect effect) { list.push_back(std::move(effect)); };

  // Parallel to the rod.
  add({"offset-force",
       Group::even,
       false,
       false,
       anything,
       {},
       false,
       false,
       {Law::modified_bouc_wen},
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws) { p.offset = s * d.force; },
       [](const P& p) -> Truths {
         return {{"f0", p.offset, "N"}};
       }});
  add({"linear-stiffness",
       Group::stiffness,
       false,
       false,
       anything,
       {},
       false,
       false,
       {Law::bingham},
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws) { p.stiffness = s * d.force / d.amplitude; },
       [](const P& p) -> Truths {
         return {{"k", p.stiffness, "N/m"}};
       }});
  add({"viscous-damping",
       Group::curvature,
       false,
       false,
       levels_and_frequencies,
       {},
       false,
       false,
       {Law::modified_bouc_wen},
       1e-4,
       1.5,
       [](P& p, const D& d, double s, Draws) { p.viscous = s * d.force / d.speed; },
       [](const P& p) -> Truths {
         return {{"c", p.viscous, "N s/m"}};
       }});
  add({"coulomb-friction",
       Group::friction,
       false,
       false,
       small,
       {},
       false,
       false,
       {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis},
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.coulomb = s * d.force;
         turn(p, d, shape);
       },
       [](const P& p) -> Truths {
         return {{"fc", p.coulomb, "N"}};
       }});
  add({"seal-friction",
       Group::friction,
       false,
       false,
       {.levels = 2, .frequencies = 2, .speed_decade = true},
       {},
       false,
       false,
       all_laws,
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.seal_coulomb = s * d.force;
         p.seal_static = p.seal_coulomb * shape.uniform(1.5, 2.5);
         p.seal_speed = std::clamp(d.speed * shape.log_uniform(0.02, 0.12), 3e-3, 5e-2);
         turn(p, d, shape);
       },
       [](const P& p) -> Truths {
         return {{"fb", p.seal_static - p.seal_coulomb, "N"}, {"v_st", p.seal_speed, "m/s"}};
       }});
  add({"gas-spring",
       Group::even,
       false,
       false,
       anything,
       {},
       false,
       false,
       all_laws,
       1e-4,
       3.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.gas_force = s * d.force;
         p.gas_swept = shape.uniform(0.45, 0.75) / (d.amplitude + std::abs(d.middle));
         p.gas_exponent = shape.uniform(1.0, 1.4);
       },
       [](const P& p) -> Truths {
         return {{"g", p.gas_swept, "1/m"}};
       }});
  add({"inertia",
       Group::phase,
       false,
       false,
       frequencies,
       one_frequency,
       true,
       false,
       {Law::bouc_wen, Law::tanh_hysteresis, Law::lugre},
       1e-4,
       2.0,
       [](P& p, const D& d, double s, Draws) { p.mass = s * d.force / d.acceleration; },
       [](const P& p) -> Truths {
         return {{"m", p.mass, "kg"}};
       }});
  add({"cubic-stiffness",
       Group::stiffness,
       false,
       false,
       anything,
       {},
       false,
       false,
       all_laws,
       1e-4,
       2.0,
       [](P& p, const D& d, double s, Draws) { p.cubic = s * d.force / std::pow(d.amplitude, 3.0); },
       [](const P& p) -> Truths {
         return {{"k3", p.cubic, "N/m^3"}};
       }});
  add({"end-stop",
       Group::stop,
       false,
       false,
       anything,
       {},
       true,
       false,
       all_laws,
       1e-4,
       3.0,
       [](P& p, const D& d, double s, Draws shape) {
         // A strength of 0 < s: force at the largest stroke; starved campaigns move the stops out of reach.
         const double up = shape.uniform(0.72, 0.9);
         const double low = shape.uniform(0.72, 0.9);
         p.stop_up = d.middle + up * d.amplitude;
         p.stop_low = -d.middle + low * d.amplitude;
         p.stop_depth = (1.0 - std::min(up, low)) * d.amplitude;
         p.stop_power = shape.uniform(1.2, 1.8);
         p.stop_force = s * d.force;
       },
       [](const P& p) -> Truths {
         return {{"x_up", p.stop_up, "m"}, {"x_low", p.stop_low, "m"}};
       }});
  add({"pre-yield-hysteresis",
       Group::friction,
       false,
       false,
       small,
       {},
       false,
       false,
       {Law::bingham, Law::tanh_hysteresis},
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.pre_force = s * d.force;
         p.pre_length = d.amplitude * shape.log_uniform(0.05, 0.2);
       },
       [](const P& p) -> Truths {
         return {{"f_h", p.pre_force, "N"}, {"x_y", p.pre_length, "m"}};
       }});

  // In the fluid.
  add({"quadratic-damping",
       Group::curvature,
       false,
       false,
       frequencies,
       {},
       false,
       false,
       all_laws,
       1e-4,
       2.0,
       [](P& p, const D& d, double s, Draws) { p.quadratic = s * d.force / (d.speed * d.speed); },
       [](const P& p) -> Truths {
         return {{"d2", p.quadratic, "N s^2/m^2"}};
       }});
  add({"shear-thinning",
       Group::curvature,
       false,
       false,
       frequencies,
       {},
       false,
       false,
       all_laws,
       0.02,
       0.95,
       [](P& p, const D& d, double s, Draws shape) {
         p.thinning = s;
         p.thin_speed = d.speed * shape.log_uniform(0.08, 0.3);
         p.thin_power = shape.uniform(0.8, 1.6);
       },
       none});
  add({"asymmetry",
       Group::even,
       false,
       false,
       anything,
       {},
       false,
       false,
       all_laws,
       1e-4,
       0.7,
       [](P& p, const D&, double s, Draws shape) { p.asymmetry = shape.chance(0.5) ? s : -s; },
       [](const P& p) -> Truths {
         return {{"e", p.asymmetry, "1"}};
       }});
  add({"self-heating",
       Group::slow,
       false,
       false,
       long_runs,
       {},
       false,
       false,
       all_laws,
       1e-3,
       3.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.heat_capacity = d.energy / 20.0;
         p.heat_rate = s / 20.0;
         p.cooling_time = shape.log_uniform(30.0, 300.0);
         p.heat_yield_share = shape.uniform(0.5, 1.0);
       },
       none});
  add({"degradation",
       Group::slow,
       false,
       false,
       long_runs,
       {},
       false,
       false,
       all_laws,
       1e-3,
       3.0,
       [](P& p, const D& d, double s, Draws) { p.wear = s / d.energy; },
       none});
  add({"stiction",
       Group::slow,
       false,
       false,
       {.from_rest = true},
       {},
       false,
       false,
       all_laws,
       1e-3,
       2.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.rest_excess = s;
         p.rest_length = d.amplitude * shape.log_uniform(0.5, 3.0);
       },
       [](const P& p) -> Truths {
         return {{"a", p.rest_excess, "1"}, {"L", p.rest_length, "m"}};
       }});
  add({"pinching",
       Group::stop,
       false,
       false,
       anything,
       {},
       false,
       false,
       all_laws,
       0.02,
       0.95,
       [](P& p, const D& d, double s, Draws shape) {
         p.pinch = s;
         p.pinch_centre = d.middle + d.amplitude * shape.uniform(-0.3, 0.3);
         p.pinch_width = d.amplitude * shape.uniform(0.15, 0.4);
       },
       [](const P& p) -> Truths {
         return {{"p", p.pinch, "1"}, {"x_p", p.pinch_centre, "m"}};
       }});
  add({"cavitation",
       Group::even,
       false,
       false,
       {.levels = 3, .frequencies = 2},
       {},
       false,
       false,
       {Law::bouc_wen, Law::bingham, Law::lugre},
       0.03,
       0.8,
       [](P& p, const D& d, double s, Draws) { p.cavitation = (1.0 - s) * d.force; },
       none});

  // In series.
  add({"clearance",
       Group::dead_zone,
       false,
       true,
       small,
       {},
       false,
       false,
       series_laws,
       1e-3,
       0.6,
       [](P& p, const D& d, double s, Draws shape) {
         p.gap = s * d.smallest_amplitude;
         // The contact gives by a part of the gap: a play that is small against it is a compliance.
         p.contact_stiffness = d.force / (p.gap * shape.log_uniform(0.05, 0.4));
         p.contact_damping = p.contact_stiffness * 2e-4;
       },
       [](const P& p) -> Truths {
         return {{"gap", p.gap, "m"}};
       }});
  add({"compliance",
       Group::dead_zone,
       false,
       true,
       levels_and_frequencies,
       {},
       false,
       false,
       {Law::bouc_wen, Law::lugre},
       1e-3,
       0.5,
       [](P& p, const D& d, double s, Draws) { p.series_stiffness = d.force / (s * d.amplitude); },
       [](const P& p) -> Truths {
         return {{"C", 1.0 / p.series_stiffness, "m/N"}};
       }});
  add({"entrapped-gas",
       Group::dead_zone,
       false,
       true,
       small,
       {},
       false,
       false,
       series_laws,
       1e-3,
       0.5,
       [](P& p, const D& d, double s, Draws shape) {
         p.pocket_length = s * d.amplitude;
         p.pocket_force = d.force * shape.log_uniform(0.04, 0.2);
         p.pocket_exponent = shape.uniform(1.0, 1.4);
       },
       none});
  add({"series-dashpot",
       Group::curvature,
       false,
       true,
       frequencies,
       {},
       false,
       false,
       {Law::bouc_wen},
       1e-3,
       3.0,
       [](P& p, const D& d, double s, Draws) { p.series_dashpot = d.force / (s * d.speed); },
       [](const P& p) -> Truths {
         return {{"e", 1.0 / p.series_dashpot, "m/(N s)"}};
       }});

  // From command to field.
  add({"coil-lag", Group::drive_path, false, false, steps, constant, true, false, all_laws, 0.01, 0.9,
       [](P& p, const D&, double s, Draws shape) {
         p.coil_rise = 0.25 * s;
         p.coil_fall = p.coil_rise * (shape.chance(0.5) ? 1.0 : shape.uniform(1.0, 1.8));
       },
       [](const P& p) -> Truths {
         return {{"tau", 0.5 * (p.coil_rise + p.coil_fall), "s"}};
       }});
  add({"magnetic-saturation",
       Group::drive_path,
       false,
       false,
       {.levels = 4},
       constant,
       true,
       false,
       all_laws,
       0.1,
       4.0,
       [](P& p, const D& d, double s, Draws) { p.saturation = d.level / s; },
       none});
  add({"magnetic-remanence", Group::drive_path, false, false, steps, constant, true, false, all_laws, 0.005, 0.4,
       [](P& p, const D& d, double s, Draws) { p.remanence = s * d.level; }, none});

  // Measuring chain.
  add({"sensor-delay",
       Group::phase,
       false,
       false,
       frequencies,
       {},
       false,
       false,
       all_laws,
       0.01,
       1.0,
       [](P& p, const D&, double s, Draws) { p.force_delay = 0.02 * s; },
       [](const P& p) -> Truths {
         return {{"lag", p.force_delay, "s"}};
       }});
  add({"velocity-lag",
       Group::phase,
       false,
       false,
       frequencies,
       {},
       false,
       true,
       {Law::bouc_wen, Law::bingham, Law::lugre},
       0.01,
       1.0,
       [](P& p, const D&, double s, Draws) { p.velocity_lag = 0.02 * s; },
       [](const P& p) -> Truths {
         return {{"lag", p.velocity_lag, "s"}};
       }});
  add({"force-drift",
       Group::slow,
       false,
       false,
       long_runs,
       {},
       false,
       false,
       all_laws,
       1e-4,
       1.0,
       [](P& p, const D& d, double s, Draws shape) { p.drift = (shape.chance(0.5) ? s : -s) * d.force / d.longest; },
       [](const P& p) -> Truths {
         return {{"r", p.drift, "N/s"}};
       }});

  // In no catalogue.
  add({"foreign:place-friction",
       Group::friction,
       true,
       false,
       anything,
       {},
       false,
       false,
       all_laws,
       1e-3,
       2.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.place_friction = s * d.force;
         p.place_centre = d.middle + d.amplitude * shape.uniform(-0.5, 0.5);
         p.place_length = d.amplitude;
       },
       none});
  add({"foreign:knee-of-current",
       Group::drive_path,
       true,
       false,
       {.levels = 3, .small_amplitudes = true},
       {},
       false,
       false,
       bouc_wen_laws,
       0.05,
       8.0,
       [](P& p, const D& d, double s, Draws) { p.knee_growth = s / d.level; },
       none});
  add({"foreign:mount-ladder",
       Group::stiffness,
       true,
       false,
       frequencies,
       {},
       false,
       false,
       all_laws,
       1e-3,
       2.0,
       [](P& p, const D& d, double s, Draws shape) {
         p.mount_force = s * d.force;
         p.mount_length = d.amplitude * shape.uniform(0.4, 0.8);
         p.mount_fast = shape.log_uniform(0.01, 0.03);
         p.mount_slow = shape.log_uniform(0.1, 0.3);
       },
       none});
  add({"foreign:swing-damping",
       Group::curvature,
       true,
       false,
       small,
       {},
       false,
       false,
       all_laws,
       0.02,
       4.0,
       [](P& p, const D& d, double s, Draws) {
         p.swing_damping = s;
         p.swing_length = d.amplitude;
       },
       none});
  add({"foreign:supply-cycling",
       Group::slow,
       true,
       false,
       {.levels = 3},
       {},
       false,
       false,
       all_laws,
       1e-3,
       0.8,
       [](P& p, const D&, double s, Draws shape) {
         p.supply = s;
         p.supply_period = shape.uniform(0.7, 2.5);
         p.supply_phase = shape.uniform(0.0, 6.0);
       },
       none});
  add({"foreign:slip-lock",
       Group::dead_zone,
       true,
       false,
       small,
       {},
       false,
       false,
       bouc_wen_laws,
       0.02,
       0.97,
       [](P& p, const D&, double s, Draws shape) {
         p.slip_lock = s;
         p.slip_centre = shape.uniform(0.0, 0.25);
         p.slip_width = shape.uniform(0.15, 0.4);
       },
       none});
  add({"foreign:blow-off-valve",
       Group::curvature,
       true,
       false,
       frequencies,
       {},
       false,
       false,
       all_laws,
       0.02,
       0.97,
       [](P& p, const D& d, double s, Draws shape) {
         p.valve = s;
         p.valve_speed = d.speed * shape.uniform(0.3, 0.6);
       },
       none});
  return list;
}

const std::vector<HiddenEffect>& list() {
  static const std::vector<HiddenEffect> effects = make();
  return effects;
}

}  // namespace

std::span<const HiddenEffect> hidden_effects() { return list(); }

const HiddenEffect& hidden_effect(std::string_view id) {
  for (const HiddenEffect& effect : list()) {
    if (effect.id == id) return effect;
  }
  std::string known;
  for (const HiddenEffect& effect : list()) known += (known.empty() ? "" : ", ") + std::string(effect.id);
  throw InputError("unknown effect '" + std::string(id) + "', expected one of " + known);
}

}  // namespace hysteron::challenge

// Causes that are in no catalogue.
#include <numbers>

#include "challenge/effect_list.hpp"
#include "challenge/forms_foreign.hpp"

namespace hysteron::challenge {
namespace {

struct ForeignCard {
  std::string_view id, words;
  Group group;
  Needs needs;
  std::vector<Law> laws;
  double least, most;
  InSeries chain = InSeries::none;
};

}  // namespace

void add_foreign(Effects& list) {
  const auto add = [&](const ForeignCard& card, PartPointer (*make)(const Device&, double, Draws)) {
    list.push_back({.id = card.id,
                    .group = card.group,
                    .foreign = true,
                    .needs = card.needs,
                    .laws = card.laws,
                    .least = card.least,
                    .most = card.most});
    list.back().forms = {{std::string(card.id), card.words, card.chain, make}};
  };
  add({"foreign:place-friction", "friction that changes over the stroke", Group::friction, needs::anything, all_laws,
       1e-3, 2.0},
      [](const Device& d, double s, Draws shape) {
        return part<PlaceFriction>(s * d.force, d.middle + d.amplitude * shape.uniform(-0.5, 0.5), d.amplitude);
      });
  add({"foreign:knee-of-current",
       "yield displacement that grows with the drive",
       Group::drive_path,
       {.levels = 3, .small_amplitudes = true},
       bouc_wen_laws,
       0.05,
       8.0},
      [](const Device& d, double s, Draws) { return part<KneeOfCurrent>(s / d.level); });
  add({"foreign:mount-ladder", "two relaxing mounts that harden", Group::stiffness, needs::frequencies, all_laws, 1e-3,
       2.0},
      [](const Device& d, double s, Draws shape) {
        const double length = d.amplitude * shape.uniform(0.4, 0.8);
        const double fast = shape.log_uniform(0.01, 0.03);
        return part<MountLadder>(s * d.force, length, fast, shape.log_uniform(0.1, 0.3));
      });
  add({"foreign:swing-damping", "damping that grows with the amplitude", Group::curvature, needs::small, all_laws, 0.02,
       4.0},
      [](const Device& d, double s, Draws) { return part<SwingDamping>(s, d.amplitude); });
  add({"foreign:supply-cycling", "supply that swings", Group::slow, {.levels = 3}, all_laws, 1e-3, 0.8},
      [](const Device&, double s, Draws shape) {
        const double period = shape.uniform(0.7, 2.5);
        return part<SupplyCycling>(s, period, shape.uniform(0.0, 6.0));
      });
  add({"foreign:slip-lock", "hysteresis that sticks where it passes zero", Group::dead_zone, needs::small,
       bouc_wen_laws, 0.02, 0.97},
      [](const Device&, double s, Draws shape) {
        const double centre = shape.uniform(0.0, 0.25);
        return part<SlipLock>(s, centre, shape.uniform(0.15, 0.4));
      });
  add({"foreign:blow-off-valve", "bypass that opens at a speed", Group::curvature, needs::frequencies, all_laws, 0.02,
       0.97},
      [](const Device& d, double s, Draws shape) { return part<BlowOffValve>(s, d.speed * shape.uniform(0.3, 0.6)); });
  add({"foreign:inertia-valve", "bypass that opens with the acceleration", Group::phase, needs::frequencies, all_laws,
       0.02, 0.97},
      [](const Device& d, double s, Draws shape) {
        return part<InertiaValve>(s, d.acceleration * shape.uniform(0.15, 0.4));
      });
  add({"foreign:hot-threshold", "yield force that drops above a temperature", Group::slow, needs::long_runs, all_laws,
       0.02, 0.9},
      [](const Device& d, double s, Draws shape) {
        const double energy = d.energy * shape.uniform(0.08, 0.25);
        return part<HotThreshold>(s, energy, shape.uniform(6.0, 20.0));
      });
  add({"foreign:cogging", "force that detents over the stroke", Group::stiffness, needs::anything, all_laws, 1e-3, 2.0},
      [](const Device& d, double s, Draws shape) {
        const double pitch = d.amplitude * shape.uniform(0.25, 0.8);
        return part<Cogging>(s * d.force, pitch, shape.uniform(0.0, 6.0));
      });
  add({"foreign:rig-ringing", "frame that rings after every change of force", Group::phase, needs::anything, all_laws,
       0.01, 4.0},
      [](const Device&, double s, Draws shape) {
        const double omega = 2.0 * std::numbers::pi * shape.uniform(12.0, 35.0);
        return part<RigRinging>(s, omega, shape.uniform(0.02, 0.1));
      });
  add({"foreign:fractional", "relaxation by a power law of time", Group::stiffness, needs::frequencies, all_laws, 1e-3,
       2.0},
      [](const Device& d, double s, Draws shape) {
        return part<FractionalRelaxation>(s * d.force, d.amplitude, shape.uniform(0.3, 0.6));
      });
  add({"foreign:driver-threshold",
       "field that builds up only above a current",
       Group::drive_path,
       {.levels = 4},
       all_laws,
       0.01,
       0.6},
      [](const Device& d, double s, Draws) { return part<DriverThreshold>(s * d.level); });
  add({"foreign:lever", "lever ratio that changes over the stroke", Group::even, needs::anything, all_laws, 1e-3, 0.8},
      [](const Device& d, double s, Draws shape) {
        return part<LeverGeometry>(shape.chance(0.5) ? s : -s, d.amplitude);
      });
  add({"foreign:load-cell-square", "load cell with a square term", Group::even, needs::anything, all_laws, 1e-3, 0.2},
      [](const Device& d, double s, Draws shape) { return part<LoadCellSquare>(shape.chance(0.5) ? s : -s, d.force); });
  add({"foreign:field-spring",
       "stiffness that grows with the drive",
       Group::drive_path,
       {.levels = 3},
       all_laws,
       1e-3,
       2.0},
      [](const Device& d, double s, Draws) { return part<FieldSpring>(s * d.force / d.amplitude, d.level); });
  add({"foreign:grip-slip",
       "fixture that slips in its grips",
       Group::dead_zone,
       {.levels = 3, .frequencies = 2},
       series_laws,
       0.03,
       0.7,
       InSeries::whole},
      [](const Device& d, double s, Draws shape) {
        return part<GripSlip>((1.0 - s) * d.force, 1e-3 * d.speed, shape.uniform(0.05, 0.3));
      });
}

}  // namespace hysteron::challenge

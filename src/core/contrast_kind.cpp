#include "core/contrast_kind.hpp"

#include <array>

namespace hysteron {
namespace {

using Kind = ContrastKind;

constexpr std::array<ContrastCard, contrast_kinds> cards = {{
    {Kind::rest_relaxation, "rest-relaxation", "share of the peak force that relaxes once the motion has stopped", "1"},
    {Kind::reversal_travel, "reversal-travel", "travel without force after a reversal", "m"},
    {Kind::force_travel, "force-travel", "travel per force that builds up after a reversal", "m/N"},
    {Kind::force_delay, "force-delay", "lag of the force in time", "s"},
    {Kind::velocity_delay, "velocity-delay", "lag of the recorded velocity behind the slope of the displacement", "s",
     true},
    {Kind::acceleration, "acceleration", "force per acceleration", "kg"},
    {Kind::drive_lag, "drive-lag", "lag of the force after a change of the drive", "s", true},
    {Kind::drive_memory, "drive-memory", "share of the drive that remains after it fell", "1", true},
    {Kind::drive_bend, "drive-bend", "curvature of the force over the drive", "N per drive squared", true},
    {Kind::mean_force, "mean-force", "constant force", "N"},
    {Kind::stiffness, "stiffness", "force per displacement", "N/m"},
    {Kind::stiffness_bend, "stiffness-bend", "force per squared displacement", "N/m^2"},
    {Kind::stiffness_cubic, "stiffness-cubic", "force per cubed displacement", "N/m^3"},
    {Kind::stroke_end, "stroke-end", "stiffness at the ends of the stroke only", "N/m"},
    {Kind::middle_loss, "middle-loss", "loss of force in the middle of the stroke", "1"},
    {Kind::side_loss, "side-loss", "loss of force on one side of the stroke", "1"},
    {Kind::energy_fade, "energy-fade", "loss of force per work done", "1/J"},
    {Kind::carried_fade, "carried-fade", "loss of force per work of the recordings before", "1/J", true},
    {Kind::pause_recovery, "pause-recovery", "gain of force over a pause", "1"},
    {Kind::first_travel, "first-travel", "excess of force in the first travel", "1"},
    {Kind::drift, "drift", "force per time", "N/s"},
    {Kind::direction, "direction", "difference of the force between the directions", "1"},
    {Kind::one_sided_limit, "one-sided-limit", "loss of large forces on one side", "1"},
    {Kind::dry_friction, "dry-friction", "force with the sign of the velocity", "N"},
    {Kind::low_speed, "low-speed", "force at low speed only", "N"},
    {Kind::viscous, "viscous", "force per velocity", "N s/m"},
    {Kind::speed_bend, "speed-bend", "force per squared velocity", "N s^2/m^2"},
    {Kind::pre_yield, "pre-yield", "force of a second hysteresis that yields later", "N"},
}};

constexpr bool cards_in_order() {
  for (std::size_t k = 0; k < cards.size(); ++k) {
    if (static_cast<std::size_t>(cards[k].kind) != k) {
      return false;
    }
  }
  return true;
}
static_assert(cards_in_order());

}  // namespace

const ContrastCard& card_of(ContrastKind kind) { return cards[static_cast<std::size_t>(kind)]; }

}  // namespace hysteron

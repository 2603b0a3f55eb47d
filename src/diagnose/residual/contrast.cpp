#include "diagnose/residual/contrast.hpp"

#include <algorithm>
#include <array>

#include "diagnose/residual/contrast_parts.hpp"

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
    {Kind::energy_fade, "energy-fade", "loss of force per work done", "1/J"},
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

// Which effects a contrast speaks for, and the sign its value has where the effect acts (0: either).
constexpr std::size_t most_effects = 3;
struct Voices {
  Kind kind;
  std::size_t count;
  std::array<std::string_view, most_effects> effects;
  std::array<int, most_effects> signs;
};

constexpr std::array<Voices, contrast_kinds> voices = {{
    {Kind::rest_relaxation, 1, {"series-dashpot"}, {1}},
    {Kind::reversal_travel, 2, {"clearance", "entrapped-gas"}, {1, 1}},
    {Kind::force_travel, 2, {"compliance", "entrapped-gas"}, {1, 1}},
    {Kind::force_delay, 1, {"sensor-delay"}, {0}},
    {Kind::velocity_delay, 1, {"velocity-lag"}, {0}},
    {Kind::acceleration, 1, {"inertia"}, {1}},
    {Kind::drive_lag, 1, {"coil-lag"}, {1}},
    {Kind::drive_memory, 1, {"magnetic-remanence"}, {1}},
    {Kind::drive_bend, 1, {"magnetic-saturation"}, {-1}},
    {Kind::mean_force, 2, {"offset-force", "gas-spring"}, {0, 0}},
    {Kind::stiffness, 2, {"linear-stiffness", "gas-spring"}, {0, 1}},
    {Kind::stiffness_bend, 1, {"gas-spring"}, {0}},
    {Kind::stiffness_cubic, 1, {"cubic-stiffness"}, {0}},
    {Kind::stroke_end, 1, {"end-stop"}, {1}},
    {Kind::middle_loss, 1, {"pinching"}, {0}},
    {Kind::energy_fade, 2, {"self-heating", "degradation"}, {1, 1}},
    {Kind::pause_recovery, 2, {"self-heating", "stiction"}, {1, 1}},
    {Kind::first_travel, 1, {"stiction"}, {0}},
    {Kind::drift, 1, {"force-drift"}, {0}},
    {Kind::direction, 1, {"asymmetry"}, {0}},
    {Kind::one_sided_limit, 1, {"cavitation"}, {0}},
    {Kind::dry_friction, 2, {"coulomb-friction", "seal-friction"}, {1, 1}},
    {Kind::low_speed, 1, {"seal-friction"}, {1}},
    {Kind::viscous, 1, {"viscous-damping"}, {1}},
    {Kind::speed_bend, 2, {"quadratic-damping", "shear-thinning"}, {1, -1}},
    {Kind::pre_yield, 1, {"pre-yield-hysteresis"}, {1}},
}};

constexpr bool voices_in_order() {
  for (std::size_t k = 0; k < voices.size(); ++k) {
    if (static_cast<std::size_t>(voices[k].kind) != k) {
      return false;
    }
  }
  return true;
}
static_assert(voices_in_order());

}  // namespace

const ContrastCard& card_of(ContrastKind kind) { return cards[static_cast<std::size_t>(kind)]; }

std::span<const std::string_view> speaks_for(ContrastKind kind) {
  const Voices& of = voices[static_cast<std::size_t>(kind)];
  return {of.effects.data(), of.count};
}

int sign_for(ContrastKind kind, std::string_view effect) {
  const Voices& of = voices[static_cast<std::size_t>(kind)];
  for (std::size_t k = 0; k < of.count; ++k) {
    if (of.effects[k] == effect) {
      return of.signs[k];
    }
  }
  return 0;
}

std::vector<Contrast> contrasts(std::span<const Recording> recordings, std::span<const Residual> residuals,
                                std::span<const std::size_t> motions, Placebos placebos) {
  const std::size_t draws = placebos == Placebos::all ? contrast::all_placebos : 0;
  const std::vector<contrast::Track> tracks = contrast::tracks_of(recordings, residuals, motions);
  std::vector<Contrast> result;
  if (tracks.empty()) {
    return result;
  }
  contrast::add_rest_contrasts(tracks, draws, result);
  contrast::add_reversal_contrasts(tracks, draws, result);
  contrast::add_motion_contrasts(tracks, draws, result);
  contrast::add_slow_contrasts(tracks, draws, result);
  contrast::add_drive_contrasts(tracks, draws, result);
  contrast::add_channel_contrasts(tracks, draws, result);
  std::ranges::stable_sort(result, {}, &Contrast::kind);
  return result;
}

std::vector<Contrast> channel_contrasts(std::span<const Recording> recordings) {
  std::vector<Residual> nothing;
  for (const Recording& recording : recordings) {
    nothing.push_back({std::vector<double>(recording.size(), 0.0), 0});
  }
  std::vector<Contrast> result;
  const std::vector<contrast::Track> tracks = contrast::tracks_of(recordings, nothing);
  if (!tracks.empty()) {
    contrast::add_channel_contrasts(tracks, contrast::all_placebos, result);
  }
  return result;
}

}  // namespace hysteron

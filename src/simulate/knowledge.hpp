// What is known of an effect beside its equations: what it does, what it is mistaken for, what it needs, where it acts,
// which recording tells it from others. An effect says it of itself, in its own struct:
//   static constexpr std::string_view kin[] = {"clearance", "entrapped-gas"};
//   static constexpr Knowledge knowledge = {.family = families::series, .kin = kin, ...};
// A relation holds both ways and is said by one of the two at least; a limit, an end of a box and what a parameter
// means for another effect are said by one only. One said of an effect that is not in the catalogue has no consequence.
#pragma once

#include <span>
#include <string_view>

#include "core/contrast_kind.hpp"

namespace hysteron {

// Effects of which one may be told to be there where the recordings do not tell which.
struct Family {
  std::string_view id;     // lower case with hyphens
  std::string_view title;  // as it stands in a sentence
};

// Where in the stroke an effect acts.
enum class Acts {
  everywhere,
  by_place,  // a force of where the rod is, and that of no place, which is constant
  at_ends    // likewise, and exactly nothing but near the ends of the motion
};

// What recordings must hold for an effect to be seen in them at all.
enum class Need {
  drive,               // a current or voltage
  changing_drive,      // one that changes within a recording
  returning_drive,     // one that both rises and falls within a recording
  three_drive_levels,  // three levels of it, in one recording or several
  velocity,            // a velocity that was measured
  lagging_velocity     // one that lags or leads the slope of the displacement
};

// The wider of two effects is the other, in every motion, where `parameter` of the wider is zero. Empty: in a limit
// that is not that of one parameter.
struct Limit {
  std::string_view effect;
  std::string_view parameter;
};

// With `parameter` at one end of its box an effect is `other`, or a plain form of itself.
enum class BoxEnd { lower, upper };
// "lower" or "upper", in result files and sentences.
constexpr std::string_view word_of(BoxEnd end) { return end == BoxEnd::lower ? "lower" : "upper"; }
struct BoxLimit {
  std::string_view other;
  std::string_view parameter;
  BoxEnd end;
};

// Two parameters of an effect of which one sign goes with the other.
struct SameSign {
  std::string_view parameter;
  std::string_view other;
};

// `parameter` stands for `factor` times it as `its` of `effect`: a fit with one tells where to start one with the
// other.
struct KindredParameter {
  std::string_view parameter;
  std::string_view effect;
  std::string_view its;
  double factor;
};

// A damper law that has the effect as a part of its own. Without it the law is `rest`, and the part's size stands in
// the law's `parameter`; both empty where the law has it in another form.
struct PartOfLaw {
  std::string_view law;
  std::string_view rest = {};
  std::string_view parameter = {};
};

struct Knowledge {
  Family family = {};
  std::string_view in_words;  // its title as it stands in a sentence
  // In both "current" stands for the drive, "[with|without]" for what is said with a drive and without one:
  // "equally far at any speed[ and current]".
  std::string_view shows;           // what the force does where it is there, a clause
  std::string_view experiment;      // a recording that tells it from what it is mistaken for
  std::string_view rig_cause = {};  // what looks the same to the recordings without being in the damper
  Acts acts = Acts::everywhere;
  // The force is a multiple of one channel or a constant: a form that cannot be missed, so that what stays beside it is
  // not the remainder of its own.
  bool one_form = false;
  std::span<const Need> needs = {};                // beside motion and force
  std::span<const std::string_view> kin = {};      // what it is mistaken for, whatever the recordings
  std::span<const Limit> holds = {};               // effects that it is at a limit of its own
  std::span<const Limit> limit_of = {};            // effects that are this one at a limit of theirs
  std::span<const BoxLimit> ends_as = {};          // effects that it is at an end of its own box
  std::span<const PartOfLaw> part_of = {};         // damper laws that have it as a part of their own
  std::span<const KindredParameter> kindred = {};  // parameters of its own that stand for others
  std::span<const SameSign> same_sign = {};        // pairs of parameters of its own that are of one sign
  std::span<const ContrastSense> contrasts = {};   // what only it does to the force, and with which sign
};

// Families of the catalogue. One that none of them describes is declared beside its effect.
namespace families {
inline constexpr Family free_travel = {"free-travel", "travel without force after a reversal"};
inline constexpr Family series = {"series", "something that gives way in series with the damper"};
inline constexpr Family friction = {"friction", "friction beside the damper"};
inline constexpr Family fluid = {"fluid", "another curve of the viscous force over the speed"};
inline constexpr Family place = {"place", "a force of where the rod is"};
inline constexpr Family direction = {"direction", "a difference between the two directions of motion"};
inline constexpr Family phase = {"phase", "a shift between motion and force"};
inline constexpr Family slow_loss = {"slow-loss", "a slow loss of force"};
inline constexpr Family drive_path = {"drive-path", "a field that does not follow the drive"};
inline constexpr Family force_channel = {"force-channel", "a fault of the force channel"};
}  // namespace families

}  // namespace hysteron

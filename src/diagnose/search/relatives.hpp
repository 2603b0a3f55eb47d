// Which effects are mistaken for one another, whatever the recordings: one is a limit of the other, or their signatures
// agree on all but few motions.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// Effects to set against `id` besides those the data bring up; empty for an unknown id.
std::vector<std::string> relatives(const std::string& id);
bool is_kin(const std::string& effect, const std::string& other);

// Whether the effect is a force that depends on where the rod is.
bool is_of_place(const std::string& effect);

// Whether the effect does exactly nothing but in a part of the stroke.
bool acts_in_a_part(const std::string& effect);

// Whether the effect's force is a multiple of one channel or a constant: such a form cannot be missed, so that what
// stays beside it is not the remainder of its own.
bool has_one_form(const std::string& effect);

// Whether `wider` with further parameters at a limit is `effect` itself, in every motion.
bool is_limit(const std::string& effect, const std::string& wider);
// The parameter of `wider` that is zero at that limit; empty where none is, or where it is no limit.
std::string limit_parameter(const std::string& effect, const std::string& wider);

// A parameter with which, at one end of its box, `effect` is `other`.
enum class BoxEnd { lower, upper };
struct BoxLimit {
  std::string_view effect;
  std::string_view other;
  std::string_view parameter;
  BoxEnd end;
};
// Null where there is none.
const BoxLimit* box_limit(const std::string& effect, const std::string& other);

// Whether the law has the effect as a linear parameter of its own, as a stiffness or an offset.
bool is_part_of(const std::string& effect, const std::string& law);

// The effect that a lag of the velocity channel is, which the channels show without any model.
constexpr const char* channel_lag = "velocity-lag";

// What parameters of related effects, "effect.parameter", mean of each other: the value of `to` is `factor` times that
// of `from`, so that a fit with one effect tells where to start one with the other.
struct Kindred {
  std::string_view from;
  std::string_view to;
  double factor;
};
std::span<const Kindred> kindred();

}  // namespace hysteron

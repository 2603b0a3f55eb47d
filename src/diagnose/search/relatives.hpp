// What the cards of effects (simulate/knowledge.hpp) say of one another: one is a limit of the other, or their
// signatures agree on all but few motions. A relation holds both ways, whichever of the two says it, so that effects of
// a plugin are set against those of the catalogue and the other way round.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulate/knowledge.hpp"

namespace hysteron {

// Of the effect's card; empty where it has none, or where there is no such effect.
const Knowledge& knowledge_of(std::string_view effect);

// Effects to set against `id` besides those the data bring up; empty for an unknown id.
std::vector<std::string> relatives(const std::string& id);
bool is_kin(const std::string& effect, const std::string& other);

// Whether the effect's force is a multiple of one channel or a constant: such a form cannot be missed, so that what
// stays beside it is not the remainder of its own.
bool has_one_form(const std::string& effect);

// Whether `wider` with further parameters at a limit is `effect` itself, in every motion.
bool is_limit(const std::string& effect, const std::string& wider);
// The parameter of `wider` that is zero at that limit; empty where none is, or where it is no limit.
std::string limit_parameter(const std::string& effect, const std::string& wider);

// A parameter with which, at one end of its box, `effect` is `other`; null where there is none.
const BoxLimit* box_limit(const std::string& effect, const std::string& other);

// Whether the effect at that end of the parameter's box is a plain form of itself, as Coulomb's law is of a friction
// that turns over a distance: to sit there is no sign that its form is wrong.
bool is_plain_end(const std::string& effect, const std::string& parameter, BoxEnd end);

// Whether the law has the effect as a part of its own: the effect's card says so, or it is a linear parameter of the
// law, as a stiffness or an offset. All that it has.
bool is_part_of(const std::string& effect, const std::string& law);
// What the effect's card says of itself as a part of the law; null where it says nothing.
const PartOfLaw* part_of_law(const std::string& effect, const std::string& law);
// The law that is left without the effect; empty where the card knows none.
std::string rest_of_law(const std::string& effect, const std::string& law);
std::vector<std::string> parts_of(const std::string& law);

// The effect that a lag of the velocity channel is, which the channels show without any model.
constexpr const char* channel_lag = "velocity-lag";

// What parameters of related effects, "effect.parameter", mean of each other: the value of `to` is `factor` times that
// of `from`, so that a fit with one effect tells where to start one with the other.
struct Kindred {
  std::string from;
  std::string to;
  double factor;
};
std::vector<Kindred> kindred();

// An effect related to another, and how where it is more than mistaken for it: "the same where its gap is zero".
struct Relation {
  std::string id;
  std::string how;
};
// Its relatives, then what else it ends as or ends as it.
std::vector<Relation> relations_of(const std::string& effect);

// An effect that a contrast speaks for, and the sign that its value has where the effect acts.
struct Voice {
  std::string_view effect;
  Sense sense = Sense::either;
};
// Those whose cards say so, plugins' included, in the order of the catalogue.
std::vector<Voice> voices_of(ContrastKind kind);

}  // namespace hysteron

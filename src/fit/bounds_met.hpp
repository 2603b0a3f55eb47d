// What it means that identified parameters sit on ends of their boxes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/message.hpp"
#include "fit/layout.hpp"
#include "fit/solver.hpp"

namespace hysteron {

// Of a coordinate on a bound: the upper one.
inline bool on_upper(double u) { return u > 0.5; }

// Whether an end of the parameter's box is one of what it can be at all.
bool is_limit(const Parameter& card, bool upper);

// NRMSE where the coordinates of the point `u` that sit on an end of their search range were free to go on, to first
// order: by the Gauss-Newton step from there, the free coordinates moving along. What sits on the end of what it can be
// at all stays. `derivatives` are those at the point. Absent where nothing is to be set free or the point diverged.
std::optional<double> cost_beyond_bounds(const Layout& layout, const Response& derivatives,
                                         const std::vector<double>& u);

// Which parameters sit on an end of their search range that is none of what they can be at all.
struct EndsMet {
  std::string text;    // what that costs in the error, for people; empty without any
  bool costs = false;  // error that shows
  Message wider = "";  // the options that widen the ranges
};
EndsMet ends_met(const Layout& layout, const Response& derivatives, const std::vector<double>& u, DriveKind drive_kind);

// One sentence or two for people: which parameters are at the end of what they can be, which at the end of their search
// range, what the range costs in the error, and the option that widens it. Empty where no parameter meets an end.
Message bounds_text(const Layout& layout, const Response& derivatives, const std::vector<double>& u,
                    DriveKind drive_kind);

}  // namespace hysteron

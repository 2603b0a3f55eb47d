// Which candidates of a request are marched side by side. A pack takes as long as its stiffest lane, so candidates are
// packed in the order of the sub-steps that their stiffness asks for. No lane depends on its company: what is packed
// with what changes no result.
#pragma once

#include <span>
#include <vector>

#include "fit/layout.hpp"
#include "fit/pack.hpp"
#include "fit/target.hpp"

namespace hysteron {

// Packs that are marched at once: one, or two side by side.
struct Deal {
  std::size_t first_pack;
  std::size_t packs;
};

struct Packing {
  std::vector<std::size_t> order;  // rows of the request; pack k has those from k lane_count on
  std::vector<Deal> deals;         // in order, every pack once

  [[nodiscard]] Rows rows(const Deal& deal) const;
};

// For rows of `points` on targets of which `like` is one. Two packs go side by side if `in_pairs` and where that is
// faster than one after the other.
Packing pack_candidates(const Layout& layout, const std::vector<double>& points, const Target& like, bool in_pairs);

}  // namespace hysteron

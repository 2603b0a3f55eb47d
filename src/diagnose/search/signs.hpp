// Signs that an effect's parameters can have together. A descent may end in the other half of the box, where a form
// that is not the effect's does as well beside others: a gas spring whose force falls as the gas is compressed, beside
// a cubic stiffness that makes up for it.
#pragma once

#include <optional>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Where two parameters of an effect have signs that its card says they cannot have together (Knowledge::same_sign): the
// fit on the other side of either, refitted, if it is there as good but for what a part must gain. Nothing where all
// signs are possible, or where no such fit is.
std::optional<Fit> turned_round(const Workbench& bench, const Fit& fit);

}  // namespace hysteron

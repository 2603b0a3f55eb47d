// Recordings of a campaign that are one: a held-out error on a copy of what was fitted would be none.
#pragma once

#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Remarks of recordings whose file holds the bytes of an earlier one, and of those whose displacement and force, sample
// by sample, are nearer to an earlier one than two tests come: by a thousandth, as rounded numbers, or by less than the
// noise of two, or that share a quarter of the samples of the shorter one, digit for digit or but for the digits that
// they are rounded to (check/rounded_copies.hpp), wherever these stand.
std::vector<Remark> remarks_on_copies(const std::vector<Recording>& recordings);

}  // namespace hysteron

// Size of an effect in each part of the recordings, where one size fits all of them: the coefficient of what the effect
// does in what is left without it.
//   r_without = b s + rest,   s = r_without - r_with,   b_p = <r_without, s>_p / <s, s>_p
// Of the effect that is there b is one everywhere; what covers for another is too small here and too large there,
// whatever it gains over all.
#pragma once

#include <span>
#include <vector>

#include "core/part_size.hpp"
#include "core/recording.hpp"

namespace hysteron {

// Residuals of each recording without the effect and with it, over the normaliser, of its last samples. Parts in which
// the effect does nothing are absent, and recordings whose residuals are not finite.
std::vector<SizeOfPart> sizes_of_parts(std::span<const Recording> recordings,
                                       const std::vector<std::vector<double>>& without,
                                       const std::vector<std::vector<double>>& with);

}  // namespace hysteron

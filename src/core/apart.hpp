// Recordings that were made where the rod was in no other one.
#pragma once

#include <cstddef>
#include <vector>

#include "core/recording.hpp"

namespace hysteron {

// Where the rod was, m.
struct RodStretch {
  double low = 0.0;
  double high = 0.0;
};

struct Apart {
  std::size_t recording = 0;
  RodStretch own;
  RodStretch others;  // all others together
};

// Each that lies apart from all others by more than the whole length that these cover: its zero may be another. Of
// three recordings or more, since of two either may be right. Recordings at several positions of the rod, as of a test
// at mid-stroke and near both ends, do not look so: the others cover a long stretch.
std::vector<Apart> apart_from_others(const std::vector<Recording>& recordings);

}  // namespace hysteron

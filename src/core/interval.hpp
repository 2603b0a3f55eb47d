// An interval of numbers: of confidence, of quantiles.
#pragma once

namespace hysteron {

struct Interval {
  double lower;
  double upper;
};

}  // namespace hysteron

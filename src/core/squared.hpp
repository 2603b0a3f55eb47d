#pragma once

namespace hysteron {

inline double squared(double value) { return value * value; }

}  // namespace hysteron

// What recordings made before one did to the damper: heat that is not yet lost when it begins, and wear that stays.
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hysteron {

struct Recording;

// Work of a stretch of time before a recording began.
struct EarlierWork {
  double ago = 0.0;   // s, from the middle of the stretch to the first sample, not negative
  double work = 0.0;  // J, integral of the measured force over the displacement
};

// J, what is left of it where it fades at this rate (1/s): a number or a pack of them, 0 for wear.
template <class T>
T left_of(std::span<const EarlierWork> earlier, const T& rate) {
  using std::exp;
  T sum(0.0);
  for (const EarlierWork& stretch : earlier) {
    sum += T(stretch.work) * exp(T(-stretch.ago) * rate);
  }
  return sum;
}

// A recording whose start cannot be its own, and why.
struct WrongStart {
  std::string file;
  std::string why;
};

// Gives every recording the work of those that were started before it, oldest first, where all say when they were
// started and hold a force; else none has any. Stretches are short beside their age, so that what fades with time may
// take each at its middle. Returns the first start that contradicts the recordings; nothing is carried then.
std::optional<WrongStart> carry_work(std::vector<Recording>& recordings);

}  // namespace hysteron

// Whether a motion under an excitation that is repeated has become steady, by its states where the periods meet.
#pragma once

#include <optional>
#include <span>

#include "respond/respond.hpp"

namespace hysteron {

struct Settling {
  double change;  // over the last period, over the largest displacement (m) or velocity (m/s) of that period
  // What is left to the steady motion at the pace of the last two changes, likewise; nothing where they do not fall, or
  // where there is one period.
  std::optional<double> left;
  std::optional<double> factor;  // of that pace, a period
};

// Of a motion over `periods` periods of `samples` samples, one at least, and one sample more.
Settling settling_of(const MassMotion& motion, int periods, std::size_t samples);

}  // namespace hysteron

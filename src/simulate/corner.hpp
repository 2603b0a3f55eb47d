// Corners of a motion: displacement on two straight lines that meet between or on samples, as triangle waves and ramps
// have. Interpolating the velocity across one would turn hysteresis up to half a sample's travel early. Told from the
// samples that are marched and not carried from where velocities are derived (io/velocity.hpp): thinned recordings and
// those with a velocity of their own have corners too.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace hysteron {

// Velocity along an interval of length h: start + start_slope t before `at`, a theta in [0, 1], and
// end - end_slope (h - t) after it. m/s, m/s^2.
struct VelocityCorner {
  double start;
  double start_slope;
  double end;
  double end_slope;
  double at;
};

// The corner in the interval from sample n to n + 1, or on one of the two. Where the velocity changes by a good
// part of the largest speed around and is steady on both sides. Spans of equal length, time in s strictly increasing,
// m, m/s.
std::optional<VelocityCorner> corner_of(std::span<const double> time, std::span<const double> displacement,
                                        std::span<const double> velocity, std::size_t n);

}  // namespace hysteron

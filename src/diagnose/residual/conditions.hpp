// What was recorded of each recording's circumstances, and whether it explains a parting of the recordings.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/partition.hpp"

namespace hysteron {

// One number of each recording.
struct Condition {
  std::string name;
  std::vector<double> value;
  bool ratio = false;     // differences are those of its logarithm; all values are positive
  double absolute = 0.0;  // above zero: the difference that does not count, else a twentieth
};

// Half stroke, frequency, peak speed and form of the motion, its middle, drive, its spread and temperature; those left
// out that no two recordings differ in by more than a twentieth.
std::vector<Condition> conditions_of(const std::vector<Recording>& recordings);

// A condition that parts the recordings of two groups, the ones of the first all below or all above those of the
// second; none: nullptr.
const Condition* parted_by(const std::vector<Condition>& conditions, const Group& a, const Group& b);

// Recordings that no condition tells apart, a twentieth being no difference; each is in one cell.
std::vector<Group> cells_of(const std::vector<Condition>& conditions, std::size_t recordings);

// Least squares when the parameters follow a condition, or the order of the recordings, by a parabola, a condition of
// few levels (at most half as many as recordings) by any function, or drive, stroke and frequency together by a plane;
// and what they follow.
struct Followed {
  std::string name;
  double squares = 0.0;
};
Followed followed(const std::vector<Quadratic>& quadratics, const std::vector<Condition>& conditions);

}  // namespace hysteron

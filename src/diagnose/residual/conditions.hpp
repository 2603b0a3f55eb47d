// What was recorded of each recording's circumstances, and whether it explains a parting of the recordings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/residual/partition.hpp"

namespace hysteron {

// One number of each recording.
struct RecordedCondition {
  std::string name;
  std::vector<double> value;
  bool ratio = false;     // differences are those of its logarithm; all values are positive
  double absolute = 0.0;  // above zero: the difference that does not count, else a twentieth
  bool unused = false;    // a recorded column that no model uses, named as in the file
};

// Half stroke, frequency, peak speed and form of the motion, its middle, drive, its spread, and the columns that no
// model uses; those left out that no two recordings differ in by more than a twentieth.
std::vector<RecordedCondition> conditions_of(const std::vector<Recording>& recordings);

// The motion of each recording, by its number: recordings have one where stroke, frequency, speed, form and middle
// differ by no more than a twentieth. What a model misses of a motion it misses again in each of them.
std::vector<std::size_t> motions_of(const std::vector<Recording>& recordings);

// A condition that parts the recordings of two groups, the ones of the first all below or all above those of the
// second; none: nullptr.
const RecordedCondition* parted_by(const std::vector<RecordedCondition>& conditions, const Group& a, const Group& b);

// Recordings that no condition tells apart, a twentieth being no difference; each is in one cell.
std::vector<Group> cells_of(const std::vector<RecordedCondition>& conditions, std::size_t recordings);

// Least squares when the parameters follow a condition, or the order of the recordings, by a parabola, a condition of
// few levels (at most half as many as recordings) by any function, or drive, stroke and frequency together by a plane.
double squares_followed(const std::vector<Quadratic>& quadratics, const std::vector<RecordedCondition>& conditions);

// A column that no model uses and that the parameters follow from recording to recording.
struct FollowedColumn {
  std::string name;
  double low = 0.0;  // least and largest of its means, in the unit of the file
  double high = 0.0;
  double together = 0.0;  // squares to first order: parameters common to all recordings, and affine in the column
  double along = 0.0;
  double chance =
      1.0;  // that the column, dealt to the recordings by lot, leaves as little; times the number of columns
  Eigen::VectorXd change;  // of each parameter, from `low` to `high`
  Eigen::VectorXd cost;    // squares that come back without the change of each, the others as they are
};
// The column that leaves least, where chance does not explain it and neither stroke, frequency, drive nor any other
// known condition, nor the order of the recordings, leaves as little.
std::optional<FollowedColumn> followed_column(const std::vector<Quadratic>& quadratics,
                                              const std::vector<RecordedCondition>& conditions);

}  // namespace hysteron

// Which recordings one set of parameters fits together. The misfit of each recording is a quadratic in the changes of
// the parameters, exact where the force is affine in them; merging two groups costs what one common change leaves more
// than two of their own.
//   q_r(d) = |r_r + S_r d|^2,   cost(G) = min over d of the sum of q_r(d) over r in G
// Groups are merged by the least cost (Ward, J. Am. Stat. Assoc. 58 (1963) 236, in the metric of the data).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace hysteron {

// Of one recording, p parameters: S^T S (p x p), S^T r (p), r^T r; squares are of NRMSE.
struct Quadratic {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  double squares = 0.0;
};

using Group = std::vector<std::size_t>;  // of recordings, in ascending order

struct Partition {
  std::vector<Group> groups;  // the largest first, then by their first recording
  double together = 0.0;      // squares with one change for all recordings, with one for each group, one for each
  double apart = 0.0;
  double alone = 0.0;
  double chance = 1.0;  // probability that parameters which scatter from recording to recording part as well

  // Of what changes of their own take off every recording: what those of the groups take.
  [[nodiscard]] double share() const;
};

// The change of the parameters that suits a group best, and the squares it leaves. Directions that the group does not
// determine stay at zero.
struct Common {
  Eigen::VectorXd change;
  double squares = 0.0;
};
Common common_of(const std::vector<Quadratic>& quadratics, const Group& group);

// Probability up to which chance does not explain a partition.
constexpr double surely = 5e-3;

// The fewest groups that chance does not explain and that fit their recordings as well as fits of each alone (within a
// twentieth of what these take off); without any, those that chance explains least. Groups of one recording confirm no
// state and do not count in this; nothing where fewer than two hold two, or of fewer than four recordings. Chance:
// changes drawn from a normal and from an even distribution along the direction that tells the two largest groups
// apart, all other directions silent, which part better than any that scatter in several; the larger probability, times
// the numbers of groups there are to choose from.
std::optional<Partition> clearest_partition(const std::vector<Quadratic>& quadratics);

// The fewest groups that fit their recordings as well as fits of each alone, whatever chance; a group may be one
// recording. Nothing of fewer than four.
std::optional<Partition> coarsest_partition(const std::vector<Quadratic>& quadratics);

// Squares that come back, for each parameter, when it alone must be common to all groups: which parameters differ.
std::vector<double> cost_of_sharing(const std::vector<Quadratic>& quadratics, const std::vector<Group>& groups);

// The change of the parameters that is a linear function of these regressors (recordings x functions), and what it
// leaves.
struct Along {
  Eigen::MatrixXd change;  // parameters x functions
  double squares = 0.0;
};
Along along(const std::vector<Quadratic>& quadratics, const Eigen::MatrixXd& regressors);

}  // namespace hysteron

#include "diagnose/residual/partition.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "core/robust.hpp"

namespace hysteron {
namespace {

// Of the mean recording's curvature: keeps what a group does not determine where it is.
constexpr double ridge = 1e-6;
// Groups fit their recordings as well as fits of each alone when they leave so much of what these take off.
constexpr double as_good_as_alone = 0.05;
// Draws of chance: ten of them lie beyond what is sure.
constexpr std::size_t draws = 2000;
// Of fewer recordings nothing is parted.
constexpr std::size_t fewest_recordings = 4;

// Minimises a sum of quadratics, damped by a share of the mean recording's curvature.
class Minimiser {
 public:
  explicit Minimiser(const std::vector<Quadratic>& quadratics) {
    const Eigen::Index p = quadratics.front().gradient.size();
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(p);
    for (const Quadratic& row : quadratics) {
      mean += row.hessian.diagonal() / static_cast<double>(quadratics.size());
    }
    damping_ = (ridge * mean).cwiseMax(1e-300);
  }
  [[nodiscard]] Common least(const Quadratic& sum) const {
    Eigen::MatrixXd matrix = sum.hessian;
    matrix.diagonal() += damping_;
    Common result;
    result.change = -matrix.ldlt().solve(sum.gradient);
    result.squares = sum.squares + result.change.dot(2.0 * sum.gradient + sum.hessian * result.change);
    if (!std::isfinite(result.squares) || result.squares > sum.squares) {
      return {Eigen::VectorXd::Zero(sum.gradient.size()), sum.squares};
    }
    return result;
  }
  [[nodiscard]] const Eigen::VectorXd& damping() const { return damping_; }

 private:
  Eigen::VectorXd damping_;
};

Quadratic added(const Quadratic& a, const Quadratic& b) {
  return {a.hessian + b.hessian, a.gradient + b.gradient, a.squares + b.squares};
}

Quadratic sum_of(const std::vector<Quadratic>& quadratics, const Group& group) {
  Quadratic sum = quadratics[group.front()];
  for (std::size_t k = 1; k < group.size(); ++k) {
    sum = added(sum, quadratics[group[k]]);
  }
  return sum;
}

// Every partition on the way from all recordings apart to all in one: element k has k + 1 groups.
struct Merging {
  std::vector<std::vector<Group>> groups;
  std::vector<double> squares;
};

Merging merging_of(const std::vector<Quadratic>& quadratics, const Minimiser& minimiser) {
  struct Node {
    Group members;
    Quadratic sum;
    double squares;
  };
  std::vector<Node> nodes;
  double total = 0.0;
  for (std::size_t r = 0; r < quadratics.size(); ++r) {
    nodes.push_back({{r}, quadratics[r], minimiser.least(quadratics[r]).squares});
    total += nodes.back().squares;
  }
  const std::size_t count = nodes.size();
  const auto cost_of = [&](const Node& a, const Node& b) {
    return minimiser.least(added(a.sum, b.sum)).squares - a.squares - b.squares;
  };
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count),
                                                   std::numeric_limits<double>::infinity());
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      cost(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) = cost_of(nodes[a], nodes[b]);
    }
  }
  Merging result;
  result.groups.resize(count);
  result.squares.resize(count);
  const auto keep = [&](std::size_t groups) {
    result.squares[groups - 1] = total;
    for (const Node& node : nodes) {
      if (!node.members.empty()) {
        result.groups[groups - 1].push_back(node.members);
      }
    }
  };
  keep(count);
  for (std::size_t groups = count - 1; groups > 0; --groups) {
    Eigen::Index a = 0;
    Eigen::Index b = 0;
    total += cost.minCoeff(&a, &b);
    Node& into = nodes[static_cast<std::size_t>(a)];
    Node& from = nodes[static_cast<std::size_t>(b)];
    into.members.insert(into.members.end(), from.members.begin(), from.members.end());
    std::ranges::sort(into.members);
    into.sum = added(into.sum, from.sum);
    into.squares = minimiser.least(into.sum).squares;
    from.members.clear();
    cost.row(b).setConstant(std::numeric_limits<double>::infinity());
    cost.col(b).setConstant(std::numeric_limits<double>::infinity());
    for (Eigen::Index k = 0; k < cost.rows(); ++k) {
      const Node& other = nodes[static_cast<std::size_t>(k)];
      if (k != a && !other.members.empty()) {
        cost(std::min(a, k), std::max(a, k)) = cost_of(into, other);
      }
    }
    keep(groups);
  }
  return result;
}

// Of values with these weights, merged likewise: what stays within k + 1 groups, of what all have together. Only
// neighbours are looked at, one of whose merges is always the cheapest.
std::vector<double> merged_on_a_line(const std::vector<double>& values, const std::vector<double>& weights) {
  struct Cluster {
    double value;
    double weight;
  };
  std::vector<Cluster> line;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    line.push_back({values[k], weights[k]});
  }
  std::ranges::sort(line, {}, &Cluster::value);
  std::vector<double> within(line.size(), 0.0);
  const auto cost = [&](std::size_t k) {
    const double gap = line[k + 1].value - line[k].value;
    return gap * gap * line[k].weight * line[k + 1].weight / (line[k].weight + line[k + 1].weight);
  };
  double total = 0.0;
  while (line.size() > 1) {
    std::size_t best = 0;
    for (std::size_t k = 1; k + 1 < line.size(); ++k) {
      best = cost(k) < cost(best) ? k : best;
    }
    total += cost(best);
    const double weight = line[best].weight + line[best + 1].weight;
    line[best] = {(line[best].value * line[best].weight + line[best + 1].value * line[best + 1].weight) / weight,
                  weight};
    line.erase(line.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    within[line.size() - 1] = total;
  }
  for (double& value : within) {
    value /= total;
  }
  return within;
}

// What draws of parameters that scatter leave within groups, by the number of these.
class Chance {
 public:
  void add(bool normal, const std::vector<double>& within) { within_[normal ? 0 : 1].push_back(within); }
  // Probability of so little or less: the larger one of normal and of even scatter.
  [[nodiscard]] double below(std::size_t groups, double within) const {
    double result = 0.0;
    for (const std::vector<std::vector<double>>& all : within_) {
      const auto lower = std::ranges::count_if(all, [&](const auto& row) { return row[groups - 1] <= within; });
      result = std::max(result, static_cast<double>(1 + lower) / static_cast<double>(1 + all.size()));
    }
    return result;
  }
  // The median.
  [[nodiscard]] double usual(std::size_t groups) const {
    std::vector<double> values;
    for (const std::vector<double>& row : within_[0]) {
      values.push_back(row[groups - 1]);
    }
    return median_of(std::move(values));
  }

 private:
  std::array<std::vector<std::vector<double>>, 2> within_;
};

Chance chance_of(const std::vector<double>& weights) {
  Chance result;
  std::vector<double> values(weights.size());
  for (std::size_t n = 0; n < draws; ++n) {
    const Stream stream = Stream(n).child("parting");
    for (const bool normal : {true, false}) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = normal ? stream.normal(k, 0) : stream.uniform(k, 1);
      }
      result.add(normal, merged_on_a_line(values, weights));
    }
  }
  return result;
}

// How tight groups are: what they leave of what one change for all of them leaves, both less what changes of their own
// leave; and what each of their recordings tells of a change along the direction in which the two largest groups
// differ. No weights where nothing does.
struct Tightness {
  double within = 1.0;
  std::vector<double> weights;
};

Tightness tightness_of(const std::vector<Quadratic>& quadratics, const Minimiser& minimiser,
                       const std::vector<Group>& groups) {
  std::vector<Group> sorted = groups;
  std::ranges::stable_sort(sorted, std::greater{}, &Group::size);
  const Eigen::VectorXd direction =
      minimiser.least(sum_of(quadratics, sorted[0])).change - minimiser.least(sum_of(quadratics, sorted[1])).change;
  Group all;
  double apart = 0.0;
  double alone = 0.0;
  Tightness result;
  double heaviest = 0.0;
  for (const Group& group : groups) {
    all.insert(all.end(), group.begin(), group.end());
    apart += minimiser.least(sum_of(quadratics, group)).squares;
  }
  for (const std::size_t r : all) {
    alone += minimiser.least(quadratics[r]).squares;
    result.weights.push_back(std::max(direction.dot(quadratics[r].hessian * direction), 0.0));
    heaviest = std::max(heaviest, result.weights.back());
  }
  const double together = minimiser.least(sum_of(quadratics, all)).squares;
  if (!(together > alone) || !(heaviest > 0.0)) {
    return {};
  }
  for (double& weight : result.weights) {
    weight = std::max(weight, ridge * heaviest);
  }
  result.within = (apart - alone) / (together - alone);
  return result;
}

std::vector<Group> ordered(std::vector<Group> groups) {
  std::ranges::stable_sort(groups, [](const Group& a, const Group& b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return groups;
}

}  // namespace

double Partition::share() const { return together > alone ? (together - apart) / (together - alone) : 0.0; }

Common common_of(const std::vector<Quadratic>& quadratics, const Group& group) {
  return Minimiser(quadratics).least(sum_of(quadratics, group));
}

std::optional<Partition> clearest_partition(const std::vector<Quadratic>& quadratics) {
  const std::size_t count = quadratics.size();
  if (count < fewest_recordings) {
    return {};
  }
  const Minimiser minimiser(quadratics);
  const Merging merging = merging_of(quadratics, minimiser);
  const std::size_t most = count / 2;
  std::optional<Partition> best;
  std::optional<Partition> fewest;
  double clearest = std::numeric_limits<double>::infinity();
  std::size_t drawn_for = 0;
  Chance chance;
  for (std::size_t k = 1; k < most; ++k) {
    // A recording alone confirms nothing, and one far off makes any parting of the others look tight.
    std::vector<Group> groups = merging.groups[k];
    std::erase_if(groups, [](const Group& group) { return group.size() < 2; });
    if (groups.size() < 2) {
      continue;
    }
    const Tightness tight = tightness_of(quadratics, minimiser, groups);
    if (tight.weights.empty()) {
      continue;
    }
    if (tight.weights.size() != drawn_for) {
      drawn_for = tight.weights.size();
      chance = chance_of(tight.weights);
    }
    Partition one{ordered(merging.groups[k]), merging.squares.front(), merging.squares[k], merging.squares.back(), 1.0};
    // The number of groups is chosen among so many.
    one.chance = std::min(1.0, chance.below(groups.size(), tight.within) * static_cast<double>(most - 1));
    const double clear = tight.within / chance.usual(groups.size());
    if (!best || one.chance < best->chance || (one.chance == best->chance && clear < clearest)) {
      clearest = clear;
      best = one;
    }
    if (!fewest && one.chance <= surely && tight.within <= as_good_as_alone) {
      fewest = std::move(one);
    }
  }
  return fewest ? fewest : best;
}

std::optional<Partition> coarsest_partition(const std::vector<Quadratic>& quadratics) {
  if (quadratics.size() < fewest_recordings) {
    return {};
  }
  const Merging merging = merging_of(quadratics, Minimiser(quadratics));
  for (std::size_t k = 1; k < merging.groups.size(); ++k) {
    Partition one{ordered(merging.groups[k]), merging.squares.front(), merging.squares[k], merging.squares.back(), 1.0};
    if (1.0 - one.share() <= as_good_as_alone) {
      return one;
    }
  }
  return {};
}

Along along(const std::vector<Quadratic>& quadratics, const Eigen::MatrixXd& regressors) {
  const Eigen::Index p = quadratics.front().gradient.size();
  const Eigen::Index m = regressors.cols();
  Quadratic sum{Eigen::MatrixXd::Zero(p * m, p * m), Eigen::VectorXd::Zero(p * m), 0.0};
  const Minimiser minimiser(quadratics);
  for (std::size_t r = 0; r < quadratics.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    for (Eigen::Index a = 0; a < m; ++a) {
      sum.gradient.segment(a * p, p) += regressors(row, a) * quadratics[r].gradient;
      for (Eigen::Index b = 0; b < m; ++b) {
        sum.hessian.block(a * p, b * p, p, p) += regressors(row, a) * regressors(row, b) * quadratics[r].hessian;
      }
    }
    sum.squares += quadratics[r].squares;
  }
  Eigen::MatrixXd matrix = sum.hessian;
  for (Eigen::Index a = 0; a < m; ++a) {
    matrix.diagonal().segment(a * p, p) += minimiser.damping();
  }
  const Eigen::VectorXd change = -matrix.ldlt().solve(sum.gradient);
  const double squares = sum.squares + change.dot(2.0 * sum.gradient + sum.hessian * change);
  if (!std::isfinite(squares) || squares > sum.squares) {
    return {Eigen::MatrixXd::Zero(p, m), sum.squares};
  }
  return {change.reshaped(p, m), squares};
}

std::vector<double> cost_of_sharing(const std::vector<Quadratic>& quadratics, const std::vector<Group>& groups) {
  const Eigen::Index p = quadratics.front().gradient.size();
  const auto count = static_cast<Eigen::Index>(groups.size());
  const Minimiser minimiser(quadratics);
  std::vector<Quadratic> sums;
  double apart = 0.0;
  for (const Group& group : groups) {
    sums.push_back(sum_of(quadratics, group));
    apart += minimiser.least(sums.back()).squares;
  }
  std::vector<double> result;
  for (Eigen::Index shared = 0; shared < p; ++shared) {
    // Unknowns: the shared parameter, then the others of each group.
    const Eigen::Index size = 1 + count * (p - 1);
    const auto place = [&](Eigen::Index group, Eigen::Index parameter) {
      return parameter == shared ? 0 : 1 + group * (p - 1) + (parameter < shared ? parameter : parameter - 1);
    };
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(size);
    double squares = 0.0;
    for (Eigen::Index g = 0; g < count; ++g) {
      const Quadratic& sum = sums[static_cast<std::size_t>(g)];
      for (Eigen::Index a = 0; a < p; ++a) {
        slope(place(g, a)) += sum.gradient(a);
        matrix(place(g, a), place(g, a)) += minimiser.damping()(a);
        for (Eigen::Index b = 0; b < p; ++b) {
          matrix(place(g, a), place(g, b)) += sum.hessian(a, b);
        }
      }
      squares += sum.squares;
    }
    const Eigen::VectorXd change = -matrix.ldlt().solve(slope);
    result.push_back(std::max(0.0, squares + change.dot(slope) - apart));
  }
  return result;
}

}  // namespace hysteron

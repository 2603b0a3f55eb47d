#include "diagnose/residual/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "core/random.hpp"

namespace hysteron {
namespace {

// Of its size, by which a condition may change and the force still be that of a repeated test.
constexpr double repeated = 0.05;

double mean_of(const std::vector<double>& values) {
  return values.empty() ? 0.0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
}

// Values on a scale on which the largest difference that does not count is one.
std::vector<double> scaled(const RecordedCondition& condition) {
  std::vector<double> result = condition.value;
  const double largest = std::max(peak_of(condition.value), 1e-300);
  for (double& value : result) {
    value = condition.absolute > 0.0 ? value / condition.absolute
                                     : (condition.ratio ? std::log(value) : value / largest) / repeated;
  }
  return result;
}

bool varied(const RecordedCondition& condition) {
  if (condition.value.size() < 2) {
    return false;
  }
  const std::vector<double> values = scaled(condition);
  const auto [low, high] = std::ranges::minmax(values);
  return high - low > 1.0;
}

// From -1 to 1.
Eigen::VectorXd column_of(const RecordedCondition& condition) {
  const std::vector<double> values = scaled(condition);
  const auto [low, high] = std::ranges::minmax(values);
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t r = 0; r < values.size(); ++r) {
    result(static_cast<Eigen::Index>(r)) = 2.0 * (values[r] - low) / std::max(high - low, 1e-300) - 1.0;
  }
  return result;
}

}  // namespace

namespace {

// Appends a condition that some of the recordings differ in.
template <class Value>
void add_condition(std::vector<RecordedCondition>& all, const char* name, const std::vector<Recording>& recordings,
                   Value value) {
  RecordedCondition condition{name, {}, false, 0.0, false};
  for (const Recording& recording : recordings) {
    condition.value.push_back(value(recording));
  }
  condition.ratio = std::ranges::all_of(condition.value, [](double one) { return one > 0.0; });
  if (varied(condition)) {
    all.push_back(std::move(condition));
  }
}

// Ends of the stroke; zero of no samples.
std::pair<double, double> ends_of(const Recording& of) {
  if (of.displacement.empty()) {
    return {0.0, 0.0};
  }
  const auto [low, high] = std::ranges::minmax(of.displacement);
  return {low, high};
}

double half_stroke(const Recording& of) {
  const auto [low, high] = ends_of(of);
  return 0.5 * (high - low);
}

void add_stroke_and_frequency(std::vector<RecordedCondition>& all, const std::vector<Recording>& recordings) {
  add_condition(all, "stroke", recordings, half_stroke);
  add_condition(all, "frequency", recordings, dominant_frequency);
}

void add_form_and_middle(std::vector<RecordedCondition>& all, const std::vector<Recording>& recordings) {
  add_condition(all, "form of the motion", recordings,
                [](const Recording& of) { return spread_of(of.displacement) / std::max(half_stroke(of), 1e-300); });
  // Each recording sweeps its stroke: a shift of its middle by less than half of that shows nothing that the others do
  // not show.
  double largest = 0.0;
  for (const Recording& recording : recordings) {
    largest = std::max(largest, half_stroke(recording));
  }
  RecordedCondition middle{"middle of the stroke", {}, false, 0.5, false};
  for (const Recording& recording : recordings) {
    const auto [low, high] = ends_of(recording);
    middle.value.push_back(0.5 * (low + high) / std::max(largest, 1e-300));
  }
  if (varied(middle)) {
    all.push_back(std::move(middle));
  }
}

}  // namespace

std::vector<RecordedCondition> conditions_of(const std::vector<Recording>& recordings) {
  std::vector<RecordedCondition> all;
  add_stroke_and_frequency(all, recordings);
  add_condition(all, "peak speed", recordings, [](const Recording& of) { return peak_of(of.velocity); });
  add_form_and_middle(all, recordings);
  add_condition(all, "drive", recordings, [](const Recording& of) { return mean_of(of.drive); });
  add_condition(all, "spread of the drive", recordings, [](const Recording& of) { return spread_of(of.drive); });
  for (UnusedOfAll& column : unused_of_all(recordings)) {
    RecordedCondition condition{column.name, std::move(column.means), false, 0.0, true};
    condition.ratio = std::ranges::all_of(condition.value, [](double one) { return one > 0.0; });
    if (varied(condition)) {
      all.push_back(std::move(condition));
    }
  }
  return all;
}

std::vector<std::size_t> motions_of(const std::vector<Recording>& recordings) {
  std::vector<RecordedCondition> all;
  add_stroke_and_frequency(all, recordings);
  // The peak of a noisy speed is not that of the motion.
  add_condition(all, "speed", recordings, [](const Recording& of) { return spread_of(of.velocity); });
  add_form_and_middle(all, recordings);
  std::vector<std::size_t> result(recordings.size());
  const std::vector<Group> cells = cells_of(all, recordings.size());
  for (std::size_t motion = 0; motion < cells.size(); ++motion) {
    for (const std::size_t r : cells[motion]) {
      result[r] = motion;
    }
  }
  return result;
}

const RecordedCondition* parted_by(const std::vector<RecordedCondition>& conditions, const Group& a, const Group& b) {
  for (const RecordedCondition& condition : conditions) {
    const std::vector<double> values = scaled(condition);
    const auto range = [&](const Group& group) {
      double low = values[group.front()];
      double high = low;
      for (const std::size_t r : group) {
        low = std::min(low, values[r]);
        high = std::max(high, values[r]);
      }
      return std::pair{low, high};
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    if (low_a > high_b + 1.0 || low_b > high_a + 1.0) {
      return &condition;
    }
  }
  return nullptr;
}

std::vector<Group> cells_of(const std::vector<RecordedCondition>& conditions, std::size_t recordings) {
  std::vector<std::vector<double>> values;
  values.reserve(conditions.size());
  for (const RecordedCondition& condition : conditions) {
    values.push_back(scaled(condition));
  }
  std::vector<Group> result;
  for (std::size_t r = 0; r < recordings; ++r) {
    const auto cell = std::ranges::find_if(result, [&](const Group& group) {
      return std::ranges::all_of(
          values, [&](const std::vector<double>& of) { return std::fabs(of[r] - of[group.front()]) <= 1.0; });
    });
    if (cell == result.end()) {
      result.push_back({r});
    } else {
      cell->push_back(r);
    }
  }
  return result;
}

double squares_followed(const std::vector<Quadratic>& quadratics, const std::vector<RecordedCondition>& conditions) {
  const auto count = static_cast<Eigen::Index>(quadratics.size());
  std::vector<RecordedCondition> all = conditions;
  RecordedCondition order{"order of the recordings", std::vector<double>(quadratics.size()), false, 0.0, false};
  std::iota(order.value.begin(), order.value.end(), 0.0);
  all.push_back(std::move(order));
  Eigen::MatrixXd plane = Eigen::MatrixXd::Ones(count, 1);
  double best = std::numeric_limits<double>::infinity();
  const auto keep = [&](const Eigen::MatrixXd& regressors) {
    // As many functions as recordings follow anything.
    if (regressors.cols() < count - 1) best = std::min(best, along(quadratics, regressors).squares);
  };
  for (const RecordedCondition& condition : all) {
    const Eigen::VectorXd column = column_of(condition);
    Eigen::MatrixXd regressors(count, 3);
    regressors << Eigen::VectorXd::Ones(count), column, column.cwiseProduct(column);
    keep(regressors);
    // Levels that repeat allow for any function.
    const std::vector<Group> levels = cells_of({condition}, quadratics.size());
    if (2 * levels.size() <= quadratics.size()) {
      Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(levels.size()));
      for (std::size_t level = 0; level < levels.size(); ++level) {
        for (const std::size_t r : levels[level]) {
          steps(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(level)) = 1.0;
        }
      }
      keep(steps);
    }
    if (condition.name == "drive" || condition.name == "stroke" || condition.name == "frequency") {
      plane.conservativeResize(Eigen::NoChange, plane.cols() + 1);
      plane.col(plane.cols() - 1) = column;
    }
  }
  keep(plane);
  return best;
}

std::optional<FollowedColumn> followed_column(const std::vector<Quadratic>& quadratics,
                                              const std::vector<RecordedCondition>& conditions) {
  constexpr std::size_t permutations = 999;
  // Five recordings have 120 orders: one of them is no proof.
  constexpr Eigen::Index fewest_to_follow = 6;
  const auto count = static_cast<Eigen::Index>(quadratics.size());
  const auto affine = [&](const Eigen::VectorXd& column) {
    Eigen::MatrixXd regressors(count, 2);
    regressors << Eigen::VectorXd::Ones(count), column;
    return along(quadratics, regressors);
  };
  std::vector<RecordedCondition> known{
      {"order of the recordings", std::vector<double>(quadratics.size()), false, 0.0, false}};
  std::iota(known.front().value.begin(), known.front().value.end(), 0.0);
  const RecordedCondition* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  std::size_t columns = 0;
  for (const RecordedCondition& condition : conditions) {
    if (!condition.unused) {
      known.push_back(condition);
      continue;
    }
    ++columns;
    if (const double squares = affine(column_of(condition)).squares; squares < least) {
      least = squares;
      best = &condition;
    }
  }
  if (best == nullptr || count < fewest_to_follow) {
    return {};
  }
  for (const RecordedCondition& condition : known) {
    if (affine(column_of(condition)).squares <= least) {
      return {};
    }
  }
  Eigen::VectorXd column = column_of(*best);
  const Along found = affine(column);
  FollowedColumn result;
  result.change = 2.0 * found.change.col(1);
  result.cost = Eigen::VectorXd::Zero(result.change.size());
  for (Eigen::Index r = 0; r < count; ++r) {
    const Eigen::VectorXd own = column(r) * found.change.col(1);
    result.cost += own.cwiseAbs2().cwiseProduct(quadratics[static_cast<std::size_t>(r)].hessian.diagonal());
  }
  const Stream stream = Stream(0).child("permutations");
  std::size_t as_little = 1;
  for (std::size_t p = 0; p < permutations; ++p) {
    for (Eigen::Index k = count; k > 1; --k) {
      const auto other = stream.below(static_cast<std::uint64_t>(k), p, static_cast<std::uint32_t>(k));
      std::swap(column(k - 1), column(static_cast<Eigen::Index>(other)));
    }
    as_little += affine(column).squares <= found.squares ? 1 : 0;
  }
  result.name = best->name;
  const auto [low, high] = std::ranges::minmax(best->value);
  result.low = low;
  result.high = high;
  result.together = along(quadratics, Eigen::MatrixXd::Ones(count, 1)).squares;
  result.along = found.squares;
  result.chance = std::min(1.0, static_cast<double>(columns * as_little) / static_cast<double>(permutations + 1));
  return result.chance <= surely ? std::optional(result) : std::nullopt;
}

}  // namespace hysteron

#include "diagnose/residual/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/layout.hpp"

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

double peak_of(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) {
    result = std::max(result, std::fabs(value));
  }
  return result;
}

// Values on a scale on which the largest difference that does not count is one.
std::vector<double> scaled(const Condition& condition) {
  std::vector<double> result = condition.value;
  const double largest = std::max(peak_of(condition.value), 1e-300);
  for (double& value : result) {
    value = condition.absolute > 0.0 ? value / condition.absolute
                                     : (condition.ratio ? std::log(value) : value / largest) / repeated;
  }
  return result;
}

bool varied(const Condition& condition) {
  const std::vector<double> values = scaled(condition);
  const auto [low, high] = std::ranges::minmax(values);
  return high - low > 1.0;
}

// From -1 to 1.
Eigen::VectorXd column_of(const Condition& condition) {
  const std::vector<double> values = scaled(condition);
  const auto [low, high] = std::ranges::minmax(values);
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t r = 0; r < values.size(); ++r) {
    result(static_cast<Eigen::Index>(r)) = 2.0 * (values[r] - low) / std::max(high - low, 1e-300) - 1.0;
  }
  return result;
}

}  // namespace

std::vector<Condition> conditions_of(const std::vector<Recording>& recordings) {
  std::vector<Condition> all;
  const auto add = [&](const char* name, auto value) {
    Condition condition{name, {}, false, 0.0};
    for (const Recording& recording : recordings) {
      condition.value.push_back(value(recording));
    }
    condition.ratio = std::ranges::all_of(condition.value, [](double one) { return one > 0.0; });
    if (varied(condition)) {
      all.push_back(std::move(condition));
    }
  };
  const auto half_stroke = [](const Recording& of) {
    const auto [low, high] = std::ranges::minmax(of.displacement);
    return 0.5 * (high - low);
  };
  add("stroke", half_stroke);
  add("frequency", dominant_frequency);
  add("peak speed", [](const Recording& of) { return peak_of(of.velocity); });
  add("form of the motion",
      [&](const Recording& of) { return spread_of(of.displacement) / std::max(half_stroke(of), 1e-300); });
  // Each recording sweeps its stroke: a shift of its middle by less than half of that shows nothing that the others do
  // not show.
  double largest = 0.0;
  for (const Recording& recording : recordings) {
    largest = std::max(largest, half_stroke(recording));
  }
  Condition middle{"middle of the stroke", {}, false, 0.5};
  for (const Recording& recording : recordings) {
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    middle.value.push_back(0.5 * (low + high) / std::max(largest, 1e-300));
  }
  if (varied(middle)) {
    all.push_back(std::move(middle));
  }
  add("drive", [](const Recording& of) { return mean_of(of.drive); });
  add("spread of the drive", [](const Recording& of) { return spread_of(of.drive); });
  if (std::ranges::none_of(recordings, [](const Recording& of) { return of.temperature.empty(); })) {
    add("temperature", [](const Recording& of) { return mean_of(of.temperature); });
  }
  return all;
}

const Condition* parted_by(const std::vector<Condition>& conditions, const Group& a, const Group& b) {
  for (const Condition& condition : conditions) {
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

std::vector<Group> cells_of(const std::vector<Condition>& conditions, std::size_t recordings) {
  std::vector<std::vector<double>> values;
  for (const Condition& condition : conditions) {
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

Followed followed(const std::vector<Quadratic>& quadratics, const std::vector<Condition>& conditions) {
  const auto count = static_cast<Eigen::Index>(quadratics.size());
  std::vector<Condition> all = conditions;
  Condition order{"order of the recordings", std::vector<double>(quadratics.size()), false, 0.0};
  std::iota(order.value.begin(), order.value.end(), 0.0);
  all.push_back(std::move(order));
  Eigen::MatrixXd plane = Eigen::MatrixXd::Ones(count, 1);
  Followed best{"", std::numeric_limits<double>::infinity()};
  const auto keep = [&](const std::string& name, const Eigen::MatrixXd& regressors) {
    // As many functions as recordings follow anything.
    const double squares = regressors.cols() < count - 1 ? squares_along(quadratics, regressors) : best.squares;
    if (squares < best.squares) {
      best = {name, squares};
    }
  };
  for (const Condition& condition : all) {
    const Eigen::VectorXd column = column_of(condition);
    Eigen::MatrixXd regressors(count, 3);
    regressors << Eigen::VectorXd::Ones(count), column, column.cwiseProduct(column);
    keep(condition.name, regressors);
    // Levels that repeat allow for any function.
    const std::vector<Group> levels = cells_of({condition}, quadratics.size());
    if (2 * levels.size() <= quadratics.size()) {
      Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(levels.size()));
      for (std::size_t level = 0; level < levels.size(); ++level) {
        for (const std::size_t r : levels[level]) {
          steps(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(level)) = 1.0;
        }
      }
      keep(condition.name, steps);
    }
    if (condition.name == "drive" || condition.name == "stroke" || condition.name == "frequency") {
      plane.conservativeResize(Eigen::NoChange, plane.cols() + 1);
      plane.col(plane.cols() - 1) = column;
    }
  }
  keep("drive, stroke and frequency", plane);
  return best;
}

}  // namespace hysteron

#include "diagnose/search/score.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "diagnose/search/counting.hpp"
#include "diagnose/search/tangent.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// Directions of the signatures that are nearly others.
constexpr double least_direction = 0.02;
// The first order is not trusted further than this factor on a simulated size.
constexpr double most_rescaled = 4.0;

// Weighted residuals of all recordings, a column for each point; columns of points that ran away are zero.
Eigen::MatrixXd residuals_of(const Objective& objective, const std::vector<double>& points, std::size_t dimension) {
  const std::size_t count = points.size() / dimension;
  Eigen::MatrixXd result(static_cast<Eigen::Index>(objective.samples()), static_cast<Eigen::Index>(count));
  std::vector<bool> ran_away(count, false);
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < objective.targets().size(); ++r) {
    const std::size_t size = objective.targets()[r].force.size();
    Request request;
    request.points = points;
    request.window = Window{r, 0, size};
    const Response response = objective.evaluate(request);
    for (std::size_t k = 0; k < count; ++k) {
      ran_away[k] = ran_away[k] || response.cost[k] >= diverged_cost;
      result.col(static_cast<Eigen::Index>(k)).segment(row, static_cast<Eigen::Index>(size)) =
          Eigen::Map<const Eigen::VectorXd>(response.residual.data() + k * size, static_cast<Eigen::Index>(size));
    }
    row += static_cast<Eigen::Index>(size);
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (ran_away[k]) {
      result.col(static_cast<Eigen::Index>(k)).setZero();
    }
  }
  return result;
}

// What the span of the columns takes off the vector, directions that are hardly there left out.
double taken_off(const Eigen::MatrixXd& columns, const Eigen::VectorXd& left) {
  Eigen::MatrixXd unit = columns;
  for (Eigen::Index k = 0; k < unit.cols(); ++k) {
    const double norm = unit.col(k).norm();
    unit.col(k) *= norm > 0.0 ? 1.0 / norm : 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> among(unit.transpose() * unit);
  const Eigen::VectorXd along = among.eigenvectors().transpose() * (unit.transpose() * left);
  const double largest = among.eigenvalues().maxCoeff();
  double gain = 0.0;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    if (among.eigenvalues()[k] > least_direction * largest && largest > 0.0) {
      gain += along[k] * along[k] / among.eigenvalues()[k];
    }
  }
  return gain;
}

// An extension with all its starts, before it is looked at.
Scored unseen(const Workbench& bench, const Fit& before, const Extension& extension, const Fit* also,
              std::size_t most_starts) {
  Scored result{extension, 0.0, bench.starts(with(before.what, extension), before, also)};
  if (most_starts > 0 && result.starts.points.size() > most_starts) {
    result.starts.points.resize(most_starts);
  }
  return result;
}

ByteWriter key_of(const Fit& before, const Scored& scored) {
  ByteWriter key;
  key.text("look");
  add_fit(key, before);
  add_layout(key, *scored.starts.layout);
  key.whole(scored.starts.points.size());
  for (const std::vector<double>& point : scored.starts.points) {
    key.numbers(point);
  }
  key.numbers(scored.starts.neutral);
  return key;
}

std::string bytes_of(const Scored& scored) {
  ByteWriter bytes;
  bytes.number(scored.gain);
  for (const std::vector<double>& point : scored.starts.points) {
    bytes.numbers(point);
  }
  return bytes.bytes();
}

void take(Scored& scored, const std::string& bytes) {
  ByteReader read(bytes);
  scored.gain = read.number();
  for (std::vector<double>& point : scored.starts.points) {
    point = read.numbers();
  }
}

Scored look(const Workbench& bench, Scored result, const Tangent& tangent) {
  const std::size_t d = result.starts.layout->dimension();
  const Objective objective(*result.starts.layout, bench.split().fit, bench.options());
  std::vector<double> points;
  for (const std::vector<double>& start : result.starts.points) {
    points.insert(points.end(), start.begin(), start.end());
  }
  Eigen::MatrixXd signatures = residuals_of(objective, points, d);
  std::vector<double> alone(result.starts.points.size(), 0.0);
  for (Eigen::Index k = 0; k < signatures.cols(); ++k) {
    if (signatures.col(k).squaredNorm() > 0.0) {
      signatures.col(k) -= tangent.residual;
    }
  }
  signatures -= tangent.basis * (tangent.basis.transpose() * signatures);
  for (Eigen::Index k = 0; k < signatures.cols(); ++k) {
    // The residual is simulated - measured: a change against it takes some off.
    const double along = -signatures.col(k).dot(tangent.left);
    const double square = signatures.col(k).squaredNorm();
    if (along <= 0.0 || square <= 0.0) {
      continue;
    }
    alone[static_cast<std::size_t>(k)] = along * along / square;
    // The size that the first order asks for.
    std::vector<double>& point = result.starts.points[static_cast<std::size_t>(k)];
    const double factor = std::clamp(along / square, 1.0 / most_rescaled, most_rescaled);
    for (const std::size_t c : result.starts.sizes) {
      const double neutral = result.starts.neutral[c];
      point[c] = std::clamp(neutral + factor * (point[c] - neutral), 0.0, 1.0);
    }
  }
  std::vector<std::size_t> order(alone.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return alone[a] > alone[b]; });
  std::vector<std::vector<double>> sorted;
  sorted.reserve(order.size());
  for (const std::size_t k : order) {
    sorted.push_back(std::move(result.starts.points[k]));
  }
  result.starts.points = std::move(sorted);
  result.gain = taken_off(signatures, tangent.left);
  return result;
}

}  // namespace

std::vector<Scored> scored(const Workbench& bench, const Fit& before, const std::vector<Extension>& extensions,
                           const Fit* also, std::size_t most_starts, const std::function<void(double share)>& done) {
  std::vector<Scored> result;
  std::vector<ByteWriter> keys;
  for (const Extension& extension : extensions) {
    result.push_back(unseen(bench, before, extension, also, most_starts));
    keys.push_back(key_of(before, result.back()));
  }
  std::optional<Tangent> tangent;
  if (!std::ranges::all_of(keys, [&](const ByteWriter& key) { return bench.has_piece(key); })) {
    tangent = tangent_of(bench, before);
  }
  const Workbench each = bench.shared_by(extensions.size());
  Counting counting(extensions.size(), done);
  parallel_for(extensions.size(), bench.options().threads, [&](std::size_t k) {
    take(result[k], bench.piece(keys[k], [&] { return bytes_of(look(each, result[k], *tangent)); }));
    counting.add();
  });
  std::ranges::stable_sort(result, [](const Scored& a, const Scored& b) { return a.gain > b.gain; });
  return result;
}

}  // namespace hysteron

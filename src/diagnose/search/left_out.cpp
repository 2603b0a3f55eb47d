#include "diagnose/search/left_out.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/signal/noise.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr std::size_t fewest_recordings = 4;  // of fewer, parts of each are left out
constexpr std::size_t parts_of_few = 4;       // of each of few recordings
// Of the diagonal: what the other recordings do not tell stays where it is.
constexpr double ridge = 1e-6;
// The step is to first order: no coordinate goes further than this part of its box.
constexpr double most_step = 0.2;

// Samples [begin, end) of a recording that are left out together.
struct Stretch {
  std::size_t recording;
  std::size_t begin;
  std::size_t end;
};

std::vector<Stretch> parts_of(const std::vector<Linearised>& all) {
  std::vector<Stretch> result;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t size = all[r].residual.size();
    const std::size_t count = all.size() < fewest_recordings ? parts_of_few : 1;
    for (std::size_t k = 0; k < count; ++k) {
      result.push_back({r, k * size / count, (k + 1) * size / count});
    }
  }
  return result;
}

std::string bytes_of(const LeftOut& result) {
  ByteWriter bytes;
  bytes.whole(result.predicted.size());
  for (const std::vector<double>& blocks : result.predicted) {
    bytes.numbers(blocks);
  }
  bytes.number(result.squares);
  return bytes.bytes();
}

LeftOut left_out_of(const std::string& bytes) {
  ByteReader read(bytes);
  LeftOut result;
  result.predicted.resize(read.whole());
  for (std::vector<double>& blocks : result.predicted) {
    blocks = read.numbers();
  }
  result.squares = read.number();
  return result;
}

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

LeftOut worked_out(const Workbench& bench, const Fit& fit) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  const std::vector<Linearised> all = objective.linearised(fit.point);
  const std::size_t d = fit.dimension();
  const std::vector<Eigen::Index> free = free_coordinates(fit.point);
  const std::vector<Stretch> parts = parts_of(all);
  const auto m = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(m);
  std::vector<Eigen::MatrixXd> jacobians;
  std::vector<Eigen::VectorXd> residuals;
  for (const Stretch& part : parts) {
    const auto rows = static_cast<Eigen::Index>(part.end - part.begin);
    const Rows whole(all[part.recording].jacobian.data() + part.begin * d, rows, static_cast<Eigen::Index>(d));
    jacobians.emplace_back(whole(Eigen::all, free));
    residuals.emplace_back(Eigen::Map<const Eigen::VectorXd>(all[part.recording].residual.data() + part.begin, rows));
    hessian.selfadjointView<Eigen::Lower>().rankUpdate(jacobians.back().transpose());
    gradient += jacobians.back().transpose() * residuals.back();
  }
  const auto stepped = [&](const Eigen::MatrixXd& matrix, const Eigen::VectorXd& slope) -> Eigen::VectorXd {
    Eigen::MatrixXd damped = matrix;
    damped.diagonal() += (ridge * hessian.diagonal()).cwiseMax(1e-300);
    Eigen::VectorXd step = -damped.selfadjointView<Eigen::Lower>().ldlt().solve(slope);
    const double longest = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
    if (!std::isfinite(longest)) {
      return Eigen::VectorXd::Zero(m);
    }
    return step * std::min(1.0, most_step / std::max(longest, 1e-300));
  };
  LeftOut result;
  result.predicted.resize(all.size());
  const Eigen::VectorXd refined = stepped(hessian, gradient);
  double before = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    before += residuals[k].squaredNorm();
    result.squares += (residuals[k] + jacobians[k] * refined).squaredNorm();
  }
  result.squares = std::isfinite(result.squares) ? std::min(result.squares, before) : before;
  std::vector<std::vector<double>> predicted(all.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Eigen::VectorXd residual = residuals[k];
    if (m > 0 && parts.size() > 1) {
      Eigen::MatrixXd others = hessian;
      others.selfadjointView<Eigen::Lower>().rankUpdate(jacobians[k].transpose(), -1.0);
      residual += jacobians[k] * stepped(others, gradient - jacobians[k].transpose() * residual);
    }
    predicted[parts[k].recording].insert(predicted[parts[k].recording].end(), residual.begin(), residual.end());
  }
  for (std::size_t r = 0; r < all.size(); ++r) {
    const Target& target = objective.targets()[r];
    const std::size_t from = target.run_in;
    const std::size_t size = predicted[r].size();
    const double unit = 1.0 / (target.weight * target.normaliser * target.normaliser);
    const std::size_t count = block_count(target.motion.time.back() - target.motion.time.front(), target.frequency);
    for (std::size_t b = 0; b < count; ++b) {
      const std::size_t begin = from + b * (size - from) / count;
      const std::size_t end = from + (b + 1) * (size - from) / count;
      double sum = 0.0;
      for (std::size_t n = begin; n < end; ++n) {
        sum += squared(predicted[r][n]);
      }
      if (end > begin) {
        result.predicted[r].push_back(std::isfinite(sum) ? sum * unit / static_cast<double>(end - begin)
                                                         : std::numeric_limits<double>::infinity());
      }
    }
  }
  return result;
}

}  // namespace

LeftOut left_out(const Workbench& bench, const Fit& fit) {
  ByteWriter key;
  key.text("left out");
  add_fit(key, fit);
  return left_out_of(bench.piece(key, [&] { return bytes_of(worked_out(bench, fit)); }));
}

std::vector<LeftOut> left_out(const Workbench& bench, const std::vector<const Fit*>& fits) {
  std::vector<LeftOut> result(fits.size());
  const Workbench single = bench.single_threaded();
  parallel_for(fits.size(), bench.options().threads, [&](std::size_t k) { result[k] = left_out(single, *fits[k]); });
  return result;
}

LeftOut left_out_beside(const Workbench& bench, const Fit& fit, const Extension& part, LeftOut plain) {
  if (const std::optional<Fit> neutral = bench.beside(fit, part)) {
    LeftOut other = left_out(bench, *neutral);
    return other.squares < plain.squares ? other : plain;
  }
  return plain;
}

std::vector<double> noise_of(const Workbench& bench) {
  std::vector<double> result;
  for (std::size_t r = 0; r < bench.split().fit.size(); ++r) {
    result.push_back(squared(bench.noise()[r].sigma / normaliser(bench.split().fit[r], bench.options().normalisation)));
  }
  return result;
}

}  // namespace hysteron

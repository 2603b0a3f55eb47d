#include "diagnose/search/left_out.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/counting.hpp"
#include "diagnose/signal/noise.hpp"
#include "fit/free_coordinates.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr std::size_t parts_of_few = 4;  // of each of few recordings
// Of the diagonal: what the other recordings do not tell stays where it is.
constexpr double ridge = 1e-6;
// The step is to first order: no coordinate goes further than this part of its box.
constexpr double most_step = 0.2;

// Samples [begin, end) of a recording; those of one group are left out together.
struct Stretch {
  std::size_t recording;
  std::size_t begin;
  std::size_t end;
  std::size_t group;
};

std::vector<Stretch> parts_of(const std::vector<Linearised>& all, const std::vector<std::size_t>& motions) {
  std::vector<Stretch> result;
  const bool by_motion = count_of(motions) >= fewest_clusters;
  const std::size_t count = all.size() < fewest_clusters ? parts_of_few : 1;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::size_t size = all[r].residual.size();
    for (std::size_t k = 0; k < count; ++k) {
      result.push_back({r, k * size / count, (k + 1) * size / count, by_motion ? motions[r] : result.size()});
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
  for (const std::vector<double>& residual : result.residuals) {
    bytes.numbers(residual);
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
  result.residuals.resize(result.predicted.size());
  for (std::vector<double>& residual : result.residuals) {
    residual = read.numbers();
  }
  result.squares = read.number();
  return result;
}

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

// Mean squares of the blocks of a recording, over its normaliser^2.
std::vector<double> block_squares(const std::vector<double>& residual, std::size_t count) {
  std::vector<double> result;
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t begin = b * residual.size() / count;
    const std::size_t end = (b + 1) * residual.size() / count;
    double sum = 0.0;
    for (std::size_t n = begin; n < end; ++n) {
      sum += squared(residual[n]);
    }
    if (end > begin) {
      result.push_back(std::isfinite(sum) ? sum / static_cast<double>(end - begin)
                                          : std::numeric_limits<double>::infinity());
    }
  }
  return result;
}

// Residuals of the parts that are left out, over the root of their weight, and their slopes in the free coordinates.
struct Tangents {
  std::vector<Stretch> parts;
  std::vector<Eigen::MatrixXd> slopes;  // of each part
  std::vector<Eigen::VectorXd> residuals;

  [[nodiscard]] Eigen::Index free() const { return slopes.empty() ? 0 : slopes.front().cols(); }
};

Tangents tangents_of(const std::vector<Linearised>& all, const Fit& fit, const std::vector<std::size_t>& motions) {
  const std::size_t d = fit.dimension();
  const std::vector<Eigen::Index> free = free_coordinates(fit.point);
  Tangents result{parts_of(all, motions), {}, {}};
  for (const Stretch& part : result.parts) {
    const auto rows = static_cast<Eigen::Index>(part.end - part.begin);
    const Rows whole(all[part.recording].jacobian.data() + part.begin * d, rows, static_cast<Eigen::Index>(d));
    result.slopes.emplace_back(whole(Eigen::all, free));
    result.residuals.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(all[part.recording].residual.data() + part.begin, rows));
  }
  return result;
}

// H and g of the equations above.
struct Normal {
  Eigen::MatrixXd hessian;  // lower triangle
  Eigen::VectorXd gradient;

  explicit Normal(Eigen::Index size)
      : hessian(Eigen::MatrixXd::Zero(size, size)), gradient(Eigen::VectorXd::Zero(size)) {}
  void add(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& residuals) {
    hessian.selfadjointView<Eigen::Lower>().rankUpdate(slopes.transpose());
    gradient += slopes.transpose() * residuals;
  }
};

// The step to the minimum; `whole` are the equations of all recordings.
Eigen::VectorXd step_of(const Eigen::MatrixXd& hessian, const Eigen::VectorXd& gradient, const Normal& whole) {
  Eigen::MatrixXd damped = hessian;
  damped.diagonal() += (ridge * whole.hessian.diagonal()).cwiseMax(1e-300);
  Eigen::VectorXd step = -damped.selfadjointView<Eigen::Lower>().ldlt().solve(gradient);
  const double longest = step.size() > 0 ? step.cwiseAbs().maxCoeff() : 0.0;
  if (!std::isfinite(longest)) {
    return Eigen::VectorXd::Zero(gradient.size());
  }
  return step * std::min(1.0, most_step / std::max(longest, 1e-300));
}

// Of each group of parts, the step of the parameters that the other groups alone would take.
std::map<std::size_t, Eigen::VectorXd> steps_without(const Tangents& tangents, const Normal& whole) {
  std::map<std::size_t, Normal> own;
  for (std::size_t k = 0; k < tangents.parts.size(); ++k) {
    own.try_emplace(tangents.parts[k].group, tangents.free())
        .first->second.add(tangents.slopes[k], tangents.residuals[k]);
  }
  std::map<std::size_t, Eigen::VectorXd> result;
  for (const auto& [group, normal] : own) {
    result[group] = tangents.free() > 0 && own.size() > 1
                        ? step_of(whole.hessian - normal.hessian, whole.gradient - normal.gradient, whole)
                        : Eigen::VectorXd::Zero(tangents.free()).eval();
  }
  return result;
}

LeftOut worked_out(const Workbench& bench, const Fit& fit) {
  const Objective objective(*fit.layout, bench.split().fit, bench.options());
  const Tangents tangents = tangents_of(objective.linearised(fit.point), fit, bench.motions());
  Normal whole(tangents.free());
  for (std::size_t k = 0; k < tangents.parts.size(); ++k) {
    whole.add(tangents.slopes[k], tangents.residuals[k]);
  }
  LeftOut result;
  const Eigen::VectorXd refined = step_of(whole.hessian, whole.gradient, whole);
  std::map<std::size_t, Eigen::VectorXd> steps = steps_without(tangents, whole);
  double before = 0.0;
  std::vector<std::vector<double>> predicted(objective.targets().size());
  for (std::size_t k = 0; k < tangents.parts.size(); ++k) {
    const Stretch& part = tangents.parts[k];
    before += tangents.residuals[k].squaredNorm();
    result.squares += (tangents.residuals[k] + tangents.slopes[k] * refined).squaredNorm();
    const Eigen::VectorXd residual = tangents.residuals[k] + tangents.slopes[k] * steps[part.group];
    predicted[part.recording].insert(predicted[part.recording].end(), residual.begin(), residual.end());
  }
  result.squares = std::isfinite(result.squares) ? std::min(result.squares, before) : before;
  for (std::size_t r = 0; r < predicted.size(); ++r) {
    const Target& target = objective.targets()[r];
    const double unit = 1.0 / (std::sqrt(target.weight) * target.normaliser);
    std::vector<double>& residual = result.residuals.emplace_back(
        predicted[r].begin() + static_cast<std::ptrdiff_t>(target.run_in), predicted[r].end());
    std::ranges::transform(residual, residual.begin(), [unit](double value) { return unit * value; });
    result.predicted.push_back(
        block_squares(residual, block_count(target.motion.time.back() - target.motion.time.front(), target.frequency)));
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

std::vector<LeftOut> left_out(const Workbench& bench, const std::vector<const Fit*>& fits,
                              const std::function<void(double share)>& done) {
  std::vector<LeftOut> result(fits.size());
  const Workbench each = bench.shared_by(fits.size());
  Counting counting(fits.size(), done);
  parallel_for(fits.size(), bench.options().threads, [&](std::size_t k) {
    result[k] = left_out(each, *fits[k]);
    counting.add();
  });
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

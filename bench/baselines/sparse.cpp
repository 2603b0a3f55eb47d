#include "baselines/sparse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/drive.hpp"
#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/tangent.hpp"
#include "diagnose/signal/features.hpp"

namespace hysteron::baselines {
namespace {

// Thresholds, as parts of the norm of what is to be explained.
constexpr std::array<double, 8> thresholds = {0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.8};
// Of the largest speed: below it the friction of a seal drops.
constexpr double hump = 0.1;
// Part of its norm that a term keeps beside the fit's parameters, or beside other terms, below which these imitate it.
constexpr double imitated = 0.01;
// A drive that changes less over the campaign is one level.
constexpr double least_change = 0.02;

double largest(const std::vector<double>& values, double so_far) {
  for (const double value : values) {
    so_far = std::max(so_far, std::fabs(value));
  }
  return so_far;
}

// Rate of change by central differences.
double slope(const std::vector<double>& time, const std::vector<double>& values, std::size_t n) {
  const std::size_t before = n == 0 ? 0 : n - 1;
  const std::size_t after = std::min(n + 1, values.size() - 1);
  return (values[after] - values[before]) / (time[after] - time[before]);
}

double sign(double value) { return value > 0.0 ? 1.0 : (value < 0.0 ? -1.0 : 0.0); }

// What channels are divided by, over the whole campaign.
struct Sizes {
  double stroke = 1e-300;
  double speed = 1e-300;
  double acceleration = 1e-300;
  double drive = 1e-300;
  double duration = 1e-300;
  bool levels = false;   // the drive differs between or within recordings
  bool varying = false;  // within one
};

Sizes sizes_of(const std::vector<Recording>& recordings) {
  Sizes result;
  double low = 1e300;
  double high = -1e300;
  for (const Recording& recording : recordings) {
    result.stroke = std::max(result.stroke, features_of(recording).stroke);
    result.speed = largest(recording.velocity, result.speed);
    result.drive = largest(recording.drive, result.drive);
    result.duration = std::max(result.duration, recording.time.back() - recording.time.front());
    for (std::size_t n = 0; n < recording.size(); ++n) {
      result.acceleration = std::max(result.acceleration, std::fabs(slope(recording.time, recording.velocity, n)));
    }
    for (const double drive : recording.drive) {
      low = std::min(low, drive);
      high = std::max(high, drive);
    }
    result.varying = result.varying || (!recording.drive.empty() && drive_varies(recording));
  }
  result.levels = high - low > least_change * result.drive;
  return result;
}

// The channels of one sample, each over its size.
struct Sample {
  double x, v, a, t;
  double force;       // of the fit, over the largest norm
  double force_rate;  // likewise, over speed over stroke
  double work;        // of that force since the start
  double drive;       // 0 where it is one level
  double drive_rate;  // 0 where it is constant
};

using Value = double (*)(const Sample&);
struct Row {
  Term term;
  Value value;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {{"1", {"offset-force"}}, [](const Sample&) { return 1.0; }},
      {{"x", {"linear-stiffness"}}, [](const Sample& s) { return s.x; }},
      {{"x^2", {"gas-spring"}}, [](const Sample& s) { return s.x * s.x; }},
      {{"x^3", {"cubic-stiffness"}}, [](const Sample& s) { return s.x * s.x * s.x; }},
      {{"x^9", {"end-stop"}}, [](const Sample& s) { return std::pow(s.x, 9.0); }},
      {{"v", {"viscous-damping"}}, [](const Sample& s) { return s.v; }},
      {{"|v| v", {"quadratic-damping"}}, [](const Sample& s) { return std::fabs(s.v) * s.v; }},
      {{"sign(v) |v|^(1/2)", {"shear-thinning"}},
       [](const Sample& s) { return sign(s.v) * std::sqrt(std::fabs(s.v)); }},
      {{"sign(v)", {"coulomb-friction"}}, [](const Sample& s) { return sign(s.v); }},
      {{"sign(v) exp(-(v / v_s)^2)", {"seal-friction"}},
       [](const Sample& s) { return sign(s.v) * std::exp(-s.v * s.v / (hump * hump)); }},
      {{"a", {"inertia"}}, [](const Sample& s) { return s.a; }},
      {{"|v|", {"asymmetry"}}, [](const Sample& s) { return std::fabs(s.v); }},
      {{"|F|", {"asymmetry"}}, [](const Sample& s) { return std::fabs(s.force); }},
      {{"sign(v) |x|", {"pinching"}}, [](const Sample& s) { return sign(s.v) * std::fabs(s.x); }},
      {{"F x^2", {"pinching"}}, [](const Sample& s) { return s.force * s.x * s.x; }},
      {{"F'", {"sensor-delay"}}, [](const Sample& s) { return s.force_rate; }},
      {{"t", {"force-drift"}}, [](const Sample& s) { return s.t; }},
      {{"F t", {"self-heating", "degradation"}}, [](const Sample& s) { return s.force * s.t; }},
      {{"F W", {"self-heating", "degradation"}}, [](const Sample& s) { return s.force * s.work; }},
      {{"i sign(v)", {}}, [](const Sample& s) { return s.drive * sign(s.v); }},
      {{"i v", {}}, [](const Sample& s) { return s.drive * s.v; }},
      {{"i x", {}}, [](const Sample& s) { return s.drive * s.x; }},
      {{"i^2 sign(v)", {"magnetic-saturation"}}, [](const Sample& s) { return s.drive * s.drive * sign(s.v); }},
      {{"i' sign(v)", {"coil-lag"}}, [](const Sample& s) { return s.drive_rate * sign(s.v); }},
  };
  return all;
}

// Least squares by as many columns of norm one as are told apart; the others get nothing.
Eigen::VectorXd basic_solution(const Eigen::MatrixXd& unit, const Eigen::VectorXd& target) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(unit);
  qr.setThreshold(imitated);
  const Eigen::Index rank = qr.rank();
  const Eigen::VectorXd turned = qr.householderQ().adjoint() * target;
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(unit.cols());
  sizes.head(rank) = qr.matrixQR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(turned.head(rank));
  return qr.colsPermutation() * sizes;
}

}  // namespace

const std::vector<Term>& library() {
  static const std::vector<Term> terms = [] {
    std::vector<Term> result;
    for (const Row& row : rows()) {
      result.push_back(row.term);
    }
    return result;
  }();
  return terms;
}

Regression regression_of(const Workbench& bench, const Fit& fit, const Residuals& residuals) {
  const std::vector<Recording>& recordings = bench.split().fit;
  const Sizes sizes = sizes_of(recordings);
  const Tangent tangent = tangent_of(bench, fit);
  Regression result{Eigen::MatrixXd::Zero(tangent.left.size(), static_cast<Eigen::Index>(rows().size())), -tangent.left,
                    0};
  const double largest_norm = std::ranges::max(residuals.norms);
  Eigen::Index line = 0;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Recording& recording = recordings[r];
    const Residual& residual = residuals.of[r];
    const std::size_t counted = recording.size() - residual.from;
    // A term is a force, the same function of the motion in all recordings; the cost divides each by its own norm.
    const double weight =
        largest_norm / residuals.norms[r] / std::sqrt(static_cast<double>(counted * recordings.size()));
    result.samples += counted;
    const double centre = features_of(recording).centre;
    std::vector<double> force(recording.size());
    for (std::size_t n = 0; n < force.size(); ++n) {
      force[n] = (recording.force[n] + residual.force[n]) / largest_norm;
    }
    double work = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n, ++line) {
      if (n > 0) {
        work += std::fabs(force[n] * (recording.displacement[n] - recording.displacement[n - 1])) / sizes.stroke;
      }
      if (n < residual.from) {
        continue;
      }
      Sample sample{};
      sample.x = (recording.displacement[n] - centre) / sizes.stroke;
      sample.v = recording.velocity[n] / sizes.speed;
      sample.a = slope(recording.time, recording.velocity, n) / sizes.acceleration;
      sample.t = (recording.time[n] - recording.time.front()) / sizes.duration;
      sample.force = force[n];
      sample.force_rate = slope(recording.time, force, n) * sizes.stroke / sizes.speed;
      sample.work = work;
      sample.drive = sizes.levels && !recording.drive.empty() ? recording.drive[n] / sizes.drive : 0.0;
      sample.drive_rate = sizes.varying && !recording.drive.empty()
                              ? slope(recording.time, recording.drive, n) * sizes.duration / sizes.drive
                              : 0.0;
      for (std::size_t c = 0; c < rows().size(); ++c) {
        result.terms(line, static_cast<Eigen::Index>(c)) = weight * rows()[c].value(sample);
      }
    }
  }
  const Eigen::RowVectorXd before = result.terms.colwise().norm();
  result.terms -= tangent.basis * (tangent.basis.transpose() * result.terms);
  for (Eigen::Index c = 0; c < result.terms.cols(); ++c) {
    if (result.terms.col(c).norm() <= imitated * before[c]) {
      result.terms.col(c).setZero();
    }
  }
  return result;
}

Eigen::VectorXd thresholded(const Eigen::MatrixXd& terms, const Eigen::VectorXd& target, double threshold) {
  std::vector<Eigen::Index> stay;
  const Eigen::VectorXd norms = terms.colwise().norm().transpose();
  for (Eigen::Index c = 0; c < terms.cols(); ++c) {
    if (norms[c] > 0.0) {
      stay.push_back(c);
    }
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(terms.cols());
  while (!stay.empty()) {
    const Eigen::MatrixXd unit = terms(Eigen::all, stay) * norms(stay).cwiseInverse().asDiagonal();
    const Eigen::VectorXd sizes = basic_solution(unit, target);
    std::vector<Eigen::Index> still;
    for (Eigen::Index k = 0; k < sizes.size(); ++k) {
      if (std::fabs(sizes[k]) >= threshold) {
        still.push_back(stay[static_cast<std::size_t>(k)]);
      }
    }
    if (still.size() == stay.size()) {
      result(stay) = sizes.cwiseQuotient(norms(stay));
      return result;
    }
    stay = std::move(still);
  }
  return result;
}

std::vector<std::size_t> chosen_terms(const Regression& regression, double values) {
  const double square = regression.target.squaredNorm();
  std::vector<std::size_t> best;
  double best_gain = 0.0;
  for (const double threshold : thresholds) {
    const Eigen::VectorXd sizes =
        thresholded(regression.terms, regression.target, threshold * regression.target.norm());
    std::vector<std::size_t> stay;
    for (Eigen::Index c = 0; c < sizes.size(); ++c) {
      if (sizes[c] != 0.0) {
        stay.push_back(static_cast<std::size_t>(c));
      }
    }
    const double after = (regression.target - regression.terms * sizes).squaredNorm();
    const double gain =
        stay.empty() ? 0.0 : evidence(square, std::max(after, 1e-300), static_cast<double>(stay.size()), values);
    if (gain > best_gain) {
      best_gain = gain;
      best = std::move(stay);
    }
  }
  return best;
}

}  // namespace hysteron::baselines

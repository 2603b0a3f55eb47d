// What goes on from one recording to the next: the size of the force over the work that the recordings before did,
// where their starts are told. Each recording has one size, so the number of recordings is that of the observations:
//   y = -(size of the missing force over the simulated one),   y = m s + X b,   m by least squares
// s is the work before, X what a law that is wrong for fast, wide or strongly driven tests makes of their sizes.
// Placebos exchange what X leaves of y between recordings (Freedman and Lane 1983).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/mean.hpp"
#include "core/random.hpp"
#include "diagnose/residual/contrast_parts.hpp"

namespace hysteron::contrast {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// How much larger the measured force is than the simulated one, beside a constant and a spring.
double size_of(const Track& track) {
  Eigen::Matrix3d among = Eigen::Matrix3d::Zero();
  Eigen::Vector3d with = Eigen::Vector3d::Zero();
  for (std::size_t n = track.from; n < track.time.size(); ++n) {
    const Eigen::Vector3d row(track.simulated[n] / track.peak, 1.0, track.x[n] / track.stroke);
    among += track.duration[n] * row * row.transpose();
    with += track.duration[n] * track.missing[n] / track.peak * row;
  }
  return among.ldlt().solve(with)[0];
}

// What the columns of a matrix leave of a vector.
class Without {
 public:
  explicit Without(const Matrix& columns) : columns_(columns), solver_(columns) {}
  [[nodiscard]] Vector of(const Vector& values) const { return values - columns_ * solver_.solve(values); }
  [[nodiscard]] Eigen::Index rank() const { return solver_.rank(); }

 private:
  Matrix columns_;
  Eigen::CompleteOrthogonalDecomposition<Matrix> solver_;
};

Without circumstances(std::span<const Track> tracks) {
  const auto count = static_cast<Eigen::Index>(tracks.size());
  Matrix columns = Matrix::Ones(count, 4);
  for (Eigen::Index r = 0; r < count; ++r) {
    const Track& track = tracks[static_cast<std::size_t>(r)];
    columns(r, 1) = std::log(track.speed);
    columns(r, 2) = std::log(track.stroke);
    columns(r, 3) = track.drive.empty() ? 0.0 : hysteron::mean_of(track.drive);
  }
  return Without(columns);
}

// Order of recordings of a placebo, by Fisher and Yates.
std::vector<std::size_t> exchanged(std::size_t placebo, std::size_t count) {
  static const Stream stream = Stream(1).child("contrast").child("exchange");
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = count; k > 1; --k) {
    const double u = stream.uniform(placebo, static_cast<std::uint32_t>(k));
    std::swap(order[k - 1], order[std::min(k - 1, static_cast<std::size_t>(u * static_cast<double>(k)))]);
  }
  return order;
}

}  // namespace

void add_carried_contrast(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  if (std::ranges::none_of(tracks, [](const Track& track) { return !track.earlier.empty(); })) {
    return;
  }
  const auto count = static_cast<Eigen::Index>(tracks.size());
  const Without without = circumstances(tracks);
  const auto free = static_cast<double>(count - without.rank() - 1);
  if (free < least_degrees) {
    return;
  }
  Vector sizes(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    sizes[r] = -size_of(tracks[static_cast<std::size_t>(r)]);
  }
  if (!sizes.allFinite()) {
    return;
  }
  const Vector left = without.of(sizes);
  Vector work(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    work[r] = left_of(tracks[static_cast<std::size_t>(r)].earlier, 0.0);
  }
  const Vector signature = without.of(work);
  const double all = (work.array() - work.mean()).square().sum();
  if (!(signature.squaredNorm() > least_left * all)) {
    return;
  }
  // Squared correlation.
  const auto share_of = [&](const Vector& response) {
    const double with = signature.dot(response);
    return with * with / (signature.squaredNorm() * std::max(response.squaredNorm(), 1e-300));
  };
  // The slope is the mean of those of the recordings, weighted by their levers.
  std::vector<Part> parts;
  for (Eigen::Index r = 0; r < count; ++r) {
    const double lever = signature[r];
    if (lever != 0.0) {
      const Track& track = tracks[static_cast<std::size_t>(r)];
      parts.push_back({track.recording, lever * lever, left[r] / lever, track.motion});
    }
  }
  std::optional<Contrast> contrast = pooled(ContrastKind::carried_fade, parts, parts);
  if (!contrast) {
    return;
  }
  // That of the regression: X has taken its degrees of freedom.
  const double scatter = (left - contrast->value * signature).squaredNorm() / free;
  contrast->std_error =
      std::max(std::sqrt(scatter / signature.squaredNorm()), least_error * std::fabs(contrast->value));
  contrast->z = contrast->std_error > 0.0 ? normal_of(contrast->value / contrast->std_error, free) : 0.0;
  std::vector<double> of_placebos;
  for (std::size_t p = 0; p < placebos; ++p) {
    const std::vector<std::size_t> order = exchanged(p, tracks.size());
    Vector moved(count);
    for (Eigen::Index r = 0; r < count; ++r) {
      moved[r] = left[static_cast<Eigen::Index>(order[static_cast<std::size_t>(r)])];
    }
    of_placebos.push_back(share_of(without.of(moved)));
  }
  judge(*contrast, share_of(left), of_placebos);
  result.push_back(std::move(*contrast));
}

}  // namespace hysteron::contrast

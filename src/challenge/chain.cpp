#include "challenge/chain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron::challenge {
namespace {

// Butterworth low-pass of order 2 by the bilinear transform, settled at the first value. The same for every channel,
// so that it shifts none against another.
std::vector<double> anti_aliased(const std::vector<double>& signal, double cutoff_over_rate) {
  const double w = std::tan(std::numbers::pi * cutoff_over_rate);
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * w + w * w);
  const double b = w * w * norm;
  const double a1 = 2.0 * (w * w - 1.0) * norm;
  const double a2 = (1.0 - std::numbers::sqrt2 * w + w * w) * norm;
  std::vector<double> out(signal.size());
  double x1 = signal.front(), x2 = x1, y1 = x1, y2 = x1;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const double y = b * (signal[k] + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1;
    x1 = signal[k];
    y2 = y1;
    y1 = y;
    out[k] = y;
  }
  return out;
}

std::vector<double> sampled(const std::vector<double>& signal, std::size_t lead, int decimation) {
  std::vector<double> out;
  for (std::size_t k = lead; k < signal.size(); k += static_cast<std::size_t>(decimation)) out.push_back(signal[k]);
  return out;
}

double quantised(double value, double range, int bits) {
  const double step = 2.5 * range / std::pow(2.0, bits);
  return std::round(value / step) * step;
}

}  // namespace

std::vector<double> clean_force(const Physics& physics, const Track& track, int decimation) {
  std::vector<double> force = track.force;
  for (const PartPointer& part : physics.parts) part->on_force(force, track.rate);
  return sampled(anti_aliased(force, 0.4 / decimation), track.lead, decimation);
}

Measured measure(const Physics& physics, const Track& track, int decimation, const Chain& chain, const Range& range,
                 const Stream& stream) {
  const auto through = [&](const std::vector<double>& signal) {
    return sampled(anti_aliased(signal, 0.4 / decimation), track.lead, decimation);
  };
  Measured result;
  result.clean = clean_force(physics, track, decimation);
  result.x = through(track.x);
  std::vector<double> velocity = track.v;
  for (const PartPointer& part : physics.parts) part->on_velocity(velocity, track.rate);
  result.v = through(velocity);
  result.drive = through(track.drive);
  result.force = result.clean;
  const double white = chain.noise * range.force * std::sqrt(1.0 - chain.coloured_share);
  const double coloured = chain.noise * range.force * std::sqrt(chain.coloured_share);
  double colour = stream.child("colour").normal(0);
  const double fresh = std::sqrt(1.0 - chain.correlation * chain.correlation);
  for (std::size_t k = 0; k < result.clean.size(); ++k) {
    const auto n = static_cast<std::uint64_t>(k);
    result.time.push_back(static_cast<double>(k) * decimation / track.rate);
    colour = chain.correlation * colour + fresh * stream.normal(n, 1);
    double f = result.clean[k] + white * stream.normal(n, 2) + coloured * colour;
    if (stream.uniform(n, 3) < chain.outlier_rate) {
      f += chain.outlier_size * range.force * (1.0 + stream.uniform(n, 4)) * (stream.uniform(n, 5) < 0.5 ? -1.0 : 1.0);
    }
    result.force[k] = quantised(f, range.force, chain.force_bits);
    result.x[k] = quantised(result.x[k] + chain.displacement_noise * range.amplitude * stream.normal(n, 6),
                            range.amplitude, chain.displacement_bits);
    result.v[k] += chain.velocity_noise * range.speed * stream.normal(n, 7);
    result.drive[k] += chain.drive_noise * range.level * stream.normal(n, 8);
  }
  return result;
}

}  // namespace hysteron::challenge

// Recordings made for tests: analytic motions, forces of a known model.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "fit/objective.hpp"

namespace hysteron::testing {

// x = sum of a sin(2 pi f t), softly started from rest within `ramp` seconds (0: starts in motion).
struct Tone {
  double amplitude;
  double frequency;
};

inline Recording motion(const std::string& file, const std::vector<Tone>& tones, double seconds, std::size_t samples,
                        double ramp) {
  Recording recording;
  recording.file = file;
  recording.velocity_measured = true;
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = seconds * static_cast<double>(n) / static_cast<double>(samples - 1);
    const double s = ramp > 0.0 ? std::min(t / ramp, 1.0) : 1.0;
    const double window = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    const double slope = ramp > 0.0 ? 30.0 * s * s * (1.0 - s) * (1.0 - s) / ramp : 0.0;
    double x = 0.0;
    double v = 0.0;
    for (const Tone& tone : tones) {
      const double omega = 2.0 * std::numbers::pi * tone.frequency;
      x += tone.amplitude * std::sin(omega * t);
      v += tone.amplitude * omega * std::cos(omega * t);
    }
    recording.time.push_back(t);
    recording.displacement.push_back(window * x);
    recording.velocity.push_back(window * v + slope * x);
  }
  return recording;
}

inline void set_drive(Recording& recording, double level) {
  recording.drive.assign(recording.size(), level);
  recording.drive_kind = DriveKind::current;
}

// The force of a model with these terms on the recording's motion, with relative noise of the peak force.
inline void set_force(Recording& recording, const Layout& layout, const std::vector<Term>& terms,
                      const ObjectiveOptions& options, double noise = 0.0, const Stream& stream = Stream(1)) {
  recording.force.assign(recording.size(), 1.0);
  recording.force = predict(layout.model(), layout.held(), terms, make_target(recording, options));
  double peak = 0.0;
  for (const double force : recording.force) peak = std::max(peak, std::fabs(force));
  for (std::size_t n = 0; n < recording.size(); ++n) recording.force[n] += noise * peak * stream.normal(n);
}

// The point with these values of parameters in place of its own.
inline std::vector<double> point_with(const Layout& layout, std::vector<double> point,
                                      const std::map<std::string, double>& values) {
  for (std::size_t c = 0; c < point.size(); ++c) {
    const auto found = values.find(layout.names()[layout.coordinates()[c].parameter]);
    if (found != values.end()) point[c] = layout.unit(c, found->second);
  }
  return point;
}

inline std::vector<double> random_points(const Stream& stream, std::size_t count, std::size_t dimension,
                                         double margin = 0.0) {
  std::vector<double> points;
  for (std::size_t k = 0; k < count * dimension; ++k) {
    points.push_back(margin + (1.0 - 2.0 * margin) * stream.uniform(k));
  }
  return points;
}

}  // namespace hysteron::testing

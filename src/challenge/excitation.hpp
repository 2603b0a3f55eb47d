// What a test rig does to the damper: motion and drive command of each recording as functions of time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "challenge/draws.hpp"

namespace hysteron::challenge {

struct Kinematics {
  double x = 0.0;  // m
  double v = 0.0;  // m/s
  double a = 0.0;  // m/s^2
};

// Sum of sines and of one rounded triangle, in closed form with both derivatives:
//   x = offset + r(t) (sum A sin(w t + p) + B asin(k sin(w_t t)) / asin(k))
// r rises from 0 to 1 over `ramp` seconds with two continuous derivatives; without a ramp the motion has always been.
// From `stop` on it slows down within `stopping` seconds, as if its time went slower, and stays where it is.
struct Motion {
  struct Sine {
    double amplitude;  // m
    double omega;      // rad/s
    double phase;      // rad
  };
  std::vector<Sine> sines;
  double triangle_amplitude = 0.0;  // m
  double triangle_omega = 0.0;      // rad/s
  double triangle_sharpness = 0.95;
  double offset = 0.0;                                    // m
  double ramp = 0.0;                                      // s; 0: no ramp
  double stop = std::numeric_limits<double>::infinity();  // s
  double stopping = 0.0;                                  // s

  [[nodiscard]] Kinematics at(double t) const;
};

// Levels held from their times on, joined by linear slews of `slew` seconds.
struct Drive {
  std::vector<double> times;   // s, increasing; the first level holds before the second time
  std::vector<double> levels;  // A or V
  double slew = 0.002;

  [[nodiscard]] double at(double t) const;
};

struct Run {
  Motion motion;
  Drive drive;
  double duration = 3.0;      // s
  double lead = 0.05;         // s simulated before the recording begins
  double peak_amplitude = 0;  // m, from the middle position
  double peak_speed = 0;      // m/s
  double peak_acceleration = 0;
  bool held_out = false;
  std::string kind;        // "sine", "multisine", "triangle"
  std::size_t number = 0;  // of the test in its campaign
  // s after the end of the test before it; none: the damper is cold and as new.
  std::optional<double> pause = std::nullopt;
  std::optional<double> started = std::nullopt;  // s by the clock, where the files tell it
};

enum class Design { sines, broadband, mixed };

// What the effect to be shown needs, so that it is excited (or is kept unexcited).
struct Needs {
  bool drive_steps = false;
  int levels = 0;  // at least so many levels of the drive
  bool from_rest = false;
  bool long_runs = false;
  int frequencies = 1;         // at least so many frequencies of the sines
  bool one_level = false;      // unexcited: the drive never changes
  bool one_frequency = false;  // unexcited: a single frequency
  bool steady = false;         // motions that have always been: one frequency at a time
  bool slow = false;           // for a law with a sharp step at rest: reversals over many samples
  bool small_amplitudes = false;
  bool speed_decade = false;
  bool stops = false;  // each test ends at rest
};

struct Excitation {
  std::vector<Run> tests;
  double sampling_rate = 500.0;  // Hz
  double amplitude = 0.0;        // m, largest of all tests
  double smallest_amplitude = 0.0;
  double speed = 0.0;         // m/s, largest
  double acceleration = 0.0;  // m/s^2, largest
  double longest = 0.0;       // s
  double highest_level = 1.0;
};

// 4 to 24 tests, at most 30,000 samples in all, amplitudes up to `amplitude` (m), drive up to `highest_level`.
[[nodiscard]] Excitation draw_excitation(const Stream& stream, Design design, const Needs& needs, double amplitude,
                                         double highest_level);

}  // namespace hysteron::challenge

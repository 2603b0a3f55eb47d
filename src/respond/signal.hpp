// A sampled signal between its samples. What is assumed of it there is a named choice, since it decides how far a
// simulated response can be right:
//   linear        straight lines
//   cubic         cubics through the samples with three-point slopes
//   band-limited  no content above half the sampling frequency: sinc interpolation with a Kaiser window over 32 samples
//                 to either side; the samples must be uniform. Beyond the ends the signal repeats itself where it is
//                 periodic, and is reflected at its end points where it is not.
// Source of the window: Kaiser, Schafer, IEEE Trans. Acoust. Speech Signal Process. 28 (1980) 105-107.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

enum class Interpolation { linear, cubic, band_limited };

// Throws InputError for an unknown word.
Interpolation interpolation_of(const std::string& word);
std::string_view word_of(Interpolation interpolation);

class Signal {
 public:
  // Times increase (s); values of equal count, two at least. `periodic`: one more interval leads back to the first.
  // Throws InputError where band-limited is asked of samples that are not uniform.
  Signal(std::vector<double> time, std::vector<double> values, Interpolation interpolation, bool periodic);

  [[nodiscard]] double value(double time) const;
  [[nodiscard]] double slope(double time) const { return at(time).slope; }  // per s
  // The second derivative, per s^2, by a difference of the slope over 2 us; at its ends of the side it has.
  [[nodiscard]] double bend(double time) const;
  struct Point {
    double value;
    double slope;
  };
  [[nodiscard]] Point at(double time) const;

 private:
  // The time within the samples, or within the period.
  [[nodiscard]] double placed(double time) const;
  [[nodiscard]] Point within(double time) const;
  // Place on the fine grid: the first of the six points about it, and how far beyond the third of them.
  struct Place {
    std::size_t first;
    double beyond;
  };
  [[nodiscard]] Place on_fine_grid(double time) const;

  std::vector<double> time_;
  std::vector<double> values_;
  std::vector<double> slopes_;
  Interpolation interpolation_;
  double period_ = 0.0;       // s; 0: not periodic
  std::vector<double> fine_;  // band-limited: on a grid `finer` times as fine, with a margin on both sides
};

}  // namespace hysteron

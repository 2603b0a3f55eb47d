// From the unit box a solver searches to the physical parameters of a model at a drive level and frequency.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "simulate/composite.hpp"

namespace hysteron {

// What scales the identification box: peak force (N), half stroke (m), peak speed (m/s) of the recordings, the middle
// of all their displacements (m), and the ranges of drive (A or V) and frequency (Hz) over which parameter laws are
// spanned.
struct DataScale {
  double force = 1000.0;
  double length = 0.025;
  double velocity = 0.3;
  double drive_low = 0.0;
  double drive_high = 0.0;
  double frequency_low = 0.0;
  double frequency_high = 0.0;
  double middle = 0.0;
};

DataScale scale_of(const std::vector<Recording>& recordings);

// Frequency in Hz of the motion between its first and last turning points; 0 when it never turns.
double dominant_frequency(const Recording& recording);

struct LayoutOptions {
  std::map<std::string, int> by_current;
  std::map<std::string, int> by_frequency;
  std::map<std::string, double> fix;                        // parameter -> value held
  std::map<std::string, std::pair<double, double>> bounds;  // parameter -> box
};

// A coordinate of the search: one parameter, or its value at one node of its law.
struct Coordinate {
  std::size_t parameter;
  std::size_t node;
  Scale scale;
  double lower;
  double upper;
  bool linear;
};

// A parameter as a polynomial in drive and frequency, carried by its values at equispaced nodes, so that every node
// value lies in the parameter's box.
struct ParameterLaw {
  std::size_t parameter;
  std::vector<double> drive_nodes;  // one node: constant
  std::vector<double> frequency_nodes;
  std::size_t first;  // index of its first coordinate; nodes run drive-fastest
};

// One term of a law in the power basis: value * drive^drive_power * frequency^frequency_power.
struct Term {
  std::size_t parameter;
  int drive_power;
  int frequency_power;
  double value;
};

class Layout {
 public:
  // Throws InputError for unknown parameter names and impossible bounds.
  Layout(CompositeModel model, const DataScale& scale, const LayoutOptions& options);

  [[nodiscard]] const CompositeModel& model() const { return model_; }
  [[nodiscard]] const std::vector<Parameter>& cards() const { return cards_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t dimension() const { return coordinates_.size(); }
  [[nodiscard]] const std::vector<Coordinate>& coordinates() const { return coordinates_; }
  [[nodiscard]] const std::vector<ParameterLaw>& laws() const { return laws_; }
  [[nodiscard]] std::vector<bool> linear() const;
  // Values of parameters that are not searched (entries of searched ones are ignored).
  [[nodiscard]] const std::vector<double>& held() const { return held_; }

  // Physical value of coordinate c at unit position u, and its slope with u.
  [[nodiscard]] double physical(std::size_t c, double u) const;
  [[nodiscard]] double slope(std::size_t c, double u) const;
  [[nodiscard]] double unit(std::size_t c, double value) const;
  // Weights of a law's nodes at a drive level and frequency; T is double, Lanes or LaneDual.
  template <class T>
  [[nodiscard]] static std::vector<T> weights(const ParameterLaw& law, const T& drive, double frequency);

  // The card's initial values as a point of the unit box.
  [[nodiscard]] std::vector<double> initial() const;
  // Terms of all searched parameters for a point, and the matrix M (terms x coordinates, row-major) of
  // d term / d physical node value.
  [[nodiscard]] std::vector<Term> terms(const std::vector<double>& u) const;
  [[nodiscard]] std::vector<double> term_matrix() const;

 private:
  CompositeModel model_;
  std::vector<Parameter> cards_;
  std::vector<std::string> names_;
  std::vector<double> held_;
  std::vector<Coordinate> coordinates_;
  std::vector<ParameterLaw> laws_;
};

// Parameter values at a drive level and frequency from terms, over the held values.
std::vector<double> parameters_at(const std::vector<double>& held, const std::vector<Term>& terms, double drive,
                                  double frequency);

// "alpha", "alpha*i", "alpha*i^2*f": how a term is named in results.
std::string term_name(const std::string& parameter, int drive_power, int frequency_power);

}  // namespace hysteron

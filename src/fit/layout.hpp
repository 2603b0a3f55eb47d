// From the unit box a solver searches to the physical parameters of a model at a drive level and frequency.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "simulate/composite.hpp"

namespace hysteron {

// A condition over the recordings: its range is what laws in it are spanned over.
struct ConditionRange {
  std::string name;
  std::string unit;
  double low = 0.0;
  double high = 0.0;
};

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
  std::vector<ConditionRange> conditions = {};  // those of the recordings, in their order
};

// InputError where recordings have other conditions than the first.
DataScale scale_of(const std::vector<Recording>& recordings);

struct LayoutOptions {
  LawOrders by_current;
  LawOrders by_frequency;
  std::map<std::string, LawOrders> by;                      // condition -> parameters
  std::map<std::string, double> fix;                        // parameter -> value held
  std::map<std::string, std::pair<double, double>> bounds;  // parameter -> box
};

// Without what it says of parameters of other names.
LayoutOptions only_of(const std::vector<std::string>& names, LayoutOptions options);

// A coordinate of the search: one parameter, or its value at one node of its law.
struct Coordinate {
  std::size_t parameter;
  std::size_t node;
  Scale scale;
  double lower;
  double upper;
  bool linear;
};

// A parameter as a polynomial in drive, frequency and conditions (the product of one polynomial in each), carried by
// its values at equispaced nodes, so that every node value lies in the parameter's box.
struct ParameterLaw {
  struct Node {
    double drive;
    double frequency;
    std::vector<double> conditions;
  };
  std::size_t parameter;
  std::vector<double> drive_nodes;  // one node: constant
  std::vector<double> frequency_nodes;
  std::size_t first;  // index of its first coordinate; nodes run drive-fastest, then frequency, then the conditions
  std::vector<std::vector<double>> condition_nodes = {};  // one entry a condition of the layout

  [[nodiscard]] std::size_t count() const;  // of its nodes, and of its terms
  [[nodiscard]] Node node(std::size_t k) const;
};

// One term of a law in the power basis: value * drive^drive_power * frequency^frequency_power * the powers of the
// conditions.
struct Term {
  std::size_t parameter;
  int drive_power;
  int frequency_power;
  double value;
  std::vector<int> condition_powers = {};  // one a condition, or none for constants

  [[nodiscard]] bool constant() const;
  // Whether the powers are those of another term of whichever parameter.
  [[nodiscard]] bool same_powers(const Term& other) const;
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
  // Conditions of the scale: laws may follow them, and are evaluated at as many values.
  [[nodiscard]] const std::vector<ConditionRange>& conditions() const { return conditions_; }
  // Values of parameters that are not searched (entries of searched ones are ignored).
  [[nodiscard]] const std::vector<double>& held() const { return held_; }

  // Physical value of coordinate c at unit position u, and its slope with u.
  [[nodiscard]] double physical(std::size_t c, double u) const;
  [[nodiscard]] double slope(std::size_t c, double u) const;
  [[nodiscard]] double unit(std::size_t c, double value) const;
  // Weights of a law's nodes at a drive level, a frequency and values of the conditions; T is double, Lanes or
  // LaneDual.
  template <class T>
  [[nodiscard]] static std::vector<T> weights(const ParameterLaw& law, const T& drive, double frequency,
                                              std::span<const double> conditions);

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
  std::vector<ConditionRange> conditions_;
};

// The middle of every condition's range.
std::vector<double> middle_of(const std::vector<ConditionRange>& conditions);

// Parameter values at a drive level, a frequency and values of the conditions from terms, over the held values.
std::vector<double> parameters_at(const std::vector<double>& held, const std::vector<Term>& terms, double drive,
                                  double frequency, std::span<const double> conditions);

// Puts the values that terms of one layout have at the nodes of another into `point`, in unit coordinates, for the
// parameters that both have; the others stay as they are. Returns which coordinates are new.
std::vector<bool> carry_over(const Layout& from, const std::vector<Term>& terms, const Layout& to,
                             std::vector<double>& point);

// "alpha", "alpha*i", "alpha*i^2*f", "alpha*i*pressure": how a term is named in results.
std::string term_name(const std::string& parameter, const Term& term, const std::vector<ConditionRange>& conditions);
// Its unit, that of its parameter over those of what it is multiplied by.
std::string term_unit(std::string_view unit, const Term& term, const std::vector<ConditionRange>& conditions,
                      DriveKind drive);
// The same as people read it, told also where the unit of a condition is not known: "N/m per °C", "N per (unit of
// valve)^2".
std::string term_unit_text(std::string_view unit, const Term& term, const std::vector<ConditionRange>& conditions,
                           DriveKind drive);

// "more than 0", "0 to 1", "at least 0.001 m": what a parameter can be, in its unit; not below `least` where that is
// above zero.
std::string limits_text(const Parameter& card, double least = 0.0);

}  // namespace hysteron

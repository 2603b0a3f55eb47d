#include "task/impossible_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/extent.hpp"
#include "core/number_text.hpp"
#include "fit/layout.hpp"

namespace hysteron {
namespace {

using Range = std::optional<std::pair<double, double>>;

// Where a law is looked at: a drive, a frequency and conditions.
struct Place {
  double drive = 0.0;
  double frequency = 0.0;
  std::vector<double> conditions;
};

// The nodes of a polynomial over a range, which the fit has searched the values at.
std::vector<double> nodes_over(const Range& range, int order) {
  if (!range || order == 0) return {range ? range->first : 0.0};
  std::vector<double> nodes;
  for (int k = 0; k <= order; ++k) nodes.push_back(range->first + (range->second - range->first) * k / order);
  return nodes;
}

class Law {
 public:
  Law(const StoredModel& stored, std::size_t parameter) : stored_(stored) {
    for (const Term& term : stored.terms) {
      if (term.parameter == parameter) terms_.push_back(&term);
    }
  }

  // Whether it follows anything, and the ranges of all that it follows are known.
  [[nodiscard]] bool may_be_looked_at() const {
    const int drive = order(&Term::drive_power);
    const int frequency = order(&Term::frequency_power);
    if ((drive > 0 && !stored_.drive_range) || (frequency > 0 && !stored_.frequency_range)) return false;
    int condition = 0;
    for (std::size_t c = 0; c < stored_.conditions.size(); ++c) condition = std::max(condition, order_in(c));
    return drive + frequency + condition > 0;
  }

  [[nodiscard]] std::vector<Place> places() const {
    std::vector<Place> places;
    for (const double drive : nodes_over(stored_.drive_range, order(&Term::drive_power))) {
      for (const double frequency : nodes_over(stored_.frequency_range, order(&Term::frequency_power))) {
        places.push_back({drive, frequency, {}});
      }
    }
    for (std::size_t c = 0; c < stored_.conditions.size(); ++c) {
      const ConditionRange& condition = stored_.conditions[c];
      std::vector<Place> further;
      for (const Place& place : places) {
        for (const double value : nodes_over(std::pair(condition.low, condition.high), order_in(c))) {
          further.push_back(place);
          further.back().conditions.push_back(value);
        }
      }
      places = std::move(further);
    }
    return places;
  }

  // "at a current of 0 A"
  [[nodiscard]] std::string where(const Place& place) const {
    std::vector<std::string> parts;
    if (order(&Term::drive_power) > 0) {
      parts.push_back(stored_.drive == DriveKind::voltage ? fmt::format("a voltage of {:.3g} V", place.drive)
                                                          : fmt::format("a current of {:.3g} A", place.drive));
    }
    if (order(&Term::frequency_power) > 0) parts.push_back(fmt::format("{:.3g} Hz", place.frequency));
    for (std::size_t c = 0; c < stored_.conditions.size(); ++c) {
      const std::string& unit = stored_.conditions[c].unit;
      if (order_in(c) == 0) continue;
      parts.push_back(fmt::format("a {} of {:.3g}{}", stored_.conditions[c].name, place.conditions[c],
                                  unit.empty() ? "" : " " + unit));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  }

 private:
  [[nodiscard]] int order(int Term::*power) const {
    int highest = 0;
    for (const Term* term : terms_) highest = std::max(highest, term->*power);
    return highest;
  }
  [[nodiscard]] int order_in(std::size_t condition) const {
    int highest = 0;
    for (const Term* term : terms_) {
      if (condition < term->condition_powers.size()) highest = std::max(highest, term->condition_powers[condition]);
    }
    return highest;
  }

  const StoredModel& stored_;
  std::vector<const Term*> terms_;
};

}  // namespace

std::vector<std::string> impossible_laws(const StoredModel& stored, const std::string& path) {
  std::vector<std::string> remarks;
  const std::vector<Parameter> cards = stored.model.parameters();
  const std::vector<std::string> names = stored.model.parameter_names();
  for (std::size_t k = 0; k < cards.size(); ++k) {
    const Law law(stored, k);
    if (!law.may_be_looked_at()) continue;
    const std::vector<Place> places = law.places();
    std::vector<double> values;
    values.reserve(places.size());
    for (const Place& place : places) {
      values.push_back(parameters_at(stored.held, stored.terms, place.drive, place.frequency, place.conditions)[k]);
    }
    // What rounding makes of a value at a bound.
    const double rounding = std::sqrt(std::numeric_limits<double>::epsilon()) * peak_of(values);
    const Limits& limits = cards[k].limits;
    const auto impossible = std::ranges::find_if(
        values, [&](double value) { return !(value >= limits.lower - rounding && value <= limits.upper + rounding); });
    if (impossible == values.end()) continue;
    constexpr int digits = 4;
    const Place& place = places[static_cast<std::size_t>(impossible - values.begin())];
    remarks.push_back(fmt::format("{}: at {} the law of '{}' gives {}, expected {}", path, law.where(place), names[k],
                                  number_text(*impossible, digits), limits_text(cards[k])));
  }
  return remarks;
}

}  // namespace hysteron

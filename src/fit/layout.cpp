#include "fit/layout.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "core/number_text.hpp"
#include "core/suggest.hpp"
#include "core/unit_text.hpp"
#include "fit/one_level.hpp"

namespace hysteron {
namespace {

std::vector<double> nodes(double low, double high, int order) {
  std::vector<double> result;
  for (int k = 0; k <= order; ++k) {
    result.push_back(order == 0 ? 0.5 * (low + high) : low + (high - low) * k / order);
  }
  return result;
}

template <class T>
std::vector<T> lagrange(const std::vector<double>& at, const T& x) {
  std::vector<T> weight(at.size(), T(1.0));
  for (std::size_t k = 0; k < at.size(); ++k) {
    for (std::size_t m = 0; m < at.size(); ++m) {
      if (m != k) {
        weight[k] *= (x - T(at[m])) / T(at[k] - at[m]);
      }
    }
  }
  return weight;
}

// Power-basis coefficients of the Lagrange polynomial of node k.
std::vector<double> lagrange_coefficients(const std::vector<double>& at, std::size_t k) {
  std::vector<double> c{1.0};
  for (std::size_t m = 0; m < at.size(); ++m) {
    if (m == k) {
      continue;
    }
    const double scale = 1.0 / (at[k] - at[m]);
    std::vector<double> next(c.size() + 1, 0.0);
    for (std::size_t i = 0; i < c.size(); ++i) {
      next[i + 1] += c[i] * scale;
      next[i] -= c[i] * at[m] * scale;
    }
    c = next;
  }
  return c;
}

void check_known(const std::vector<std::string>& names, const std::string& name, const Message& option) {
  if (std::ranges::find(names, name) == names.end()) {
    std::string list;
    for (const std::string& known : names) {
      list += (list.empty() ? "" : ", ") + known;
    }
    throw OptionError(option + ": the model has no parameter '" + name + "'" + suggestion(name, names) +
                      ", expected one of " + list);
  }
}

// Of the recordings' scale, where a card is written for 1 kN, 25 mm and 0.3 m/s.
double factor_of(const Parameter& card, const DataScale& scale) {
  return std::pow(scale.force / 1000.0, card.dimension.force) * std::pow(scale.length / 0.025, card.dimension.length) *
         std::pow(scale.velocity / 0.3, card.dimension.velocity);
}

// Part of the half stroke that the middle of the motion may be off zero by before it counts.
constexpr double off_middle = 0.25;

// What an offset force has to make up for where the displacement does not swing about zero, as that of an absolute
// scale: the stiffest spring of the box, over the distance of the motion's middle.
double offset_of_springs(const std::vector<Parameter>& cards, const DataScale& scale) {
  const double distance = std::max(0.0, std::fabs(scale.middle) - off_middle * scale.length);
  double stiffest = 0.0;
  for (const Parameter& card : cards) {
    if (card.role == PhysicalRole::stiffness && card.linear) {
      const double stiffness = std::max(std::fabs(card.box.lower), std::fabs(card.box.upper));
      stiffest = std::max(stiffest, stiffness * factor_of(card, scale));
    }
  }
  return stiffest * distance;
}

// A length or a time so far below those of the device has more steps in it than can be marched.
constexpr double far_below_the_box = 1e-3;

// `given` is the option with the value. The box is the device's.
void refuse_impossible(const Parameter& card, const Box& box, double value, const Message& given) {
  const bool divides = card.scale == Scale::logarithmic && !card.limits.zero;
  const double least = divides ? far_below_the_box * box.lower : card.limits.lower;
  if (card.limits.hold(value) && value >= least) return;
  throw OptionError(given + ": " + number_text(value) + " is no " + std::string(card.name) + " (" +
                    std::string(card.meaning) + "), expected " + limits_text(card, divides ? least : 0.0));
}

}  // namespace

std::string limits_text(const Parameter& card, double least) {
  const std::string unit = card.unit == "1" ? "" : " " + std::string(card.unit);
  if (least > 0.0) return "at least " + number_text(least) + unit;
  if (!card.limits.zero) return "more than " + number_text(card.limits.lower) + unit;
  if (std::isinf(card.limits.lower)) return "at most " + number_text(card.limits.upper) + unit;
  if (std::isinf(card.limits.upper)) return "at least " + number_text(card.limits.lower) + unit;
  return number_text(card.limits.lower) + " to " + number_text(card.limits.upper) + unit;
}

std::size_t ParameterLaw::count() const {
  std::size_t result = drive_nodes.size() * frequency_nodes.size();
  for (const std::vector<double>& nodes : condition_nodes) {
    result *= nodes.size();
  }
  return result;
}

ParameterLaw::Node ParameterLaw::node(std::size_t k) const {
  Node result{drive_nodes[k % drive_nodes.size()], 0.0, {}};
  k /= drive_nodes.size();
  result.frequency = frequency_nodes[k % frequency_nodes.size()];
  k /= frequency_nodes.size();
  for (const std::vector<double>& nodes : condition_nodes) {
    result.conditions.push_back(nodes[k % nodes.size()]);
    k /= nodes.size();
  }
  return result;
}

bool Term::constant() const {
  return drive_power == 0 && frequency_power == 0 &&
         std::ranges::all_of(condition_powers, [](int power) { return power == 0; });
}

bool Term::same_powers(const Term& other) const {
  const auto power = [](const Term& of, std::size_t c) {
    return c < of.condition_powers.size() ? of.condition_powers[c] : 0;
  };
  bool same = drive_power == other.drive_power && frequency_power == other.frequency_power;
  for (std::size_t c = 0; c < std::max(condition_powers.size(), other.condition_powers.size()); ++c) {
    same = same && power(*this, c) == power(other, c);
  }
  return same;
}

std::vector<double> middle_of(const std::vector<ConditionRange>& conditions) {
  std::vector<double> result;
  result.reserve(conditions.size());
  for (const ConditionRange& condition : conditions) {
    result.push_back(0.5 * (condition.low + condition.high));
  }
  return result;
}

namespace {

// Takes the conditions of a recording into the ranges, which are empty where it is the first.
void widen(std::vector<ConditionRange>& ranges, const Recording& recording, bool first) {
  if (first) {
    for (const ConditionChannel& condition : recording.conditions) {
      ranges.push_back({condition.name, condition.unit, condition.values.front(), condition.values.front()});
    }
  }
  if (!std::ranges::equal(ranges, recording.conditions, {}, &ConditionRange::name, &ConditionChannel::name)) {
    throw InputError(recording.file + ": not the conditions of the other recordings, expected the same in all");
  }
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    const auto range = std::ranges::minmax(recording.conditions[c].values);
    ranges[c].low = std::min(ranges[c].low, range.min);
    ranges[c].high = std::max(ranges[c].high, range.max);
  }
}

}  // namespace

DataScale scale_of(const std::vector<Recording>& recordings) {
  DataScale scale{0.0, 0.0, 0.0};
  bool first = true;
  double lowest = 0.0;
  double highest = 0.0;
  for (const Recording& recording : recordings) {
    for (const double force : recording.force) {
      scale.force = std::max(scale.force, std::fabs(force));
    }
    for (const double velocity : recording.velocity) {
      scale.velocity = std::max(scale.velocity, std::fabs(velocity));
    }
    const auto [low, high] = std::ranges::minmax(recording.displacement);
    scale.length = std::max(scale.length, 0.5 * (high - low));
    lowest = first ? low : std::min(lowest, low);
    highest = first ? high : std::max(highest, high);
    double drive_low = 0.0;
    double drive_high = 0.0;
    if (!recording.drive.empty()) {
      const auto range = std::ranges::minmax(recording.drive);
      drive_low = range.min;
      drive_high = range.max;
    }
    const double frequency = dominant_frequency(recording);
    scale.drive_low = first ? drive_low : std::min(scale.drive_low, drive_low);
    scale.drive_high = first ? drive_high : std::max(scale.drive_high, drive_high);
    scale.frequency_low = first ? frequency : std::min(scale.frequency_low, frequency);
    scale.frequency_high = first ? frequency : std::max(scale.frequency_high, frequency);
    widen(scale.conditions, recording, first);
    first = false;
  }
  scale.middle = 0.5 * (lowest + highest);
  return scale;
}

Layout::Layout(CompositeModel model, const DataScale& scale, const LayoutOptions& options)
    : model_(std::move(model)),
      cards_(model_.parameters()),
      names_(model_.parameter_names()),
      conditions_(scale.conditions) {
  for (const auto& [name, order] : options.by_current) {
    check_known(names_, name, Option::by_current);
  }
  for (const auto& [name, order] : options.by_frequency) {
    check_known(names_, name, Option::by_frequency);
  }
  for (const auto& [condition, orders] : options.by) {
    for (const auto& [name, order] : orders) {
      check_known(names_, name, Option::by + " " + condition);
    }
    if (std::ranges::find(conditions_, condition, &ConditionRange::name) == conditions_.end()) {
      throw OptionError(Option::by + " " + condition +
                        ": the recordings were read without it, expected a column of them");
    }
  }
  for (const auto& [name, value] : options.fix) {
    check_known(names_, name, Option::fix);
  }
  for (const auto& [name, range] : options.bounds) {
    check_known(names_, name, Option::bounds);
  }
  const double of_springs = offset_of_springs(cards_, scale);
  for (std::size_t j = 0; j < cards_.size(); ++j) {
    Parameter& card = cards_[j];
    const double factor = factor_of(card, scale);
    // Held times and speeds round off the equations and stay; a held force is one of the device.
    if (!card.fixed || card.dimension.force != 0.0) {
      card.box.lower *= factor;
      card.box.upper *= factor;
      card.initial *= factor;
      const double shift = card.place * scale.middle;
      card.box.lower += shift;
      card.box.upper += shift;
      card.initial += shift;
    }
    if (!card.fixed && card.role == PhysicalRole::offset_force) {
      card.box.lower -= of_springs;
      card.box.upper += of_springs;
    }
    const Box of_device = card.box;
    if (const auto own = options.bounds.find(names_[j]); own != options.bounds.end()) {
      const Message given = Option::bounds + " " + names_[j];
      refuse_impossible(card, of_device, own->second.first, given);
      refuse_impossible(card, of_device, own->second.second, given);
      card.box.lower = own->second.first;
      card.box.upper = own->second.second;
      card.initial = std::clamp(card.initial, card.box.lower, card.box.upper);
      card.fixed = false;
      if (card.scale == Scale::logarithmic && card.box.lower <= 0.0) {
        card.scale = Scale::linear;
      }
    }
    if (const auto fixed = options.fix.find(names_[j]); fixed != options.fix.end()) {
      refuse_impossible(card, of_device, fixed->second, Option::fix + " " + names_[j]);
      card.fixed = true;
      card.initial = fixed->second;
    }
    held_.push_back(card.initial);
    const auto drive_law = options.by_current.find(names_[j]);
    const auto frequency_law = options.by_frequency.find(names_[j]);
    const int drive_order = drive_law == options.by_current.end() ? 0 : drive_law->second;
    const int frequency_order = frequency_law == options.by_frequency.end() ? 0 : frequency_law->second;
    refuse_one_level(scale, "current", Option::by_current + " " + names_[j], drive_order);
    refuse_one_level(scale, "frequency", Option::by_frequency + " " + names_[j], frequency_order);
    std::vector<std::vector<double>> condition_nodes;
    bool follows_condition = false;
    for (const ConditionRange& condition : conditions_) {
      const auto orders = options.by.find(condition.name);
      const auto own = orders == options.by.end() ? LawOrders::const_iterator{} : orders->second.find(names_[j]);
      const int order = orders == options.by.end() || own == orders->second.end() ? 0 : own->second;
      refuse_one_level(scale, condition.name, Option::by + " " + condition.name + "=" + names_[j], order);
      follows_condition = follows_condition || order > 0;
      condition_nodes.push_back(nodes(condition.low, condition.high, order));
    }
    if (card.fixed) {
      if (drive_order + frequency_order > 0 || follows_condition) {
        throw OptionError("parameter '" + names_[j] + "' is fixed and cannot follow a law, expected " + Option::bounds +
                          " for it");
      }
      continue;
    }
    ParameterLaw law{j, nodes(scale.drive_low, scale.drive_high, drive_order),
                     nodes(scale.frequency_low, scale.frequency_high, frequency_order), coordinates_.size()};
    law.condition_nodes = std::move(condition_nodes);
    for (std::size_t node = 0; node < law.count(); ++node) {
      coordinates_.push_back(
          {j, node, card.scale, card.box.lower, card.box.upper, card.linear && card.scale == Scale::linear});
    }
    laws_.push_back(std::move(law));
  }
}

std::vector<bool> Layout::linear() const {
  std::vector<bool> result;
  for (const Coordinate& coordinate : coordinates_) {
    result.push_back(coordinate.linear);
  }
  return result;
}

double Layout::physical(std::size_t c, double u) const {
  const Coordinate& k = coordinates_[c];
  if (k.scale == Scale::logarithmic) {
    return k.lower * exp(u * log(k.upper / k.lower));
  }
  return k.lower + u * (k.upper - k.lower);
}

double Layout::slope(std::size_t c, double u) const {
  const Coordinate& k = coordinates_[c];
  return k.scale == Scale::logarithmic ? physical(c, u) * log(k.upper / k.lower) : k.upper - k.lower;
}

double Layout::unit(std::size_t c, double value) const {
  const Coordinate& k = coordinates_[c];
  const double u = k.scale == Scale::logarithmic ? log(std::max(value, k.lower) / k.lower) / log(k.upper / k.lower)
                                                 : (value - k.lower) / (k.upper - k.lower);
  return std::clamp(u, 0.0, 1.0);
}

template <class T>
std::vector<T> Layout::weights(const ParameterLaw& law, const T& drive, double frequency,
                               std::span<const double> conditions) {
  const std::vector<T> by_drive = lagrange<T>(law.drive_nodes, drive);
  const std::vector<double> by_frequency = lagrange<double>(law.frequency_nodes, frequency);
  std::vector<T> result;
  for (const double wf : by_frequency) {
    for (const T& wd : by_drive) {
      result.push_back(wd * T(wf));
    }
  }
  for (std::size_t c = 0; c < law.condition_nodes.size(); ++c) {
    if (law.condition_nodes[c].size() == 1) {
      continue;
    }
    std::vector<T> wider;
    for (const double wc : lagrange<double>(law.condition_nodes[c], conditions[c])) {
      for (const T& weight : result) {
        wider.push_back(weight * T(wc));
      }
    }
    result = std::move(wider);
  }
  return result;
}
template std::vector<double> Layout::weights(const ParameterLaw&, const double&, double, std::span<const double>);
template std::vector<Lanes> Layout::weights(const ParameterLaw&, const Lanes&, double, std::span<const double>);
template std::vector<WideLanes> Layout::weights(const ParameterLaw&, const WideLanes&, double, std::span<const double>);
template std::vector<LaneDual> Layout::weights(const ParameterLaw&, const LaneDual&, double, std::span<const double>);

namespace {

// Nodes of a law's polynomials, in the order in which its nodes run.
std::vector<std::vector<double>> axes_of(const ParameterLaw& law) {
  std::vector<std::vector<double>> result{law.drive_nodes, law.frequency_nodes};
  result.insert(result.end(), law.condition_nodes.begin(), law.condition_nodes.end());
  return result;
}

// Where node or term k of a law stands on every axis.
std::vector<std::size_t> place_of(const std::vector<std::vector<double>>& axes, std::size_t k) {
  std::vector<std::size_t> result;
  for (const std::vector<double>& axis : axes) {
    result.push_back(k % axis.size());
    k /= axis.size();
  }
  return result;
}

}  // namespace

std::vector<double> Layout::initial() const {
  std::vector<double> u;
  for (std::size_t c = 0; c < coordinates_.size(); ++c) {
    u.push_back(unit(c, cards_[coordinates_[c].parameter].initial));
  }
  return u;
}

std::vector<double> Layout::term_matrix() const {
  const std::size_t d = dimension();
  std::vector<double> matrix(d * d, 0.0);  // as many terms as nodes
  for (const ParameterLaw& law : laws_) {
    const std::vector<std::vector<double>> axes = axes_of(law);
    for (std::size_t node = 0; node < law.count(); ++node) {
      const std::vector<std::size_t> at = place_of(axes, node);
      std::vector<std::vector<double>> coefficients;
      for (std::size_t a = 0; a < axes.size(); ++a) {
        coefficients.push_back(lagrange_coefficients(axes[a], at[a]));
      }
      for (std::size_t term = 0; term < law.count(); ++term) {
        const std::vector<std::size_t> power = place_of(axes, term);
        double product = 1.0;
        for (std::size_t a = 0; a < axes.size(); ++a) {
          product *= coefficients[a][power[a]];
        }
        matrix[(law.first + term) * d + law.first + node] = product;
      }
    }
  }
  return matrix;
}

std::vector<Term> Layout::terms(const std::vector<double>& u) const {
  const std::size_t d = dimension();
  const std::vector<double> matrix = term_matrix();
  std::vector<Term> result;
  for (const ParameterLaw& law : laws_) {
    const std::vector<std::vector<double>> axes = axes_of(law);
    for (std::size_t k = 0; k < law.count(); ++k) {
      double value = 0.0;
      for (std::size_t c = 0; c < d; ++c) {
        value += matrix[(law.first + k) * d + c] * physical(c, u[c]);
      }
      const std::vector<std::size_t> powers = place_of(axes, k);
      result.push_back({law.parameter,
                        static_cast<int>(powers[0]),
                        static_cast<int>(powers[1]),
                        value,
                        {powers.begin() + 2, powers.end()}});
    }
  }
  return result;
}

std::vector<double> parameters_at(const std::vector<double>& held, const std::vector<Term>& terms, double drive,
                                  double frequency, std::span<const double> conditions) {
  std::vector<double> result = held;
  for (const Term& term : terms) {
    result[term.parameter] = 0.0;
  }
  for (const Term& term : terms) {
    double power = 1.0;
    for (int k = 0; k < term.drive_power; ++k) {
      power *= drive;
    }
    for (int k = 0; k < term.frequency_power; ++k) {
      power *= frequency;
    }
    for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
      for (int k = 0; k < term.condition_powers[c]; ++k) {
        power *= conditions[c];
      }
    }
    result[term.parameter] += term.value * power;
  }
  return result;
}

LayoutOptions only_of(const std::vector<std::string>& names, LayoutOptions options) {
  const auto keep = [&](auto& rows) {
    std::erase_if(rows, [&](const auto& row) { return std::ranges::find(names, row.first) == names.end(); });
  };
  keep(options.by_current);
  keep(options.by_frequency);
  for (auto& [condition, orders] : options.by) {
    keep(orders);
  }
  keep(options.fix);
  keep(options.bounds);
  return options;
}

std::vector<bool> carry_over(const Layout& from, const std::vector<Term>& terms, const Layout& to,
                             std::vector<double>& point) {
  std::vector<bool> fresh(to.dimension(), true);
  const std::vector<std::string>& known = from.names();
  for (const ParameterLaw& law : to.laws()) {
    const auto found = std::ranges::find(known, to.names()[law.parameter]);
    if (found == known.end()) {
      continue;
    }
    const auto index = static_cast<std::size_t>(found - known.begin());
    for (std::size_t k = 0; k < law.count(); ++k) {
      const ParameterLaw::Node node = law.node(k);
      const std::vector<double> values = parameters_at(from.held(), terms, node.drive, node.frequency, node.conditions);
      point[law.first + k] = std::clamp(to.unit(law.first + k, values[index]), 0.0, 1.0);
      fresh[law.first + k] = false;
    }
  }
  return fresh;
}

std::string term_name(const std::string& parameter, const Term& term, const std::vector<ConditionRange>& conditions) {
  std::string name = parameter;
  const auto add = [&](const std::string& symbol, int power) {
    if (power > 0) {
      name += "*" + symbol + (power > 1 ? "^" + std::to_string(power) : "");
    }
  };
  add("i", term.drive_power);
  add("f", term.frequency_power);
  for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
    add(conditions[c].name, term.condition_powers[c]);
  }
  return name;
}

std::string term_unit(std::string_view unit, const Term& term, const std::vector<ConditionRange>& conditions,
                      DriveKind drive) {
  std::string result(unit);
  for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
    result = unit_over(result, conditions[c].unit, term.condition_powers[c]);
  }
  return term_unit(result, term.drive_power, term.frequency_power, drive);
}

std::string term_unit_text(std::string_view unit, const Term& term, const std::vector<ConditionRange>& conditions,
                           DriveKind drive) {
  std::string result = unit_text(term_unit(unit, term.drive_power, term.frequency_power, drive));
  for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
    const int power = term.condition_powers[c];
    if (power == 0) continue;
    if (result == "1") result.clear();
    result += (result.empty() ? "per " : " per ") + per_text(conditions[c].unit, conditions[c].name, power);
  }
  return result;
}

}  // namespace hysteron

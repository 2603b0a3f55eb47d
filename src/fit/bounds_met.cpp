#include "fit/bounds_met.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/joined.hpp"
#include "core/number_text.hpp"
#include "fit/curvature_directions.hpp"
#include "fit/free_coordinates.hpp"

namespace hysteron {
namespace {

bool coordinate_is_at_limit(const Layout& layout, std::size_t c, double u) {
  return is_limit(layout.cards()[layout.coordinates()[c].parameter], on_upper(u));
}

// By how much cost^2 falls in the Gauss-Newton step of these coordinates.
double fall(const Eigen::MatrixXd& curvature, const Eigen::VectorXd& gradient, const std::vector<Eigen::Index>& of) {
  if (of.empty()) return 0.0;
  const CorrelationEigen eigen(curvature(of, of));
  const Eigen::VectorXd slope = gradient(of).cwiseQuotient(eigen.norm);
  return slope.dot(eigen.told_inverse() * slope);
}

// A range ten times as far on that side, as --bounds takes it.
std::string wider(const Parameter& card, bool upper) {
  const auto beyond = [&](double end, double other, bool grows) {
    return end == 0.0 ? -other : grows ? 10.0 * end : 0.1 * end;
  };
  const double lower = upper ? card.box.lower : beyond(card.box.lower, card.box.upper, card.box.lower < 0.0);
  const double higher = upper ? beyond(card.box.upper, card.box.lower, card.box.upper > 0.0) : card.box.upper;
  return number_text(std::max(lower, card.limits.lower)) + ":" + number_text(std::min(higher, card.limits.upper));
}

// The end of its box that a parameter sits on.
std::string end_text(const Parameter& card, bool upper) {
  return number_text(upper ? card.box.upper : card.box.lower) + (card.unit == "1" ? "" : " " + std::string(card.unit));
}

// "at 0 A" of a node of a law; empty for a constant.
std::string place_text(const Layout& layout, const ParameterLaw& law, std::size_t node, DriveKind drive_kind) {
  const ParameterLaw::Node at = law.node(node);
  std::vector<std::string> words;
  if (law.drive_nodes.size() > 1) {
    words.push_back(number_text(at.drive) + (drive_kind == DriveKind::voltage ? " V" : " A"));
  }
  if (law.frequency_nodes.size() > 1) words.push_back(number_text(at.frequency) + " Hz");
  for (std::size_t k = 0; k < law.condition_nodes.size(); ++k) {
    const ConditionRange& condition = layout.conditions()[k];
    if (law.condition_nodes[k].size() > 1) {
      words.push_back(condition.name + " " + number_text(at.conditions[k]) +
                      (condition.unit.empty() ? "" : " " + condition.unit));
    }
  }
  return words.empty() ? "" : " at " + joined(words, " and ");
}

}  // namespace

bool is_limit(const Parameter& card, bool upper) {
  return upper ? card.box.upper >= card.limits.upper : card.box.lower <= card.limits.lower;
}

std::optional<double> cost_beyond_bounds(const Layout& layout, const Response& derivatives,
                                         const std::vector<double>& u) {
  const auto d = static_cast<Eigen::Index>(u.size());
  const Eigen::Map<const Eigen::MatrixXd> curvature(derivatives.gauss_newton.data(), d, d);
  const Eigen::Map<const Eigen::VectorXd> gradient(derivatives.gradient.data(), d);
  if (!(derivatives.cost[0] < diverged_cost) || !curvature.allFinite() || !gradient.allFinite()) return {};
  const std::vector<Eigen::Index> inside = free_coordinates(u);
  std::vector<Eigen::Index> released = inside;
  for (std::size_t c = 0; c < u.size(); ++c) {
    if (on_bound(u[c]) && !coordinate_is_at_limit(layout, c, u[c])) released.push_back(static_cast<Eigen::Index>(c));
  }
  if (released.size() == inside.size()) return {};
  // What a search that has not ended would still gain inside the box is not the box's.
  const double gain = fall(curvature, gradient, released) - fall(curvature, gradient, inside);
  const double square = derivatives.cost[0] * derivatives.cost[0];
  return std::sqrt(std::clamp(square - gain, 0.0, square));
}

EndsMet ends_met(const Layout& layout, const Response& derivatives, const std::vector<double>& u,
                 DriveKind drive_kind) {
  constexpr double least_shown = 0.005;  // of the NRMSE
  EndsMet result;
  std::vector<std::string> ends;
  std::set<std::string> widened;
  for (const ParameterLaw& law : layout.laws()) {
    const Parameter& card = layout.cards()[law.parameter];
    const std::string& name = layout.names()[law.parameter];
    for (std::size_t node = 0; node < law.count(); ++node) {
      const double position = u[law.first + node];
      const bool upper = on_upper(position);
      if (!on_bound(position) || is_limit(card, upper)) continue;
      ends.push_back(name + " (" + end_text(card, upper) + place_text(layout, law, node, drive_kind) + ")");
      const std::string range = name + "=" + wider(card, upper);
      if (widened.insert(range).second) result.wider += " " + Option::bounds + " " + range;
    }
  }
  if (ends.empty()) return result;
  const bool one = ends.size() == 1;
  result.text = joined(ends, " and ") + (one ? " is at the end of its" : " are at the ends of their") +
                " search range" + (one ? "" : "s");
  if (const std::optional<double> beyond = cost_beyond_bounds(layout, derivatives, u)) {
    // A share: where steps are coarse the NRMSE of the derivatives is not that of the table.
    const double falls = 1.0 - *beyond / derivatives.cost[0];
    result.costs = falls >= least_shown;
    result.text += result.costs
                       ? ", beyond which the NRMSE would fall by about " + number_text(std::round(100.0 * falls)) + " %"
                       : ", which costs no error that shows";
  }
  return result;
}

Message bounds_text(const Layout& layout, const Response& derivatives, const std::vector<double>& u,
                    DriveKind drive_kind) {
  std::vector<std::string> limits;
  for (const ParameterLaw& law : layout.laws()) {
    const Parameter& card = layout.cards()[law.parameter];
    for (std::size_t node = 0; node < law.count(); ++node) {
      const double position = u[law.first + node];
      const bool upper = on_upper(position);
      if (!on_bound(position) || !is_limit(card, upper)) continue;
      limits.push_back(layout.names()[law.parameter] + " is " + end_text(card, upper) +
                       place_text(layout, law, node, drive_kind) + ", the " + (upper ? "most" : "least") +
                       " it can be");
    }
  }
  std::string text;
  if (!limits.empty()) {
    text = joined(limits, " and ") + ": the recordings show none of it, or the others take its place";
  }
  const EndsMet ends = ends_met(layout, derivatives, u, drive_kind);
  if (ends.text.empty()) return text;
  return text + (text.empty() ? "" : "; ") + ends.text + "; wider with" + ends.wider;
}

}  // namespace hysteron

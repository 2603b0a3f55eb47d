// Where descents of a hypothesis begin.
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/search/relatives.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {
namespace {

// Times that the size of a start is halved, to a sixteenth.
constexpr int most_halvings = 4;
// Of a node of a richer law, part of its box.
constexpr double law_push = 0.03;

// Values for the parameters of an effect that a fit does not have, from a kindred effect that it has; whether there are
// any.
bool take_over_kindred(const Fit& from, const Layout& to, std::vector<double>& point) {
  bool any = false;
  const std::vector<std::string>& known = from.layout->names();
  for (const ParameterLaw& law : to.laws()) {
    const std::string& name = to.names()[law.parameter];
    if (std::ranges::find(known, name) != known.end()) {
      continue;
    }
    for (const Kindred& row : kindred()) {
      const auto found = row.to == name ? std::ranges::find(known, row.from) : known.end();
      if (found == known.end()) {
        continue;
      }
      const double value =
          parameters_at(from.layout->held(), from.terms, law.drive_nodes.front(), law.frequency_nodes.front(),
                        middle_of(to.conditions()))[static_cast<std::size_t>(found - known.begin())];
      for (std::size_t k = 0; k < law.count(); ++k) {
        point[law.first + k] = std::clamp(to.unit(law.first + k, row.factor * value), 0.0, 1.0);
      }
      any = true;
    }
  }
  return any;
}

// Radical inverse: evenly spread numbers in (0, 1).
double halton(std::size_t index, std::size_t base) {
  double result = 0.0;
  double part = 1.0 / static_cast<double>(base);
  for (std::size_t i = index + 1; i > 0; i /= base) {
    result += part * static_cast<double>(i % base);
    part /= static_cast<double>(base);
  }
  return result;
}

}  // namespace

Starts Workbench::starts(const Hypothesis& what, const Fit& warm, const Fit* also) const {
  auto shared = std::make_shared<const Layout>(layout(what));
  const Layout& layout = *shared;
  std::vector<double> known = layout.initial();
  const std::vector<bool> fresh = carry_over(*warm.layout, warm.terms, layout, known);
  std::vector<double> known_also = layout.initial();
  if (also != nullptr) {
    carry_over(*also->layout, also->terms, layout, known_also);
  }
  std::vector<std::vector<double>> starts;
  std::array<double, start_count> pushes = {0.01, -0.02, 0.05, -0.1, 0.003, -0.005, 0.3, -0.3};
  // The effect that is new, if it is one and not a richer law.
  const bool known_before =
      what.effects.empty() || std::ranges::find(warm.what.effects, what.effects.back()) != warm.what.effects.end();
  const Part* added_effect = known_before ? nullptr : find_effect(what.effects.back());
  if (added_effect != nullptr && !added_effect->starts.empty()) {
    std::ranges::copy(added_effect->starts, pushes.begin());
  }
  constexpr std::array<std::size_t, 4> bases = {2, 3, 5, 7};
  std::vector<std::size_t> sizes;
  std::size_t shapes = 0;
  for (std::size_t c = 0, part = 0; c < known.size(); ++c) {
    if (fresh[c]) {
      const bool size = part++ == 0 || layout.coordinates()[c].linear;
      shapes += size ? 0 : 1;
      if (size) {
        sizes.push_back(c);
      }
    }
  }
  const std::size_t count = shapes > 0 ? 2 * start_count : start_count;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> start = also != nullptr && k % 2 == 1 ? known_also : known;
    std::size_t part = 0;
    for (std::size_t c = 0; c < start.size(); ++c) {
      if (!fresh[c]) {
        continue;
      }
      const bool first_of_part = part == 0;
      ++part;
      const double neutral = start[c];
      if (first_of_part || layout.coordinates()[c].linear) {
        // The size of the effect: away from nothing, to either side where there is one.
        const double by = pushes[k % start_count];
        const double push = neutral < 0.02 ? std::fabs(by) : (neutral > 0.98 ? -std::fabs(by) : by);
        start[c] = std::clamp(neutral + push, 0.0, 1.0);
      } else if (k > 1) {
        start[c] = 0.05 + 0.9 * halton(k, bases[std::min<std::size_t>(part - 1, bases.size() - 1)]);
      }
    }
    starts.push_back(std::move(start));
  }
  const auto added = static_cast<std::size_t>(std::ranges::count(fresh, true));
  if (added == 0) {
    starts.resize(1);
    // Only laws in the drive are richer, each node of which may move.
    for (const ParameterLaw& law : layout.laws()) {
      const std::string& name = layout.names()[law.parameter];
      const bool richer = std::ranges::count(what.richer, name) > std::ranges::count(warm.what.richer, name);
      for (std::size_t k = 0; richer && k < law.count(); ++k) {
        starts.push_back(known);
        double& node = starts.back()[law.first + k];
        node += node > 0.5 ? -law_push : law_push;
      }
    }
  } else if (added == 1 && also == nullptr && added_effect != nullptr && added_effect->starts.empty()) {
    starts.resize(starts_of_a_pack(layout.dimension()));  // one size: where it starts from matters little
  }
  if (also != nullptr && take_over_kindred(*also, layout, known_also)) {
    starts.push_back(known_also);
  }
  return {std::move(shared), std::move(starts), std::move(known), std::move(sizes)};
}

// The size of what is new is known to first order at best, and far too large a one is no place to descend from: it is
// halved until the start is no worse than nothing new, a few times.
std::vector<std::vector<double>> Workbench::eased(const Starts& starts) const {
  ByteWriter key;
  key.text("eased starts");
  add_layout(key, *starts.layout);
  key.numbers(starts.neutral);
  for (const std::vector<double>& start : starts.points) {
    key.numbers(start);
  }
  const std::string bytes = piece(key, [&] {
    const Objective objective(*starts.layout, split_->fit, options_);
    const double nothing = objective.evaluate({starts.neutral, false}).cost[0];
    std::vector<std::vector<double>> points = starts.points;
    std::vector<double> costs(points.size(), diverged_cost);
    for (int k = 0; k <= most_halvings; ++k) {
      Request request;
      std::vector<std::size_t> asked;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (k == 0 || costs[i] > nothing) {
          asked.push_back(i);
          for (const std::size_t c : k == 0 ? std::vector<std::size_t>{} : starts.sizes) {
            points[i][c] = 0.5 * (points[i][c] + starts.neutral[c]);
          }
          request.points.insert(request.points.end(), points[i].begin(), points[i].end());
        }
      }
      if (asked.empty()) {
        break;
      }
      const Response answer = objective.evaluate(request);
      for (std::size_t i = 0; i < asked.size(); ++i) {
        costs[asked[i]] = answer.cost[i];
      }
    }
    ByteWriter result;
    for (std::size_t i = 0; i < points.size(); ++i) {
      result.numbers(points[i]);
      result.number(costs[i]);
    }
    return result.bytes();
  });
  ByteReader read(bytes);
  std::vector<std::pair<double, std::vector<double>>> sorted;
  for (std::size_t i = 0; i < starts.points.size(); ++i) {
    std::vector<double> point = read.numbers();
    sorted.emplace_back(read.number(), std::move(point));
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<double, std::vector<double>>::first);
  std::vector<std::vector<double>> result;
  result.reserve(sorted.size());
  for (auto& [cost, point] : sorted) {
    result.push_back(std::move(point));
  }
  return result;
}

}  // namespace hysteron

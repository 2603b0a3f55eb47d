#include "fit/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace hysteron {
namespace {

// Sum over the parts of their bounds of |d rate / d state|, 1/s. A series element has none of its own: its state is
// solved for together with the force.
double stiffness_bound(const CompositeModel& model, const double* p, double speed) {
  double bound = 0.0;
  model.for_links([&](const Link& link) {
    const auto stiffness = link.part->on_double.stiffness;
    if (stiffness != nullptr) bound += stiffness(p + link.parameter, speed);
  });
  return bound;
}

// Sub-steps between two samples, one at least, not rounded.
std::vector<double> substeps(const Layout& layout, const std::vector<double>& points, const Target& target) {
  const std::size_t d = layout.dimension();
  const CompositeModel& model = layout.model();
  std::vector<double> result(points.size() / d, 1.0);
  if (model.states() == 0) {
    return result;
  }
  const std::vector<double> conditions = target.conditions_at(0);
  const std::vector<double>& time = target.motion.time;
  const double between = (time.back() - time.front()) / static_cast<double>(std::max<std::size_t>(time.size(), 2) - 1);
  std::vector<double> nodes(d);
  std::vector<double> p(model.parameter_count());
  for (std::size_t row = 0; row < result.size(); ++row) {
    for (std::size_t c = 0; c < d; ++c) {
      nodes[c] = layout.physical(c, points[row * d + c]);
    }
    parameters_of_pack(layout, nodes, target.drive, target.frequency, conditions, p.data());
    const double bound = stiffness_bound(model, p.data(), target.fastest) * between / target.motion.step_limit;
    result[row] = std::isfinite(bound) ? std::max(bound, 1.0) : 1e300;
  }
  return result;
}

// Two packs side by side take the steps of the stiffer one. By how much it may be the stiffer one: what is won is a
// tenth to a half of the time (results/kernels.md).
constexpr double alike = 1.25;

}  // namespace

Rows Packing::rows(const Deal& deal) const {
  const std::size_t first = deal.first_pack * lane_count;
  return Rows(order).subspan(first, std::min(deal.packs * lane_count, order.size() - first));
}

Packing pack_candidates(const Layout& layout, const std::vector<double>& points, const Target& like, bool in_pairs) {
  const std::size_t count = points.size() / layout.dimension();
  const std::size_t packs = (count + lane_count - 1) / lane_count;
  Packing result;
  result.order.resize(count);
  std::iota(result.order.begin(), result.order.end(), std::size_t{0});
  if (packs <= 1) {
    result.deals.assign(packs, {0, 1});
    return result;
  }
  const std::vector<double> steps = substeps(layout, points, like);
  std::ranges::sort(result.order,
                    [&](std::size_t a, std::size_t b) { return std::tie(steps[a], a) < std::tie(steps[b], b); });
  const auto steps_of_pack = [&](std::size_t pack) {
    return steps[result.order[std::min((pack + 1) * lane_count, count) - 1]];
  };
  for (std::size_t pack = 0; pack < packs;) {
    const bool pair = in_pairs && pack + 1 < packs && steps_of_pack(pack + 1) <= alike * steps_of_pack(pack);
    result.deals.push_back({pack, pair ? std::size_t{2} : std::size_t{1}});
    pack += result.deals.back().packs;
  }
  return result;
}

}  // namespace hysteron

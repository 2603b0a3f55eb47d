// Detection limits, from forces at finite sizes: a derivative at the neutral size says nothing of what acts beyond a
// threshold, and a small size may be too stiff to be simulated.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "diagnose/search/observe.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/signature.hpp"
#include "diagnose/search/stage.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// A change of this part of the peak force, root mean square, is none: integration rounds by as much.
constexpr double least_change = 1e-6;

// Of a change the other parameters imitate all but this part.
constexpr double imitated = 1e-3;

// The effect at one size.
struct Probe {
  double size = 0.0;    // part of the box
  double change = 0.0;  // of the force, root mean square over the peak force
  double left = 0.0;    // of that, what the parameters of the fit do not imitate
};

bool is_imitated(const Probe& probe) { return probe.left < imitated * probe.change; }

// At every size at which the model can be simulated, smallest first, to both sides of a neutral value within the box.
std::vector<Probe> probes_of(const Workbench& bench, const Fit& neutral, const std::vector<std::size_t>& coordinates,
                             const Eigen::VectorXd& at, const Eigen::MatrixXd& basis,
                             const std::function<bool(const Probe&)>& enough) {
  const Eigen::VectorXd nothing = stacked(bench, neutral);
  const Eigen::VectorXd& from = nothing.allFinite() ? nothing : at;
  const double root = std::sqrt(static_cast<double>(at.size()));
  const double start = neutral.point[coordinates.front()];
  std::vector<Probe> result;
  for (const double size : effect_sizes) {
    for (const double sense : {1.0, -1.0}) {
      if (start + sense * size < 0.0 || start + sense * size > 1.0) {
        continue;
      }
      const Eigen::VectorXd change = stacked(bench, moved(neutral, coordinates, sense * size)) - from;
      if (!change.allFinite()) {
        continue;
      }
      const Eigen::VectorXd left = change - basis * (basis.transpose() * change);
      result.push_back({sense * size, change.norm() / root, left.norm() / root});
      if (enough(result.back())) {
        return result;
      }
    }
  }
  return result;
}

// Where the effect is looked for: the range of its first place, of one that has a place.
std::optional<std::string> range_of_place(const Fit& neutral, const std::string& effect) {
  const std::vector<Coordinate>& coordinates = neutral.layout->coordinates();
  for (std::size_t c = 0; c < coordinates.size(); ++c) {
    const std::size_t parameter = coordinates[c].parameter;
    const std::string& name = neutral.layout->names()[parameter];
    if (name.starts_with(effect + ".") && neutral.layout->cards()[parameter].place != 0) {
      return fmt::format("{} from {:.2g} to {:.2g} m", name.substr(name.find('.') + 1),
                         neutral.layout->physical(c, 0.0), neutral.layout->physical(c, 1.0));
    }
  }
  return std::nullopt;
}

std::string value_at(const Fit& neutral, const std::vector<std::size_t>& coordinates, double size) {
  const std::size_t c = coordinates.front();
  const std::size_t parameter = neutral.layout->coordinates()[c].parameter;
  const std::string& name = neutral.layout->names()[parameter];
  const std::string_view unit = neutral.layout->cards()[parameter].unit;
  return fmt::format("{} = {:.2g}{}", name.substr(name.find('.') + 1),
                     neutral.layout->physical(c, std::clamp(neutral.point[c] + size, 0.0, 1.0)),
                     unit == "1" ? "" : " " + std::string(unit));
}

Unobservable limit_of(const Workbench& bench, const Fit& fit, const Misfit& misfit, const std::string& effect,
                      double candidates, const Eigen::VectorXd& at, const Eigen::MatrixXd& basis) {
  Unobservable result;
  result.id = effect;
  const Fit neutral = at_neutral_size(bench, fit, effect);
  const std::vector<std::size_t> coordinates = size_of(neutral, effect);
  if (coordinates.empty()) {
    result.reason = "its parameters are all held";
    return result;
  }
  // left^2 / squares * independent values = what the criterion asks for (worth() in stage.hpp), and a parameter's
  // price.
  const double asked_evidence = least_evidence_of_a_place + 2.0 * std::log(candidates) + std::log(misfit.independent);
  const double asked = std::sqrt(asked_evidence * misfit.squares / misfit.independent);
  const std::vector<Probe> probes =
      probes_of(bench, neutral, coordinates, at, basis, [&](const Probe& probe) { return probe.left >= asked; });
  if (probes.empty()) {
    result.reason = "its equations could not be solved on these motions at any size";
    return result;
  }
  const Probe& last = *std::ranges::max_element(probes, {}, &Probe::left);
  if (last.left >= asked) {
    result.detection_limit = fmt::format("a force below {:.2g} % of the peak force (root mean square)",
                                         100.0 * last.change * asked / last.left);
    return result;
  }
  if (std::ranges::max(probes, {}, &Probe::change).change < least_change) {
    // The sizes grow. The middle of all motions, around which a place is looked for, may be where no rod was.
    const std::optional<std::string> place = range_of_place(neutral, effect);
    result.reason =
        place ? "no recording comes where it is looked for, " + *place
              : "it changes no force on these motions, up to " + value_at(neutral, coordinates, probes.back().size);
  } else if (is_imitated(last)) {
    result.reason = "the other parameters imitate all but a thousandth of it on these recordings";
  } else {
    result.reason = fmt::format(
        "at {} it changes the force by {:.3g} % of the peak (root mean square), of which the other parameters leave "
        "{:.2g} %, and {:.2g} % is what could be told",
        value_at(neutral, coordinates, last.size), 100.0 * last.change, 100.0 * last.left, 100.0 * asked);
  }
  return result;
}

}  // namespace

std::vector<std::string> had_by_the_law(const Workbench& bench, const Fit& fit,
                                        const std::vector<std::string>& effects) {
  std::vector<std::string> parts;
  std::ranges::copy_if(effects, std::back_inserter(parts),
                       [&](const std::string& id) { return is_part_of(id, fit.what.model); });
  const Eigen::VectorXd at = stacked(bench, fit);
  if (parts.empty() || !at.allFinite()) {
    return {};
  }
  const Eigen::MatrixXd basis = imitable(bench, fit, at);
  std::erase_if(parts, [&](const std::string& id) {
    const Fit neutral = at_neutral_size(bench, fit, id);
    const std::vector<std::size_t> coordinates = size_of(neutral, id);
    if (coordinates.empty()) {
      return true;
    }
    const auto acts = [](const Probe& probe) { return probe.change >= least_change; };
    const auto differs = [&](const Probe& probe) { return acts(probe) && !is_imitated(probe); };
    const std::vector<Probe> probes = probes_of(bench, neutral, coordinates, at, basis, differs);
    return std::ranges::none_of(probes, acts) || std::ranges::any_of(probes, differs);
  });
  return parts;
}

std::vector<Unobservable> detection_limits(const Workbench& bench, const Fit& fit, const Misfit& misfit,
                                           const std::vector<std::string>& effects) {
  const Eigen::VectorXd at = stacked(bench, fit);
  if (!at.allFinite() || at.size() <= static_cast<Eigen::Index>(fit.dimension()) || !(misfit.independent > 1.0)) {
    return {};
  }
  const Eigen::MatrixXd basis = imitable(bench, fit, at);
  const auto candidates = static_cast<double>(effects.size());
  std::vector<Unobservable> result(effects.size());
  parallel_for(effects.size(), bench.options().threads,
               [&](std::size_t k) { result[k] = limit_of(bench, fit, misfit, effects[k], candidates, at, basis); });
  return result;
}

}  // namespace hysteron

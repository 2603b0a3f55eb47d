#include "diagnose/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/squared.hpp"
#include "diagnose/residual/conditions.hpp"
#include "diagnose/residual/misfit.hpp"
#include "diagnose/residual/partition.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

constexpr int rounds = 10;  // of a descent
// In which the states are found and what they share is fitted without their differences.
constexpr int passes = 2;
// Of the largest force: tests of one device differ by less from day to day.
constexpr double repeatability = 0.05;
// Recordings that repeat another's motion and drive: one alone may be spoilt.
constexpr std::size_t fewest_repeats = 2;
// Another state of the device is what was wrong where it makes the larger part of the misfit beyond the noise.
constexpr double larger_part = 0.5;
// A parameter counts as different where a tenth of what the groups take off comes back without its difference.
constexpr double part_of_the_difference = 0.1;

Group everything(std::size_t count) {
  Group result(count);
  std::iota(result.begin(), result.end(), 0U);
  return result;
}

// A parameter of the damper law by which groups may differ.
struct Handle {
  std::size_t parameter;
  bool factor;  // of its whole law in the drive; else a number that is added to it
};

std::vector<Handle> handles_of(const Fit& fit) {
  std::vector<Handle> result;
  for (const ParameterLaw& law : fit.layout->laws()) {
    const bool of_the_law = fit.layout->names()[law.parameter].find('.') == std::string::npos;
    const PhysicalRole role = fit.layout->cards()[law.parameter].role;
    if (of_the_law && (fit.layout->coordinates()[law.first].linear || role != PhysicalRole::none)) {
      result.push_back({law.parameter, law.drive_nodes.size() * law.frequency_nodes.size() > 1});
    }
  }
  return result;
}

Fit moved(const Fit& fit, const Handle& handle, double step) {
  Fit result = fit;
  for (Term& term : result.terms) {
    if (term.parameter == handle.parameter && handle.factor) {
      term.value *= 1.0 + step;
    } else if (term.parameter == handle.parameter && term.drive_power == 0 && term.frequency_power == 0) {
      term.value += step;
    }
  }
  return result;
}

// To first order in the parameters, which is exact for those that the force is affine in.
std::vector<Quadratic> quadratics_of(const Workbench& bench, const Fit& fit, const std::vector<Handle>& handles) {
  constexpr double part_of_the_box = 1e-3;
  const std::vector<Recording>& recordings = bench.split().fit;
  std::vector<Quadratic> result(recordings.size());
  parallel_for(recordings.size(), bench.options().threads, [&](std::size_t r) {
    const Residual left = bench.residual(fit, recordings[r]);
    const auto rows = static_cast<Eigen::Index>(left.force.size());
    Eigen::MatrixXd slopes(rows, static_cast<Eigen::Index>(handles.size()));
    for (std::size_t h = 0; h < handles.size(); ++h) {
      const Parameter& card = fit.layout->cards()[handles[h].parameter];
      const double step = handles[h].factor ? part_of_the_box : part_of_the_box * (card.box.upper - card.box.lower);
      const Residual there = bench.residual(moved(fit, handles[h], step), recordings[r]);
      for (Eigen::Index n = 0; n < rows; ++n) {
        const auto k = static_cast<std::size_t>(n);
        slopes(n, static_cast<Eigen::Index>(h)) = (there.force[k] - left.force[k]) / step;
      }
    }
    const Eigen::Map<const Eigen::VectorXd> force(left.force.data(), rows);
    const double norm = normaliser(recordings[r], bench.options().normalisation);
    const double weight = 1.0 / (squared(norm) * static_cast<double>(rows - static_cast<Eigen::Index>(left.from)) *
                                 static_cast<double>(recordings.size()));
    result[r] = {weight * slopes.transpose() * slopes, weight * slopes.transpose() * force,
                 weight * force.squaredNorm()};
  });
  return result;
}

// The recordings as the device would have given them in one state: less what the changes of their groups add.
std::vector<Recording> in_one_state(const Workbench& bench, const Fit& fit, const std::vector<Handle>& handles,
                                    const std::vector<Quadratic>& quadratics, const std::vector<Group>& groups) {
  std::vector<Recording> result = bench.split().fit;
  const Eigen::VectorXd common = common_of(quadratics, everything(result.size())).change;
  for (const Group& group : groups) {
    const Eigen::VectorXd change = common_of(quadratics, group).change - common;
    parallel_for(group.size(), bench.options().threads, [&](std::size_t k) {
      Recording& recording = result[group[k]];
      const Residual left = bench.residual(fit, recording);
      Fit there = fit;
      for (std::size_t h = 0; h < handles.size(); ++h) {
        there = moved(there, handles[h], change(static_cast<Eigen::Index>(h)));
      }
      const Residual other = bench.residual(there, recording);
      for (std::size_t n = 0; n < recording.size(); ++n) {
        const double by = other.force[n] - left.force[n];
        recording.force[n] -= std::isfinite(by) ? by : 0.0;
      }
    });
  }
  return result;
}

bool finite(const std::vector<Quadratic>& quadratics) {
  return std::ranges::all_of(quadratics, [](const Quadratic& row) {
    return row.hessian.allFinite() && row.gradient.allFinite() && std::isfinite(row.squares);
  });
}

double squares_of(const std::vector<Quadratic>& quadratics, const std::vector<Group>& groups) {
  double result = 0.0;
  for (const Group& group : groups) {
    result += common_of(quadratics, group).squares;
  }
  return result;
}

// What is known that parts two groups of which each holds more than one recording; empty where two stand that nothing
// parts.
std::string parted_by_conditions(const std::vector<RecordedCondition>& conditions, const std::vector<Group>& groups) {
  std::string result;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      if (groups[a].size() < 2 || groups[b].size() < 2) {
        continue;
      }
      const RecordedCondition* condition = parted_by(conditions, groups[a], groups[b]);
      if (condition == nullptr) {
        return {};
      }
      result = condition->name;
    }
  }
  return result;
}

double mean_drive(const std::vector<Recording>& recordings) {
  double sum = 0.0;
  for (const Recording& recording : recordings) {
    sum += recording.drive.empty() ? 0.0
                                   : std::accumulate(recording.drive.begin(), recording.drive.end(), 0.0) /
                                         static_cast<double>(recording.size());
  }
  return sum / static_cast<double>(recordings.size());
}

double mean_frequency(const std::vector<Recording>& recordings) {
  double sum = 0.0;
  for (const Recording& recording : recordings) {
    sum += dominant_frequency(recording);
  }
  return sum / static_cast<double>(recordings.size());
}

std::string in_words(PhysicalRole role) {
  switch (role) {
    case PhysicalRole::yield_force:
      return "yield force";
    case PhysicalRole::offset_force:
      return "preload";
    case PhysicalRole::damping:
      return "damping";
    case PhysicalRole::stiffness:
      return "stiffness";
    case PhysicalRole::mass:
      return "mass";
    case PhysicalRole::none:
      break;
  }
  return {};
}

std::string list_of(const std::vector<std::string>& words) {
  std::string result;
  for (std::size_t k = 0; k < words.size(); ++k) {
    result += (k == 0 ? "" : (k + 1 == words.size() ? " and " : ", ")) + words[k];
  }
  return result;
}

// A partition, and what that is recorded explains it.
struct Parted {
  Partition partition;
  std::string explained_by;
  bool by_repeats = false;
};

// Groups that hold together so well that scatter from recording to recording does not explain them.
std::optional<Parted> parted_clearly(const std::optional<Partition>& clearest, const std::vector<Quadratic>& quadratics,
                                     const std::vector<RecordedCondition>& conditions) {
  if (!clearest || clearest->chance > surely) {
    return {};
  }
  Parted result{*clearest, parted_by_conditions(conditions, clearest->groups), false};
  if (const Followed law = followed(quadratics, conditions);
      result.explained_by.empty() && law.squares <= clearest->apart) {
    result.explained_by = law.name;
  }
  return result;
}

// Recordings of the same motion and drive whose forces differ by more than tests of one device do: no function of what
// was recorded gives them both.
std::optional<Parted> parted_by_repeats(const std::vector<Quadratic>& quadratics,
                                        const std::vector<RecordedCondition>& conditions) {
  const std::vector<Group> cells = cells_of(conditions, quadratics.size());
  if (quadratics.size() < cells.size() + fewest_repeats) {
    return {};
  }
  const std::optional<Partition> partition = coarsest_partition(quadratics);
  if (!partition) {
    return {};
  }
  const double all = partition->together - partition->alone;
  const double unexplained = squares_of(quadratics, cells) - partition->alone;
  if (unexplained < std::max(larger_part * all, squared(repeatability))) {
    return {};
  }
  Parted result{*partition, "", true};
  if (const Followed law = followed(quadratics, conditions); partition->together - law.squares > larger_part * all) {
    result.explained_by = law.name;
  }
  return result;
}

void fit_groups(Belonging& result, const Workbench& bench, const Fit& joint, const std::vector<Quadratic>& quadratics,
                const std::vector<Handle>& handles, const Partition& partition) {
  const std::vector<Recording>& recordings = bench.split().fit;
  const double drive = mean_drive(recordings);
  const double frequency = mean_frequency(recordings);
  double apart = 0.0;
  std::vector<std::vector<double>> values;
  for (const Group& group : partition.groups) {
    std::vector<Recording> members;
    result.groups.emplace_back();
    for (const std::size_t r : group) {
      members.push_back(recordings[r]);
      result.groups.back().push_back(recordings[r].file);
    }
    const Fit own = bench.on_all(joint, members, rounds);
    result.nrmse.push_back(own.cost);
    apart += squared(own.cost) * static_cast<double>(members.size()) / static_cast<double>(recordings.size());
    values.push_back(parameters_at(own.layout->held(), own.terms, drive, frequency));
  }
  result.apart = std::sqrt(apart);
  const std::vector<double> costs = cost_of_sharing(quadratics, partition.groups);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    const std::size_t parameter = handles[h].parameter;
    const Parameter& card = joint.layout->cards()[parameter];
    Difference row{joint.layout->names()[parameter],
                   in_words(card.role),
                   std::string(card.unit),
                   {},
                   handles[h].factor ? std::optional(drive) : std::nullopt,
                   costs[h] / (partition.together - partition.apart)};
    for (const std::vector<double>& of : values) {
      row.values.push_back(of[parameter]);
    }
    if (row.share > part_of_the_difference) {
      result.differences.push_back(std::move(row));
    }
  }
  std::ranges::stable_sort(result.differences, std::greater{}, &Difference::share);
}

}  // namespace

std::optional<Belonging> belonging_of(const Workbench& bench, const Fit& base, const Fit& augmented) {
  const std::vector<Recording>& recordings = bench.split().fit;
  const Fit joint = bench.polished(base, rounds);
  const std::vector<Handle> handles = handles_of(joint);
  std::vector<Quadratic> quadratics = quadratics_of(bench, joint, handles);
  if (handles.empty() || !finite(quadratics)) {
    return {};
  }
  const std::vector<RecordedCondition> conditions = conditions_of(recordings);
  std::optional<Parted> parted = parted_by_repeats(quadratics, conditions);
  // What all states share, the shape of the loop, is distorted by their differences until these are taken off.
  std::optional<Partition> clearest = clearest_partition(quadratics);
  Fit shared = joint;
  for (int pass = 0; pass < passes && clearest; ++pass) {
    shared = bench.on_all(shared, in_one_state(bench, shared, handles, quadratics, clearest->groups), rounds);
    quadratics = quadratics_of(bench, shared, handles);
    clearest = finite(quadratics) ? clearest_partition(quadratics) : std::nullopt;
  }
  if (const std::optional<Parted> clear = parted_clearly(clearest, quadratics, conditions);
      clear && (!parted || clear->explained_by.empty())) {
    parted = clear;
  } else if (parted) {
    quadratics = quadratics_of(bench, joint, handles);
  }
  if (!parted) {
    return {};
  }
  Belonging result;
  result.chance = parted->partition.chance;
  result.explained_by = parted->explained_by;
  result.by_repeats = parted->by_repeats;
  result.together = joint.cost;
  fit_groups(result, bench, joint, quadratics, handles, parted->partition);
  const double floor = misfit_of(recordings, bench.residuals(joint)).floor;
  if (squared(result.together) - squared(result.apart) < larger_part * (squared(result.together) - floor)) {
    return {};
  }
  if (result.explained_by.empty() && !augmented.what.effects.empty()) {
    const std::vector<Quadratic> left = quadratics_of(bench, augmented, handles_of(augmented));
    const double joined = common_of(left, everything(left.size())).squares;
    if (finite(left) && joined - squares_of(left, parted->partition.groups) < larger_part * (joined - floor)) {
      result.explained_by = "effects";
    }
  }
  return result;
}

std::optional<UnusedColumnTold> unused_column(const Workbench& bench, const Fit& base) {
  const std::vector<RecordedCondition> conditions = conditions_of(bench.split().fit);
  if (std::ranges::none_of(conditions, &RecordedCondition::unused)) {
    return {};
  }
  const Fit joint = bench.polished(base, rounds);
  const std::vector<Handle> handles = handles_of(joint);
  const std::vector<Quadratic> quadratics = quadratics_of(bench, joint, handles);
  if (handles.empty() || !finite(quadratics)) {
    return {};
  }
  const std::optional<FollowedColumn> found = followed_column(quadratics, conditions);
  if (!found) {
    return {};
  }
  UnusedColumnTold result{found->name,   found->low, found->high, std::sqrt(found->together), std::sqrt(found->along),
                          found->chance, {}};
  std::vector<std::size_t> order(handles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t h) { return found->cost(static_cast<Eigen::Index>(h)); });
  for (const std::size_t h : order) {
    const auto at = static_cast<Eigen::Index>(h);
    if (found->cost(at) > part_of_the_difference * (found->together - found->along)) {
      const Parameter& card = joint.layout->cards()[handles[h].parameter];
      result.changes.push_back({joint.layout->names()[handles[h].parameter], in_words(card.role),
                                handles[h].factor ? "" : std::string(card.unit), found->change(at)});
    }
  }
  return result;
}

std::string sentence_of(const UnusedColumnTold& column) {
  std::vector<std::string> changes;
  for (const UnusedColumnTold::Change& row : column.changes) {
    const std::string name = row.meaning.empty() ? row.parameter : row.meaning + " (" + row.parameter + ")";
    changes.push_back(row.unit.empty()
                          ? fmt::format("{} {:+.0f} %", name, 100.0 * row.value)
                          : fmt::format("{} {:+.3g}{}", name, row.value, row.unit == "1" ? "" : " " + row.unit));
  }
  return fmt::format(
      "the parameters follow the recorded '{}', which no model uses: from {:.3g} to {:.3g} {}; all recordings together "
      "NRMSE {:.2g}, with parameters that follow it about {:.2g}; dealt to the recordings by lot, it does as well with "
      "a "
      "probability of {:.1g}",
      column.name, column.low, column.high, list_of(changes), column.together, column.along, column.chance);
}

nlohmann::json column_json(const UnusedColumnTold& column) {
  nlohmann::json parameters = nlohmann::json::array();
  for (const UnusedColumnTold::Change& row : column.changes) {
    parameters.push_back({{"name", row.parameter},
                          {"change", row.value},
                          {"unit", row.unit.empty() ? nlohmann::json(nullptr) : nlohmann::json(row.unit)}});
  }
  return {{"name", column.name},         {"from", column.low},
          {"to", column.high},           {"nrmse_together", column.together},
          {"nrmse_along", column.along}, {"chance", column.chance},
          {"parameters", parameters}};
}

bool mixed(const std::optional<Belonging>& belonging) { return belonging && belonging->explained_by.empty(); }

std::string sentence_of(const Belonging& belonging) {
  std::vector<std::string> groups;
  for (std::size_t g = 0; g < belonging.groups.size(); ++g) {
    groups.push_back(fmt::format("({}) {}", g + 1, list_of(belonging.groups[g])));
  }
  std::vector<std::string> differences;
  for (const Difference& row : belonging.differences) {
    std::string values;
    for (std::size_t g = 0; g < row.values.size(); ++g) {
      values += fmt::format("{}{:.3g}", g == 0 ? "" : " against ", row.values[g]);
    }
    differences.push_back(fmt::format(
        "{} {}{}{}", row.meaning.empty() ? row.parameter : row.meaning + " (" + row.parameter + ")", values,
        row.unit == "1" ? "" : " " + row.unit, row.drive ? fmt::format(" at a drive of {:.3g}", *row.drive) : ""));
  }
  return fmt::format(
      "the recordings are not of one device state: {}{}{}; fitted together NRMSE {:.2g}, apart {:.2g}; {}. A valve, a "
      "preload or the specimen was another; no name is given on a mixture",
      list_of(groups), differences.empty() ? "" : "; ", list_of(differences), belonging.together, belonging.apart,
      belonging.by_repeats ? std::string("recordings of the same motion and drive are not alike")
                           : fmt::format("parameters that scatter from recording to recording part so well with a "
                                         "probability of {:.1g}, and nothing recorded parts them so",
                                         belonging.chance));
}

nlohmann::json groups_json(const Belonging& belonging) {
  nlohmann::json groups = nlohmann::json::array();
  for (std::size_t g = 0; g < belonging.groups.size(); ++g) {
    nlohmann::json parameters = nlohmann::json::array();
    for (const Difference& row : belonging.differences) {
      parameters.push_back({{"name", row.parameter}, {"value", row.values[g]}, {"unit", row.unit}});
    }
    groups.push_back({{"recordings", belonging.groups[g]}, {"nrmse", belonging.nrmse[g]}, {"parameters", parameters}});
  }
  return {{"states", groups},
          {"nrmse_together", belonging.together},
          {"nrmse_apart", belonging.apart},
          {"told_by", belonging.by_repeats ? "repeated motions" : "states that hold together"},
          {"chance", belonging.by_repeats ? nlohmann::json(nullptr) : nlohmann::json(belonging.chance)},
          {"sentence", sentence_of(belonging)}};
}

}  // namespace hysteron

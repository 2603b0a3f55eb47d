#include "diagnose/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/frequency.hpp"
#include "core/squared.hpp"
#include "diagnose/residual/conditions.hpp"
#include "diagnose/residual/misfit.hpp"
#include "diagnose/residual/partition.hpp"
#include "diagnose/search/wording.hpp"
#include "fit/parallel.hpp"

namespace hysteron {
namespace {

// In which the states are found and what they share is fitted without their differences.
constexpr int passes = 2;
// Of the largest force: tests of one device differ by less from day to day.
constexpr double repeatability = 0.05;
// Recordings that repeat another's motion and drive: one alone may be spoilt.
constexpr std::size_t fewest_repeats = 2;
// Another state of the device is what was wrong where it makes the larger part of the misfit beyond the noise.
constexpr double larger_part = 0.5;

Group everything(std::size_t count) {
  Group result(count);
  std::iota(result.begin(), result.end(), 0U);
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

double squares_of(const std::vector<Quadratic>& quadratics, const std::vector<Group>& groups) {
  double result = 0.0;
  for (const Group& group : groups) {
    result += common_of(quadratics, group).squares;
  }
  return result;
}

// Whether something known parts every two groups of which each holds more than one recording; not where there are no
// two of them.
bool parted_by_conditions(const std::vector<RecordedCondition>& conditions, const std::vector<Group>& groups) {
  bool result = false;
  for (std::size_t a = 0; a < groups.size(); ++a) {
    for (std::size_t b = a + 1; b < groups.size(); ++b) {
      if (groups[a].size() < 2 || groups[b].size() < 2) {
        continue;
      }
      if (parted_by(conditions, groups[a], groups[b]) == nullptr) {
        return false;
      }
      result = true;
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

// A partition, and what that is recorded explains it.
struct Parted {
  Partition partition;
  bool explained = false;
  bool by_repeats = false;
};

// Groups that hold together so well that scatter from recording to recording does not explain them.
std::optional<Parted> parted_clearly(const std::optional<Partition>& clearest, const std::vector<Quadratic>& quadratics,
                                     const std::vector<RecordedCondition>& conditions) {
  if (!clearest || clearest->chance > surely) {
    return {};
  }
  const bool explained =
      parted_by_conditions(conditions, clearest->groups) || squares_followed(quadratics, conditions) <= clearest->apart;
  return Parted{*clearest, explained, false};
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
  const bool explained = partition->together - squares_followed(quadratics, conditions) > larger_part * all;
  return Parted{*partition, explained, true};
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
    const Fit own = bench.on_all(joint, members, descent_rounds);
    result.nrmse.push_back(own.cost);
    apart += squared(own.cost) * static_cast<double>(members.size()) / static_cast<double>(recordings.size());
    values.push_back(
        parameters_at(own.layout->held(), own.terms, drive, frequency, middle_of(own.layout->conditions())));
  }
  result.apart = std::sqrt(apart);
  const std::vector<double> costs = cost_of_sharing(quadratics, partition.groups);
  for (std::size_t h = 0; h < handles.size(); ++h) {
    const std::size_t parameter = handles[h].parameter;
    const Parameter& card = joint.layout->cards()[parameter];
    Difference row{joint.layout->names()[parameter],
                   std::string(name_of(card.role)),
                   std::string(card.unit),
                   {},
                   handles[h].factor ? std::optional(drive) : std::nullopt,
                   costs[h] / (partition.together - partition.apart)};
    for (const std::vector<double>& of : values) {
      row.values.push_back(of[parameter]);
    }
    if (row.share > least_difference) {
      result.differences.push_back(std::move(row));
    }
  }
  std::ranges::stable_sort(result.differences, std::greater{}, &Difference::share);
}

}  // namespace

std::optional<Belonging> belonging_of(const Workbench& bench, const ByRecording& base, const Fit& augmented) {
  if (!base.told()) {
    return {};
  }
  const std::vector<Recording>& recordings = bench.split().fit;
  const Fit& joint = base.joint;
  const std::vector<Handle>& handles = base.handles;
  std::vector<Quadratic> quadratics = base.quadratics;
  const std::vector<RecordedCondition> conditions = conditions_of(recordings);
  std::optional<Parted> parted = parted_by_repeats(quadratics, conditions);
  // What all states share, the shape of the loop, is distorted by their differences until these are taken off.
  std::optional<Partition> clearest = clearest_partition(quadratics);
  Fit shared = joint;
  for (int pass = 0; pass < passes && clearest; ++pass) {
    shared = bench.on_all(shared, in_one_state(bench, shared, handles, quadratics, clearest->groups), descent_rounds);
    quadratics = quadratics_of(bench, shared, handles);
    clearest = finite(quadratics) ? clearest_partition(quadratics) : std::nullopt;
  }
  if (const std::optional<Parted> clear = parted_clearly(clearest, quadratics, conditions);
      clear && (!parted || !clear->explained)) {
    parted = clear;
  } else if (parted) {
    quadratics = base.quadratics;
  }
  if (!parted) {
    return {};
  }
  Belonging result;
  result.chance = parted->partition.chance;
  result.explained = parted->explained;
  result.by_repeats = parted->by_repeats;
  result.together = joint.cost;
  fit_groups(result, bench, joint, quadratics, handles, parted->partition);
  const double floor = misfit_of(recordings, bench.residuals(joint)).floor;
  if (squared(result.together) - squared(result.apart) < larger_part * (squared(result.together) - floor)) {
    return {};
  }
  if (!result.explained && !augmented.what.effects.empty()) {
    const std::vector<Quadratic> left = quadratics_of(bench, augmented, handles_of(augmented));
    const double joined = common_of(left, everything(left.size())).squares;
    if (finite(left) && joined - squares_of(left, parted->partition.groups) < larger_part * (joined - floor)) {
      result.explained = true;
    }
  }
  return result;
}

bool mixed(const std::optional<Belonging>& belonging) { return belonging && !belonging->explained; }

std::string sentence_of(const Belonging& belonging) {
  std::vector<std::string> groups;
  for (std::size_t g = 0; g < belonging.groups.size(); ++g) {
    groups.push_back(fmt::format("({}) {}", g + 1, joined(belonging.groups[g], " and ")));
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
      "preload or the specimen was another, or what drives it was noted wrongly; no name is given on a mixture",
      joined(groups, " and "), differences.empty() ? "" : "; ", joined(differences, " and "), belonging.together,
      belonging.apart,
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

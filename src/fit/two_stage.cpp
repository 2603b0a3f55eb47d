#include "fit/two_stage.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/frequency.hpp"
#include "core/message.hpp"
#include "fit/no_candidate.hpp"

namespace hysteron {
namespace {

// Levels closer than this share of the campaign's range are one condition.
constexpr double same_level = 0.02;

std::vector<Condition> conditions_of(const std::vector<Recording>& recordings, const std::vector<std::size_t>& fitted) {
  const DataScale scale = scale_of(pick(recordings, fitted));
  const double drive_width = same_level * (scale.drive_high - scale.drive_low);
  const double frequency_width = same_level * (scale.frequency_high - scale.frequency_low);
  std::vector<Condition> result;
  for (const std::size_t index : fitted) {
    const Recording& recording = recordings[index];
    const double drive = recording.drive.empty()
                             ? 0.0
                             : std::accumulate(recording.drive.begin(), recording.drive.end(), 0.0) /
                                   static_cast<double>(recording.size());
    const double frequency = dominant_frequency(recording);
    const auto known = std::ranges::find_if(result, [&](const Condition& condition) {
      return std::fabs(condition.drive - drive) <= drive_width &&
             std::fabs(condition.frequency - frequency) <= frequency_width;
    });
    if (known == result.end()) {
      result.push_back({drive, frequency, {index}, 0.0, {}});
    } else {
      known->recordings.push_back(index);
    }
  }
  return result;
}

double law_value(const ParameterLaw& law, const std::vector<double>& nodes, const Condition& condition) {
  const std::vector<double> weights = Layout::weights<double>(law, condition.drive, condition.frequency, {});
  return std::inner_product(weights.begin(), weights.end(), nodes.begin(), 0.0);
}

double sigma_of(const ConditionValue& value, const Parameter& card) {
  return value.std_error ? std::max(*value.std_error, 0.01 * std::fabs(value.value)) : card.box.upper - card.box.lower;
}

// Distance between two values as a share of the box.
double box_share(const Parameter& card, double a, double b) {
  if (card.scale == Scale::logarithmic) {
    return (std::log(std::max(a, card.box.lower)) - std::log(std::max(b, card.box.lower))) /
           std::log(card.box.upper / card.box.lower);
  }
  return (a - b) / (card.box.upper - card.box.lower);
}

// The fit of a condition with some parameters held.
struct ConditionFit {
  std::vector<ConditionValue> values;  // one per law; held ones without an error
  double nrmse;
};

}  // namespace

std::vector<double> law_through(const ParameterLaw& law, const Parameter& card,
                                const std::vector<Condition>& conditions, const std::vector<ConditionValue>& values) {
  const auto rows = static_cast<Eigen::Index>(values.size());
  const auto columns = static_cast<Eigen::Index>(law.count());
  Eigen::MatrixXd matrix(rows, columns);
  Eigen::VectorXd right(rows);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const auto at = static_cast<std::size_t>(r);
    const std::vector<double> weights =
        Layout::weights<double>(law, conditions[at].drive, conditions[at].frequency, {});
    const double sigma = sigma_of(values[at], card);
    for (Eigen::Index c = 0; c < columns; ++c) {
      matrix(r, c) = weights[static_cast<std::size_t>(c)] / sigma;
    }
    right[r] = values[at].value / sigma;
  }
  const Eigen::VectorXd nodes = matrix.completeOrthogonalDecomposition().solve(right);
  std::vector<double> result;
  for (const double node : nodes) {
    result.push_back(std::clamp(node, card.box.lower, card.box.upper));
  }
  return result;
}

TwoStage fit_two_stage(const Campaign& campaign, const Layout& layout, const std::vector<std::size_t>& fitted,
                       const std::vector<std::size_t>& heldout, const SolverEntry& solver,
                       const IdentifyOptions& options, const Progress& progress) {
  TwoStage result;
  result.conditions = conditions_of(campaign.recordings, fitted);
  const std::vector<ParameterLaw>& laws = layout.laws();
  const std::vector<Parameter>& cards = layout.cards();
  for (const ParameterLaw& law : laws) {
    if (std::ranges::any_of(law.condition_nodes, [](const auto& nodes) { return nodes.size() > 1; })) {
      throw OptionError(Option::stages + " two: " + layout.names()[law.parameter] +
                        " follows a condition, expected laws in drive and frequency only");
    }
    const std::size_t coefficients = law.count();
    if (result.conditions.size() < coefficients) {
      throw OptionError(Option::stages + " two: the law of " + layout.names()[law.parameter] + " has " +
                        std::to_string(coefficients) + " coefficients, the fitted recordings only " +
                        std::to_string(result.conditions.size()) + " conditions of drive level and frequency");
    }
  }
  const auto samples_of = [&](const std::vector<std::size_t>& indices) {
    std::size_t samples = 0;
    for (const std::size_t index : indices) {
      samples += campaign.recordings[index].size();
    }
    return samples;
  };
  const std::size_t all_samples = std::max<std::size_t>(samples_of(fitted), 1);
  const DataScale scale = scale_of(pick(campaign.recordings, fitted));
  std::size_t spent = 0;                                // samples marched
  std::vector<std::vector<double>> nodes(laws.size());  // of frozen laws

  const auto fit = [&](const Condition& condition, const SolverEntry& entry, const std::vector<ConditionValue>& from,
                       std::size_t budget, const std::string& stage) {
    LayoutOptions held;
    for (std::size_t j = 0; j < cards.size(); ++j) {
      held.fix[layout.names()[j]] = layout.held()[j];
    }
    std::size_t free = 0;
    for (std::size_t l = 0; l < laws.size(); ++l) {
      const std::string& name = layout.names()[laws[l].parameter];
      const Parameter& card = cards[laws[l].parameter];
      held.bounds[name] = {card.box.lower, card.box.upper};
      held.fix.erase(name);
      if (!nodes[l].empty()) {
        held.fix[name] = law_value(laws[l], nodes[l], condition);
      } else {
        ++free;
      }
    }
    const std::vector<Recording> recordings = pick(campaign.recordings, condition.recordings);
    const Layout own(layout.model(), scale, held);
    const Objective objective(own, recordings, options.objective);
    ConditionFit done{std::vector<ConditionValue>(laws.size()), 0.0};
    for (std::size_t l = 0; l < laws.size(); ++l) {
      if (!nodes[l].empty()) {
        done.values[l].value = held.fix[layout.names()[laws[l].parameter]];
      }
    }
    if (free == 0) {
      done.nrmse = predicted_nrmse(own, {}, refer_to(recordings), options.objective);
      return done;
    }
    std::vector<double> start = own.initial();
    for (std::size_t c = 0; c < own.dimension() && !from.empty(); ++c) {
      const auto law = std::ranges::find(laws, own.coordinates()[c].parameter, &ParameterLaw::parameter);
      start[c] = own.unit(c, from[static_cast<std::size_t>(law - laws.begin())].value);
    }
    IdentifyOptions with = options;
    with.budget = std::max<std::size_t>(budget, 1);
    if (&entry != &solver) {
      with.settings.clear();
    }
    const RunResult run = run_solver(
        entry, make_problem(objective, entry, with, stage, std::move(start)),
        [&](const Request& request) { return objective.evaluate(request); },
        [&](const RunResult& partial) { return !progress || progress(stage, partial); });
    if (run.best.empty() || run.cost >= diverged_cost) {
      throw_without_candidate(stage, run, own, options.layout);
    }
    spent += run.evaluations * samples_of(condition.recordings);
    Identification estimated{own, own.terms(run.best), {}, {}, 0, run.cost, {}, {}, {}, false, {}};
    estimate(estimated, objective, run.best, campaign.recordings.front().drive_kind);
    for (const Estimate& estimate : estimated.estimates) {
      const auto law = std::ranges::find(laws, estimate.term.parameter, &ParameterLaw::parameter);
      done.values[static_cast<std::size_t>(law - laws.begin())] = {estimate.term.value, estimate.std_error};
    }
    done.nrmse = run.cost;
    return done;
  };
  const auto overall_nrmse = [&](const std::vector<double>& of_conditions) {
    // Root mean square over recordings, of which a condition may hold several.
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t c = 0; c < of_conditions.size(); ++c) {
      const auto recordings = static_cast<double>(result.conditions[c].recordings.size());
      sum += recordings * of_conditions[c] * of_conditions[c];
      count += recordings;
    }
    return std::sqrt(sum / count);
  };

  std::vector<ConditionFit> current;
  std::vector<double> nrmse;
  for (std::size_t c = 0; c < result.conditions.size(); ++c) {
    Condition& condition = result.conditions[c];
    current.push_back(fit(condition, solver, {}, options.budget / 2, "stage one, condition " + std::to_string(c + 1)));
    condition.nrmse = current.back().nrmse;
    condition.values = current.back().values;
    nrmse.push_back(condition.nrmse);
  }
  result.nrmse_free = overall_nrmse(nrmse);

  const auto values_of = [&](std::size_t l) {
    std::vector<ConditionValue> values;
    values.reserve(current.size());
    for (const ConditionFit& one : current) {
      values.push_back(one.values[l]);
    }
    return values;
  };
  for (std::size_t step = 0; step < laws.size(); ++step) {
    std::size_t chosen = laws.size();
    double least = 0.0;
    bool chosen_constant = false;
    std::vector<double> chosen_nodes;
    for (std::size_t l = 0; l < laws.size(); ++l) {
      if (!nodes[l].empty()) {
        continue;
      }
      const Parameter& card = cards[laws[l].parameter];
      const std::vector<ConditionValue> values = values_of(l);
      const std::vector<double> through = law_through(laws[l], card, result.conditions, values);
      double squares = 0.0;
      double total = 0.0;
      for (std::size_t c = 0; c < values.size(); ++c) {
        const double weight = 1.0 / (sigma_of(values[c], card) * sigma_of(values[c], card));
        const double away = box_share(card, values[c].value, law_value(laws[l], through, result.conditions[c]));
        squares += weight * away * away;
        total += weight;
      }
      const double scatter = std::sqrt(squares / total);
      const bool constant = through.size() == 1;
      if (chosen == laws.size() || (constant && !chosen_constant) || (constant == chosen_constant && scatter < least)) {
        chosen = l;
        least = scatter;
        chosen_constant = constant;
        chosen_nodes = through;
      }
    }
    nodes[chosen] = chosen_nodes;
    for (std::size_t c = 0; c < result.conditions.size(); ++c) {
      current[c] = fit(result.conditions[c], *find_solver("lm"), current[c].values, options.budget / 2 / laws.size(),
                       "stage two, " + layout.names()[laws[chosen].parameter] + " frozen");
      nrmse[c] = current[c].nrmse;
    }
    result.steps.push_back({chosen, least, overall_nrmse(nrmse)});
  }

  result.point.resize(layout.dimension());
  for (std::size_t l = 0; l < laws.size(); ++l) {
    for (std::size_t k = 0; k < nodes[l].size(); ++k) {
      result.point[laws[l].first + k] = layout.unit(laws[l].first + k, nodes[l][k]);
    }
  }
  const std::vector<Term> terms = layout.terms(result.point);
  result.nrmse = predicted_nrmse(layout, terms, refer_to(campaign.recordings, fitted), options.objective);
  if (!heldout.empty()) {
    result.nrmse_heldout = predicted_nrmse(layout, terms, refer_to(campaign.recordings, heldout), options.objective,
                                           refer_to(campaign.recordings, fitted));
  }
  result.evaluations = (spent + all_samples - 1) / all_samples;
  return result;
}

}  // namespace hysteron

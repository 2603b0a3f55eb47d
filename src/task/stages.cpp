#include "task/stages.hpp"

#include <fmt/format.h>

#include "report/terminal.hpp"

namespace hysteron {

using nlohmann::json;

namespace {

constexpr int curve_points = 41;

// What the two stages are compared with.
const RunResult& joint_run(const Identification& joint) { return joint.solvers[joint.chosen].run; }

std::string order_text(const ParameterLaw& law) {
  const auto part = [](const char* of, std::size_t nodes) {
    return nodes < 2 ? std::string() : fmt::format("order {} in {}", nodes - 1, of);
  };
  const std::string drive = part("drive", law.drive_nodes.size());
  const std::string frequency = part("frequency", law.frequency_nodes.size());
  if (drive.empty() && frequency.empty()) {
    return "constant";
  }
  return drive + (drive.empty() || frequency.empty() ? "" : ", ") + frequency;
}

}  // namespace

json stages_json(const TwoStage& two, const Identification& joint, const Campaign& campaign) {
  const Layout& layout = joint.layout;
  const auto number = [](const std::optional<double>& value) { return value ? json(*value) : json(nullptr); };
  json conditions = json::array();
  for (const Condition& condition : two.conditions) {
    json files = json::array();
    for (const std::size_t index : condition.recordings) {
      files.push_back(campaign.recordings[index].file);
    }
    conditions.push_back({{"drive", condition.drive},
                          {"frequency", condition.frequency},
                          {"recordings", files},
                          {"nrmse_free", condition.nrmse}});
  }
  const std::vector<Term> two_terms = layout.terms(two.point);
  const std::vector<Term> joint_terms = layout.terms(joint_run(joint).best);
  json parameters = json::array();
  for (const FrozenParameter& step : two.steps) {
    const ParameterLaw& law = layout.laws()[step.law];
    json row = {{"name", layout.names()[law.parameter]},
                {"unit", layout.cards()[law.parameter].unit},
                {"law", order_text(law)},
                {"scatter", step.scatter},
                {"nrmse_when_frozen", step.nrmse},
                {"against", law.drive_nodes.size() == 1 && law.frequency_nodes.size() > 1 ? "frequency" : "drive"},
                {"free", json::array()}};
    for (const Condition& condition : two.conditions) {
      const ConditionValue& value = condition.values[step.law];
      row["free"].push_back({{"drive", condition.drive},
                             {"frequency", condition.frequency},
                             {"value", value.value},
                             {"std_error", number(value.std_error)}});
    }
    // Curves against the drive (frequency, for laws of frequency only), at the mean of the other.
    double mean_drive = 0.0;
    double mean_frequency = 0.0;
    double low = 1e300;
    double high = -1e300;
    const bool by_frequency = row["against"] == "frequency";
    for (const Condition& condition : two.conditions) {
      mean_drive += condition.drive / static_cast<double>(two.conditions.size());
      mean_frequency += condition.frequency / static_cast<double>(two.conditions.size());
      low = std::min(low, by_frequency ? condition.frequency : condition.drive);
      high = std::max(high, by_frequency ? condition.frequency : condition.drive);
    }
    json at = json::array();
    json two_curve = json::array();
    json joint_curve = json::array();
    for (int k = 0; k < curve_points; ++k) {
      const double x = low + (high - low) * k / (curve_points - 1);
      const double drive = by_frequency ? mean_drive : x;
      const double frequency = by_frequency ? x : mean_frequency;
      at.push_back(x);
      two_curve.push_back(parameters_at(layout.held(), two_terms, drive, frequency, {})[law.parameter]);
      joint_curve.push_back(parameters_at(layout.held(), joint_terms, drive, frequency, {})[law.parameter]);
    }
    row["curve"] = {{"at", at}, {"two_stages", two_curve}, {"joint", joint_curve}};
    parameters.push_back(std::move(row));
  }
  const std::optional<double>& joint_heldout = joint.solvers[joint.chosen].nrmse_heldout;
  json better = nullptr;
  if (two.nrmse_heldout && joint_heldout) {
    better = *two.nrmse_heldout < *joint_heldout ? "two stages" : "joint";
  }
  return {{"conditions", conditions},
          {"nrmse_free", two.nrmse_free},
          {"parameters", parameters},
          {"two_stages",
           {{"nrmse_fit", two.nrmse}, {"nrmse_heldout", number(two.nrmse_heldout)}, {"evaluations", two.evaluations}}},
          {"joint",
           {{"nrmse_fit", joint_run(joint).cost},
            {"nrmse_heldout", number(joint_heldout)},
            {"evaluations", joint_run(joint).evaluations}}},
          {"predicts_better", better}};
}

std::string stages_text(const TwoStage& two, const Identification& joint) {
  const auto number = [](const std::optional<double>& value) { return value ? format_number(*value, 4) : "-"; };
  const SolverOutcome& outcome = joint.solvers[joint.chosen];
  std::string text = fmt::format(
      "{}\n",
      table({"laws", "NRMSE fit", "NRMSE held out", "evaluations"},
            {{"every condition free", format_number(two.nrmse_free, 4), "-", "-"},
             {"two stages", format_number(two.nrmse, 4), number(two.nrmse_heldout), std::to_string(two.evaluations)},
             {"joint", format_number(outcome.run.cost, 4), number(outcome.nrmse_heldout),
              std::to_string(outcome.run.evaluations)}}));
  std::vector<std::vector<std::string>> rows;
  for (const FrozenParameter& step : two.steps) {
    const ParameterLaw& law = joint.layout.laws()[step.law];
    rows.push_back({joint.layout.names()[law.parameter], order_text(law), fmt::format("{:.1f}", 100.0 * step.scatter),
                    format_number(step.nrmse, 4)});
  }
  text +=
      "frozen on their laws one by one, the others fitted again at each condition; scatter: the free values about "
      "the law\n";
  return text + fmt::format("{}\n", table({"frozen", "law", "scatter [% of box]", "NRMSE then"}, rows));
}

}  // namespace hysteron

#include "external/answers.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "external/line_program.hpp"

namespace hysteron {

using nlohmann::json;

SolverAnswer solver_answer(const std::string& line, const std::string& id, std::size_t dimension) {
  const json answer = json::parse(line, nullptr, false);
  SolverAnswer result;
  const auto wrong = [&](const std::string& expected) {
    return WorkError("solver '" + id + "' " + printed(line) + ", expected " + expected);
  };
  if (answer.is_object() && answer.contains("stop") && answer.at("stop").is_string()) {
    // Which of them it means cannot be known, and points would be lost without a word.
    if (answer.contains("ask") && !answer.at("ask").empty()) {
      throw wrong(R"(either {"ask": [[...], ...]} or {"stop": "why"}, not both in one line)");
    }
    result.stop = answer.at("stop").get<std::string>();
    if (result.stop.empty()) result.stop = "its own end";
    return result;
  }
  if (!answer.is_object() || !answer.contains("ask") || !answer.at("ask").is_array() || answer.at("ask").empty()) {
    throw wrong(R"({"ask": [[...], ...]} with at least one point, or {"stop": "why"})");
  }
  for (const json& point : answer.at("ask")) {
    if (!point.is_array() || point.size() != dimension) {
      throw wrong("points of " + std::to_string(dimension) + " numbers");
    }
    for (const json& value : point) {
      if (!value.is_number() || !(value.get<double>() >= 0.0 && value.get<double>() <= 1.0)) {
        throw wrong("coordinates from 0 to 1");
      }
      result.points.push_back(value.get<double>());
    }
  }
  return result;
}

std::vector<std::optional<double>> objective_answer(const std::string& line, std::size_t points) {
  const json answer = json::parse(line, nullptr, false);
  const auto wrong = [&](const std::string& expected) {
    return WorkError("the objective " + printed(line) + ", expected " + expected);
  };
  if (!answer.is_object() || !answer.contains("costs") || !answer.at("costs").is_array()) {
    throw wrong(R"({"costs": [...]})");
  }
  const json& costs = answer.at("costs");
  if (costs.size() != points) {
    throw wrong(std::to_string(points) + " costs, got " + std::to_string(costs.size()));
  }
  std::vector<std::optional<double>> result;
  for (const json& cost : costs) {
    if (!cost.is_number() && !cost.is_null()) throw wrong("numbers, or null where there is no cost");
    result.push_back(cost.is_null() ? std::nullopt : std::optional(cost.get<double>()));
  }
  return result;
}

}  // namespace hysteron

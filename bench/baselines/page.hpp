// Scores of baselines beside those of the program, and the page of them.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace hysteron::baselines {

// Methods, and what they count as values.
constexpr const char* tests = "F tests, all that hold";
constexpr const char* strongest_test = "F tests, the strongest";
constexpr const char* selection = "forward selection, BIC";
constexpr const char* sparse = "sparse regression";
constexpr const char* samples = "samples";
constexpr const char* independent = "independent values";

class Scores {
 public:
  // A campaign's sealed answer, {method: {count: statement}} and what the program said; statements as diagnosis.json.
  void add(const nlohmann::json& answer, const nlohmann::json& said, const nlohmann::json& diagnosis);
  // `command`: what made it.
  [[nodiscard]] std::string page(const std::string& command) const;

 private:
  // Scored campaigns by method and count, then level.
  std::map<std::pair<std::string, std::string>, std::map<std::string, nlohmann::json>> scored_;
};

}  // namespace hysteron::baselines

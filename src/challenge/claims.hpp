// What a diagnosis states: names, sets and suggestions, of either schema of diagnosis.json.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace hysteron::challenge {

using Names = std::set<std::string>;

[[nodiscard]] Names names_in(const nlohmann::json& list);
[[nodiscard]] bool meet(const Names& a, const Names& b);
// A number of a member that may be missing or null.
[[nodiscard]] nlohmann::json number_of(const nlohmann::json& object, const char* key);

// Grades of the schema hysteron.diagnosis/2; schema 1 has names without a grade.
enum class Grade { established, supported, suggested, ungraded };

// One statement of a diagnosis: an id with those it cannot be told from.
struct Claim {
  std::string id;
  Names set;  // with the id
  Grade grade = Grade::ungraded;
  bool name = false;  // counts as a name, alone or as a set: supported or better; of schema 1 under missing-physics
  bool right = false;
  nlohmann::json confidence;
};
// {"id","set","grade","confidence","name","right"}
[[nodiscard]] nlohmann::json json_of(const Claim& claim);

struct Claims {
  std::vector<Claim> all;
  Names definite;           // ids named without a rival
  std::vector<Names> sets;  // declared sets of candidates
  Names wrong;              // names, alone or as a set, that hold no accepted cause
};

// `accepted`: the causes that are there.
[[nodiscard]] Claims claims_of(const nlohmann::json& diagnosis, const Names& accepted);

}  // namespace hysteron::challenge

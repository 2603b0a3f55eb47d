#include "challenge/claims.hpp"

#include <algorithm>

namespace hysteron::challenge {

using nlohmann::json;

namespace {

Grade grade_of(const json& effect, bool suggestion) {
  if (suggestion) return Grade::suggested;
  const std::string word = effect.value("grade", "");
  if (word == "established") return Grade::established;
  if (word == "supported") return Grade::supported;
  return word == "suggested" ? Grade::suggested : Grade::ungraded;
}

json word_of(Grade grade) {
  switch (grade) {
    case Grade::established:
      return "established";
    case Grade::supported:
      return "supported";
    case Grade::suggested:
      return "suggested";
    case Grade::ungraded:
      break;
  }
  return nullptr;
}

}  // namespace

Names names_in(const json& list) {
  Names names;
  for (const json& name : list) names.insert(name.get<std::string>());
  return names;
}

bool meet(const Names& a, const Names& b) {
  return std::ranges::any_of(a, [&](const std::string& name) { return b.contains(name); });
}

// A number of a member that may be missing or null.
json number_of(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object.at(key).is_number()) return nullptr;
  return object.at(key);
}

json json_of(const Claim& claim) {
  return {
      {"id", claim.id},     {"set", claim.set},    {"grade", word_of(claim.grade)}, {"confidence", claim.confidence},
      {"name", claim.name}, {"right", claim.right}};
}

Claims claims_of(const json& diagnosis, const Names& accepted) {
  Claims claims;
  const bool asserted = diagnosis.at("verdict") == "missing-physics";
  const auto add = [&](const json& effect, bool suggestion) {
    Claim claim;
    claim.id = effect.at("id").get<std::string>();
    claim.set = names_in(effect.value("indistinguishable_from", json::array()));
    const bool alone = claim.set.empty();
    claim.set.insert(claim.id);
    claim.grade = grade_of(effect, suggestion);
    claim.name = claim.grade == Grade::ungraded ? asserted : claim.grade != Grade::suggested;
    claim.right = meet(claim.set, accepted);
    claim.confidence = number_of(effect, "confidence");
    if (claim.grade != Grade::suggested) {
      if (alone && claim.name) {
        claims.definite.insert(claim.id);
      } else {
        claims.sets.push_back(claim.set);
      }
    }
    if (claim.name && !claim.right) claims.wrong.insert(claim.id);
    // A set has a row for each of its members; it is stated once.
    const bool stated = std::ranges::any_of(claims.all, [&](const Claim& before) {
      return claim.set.size() > 1 && before.set == claim.set && before.grade == claim.grade;
    });
    if (!stated) claims.all.push_back(std::move(claim));
  };
  for (const json& effect : diagnosis.at("effects")) add(effect, false);
  for (const json& effect : diagnosis.value("suggestions", json::array())) add(effect, true);
  return claims;
}

}  // namespace hysteron::challenge

#include "challenge/score.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "challenge/claims.hpp"
#include "challenge/place.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;

struct Causes {
  Names known;       // of the catalogue, whether they can be seen or not
  Names detectable;  // of the catalogue
  bool foreign = false;
  bool any_detectable = false;
  double share = 0.0, left = 0.0;
};

Causes causes_of(const json& answer) {
  Causes causes;
  for (const json& effect : answer.at("effects")) {
    const auto id = effect.at("id").get<std::string>();
    const bool detectable = effect.at("detectability").get<double>() >= detectable_from;
    causes.any_detectable = causes.any_detectable || detectable;
    causes.share = std::max(causes.share, effect.at("share_of_peak").get<double>());
    causes.left = std::max(causes.left, effect.at("left_nrmse").get<double>());
    if (effect.at("foreign").get<bool>()) {
      causes.foreign = true;
      continue;
    }
    causes.known.insert(id);
    if (detectable) causes.detectable.insert(id);
  }
  return causes;
}

Outcome outcome_of(const json& answer, const json& diagnosis, const Causes& causes, const Claims& claims) {
  const auto verdict = diagnosis.at("verdict").get<std::string>();
  if (!claims.wrong.empty()) return Outcome::wrong;
  const bool has_sets = !claims.sets.empty();
  if (causes.detectable.empty()) {
    // Naming a cause that is there is right even where it was not expected.
    if (!claims.definite.empty()) return Outcome::right;
    if (std::ranges::any_of(claims.sets, [&](const Names& set) { return meet(set, causes.known); })) {
      return Outcome::in_set;
    }
    if (has_sets) return Outcome::abstained;
    // Refused: no name, and not complete.
    if (causes.foreign) return verdict != "complete" || !causes.any_detectable ? Outcome::right : Outcome::missed;
    if (answer.at("level") == "wrong-base") return Outcome::right;
    return verdict == "complete" ? Outcome::right : Outcome::abstained;
  }
  std::size_t named = 0;
  std::size_t listed = 0;
  for (const std::string& cause : causes.detectable) {
    if (claims.definite.contains(cause)) {
      ++named;
    } else if (std::ranges::any_of(claims.sets, [&](const Names& set) { return set.contains(cause); })) {
      ++listed;
    }
  }
  // Beside foreign causes one effect found is what can be asked for.
  if (named == causes.detectable.size() || (named > 0 && answer.at("level") == "beside")) return Outcome::right;
  if (listed > 0 && answer.at("level") == "beside") return Outcome::in_set;
  if (named + listed == causes.detectable.size()) return Outcome::in_set;
  if (named + listed > 0) return Outcome::part;
  return verdict == "complete" ? Outcome::missed : Outcome::abstained;
}

json parameter_errors(const json& answer, const json& diagnosis) {
  json result = json::array();
  for (const json& truth : answer.at("effects")) {
    for (const json& effect : diagnosis.at("effects")) {
      if (effect.at("id") != truth.at("id") || !effect.contains("parameters")) continue;
      for (const json& wanted : truth.at("parameters")) {
        for (const json& found : effect.at("parameters")) {
          if (found.at("name") != wanted.at("name") || !found.at("value").is_number()) continue;
          const double value = wanted.at("value").get<double>();
          const double got = found.at("value").get<double>();
          json row = {{"effect", truth.at("id")},
                      {"name", wanted.at("name")},
                      {"true", value},
                      {"found", got},
                      {"relative_error", (got - value) / std::abs(value)},
                      {"inside_ci95", nullptr}};
          if (found.contains("ci95") && found.at("ci95").is_array() && found.at("ci95").size() == 2 &&
              found.at("ci95")[0].is_number() && found.at("ci95")[1].is_number()) {
            row["inside_ci95"] =
                found.at("ci95")[0].get<double>() <= value && value <= found.at("ci95")[1].get<double>();
          }
          result.push_back(std::move(row));
        }
      }
    }
  }
  return result;
}

// Places that the diagnosis states, in its order, with the concentration of the true change there.
json places(const json& answer, const json& diagnosis) {
  json result = json::array();
  if (!answer.contains("places")) return result;
  for (const json& place : diagnosis.value("locations", json::array())) {
    const double samples = place.at("share_of_samples").get<double>();
    const double found = concentration(answer.at("places"), place.at("variable").get<std::string>(),
                                       place.at("from").get<double>(), place.at("to").get<double>());
    result.push_back({{"where", place.at("where")},
                      {"stated", samples > 0.0 ? place.at("share_of_misfit").get<double>() / samples : 0.0},
                      {"true", found},
                      {"right", found > place_from}});
  }
  return result;
}

}  // namespace

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::part:
      return "part";
    case Outcome::in_set:
      return "in a set";
    case Outcome::abstained:
      return "abstained";
    case Outcome::missed:
      return "missed";
    case Outcome::wrong:
      return "wrong";
    case Outcome::failed:
      return "failed";
  }
  return "";
}

json score_campaign(const json& answer, const json& diagnosis) {
  const Causes causes = causes_of(answer);
  json result = {{"campaign", answer.at("campaign")},
                 {"level", answer.at("level")},
                 {"design", answer.at("design")},
                 {"disturbance", answer.at("disturbance")},
                 {"truth", json::array()},
                 {"forms", answer.value("forms", json::array())},
                 {"foreign_power_over_strongest", number_of(answer, "foreign_power_over_strongest")},
                 {"answer", json::array()},
                 {"detectable", causes.any_detectable},
                 {"share_of_peak", causes.share},
                 {"left_over_noise", causes.left / answer.at("noise").at("share_of_peak").get<double>()},
                 {"floor", answer.at("floor_nrmse_heldout")},
                 {"named", json::array()},
                 {"wrong_names", json::array()},
                 {"candidates", json::array()},
                 {"places", json::array()},
                 {"parameters", json::array()}};
  for (const json& effect : answer.at("effects")) result["truth"].push_back(effect.at("id"));
  if (!diagnosis.is_object()) {
    result["outcome"] = name_of(Outcome::failed);
    result["detected"] = false;
    result["verdict"] = nullptr;
    result["nrmse_heldout_before"] = nullptr;
    result["nrmse_heldout_after"] = nullptr;
    return result;
  }
  Names accepted = names_in(answer.at("acceptable"));
  accepted.insert(causes.known.begin(), causes.known.end());
  const Claims claims = claims_of(diagnosis, accepted);
  result["outcome"] = name_of(outcome_of(answer, diagnosis, causes, claims));
  result["verdict"] = diagnosis.at("verdict");
  result["detected"] = diagnosis.at("verdict") != "complete";
  result["wrong_names"] = claims.wrong;
  result["places"] = places(answer, diagnosis);
  for (const Claim& claim : claims.all) {
    const json stated = json_of(claim);
    if (claim.set.size() == 1 && claim.name) {
      result["named"].push_back(stated);
    } else if (claim.grade != Grade::suggested) {
      result["candidates"].push_back(claim.id);
    }
    result["answer"].push_back(stated);
  }
  result["parameters"] = parameter_errors(answer, diagnosis);
  const json baseline = diagnosis.value("baseline", json::object());
  const json augmented = diagnosis.value("augmented", json::object());
  result["nrmse_heldout_before"] = number_of(baseline, "nrmse_heldout");
  result["nrmse_heldout_after"] = number_of(augmented, "nrmse_heldout");
  return result;
}

}  // namespace hysteron::challenge

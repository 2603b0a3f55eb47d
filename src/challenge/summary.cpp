#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "challenge/score.hpp"
#include "challenge/statistics.hpp"

namespace hysteron::challenge {
namespace {

using nlohmann::json;
using Filter = std::function<bool(const json&)>;

json rate(int hits, int trials) {
  const Bounds bounds = clopper_pearson(hits, trials);
  return {{"hits", hits},
          {"trials", trials},
          {"rate", trials > 0 ? json(static_cast<double>(hits) / trials) : json(nullptr)},
          {"low95", bounds.low},
          {"high95", bounds.high}};
}

int count(const json& campaigns, const Filter& filter) {
  return static_cast<int>(std::count_if(campaigns.begin(), campaigns.end(), filter));
}

Filter outcome_is(Outcome outcome) {
  return [outcome](const json& c) { return c.at("outcome") == name_of(outcome); };
}

// Counts of every outcome among the campaigns that pass, with the bounds of the rates that matter.
json outcomes(const json& campaigns, const Filter& filter) {
  json chosen = json::array();
  for (const json& c : campaigns) {
    if (filter(c)) chosen.push_back(c);
  }
  const int trials = static_cast<int>(chosen.size());
  const int right = count(chosen, outcome_is(Outcome::right));
  const int in_set = count(chosen, outcome_is(Outcome::in_set));
  return {{"campaigns", trials},
          {"right", right},
          {"part", count(chosen, outcome_is(Outcome::part))},
          {"in_set", in_set},
          {"abstained", count(chosen, outcome_is(Outcome::abstained))},
          {"missed", count(chosen, outcome_is(Outcome::missed))},
          {"wrong", count(chosen, outcome_is(Outcome::wrong))},
          {"failed", count(chosen, outcome_is(Outcome::failed))},
          {"detected", count(chosen, [](const json& c) { return c.at("detected").get<bool>(); })},
          {"rate_right", rate(right, trials)},
          {"rate_right_or_in_set", rate(right + in_set, trials)},
          {"rate_wrong", rate(count(chosen, outcome_is(Outcome::wrong)), trials)}};
}

std::string truth_of(const json& campaign) {
  if (campaign.at("truth").empty()) return "nothing";
  std::string text;
  for (const json& id : campaign.at("truth")) text += (text.empty() ? "" : " + ") + id.get<std::string>();
  return text;
}

// What a campaign was told: every name and every set, "end-stop + (set without it)"; without any the verdict.
std::string said_of(const json& campaign) {
  const json& truth = campaign.at("truth");
  std::string said;
  for (const json& stated : campaign.at("answer")) {
    if (stated.at("grade") == "suggested") continue;
    const json& set = stated.at("set");
    const bool holds = !truth.empty() && std::ranges::find(set, truth.at(0)) != set.end();
    const bool alone = set.size() == 1 && stated.at("name").get<bool>();
    said += (said.empty() ? "" : " + ") + (alone   ? stated.at("id").get<std::string>()
                                           : holds ? "(set with it)"
                                                   : "(set without it)");
  }
  if (!said.empty()) return said;
  return campaign.at("verdict").is_string() ? "(" + campaign.at("verdict").get<std::string>() + ")" : "(no diagnosis)";
}

// Rows: what was there (single causes only); columns: all that was said, each campaign once.
json confusion(const json& campaigns) {
  std::map<std::string, std::map<std::string, int>> table;
  for (const json& c : campaigns) {
    if (c.at("truth").size() > 1) continue;
    std::string truth = truth_of(c);
    if (truth != "nothing" && !c.at("detectable").get<bool>()) truth += " (cannot be seen)";
    ++table[truth][said_of(c)];
  }
  json result = json::array();
  for (const auto& [truth, row] : table) {
    json said = json::array();
    std::vector<std::pair<std::string, int>> ordered(row.begin(), row.end());
    std::ranges::stable_sort(ordered, [](const auto& a, const auto& b) { return a.second > b.second; });
    for (const auto& [name, number] : ordered) said.push_back({{"said", name}, {"count", number}});
    result.push_back({{"truth", truth}, {"said", said}});
  }
  return result;
}

// Stated probability against frequency, bin by bin: names and suggestions together, a set right where it holds a cause.
json reliability(const json& campaigns, const Filter& filter) {
  constexpr std::array<double, 9> edges = {0.0, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0};
  json result = json::array();
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    int trials = 0;
    int right = 0;
    double sum = 0.0;
    for (const json& c : campaigns) {
      if (!filter(c)) continue;
      for (const json& stated : c.at("answer")) {
        const bool counts = stated.at("name").get<bool>() || stated.at("grade").is_string();
        if (!counts || !stated.at("confidence").is_number()) continue;
        const double confidence = stated.at("confidence").get<double>();
        const bool last = b + 2 == edges.size();
        if (confidence < edges[b] || (last ? confidence > edges[b + 1] : confidence >= edges[b + 1])) continue;
        ++trials;
        sum += confidence;
        right += stated.at("right").get<bool>() ? 1 : 0;
      }
    }
    json row = {{"from", edges[b]}, {"to", edges[b + 1]}, {"right", rate(right, trials)}};
    row["mean_confidence"] = trials > 0 ? json(sum / trials) : json(nullptr);
    result.push_back(std::move(row));
  }
  return result;
}

// Names at supported or better over all campaigns, alone or as sets.
json names_stated(const json& campaigns) {
  int all = 0;
  int right = 0;
  for (const json& c : campaigns) {
    for (const json& stated : c.at("answer")) {
      if (!stated.at("name").get<bool>()) continue;
      ++all;
      right += stated.at("right").get<bool>() ? 1 : 0;
    }
  }
  return rate(right, all);
}

// Detection and naming over the size of single causes of the catalogue.
json by_size(const json& campaigns, const char* measure, const std::vector<double>& edges) {
  json result = json::array();
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    const auto inside = [&](const json& c) {
      const double size = c.at(measure).get<double>();
      return c.at("truth").size() == 1 && c.at("level") != "foreign" && c.at("level") != "unexcited" &&
             c.at("level") != "wrong-base" && size >= edges[b] && size < edges[b + 1];
    };
    json row = outcomes(campaigns, inside);
    row["from"] = edges[b];
    row["to"] = edges[b + 1];
    row["rate_detected"] = rate(row.at("detected").get<int>(), row.at("campaigns").get<int>());
    result.push_back(std::move(row));
  }
  return result;
}

// Of a parameter, or of all.
struct ParameterErrors {
  std::vector<double> relative;
  int inside = 0;
  int intervals = 0;

  void add(const json& row) {
    relative.push_back(std::abs(row.at("relative_error").get<double>()));
    if (row.at("inside_ci95").is_boolean()) {
      ++intervals;
      inside += row.at("inside_ci95").get<bool>() ? 1 : 0;
    }
  }
  [[nodiscard]] json summary(const std::string& name) const {
    return {{"parameter", name},
            {"count", relative.size()},
            {"median_relative_error", median(relative)},
            {"largest_relative_error", *std::ranges::max_element(relative)},
            {"inside_ci95", rate(inside, intervals)}};
  }
};

// By name; "all" is the last.
json parameters(const json& campaigns) {
  std::map<std::string, ParameterErrors> errors;
  ParameterErrors all;
  for (const json& c : campaigns) {
    for (const json& row : c.at("parameters")) {
      errors[row.at("effect").get<std::string>() + " " + row.at("name").get<std::string>()].add(row);
      all.add(row);
    }
  }
  json result = json::array();
  for (const auto& [name, of] : errors) {
    result.push_back(of.summary(name));
  }
  if (!errors.empty()) result.push_back(all.summary("all"));
  return result;
}

json heldout(const json& campaigns) {
  std::vector<double> before;
  std::vector<double> after;
  int within = 0;
  for (const json& c : campaigns) {
    if (c.at("outcome") != name_of(Outcome::right) || c.at("named").empty()) continue;
    if (!c.at("nrmse_heldout_after").is_number() || !c.at("nrmse_heldout_before").is_number()) continue;
    const double floor = c.at("floor").get<double>();
    before.push_back(c.at("nrmse_heldout_before").get<double>() / floor);
    after.push_back(c.at("nrmse_heldout_after").get<double>() / floor);
    within += after.back() <= 1.1 ? 1 : 0;
  }
  json result = {{"named_cases", after.size()},
                 {"median_before_over_floor", nullptr},
                 {"median_after_over_floor", nullptr},
                 {"within_10_percent_of_floor", rate(within, static_cast<int>(after.size()))}};
  if (!after.empty()) {
    result["median_before_over_floor"] = median(before);
    result["median_after_over_floor"] = median(after);
  }
  return result;
}

// Stated places of causes that can be seen.
json places(const json& campaigns) {
  int all = 0;
  int all_right = 0;
  int first = 0;
  int first_right = 0;
  for (const json& c : campaigns) {
    if (!c.at("detectable").get<bool>() || c.at("places").empty()) continue;
    ++first;
    first_right += c.at("places").at(0).at("right").get<bool>() ? 1 : 0;
    for (const json& place : c.at("places")) {
      ++all;
      all_right += place.at("right").get<bool>() ? 1 : 0;
    }
  }
  return {{"first", rate(first_right, first)}, {"all", rate(all_right, all)}};
}

}  // namespace

json rate_of(int hits, int trials) { return rate(hits, trials); }

json reliability_of(const json& campaigns) {
  return reliability(campaigns, [](const json&) { return true; });
}

json summarise(const json& campaigns) {
  const auto of_level = [](const std::string& level) {
    return [level](const json& c) { return c.at("level") == level; };
  };
  json result = {{"all", outcomes(campaigns, [](const json&) { return true; })},
                 {"levels", json::array()},
                 {"effects", json::array()},
                 {"disturbances", json::array()}};
  for (const char* level :
       {"plain", "buried", "absorbed", "pairs", "wrong-base", "foreign", "beside", "none", "unexcited"}) {
    json row = outcomes(campaigns, of_level(level));
    if (row.at("campaigns") == 0) continue;
    row["level"] = level;
    result["levels"].push_back(std::move(row));
  }
  std::map<std::string, int> ids;
  std::map<std::string, int> disturbances;
  for (const json& c : campaigns) {
    for (const json& id : c.at("truth")) ids[id.get<std::string>()] = 1;
    if (c.at("level") == "none") disturbances[c.at("disturbance").get<std::string>()] = 1;
  }
  // Every form where it was hidden, alone or not; right: a name, alone or as a set, holds its effect.
  std::map<std::string, std::pair<int, int>> forms;
  for (const json& c : campaigns) {
    for (std::size_t k = 0; k < c.at("forms").size(); ++k) {
      const auto form = c.at("forms").at(k).get<std::string>();
      if (form.starts_with("foreign:")) continue;
      const auto& answer = c.at("answer");
      const bool found = std::any_of(answer.begin(), answer.end(), [&](const json& stated) {
        const json& set = stated.at("set");
        return stated.at("name").get<bool>() && std::find(set.begin(), set.end(), c.at("truth").at(k)) != set.end();
      });
      forms[form].first += found ? 1 : 0;
      ++forms[form].second;
    }
  }
  result["forms"] = json::array();
  for (const auto& [form, counts] : forms) {
    result["forms"].push_back({{"form", form}, {"named", rate(counts.first, counts.second)}});
  }
  for (const auto& [id, ignored] : ids) {
    json row = outcomes(campaigns, [&, name = id](const json& c) {
      return c.at("truth").size() == 1 && c.at("truth")[0] == name && c.at("detectable").get<bool>();
    });
    row["effect"] = id;
    result["effects"].push_back(std::move(row));
  }
  for (const auto& [name, ignored] : disturbances) {
    json row = outcomes(campaigns, [&, wanted = name](const json& c) {
      return c.at("level") == "none" && c.at("disturbance") == wanted;
    });
    row["disturbance"] = name;
    result["disturbances"].push_back(std::move(row));
  }
  const int controls = count(campaigns, of_level("none"));
  const auto any_name = [](const json& c) {
    return c.at("level") == "none" && (!c.at("named").empty() || !c.at("candidates").empty());
  };
  result["negative_controls"] = {
      {"definite_name",
       rate(count(campaigns, [](const json& c) { return c.at("level") == "none" && !c.at("named").empty(); }),
            controls)},
      {"any_name", rate(count(campaigns, any_name), controls)}};
  result["detectable_plain"] =
      outcomes(campaigns, [](const json& c) { return c.at("level") == "plain" && c.at("detectable").get<bool>(); });
  result["confusion"] = confusion(campaigns);
  result["names"] = names_stated(campaigns);
  result["catalogue"] = outcomes(campaigns, [](const json& c) {
    const json& truth = c.at("truth");
    return c.at("detectable").get<bool>() && std::any_of(truth.begin(), truth.end(), [](const json& id) {
             return !id.get<std::string>().starts_with("foreign:");
           });
  });
  result["reliability"] = reliability_of(campaigns);
  result["reliability_by_level"] = json::array();
  for (const json& level : result.at("levels")) {
    const std::string name = level.at("level");
    result["reliability_by_level"].push_back({{"level", name}, {"bins", reliability(campaigns, of_level(name))}});
  }
  result["by_share_of_peak"] = by_size(campaigns, "share_of_peak", {0.0, 0.02, 0.04, 0.08, 0.15, 1e9});
  result["by_left_over_noise"] = by_size(campaigns, "left_over_noise", {0.0, 0.1, 0.3, 1.0, 3.0, 1e9});
  result["parameters"] = parameters(campaigns);
  result["heldout"] = heldout(campaigns);
  result["places"] = places(campaigns);
  return result;
}

}  // namespace hysteron::challenge

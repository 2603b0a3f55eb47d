#include "study/times.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "study/quantile.hpp"

namespace hysteron {

using nlohmann::json;

json analyse_times(const json& plan, const json& analysis, const std::vector<RunRecord>& records,
                   const std::vector<RunTiming>& timings) {
  std::map<std::string, const RunTiming*> by_key;
  for (const RunTiming& timing : timings) by_key[timing.key] = &timing;
  std::map<std::string, const RunRecord*> results;
  for (const RunRecord& record : records) results[record.key] = &record;
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::vector<double>, double>> cells;
  double total = 0.0;
  std::map<std::string, std::size_t> hosts;
  for (const json& run : plan.at("runs")) {
    const auto key = run.at("key").get<std::string>();
    const auto timing = by_key.find(key);
    const auto record = results.find(key);
    if (timing == by_key.end() || record == results.end()) continue;
    auto& [seconds, evaluations] = cells[{run.at("problem").get<std::size_t>(), run.at("solver").get<std::size_t>()}];
    seconds.push_back(timing->second->seconds);
    evaluations += static_cast<double>(record->second->evaluations);
    total += timing->second->seconds;
    ++hosts[timing->second->host];
  }
  std::map<std::pair<std::size_t, std::size_t>, double> to_target;
  json target = nullptr;
  for (const json& row : analysis.at("fixed_target")) {
    if (target.is_null()) target = row.at("target");
    if (row.at("target") != target || row.at("ert").is_null()) continue;
    to_target[{row.at("problem").get<std::size_t>(), row.at("solver").get<std::size_t>()}] =
        row.at("ert").get<double>();
  }
  json rows = json::array();
  for (const auto& [where, what] : cells) {
    const auto expected = to_target.find(where);
    const double sum = std::accumulate(what.first.begin(), what.first.end(), 0.0);
    rows.push_back({{"problem", where.first},
                    {"solver", where.second},
                    {"runs", what.first.size()},
                    {"seconds_median", quantile(what.first, 0.5)},
                    {"seconds_total", sum},
                    {"evaluations_total", what.second},
                    {"microseconds_per_evaluation", what.second > 0.0 ? json(1e6 * sum / what.second) : json(nullptr)},
                    {"seconds_to_target", what.second > 0.0 && expected != to_target.end()
                                              ? json(expected->second * sum / what.second)
                                              : json(nullptr)}});
  }
  return {{"schema", "hysteron.study-times/1"},
          {"target", target},
          {"seconds_total", total},
          {"runs_by_host", hosts},
          {"rows", rows}};
}

}  // namespace hysteron

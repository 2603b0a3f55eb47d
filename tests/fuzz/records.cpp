// The plan and the records of a study with checksums that fit, and the report that is made of them. The first line of
// the input is the plan, in which #K stands for the key of the K-th record; the others are records, as JSON.
#include <nlohmann/json.hpp>
#include <vector>

#include "io/sha256.hpp"
#include "report/study.hpp"
#include "study/store.hpp"
#include "target.hpp"
#include "task/study.hpp"

namespace {

using namespace hysteron;
using nlohmann::json;

// What the types of the store's columns leave of a line.
RunRecord record_of(const json& line, const std::string& config) {
  const auto number = [&](const char* name) -> std::optional<double> {
    return line.contains(name) && line.at(name).is_number() ? std::optional(line.at(name).get<double>()) : std::nullopt;
  };
  const auto text = [&](const char* name) {
    return line.contains(name) && line.at(name).is_string() ? line.at(name).get<std::string>() : std::string();
  };
  RunRecord record;
  record.config = config;
  record.key = sha256_hex(config);
  record.nrmse = number("nrmse");
  record.nrmse_tight = number("nrmse_tight");
  record.nrmse_heldout = number("nrmse_heldout");
  if (line.contains("evaluations") && line.at("evaluations").is_number_integer()) {
    record.evaluations = line.at("evaluations").get<std::size_t>();
  }
  record.stopped = text("stopped");
  record.parameters = text("parameters");
  if (line.contains("trace") && line.at("trace").is_array()) {
    for (const json& point : line.at("trace")) {
      if (point.is_array() && point.size() == 2 && point[0].is_number_integer() && point[1].is_number()) {
        record.trace.push_back({point[0].get<std::size_t>(), point[1].get<double>()});
      }
    }
  }
  return record;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view left = fuzz::text_of(data, size);
  const auto next_line = [&] {
    const std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(std::min(left.size(), line.size() + 1));
    return line;
  };
  const std::string plan(next_line());
  std::vector<Entry> entries;
  std::string named;
  while (!left.empty()) {
    const json line = json::parse(next_line(), nullptr, false);
    if (!line.is_object()) continue;
    const RunRecord record = record_of(line, std::to_string(entries.size()));
    entries.push_back({record, {record.key, 0.25, "host", 1, 0}});
  }
  for (std::size_t at = 0; at < plan.size(); ++at) {
    const std::size_t k = plan[at] == '#' && at + 1 < plan.size() ? static_cast<std::size_t>(plan[at + 1] - '0') : 10;
    if (k < std::min<std::size_t>(10, entries.size())) {
      named += entries[k].record.key;
      ++at;
    } else {
      named += plan[at];
    }
  }
  fuzz::taken([&] {
    Store store = Store::memory();
    store.add(entries);
    const StudyView view = view_of(named, std::nullopt, store.records(), store.timings(), "study");
    static_cast<void>(study_report("study", view, {.times = true, .ioh = true, .mat = true}));
    static_cast<void>(study_terminal(view.analysis, view.times));
  });
  return 0;
}

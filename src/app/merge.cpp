// hysteron merge: one store from the stores of shards.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "app/command.hpp"
#include "app/result.hpp"
#include "app/study_output.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "study/gather.hpp"

namespace hysteron::app {

void add_merge(CLI::App& program) {
  struct Options {
    std::vector<std::string> parts;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("merge", "one study from the folders of its shards");
  command->add_option("DIR", options->parts, "folders written by `hysteron bench --shard`")->required();
  command->add_option("--out", options->out, "folder of the whole study; one that exists is added to")->required();
  command->footer("Example:\n  hysteron merge part1 part2 part3 --out whole");
  command->callback([options] {
    refuse_standard_output(options->out, "the records of a study");
    refuse_other_results(options->out, "store.sqlite");
    // Everything is read and compared before anything is written.
    std::string plan;
    std::string plan_from;
    std::map<std::string, std::pair<RunRecord, std::string>> records;
    std::map<std::string, RunTiming> timings;
    std::map<std::string, std::string> problems;
    const auto take = [&](const Store& store, const std::string& folder) {
      const auto own = store.plan();
      if (!own) throw InputError(folder, 0, "the store holds no plan, expected a study begun with `hysteron bench`");
      if (plan.empty()) {
        plan = *own;
        plan_from = folder;
      } else if (plan != *own) {
        throw InputError(folder, 0, "is of another study than " + plan_from + ", expected shards of one study file");
      }
      for (RunRecord& record : store.records()) {
        const auto found = records.find(record.key);
        if (found == records.end()) {
          const std::string key = record.key;
          records.emplace(key, std::pair{std::move(record), folder});
        } else if (record_text(found->second.first) != record_text(record)) {
          throw InputError(folder, 0,
                           "run " + record.key.substr(0, 12) + " has another result than in " + found->second.second +
                               ": the same configuration must give the same bytes; were they run by different builds?");
        }
      }
      for (RunTiming& timing : store.timings()) timings.emplace(timing.key, timing);
      for (auto& [hash, config] : store.problems()) problems.emplace(hash, config);
    };
    for (const std::string& part : options->parts) take(open_gathered(part), part);
    Store whole = Store::open(options->out, Store::Mode::write);
    if (whole.plan()) take(whole, options->out);
    whole.set_plan(plan);
    for (const auto& [hash, config] : problems) whole.add_problem(hash, config);
    for (const auto& [key, record] : records)
      whole.add(record.first, timings.contains(key) ? timings.at(key) : RunTiming{key, 0.0, {}, 1, 0});
    const StudyView view = view_of(whole, whole.records(), options->out);
    fmt::print("{} of {} runs in {}\n", view.analysis.at("done").get<std::size_t>(),
               view.analysis.at("planned").get<std::size_t>(), printable(options->out));
  });
}

}  // namespace hysteron::app

// What simpler methods would have said of the campaigns of a challenge, beside what the program said:
//
//   hysteron_baselines FOLDER... --out DIR [--most N] [--threads N] [--page results/baselines.md]
//
// FOLDER is an --out of `hysteron challenge`, diagnosed. Every campaign with a diagnosis (of each level the first N) is
// prepared as `hysteron diagnose` does, its base law fitted, and three methods asked which effects are missing: F tests
// of each effect refitted behind the base, forward selection by the Bayesian information criterion, sparse regression
// of the base's residual. Each counts its values twice: samples, as is usual, and the independent ones that the program
// counts. What they say is kept in DIR, so that a rerun resumes; the answers are opened only to score.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "baselines/page.hpp"
#include "baselines/sparse.hpp"
#include "baselines/stepwise.hpp"
#include "bench/page.hpp"
#include "bench/program.hpp"
#include "challenge/score.hpp"
#include "challenge/seal.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/search/observe.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/workbenches.hpp"
#include "io/campaign.hpp"
#include "io/file.hpp"
#include "io/output.hpp"

namespace {

using namespace hysteron;
using nlohmann::json;

constexpr double level_of_tests = 0.05;
constexpr std::size_t most_effects = 5;  // as of a diagnosis
constexpr int all_campaigns = 9999;
constexpr std::size_t base_budget = 20000;

// A statement as the score reads it: names are asserted, each alone or with those it cannot be told from.
json said(const std::vector<std::set<std::string>>& names, bool something_is_left = false) {
  json effects = json::array();
  for (const std::set<std::string>& name : names) {
    json others = json::array();
    for (auto other = std::next(name.begin()); other != name.end(); ++other) {
      others.push_back(*other);
    }
    effects.push_back({{"id", *name.begin()}, {"grade", "established"}, {"indistinguishable_from", others}});
  }
  return {{"verdict", !names.empty() ? "missing-physics" : (something_is_left ? "unattributed" : "complete")},
          {"effects", effects}};
}

json said(const std::vector<std::string>& names) {
  std::vector<std::set<std::string>> alone;
  for (const std::string& name : names) {
    alone.push_back({name});
  }
  return said(alone);
}

json said_of_terms(const std::vector<std::size_t>& terms) {
  std::vector<std::set<std::string>> names;
  for (const std::size_t term : terms) {
    const std::vector<std::string_view>& effects = baselines::library()[term].effects;
    const std::set<std::string> name(effects.begin(), effects.end());
    if (!name.empty() && std::ranges::find(names, name) == names.end()) {
      names.push_back(name);
    }
  }
  return said(names, !terms.empty());
}

// What each method says of a campaign, by its name.
json asked(const std::filesystem::path& folder, int threads) {
  Campaign campaign = load_campaign({folder.string()});
  without_outliers(campaign);
  DiagnoseOptions options;
  options.model = campaign.model;
  options.layout.by_current = campaign.by_current;
  options.layout.by_frequency = campaign.by_frequency;
  options.objective.threads = threads;
  std::vector<std::string> notes;
  const Workbenches benches = workbenches_of(campaign, split_of(campaign), options, notes);
  const Workbench& bench = benches.quick;
  std::vector<std::string> effects;
  for (const Part* effect : effect_catalogue()) {
    if (!excluded_by_inputs(std::string(effect->id), benches.whole.split().fit)) {
      effects.emplace_back(effect->id);
    }
  }
  const Fit base = bench.from_anywhere({options.model, {}, {}}, base_budget);
  const Residuals left = bench.residuals(base);
  const std::vector<Fit> first = baselines::refits(bench, base, effects);
  std::vector<baselines::Step> steps;
  for (const Fit& fit : first) {
    steps.push_back(baselines::step_of(base, fit));
  }
  const baselines::Regression regression = baselines::regression_of(bench, base, left);
  json result;
  for (const auto& [count, values] :
       {std::pair{baselines::samples, static_cast<double>(regression.samples)},
        std::pair{baselines::independent, misfit_of(bench.split().fit, left).independent}}) {
    std::vector<std::string> names = baselines::significant(steps, values, level_of_tests);
    result[baselines::tests][count] = said(names);
    names.resize(std::min<std::size_t>(names.size(), 1));
    result[baselines::strongest_test][count] = said(names);
    result[baselines::selection][count] = said(baselines::forward(bench, base, first, effects, values, most_effects));
    result[baselines::sparse][count] = said_of_terms(baselines::chosen_terms(regression, values));
  }
  return result;
}

int run(int argc, char** argv) {
  CLI::App program("what simpler methods would have said of the campaigns of a challenge");
  std::vector<std::string> folders;
  std::string out;
  std::string page;
  int threads = 1;
  int most = all_campaigns;
  program.add_option("FOLDER", folders, "--out of a challenge, diagnosed")->required()->check(CLI::ExistingDirectory);
  program.add_option("--out", out, "folder that keeps what was said")->required();
  program.add_option("--page", page, "page to write; else printed");
  program.add_option("--most", most, "campaigns of each level in a folder")->check(CLI::Range(1, all_campaigns));
  program.add_option("--threads", threads, "worker threads")->check(CLI::Range(1, 1024));
  CLI11_PARSE(program, argc, argv);

  baselines::Scores scores;
  for (const std::filesystem::path folder : folders) {
    const json answers = challenge::open_seal(folder);
    const std::filesystem::path kept = std::filesystem::path(out) / std::filesystem::canonical(folder).filename();
    make_output_folder(kept);
    std::map<std::string, int> of_level;
    for (const json& answer : answers.at("campaigns")) {
      const std::string name = answer.at("campaign");
      const std::filesystem::path diagnosis = folder / "diagnoses" / name / "diagnosis.json";
      if (!std::filesystem::exists(diagnosis) || ++of_level[answer.at("level")] > most) {
        continue;
      }
      const std::filesystem::path file = kept / (name + ".json");
      if (!std::filesystem::exists(file)) {
        write_file_atomically(file, asked(folder / name, threads).dump(1) + "\n");
        fmt::print(stderr, "{}\n", file.string());
      }
      scores.add(answer, json::parse(read_file(file)), json::parse(read_file(diagnosis)));
    }
  }
  std::string command = "hysteron_baselines";
  for (const std::filesystem::path folder : folders) {
    command += " " + std::filesystem::canonical(folder).filename().string();
  }
  command +=
      " --out DIR" + (most < all_campaigns ? " --most " + std::to_string(most) : "") + " --page results/baselines.md";
  const std::string text = scores.page(command);
  bench::write_page(page, text);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }

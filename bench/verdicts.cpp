// The verdicts of a challenge once more, from the evidence that its diagnoses hold: what a change of their rules would
// do to all campaigns, in a second. Nothing is searched or fitted, so that what a rule makes the search do (another law
// in place of the one asked for, an extended model) is as it was.
//
//   hysteron_verdicts FOLDER... [--list] [--write]
//   hysteron_verdicts FOLDER --plain
//
// FOLDER is an --out of `hysteron challenge`, diagnosed; with --list every campaign that is not right is a line, and a
// star marks those whose outcome is another than with the verdict they hold. --write puts the verdicts into the
// diagnoses, without their sentences and parameters, for `hysteron challenge --score-only`. --plain wants no challenge:
// every diagnosis.json anywhere below FOLDER that holds evidence is judged, and the verdicts are printed as JSON by the
// folders they stand in.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "challenge/score.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "diagnose/judge/evidence.hpp"
#include "diagnose/judge/verdict.hpp"
#include "diagnose/search/relatives.hpp"
#include "io/file.hpp"
#include "io/output.hpp"

namespace {

using nlohmann::json;

// What the score asks of a diagnosis.
json diagnosis_with(const hysteron::Verdict& verdict) {
  const auto rows_of = [](const std::vector<hysteron::Named>& names) {
    json rows = json::array();
    for (const hysteron::Named& named : names) {
      rows.push_back({{"id", named.id},
                      {"grade", name_of(named.grade)},
                      {"confidence", named.confidence},
                      {"indistinguishable_from", named.indistinguishable_from}});
    }
    return rows;
  };
  return {{"verdict", name_of(verdict.answer)},
          {"effects", rows_of(verdict.effects)},
          {"suggestions", rows_of(verdict.suggestions)}};
}

// Whether a diagnosis holds what a verdict rests on.
bool has_evidence(const json& diagnosis) {
  return diagnosis.contains("evidence") && diagnosis.at("evidence").contains("doubt_of_data");
}

json judged_again(const json& diagnosis) {
  return diagnosis_with(hysteron::verdict_of(hysteron::evidence_from(diagnosis.at("evidence"))));
}

// {"folder below the given one": {"verdict", "effects", "suggestions"}, ...}
json verdicts_below(const std::filesystem::path& folder) {
  json result = json::object();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().filename() != "diagnosis.json") {
      continue;
    }
    const json diagnosis = json::parse(hysteron::read_file(entry.path()));
    if (has_evidence(diagnosis)) {
      const std::filesystem::path below = std::filesystem::relative(entry.path().parent_path(), folder);
      result[below.generic_string()] = judged_again(diagnosis);
    }
  }
  return result;
}

std::string listed(const json& names) {
  std::string text;
  for (const json& name : names) {
    text += (text.empty() ? "" : " ") + (name.is_object() ? name.at("id") : name).get<std::string>();
  }
  return text.empty() ? "-" : text;
}

// Whether the search refits the true effect or a related one where the first order ranks all of them: what it leaves
// out there can be named no more.
struct FirstLooks {
  int campaigns = 0;
  int held = 0;
  std::string missed;

  void count(const json& answer, const hysteron::Evidence& evidence) {
    constexpr double seen = 10.0;
    const json& effects = answer.at("effects");
    if (effects.size() != 1 || effects[0].at("foreign") || effects[0].at("detectability").get<double>() < seen ||
        evidence.first_stage.empty()) {
      return;
    }
    ++campaigns;
    const std::string cause = effects[0].at("id");
    const bool there = std::ranges::any_of(evidence.first_stage, [&](const hysteron::FirstLook& row) {
      return row.refitted &&
             (row.id == cause || hysteron::is_kin(cause, row.id) ||
              std::ranges::find(answer.at("acceptable"), json(row.id)) != answer.at("acceptable").end());
    });
    held += there ? 1 : 0;
    missed += there ? "" : " " + cause;
  }
};

int run(int argc, char** argv) {
  CLI::App program("verdicts of a challenge once more, from the evidence of its diagnoses");
  std::vector<std::string> folders;
  bool list = false;
  bool write = false;
  bool plain = false;
  program.add_option("FOLDER", folders, "--out of a challenge; with --plain any")
      ->required()
      ->check(CLI::ExistingDirectory);
  program.add_flag("--list", list, "a line for every campaign that is not right");
  program.add_flag("--write", write, "put the verdicts into the diagnoses");
  program.add_flag("--plain", plain, "FOLDER is no challenge: verdicts of all diagnoses below it, as JSON")
      ->excludes("--list", "--write");
  CLI11_PARSE(program, argc, argv);
  if (plain) {
    if (folders.size() != 1) {
      throw hysteron::InputError("--plain takes one folder, " + std::to_string(folders.size()) + " were given");
    }
    fmt::print("{}\n", verdicts_below(folders.front()).dump(1));
    return 0;
  }

  std::map<std::string, std::map<std::string, int>> counts;
  json rows = json::array();
  FirstLooks first_looks;
  int changed = 0;
  int total = 0;
  int left_out = 0;  // not diagnosed, or by a program that did not record what its verdict rests on
  for (const std::filesystem::path folder : folders) {
    const json answers = hysteron::challenge::open_seal(folder);
    for (const json& answer : answers.at("campaigns")) {
      const std::string name = answer.at("campaign");
      const std::filesystem::path path = folder / "diagnoses" / name / "diagnosis.json";
      if (!std::filesystem::exists(path)) {
        ++left_out;
        continue;
      }
      const json diagnosis = json::parse(hysteron::read_file(path));
      if (!has_evidence(diagnosis)) {
        ++left_out;
        continue;
      }
      const json again = judged_again(diagnosis);
      if (write) {
        json written = diagnosis;
        written.update(again);
        hysteron::write_file_atomically(path, written.dump(1) + "\n");
      }
      const json row = hysteron::challenge::score_campaign(answer, again);
      rows.push_back(row);
      first_looks.count(answer, hysteron::evidence_from(diagnosis.at("evidence")));
      const std::string outcome = row.at("outcome");
      const std::string held = hysteron::challenge::score_campaign(answer, diagnosis).at("outcome");
      const std::string level = answer.at("level");
      ++counts[level][outcome];
      ++total;
      changed += outcome == held ? 0 : 1;
      if (list && (outcome != "right" || outcome != held)) {
        fmt::print("{} {} {:<10} truth: {:<40} {:<15} {:<10}{} names: {} candidates: {}\n", folder.filename().string(),
                   name.substr(name.size() - 4), level, listed(row.at("truth")), again.at("verdict").get<std::string>(),
                   outcome, outcome == held ? "" : " *was " + held, listed(row.at("named")),
                   listed(row.at("candidates")));
      }
    }
  }
  for (const auto& [level, outcomes] : counts) {
    fmt::print("{:<12}", level);
    for (const auto& [outcome, count] : outcomes) {
      fmt::print(" {} {}", outcome, count);
    }
    fmt::print("\n");
  }
  fmt::print("{} campaigns, {} of another outcome than with the verdict they hold; {} left out, without evidence\n",
             total, changed, left_out);
  fmt::print("\nnames and suggestions, stated against found:\n");
  for (const json& bin : hysteron::challenge::reliability_of(rows)) {
    const json& right = bin.at("right");
    if (right.at("trials") > 0) {
      fmt::print("{:.2f} to {:.2f}: {:.2f} stated, {} of {} true, {:.2f} [{:.2f}, {:.2f}]\n",
                 bin.at("from").get<double>(), bin.at("to").get<double>(), bin.at("mean_confidence").get<double>(),
                 right.at("hits").get<int>(), right.at("trials").get<int>(), right.at("rate").get<double>(),
                 right.at("low95").get<double>(), right.at("high95").get<double>());
    }
  }
  fmt::print("\nrefitted in the first stage, of single causes that can be seen: {} of {}, they or a related effect{}\n",
             first_looks.held, first_looks.campaigns, first_looks.missed.empty() ? "" : "; not" + first_looks.missed);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }

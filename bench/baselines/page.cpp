#include "baselines/page.hpp"

#include <fmt/format.h>

#include "baselines/sparse.hpp"
#include "challenge/score.hpp"

namespace hysteron::baselines {
namespace {

using nlohmann::json;

constexpr const char* program = "hysteron";
// The order of levels on pages of challenges.
constexpr const char* levels[] = {"plain",   "buried", "absorbed", "pairs",    "wrong-base",
                                  "foreign", "beside", "none",     "unexcited"};

std::string rate(const json& of) {
  if (of.at("trials") == 0) {
    return "-";
  }
  return fmt::format("{} of {} ({:.0f}-{:.0f} %)", of.at("hits").get<int>(), of.at("trials").get<int>(),
                     100.0 * of.at("low95").get<double>(), 100.0 * of.at("high95").get<double>());
}

std::string row(const std::string& method, const std::string& count, const json& campaigns) {
  const json summary = challenge::summarise(campaigns);
  const json& all = summary.at("all");
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", method, count, rate(all.at("rate_right")),
                     all.at("in_set").get<int>(), all.at("part").get<int>(), rate(all.at("rate_wrong")),
                     rate(summary.at("names")));
}

std::string table(const std::map<std::pair<std::string, std::string>, json>& rows) {
  std::string text =
      "| method | values | right | in a set | part | a name without a cause | names that hold a cause |\n"
      "|---|---|--:|--:|--:|--:|--:|\n";
  for (const char* method : {program, tests, strongest_test, selection, sparse}) {
    for (const char* count : {"", samples, independent}) {
      if (const auto at = rows.find({method, count}); at != rows.end()) {
        text += row(method, count, at->second);
      }
    }
  }
  return text;
}

std::string library_table() {
  std::string text = "| term | stands for |\n|---|---|\n";
  for (const Term& term : library()) {
    std::string effects;
    for (const std::string_view effect : term.effects) {
      effects += (effects.empty() ? "" : " or ") + std::string(effect);
    }
    std::string escaped;
    for (const char c : term.text) {
      escaped += c == '|' ? "\\|" : std::string(1, c);
    }
    text += fmt::format("| {} | {} |\n", escaped, effects.empty() ? "the law itself, no effect" : effects);
  }
  return text;
}

}  // namespace

void Scores::add(const json& answer, const json& said, const json& diagnosis) {
  const auto scored = [&](const std::string& method, const std::string& count, const json& statement) {
    json& rows =
        scored_[{method, count}].try_emplace(answer.at("level").get<std::string>(), json::array()).first->second;
    rows.push_back(challenge::score_campaign(answer, statement));
  };
  scored(program, "", diagnosis);
  for (const auto& [method, counts] : said.items()) {
    for (const auto& [count, statement] : counts.items()) {
      scored(method, count, statement);
    }
  }
}

std::string Scores::page(const std::string& command) const {
  std::string text =
      fmt::format("# What simpler methods would have said\n\nMade by\n\n    build/release/bench/{}\n\n", command);
  text +=
      "docs/challenge.md says how the folders are made and when a campaign is right. All methods have the same "
      "recordings,\nsplit, base fit and refits. `hysteron` is what the diagnoses in the folders say. Where nothing is "
      "named the tests and the\nselection say `complete`; the regression refuses where it keeps only terms that stand "
      "for no effect. Bounds: Clopper and\nPearson, 95 %.\n";
  const auto rows_of = [&](const std::string& level) {
    std::map<std::pair<std::string, std::string>, json> rows;
    for (const auto& [method, by_level] : scored_) {
      for (const auto& [name, campaigns] : by_level) {
        if (level.empty() || name == level) {
          json& row = rows.try_emplace(method, json::array()).first->second;
          row.insert(row.end(), campaigns.begin(), campaigns.end());
        }
      }
    }
    return rows;
  };
  text += "\n## All levels\n\n" + table(rows_of(""));
  for (const char* level : levels) {
    if (const auto rows = rows_of(level); !rows.empty()) {
      text += fmt::format("\n## {}\n\n", level) + table(rows);
    }
  }
  text +=
      "\n## Terms of the regression\n\nx displacement from its middle, v, a velocity and acceleration, F force of the "
      "fitted base, F' its rate, W its work,\ni drive, t time. What the base's own parameters do is taken off residual "
      "and terms. Effects without a term cannot be\nnamed by it.\n\n";
  return text + library_table();
}

}  // namespace hysteron::baselines

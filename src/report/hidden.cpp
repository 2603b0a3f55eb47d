#include "report/hidden.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "core/interval_text.hpp"
#include "report/markdown.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

std::string number(const json& value) { return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : "-"; }

std::string interval(const json& ends) {
  if (!ends.is_array() || !ends[0].is_number() || !ends[1].is_number()) return "-";
  const auto [low, high] = interval_ends(ends[0].get<double>(), ends[1].get<double>(), 3, [](double value, int digits) {
    return fmt::format("{:.{}g}", value, digits);
  });
  return low + " to " + high;
}

std::string list(const json& names) {
  std::string text;
  for (const json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text.empty() ? "-" : text;
}

std::string word(const json& value) { return value.is_string() ? value.get<std::string>() : "-"; }

std::string answer_of(const json& row) {
  std::string text;
  for (const json& stated : row.at("answer")) {
    text += (text.empty() ? "" : "; ") + stated.at("id").get<std::string>();
    if (stated.at("confidence").is_number()) text += fmt::format(" {:.2f}", stated.at("confidence").get<double>());
    if (stated.at("grade").is_string()) text += " " + stated.at("grade").get<std::string>();
    if (stated.at("set").size() > 1) text += " in a set";
  }
  return text.empty() ? "-" : text;
}

std::string counted(const json& rate) {
  return fmt::format("{} of {}", rate.at("hits").get<int>(), rate.at("trials").get<int>());
}

}  // namespace

std::string hidden_markdown(const json& result) {
  const json& plain = result.at("as_recorded");
  std::string text = "# Effects hidden in recordings of a real damper\n\n";
  int effects = 0;
  int found = 0;
  int in_set = 0;
  int suggested = 0;
  for (const json& row : result.at("campaigns")) {
    if (row.at("placebo")) continue;
    ++effects;
    found += row.at("outcome") == "found" ? 1 : 0;
    in_set += row.at("outcome") == "in a set" ? 1 : 0;
    suggested += row.at("outcome") == "suggested" ? 1 : 0;
  }
  text += fmt::format(
      "Of {} hidden effects {} were named, {} stand in a declared set and {} are suggested. {} placebos got a name "
      "that "
      "the recordings as they are do not have. Of the names beside those, {} were hidden.",
      effects, found, in_set, suggested, counted(result.at("placebos")), counted(result.at("names")));
  const int left = result.at("not_diagnosed");
  text += left > 0 ? fmt::format(" Campaigns not diagnosed, and not counted: {}.\n\n", left) : "\n\n";
  text += fmt::format("Seed {}, sha256 of the sealed answers {}.\n\n", result.at("seed").get<std::uint64_t>(),
                      result.at("seal").get<std::string>());
  text += fmt::format("As recorded: {}; named: {}; candidates: {}; suggested: {}.", word(plain.at("verdict")),
                      list(plain.at("named")), list(plain.at("candidates")), list(plain.at("suggested")));
  if (result.at("base_residual_n").is_number()) {
    text += fmt::format(" The base law leaves an RMS of {} N.", number(result.at("base_residual_n")));
  }
  text += "\n\n";
  std::vector<std::vector<std::string>> hidden;
  std::vector<std::vector<std::string>> parameters;
  std::vector<std::vector<std::string>> placebos;
  for (const json& row : result.at("campaigns")) {
    const std::string id = row.at("hidden");
    const std::string name = row.at("campaign");
    const std::string link = fmt::format("[{}](diagnoses/{}/report.html)", name, name);
    if (row.at("placebo")) {
      placebos.push_back({link, id, word(row.at("verdict")), answer_of(row), row.at("outcome")});
      continue;
    }
    hidden.push_back({link, id, row.at("size") > 0.0 ? number(row.at("size")) : "drawn",
                      fmt::format("{:.2g}", row.at("share").get<double>()), word(row.at("verdict")), answer_of(row),
                      row.at("outcome"), number(row.at("nrmse_heldout_before")),
                      number(row.at("nrmse_heldout_after"))});
    for (const json& p : row.at("parameters")) {
      parameters.push_back({id + " " + p.at("name").get<std::string>(), p.at("unit"), number(p.at("value")),
                            number(p.at("found")), interval(p.at("ci95"))});
    }
  }
  if (!hidden.empty()) {
    text +=
        "## Hidden effects\n\nSize: RMS of the change of force over what the base law leaves. Share: the same over the "
        "RMS of the force; for what is in series,\ndeflection at the peak force over the smallest amplitude, of the "
        "same "
        "share. Answer: without what stands for the recordings as they are.\nA name is wrong when it neither was "
        "hidden "
        "nor stands for the recordings as they are. In the model: without a name, as what stays\nunexplained may be "
        "its "
        "cause, but in the augmented model, and not in that of the recordings as they are.\n\n";
    text += markdown_table(
        {"campaign", "hidden", "size", "share", "verdict", "answer", "outcome", "held out before", "held out after"},
        hidden);
    text += "\n## Their parameters\n\n";
    text += markdown_table({"parameter", "unit", "hidden", "found", "interval"}, parameters);
  }
  std::vector<std::vector<std::string>> bins;
  for (const json& bin : result.at("reliability")) {
    const json& right = bin.at("right");
    if (right.at("trials") == 0) continue;
    bins.push_back({number(bin.at("from")), number(bin.at("to")), number(bin.at("mean_confidence")), counted(right)});
  }
  if (!bins.empty()) {
    text += "\n## Reliability of the stated probability\n\n";
    text += markdown_table({"stated from", "to", "stated", "were hidden"}, bins);
  }
  if (!placebos.empty()) {
    text += "\n## Placebos\n\nChannels put in disorder: no effect explains them.\n\n";
    text += markdown_table({"campaign", "placebo", "verdict", "answer", "outcome"}, placebos);
  }
  return text;
}

}  // namespace hysteron

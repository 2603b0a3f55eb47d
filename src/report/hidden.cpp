#include "report/hidden.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "report/markdown.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

std::string number(const json& value) { return value.is_number() ? fmt::format("{:.3g}", value.get<double>()) : "-"; }

std::string list(const json& names) {
  std::string text;
  for (const json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text.empty() ? "-" : text;
}

std::string word(const json& value) { return value.is_string() ? value.get<std::string>() : "-"; }

}  // namespace

std::string hidden_markdown(const json& result) {
  const json& plain = result.at("as_recorded");
  std::string text = "# Effects hidden in recordings of a real damper\n\n";
  text += fmt::format("Seed {}, sha256 of the sealed answers {}.\n\n", result.at("seed").get<std::uint64_t>(),
                      result.at("seal").get<std::string>());
  text += fmt::format("As recorded: {}; named: {}; candidates: {}.\n\n", word(plain.at("verdict")),
                      list(plain.at("named")), list(plain.at("candidates")));
  std::vector<std::vector<std::string>> hidden;
  std::vector<std::vector<std::string>> parameters;
  std::vector<std::vector<std::string>> placebos;
  for (const json& row : result.at("campaigns")) {
    const std::string id = row.at("hidden");
    if (row.at("placebo")) {
      placebos.push_back(
          {id, word(row.at("verdict")), list(row.at("named")), list(row.at("candidates")), row.at("outcome")});
      continue;
    }
    hidden.push_back({id, fmt::format("{:.2g}", row.at("share").get<double>()), word(row.at("verdict")),
                      list(row.at("named")), list(row.at("candidates")), row.at("outcome"),
                      number(row.at("nrmse_heldout_before")), number(row.at("nrmse_heldout_after"))});
    for (const json& p : row.at("parameters")) {
      parameters.push_back(
          {id + " " + p.at("name").get<std::string>(), p.at("unit"), number(p.at("value")), number(p.at("found")),
           p.at("ci95").is_array() ? number(p.at("ci95")[0]) + " to " + number(p.at("ci95")[1]) : "-"});
    }
  }
  if (!hidden.empty()) {
    text +=
        "## Hidden effects\n\nShare: RMS of the change over RMS of the force; for compliance and clearance, deflection "
        "over the smallest amplitude.\nA name is wrong when it neither was hidden nor stands for the recordings as "
        "they are. In the model: without a name, as what stays\nunexplained may be its cause, but in the augmented "
        "model, and not in that of the recordings as they are.\n\n";
    text += markdown_table(
        {"hidden", "share", "verdict", "named", "candidates", "outcome", "held out before", "held out after"}, hidden);
    text += "\n## Their parameters\n\n";
    text += markdown_table({"parameter", "unit", "hidden", "found", "95 % interval"}, parameters);
  }
  if (!placebos.empty()) {
    text += "\n## Placebos\n\nChannels put in disorder: no effect explains them.\n\n";
    text += markdown_table({"placebo", "verdict", "named", "candidates", "outcome"}, placebos);
  }
  return text;
}

}  // namespace hysteron

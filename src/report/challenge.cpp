#include "report/challenge.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "report/html.hpp"
#include "report/markdown.hpp"
#include "report/web_assets.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

struct Table {
  std::string title;
  std::string remark;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

std::string percent(const json& rate) {
  if (!rate.at("rate").is_number()) return "-";
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100.0 * rate.at("rate").get<double>(),
                     100.0 * rate.at("low95").get<double>(), 100.0 * rate.at("high95").get<double>());
}

std::string number(const json& value, const char* format = "{:.3g}") {
  return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

std::string share(const json& value) {
  return value.is_number() ? fmt::format("{:.1f} %", 100.0 * value.get<double>()) : "-";
}

const std::vector<std::string> outcome_header = {"campaigns", "right",  "part",  "in a set",
                                                 "abstained", "missed", "wrong", "failed"};

std::vector<std::string> with(std::vector<std::string> first, const std::vector<std::string>& rest) {
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

std::vector<std::string> outcome_cells(const json& row) {
  std::vector<std::string> cells;
  for (const char* key : {"campaigns", "right", "part", "in_set", "abstained", "missed", "wrong", "failed"}) {
    cells.push_back(std::to_string(row.at(key).get<int>()));
  }
  return cells;
}

Table outcome_table(const json& rows, const std::string& title, const std::string& remark, const char* key) {
  Table table{title, remark, with(with({key}, outcome_header), {"right [95 %]", "wrong [95 %]"}), {}};
  for (const json& row : rows) {
    table.rows.push_back(with(with({row.at(key).get<std::string>()}, outcome_cells(row)),
                              {percent(row.at("rate_right")), percent(row.at("rate_wrong"))}));
  }
  return table;
}

std::string edge(double value) { return value >= 1e9 ? "above" : fmt::format("{:g}", value); }

Table size_table(const json& rows, const std::string& title, const std::string& remark) {
  Table table{title, remark, with(with({"from", "to"}, outcome_header), {"detected [95 %]", "right [95 %]"}), {}};
  for (const json& row : rows) {
    table.rows.push_back(
        with(with({edge(row.at("from").get<double>()), edge(row.at("to").get<double>())}, outcome_cells(row)),
             {percent(row.at("rate_detected")), percent(row.at("rate_right"))}));
  }
  return table;
}

std::vector<Table> tables_of(const json& result) {
  const json& s = result.at("summary");
  std::vector<Table> tables;

  Table key{
      "Key figures", "Rates with two-sided 95 % bounds of Clopper and Pearson.", {"what", "of", "rate [95 %]"}, {}};
  const auto add = [&](const std::string& what, const json& rate) {
    key.rows.push_back({what, std::to_string(rate.at("trials").get<int>()), percent(rate)});
  };
  add("plain and detectable: right", s.at("detectable_plain").at("rate_right"));
  add("plain and detectable: right or in a declared set", s.at("detectable_plain").at("rate_right_or_in_set"));
  add("plain and detectable: wrong name", s.at("detectable_plain").at("rate_wrong"));
  add("all campaigns: wrong name", s.at("all").at("rate_wrong"));
  add("negative controls: definite name", s.at("negative_controls").at("definite_name"));
  add("negative controls: any name, also as candidate", s.at("negative_controls").at("any_name"));
  add("named rightly: held-out error within 10 % of the floor", s.at("heldout").at("within_10_percent_of_floor"));
  add("cause that can be seen: the first place stated for the misfit is right", s.at("places").at("first"));
  add("cause that can be seen: places stated for the misfit that are right", s.at("places").at("all"));
  tables.push_back(std::move(key));

  tables.push_back(outcome_table(s.at("levels"), "Levels", "", "level"));
  tables.push_back(outcome_table(s.at("effects"), "Single causes that can be seen",
                                 "foreign: causes are right when refused (unattributed).", "effect"));
  tables.push_back(outcome_table(s.at("disturbances"), "Negative controls", "", "disturbance"));
  tables.push_back(size_table(s.at("by_share_of_peak"), "Size: RMS of the change of force over peak force",
                              "Single causes of the catalogue, excited, told the true law."));
  tables.push_back(size_table(s.at("by_left_over_noise"),
                              "Size: what the law cannot take up (NRMSE) over the noise (share of peak)",
                              "The same campaigns."));

  Table confusion{"Confusion", "Single causes; what was said, most frequent first.", {"truth", "said"}, {}};
  for (const json& row : s.at("confusion")) {
    std::string said;
    for (const json& entry : row.at("said")) {
      said += (said.empty() ? "" : ", ") +
              fmt::format("{} {}", entry.at("said").get<std::string>(), entry.at("count").get<int>());
    }
    confusion.rows.push_back({row.at("truth").get<std::string>(), said});
  }
  tables.push_back(std::move(confusion));

  Table reliability{"Reliability of the stated confidence",
                    "Every definite name.",
                    {"confidence from", "to", "names", "mean confidence", "right [95 %]"},
                    {}};
  for (const json& row : s.at("reliability")) {
    reliability.rows.push_back({number(row.at("from")), number(row.at("to")),
                                std::to_string(row.at("right").at("trials").get<int>()),
                                number(row.at("mean_confidence")), percent(row.at("right"))});
  }
  tables.push_back(std::move(reliability));

  Table parameters{"Parameters",
                   "Of causes that were named or listed, where truth and catalogue mean the same quantity.",
                   {"parameter", "count", "median error", "largest error", "inside ci95 [95 %]"},
                   {}};
  for (const json& row : s.at("parameters")) {
    parameters.rows.push_back({row.at("parameter").get<std::string>(), std::to_string(row.at("count").get<int>()),
                               share(row.at("median_relative_error")), share(row.at("largest_relative_error")),
                               percent(row.at("inside_ci95"))});
  }
  tables.push_back(std::move(parameters));

  Table heldout{"Held-out error over the noise floor",
                "Campaigns named rightly; medians. The floor is known: the noise-free force is.",
                {"campaigns", "before", "after"},
                {}};
  heldout.rows.push_back({std::to_string(s.at("heldout").at("named_cases").get<int>()),
                          number(s.at("heldout").at("median_before_over_floor")),
                          number(s.at("heldout").at("median_after_over_floor"))});
  tables.push_back(std::move(heldout));
  return tables;
}

Table campaign_table(const json& result) {
  Table table{
      "Every campaign",
      "",
      {"campaign", "level", "truth", "size", "verdict", "named", "candidates", "outcome", "before", "after", "floor"},
      {}};
  const auto joined = [](const json& list) {
    std::string text;
    for (const json& entry : list) {
      text += (text.empty() ? "" : ", ") +
              (entry.is_object() ? entry.at("id").get<std::string>() : entry.get<std::string>());
    }
    return text;
  };
  for (const json& c : result.at("campaigns")) {
    std::string truth = joined(c.at("truth"));
    if (truth.empty()) truth = c.at("disturbance").get<std::string>();
    if (!c.at("truth").empty() && !c.at("detectable").get<bool>()) truth += " (cannot be seen)";
    table.rows.push_back(
        {c.at("campaign").get<std::string>(), c.at("level").get<std::string>(), truth, number(c.at("share_of_peak")),
         c.at("verdict").is_string() ? c.at("verdict").get<std::string>() : "-", joined(c.at("named")),
         joined(c.at("candidates")), c.at("outcome").get<std::string>(), number(c.at("nrmse_heldout_before"), "{:.4f}"),
         number(c.at("nrmse_heldout_after"), "{:.4f}"), number(c.at("floor"), "{:.4f}")});
  }
  return table;
}

std::string heading(const json& result) {
  const int left = result.value("not_diagnosed", 0);
  return fmt::format("{} campaigns{}, seed {}, sha256 of the sealed answers {}", result.at("campaigns").size(),
                     left > 0 ? fmt::format(" of {}, the others not diagnosed",
                                            result.at("campaigns").size() + static_cast<std::size_t>(left))
                              : "",
                     result.at("seed").get<std::uint64_t>(), result.at("seal").get<std::string>());
}

}  // namespace

std::string challenge_markdown(const json& result) {
  std::string text = "# Concealed physics\n\n" + heading(result) + ".\n";
  for (const Table& table : tables_of(result)) {
    if (table.rows.empty()) continue;
    text += "\n## " + table.title + "\n\n";
    if (!table.remark.empty()) text += table.remark + "\n\n";
    text += markdown_table(table.header, table.rows);
  }
  return text;
}

std::string challenge_html(const json& result) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><title>Concealed "
      "physics</title><style>\n";
  page += web::report_css();
  page +=
      "\nmain{max-width:75rem;margin:0 auto;padding:1rem}section{overflow-x:auto;margin:1.5rem 0}"
      "td,th{text-align:left;padding:.15rem .6rem;border-bottom:1px solid var(--grid)}\n</style></head><body><main>\n";
  page += "<h1>Concealed physics</h1>\n<p>" + html_escape(heading(result)) + "</p>\n";
  std::vector<Table> tables = tables_of(result);
  tables.push_back(campaign_table(result));
  for (const Table& table : tables) {
    if (table.rows.empty()) continue;
    page += "<section><h2>" + html_escape(table.title) + "</h2>";
    if (!table.remark.empty()) page += "<p>" + html_escape(table.remark) + "</p>";
    page += "<table><thead><tr>";
    for (const std::string& cell : table.header) page += "<th scope=\"col\">" + html_escape(cell) + "</th>";
    page += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
      page += "<tr>";
      for (const std::string& cell : row) page += "<td>" + html_escape(cell) + "</td>";
      page += "</tr>\n";
    }
    page += "</tbody></table></section>\n";
  }
  page += "</main></body></html>\n";
  return page;
}

}  // namespace hysteron

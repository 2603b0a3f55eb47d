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
  bool linked = false;  // the first cell is a campaign, whose report it leads to
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
    if (row.at("campaigns") == 0) continue;
    table.rows.push_back(with(with({row.at(key).get<std::string>()}, outcome_cells(row)),
                              {percent(row.at("rate_right")), percent(row.at("rate_wrong"))}));
  }
  return table;
}

std::string edge(double value) { return value >= 1e9 ? "above" : fmt::format("{:g}", value); }

Table size_table(const json& rows, const std::string& title, const std::string& remark) {
  Table table{title, remark, with(with({"from", "to"}, outcome_header), {"detected [95 %]", "right [95 %]"}), {}};
  for (const json& row : rows) {
    if (row.at("campaigns") == 0) continue;
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
                                 "foreign: causes are right when refused: no name, and not complete.", "effect"));
  tables.push_back(outcome_table(s.at("disturbances"), "Negative controls", "", "disturbance"));
  tables.push_back(size_table(s.at("by_share_of_peak"), "Size: RMS of the change of force over peak force",
                              "Single causes of the catalogue, excited, told the true law."));
  tables.push_back(size_table(s.at("by_left_over_noise"),
                              "Size: what the law cannot take up (NRMSE) over the noise (share of peak)",
                              "The same campaigns."));

  Table confusion{
      "Confusion",
      "Single causes; all that was said of each campaign, most frequent first: names and sets, with + between "
      "them where there are several, or the verdict without any. Suggestions do not count.",
      {"truth", "said"},
      {}};
  for (const json& row : s.at("confusion")) {
    std::string said;
    for (const json& entry : row.at("said")) {
      said += (said.empty() ? "" : ", ") +
              fmt::format("{} {}", entry.at("said").get<std::string>(), entry.at("count").get<int>());
    }
    confusion.rows.push_back({row.at("truth").get<std::string>(), said});
  }
  tables.push_back(std::move(confusion));

  Table reliability{
      "Reliability of the stated probability",
      "Names and suggestions; a set is right where it holds a cause. Off: frequency less stated probability, in "
      "bins of 30 or more.",
      {"level", "stated from", "to", "stated", "names", "true [95 %]", "off"},
      {}};
  const auto add_bins = [&](const std::string& level, const json& bins) {
    for (const json& row : bins) {
      const int trials = row.at("right").at("trials").get<int>();
      if (trials == 0) continue;
      const double mean = row.at("mean_confidence").get<double>();
      reliability.rows.push_back(
          {level, number(row.at("from")), number(row.at("to")), fmt::format("{:.3f}", mean), std::to_string(trials),
           percent(row.at("right")),
           trials < 30 ? "-"
                       : fmt::format("{:+.1f} points", 100.0 * (row.at("right").at("rate").get<double>() - mean))});
    }
  };
  add_bins("all", s.at("reliability"));
  for (const json& level : s.at("reliability_by_level")) {
    add_bins(level.at("level").get<std::string>(), level.at("bins"));
  }
  tables.push_back(std::move(reliability));

  Table forms{"Forms",
              "Of the effects, wherever they were hidden.",
              {"form", "campaigns", "named, alone or in a set [95 %]"},
              {}};
  for (const json& row : s.at("forms")) {
    forms.rows.push_back({row.at("form").get<std::string>(), std::to_string(row.at("named").at("trials").get<int>()),
                          percent(row.at("named"))});
  }
  tables.push_back(std::move(forms));

  Table parameters{"Parameters",
                   "Of causes that were named or listed, where truth and catalogue mean the same quantity.",
                   {"parameter", "count", "median error", "largest error", "inside the interval [95 %]"},
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

// "gas-spring 0.97 established (with asymmetry), not there"
std::string statement(const json& stated) {
  std::string text = stated.at("id").get<std::string>();
  if (stated.at("confidence").is_number()) text += fmt::format(" {:.2f}", stated.at("confidence").get<double>());
  if (stated.at("grade").is_string()) text += " " + stated.at("grade").get<std::string>();
  std::string others;
  for (const json& id : stated.at("set")) {
    if (id != stated.at("id")) others += (others.empty() ? "" : ", ") + id.get<std::string>();
  }
  if (!others.empty()) text += " (or " + others + ")";
  if (!stated.at("right").get<bool>()) text += ", not there";
  return text;
}

Table campaign_table(const json& result) {
  Table table{"Every campaign",
              "Size: RMS of the change of force over peak force. Before and after: held-out error (NRMSE) of the base "
              "model and of the augmented one; floor: that of the noise.",
              {"campaign", "truth", "answer", "outcome", "verdict", "level", "size", "before", "after", "floor"},
              {}};
  table.linked = true;
  for (const json& c : result.at("campaigns")) {
    std::string truth;
    const json& causes = c.at("forms").size() == c.at("truth").size() ? c.at("forms") : c.at("truth");
    for (const json& cause : causes) truth += (truth.empty() ? "" : ", ") + cause.get<std::string>();
    if (truth.empty()) truth = c.at("disturbance").get<std::string>();
    if (truth.empty()) truth = "nothing";
    if (!c.at("truth").empty() && !c.at("detectable").get<bool>()) truth += " (cannot be seen)";
    std::string answer;
    for (const json& stated : c.at("answer")) answer += (answer.empty() ? "" : "; ") + statement(stated);
    table.rows.push_back({c.at("campaign").get<std::string>(), truth, answer.empty() ? "no name" : answer,
                          c.at("outcome").get<std::string>(),
                          c.at("verdict").is_string() ? c.at("verdict").get<std::string>() : "-",
                          c.at("level").get<std::string>(), number(c.at("share_of_peak")),
                          number(c.at("nrmse_heldout_before"), "{:.4f}"), number(c.at("nrmse_heldout_after"), "{:.4f}"),
                          number(c.at("floor"), "{:.4f}")});
  }
  return table;
}

std::string report_of(const std::string& campaign) { return "diagnoses/" + campaign + "/report.html"; }

std::string counted(const json& rate) {
  const int trials = rate.at("trials").get<int>();
  if (trials == 0) return "0 of 0";
  return fmt::format("{} of {} ({:.0f} %)", rate.at("hits").get<int>(), trials, 100.0 * rate.at("rate").get<double>());
}

// Three sentences: what is found, what is said wrongly, what a stated probability is worth.
std::string headline(const json& result) {
  const json& s = result.at("summary");
  const json& known = s.at("catalogue");
  std::string text = fmt::format(
      "Effects of the catalogue that can be seen were named without a wrong name in {} campaigns, and stand in a "
      "declared set in {} more. ",
      counted(known.at("rate_right")), known.at("in_set").get<int>());
  const json& names = s.at("names");
  std::string foreign = "no campaign has foreign causes alone";
  for (const json& level : s.at("levels")) {
    if (level.at("level") == "foreign")
      foreign = "foreign causes alone were refused in " + counted(level.at("rate_right"));
  }
  text += fmt::format("Of {} names {} are not in the truth; nothing missing got a name in {} campaigns; {}. ",
                      names.at("trials").get<int>(), names.at("trials").get<int>() - names.at("hits").get<int>(),
                      counted(s.at("negative_controls").at("definite_name")), foreign);
  int sure = 0;
  int sure_right = 0;
  int all = 0;
  int right = 0;
  double stated = 0.0;
  for (const json& bin : s.at("reliability")) {
    const int trials = bin.at("right").at("trials").get<int>();
    all += trials;
    right += bin.at("right").at("hits").get<int>();
    if (trials > 0) stated += trials * bin.at("mean_confidence").get<double>();
    if (bin.at("from").get<double>() < 0.95) continue;
    sure += trials;
    sure_right += bin.at("right").at("hits").get<int>();
  }
  text += fmt::format(
      "Of names stated with 0.95 or more {} of {} are true; of all names and suggestions {} of {}, where "
      "{:.1f} were promised.",
      sure_right, sure, right, all, stated);
  return text;
}

std::string heading(const json& result) {
  const int left = result.value("not_diagnosed", 0);
  return fmt::format("{} campaigns{}, seed {}, sha256 of the sealed answers {}", result.at("campaigns").size(),
                     left > 0 ? fmt::format(" of {}, the others not diagnosed",
                                            result.at("campaigns").size() + static_cast<std::size_t>(left))
                              : "",
                     result.at("seed").get<std::uint64_t>(), result.at("seal").get<std::string>());
}

// On a phone report.css sets every row as a list of its cells, each behind the name of its column.
std::string html_of(const Table& table) {
  std::string html = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + html_escape(table.title) +
                     "\"><table class=\"stack\"><thead><tr>";
  for (const std::string& cell : table.header) html += "<th scope=\"col\">" + html_escape(cell) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string cell = html_escape(row[k]);
      if (k > 0) {
        html += "<td data-title=\"" + html_escape(table.header[k]) + "\">" + cell + "</td>";
      } else {
        html += std::string("<th scope=\"row\"") + (table.linked ? " class=\"nowrap\">" : ">") +
                (table.linked ? "<a href=\"" + report_of(cell) + "\">" + cell + "</a>" : cell) + "</th>";
      }
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string challenge_markdown(const json& result) {
  std::string text = "# Concealed physics\n\n" + headline(result) + "\n\n" + heading(result) + ".\n";
  std::vector<Table> tables = tables_of(result);
  tables.push_back(campaign_table(result));
  for (Table& table : tables) {
    if (table.rows.empty()) continue;
    text += "\n## " + table.title + "\n\n";
    if (!table.remark.empty()) text += table.remark + "\n\n";
    if (table.linked) {
      for (auto& row : table.rows) row[0] = "[" + row[0] + "](" + report_of(row[0]) + ")";
    }
    text += markdown_table(table.header, table.rows);
  }
  return text;
}

std::string challenge_html(const json& result) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\"><link rel=\"icon\" href=\"data:,\"><title>Concealed physics</title><style>\n";
  page += web::report_css();
  page += "</style></head><body><div id=\"content\">\n<h1>Concealed physics</h1>\n<p class=\"verdict\">" +
          html_escape(headline(result)) + "</p>\n<p class=\"muted\">" + html_escape(heading(result)) + "</p>\n";
  // What happened to each campaign first, the figures behind it.
  std::vector<Table> tables = tables_of(result);
  tables.insert(tables.begin(), campaign_table(result));
  page += "<main>\n";
  for (const Table& table : tables) {
    if (table.rows.empty()) continue;
    page += "<section><h2>" + html_escape(table.title) + "</h2>\n";
    if (!table.remark.empty()) page += "<p>" + html_escape(table.remark) + "</p>\n";
    page += html_of(table) + "</section>\n";
  }
  page += "</main></div></body></html>\n";
  return page;
}

}  // namespace hysteron

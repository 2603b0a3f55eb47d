#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>

#include "report/html.hpp"
#include "report/markdown.hpp"
#include "report/terminal.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

json small_report() {
  return {{"title", "Model <of> \"r1\" & r2"},
          {"version", "0.1.0"},
          {"recordings",
           {{{"file", "r1.csv"},
             {"role", "fit"},
             {"nrmse", 0.031},
             {"time", {0.123456789012, 1.0}},
             {"force_n", {123.45678912, std::numeric_limits<double>::quiet_NaN()}},
             {"predicted_n", {120.0, 121.0}}}}}};
}

// The page's own parts: everything but the embedded data.
std::string without_data(const std::string& html) {
  const std::string open = R"(<script type="application/json" id="report-data">)";
  const auto from = html.find(open);
  const auto to = html.find("</script>", from);
  EXPECT_NE(from, std::string::npos);
  return html.substr(0, from + open.size()) + html.substr(to);
}

std::string data_of(const std::string& html) {
  const std::string open = R"(<script type="application/json" id="report-data">)";
  const auto from = html.find(open) + open.size();
  return html.substr(from, html.find("</script>", from) - from);
}

std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++count;
  return count;
}

TEST(Html, LoadsNothing) {
  const std::string page = without_data(fit_report_html(small_report()));
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("fetch("), std::string::npos);
  EXPECT_EQ(page.find("XMLHttpRequest"), std::string::npos);
  EXPECT_EQ(page.find("url("), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
  const std::regex link("<link[^>]*href=\"([^\"]*)\"");
  for (std::sregex_iterator it(page.begin(), page.end(), link); it != std::sregex_iterator{}; ++it) {
    EXPECT_EQ((*it)[1].str(), "data:,");
  }
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
}

TEST(Html, IsComplete) {
  const std::string page = fit_report_html(small_report());
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_NE(page.find("uPlot=function"), std::string::npos);
  EXPECT_NE(page.find("Permission is hereby granted"), std::string::npos);
  EXPECT_NE(page.find(".u-over"), std::string::npos);
  for (const char* name :
       {"{{title}}", "{{uplot_css}}", "{{report_css}}", "{{uplot_license}}", "{{uplot_js}}", "{{common_js}}",
        "{{chart_js}}", "{{correlation_js}}", "{{part_js}}", "{{report_js}}", "{{data}}"}) {
    EXPECT_EQ(page.find(name), std::string::npos) << name;
  }
  EXPECT_NE(page.find("<title>Model &lt;of&gt; &quot;r1&quot; &amp; r2</title>"), std::string::npos);
}

TEST(Html, DataCannotLeaveItsElement) {
  json report = small_report();
  const std::string plain = fit_report_html(report);
  const std::string hostile = "</script><script>alert(1)</script><!--<script> {{data}} {{report_js}}";
  report["notes"] = {hostile};
  report["recordings"][0]["file"] = hostile;
  const std::string page = fit_report_html(report);
  for (const char* tag : {"</script", "<script", "<!--"}) {
    EXPECT_EQ(occurrences(page, tag), occurrences(plain, tag)) << tag;
  }
  EXPECT_EQ(data_of(page).find('<'), std::string::npos);
  EXPECT_EQ(json::parse(data_of(page))["notes"][0], hostile);
}

TEST(Html, DataSurvives) {
  const json data = json::parse(data_of(fit_report_html(small_report())));
  EXPECT_EQ(data["title"], "Model <of> \"r1\" & r2");
  const json& recording = data["recordings"][0];
  EXPECT_EQ(recording["nrmse"], 0.031);
  EXPECT_EQ(recording["time"][0], 0.123456789);
  EXPECT_EQ(recording["force_n"][0], 123.457);
  EXPECT_TRUE(recording["force_n"][1].is_null());
}

TEST(Html, BytesThatAreNotUtf8DoNotFail) {
  json report = small_report();
  report["recordings"][0]["file"] = "gr\xFC\xDF.csv";
  EXPECT_NO_THROW(fit_report_html(report));
}

// The words of the page say what its numbers are.
TEST(Html, SaysWhatItsNumbersAre) {
  const std::string page = without_data(fit_report_html(small_report()));
  EXPECT_EQ(page.find("z is the value over its standard error;"), std::string::npos);
  EXPECT_EQ(page.find("drive-bend"), std::string::npos) << "the record says which contrast is of all recordings";
  for (const char* words :
       {"taken as Student's t of so many recordings", "each recording weighs the same in both",
        "the floor is at least this much", "may add to more than 100 %", "Cut off to whole percent, not rounded",
        "No standard error could be computed", "one value of all ${c.recordings}"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
}

TEST(Html, EmptyReportIsAPage) {
  EXPECT_NE(fit_report_html(json::object()).find("<title>Hysteron report</title>"), std::string::npos);
}

TEST(FormatNumber, KeepsSignificantDigits) {
  EXPECT_EQ(format_number(0.03124, 3), "0.0312");
  EXPECT_EQ(format_number(0.03, 3), "0.0300");
  EXPECT_EQ(format_number(0.09999, 2), "0.10");
  EXPECT_EQ(format_number(-12.345, 3), "-12.3");
  EXPECT_EQ(format_number(123456.0, 3), "123456");
  EXPECT_EQ(format_number(1234567.0, 3), "1.23e6");
  EXPECT_EQ(format_number(9.9999e-5, 3), "0.000100");
  EXPECT_EQ(format_number(1.5e-7, 2), "1.5e-7");
  EXPECT_EQ(format_number(0.0, 3), "0");
  EXPECT_EQ(format_number(-0.0, 3), "0");
  EXPECT_EQ(format_number(std::nan(""), 3), "nan");
  EXPECT_EQ(format_number(-std::numeric_limits<double>::infinity(), 3), "-inf");
}

TEST(Terminal, Width) {
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("α z²"), 4U);
  EXPECT_EQ(display_width("n\xCC\x88"), 1U);
  EXPECT_EQ(display_width("阻尼"), 4U);
  EXPECT_EQ(display_width("\xFF\xFE"), 2U);
  EXPECT_EQ(display_width("\xE2\x82"), 2U);
}

TEST(Terminal, Numbers) {
  for (const char* text : {"12", "-0.5", "−0.5", "1.2e-3", "97.1 %", "12 000", "< 0.001", "inf", ".5", "5."})
    EXPECT_TRUE(looks_numeric(text)) << text;
  for (const char* text : {"", "-", "a", "1.2 N", "pso", "1e", "12 a", "0.5 A", "1.2.3"})
    EXPECT_FALSE(looks_numeric(text)) << text;
}

TEST(Terminal, Table) {
  EXPECT_EQ(table({"solver", "NRMSE", "β", "note"},
                  {{"pso", "0.0312", "12.5", "ok"}, {"cma-es", "-", "−3.25", ""}, {"lm", "0.1"}}),
            "solver   NRMSE      β  note\n"
            "------  ------  -----  ----\n"
            "pso     0.0312   12.5  ok\n"
            "cma-es       -  −3.25\n"
            "lm         0.1\n");
  EXPECT_EQ(table({}, {}), "");
  EXPECT_EQ(table({"a"}, {}), "a\n-\n");
  EXPECT_EQ(table({"a"}, {{"x\ny"}}), "a\n---\nx y\n");
}

TEST(Terminal, TextIsPartedAtSpaces) {
  std::string text;
  for (int k = 0; k < 40; ++k) text += (k > 0 ? " w" : "w") + std::to_string(k);
  const std::string lines = wrapped(text, 2);
  std::istringstream rows(lines);
  std::string words;
  for (std::string row; std::getline(rows, row);) {
    EXPECT_LE(row.size(), usual_width);
    EXPECT_EQ(words.empty(), !row.starts_with("  w")) << row;
    words += (words.empty() ? "" : " ") + row.substr(words.empty() ? 0 : 2);
  }
  EXPECT_EQ(words, text);
  EXPECT_EQ(wrapped(""), "\n");
  EXPECT_EQ(wrapped(std::string(100, 'x')), std::string(100, 'x') + "\n");
}

TEST(Terminal, ANarrowTablePartsItsLastColumn) {
  const std::string words = "a meaning of many words that goes on and on, and does not end before eighty columns do";
  const std::string lines = narrow_table({"name", "value", "meaning"}, {{"first", "1.5", words}, {"second", "2", "-"}});
  EXPECT_EQ(lines,
            "name    value  meaning\n"
            "------  -----  -------------------------------------------------------------\n"
            "first     1.5  a meaning of many words that goes on and on, and does not end\n"
            "               before eighty columns do\n"
            "second      2  -\n");
}

TEST(Markdown, Table) {
  EXPECT_EQ(markdown_table({"solver", "NRMSE"}, {{"p|so", "0.0312"}, {"two\nlines", "0.1"}}),
            "| solver       |  NRMSE |\n"
            "| ------------ | -----: |\n"
            "| p\\|so        | 0.0312 |\n"
            "| two<br>lines |    0.1 |\n");
}

}  // namespace
}  // namespace hysteron

#include "report/html.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "core/nesting.hpp"
#include "report/web_assets.hpp"

namespace hysteron {
namespace {

double shortened(double value, int digits) {
  if (!std::isfinite(value)) return value;
  std::array<char, 48> text{};
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  double result = value;
  std::from_chars(text.data(), written.ptr, result);
  return result;
}

// A page with 60 recordings is mostly digits that no screen shows; this makes it three times smaller.
void shorten_samples(nlohmann::json& report) {
  if (!report.is_object()) return;
  for (const char* part : {"recordings", "curves"}) {
    if (!report.contains(part)) continue;
    for (auto& row : report[part]) {
      if (!row.is_object()) continue;
      for (auto& [name, channel] : row.items()) {
        if (!channel.is_array()) continue;
        const int digits = name == "time" || name == "x" ? 9 : 6;
        for (auto& sample : channel) {
          if (sample.is_number_float()) sample = shortened(sample.get<double>(), digits);
        }
      }
    }
  }
}

// Vendored scripts open with a banner comment naming a web address. The licence is included in full beside it, and
// without the banner a page that holds an address shows only addresses of the user's own data.
std::string_view without_banner(std::string_view script) {
  if (!script.starts_with("/*!")) return script;
  const auto end = script.find("*/");
  return end == std::string_view::npos ? script : script.substr(end + 2);
}

// Replaces every {{name}} of the template in one pass, so that braces inside the inserted text stay what they are.
std::string filled(std::string_view text, const std::map<std::string, std::string_view, std::less<>>& values) {
  std::size_t size = text.size();
  for (const auto& [name, value] : values) size += value.size();
  std::string result;
  result.reserve(size);
  while (true) {
    const auto open = text.find("{{");
    const auto close = open == std::string_view::npos ? open : text.find("}}", open);
    if (close == std::string_view::npos) break;
    const auto found = values.find(text.substr(open + 2, close - open - 2));
    if (found == values.end()) {
      result += text.substr(0, open + 2);
      text.remove_prefix(open + 2);
      continue;
    }
    result += text.substr(0, open);
    result += found->second;
    text.remove_prefix(close + 2);
  }
  result += text;
  return result;
}

}  // namespace

std::string script_safe_json(const nlohmann::json& value) {
  // A file name may hold bytes that are not UTF-8; a report must not fail for that.
  const std::string plain = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(plain.size() + 64);
  // In JSON text `<` occurs inside strings only, where \u003c means the same.
  for (const char c : plain) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string html_escape(const std::string& text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

namespace {

// `part`: what only this kind of page draws, for its `script`.
std::string page_of(const nlohmann::json& data, std::string_view part, std::string_view script) {
  std::string title = "Hysteron report";
  if (data.is_object() && data.contains("title") && data["title"].is_string()) {
    title = data["title"].get<std::string>();
  }
  title = html_escape(title);
  const std::string text = script_safe_json(data);
  return filled(web::report_html(), {{"title", title},
                                     {"uplot_css", web::uplot_css()},
                                     {"report_css", web::report_css()},
                                     {"uplot_license", web::uplot_license()},
                                     {"uplot_js", without_banner(web::uplot_js())},
                                     {"common_js", web::common_js()},
                                     {"chart_js", web::chart_js()},
                                     {"correlation_js", web::correlation_js()},
                                     {"part_js", part},
                                     {"report_js", script},
                                     {"data", text}});
}

}  // namespace

std::string fit_report_html(nlohmann::json report) {
  shorten_samples(report);
  return page_of(report, web::quality_js(), web::report_js());
}

nlohmann::json data_of_page(const std::string& html) {
  constexpr std::string_view open = R"(<script type="application/json" id="report-data">)";
  const std::size_t from = html.find(open);
  const std::size_t to = from == std::string::npos ? from : html.find("</script>", from);
  if (to == std::string::npos) return nullptr;
  const std::size_t begin = from + open.size();
  const std::string text = html.substr(begin, to - begin);
  if (nested_too_deeply(text)) return nullptr;
  nlohmann::json data = nlohmann::json::parse(text, nullptr, false);
  return data.is_object() ? data : nlohmann::json(nullptr);
}

std::string study_page_html(const nlohmann::json& page) { return page_of(page, web::ranks_js(), web::study_js()); }

std::string compare_page_html(const nlohmann::json& page) { return page_of(page, {}, web::compare_js()); }

}  // namespace hysteron

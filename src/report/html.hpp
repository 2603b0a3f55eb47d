// The self-contained HTML page of an identification or a diagnosis.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hysteron {

// One HTML page holding the report's data, the plot library, styles and script; opening it loads nothing else.
// Sample arrays of `recordings` and `curves` are shortened to the digits a plot can show (9 for abscissae, 6 for the
// rest).
// Members that the page does not know are kept in its data and otherwise ignored; missing ones leave their part out.
std::string fit_report_html(nlohmann::json report);

// The report's data that a page of fit_report_html holds; null for a text that is no such page.
nlohmann::json data_of_page(const std::string& html);

// The page of a study: `page` is what web/study.js draws.
std::string study_page_html(const nlohmann::json& page);

// The page of a comparison: `page` is what web/compare.js draws.
std::string compare_page_html(const nlohmann::json& page);

// JSON text that may stand inside a <script> element: no `<` is left, so no tag can end or open there.
std::string script_safe_json(const nlohmann::json& value);

// Text that may stand inside an HTML element or a quoted attribute.
std::string html_escape(const std::string& text);

}  // namespace hysteron

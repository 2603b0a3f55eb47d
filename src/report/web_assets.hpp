// Files of the HTML report, embedded at build time by cmake/web.cmake.
#pragma once

#include <string_view>

namespace hysteron::web {

std::string_view report_html();
std::string_view report_css();
std::string_view common_js();
std::string_view chart_js();
std::string_view correlation_js();
std::string_view quality_js();
std::string_view ranks_js();
std::string_view report_js();
std::string_view study_js();
std::string_view compare_js();
std::string_view uplot_js();
std::string_view uplot_css();
std::string_view uplot_license();

}  // namespace hysteron::web

// A page of the Markdown that the program itself writes.
#pragma once

#include <string>
#include <string_view>

namespace hysteron::app {

// One HTML page that loads nothing: the headings, paragraphs, tables and links of `markdown`.
std::string markdown_page(std::string_view markdown, const std::string& title);

}  // namespace hysteron::app

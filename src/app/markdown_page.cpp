#include "app/markdown_page.hpp"

#include <algorithm>
#include <vector>

#include "report/html.hpp"
#include "report/web_assets.hpp"

namespace hysteron::app {
namespace {

// Words with `[text](target)` as links and `code` as such.
std::string words_of(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const std::size_t open = text.find_first_of("[`");
    html += html_escape(std::string(text.substr(0, open)));
    if (open == std::string_view::npos) break;
    text.remove_prefix(open);
    const bool code = text.front() == '`';
    const std::size_t middle = code ? text.find('`', 1) : text.find("](");
    const std::size_t end = code ? middle : text.find(')', std::min(middle, text.size()));
    if (end == std::string_view::npos) {
      html += text.front();
      text.remove_prefix(1);
      continue;
    }
    const std::string inside = html_escape(std::string(text.substr(1, middle - 1)));
    const std::string target = code ? "" : html_escape(std::string(text.substr(middle + 2, end - middle - 2)));
    html += code ? "<code>" + inside + "</code>" : "<a href=\"" + target + "\">" + inside + "</a>";
    text.remove_prefix(end + 1);
  }
  return html;
}

// Cells of a row "| a | b |", in which \| is no end of a cell.
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  for (std::size_t k = 1; k < line.size(); ++k) {
    if (line[k] == '\\' && k + 1 < line.size() && line[k + 1] == '|') {
      cells.back() += line[++k];
    } else if (line[k] == '|') {
      cells.emplace_back();
    } else {
      cells.back() += line[k];
    }
  }
  cells.pop_back();  // behind the last end
  for (std::string& cell : cells) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
  }
  return cells;
}

std::string table_of(const std::vector<std::string_view>& lines) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"table\"><table class=\"stack\"><thead><tr>";
  const std::vector<std::string> header = cells_of(lines.front());
  for (const std::string& cell : header) html += "<th scope=\"col\">" + words_of(cell) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (std::size_t row = 2; row < lines.size(); ++row) {  // behind the rule
    const std::vector<std::string> cells = cells_of(lines[row]);
    html += "<tr>";
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string title = k < header.size() ? html_escape(header[k]) : "";
      html += k == 0 ? "<th scope=\"row\" class=\"nowrap\">" + words_of(cells[k]) + "</th>"
                     : "<td data-title=\"" + title + "\">" + words_of(cells[k]) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string markdown_page(std::string_view markdown, const std::string& title) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src "
      "data:\"><link rel=\"icon\" href=\"data:,\"><title>" +
      html_escape(title) + "</title><style>\n";
  page += web::report_css();
  page += "</style></head><body><div id=\"content\">\n";
  std::vector<std::string_view> table;
  std::string paragraph;
  const auto end_block = [&] {
    if (table.size() > 1) page += table_of(table);
    if (!paragraph.empty()) page += "<p>" + words_of(paragraph) + "</p>\n";
    table.clear();
    paragraph.clear();
  };
  while (!markdown.empty()) {
    const std::size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
    if (line.starts_with('|')) {
      table.push_back(line);
      continue;
    }
    const std::size_t level = line.find_first_not_of('#');
    const bool heading = level != std::string_view::npos && level > 0 && line[level] == ' ';
    if (line.empty() || heading) end_block();
    if (heading) {
      const std::string tag = "h" + std::to_string(level);
      page += "<" + tag + ">" + words_of(line.substr(level + 1)) + "</" + tag + ">\n";
    } else if (!line.empty()) {
      paragraph += (paragraph.empty() ? "" : " ") + std::string(line);
    }
  }
  end_block();
  return page + "</div></body></html>\n";
}

}  // namespace hysteron::app

#include "report/markdown.hpp"

#include <algorithm>

#include "report/terminal.hpp"

namespace hysteron {
namespace {

std::string escaped(const std::string& cell) {
  std::string text;
  for (const char c : cell) {
    if (c == '|') {
      text += "\\|";
    } else if (c == '\n') {
      text += "<br>";
    } else if (c != '\r') {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string markdown_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  const std::vector<bool> numeric = numeric_columns(header, rows);
  const std::size_t columns = numeric.size();
  if (columns == 0) return {};
  std::vector<std::size_t> width(columns, 3);  // a rule needs three dashes
  const auto measure = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) width[c] = std::max(width[c], display_width(escaped(cells[c])));
  };
  measure(header);
  for (const auto& row : rows) measure(row);

  std::string out;
  const auto print = [&](const std::vector<std::string>& cells) {
    out += '|';
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string cell = c < cells.size() ? escaped(cells[c]) : std::string{};
      const std::string padding(width[c] - display_width(cell), ' ');
      out += ' ' + (numeric[c] ? padding + cell : cell + padding) + " |";
    }
    out += '\n';
  };
  print(header);
  out += '|';
  for (std::size_t c = 0; c < columns; ++c) {
    out += ' ' + std::string(width[c] - (numeric[c] ? 1 : 0), '-') + (numeric[c] ? ": |" : " |");
  }
  out += '\n';
  for (const auto& row : rows) print(row);
  return out;
}

}  // namespace hysteron

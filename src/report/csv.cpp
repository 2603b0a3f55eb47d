#include "report/csv.hpp"

namespace hysteron {
namespace {

void append(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) text += ',';
    if (cells[k].find_first_of(",\"\n\r") == std::string::npos) {
      text += cells[k];
      continue;
    }
    text += '"';
    for (const char c : cells[k]) {
      if (c == '"') text += '"';
      text += c;
    }
    text += '"';
  }
  text += '\n';
}

}  // namespace

std::string csv_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  append(text, header);
  for (const auto& row : rows) append(text, row);
  return text;
}

}  // namespace hysteron

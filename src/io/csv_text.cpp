#include "io/csv_text.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <system_error>

#include "core/printable.hpp"

namespace hysteron {
namespace {

void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

}  // namespace

std::string csv_of_columns(std::span<const std::string> names, std::span<const std::span<const double>> columns) {
  assert(!names.empty() && names.size() == columns.size());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  text += '\n';
  const std::size_t rows = columns.front().size();
  text.reserve(text.size() + 16 * columns.size() * rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      assert(columns[k].size() == rows);
      if (k > 0) text += ',';
      append(text, columns[k][i]);
    }
    text += '\n';
  }
  return text;
}

std::string name_cell(std::string_view name) {
  std::string cell = printable(name);
  if (cell.empty() || std::string_view("=+-@").find(cell.front()) == std::string_view::npos) return cell;
  const char* const begin = cell.data() + (cell.front() == '+' ? 1 : 0);
  const char* const end = cell.data() + cell.size();
  double value = 0.0;
  const auto read = std::from_chars(begin, end, value);
  const bool number = read.ec == std::errc() && read.ptr == end;
  return number ? cell : "'" + cell;
}

}  // namespace hysteron

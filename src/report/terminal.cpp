#include "report/terminal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/printable.hpp"

namespace hysteron {
namespace {

struct Range {
  char32_t first;
  char32_t last;
};

// Combining marks and other characters without width that occur in names and units (a short list, not all of Unicode).
constexpr std::array<Range, 7> zero_width{{{0x0300, 0x036F},
                                           {0x0483, 0x0489},
                                           {0x1AB0, 0x1AFF},
                                           {0x1DC0, 0x1DFF},
                                           {0x200B, 0x200F},
                                           {0x20D0, 0x20FF},
                                           {0xFE00, 0xFE0F}}};

constexpr std::array<Range, 8> double_width{{{0x1100, 0x115F},
                                             {0x2E80, 0x303E},
                                             {0x3041, 0xA4CF},
                                             {0xAC00, 0xD7A3},
                                             {0xF900, 0xFAFF},
                                             {0xFE30, 0xFE6F},
                                             {0xFF00, 0xFF60},
                                             {0x1F300, 0x3FFFD}}};

template <std::size_t N>
bool within(const std::array<Range, N>& ranges, char32_t c) {
  return std::any_of(ranges.begin(), ranges.end(), [c](const Range& r) { return c >= r.first && c <= r.last; });
}

// Takes one character off the front of `text`; a byte that does not start a valid sequence is taken alone.
char32_t take(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  std::size_t length = 1;
  char32_t c = lead;
  if (lead >= 0xC2 && lead < 0xE0) {
    length = 2;
    c = lead & 0x1FU;
  } else if (lead >= 0xE0 && lead < 0xF0) {
    length = 3;
    c = lead & 0x0FU;
  } else if (lead >= 0xF0 && lead < 0xF5) {
    length = 4;
    c = lead & 0x07U;
  }
  if (length > text.size()) length = 1;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      length = 1;
      break;
    }
    c = (c << 6U) | (byte(i) & 0x3FU);
  }
  if (length == 1) c = lead < 0x80 ? lead : U'?';
  text.remove_prefix(length);
  return c;
}

bool is_placeholder(std::string_view text) {
  return text.empty() || text == "-" || text == "–" || text == "—" || text == "n/a";
}

}  // namespace

std::string format_number(double value, int significant) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value == 0.0) return "0";
  significant = std::clamp(significant, 1, 17);
  std::array<char, 64> buffer{};
  char* const begin = buffer.data();
  char* const end = begin + buffer.size();
  // The exponent after rounding: 0.09999 with two digits is 0.10, not 0.100.
  const auto scientific = std::to_chars(begin, end, value, std::chars_format::scientific, significant - 1);
  const std::string text(begin, scientific.ptr);
  const auto e = text.find('e');
  const int exponent = std::atoi(text.c_str() + e + 1);
  if (exponent >= -4 && exponent < 6) {
    const int decimals = std::max(0, significant - 1 - exponent);
    const auto fixed = std::to_chars(begin, end, value, std::chars_format::fixed, decimals);
    return {begin, fixed.ptr};
  }
  return text.substr(0, e + 1) + std::to_string(exponent);
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    const char32_t c = take(text);
    if (c < 0x20 || within(zero_width, c)) continue;
    width += within(double_width, c) ? 2 : 1;
  }
  return width;
}

bool looks_numeric(std::string_view text) {
  const auto skip = [&text](std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
  };
  const auto skip_spaces = [&] {
    while (skip(" ")) {
    }
  };
  const auto digit = [&text] { return !text.empty() && text.front() >= '0' && text.front() <= '9'; };
  skip_spaces();
  if (skip("<=") || skip(">=") || skip("<") || skip(">") || skip("≤") || skip("≥") || skip("~") || skip("±")) {
    skip_spaces();
  }
  if (!skip("-") && !skip("−")) skip("+");
  if (text == "inf" || text == "nan" || text == "∞") return true;
  std::size_t digits = 0;
  while (true) {
    if (digit()) {
      text.remove_prefix(1);
      ++digits;
    } else if (digits > 0 && text.size() > 1 && (text.front() == ' ' || text.front() == ',') && text[1] >= '0' &&
               text[1] <= '9') {
      text.remove_prefix(1);  // separates thousands
    } else {
      break;
    }
  }
  if (skip(".")) {
    while (digit()) {
      text.remove_prefix(1);
      ++digits;
    }
  }
  if (digits == 0) return false;
  if (skip("e") || skip("E")) {
    if (!skip("-")) skip("+");
    if (!digit()) return false;
    while (digit()) text.remove_prefix(1);
  }
  skip_spaces();
  skip("%");
  skip_spaces();
  return text.empty();
}

std::vector<bool> numeric_columns(const std::vector<std::string>& header,
                                  const std::vector<std::vector<std::string>>& rows) {
  std::size_t columns = header.size();
  for (const auto& row : rows) columns = std::max(columns, row.size());
  std::vector<bool> numeric(columns, false);
  for (std::size_t c = 0; c < columns; ++c) {
    bool all = true;
    bool any = false;
    for (const auto& row : rows) {
      if (c >= row.size() || is_placeholder(row[c])) continue;
      const bool number = looks_numeric(row[c]);
      all = all && number;
      any = any || number;
    }
    numeric[c] = all && any;
  }
  return numeric;
}

namespace {

// Words of a text in lines of at most `width` columns.
std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
  std::vector<std::string> lines{""};
  std::size_t column = 0;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t space = std::min(text.find(' ', from), text.size());
    const std::string_view word = text.substr(from, space - from);
    const std::size_t needed = display_width(word);
    if (column > 0 && column + 1 + needed > width) {
      lines.emplace_back();
      column = 0;
    } else if (from > 0) {
      lines.back() += ' ';
      ++column;
    }
    lines.back() += word;
    column += needed;
    from = space + 1;
  }
  return lines;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result;
  for (const std::string& line : lines_of(text, usual_width - indent)) {
    result += (result.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
  }
  return result + "\n";
}

std::string narrow_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t least = 20;  // of the last column
  const std::size_t last = header.size() - 1;
  std::size_t before = 0;
  for (std::size_t c = 0; c < last; ++c) {
    std::size_t width = display_width(printable(header[c]));
    for (const auto& row : rows) width = std::max(width, display_width(printable(row[c])));
    before += width + 2;
  }
  const std::size_t left = before + least > usual_width ? least : usual_width - before;
  std::vector<std::vector<std::string>> parted;
  for (const auto& row : rows) {
    const std::vector<std::string> lines = lines_of(row[last], left);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      parted.push_back(k == 0 ? row : std::vector<std::string>(header.size()));
      parted.back()[last] = lines[k];
    }
  }
  return table(header, parted);
}

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  const std::vector<bool> numeric = numeric_columns(header, rows);
  const std::size_t columns = numeric.size();
  if (columns == 0) return {};
  std::vector<std::size_t> width(columns, 0);
  const auto measure = [&](const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) width[c] = std::max(width[c], display_width(printable(cells[c])));
  };
  measure(header);
  for (const auto& row : rows) measure(row);

  std::string out;
  const auto print = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string cell = c < cells.size() ? printable(cells[c]) : std::string{};
      const std::string padding(width[c] - display_width(cell), ' ');
      if (c > 0) line += "  ";
      line += numeric[c] ? padding + cell : cell + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  };
  print(header);
  std::vector<std::string> rule;
  rule.reserve(columns);
  for (const std::size_t w : width) rule.emplace_back(w, '-');
  print(rule);
  for (const auto& row : rows) print(row);
  return out;
}

}  // namespace hysteron

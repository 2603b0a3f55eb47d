#include "io/workbook_styles.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "io/header_row.hpp"
#include "io/text.hpp"

namespace hysteron::workbook {
namespace {

// "[h]", "[mm]": hours, minutes or seconds that go on beyond a day.
bool is_elapsed(std::string_view bracket) {
  const std::string lower = lower_case(bracket);
  return !lower.empty() && std::string_view("hms").find(lower.front()) != std::string_view::npos &&
         lower.find_first_not_of(lower.front()) == std::string::npos;
}

// Whether a format shows a number of days as a date or a time: a letter of one stands before the first digit, outside
// of quotes and brackets. "0.00 s" is a number with a unit.
bool shows_a_date(std::string_view code) {
  for (std::size_t k = 0; k < code.size(); ++k) {
    const char c = code[k];
    if (c == ';' || c == '0' || c == '#' || c == '?') return false;
    if (c == '\\' || c == '_' || c == '*') {  // the next character stands for itself, or for a blank
      ++k;
    } else if (c == '"' || c == '[') {
      const std::size_t end = std::min(code.find(c == '"' ? '"' : ']', k + 1), code.size());
      if (c == '[' && is_elapsed(code.substr(k + 1, end - k - 1))) return true;
      k = end;
    } else if (lower_case(code.substr(k, 7)) == "general") {
      return false;
    } else if (std::string_view("ydhmsYDHMS").find(c) != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

// Formats that have a number and no code (ECMA-376, 18.8.30): dates and times of every language.
bool is_built_in_date(std::uint32_t format) {
  return (format >= 14 && format <= 22) || (format >= 27 && format <= 36) || (format >= 45 && format <= 47) ||
         (format >= 50 && format <= 58);
}

// Of a format of positive numbers: what stands behind its digits.
Shown shown_by(std::string_view code) {
  Shown shown{shows_a_date(code), {}, false};
  if (shown.date) return shown;
  bool behind = false;
  const auto is_exponent = [&](std::size_t k) {
    return lower_case(code.substr(k, 1)) == "e" &&
           (code.substr(k + 1).starts_with('+') || code.substr(k + 1).starts_with('-'));
  };
  for (std::size_t k = 0; k < code.size() && code[k] != ';'; ++k) {
    const char c = code[k];
    std::string_view text;
    if (c == '"' || c == '[') {
      const std::size_t end = std::min(code.find(c == '"' ? '"' : ']', k + 1), code.size());
      text = code.substr(k + 1, end - k - 1);
      // [$kN-409] is a text and the number of a language; other brackets are colours and conditions.
      if (c == '[') text = text.starts_with('$') ? text.substr(1, text.rfind('-') - 1) : std::string_view{};
      k = end;
    } else if (c == '\\' && k + 1 < code.size()) {
      text = code.substr(++k, 1);
    } else if (c == '_' || c == '*' || is_exponent(k)) {
      ++k;  // a blank as wide as the next character, that character as often as it fits, or the exponent's sign
    } else if (c == '0' || c == '#' || c == '?') {
      behind = true;
      shown.scaled = false;  // commas so far stand between thousands
      shown.unit.clear();
    } else if (lower_case(code.substr(k, 7)) == "general") {
      behind = true;
      k += 6;
    } else if (c == ',' || c == '%') {
      shown.scaled = behind;
    } else if (c != '.') {
      text = code.substr(k, 1);
    }
    if (behind) shown.unit += text;
  }
  shown.unit = without_brackets(without_blanks(shown.unit));
  // Parentheses, strokes of fractions and the like are none; a degree sign is no ASCII.
  const auto is_letter = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalpha(byte) != 0 || byte >= 0x80;
  };
  constexpr std::size_t longest_unit = 32;
  if (shown.unit.size() > longest_unit || std::ranges::none_of(shown.unit, is_letter)) shown.unit.clear();
  return shown;
}

}  // namespace

std::vector<Shown> styles_of(Archive& archive, const std::string& path) {
  constexpr std::size_t most_styles = 65'536;
  std::vector<std::pair<std::uint32_t, Shown>> formats;  // those with a code
  std::vector<Shown> styles;
  bool of_cells = false;
  XmlEvents events;
  events.begin = [&](std::string_view name, const XmlAttributes& attributes) {
    of_cells = of_cells || name == "cellXfs";
    const std::optional<std::uint32_t> format = whole(attribute(attributes, "numFmtId"));
    if (name == "numFmt" && format && formats.size() < most_styles) {
      formats.emplace_back(*format, shown_by(attribute(attributes, "formatCode")));
    }
    if (name != "xf" || !of_cells) return;
    if (styles.size() == most_styles) throw Damage("it has more than 65536 styles");
    const auto coded = std::ranges::find(formats, format.value_or(0), &std::pair<std::uint32_t, Shown>::first);
    styles.push_back(coded != formats.end() ? coded->second : Shown{format && is_built_in_date(*format), {}, false});
  };
  events.end = [&](std::string_view name) { of_cells = of_cells && name != "cellXfs"; };
  archive.read(path, std::move(events));
  return styles;
}

}  // namespace hysteron::workbook

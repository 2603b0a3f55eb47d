// Aligned tables for a terminal, and numbers as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// `value` with `significant` digits, trailing zeros kept; plain notation from 1e-4 up to 1e6 (all integer digits are
// shown there), else like 1.23e-7. Does not depend on the locale. Not-a-number prints "nan", infinities "inf".
std::string format_number(double value, int significant);

// Columns a terminal needs for UTF-8 text: 0 for combining marks, 2 for East Asian wide characters and emoji. Bytes
// that are not UTF-8 count as one column each.
std::size_t display_width(std::string_view text);

// True for text that a reader takes as a number: 12, -0.5, 1.2e-3, 97.1 %, 1 234, < 0.001, inf.
bool looks_numeric(std::string_view text);

// One flag per column: every cell is empty, a dash, or a number, and at least one is a number. Such columns are set
// flush right. Rows may be shorter or longer than the header.
std::vector<bool> numeric_columns(const std::vector<std::string>& header,
                                  const std::vector<std::vector<std::string>>& rows);

// Header, a rule, then the rows; columns two spaces apart, no trailing spaces, every line ends with a newline.
// Line breaks inside a cell become spaces.
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

// Columns of a terminal as it opens.
inline constexpr std::size_t usual_width = 80;

// Text in lines of at most `usual_width` columns, parted at spaces; the second and later ones begin with `indent`
// spaces. A word that is longer has a line of its own. Ends with a newline.
std::string wrapped(std::string_view text, std::size_t indent = 0);

// As table(), with the words of the last column in several lines where a line would be wider than `usual_width`.
std::string narrow_table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

}  // namespace hysteron

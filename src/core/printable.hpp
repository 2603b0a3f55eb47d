// Text of files and their names as it may be shown: nobody's bytes command a terminal or break a result file.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

// UTF-8 text: bytes that are none are written as \xE9. UTF-8 stays what it is.
[[nodiscard]] std::string valid_utf8(std::string_view text);

// For a terminal, in one line: control characters, marks that turn the direction of writing, and bytes that are not
// UTF-8 are written as \x1B, \u202E, \xE9; line ends and tabs are spaces.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace hysteron

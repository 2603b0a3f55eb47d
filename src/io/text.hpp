// Small text helpers of the readers: ASCII only, independent of the locale.
#pragma once

#include <string>
#include <string_view>

#include "core/lower_case.hpp"

namespace hysteron {

// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// Without spaces, tabs and no-break spaces at both ends, these in UTF-8 or in the Latin-1 of Windows.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

// With spaces in place of no-break spaces.
[[nodiscard]] std::string plain_blanks(std::string_view text);

// In single quotes for a one-line message: control bytes shown as '?', long text shortened.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace hysteron

// How deeply JSON of strangers is nested. Copying and writing a value goes down it by recursion, and a text of a few
// hundred kilobytes can be nested deeper than the stack is long.
#pragma once

#include <cstddef>
#include <string_view>

namespace hysteron {

// Far above what any file of ours has.
inline constexpr std::size_t deepest_nesting = 64;

// Whether brackets of the text, which may be no JSON at all, are open deeper than that; those inside strings do not
// count.
[[nodiscard]] bool nested_too_deeply(std::string_view json);

}  // namespace hysteron

// SHA-256 (FIPS 180-4), to tie results to the bytes they came from.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

// 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::string_view bytes);

}  // namespace hysteron

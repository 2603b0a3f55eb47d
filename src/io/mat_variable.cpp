#include "io/mat_variable.hpp"

namespace hysteron {

void append_utf8(std::string& text, std::uint32_t character) {
  if (character > 0x10FFFF || (character >= 0xD800 && character < 0xE000)) character = 0xFFFD;
  if (character < 0x80) {
    text += static_cast<char>(character);
    return;
  }
  const auto last = [&](std::uint32_t shift) { text += static_cast<char>(0x80U | ((character >> shift) & 0x3FU)); };
  if (character < 0x800) {
    text += static_cast<char>(0xC0U | (character >> 6U));
  } else if (character < 0x10000) {
    text += static_cast<char>(0xE0U | (character >> 12U));
    last(6);
  } else {
    text += static_cast<char>(0xF0U | (character >> 18U));
    last(12);
    last(6);
  }
  last(0);
}

std::string utf8_of_utf16(const std::vector<std::uint32_t>& units) {
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const bool pair = units[i] >= 0xD800 && units[i] < 0xDC00 && i + 1 < units.size() && units[i + 1] >= 0xDC00 &&
                      units[i + 1] < 0xE000;
    if (pair) {
      append_utf8(text, 0x10000 + ((units[i] - 0xD800) << 10U) + (units[i + 1] - 0xDC00));
      ++i;
    } else {
      append_utf8(text, units[i]);
    }
  }
  return text;
}

}  // namespace hysteron

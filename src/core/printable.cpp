#include "core/printable.hpp"

#include <array>
#include <cstddef>

namespace hysteron {
namespace {

struct Character {
  std::size_t length = 1;
  char32_t code = 0;
  bool valid = false;
};

// The character at the front of `text`, not overlong, not a surrogate, not beyond Unicode; else one byte.
Character front_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead, true};
  const std::size_t length = lead >= 0xF0 && lead < 0xF5 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead >= 0xF5 || length > text.size()) return {1, lead, false};
  char32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {1, lead, false};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool valid = code >= least.at(length) && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  return valid ? Character{length, code, true} : Character{1, lead, false};
}

void append_hex(std::string& text, const char* before, char32_t value, int digits) {
  text += before;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) {
    text += "0123456789ABCDEF"[(value >> static_cast<unsigned>(shift)) & 0xFU];
  }
}

bool turns_direction(char32_t code) {
  return (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0x200E || code == 0x200F;
}

}  // namespace

std::string valid_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character next = front_of(text);
    if (next.valid) {
      result += text.substr(0, next.length);
    } else {
      append_hex(result, "\\x", next.code, 2);
    }
    text.remove_prefix(next.length);
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character next = front_of(text);
    const char32_t code = next.code;
    if (!next.valid) {
      append_hex(result, "\\x", code, 2);
    } else if (code == '\n' || code == '\r' || code == '\t') {
      result += ' ';
    } else if (code < 0x20 || (code >= 0x7F && code < 0xA0)) {
      append_hex(result, "\\x", code, 2);
    } else if (turns_direction(code)) {
      append_hex(result, "\\u", code, 4);
    } else {
      result += text.substr(0, next.length);
    }
    text.remove_prefix(next.length);
  }
  return result;
}

}  // namespace hysteron

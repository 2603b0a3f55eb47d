#include "io/text.hpp"

#include <algorithm>

namespace hysteron {
namespace {

constexpr std::string_view no_break_spaces[] = {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x87"};
constexpr char no_break_of_windows = '\xA0';

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view without_blanks(std::string_view text) {
  text = trimmed(text);
  for (const std::string_view space : no_break_spaces) {
    if (text.starts_with(space)) return without_blanks(text.substr(space.size()));
    if (text.ends_with(space)) return without_blanks(text.substr(0, text.size() - space.size()));
  }
  // In UTF-8 no such byte begins a letter, or follows one of ASCII.
  if (text.starts_with(no_break_of_windows)) return without_blanks(text.substr(1));
  if (text.ends_with(no_break_of_windows) && is_ascii(text[text.size() - 2])) {
    return without_blanks(text.substr(0, text.size() - 1));
  }
  return text;
}

std::string plain_blanks(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::size_t taken = 1;
    char next = text.front();
    for (const std::string_view space : no_break_spaces) {
      if (!text.starts_with(space)) continue;
      taken = space.size();
      next = ' ';
    }
    if (next == no_break_of_windows && (result.empty() || is_ascii(result.back()))) next = ' ';
    result += next;
    text.remove_prefix(taken);
  }
  return result;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string result = "'";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return result + (text.size() > longest ? "...'" : "'");
}

}  // namespace hysteron

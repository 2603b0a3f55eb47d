// Words in a row, as a sentence names them.
#pragma once

#include <string>
#include <string_view>

namespace hysteron {

// "a, b and c" with " and " for `last`; empty without words. Of any range of strings or string views.
template <class Words>
std::string joined(const Words& words, std::string_view last) {
  std::string result;
  std::size_t k = 0;
  for (const auto& word : words) {
    if (k > 0) result += k + 1 == words.size() ? last : ", ";
    result += word;
    ++k;
  }
  return result;
}

}  // namespace hysteron

#include "task/command_text.hpp"

#include <filesystem>

#include "core/printable.hpp"

namespace hysteron {

std::string quoted_word(const std::string& word) {
  return word.find(' ') == std::string::npos ? word : "'" + word + "'";
}

std::string command_text(const std::vector<std::string>& words) {
  std::string text = "hysteron";
  for (std::size_t k = 0; k < words.size(); ++k) {
    std::string word = valid_utf8(words[k]);
    if (word == "--threads" || word == "--out") {
      ++k;
      continue;
    }
    if (word == "--quiet" || word.starts_with("--threads=") || word.starts_with("--out=")) {
      continue;
    }
    if (word.starts_with("/")) {
      word = std::filesystem::path(word).filename().string();
    }
    text += " " + quoted_word(word);
  }
  return text;
}

}  // namespace hysteron

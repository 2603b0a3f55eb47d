#include "io/format.hpp"

#include <algorithm>
#include <vector>

#include "io/file.hpp"
#include "io/text.hpp"

namespace hysteron {

const InputFormat* find_format(const std::filesystem::path& path) {
  std::string head;
  InputFile(path).read(head, bytes_of_head);
  for (const InputFormat* format : formats()) {
    if (format->begins != nullptr && format->begins(head)) return format;
  }
  const std::string ending = lower_case(path.extension().string());
  for (const InputFormat* format : formats()) {
    if (std::ranges::find(format->endings, ending, &Ending::text) != format->endings.end()) return format;
  }
  return nullptr;
}

InFolders in_folders(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  if (name.starts_with('.') || name.starts_with("~$")) return InFolders::none;
  const std::string ending = lower_case(path.extension().string());
  for (const InputFormat* format : formats()) {
    for (const Ending& known : format->endings) {
      if (known.text == ending) return known.in_folders;
    }
  }
  return InFolders::none;
}

std::size_t samples_by_size(const std::filesystem::path& path) {
  constexpr std::uintmax_t sample = 16;
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  return code ? 0 : static_cast<std::size_t>(size / sample);
}

std::string list_of_endings() {
  std::vector<std::string_view> all;
  for (const InputFormat* format : formats()) {
    for (const Ending& ending : format->endings) all.push_back(ending.text);
  }
  std::string text;
  for (std::size_t k = 0; k < all.size(); ++k) {
    text += (k == 0 ? "" : k + 1 < all.size() ? ", " : " or ") + std::string(all[k]);
  }
  return text;
}

}  // namespace hysteron

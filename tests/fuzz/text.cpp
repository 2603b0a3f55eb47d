// Names of files and columns as a terminal and a result file get them.
#include "io/text.hpp"

#include <algorithm>

#include "core/printable.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::string_view text = fuzz::text_of(data, size);
  const std::string valid = valid_utf8(text);
  fuzz::require(valid_utf8(valid) == valid, "what is UTF-8 stays what it is");
  const std::string shown = printable(text);
  fuzz::require(printable(shown) == shown && valid_utf8(shown) == shown, "what can be shown stays what it is");
  fuzz::require(std::ranges::none_of(shown, [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; }),
                "nothing that is shown is a command");
  const std::string quoted = in_quotes(text);
  fuzz::require(quoted.size() < 200 && std::ranges::none_of(quoted, [](char c) { return c >= 0 && c < ' '; }),
                "a quotation is short and in one line");
  return 0;
}

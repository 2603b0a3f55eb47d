// A variable of a MAT file as both readers hand it over: every value was in the file, every size was checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hysteron {

struct MatVariable {
  enum class Kind : std::uint8_t { numbers, text, texts, other };
  using Field = std::pair<std::string, std::optional<std::string>>;

  std::string name;
  Kind kind = Kind::other;
  bool complex = false;
  bool damaged = false;  // it is there and cannot be read; the other members but the name say nothing
  std::size_t rows = 0;  // of numbers
  std::size_t columns = 0;
  std::vector<double> values;  // rows x columns, by columns
  std::string text;            // of a char array, UTF-8
  // Of a struct (`texts`): its texts, nothing where a field is not text. Of level 7.3 only those of units.
  std::vector<Field> fields;
};

// What is wrong with the file, without its name.
class MatDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Appends a character to UTF-8 text; what is not a character becomes U+FFFD.
void append_utf8(std::string& text, std::uint32_t character);
// UTF-16 units as UTF-8.
[[nodiscard]] std::string utf8_of_utf16(const std::vector<std::uint32_t>& units);

}  // namespace hysteron

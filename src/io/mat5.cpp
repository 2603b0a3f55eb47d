#include "io/mat5.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "io/text.hpp"

namespace hysteron {
namespace {

constexpr std::size_t header_size = 128;
constexpr std::size_t tag_size = 8;
// Of one variable, inflated. Far above any recording, and below what a machine of today runs out of.
constexpr std::size_t largest_variable = std::size_t{2} << 30U;

// Types of elements.
constexpr std::uint32_t type_int8 = 1;
constexpr std::uint32_t type_uint8 = 2;
constexpr std::uint32_t type_int16 = 3;
constexpr std::uint32_t type_uint16 = 4;
constexpr std::uint32_t type_int32 = 5;
constexpr std::uint32_t type_uint32 = 6;
constexpr std::uint32_t type_single = 7;
constexpr std::uint32_t type_double = 9;
constexpr std::uint32_t type_int64 = 12;
constexpr std::uint32_t type_uint64 = 13;
constexpr std::uint32_t type_matrix = 14;
constexpr std::uint32_t type_compressed = 15;
constexpr std::uint32_t type_utf8 = 16;
constexpr std::uint32_t type_utf16 = 17;
constexpr std::uint32_t type_utf32 = 18;

// Classes of arrays.
constexpr std::uint32_t class_struct = 2;
constexpr std::uint32_t class_char = 4;
constexpr std::uint32_t class_first_number = 6;
constexpr std::uint32_t class_last_number = 15;
constexpr std::uint32_t class_opaque = 17;  // laid out otherwise, not documented

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

// Bytes of a file or of a variable, taken from the front.
class Cursor {
 public:
  Cursor(std::string_view bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  [[nodiscard]] bool swapped() const { return swapped_; }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) {
      throw MatDamage("an element of " + std::to_string(count) + " bytes where " + std::to_string(bytes_.size()) +
                      " are left, the file is cut off or damaged");
    }
    const std::string_view result = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return result;
  }

  template <class T>
  T number() {
    return number_at<T>(take(sizeof(T)), 0, swapped_);
  }

  template <class T>
  static T number_at(std::string_view data, std::size_t index, bool swapped) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), data.data() + index * sizeof(T), sizeof(T));
    if (swapped) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

  // The next element; `padded` to eight bytes, as all inside a variable are.
  Element element(bool padded) {
    const auto first = number<std::uint32_t>();
    if (first >> 16U != 0) {  // up to four bytes, in the tag itself
      const std::size_t size = first >> 16U;
      if (size > 4) throw MatDamage("a small element of " + std::to_string(size) + " bytes, the file is damaged");
      return {first & 0xFFFFU, take(4).substr(0, size)};
    }
    const std::size_t size = number<std::uint32_t>();
    const Element result{first, take(size)};
    if (padded) take(std::min((8 - size % 8) % 8, left()));
    return result;
  }

 private:
  std::string_view bytes_;
  bool swapped_;
};

template <class T>
void append_numbers(std::string_view data, bool swapped, std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(Cursor::number_at<T>(data, i, swapped));
  }
}

std::size_t size_of_type(std::uint32_t type) {
  switch (type) {
    case type_int8:
    case type_uint8:
    case type_utf8:
      return 1;
    case type_int16:
    case type_uint16:
    case type_utf16:
      return 2;
    case type_int32:
    case type_uint32:
    case type_single:
    case type_utf32:
      return 4;
    case type_double:
    case type_int64:
    case type_uint64:
      return 8;
    default:
      return 0;
  }
}

// Exactly `count` numbers.
std::vector<double> numbers_of(const Element& element, bool swapped, std::size_t count, const std::string& name) {
  const std::size_t size = size_of_type(element.type);
  if (size == 0) throw MatDamage("variable " + in_quotes(name) + " holds no numbers, the file is damaged");
  if (element.data.size() / size != count || element.data.size() % size != 0) {
    throw MatDamage("variable " + in_quotes(name) + " holds " + std::to_string(element.data.size() / size) +
                    " values and its size says " + std::to_string(count) + ", the file is damaged");
  }
  if (count > largest_variable / sizeof(double)) {
    throw MatDamage("variable " + in_quotes(name) + " of " + std::to_string(count) + " values, expected at most " +
                    std::to_string(largest_variable / sizeof(double)));
  }
  std::vector<double> values(count);
  switch (element.type) {
    case type_int8:
      append_numbers<std::int8_t>(element.data, swapped, values);
      break;
    case type_uint8:
    case type_utf8:
      append_numbers<std::uint8_t>(element.data, swapped, values);
      break;
    case type_int16:
      append_numbers<std::int16_t>(element.data, swapped, values);
      break;
    case type_uint16:
    case type_utf16:
      append_numbers<std::uint16_t>(element.data, swapped, values);
      break;
    case type_int32:
      append_numbers<std::int32_t>(element.data, swapped, values);
      break;
    case type_uint32:
    case type_utf32:
      append_numbers<std::uint32_t>(element.data, swapped, values);
      break;
    case type_single:
      append_numbers<float>(element.data, swapped, values);
      break;
    case type_double:
      append_numbers<double>(element.data, swapped, values);
      break;
    case type_int64:
      append_numbers<std::int64_t>(element.data, swapped, values);
      break;
    default:
      append_numbers<std::uint64_t>(element.data, swapped, values);
  }
  return values;
}

// Text of a char array: bytes are UTF-8, two-byte units UTF-16. Ends at the first NUL.
std::string text_of(const Element& element, bool swapped) {
  std::string text;
  if (element.type == type_int8 || element.type == type_uint8 || element.type == type_utf8) {
    text = element.data;
  } else if (element.type == type_uint16 || element.type == type_utf16) {
    std::vector<std::uint32_t> units;
    for (std::size_t i = 0; i < element.data.size() / 2; ++i) {
      units.push_back(Cursor::number_at<std::uint16_t>(element.data, i, swapped));
    }
    text = utf8_of_utf16(units);
  } else if (element.type == type_utf32) {
    for (std::size_t i = 0; i < element.data.size() / 4; ++i) {
      append_utf8(text, Cursor::number_at<std::uint32_t>(element.data, i, swapped));
    }
  } else {
    throw MatDamage("a text of type " + std::to_string(element.type) + ", the file is damaged");
  }
  return std::string(trimmed(text.substr(0, text.find('\0'))));
}

Element expect(Cursor& cursor, std::uint32_t type, const char* what) {
  const Element element = cursor.element(true);
  if (element.type != type) {
    throw MatDamage(std::string(what) + " of type " + std::to_string(element.type) + ", expected " +
                    std::to_string(type) + ", the file is damaged");
  }
  return element;
}

MatVariable read_variable(std::string_view bytes, bool swapped, bool inside_struct);

// Of a struct of one element; the fields of others are not looked at.
void read_fields(Cursor& cursor, MatVariable& variable, std::size_t count) {
  const Element width_of_name = expect(cursor, type_int32, "the length of field names");
  if (width_of_name.data.size() != 4) throw MatDamage("a length of field names that is no number, the file is damaged");
  const auto width = Cursor::number_at<std::int32_t>(width_of_name.data, 0, cursor.swapped());
  const Element names = expect(cursor, type_int8, "field names");
  if (width <= 0 || names.data.size() % static_cast<std::size_t>(width) != 0) {
    throw MatDamage("field names of length " + std::to_string(width) + ", the file is damaged");
  }
  if (count != 1) return;
  variable.kind = MatVariable::Kind::texts;
  for (std::size_t at = 0; at < names.data.size(); at += static_cast<std::size_t>(width)) {
    const std::string_view name = names.data.substr(at, static_cast<std::size_t>(width));
    const Element element = expect(cursor, type_matrix, "a field");
    MatVariable::Field field{std::string(name.substr(0, name.find('\0'))), {}};
    if (!element.data.empty()) {
      MatVariable value = read_variable(element.data, cursor.swapped(), true);
      if (value.kind == MatVariable::Kind::text) field.second = std::move(value.text);
    }
    variable.fields.push_back(std::move(field));
  }
}

MatVariable read_variable(std::string_view bytes, bool swapped, bool inside_struct) {
  Cursor cursor(bytes, swapped);
  MatVariable variable;
  const Element flags = expect(cursor, type_uint32, "array flags");
  if (flags.data.size() != 8) throw MatDamage("array flags of a wrong size, the file is damaged");
  const auto word = Cursor::number_at<std::uint32_t>(flags.data, 0, swapped);
  const std::uint32_t array_class = word & 0xFFU;
  variable.complex = (word & 0x0800U) != 0;
  if (array_class == class_opaque) return variable;
  if (array_class == 0 || array_class > class_opaque) {
    throw MatDamage("an array of the unknown class " + std::to_string(array_class) + ", the file is damaged");
  }
  const Element dimensions = expect(cursor, type_int32, "dimensions");
  const std::size_t rank = dimensions.data.size() / 4;
  if (rank < 2 || dimensions.data.size() % 4 != 0) throw MatDamage("an array of wrong dimensions, the file is damaged");
  std::size_t count = 1;
  for (std::size_t i = 0; i < rank; ++i) {
    const auto size = Cursor::number_at<std::int32_t>(dimensions.data, i, swapped);
    if (size < 0 || (size > 0 && count > std::numeric_limits<std::size_t>::max() / static_cast<std::size_t>(size))) {
      throw MatDamage("an array of impossible dimensions, the file is damaged");
    }
    count *= static_cast<std::size_t>(size);
    if (i == 0) variable.rows = static_cast<std::size_t>(size);
    if (i == 1) variable.columns = static_cast<std::size_t>(size);
  }
  variable.name = expect(cursor, type_int8, "a name").data;
  variable.name.resize(std::min(variable.name.size(), variable.name.find('\0')));
  if (array_class >= class_first_number && array_class <= class_last_number) {
    variable.kind = rank == 2 ? MatVariable::Kind::numbers : MatVariable::Kind::other;
    variable.values = numbers_of(cursor.element(true), swapped, count, variable.name);
    if (variable.complex) numbers_of(cursor.element(true), swapped, count, variable.name);
  } else if (array_class == class_char) {
    variable.kind = MatVariable::Kind::text;
    variable.text = text_of(cursor.element(true), swapped);
  } else if (array_class == class_struct && !inside_struct) {
    read_fields(cursor, variable, count);
  } else {
    return variable;
  }
  if (cursor.left() >= tag_size && (variable.kind != MatVariable::Kind::other || array_class != class_struct)) {
    throw MatDamage("variable " + in_quotes(variable.name) + " is followed by " + std::to_string(cursor.left()) +
                    " bytes that belong to nothing, the file is damaged");
  }
  return variable;
}

class Inflater {
 public:
  explicit Inflater(std::string_view compressed) {
    // zlib takes its input by a pointer to non-const and does not write to it.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data()));
    stream_.avail_in = static_cast<uInt>(compressed.size());
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  // Exactly `count` bytes more.
  std::string take(std::size_t count) {
    std::string result;
    constexpr std::size_t step = 1U << 20U;
    while (result.size() < count && !ended_) {
      const std::size_t before = result.size();
      const std::size_t room = std::min(step, count - before);
      result.resize(before + room);
      step_into(result.data() + before, room);
      const std::size_t got = room - stream_.avail_out;
      result.resize(before + got);
      if (got == 0 && !ended_) break;
    }
    if (result.size() != count) throw MatDamage("a compressed variable ends early, the file is cut off or damaged");
    return result;
  }

  // The stream ends here, its checksum being right.
  void end() {
    if (ended_) return;
    char more = 0;
    step_into(&more, 1);
    if (!ended_ || stream_.avail_out == 0) {
      throw MatDamage("a compressed variable is longer than it says or ends early, the file is damaged");
    }
  }

 private:
  void step_into(char* out, std::size_t room) {
    stream_.next_out = reinterpret_cast<Bytef*>(out);
    stream_.avail_out = static_cast<uInt>(room);
    const int status = inflate(&stream_, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      throw MatDamage("a compressed variable cannot be unpacked, the file is damaged");
    }
    ended_ = status == Z_STREAM_END;
  }

  z_stream stream_{};
  bool ended_ = false;
};

std::string inflated(std::string_view compressed, bool swapped) {
  Inflater inflater(compressed);
  const std::string tag = inflater.take(tag_size);
  const auto type = Cursor::number_at<std::uint32_t>(tag, 0, swapped);
  const std::size_t size = Cursor::number_at<std::uint32_t>(tag, 1, swapped);
  if (type != type_matrix) throw MatDamage("a compressed element that is no variable, the file is damaged");
  if (size > largest_variable) {
    throw MatDamage("a variable of " + std::to_string(size) + " bytes, expected at most " +
                    std::to_string(largest_variable));
  }
  std::string result = inflater.take(size);
  inflater.end();
  return result;
}

}  // namespace

std::vector<MatVariable> read_mat5(std::string_view bytes) {
  if (bytes.size() < header_size) throw MatDamage("the header is cut off");
  const std::string_view endian = bytes.substr(126, 2);
  const bool little = endian == "IM";
  if (!little && endian != "MI") throw MatDamage("the header names no byte order");
  const bool swapped = little != (std::endian::native == std::endian::little);
  Cursor cursor(bytes.substr(header_size), swapped);
  std::vector<MatVariable> variables;
  while (cursor.left() > 0) {
    const Element element = cursor.element(false);
    if (element.type == type_compressed) {
      variables.push_back(read_variable(inflated(element.data, swapped), swapped, false));
    } else if (element.type == type_matrix) {
      if (element.data.empty()) continue;
      variables.push_back(read_variable(element.data, swapped, false));
    } else {
      throw MatDamage("an element of type " + std::to_string(element.type) +
                      " where a variable should begin, the file is damaged");
    }
  }
  return variables;
}

}  // namespace hysteron

#include "io/mat5_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "io/channels.hpp"

namespace hysteron {
namespace {

constexpr std::size_t longest_name = 63;
constexpr std::size_t name_width = 64;  // of the fields of a struct, with a NUL
constexpr std::uint32_t type_int8 = 1;
constexpr std::uint32_t type_uint16 = 4;
constexpr std::uint32_t type_int32 = 5;
constexpr std::uint32_t type_uint32 = 6;
constexpr std::uint32_t type_double = 9;
constexpr std::uint32_t type_matrix = 14;
constexpr std::uint32_t class_cell = 1;
constexpr std::uint32_t class_struct = 2;
constexpr std::uint32_t class_char = 4;
constexpr std::uint32_t class_double = 6;

static_assert(std::endian::native == std::endian::little, "the file says that it is little-endian");

template <class T>
std::string raw(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

// Padded to eight bytes.
std::string element(std::uint32_t type, const std::string& data) {
  if (data.size() > std::numeric_limits<std::int32_t>::max()) {
    throw WorkError("a variable of a MAT file would have more than 2 GiB, expected fewer samples, or CSV");
  }
  std::string bytes = raw<std::uint32_t>({type, static_cast<std::uint32_t>(data.size())}) + data;
  bytes.resize((bytes.size() + 7) / 8 * 8);
  return bytes;
}

std::string head(std::uint32_t array_class, std::size_t rows, std::size_t columns, std::string_view name) {
  return element(type_uint32, raw<std::uint32_t>({array_class, 0})) +
         element(type_int32, raw<std::int32_t>({static_cast<std::int32_t>(rows), static_cast<std::int32_t>(columns)})) +
         element(type_int8, std::string(name));
}

// UTF-8 as UTF-16 units; bytes that are none become U+FFFD.
std::vector<std::uint16_t> utf16_of(std::string_view text) {
  std::vector<std::uint16_t> units;
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t count = first < 0x80                    ? 1
                              : first >= 0xC2 && first < 0xE0 ? 2
                              : first >= 0xE0 && first < 0xF0 ? 3
                              : first >= 0xF0 && first < 0xF5 ? 4
                                                              : 0;
    std::uint32_t character = count == 1 ? first : count == 0 ? 0xFFFD : first & (0x7FU >> count);
    bool whole = count > 0 && at + count <= text.size();
    for (std::size_t k = 1; whole && k < count; ++k) {
      const auto next = static_cast<unsigned char>(text[at + k]);
      whole = (next & 0xC0U) == 0x80U;
      character = character << 6U | (next & 0x3FU);
    }
    if (!whole || (character >= 0xD800 && character < 0xE000) || character > 0x10FFFF) character = 0xFFFD;
    at += whole ? count : 1;
    if (character < 0x10000) {
      units.push_back(static_cast<std::uint16_t>(character));
    } else {
      units.push_back(static_cast<std::uint16_t>(0xD800U + ((character - 0x10000) >> 10U)));
      units.push_back(static_cast<std::uint16_t>(0xDC00U + ((character - 0x10000) & 0x3FFU)));
    }
  }
  return units;
}

std::string matrix_of(const MatValue& value, std::string_view name);

// Names of the fields or variables, "_2" and so on behind those that are there already.
std::vector<std::string> distinct_names(const MatValue::Fields& fields) {
  std::vector<std::string> names;
  for (const auto& [field, value] : fields) {
    const std::string name = mat_name(field);
    std::string candidate = name;
    for (int k = 2; std::ranges::find(names, candidate) != names.end(); ++k) {
      const std::string number = "_" + std::to_string(k);
      candidate = name.substr(0, longest_name - number.size()) + number;
    }
    names.push_back(candidate);
  }
  return names;
}

struct Matrix {
  std::string_view name;

  std::string operator()(const std::vector<double>& numbers) const {
    return head(class_double, numbers.size(), 1, name) + element(type_double, raw(numbers));
  }
  std::string operator()(const std::string& text) const {
    const std::vector<std::uint16_t> units = utf16_of(text);
    return head(class_char, units.empty() ? 0 : 1, units.size(), name) + element(type_uint16, raw(units));
  }
  std::string operator()(const std::vector<std::string>& texts) const {
    std::string bytes = head(class_cell, texts.size(), 1, name);
    for (const std::string& text : texts) bytes += matrix_of({text}, {});
    return bytes;
  }
  std::string operator()(const MatValue::Fields& fields) const {
    std::string names;
    for (const std::string& field : distinct_names(fields)) {
      names += field;
      names.resize((names.size() / name_width + 1) * name_width);
    }
    std::string bytes = head(class_struct, 1, 1, name);
    // The length of the names is a small element, with its four bytes in the tag.
    bytes += raw<std::uint32_t>({type_int32 | 4U << 16U, static_cast<std::uint32_t>(name_width)});
    bytes += element(type_int8, names);
    for (const auto& [field, value] : fields) bytes += matrix_of(value, {});
    return bytes;
  }
};

std::string matrix_of(const MatValue& value, std::string_view name) {
  return element(type_matrix, std::visit(Matrix{name}, value.value));
}

// The fields of the next line, taken from the text; quotes as report/csv.hpp writes them.
std::vector<std::string> next_record(std::string_view& text) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  std::size_t at = 0;
  for (; at < text.size() && (quoted || text[at] != '\n'); ++at) {
    const char c = text[at];
    if (c == '"') {
      if (quoted && at + 1 < text.size() && text[at + 1] == '"') {
        fields.back() += c;
        ++at;
      } else {
        quoted = !quoted;
      }
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  text.remove_prefix(std::min(at + 1, text.size()));
  return fields;
}

MatValue column_of(std::vector<std::string> cells) {
  std::vector<double> numbers;
  for (const std::string& cell : cells) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (!cell.empty() && (read.ec != std::errc() || read.ptr != cell.data() + cell.size())) return {std::move(cells)};
    numbers.push_back(value);
  }
  // Nothing in it at all tells of no number.
  if (std::ranges::all_of(cells, &std::string::empty)) return {std::move(cells)};
  return {std::move(numbers)};
}

}  // namespace

std::string mat_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (name.empty() && !letter) {
      if (digit) name = "x";
      if (!digit) continue;
    }
    if (letter || digit) {
      name += c;
    } else if (!name.ends_with('_')) {
      name += '_';
    }
  }
  name.resize(std::min(name.size(), longest_name));
  while (name.ends_with('_')) name.pop_back();
  return name.empty() ? "x" : name;
}

std::string mat5_of(const MatValue::Fields& variables) {
  std::string bytes = "MATLAB 5.0 MAT-file, written by hysteron";
  bytes.resize(116, ' ');
  bytes += std::string(8, '\0') + std::string("\x00\x01IM", 4);
  const std::vector<std::string> names = distinct_names(variables);
  for (std::size_t k = 0; k < variables.size(); ++k) bytes += matrix_of(variables[k].value, names[k]);
  return bytes;
}

std::string mat5_of_columns(std::string_view csv) {
  MatValue table = mat_table(csv);
  auto& columns = std::get<MatValue::Fields>(table.value);
  MatValue::Fields units;
  for (auto& [name, value] : columns) {
    const Column column = split_column(name);
    name = column.name;
    if (!column.unit.empty()) units.push_back({column.name, MatValue{column.unit}});
  }
  if (!units.empty()) columns.push_back({"units", MatValue{std::move(units)}});
  return mat5_of(columns);
}

MatValue mat_table(std::string_view csv) {
  const std::vector<std::string> names = next_record(csv);
  std::vector<std::vector<std::string>> columns(names.size());
  while (!csv.empty()) {
    std::vector<std::string> fields = next_record(csv);
    fields.resize(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) columns[k].push_back(std::move(fields[k]));
  }
  MatValue::Fields fields;
  for (std::size_t k = 0; k < names.size(); ++k) fields.push_back({names[k], column_of(std::move(columns[k]))});
  return {std::move(fields)};
}

}  // namespace hysteron

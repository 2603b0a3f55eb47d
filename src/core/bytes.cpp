#include "core/bytes.hpp"

#include <bit>
#include <cassert>
#include <cstring>

namespace hysteron {

void ByteWriter::whole(std::uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }

void ByteWriter::number(double value) { whole(std::bit_cast<std::uint64_t>(value)); }

void ByteWriter::text(std::string_view value) {
  whole(value.size());
  bytes_ += value;
}

void ByteWriter::numbers(const std::vector<double>& values) {
  whole(values.size());
  bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
}

std::uint64_t ByteReader::whole() {
  std::uint64_t value = 0;
  assert(rest_.size() >= sizeof value);
  std::memcpy(&value, rest_.data(), sizeof value);
  rest_.remove_prefix(sizeof value);
  return value;
}

double ByteReader::number() { return std::bit_cast<double>(whole()); }

std::vector<double> ByteReader::numbers() {
  std::vector<double> values(whole());
  assert(rest_.size() >= values.size() * sizeof(double));
  if (!values.empty()) {
    std::memcpy(values.data(), rest_.data(), values.size() * sizeof(double));
  }
  rest_.remove_prefix(values.size() * sizeof(double));
  return values;
}

}  // namespace hysteron

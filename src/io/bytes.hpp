// Numbers out of bytes of a file: every place is checked, so that no reader of a format sees a byte that is not there.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace hysteron {

// Bytes that a file names and does not have. Readers of formats turn it into an InputError with the file's name.
class BeyondTheEnd : public std::runtime_error {
 public:
  BeyondTheEnd() : std::runtime_error("the file is cut off or damaged") {}
};

// `count` bytes from `at` on; throws BeyondTheEnd.
inline std::string_view bytes_at(std::string_view bytes, std::uint64_t at, std::uint64_t count) {
  if (at > bytes.size() || count > bytes.size() - at) throw BeyondTheEnd();
  return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(count));
}

// A number as it lies in memory, of that byte order; throws BeyondTheEnd.
template <class T>
T number_at(std::string_view bytes, std::uint64_t at, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes_at(bytes, at, sizeof(T)).data(), sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(raw);
  return std::bit_cast<T>(raw);
}

// How a channel stores its numbers.
struct NumberLayout {
  enum class Kind : std::uint8_t { unsigned_integer, signed_integer, floating };
  Kind kind = Kind::floating;
  std::uint8_t size = 8;  // bytes: 1, 2, 4, 8 of integers, 4, 8 of floating numbers
  std::endian order = std::endian::little;
};

inline double value_at(std::string_view bytes, std::uint64_t at, const NumberLayout& layout) {
  const auto read = [&]<class T>(T /*type*/) { return static_cast<double>(number_at<T>(bytes, at, layout.order)); };
  switch (layout.kind) {
    case NumberLayout::Kind::floating:
      return layout.size == 4 ? read(float{}) : read(double{});
    case NumberLayout::Kind::signed_integer:
      return layout.size == 1   ? read(std::int8_t{})
             : layout.size == 2 ? read(std::int16_t{})
             : layout.size == 4 ? read(std::int32_t{})
                                : read(std::int64_t{});
    case NumberLayout::Kind::unsigned_integer:
      break;
  }
  return layout.size == 1   ? read(std::uint8_t{})
         : layout.size == 2 ? read(std::uint16_t{})
         : layout.size == 4 ? read(std::uint32_t{})
                            : read(std::uint64_t{});
}

// Reads forward from a place; throws BeyondTheEnd.
class ByteCursor {
 public:
  explicit ByteCursor(std::string_view bytes, std::endian order = std::endian::little) : bytes_(bytes), order_(order) {}

  [[nodiscard]] std::uint64_t left() const { return bytes_.size(); }
  std::string_view take(std::uint64_t count) {
    const std::string_view result = bytes_at(bytes_, 0, count);
    bytes_.remove_prefix(result.size());
    return result;
  }
  template <class T>
  T number() {
    return number_at<T>(take(sizeof(T)), 0, order_);
  }

 private:
  std::string_view bytes_;
  std::endian order_;
};

}  // namespace hysteron

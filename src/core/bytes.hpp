// Values as bytes and back, bit by bit: for keys, and for what one program keeps between its calls on one machine.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

class ByteWriter {
 public:
  void number(double value);
  void whole(std::uint64_t value);
  // With their lengths, so that no two sequences of values have the same bytes.
  void text(std::string_view value);
  void numbers(const std::vector<double>& values);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Takes what a ByteWriter was given, in the same order; anything else is a programmer's error.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  double number();
  std::uint64_t whole();
  std::vector<double> numbers();

 private:
  std::string_view rest_;
};

}  // namespace hysteron

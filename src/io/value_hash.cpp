#include "io/value_hash.hpp"

#include <bit>
#include <cstdint>

#include "io/sha256.hpp"

namespace hysteron {

std::string sha256_of_channels(std::initializer_list<const std::vector<double>*> channels) {
  std::string bytes;
  for (const std::vector<double>* channel : channels) {
    for (const double value : *channel) {
      auto word = std::bit_cast<std::uint64_t>(value);
      for (int k = 0; k < 8; ++k, word >>= 8U) bytes += static_cast<char>(word & 0xffU);
    }
    bytes += ';';
  }
  return sha256_hex(bytes);
}

std::string sha256_of_values(const Recording& recording) {
  const std::vector<double> none;
  return sha256_of_channels({&recording.time, &recording.displacement,
                             recording.velocity_measured ? &recording.velocity : &none, &recording.acceleration,
                             &recording.force, &recording.drive, &recording.temperature, &recording.base});
}

}  // namespace hysteron

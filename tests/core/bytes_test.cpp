#include "core/bytes.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

namespace hysteron {
namespace {

TEST(Bytes, ComeBackBitByBit) {
  const double nan = std::bit_cast<double>(0x7ff8000000000123ULL);
  const std::vector<double> values = {0.1, -0.0, nan, std::numeric_limits<double>::denorm_min()};
  ByteWriter writer;
  writer.numbers(values);
  writer.whole(~std::uint64_t{0});
  writer.number(-0.0);
  writer.numbers({});
  ByteReader reader(writer.bytes());
  const std::vector<double> back = reader.numbers();
  ASSERT_EQ(back.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[k]), std::bit_cast<std::uint64_t>(values[k])) << k;
  }
  EXPECT_EQ(reader.whole(), ~std::uint64_t{0});
  EXPECT_EQ(std::bit_cast<std::uint64_t>(reader.number()), std::bit_cast<std::uint64_t>(-0.0));
  EXPECT_TRUE(reader.numbers().empty());
}

TEST(Bytes, OfOtherSequencesAreOthers) {
  const auto texts = [](const char* a, const char* b) {
    ByteWriter writer;
    writer.text(a);
    writer.text(b);
    return writer.bytes();
  };
  EXPECT_NE(texts("ab", "c"), texts("a", "bc"));
  EXPECT_NE(texts("", "a"), texts("a", ""));
  ByteWriter parted;
  parted.numbers({1.0});
  parted.numbers({2.0, 3.0});
  ByteWriter other;
  other.numbers({1.0, 2.0});
  other.numbers({3.0});
  EXPECT_NE(parted.bytes(), other.bytes());
}

}  // namespace
}  // namespace hysteron

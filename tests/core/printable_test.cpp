#include "core/printable.hpp"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(Printable, TextOfAnyLanguageStaysWhatItIs) {
  for (const char* text : {"", "r1.csv", "Dämpfer 2,0 Hz.csv", "减振器.csv", "α·β²", "\xF0\x9F\x98\x80"}) {
    EXPECT_EQ(printable(text), text);
    EXPECT_EQ(valid_utf8(text), text);
  }
}

TEST(Printable, NothingReachesATerminalAsACommand) {
  EXPECT_EQ(printable("a\x1B[31mb"), "a\\x1B[31mb");
  EXPECT_EQ(printable("a\rb\nc\td"), "a b c d");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("\x7F"), "\\x7F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\x9B31m");  // a control sequence in one character
  EXPECT_EQ(printable("gpj\xE2\x80\xAE"
                      "csv"),
            "gpj\\u202Ecsv");
}

TEST(Printable, BytesThatAreNoTextAreSpelled) {
  for (const auto& shown : {printable, valid_utf8}) {
    EXPECT_EQ(shown("r\xE9.csv"), "r\\xE9.csv");
    EXPECT_EQ(shown("\xC0\xAF"), "\\xC0\\xAF");                    // overlong
    EXPECT_EQ(shown("\xE0\x80\xAF"), "\\xE0\\x80\\xAF");           // overlong
    EXPECT_EQ(shown("\xED\xA0\x80"), "\\xED\\xA0\\x80");           // a surrogate
    EXPECT_EQ(shown("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");  // beyond Unicode
    EXPECT_EQ(shown("\xE2\x82"), "\\xE2\\x82");                    // cut off
  }
  EXPECT_EQ(valid_utf8("a\x1B"), "a\x1B");
}

}  // namespace
}  // namespace hysteron

#include "external/line_program.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "core/error.hpp"

namespace hysteron {
namespace {

using Words = std::vector<std::string>;

TEST(LineProgram, CommandsArePartedAsAShellDoes) {
  EXPECT_EQ(words_of_command("python3 mine.py --n 3"), (Words{"python3", "mine.py", "--n", "3"}));
  EXPECT_EQ(words_of_command("  a\t b "), (Words{"a", "b"}));
  EXPECT_EQ(words_of_command("'a b' \"c d\"e \"\" f\\ g"), (Words{"a b", "c de", "", "f g"}));
  EXPECT_EQ(words_of_command("'a\\b' \"q\\\"q\" $HOME *"), (Words{"a\\b", "q\"q", "$HOME", "*"}));
  EXPECT_THROW(words_of_command(" "), InputError);
  EXPECT_THROW(words_of_command("a 'b"), InputError);
}

TEST(LineProgram, LinesGoBothWays) {
  LineProgram echo({"cat"});
  const std::string megabyte(1 << 20, 'x');
  for (const std::string& line : {std::string("one"), std::string("two words"), std::string("\xc3\xa9")}) {
    echo.write(line);
    EXPECT_EQ(echo.read(), line);
  }
  LineProgram counts({"sh", "-c", "while read line; do echo; echo ${#line}; done"});
  counts.write(megabyte);
  EXPECT_EQ(counts.read(), std::to_string(megabyte.size()));
}

// Waits until it has printed something, or has had the time to.
std::optional<std::string> unread(LineProgram& program) {
  for (int k = 0; k < 500; ++k) {
    if (auto line = program.unread()) return line;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

TEST(LineProgram, WhatWasPrintedUnaskedIsSeen) {
  LineProgram twice({"sh", "-c", "read line; echo one; echo; echo two"});
  EXPECT_EQ(twice.unread(), std::nullopt);
  twice.write("");
  EXPECT_EQ(twice.read(), "one");
  EXPECT_EQ(unread(twice), "two");
  LineProgram begun({"sh", "-c", "printf half; cat"});
  EXPECT_EQ(unread(begun), "half");
}

TEST(LineProgram, HowItEndsIsSaid) {
  EXPECT_EQ(LineProgram({"cat"}).end(), "");
  EXPECT_EQ(LineProgram({"sh", "-c", "cat; exit 3"}).end(), "'sh' ended with status 3");
  EXPECT_EQ(LineProgram({"sh", "-c", "cat; kill -9 $$"}).end(), "'sh' was ended by signal 9");
  // What it prints at its end is nobody's, and no reason for it to fail.
  EXPECT_EQ(LineProgram({"sh", "-c", "cat; seq 100000"}).end(), "");
}

TEST(LineProgram, AnEndIsAnErrorAndNoSignal) {
  EXPECT_THROW(LineProgram({"no-such-program-at-all"}), InputError);
  LineProgram ended({"true"});
  EXPECT_THROW(static_cast<void>(ended.read()), WorkError);
  // It closes its output before it ends.
  const auto until_it_has_ended = [&] {
    for (int k = 0; k < 5000; ++k) {
      ended.write("to nobody");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  EXPECT_THROW(until_it_has_ended(), WorkError);
}

}  // namespace
}  // namespace hysteron

#include "external/line_program.hpp"

#include <gtest/gtest.h>

#include <chrono>
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

// Messages name what a caller gives; how that is called is the caller's.
#include "core/message.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace hysteron {
namespace {

namespace fs = std::filesystem;

std::string shouted(Option option) { return "<" + std::string(name_of(option)) + ">"; }

TEST(Message, NamesOptionsAsTheCallerDoes) {
  const std::string name = "alpha";
  Message message = Option::by_current + " " + name + ": fixed, expected " + Option::bounds;
  message += " for it";
  EXPECT_EQ(message.plain(), "by current alpha: fixed, expected bounds for it");
  EXPECT_EQ(message.with(shouted), "<by-current> alpha: fixed, expected <bounds> for it");
}

TEST(Message, OfAnErrorBeginsWithItsFile) {
  const OptionError error("a.csv", 2, "no time, expected " + Message(Option::column) + " time=NAME");
  EXPECT_STREQ(error.what(), "a.csv:2: no time, expected column time=NAME");
  EXPECT_EQ(error.message().with(shouted), "a.csv:2: no time, expected <column> time=NAME");
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What stands between quotes in C++, comments and character literals left out.
std::vector<std::string> literals_of(const std::string& code) {
  static const std::regex token(R"re(//[^\n]*|'(?:[^'\\\n]|\\.)'|"((?:[^"\\\n]|\\.)*)")re");
  std::vector<std::string> result;
  for (std::sregex_iterator at(code.begin(), code.end(), token), end; at != end; ++at) {
    if ((*at)[1].matched) result.push_back((*at)[1].str());
  }
  return result;
}

const std::regex option_word("(^|[^-A-Za-z0-9])--[a-z].*");

TEST(Messages, ALiteralWithAnOptionIsFound) {
  const std::vector<std::string> found = literals_of("f(\"use --bounds\", '\"', i--); // \"--out\"\n\"a\\\" --b\"");
  ASSERT_EQ(found.size(), 2U);
  for (const std::string& text : found) EXPECT_TRUE(std::regex_search(text, option_word)) << text;
  EXPECT_FALSE(std::regex_search(std::string("----  ---, a -- b"), option_word));
}

// Only src/app knows how options are called on the command line.
TEST(Messages, OfTheLibraryHaveNoOptionsOfTheCommandLine) {
  // Reads the words of a command line, to keep it among the results.
  const fs::path of_commands = "command_text.cpp";
  std::size_t seen = 0;
  for (const fs::directory_entry& room : fs::directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / "src")) {
    if (!room.is_directory() || room.path().filename() == "app") continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(room.path())) {
      const fs::path& path = entry.path();
      if ((path.extension() != ".cpp" && path.extension() != ".hpp") || path.filename() == of_commands) continue;
      for (const std::string& text : literals_of(text_of(path))) {
        ++seen;
        EXPECT_FALSE(std::regex_search(text, option_word)) << path.string() << ": \"" << text << '"';
      }
    }
  }
  EXPECT_GT(seen, 1000U);
}

TEST(Messages, NameOptionsThatTheCommandLineHas) {
  std::string program;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / "src/app")) {
    program += text_of(entry.path());
  }
  for (const Option option : all_options()) {
    const std::string opening = "\"--" + std::string(name_of(option));
    EXPECT_NE(program.find(opening + '"'), std::string::npos) << opening;
  }
}

}  // namespace
}  // namespace hysteron

// `--out -`: the result alone on standard output, words on standard error, and a failure where it cannot be written.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Words = std::vector<std::string>;

class StandardOutput : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    fit();
    write(folder_ / "push.csv",
          "time [s],force [N]\n0,0\n0.1,50\n0.2,100\n0.3,50\n0.4,0\n0.5,-50\n0.6,-100\n0.7,-50\n0.8,0\n");
  }
  static Words with(Words words, const std::string& out) {
    words.insert(words.end(), {"--out", out});
    return words;
  }
  // Files and folders there before and after.
  [[nodiscard]] std::set<std::string> there() const {
    std::set<std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) result.insert(entry.path().string());
    return result;
  }
  // Commands that write one result, and the file of it where `--out` names a folder.
  static std::vector<std::pair<Words, std::string>> commands() {
    return {
        {{"simulate", "fitted/model.json", "data/r1.csv"}, ""},
        {{"respond", "fitted/model.json", "push.csv", "--mass", "20", "--stiffness", "1e4", "--drive", "0.5"}, ""},
        {{"fit", "data", "--model", "viscous", "--budget", "200", "--quiet"}, "model.json"},
        {{"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects", "coulomb-friction", "--laws",
          "none", "--quiet"},
         "diagnosis.json"},
        {{"compare", "fitted/model.json", "data", "--quiet"}, "compare.json"},
        {{"minimise", "--objective", "python3 " HYSTERON_SOURCE_DIR "/examples/solver/objective.py", "--box",
          "x=-2:2,y=-1:3", "--solver", "pso", "--budget", "60", "--quiet"},
         ""},
        {{"generate", "rd8040-twin", "--only", "2.0Hz_1.0A"}, "*"},
    };
  }
};

TEST_F(StandardOutput, HasTheBytesOfTheFile) {
  int k = 0;
  for (const auto& [words, file] : commands()) {
    const std::string out = "out" + std::to_string(k++);
    ASSERT_EQ(run(with(words, out)).status, 0) << words[0];
    fs::path written = folder_ / out;
    if (file == "*") {
      ASSERT_EQ(std::distance(fs::directory_iterator(written), fs::directory_iterator()), 1) << words[0];
      written = fs::directory_iterator(written)->path();
    } else if (!file.empty()) {
      written /= file;
    }
    const auto before = there();
    const Outcome outcome = run(with(words, "-"));
    ASSERT_EQ(outcome.status, 0) << words[0] << ": " << outcome.err;
    EXPECT_EQ(there(), before) << words[0] << " wrote files too";
    EXPECT_NE(outcome.out, "") << words[0];
    EXPECT_EQ(outcome.out, read(written)) << words[0];
  }
}

TEST_F(StandardOutput, ThatCannotBeWrittenIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const auto& [words, file] : commands()) {
    const Outcome outcome =
        testing::run(with(words, "-"), folder_, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
    EXPECT_EQ(outcome.status, 1) << words[0];
    EXPECT_NE(outcome.err.find("error: standard output cannot be written"), std::string::npos) << outcome.err;
  }
}

TEST_F(StandardOutput, IsRefusedWhereAFolderIsWritten) {
  write(folder_ / "study.toml", "schema = \"hysteron.study/1\"\n");
  for (const Words& words : {Words{"bench", "study.toml"},
                             {"challenge", "--campaigns", "1"},
                             {"merge", "part1"},
                             {"report", "fitted"},
                             {"reproduce", "table-v"},
                             {"generate", "rd8040-twin"},
                             {"export", "fitted/model.json", "--to", "c"}}) {
    const auto before = there();
    const Outcome outcome = run(with(words, "-"));
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_EQ(outcome.out, "") << words[0];
    EXPECT_TRUE(outcome.err.starts_with("error: --out -: several files are written")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(there(), before) << words[0];
  }
}

}  // namespace
}  // namespace hysteron

// What a shell offers: bash itself completes, fish is read.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using testing::Outcome;
using testing::Program;
using testing::write;

class Completion : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write(folder_ / "completion.bash", run({"completion", "bash"}).out);
  }

  // What bash offers for the last of these words, one a line.
  [[nodiscard]] std::string offered(const std::vector<std::string>& words) const {
    std::string line;
    for (const std::string& word : words) line += " '" + word + "'";
    const std::string script = "source completion.bash; COMP_WORDS=(hysteron" + line +
                               "); COMP_CWORD=" + std::to_string(words.size()) +
                               "; _hysteron; printf '%s\\n' \"${COMPREPLY[@]}\"";
    return testing::finish(testing::start_other("/bin/bash", {"--norc", "-c", script}, folder_), folder_).out;
  }
};

TEST_F(Completion, OffersArguments) {
  if (std::system("command -v /bin/bash > /dev/null") != 0) GTEST_SKIP() << "bash is not installed";
  EXPECT_EQ(offered({"list", ""}), "models\nsolvers\neffects\ndatasets\ntables\n");
  EXPECT_EQ(offered({"list", "--json", "mo"}), "models\n");
  EXPECT_EQ(offered({"describe", "bouc"}), "bouc-wen\n");
  EXPECT_EQ(offered({"describe", "cle"}), "clearance\n");
  EXPECT_EQ(offered({"describe", "spencer"}), "spencer-1997\n");
  EXPECT_EQ(offered({"describe", "shuffled"}), "shuffled-frog-leaping\n");
  EXPECT_EQ(offered({"generate", "utfsm"}), "utfsm-mr-damper\n");
  EXPECT_EQ(offered({"reproduce", "table-vi"}), "table-vi\ntable-vii\ntable-viii\n");
  EXPECT_EQ(offered({"completion", ""}), "bash\nzsh\nfish\n");
  EXPECT_EQ(offered({"challenge", "--effect", "cle"}), "clearance\n");
}

TEST_F(Completion, OffersOptionsAndLeavesFilesToTheShell) {
  if (std::system("command -v /bin/bash > /dev/null") != 0) GTEST_SKIP() << "bash is not installed";
  EXPECT_EQ(offered({"describe", "--fig"}), "--figure\n");
  EXPECT_EQ(offered({"describe", "--figure", ""}), "\n");  // files
  EXPECT_EQ(offered({"describe", "bouc-wen", ""}), "\n");  // one is all it takes
  EXPECT_EQ(offered({"generate", "rd8040-twin", "--out", ""}), "\n");
  EXPECT_EQ(offered({"fit", ""}), "\n");
}

TEST_F(Completion, OfFishAndZshKnowsTheSame) {
  const std::string fish = run({"completion", "fish"}).out;
  for (const char* line : {"__fish_seen_subcommand_from list; and not __fish_seen_subcommand_from models",
                           "__fish_seen_subcommand_from generate; and not", "-f -a 'models solvers effects"}) {
    EXPECT_NE(fish.find(line), std::string::npos) << line;
  }
  EXPECT_NE(run({"completion", "zsh"}).out.find("list|--help|--json|--quiet) words=\"models solvers"),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron

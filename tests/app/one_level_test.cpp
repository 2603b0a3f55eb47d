// Laws in what the fitted recordings hold one value of, whatever those held out hold: `fit` and `diagnose` refuse them
// in the same line. Every test runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using testing::Outcome;
using testing::Program;
using testing::write;

class OneLevel : public Program {
 protected:
  void refused(std::vector<std::string> laws, const std::string& line) const {
    for (const char* command : {"fit", "diagnose"}) {
      std::vector<std::string> words{command, "levels", "--model", "viscous", "--out", "out"};
      words.insert(words.end(), laws.begin(), laws.end());
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.status, 2) << command;
      EXPECT_EQ(outcome.err, "error: " + line + "\n") << command;
      EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << command;
    }
  }
  void declare(const std::string& laws) const {
    write(folder_ / "levels/campaign.toml", "schema = \"hysteron.campaign/1\"\n" + laws +
                                                "[[recording]]\nfile = \"r1.csv\"\npressure = \"2 bar\"\n"
                                                "[[recording]]\nfile = \"r2.csv\"\npressure = \"2 bar\"\n"
                                                "[[recording]]\nfile = \"r3.csv\"\npressure = \"3 bar\"\n"
                                                "role = \"validate\"\n");
  }
  void SetUp() override {
    Program::SetUp();
    write(folder_ / "levels/r1.csv", testing::csv(1.0, 0.5));
    write(folder_ / "levels/r2.csv", testing::csv(1.5, 0.5));
    write(folder_ / "levels/r3.csv", testing::csv(2.0, 1.5));
  }
};

TEST_F(OneLevel, ThatThoseHeldOutDoNotMend) {
  const std::string drive =
      "the recordings that are fitted hold no current or voltage, or only one level of it, expected at least two "
      "levels";
  declare("");
  refused({"--by-current", "c0:1"}, "--by-current c0:1: " + drive);
  refused({"--by", "pressure=c0:1"},
          "--by pressure=c0:1: the recordings that are fitted hold only one pressure, expected at least two");
  declare("[by_current]\nc0 = 1\n");
  refused({}, "levels/campaign.toml:3: a law in the current of 'c0', and " + drive + ", or --by-current c0:0");
}

// Without laws none is assumed that could not be found.
TEST_F(OneLevel, OfTheDriveBringsNoLawOfItsOwn) {
  declare("");
  const Outcome outcome = run({"diagnose", "levels", "--model", "viscous", "--effects", "inertia", "--laws", "none",
                               "--out", "out", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(testing::read(folder_ / "out/report.html")
                .find("the fitted recordings hold one level of the drive, and those held out another: no law in the "
                      "drive can be found from them"),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron

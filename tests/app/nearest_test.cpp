// Mistyped names and files are answered with the nearest one, and budgets are read alike everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;

using Nearest = Program;

TEST_F(Nearest, NamesAndFilesAreOffered) {
  fit();
  testing::write(folder_ / "typed/r1.csv", testing::csv(1.0, 0.2));
  testing::write(folder_ / "typed/campaign.toml",
                 "schema = \"hysteron.campaign/1\"\n[[recording]]\nfile = \"r1.cvs\"\n");
  struct Typed {
    std::vector<std::string> words;
    std::string offered;
  };
  const std::vector<Typed> cases = {
      {{"score", "fitted/mdel.json", "data"}, "model.json"},
      {{"score", "fitted/model.json", "data/r1.cvs"}, "r1.csv"},
      {{"simulate", "fitted/modle.json", "data/r1.csv", "--out", "out"}, "model.json"},
      {{"fit", "dat", "--model", "viscous", "--out", "out"}, "data"},
      {{"fit", "data", "--model", "viscos", "--out", "out"}, "viscous"},
      {{"fit", "data", "--model", "viscous", "--solver", "psoo", "--out", "out"}, "pso"},
      {{"fit", "data", "--model", "bouc-wen", "--by-current", "alpa:1", "--out", "out"}, "alpha"},
      {{"diagnose", "data", "--effects", "clerance", "--out", "out"}, "clearance"},
      {{"fit", "data", "--model", "viscous", "--solver", "PSO", "--out", "out"}, "pso"},
      {{"fit", "data", "--model", "Viscos", "--out", "out"}, "viscous"},
      {{"fit", "data", "--model", "viscous", "--bounds", "c=1:2", "--out", "out"}, "c0"},
      {{"fit", "data", "--model", "bouc-wen", "--bounds", "ALPHA=1:2", "--out", "out"}, "alpha"},
      {{"fit", "data", "--model", "viscous", "--column", "forse=force", "--out", "out"}, "force"},
      {{"export", "fitted/model.json", "--to", "C", "--out", "out"}, "c"},
      {{"fit", "typed", "--model", "viscous", "--out", "out"}, "r1.csv"},
      {{"profile", "data", "--model", "viscous", "--solver", "psoo"}, "pso"},
      {{"generate", "rd8040-twn", "--out", "out"}, "rd8040-twin"},
      {{"describe", "bouc-wn"}, "bouc-wen"},
      {{"reproduce", "table-vv"}, "table-v"},
      {{"export", "fitted/model.json", "--to", "pyton", "--out", "out"}, "python"},
      {{"report", "fited"}, "fitted"},
      {{"fit", "data", "--model", "viscous", "--normalisation", "maxabs", "--out", "out"}, "max-abs"},
      {{"challenge", "--out", "out", "--effect", "clerance"}, "clearance"},
      {{"challenge", "--out", "out", "--level", "plan"}, "plain"},
      {{"challenge", "--out", "out", "--forms", "clearance/hertzz"}, "clearance/hertz"},
  };
  for (const Typed& typed : cases) {
    const Outcome outcome = run(typed.words);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("(did you mean '" + typed.offered + "'?)"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << typed.words[0];
  }
}

TEST_F(Nearest, ABudgetMayBeAPowerOfTenInEveryCommand) {
  const std::vector<std::vector<std::string>> commands = {
      {"fit", "data", "--model", "viscous", "--solver", "pso", "--quiet", "--out", "out"},
      {"minimise", "--objective", "python3 " HYSTERON_SOURCE_DIR "/examples/solver/objective.py", "--box",
       "x=-2:2,y=-1:3", "--solver", "pso", "--quiet"},
      {"profile", "data", "--model", "viscous", "--solver", "pso", "--quiet"},
      {"reproduce", "table-vi", "--seeds", "1", "--quiet"},
  };
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--budget", "2e1"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << ": " << outcome.err;
    words.back() = "2e1.5";
    EXPECT_EQ(run(words).status, 2) << words[0];
  }
  for (const auto& [budget, status] : {std::pair("[2e1]", 0), {"2e1", 0}, {"2.5", 2}, {"1e300", 2}}) {
    testing::write(folder_ / "study.toml",
                   std::string("schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nseeds = 1\n"
                               "budgets = ") +
                       budget + "\n[[data]]\nrecordings = \"data/r1.csv\"\n");
    const Outcome outcome = run({"bench", "study.toml", "--quiet", "--out", std::string("study") + budget});
    EXPECT_EQ(outcome.status, status) << budget << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace hysteron

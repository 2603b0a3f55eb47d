// What the parser of the command line refuses is told in the program's words.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using testing::Outcome;
using testing::Program;

using Complaint = Program;

TEST_F(Complaint, SaysWhatIsExpected) {
  struct Typed {
    std::vector<std::string> words;
    std::string says;
  };
  const Typed cases[] = {
      {{"fit", "data"},
       "fit: --out is missing, expected folder for model.json, fit.json, report.html (see hysteron fit --help)"},
      {{"fit", "data", "--column", "time=t", "displacement=x", "--out", "out"},
       "'displacement=x' is no file, expected --column before each mapping: --column 'displacement=x'"},
      {{"score"},
       "score: MODEL is missing, expected model.json written by fit or diagnose (see hysteron score --help)"},
      {{"fit", "data", "--out"},
       "--out: no value is given, expected folder for model.json, fit.json, report.html (see hysteron fit --help)"},
      {{"fit", "data", "--out", "a", "--out", "b"},
       "--out: one is expected, 2 were given: a, b (see hysteron fit --help)"},
      {{"export", "a.json", "b.json", "--to", "c", "--out", "out"},
       "MODEL: one is expected, 2 were given: a.json, b.json (see hysteron export --help)"},
      {{"describe", "viscous", "bingham", "lugre"},
       "NAME: one is expected, 3 were given: viscous, bingham, lugre (see hysteron describe --help)"},
      {{"simulate", "a", "b", "c", "--out", "out"},
       "MODEL RECORDING: at most 2 are expected, 3 were given: a, b, c (see hysteron simulate --help)"},
      {{"respond", "a", "b", "c", "--mass", "1", "--out", "out"},
       "EXCITATION: one is expected, 2 were given: b, c (see hysteron respond --help)"},
      {{"compare", "a", "--out", "out"},
       "MODEL.json DATA: at least 2 are expected, one was given: a (see hysteron compare --help)"},
      {{"challenge", "a"}, "challenge: 'a' is not expected, it takes options alone (see hysteron challenge --help)"},
      {{"list", "model"},
       "KIND: 'model' is not known (did you mean 'models'?), expected models, solvers, effects, datasets or tables "
       "(see "
       "hysteron list --help)"},
      {{"fit", "data", "--weighting", "equal", "--out", "out"},
       "--weighting: 'equal' is not known, expected per-recording or pooled (see hysteron fit --help)"},
      {{"export", "a", "--to", "c", "--substeps", "1.5", "--out", "out"},
       "--substeps: '1.5' is not a whole number from 0 to 65536 (see hysteron export --help)"},
      {{"fit", "data", "--mass", "2", "--out", "out"},
       "--mass: expected --response beside it (see hysteron fit --help)"},
      {{"challenge", "--in", "data", "--level", "plain"},
       "--in: expected no --level beside it (see hysteron challenge --help)"},
      {{"--plugin"},
       "--plugin: no value is given, expected library with models, effects or solvers of your own, see "
       "docs/plugins.md (see hysteron --help)"},
  };
  for (const Typed& typed : cases) {
    const Outcome outcome = run(typed.words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "error: " + typed.says + "\n");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

// How many words there may be is said as of every other command.
TEST_F(Complaint, UsageCountsNoWords) {
  const std::string help = run({"compare", "--help"}).out;
  EXPECT_NE(help.find("[OPTIONS] MODEL.json DATA...\n"), std::string::npos) << help;
  EXPECT_EQ(help.find(" x 2"), std::string::npos) << help;
  const std::string other = run({"simulate", "--help"}).out;
  EXPECT_NE(other.find("[OPTIONS] MODEL RECORDING\n"), std::string::npos) << other;
}

}  // namespace
}  // namespace hysteron

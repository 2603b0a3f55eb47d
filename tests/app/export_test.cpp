// What `export` refuses: in one line, with nothing written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;

class Exported : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    fit();
  }

  // One line that holds these words, and nothing written.
  void refused(const std::vector<std::string>& words, const std::string& expected, int status = 2) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, status) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    EXPECT_FALSE(fs::exists(folder_ / "class.py"));
  }

  // The fitted model with an offset that follows a pressure of 1 to 3 bar.
  void write_pressed() const {
    nlohmann::json model = nlohmann::json::parse(testing::read(folder_ / "fitted/model.json"));
    model["by"]["pressure"] = {{"unit", "Pa"}, {"from", 1e5}, {"to", 3e5}, {"parameters", {{"f0", 1}}}};
    model["parameters"].push_back({{"name", "f0*pressure"},
                                   {"parameter", "f0"},
                                   {"condition_powers", {{"pressure", 1}}},
                                   {"value", 1e-5},
                                   {"unit", "N/Pa"}});
    testing::write(folder_ / "pressed.json", model.dump());
  }
};

TEST_F(Exported, AModelWithoutAFiniteForceIsRefused) {
  const fs::path path = folder_ / "fitted/model.json";
  nlohmann::json model = nlohmann::json::parse(testing::read(path));
  for (nlohmann::json& parameter : model["parameters"]) {
    if (parameter["name"].get<std::string>().starts_with("c0")) parameter["value"] = 1.7e308;
  }
  testing::write(path, model.dump());
  for (const char* target : {"c", "python", "fmu", "simulink", "modelica"}) {
    refused({"export", "fitted/model.json", "--to", target, "--out", "out"},
            "expected the motion of a recording that the model holds for", 1);
  }
}

TEST_F(Exported, StepsThatAreTooFewAreRefusedAndOthersSayWhatTheyCost) {
  const Outcome outcome = run({"export", "fitted/model.json", "--to", "c", "--substeps", "64", "--out", "fixed"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("differs from that of `simulate`"), std::string::npos) << outcome.out;
  const Outcome free = run({"export", "fitted/model.json", "--to", "c", "--out", "free"});
  EXPECT_EQ(free.out.find("differs from that of `simulate`"), std::string::npos) << free.out;
}

// Their replay would call itself wrong, and nothing would say why.
TEST_F(Exported, CornersOfTheMotionAreTold) {
  std::string triangle = "time [s],displacement [mm],force [N],current [A]\n";
  for (int n = 0; n < 200; ++n) {
    const double turn = std::fmod(0.0125 * n + 0.0031, 1.0);
    triangle += std::to_string(0.01 * n) + "," + std::to_string(20.0 * std::fabs(turn - 0.5)) + ",1,0.5\n";
  }
  testing::write(folder_ / "triangle.csv", triangle);
  const Outcome told = run({"export", "fitted/model.json", "--to", "c", "--motion", "triangle.csv", "--out", "c"});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.out.find("corners, where straight lines of it meet"), std::string::npos) << told.out;
  const Outcome sine = run({"export", "fitted/model.json", "--to", "c", "--out", "plain"});
  EXPECT_EQ(sine.out.find("corner"), std::string::npos) << sine.out;
}

TEST_F(Exported, NamesThatNoLanguageTakesAreRefused) {
  const auto named = [](const std::string& name) {
    return std::vector<std::string>{"export", "fitted/model.json", "--to", "c", "--name", name, "--out", "out"};
  };
  refused(named("class"), "error: --name: 'class' is a word of C++, Python and Modelica, expected another name");
  refused(named("2nd"), "error: --name: '2nd' is not an identifier, expected a letter, then letters, digits and");
  refused({"export", "fitted/model.json", "--to", "python", "--out", "class.py"},
          "error: --out: 'class' is a word of C++, Python and Modelica, expected another file or --name NAME");
}

TEST_F(Exported, AFileOfAnotherKindIsNoFolder) {
  for (const auto& [target, out] : {std::pair{"c", "out.h"}, {"fmu", "out.zip"}, {"modelica", "out.mo"}}) {
    refused({"export", "fitted/model.json", "--to", target, "--out", out},
            std::string("error: --out ") + out + ": " + target + " is not written as ");
    EXPECT_FALSE(fs::exists(folder_ / out));
  }
}

TEST_F(Exported, WhatIsNoModelIsRefusedWithTheOneThatIs) {
  refused({"export", "fitted", "--to", "c", "--out", "out"},
          "error: fitted: is a folder, expected the file in it: fitted/model.json\n");
  refused({"export", "fitted/fit.json", "--to", "c", "--out", "out"},
          "is another kind of result, expected a model.json, which fit and diagnose write beside it\n");
  refused({"compare", "fitted", "data", "--out", "out"}, "expected files that end in .json, as fitted/model.json\n");
  refused({"compare", "fitted/model.json", "fitted/model.json", "--out", "out"}, "models alone are given");
  testing::write(folder_ / "shaker.csv",
                 "time [s],Voima [N]\n0,1\n0.1,2\n0.2,3\n0.3,1\n0.4,1\n0.5,2\n0.6,3\n0.7,1\n0.8,2\n");
  refused({"respond", "fitted/model.json", "shaker.csv", "--mass", "1", "--out", "out"},
          "shaker.csv: no force and no base or displacement column, expected one of them, or --column force=NAME");
}

// Every text that is written, of all targets.
std::string all_of(const fs::path& folder) {
  std::string text;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) text += testing::read(entry.path());
  }
  return text;
}

TEST_F(Exported, WhatIsWrittenSaysWhatTheDriveIs) {
  for (const char* target : {"c", "python", "simulink", "modelica"}) {
    const fs::path out = folder_ / target;
    ASSERT_EQ(run({"export", "fitted/model.json", "--to", target, "--out", target}).status, 0) << target;
    const std::string text = all_of(out);
    EXPECT_EQ(text.find("@drive@"), std::string::npos) << target;
    EXPECT_EQ(text.find("A or V"), std::string::npos) << target << " knows that it is a current";
  }
  EXPECT_NE(testing::read(folder_ / "python/bouc_wen.py").find("the drive in A;"), std::string::npos);
  EXPECT_NE(testing::read(folder_ / "c/bouc_wen.h").find("drive;        /* A */"), std::string::npos);
}

TEST_F(Exported, WhatIsWrittenSaysAtWhichConditionsItHolds) {
  write_pressed();
  for (const auto& [target, file] : {std::pair{"c", "c/bouc_wen.h"},
                                     {"python", "python/bouc_wen.py"},
                                     {"simulink", "simulink/bouc_wen_sfun.c"},
                                     {"modelica", "modelica/bouc_wen/package.mo"}}) {
    const Outcome outcome = run({"export", "pressed.json", "--to", target, "--at", "pressure=2 bar", "--out", target});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(testing::read(folder_ / file).find("at pressure = 200000 Pa"), std::string::npos) << target;
  }
}

// As simulate, score and respond refuse it.
TEST_F(Exported, AVoltageIsNoCurrent) {
  std::string volts = testing::csv(1.0, 12.0);
  volts.replace(volts.find("current [A]"), 11, "voltage [V]");
  testing::write(folder_ / "volts.csv", volts);
  refused(
      {"export", "fitted/model.json", "--to", "c", "--motion", "volts.csv", "--out", "out"},
      "error: volts.csv: records a voltage, expected a current: parameters of fitted/model.json follow the current");
}

TEST_F(Exported, AMotionBeyondWhatWasFittedIsTold) {
  testing::write(folder_ / "far.csv", testing::csv(1.0, 9.0));
  const auto told = [&](const std::string& motion) {
    const Outcome outcome = run({"export", "fitted/model.json", "--to", "c", "--motion", motion, "--out", "moved"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(told("far.csv"),
            "warning: far.csv: a current of 9 A, and the laws of fitted/model.json were fitted from 0.2 to 0.8 A: what "
            "they say beyond is a guess\n");
  EXPECT_EQ(told("data/r1.csv"), "");
  std::string wide = testing::csv(1.0, 0.5);
  for (const auto& [from, to] : {std::pair{"[m]", "[dam]"}, {"[m/s]", "[dam/s]"}}) {
    wide.replace(wide.find(from), std::string(from).size(), to);
  }
  testing::write(folder_ / "wide.csv", wide);
  EXPECT_NE(told("wide.csv").find("wide.csv: a displacement of "), std::string::npos);
}

TEST_F(Exported, AConditionHeldBeyondWhatWasFittedIsTold) {
  write_pressed();
  const auto told = [&](const std::string& at) {
    const Outcome outcome = run({"export", "pressed.json", "--to", "c", "--at", at, "--out", "pressed"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(told("pressure=2.1 bar"), "");
  const std::string fitted = ", and its laws were fitted from 1e+05 to 3e+05 Pa: what they say beyond is a guess\n";
  EXPECT_EQ(told("pressure=-3 bar"), "warning: pressed.json: held at a pressure of -3e+05 Pa" + fitted);
  EXPECT_EQ(told("pressure=2"), "warning: pressed.json: held at a pressure of 2 Pa" + fitted);
}

// Copied without it a model that follows the current runs at 0 A.
TEST_F(Exported, TheExampleInTheHeaderSetsTheDriveWhereThereIsOne) {
  ASSERT_EQ(run({"export", "fitted/model.json", "--to", "c", "--out", "c"}).status, 0);
  EXPECT_NE(testing::read(folder_ / "c/bouc_wen.h").find(" *     now.drive = ...;    in A\n"), std::string::npos);
  ASSERT_EQ(run({"fit", "data", "--model", "viscous", "--quiet", "--out", "plain"}).status, 0);
  ASSERT_EQ(run({"export", "plain/model.json", "--to", "c", "--out", "without"}).status, 0);
  const std::string header = testing::read(folder_ / "without/viscous.h");
  EXPECT_NE(header.find("now.velocity = ...;\n"), std::string::npos);
  EXPECT_EQ(header.find("now.drive"), std::string::npos);
}

}  // namespace
}  // namespace hysteron

// What a reader assumed, and what a model does not know, is said by every command that uses it. Every test runs
// HYSTERON_PROGRAM in a temporary folder of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::csv;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Words = std::vector<std::string>;

class Remarks : public Program {
 protected:
  static constexpr const char* assumed = "displacement has no unit and was taken in m: a stroke of 40 m";

  // Sines of 20 mm without a unit, and of a force where that is asked.
  static std::string millimetres(bool force) {
    std::string text = force ? "time,displacement,force\n" : "time,displacement\n";
    for (int n = 0; n < 80; ++n) {
      const double t = 0.025 * n;
      const double phase = 2.0 * std::numbers::pi * t;
      text += std::to_string(t) + "," + std::to_string(20.0 * std::sin(phase));
      text += force ? "," + std::to_string(100.0 * std::cos(phase)) + "\n" : "\n";
    }
    return text;
  }
};

// A file that names its base holds the motion relative to it beside it, as what `respond` writes.
TEST_F(Remarks, ABaseIsTheColumnOfThatName) {
  fit();
  const auto moved = [&](const std::string& name, const std::string& head, bool both) {
    std::string text = head + "\n";
    for (int n = 0; n < 200; ++n) {
      const double t = 0.01 * n;
      text += std::to_string(t) + "," + std::to_string(5.0 * std::sin(9.0 * t)) +
              (both ? "," + std::to_string(0.3 * std::cos(9.0 * t)) : "") + "\n";
    }
    write(folder_ / name, text);
    const Outcome outcome =
        run({"respond", "fitted/model.json", name, "--mass", "20", "--stiffness", "1e4", "--out", "r_" + name});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read(folder_ / ("r_" + name));
  };
  const std::string alone = moved("d.csv", "time [s],displacement [mm]", false);
  EXPECT_EQ(moved("b.csv", "time [s],base [mm]", false), alone);
  EXPECT_EQ(moved("both.csv", "time [s],base [mm],displacement [mm]", true), alone);
}

TEST_F(Remarks, EveryCommandSaysWhatItAssumed) {
  fit();
  write(folder_ / "mm.csv", millimetres(true));
  write(folder_ / "base.csv", millimetres(false));
  write(folder_ / "study.toml",
        "schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 20\nseeds = 1\n"
        "[[data]]\nrecordings = \"mm.csv\"\n");
  for (const Words& words :
       {Words{"fit", "mm.csv", "--model", "viscous", "--budget", "50", "--quiet", "--out", "f"},
        {"score", "fitted/model.json", "mm.csv"},
        {"simulate", "fitted/model.json", "mm.csv", "--out", "s.csv"},
        {"compare", "fitted/model.json", "mm.csv", "--out", "c"},
        {"respond", "fitted/model.json", "base.csv", "--mass", "20", "--stiffness", "1e4", "--out", "r.csv"},
        {"profile", "mm.csv", "--model", "viscous", "--budget", "20"},
        {"diagnose", "mm.csv", "--model", "viscous", "--effects", "offset-force", "--laws", "none", "--quiet", "--out",
         "d"},
        {"bench", "study.toml", "--quiet", "--out", "b"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << outcome.err;
    EXPECT_NE(outcome.err.find(assumed), std::string::npos) << words[0] << ": " << outcome.err;
  }
  // Results that stay say it too.
  for (const char* file : {"f/fit.json", "d/diagnosis.json"}) {
    const json said = json::parse(read(folder_ / file)).at("warnings");
    ASSERT_FALSE(said.empty()) << file;
    EXPECT_TRUE(said[0].get<std::string>().starts_with(std::string("mm.csv: ") + assumed)) << said[0];
  }
  EXPECT_NE(read(folder_ / "d/report.html").find(assumed), std::string::npos);
  EXPECT_NE(run({"report", "d"}).out.find("warning: mm.csv: displacement has no unit"), std::string::npos);
}

// A value without a unit could be of any.
TEST_F(Remarks, EveryCommandSaysWhatUnitAModelIsTakenIn) {
  fit();
  json model = json::parse(read(folder_ / "fitted/model.json"));
  for (json& parameter : model.at("parameters")) parameter.erase("unit");
  const std::string first = model.at("parameters").at(0).at("name");
  write(folder_ / "bare.json", model.dump());
  for (const Words& words :
       {Words{"score", "bare.json", "data"},
        {"simulate", "bare.json", "data/r1.csv", "--out", "s.csv"},
        {"compare", "bare.json", "data", "--out", "c"},
        {"export", "bare.json", "--to", "python", "--out", "damper.py"},
        {"respond", "bare.json", "data/r1.csv", "--excitation", "base", "--mass", "20", "--out", "r.csv"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << outcome.err;
    EXPECT_NE(outcome.err.find("warning: bare.json: no unit beside the value of '" + first + "'"), std::string::npos)
        << words[0] << ": " << outcome.err;
  }
  EXPECT_EQ(run({"score", "fitted/model.json", "data"}).err.find("no unit beside"), std::string::npos);
}

// Whoever has no time, or mistypes what a law follows, reads what helps.
TEST_F(Remarks, RefusalsOfColumnsSayWhatHelps) {
  write(folder_ / "untimed.csv", "displacement [mm],force [N]\n0,1\n1,2\n2,3\n");
  EXPECT_NE(
      run({"fit", "untimed.csv", "--model", "bouc-wen", "--out", "o"}).err.find("needs none, with --without-time"),
      std::string::npos);
  const Outcome mistyped = run({"fit", "data", "--model", "viscous", "--by", "curent=c0:1", "--out", "o"});
  EXPECT_NE(mistyped.err.find("(did you mean 'current'?)"), std::string::npos) << mistyped.err;
}

// A held-out error on a copy of what was fitted would be none.
TEST_F(Remarks, CopiesOfARecordingAreTold) {
  write(folder_ / "data/r1 (copy).csv", csv(1.0, 0.2));
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"});
  EXPECT_EQ(outcome.status, 0);
  const std::string said = "warning: r1.csv: holds the same bytes as r1 (copy).csv";
  EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  write(folder_ / "study.toml",
        "schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 20\nseeds = 1\n"
        "[[data]]\nrecordings = \"data\"\n");
  const Outcome study = run({"bench", "study.toml", "--quiet", "--out", "b"});
  EXPECT_EQ(study.status, 0) << study.err;
  EXPECT_NE(study.err.find(said), std::string::npos) << study.err;
}

TEST_F(Remarks, EveryCommandSkipsLinesWhereThatIsAsked) {
  fit();
  // Two rows that look like a header of numbers.
  write(folder_ / "late.csv", "load,12,1,1,1\n7,12,1,1,1\n" + csv(1.0, 0.2));
  std::string base = "time [s],displacement [mm],current [A]\n";
  for (int n = 0; n < 40; ++n) base += std::to_string(0.01 * n) + "," + std::to_string(std::sin(0.3 * n)) + ",0.5\n";
  write(folder_ / "base.csv", "7,8,9\n" + base);
  for (const Words& words :
       {Words{"simulate", "fitted/model.json", "late.csv", "--skip", "2", "--out", "s.csv"},
        {"compare", "fitted/model.json", "late.csv", "--skip", "2", "--out", "c"},
        {"export", "fitted/model.json", "--to", "python", "--motion", "late.csv", "--skip", "2", "--out", "damper.py"},
        {"respond", "fitted/model.json", "base.csv", "--skip", "1", "--mass", "20", "--out", "r.csv"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << outcome.err;
  }
}

TEST_F(Remarks, LawsAreNotExtrapolatedWithoutAWord) {
  fit();  // at 0.2 and 0.8 A
  const json range = json::parse(read(folder_ / "fitted/model.json")).at("laws_fitted_over");
  ASSERT_EQ(range.size(), 1U);
  EXPECT_NEAR(range.at("drive").at(0), 0.2, 1e-9);
  EXPECT_NEAR(range.at("drive").at(1), 0.8, 1e-9);
  write(folder_ / "far/a.csv", csv(1.0, 1.0));
  write(folder_ / "far/b.csv", csv(1.0, 2.0));
  write(folder_ / "near.csv", csv(1.0, 0.84));
  const std::string said =
      "a current of 2 A, and the laws of fitted/model.json were fitted from 0.2 to 0.8 A: what they say beyond is a "
      "guess";
  const Outcome scored = run({"score", "fitted/model.json", "far"});
  EXPECT_EQ(scored.status, 0);
  EXPECT_EQ(scored.err, "warning: b.csv: " + said + " (1 more recording alike)\n");
  EXPECT_EQ(run({"simulate", "fitted/model.json", "far/b.csv", "--out", "s.csv"}).err,
            "warning: b.csv: " + said + "\n");
  const Outcome pushed = run({"respond", "fitted/model.json", "far/b.csv", "--excitation", "base", "--drive", "2",
                              "--mass", "20", "--stiffness", "1e4", "--out", "r.csv"});
  EXPECT_EQ(pushed.err, "warning: b.csv: " + said + "\n");
  for (const char* data : {"data", "near.csv"}) EXPECT_EQ(run({"score", "fitted/model.json", data}).err, "") << data;
}

TEST_F(Remarks, AFitTellsOfHeldOutRecordingsThatItsLawsDoNotReach) {
  write(folder_ / "span/a.csv", csv(1.0, 0.2));
  write(folder_ / "span/b.csv", csv(1.0, 0.8));
  write(folder_ / "span/far.csv", csv(1.0, 2.0));
  const std::string toml =
      "schema = \"hysteron.campaign/1\"\n[[recording]]\nfile = \"a.csv\"\n[[recording]]\nfile = \"b.csv\"\n"
      "[[recording]]\nfile = \"far.csv\"\n";
  write(folder_ / "span/campaign.toml", toml + "role = \"validate\"\n");
  const Words words{"fit", "span", "--model", "viscous", "--by-current", "c0:1", "--out", "of_span"};
  const std::string said = "far.csv: a current of 2 A, and the laws of the model were fitted from 0.2 to 0.8 A";
  const Outcome held = run(words);
  EXPECT_EQ(held.status, 0) << held.err;
  EXPECT_NE(held.err.find(said), std::string::npos) << held.err;
  write(folder_ / "span/campaign.toml", toml);
  const Outcome fitted = run(words);
  EXPECT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_EQ(fitted.err.find("were fitted from"), std::string::npos) << fitted.err;
}

// They follow that of the motion.
TEST_F(Remarks, AFrequencyOfTheFileIsToldWhereLawsFollowOne) {
  std::string toml = "schema = \"hysteron.campaign/1\"\n";
  for (const int tenths : {5, 10, 20}) {
    const double hertz = 0.1 * tenths;
    std::string plain = "time [s],displacement [mm],force [N]\n";
    std::string with_column = "time [s],displacement [mm],force [N],frequency [Hz]\n";
    for (int n = 0; n < 200; ++n) {
      const double phase = 2.0 * std::numbers::pi * 0.02 * n;
      const std::string row = std::to_string(0.02 * n / hertz) + "," + std::to_string(5.0 * std::sin(phase)) + "," +
                              std::to_string(100.0 * hertz * std::cos(phase));
      plain += row + "\n";
      with_column += row + ",7\n";
    }
    const std::string name = "f" + std::to_string(tenths) + ".csv";
    write(folder_ / "columns" / name, with_column);
    write(folder_ / "numbers" / name, plain);
    toml += "[[recording]]\nfile = \"" + name + "\"\nfrequency = 7\n";
  }
  write(folder_ / "numbers/campaign.toml", toml);
  const auto fitted = [&](const char* data, bool followed) {
    Words words{"fit", data, "--model", "viscous", "--budget", "60", "--out", "tones"};
    if (followed) words.insert(words.end(), {"--by", "frequency=c0:1"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  const std::string column = "column 'frequency [Hz]' is not taken: laws in the frequency follow that of the motion";
  const std::string of_columns = fitted("columns", true);
  EXPECT_NE(of_columns.find(column), std::string::npos) << of_columns;
  EXPECT_NE(run({"score", "tones/model.json", "columns"}).err.find(column), std::string::npos);
  const std::string of_numbers = fitted("numbers", true);
  EXPECT_NE(of_numbers.find("the number frequency = 7 is not taken"), std::string::npos) << of_numbers;
  for (const char* data : {"columns", "numbers"}) {
    EXPECT_EQ(fitted(data, false).find("is not taken"), std::string::npos);
  }
}

TEST_F(Remarks, NumbersThatAreNoneAreRefused) {
  fit();
  for (const char* option : {"--x0", "--v0", "--drive", "--frequency", "--tolerance"}) {
    const Outcome outcome = run({"respond", "fitted/model.json", "data/r1.csv", "--excitation", "base", "--mass", "20",
                                 option, "nan", "--out", "r.csv"});
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "r.csv")) << option;
  }
  EXPECT_EQ(run({"export", "fitted/model.json", "--to", "c", "--tolerance", "nan", "--out", "e"}).status, 2);
  EXPECT_EQ(run({"challenge", "--in", "data", "--sizes", "nan", "--out", "h"}).status, 2);
}

// Two currents, and a model that knows of none.
TEST_F(Remarks, ADriveThatNoParameterFollowsIsSaidWithWhatWould) {
  const auto fitted = [&](const std::vector<std::string>& more) {
    Words words{"fit", "data", "--budget", "400", "--quiet", "--out", "f"};
    words.insert(words.end(), more.begin(), more.end());
    if (std::ranges::find(more, "--model") == more.end()) words.insert(words.end(), {"--model", "bouc-wen"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  const std::string hint = "the recordings hold 2 levels of the current and no parameter follows it: ";
  EXPECT_NE(fitted({}).find("warning: " + hint + "--by-current alpha:1,c0:1\n"), std::string::npos);
  const json warnings = json::parse(read(folder_ / "f/fit.json")).at("warnings");
  EXPECT_EQ(std::ranges::count(warnings, json(hint + "by current alpha:1,c0:1")), 1) << warnings;
  EXPECT_NE(read(folder_ / "f/report.html").find(hint), std::string::npos);
  EXPECT_EQ(fitted({"--by-current", "c0:1"}).find("levels of the current"), std::string::npos);
  // Asked for is asked for, also where every value of the law lies on one end of its box.
  write(folder_ / "data/r1.csv", csv(1.0, 0.2, 80, -1.0));
  write(folder_ / "data/r2.csv", csv(2.0, 0.8, 80, -1.0));
  EXPECT_EQ(fitted({"--model", "viscous", "--by-current", "c0:1", "--fix", "k0=0", "--fix", "f0=0"})
                .find("no parameter follows it"),
            std::string::npos);
  for (const json& one : json::parse(read(folder_ / "f/model.json")).at("parameters")) {
    EXPECT_EQ(one.at("value"), 0.0) << one;
  }
  // One current is nothing to follow.
  write(folder_ / "data/r1.csv", csv(1.0, 0.2));
  write(folder_ / "data/r2.csv", csv(2.0, 0.2));
  EXPECT_EQ(fitted({}).find("levels of the current"), std::string::npos);
}

}  // namespace
}  // namespace hysteron

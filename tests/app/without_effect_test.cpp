// Options that would change nothing, or whose results would replace another's, are not taken without a word. Every test
// runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"
#include "io/measuring_files.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Words = std::vector<std::string>;

class WithoutEffect : public Program {
 protected:
  // In this one line, with nothing written to `out`.
  void refused(const Words& words, const std::string& line) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "error: " + line + "\n");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  // Succeeds; what is said on standard error.
  std::string told(const Words& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << ": " << outcome.err;
    return outcome.err;
  }
  [[nodiscard]] static testing::FileTable short_table() {
    return {0.01,
            {{"displacement", "mm", {0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0}},
             {"force", "N", {1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0}}}};
  }
  // Of a Kelvin-Voigt damper, with these options.
  [[nodiscard]] static Words fit_of(const std::string& data, const Words& more) {
    Words words{"fit", data, "--model", "viscous", "--budget", "100", "--quiet", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(WithoutEffect, AHeldParameterHasNoBounds) {
  refused(fit_of("data", {"--fix", "k0=2", "--bounds", "k0=3:4"}),
          "--fix k0: a parameter that is held has no bounds, expected it in --fix or in --bounds alone");
  told(fit_of("data", {"--fix", "k0=2", "--bounds", "f0=-4:4"}));
}

// Half a sine turns once: as one at 0 Hz it would bend every law in the frequency.
TEST_F(WithoutEffect, AFrequencyThatOneTurnDoesNotTell) {
  std::string rows = "time [s],displacement [mm],force [N]\n";
  for (int n = 0; n <= 80; ++n) {
    const double phase = 3.141592653589793 * n / 80.0;
    rows += std::to_string(0.02 * n) + "," + std::to_string(10.0 * std::sin(phase)) + "," +
            std::to_string(40.0 * std::cos(phase)) + "\n";
  }
  write(folder_ / "data/half.csv", rows);
  refused(
      fit_of("data", {"--by-frequency", "c0:1"}),
      "half.csv: the motion turns once, so that its frequency is not known, expected two turning points or more with "
      "--by-frequency");
  write(folder_ / "data/campaign.toml", "schema = \"hysteron.campaign/1\"\n[by_frequency]\nc0 = 1\n");
  refused(
      fit_of("data", {}),
      "half.csv: the motion turns once, so that its frequency is not known, expected two turning points or more with "
      "the law in it of data/campaign.toml:3");
}

TEST_F(WithoutEffect, AGroupOfFilesThatHaveNone) {
  const std::string expected = " files have no groups, expected no --group, or a TDMS or MDF file or a workbook";
  for (const char* data : {"data", "data/r1.csv"}) refused(fit_of(data, {"--group", "Run"}), "r1.csv: CSV" + expected);
  fit();
  ASSERT_EQ(
      run({"respond", "fitted/model.json", "data/r1.csv", "--excitation", "base", "--mass", "20", "--out", "moved.mat"})
          .status,
      0);
  refused({"score", "fitted/model.json", "moved.mat", "--column", "force=damper_force", "--group", "Run"},
          "moved.mat: MAT" + expected);
}

// A folder may hold both.
TEST_F(WithoutEffect, AGroupBesideFilesThatHaveNoneIsTaken) {
  write(folder_ / "both/a.csv", testing::csv(1.0, 0.2));
  write(folder_ / "both/b.tdms", testing::tdms::file_of(short_table()));
  const std::string said = run(fit_of("both", {"--group", "Run"})).err;
  EXPECT_EQ(said.find("have no groups"), std::string::npos) << said;
}

TEST_F(WithoutEffect, LinesOfFilesThatHaveNone) {
  const std::string expected = " files have no lines, expected no --skip, or a text file or a workbook";
  fit();
  ASSERT_EQ(
      run({"respond", "fitted/model.json", "data/r1.csv", "--excitation", "base", "--mass", "20", "--out", "moved.mat"})
          .status,
      0);
  refused({"score", "fitted/model.json", "moved.mat", "--column", "force=damper_force", "--skip", "2"},
          "moved.mat: MAT" + expected);
  write(folder_ / "tables/b.tdms", testing::tdms::file_of(short_table()));
  refused({"score", "fitted/model.json", "tables", "--skip", "1"}, "b.tdms: TDMS" + expected);
  // A folder may hold both.
  write(folder_ / "tables/a.csv", "a line that an instrument writes\n" + testing::csv(1.0, 0.2));
  const std::string said = run({"score", "fitted/model.json", "tables", "--skip", "1"}).err;
  EXPECT_EQ(said.find("have no lines"), std::string::npos) << said;
}

TEST_F(WithoutEffect, OptionsOfRecordingsThatAreNotRead) {
  fit();
  for (const auto& [option, value] : {std::pair{"--column", "force=F"}, {"--group", "Run"}, {"--skip", "2"}}) {
    refused({"export", "fitted/model.json", "--to", "c", option, value, "--out", "out"},
            std::string(option) + ": expected --motion beside it (see hysteron export --help)");
    refused({"profile", "--budget", "50", option, value},
            std::string(option) + ": expected DATA beside it (see hysteron profile --help)");
  }
}

TEST_F(WithoutEffect, ASolverThatNoStudyAsksFor) {
  write(folder_ / "study.toml",
        "schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 20\nseeds = 1\n"
        "[[data]]\nrecordings = \"data\"\n");
  refused({"bench", "study.toml", "--solver-command", "mine=sh mine.sh", "--out", "out"},
          "--solver-command: 'mine' is not among the solvers asked for, expected in the study a solver mine");
}

// Where a campaign.toml would be read with its folder, and what is taken of it.
TEST_F(WithoutEffect, ACampaignTomlBesideFilesThatAreNamed) {
  const auto declare = [&](const std::string& text) {
    write(folder_ / "data/campaign.toml", "schema = \"hysteron.campaign/1\"\n" + text);
  };
  const auto line = [](const std::string& parts) {
    return "warning: data/campaign.toml: it is not read, as recordings beside it are given one by one" + parts +
           ": expected the folder in their place, for what it says of them\n";
  };
  const auto said_of = [&](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    const std::string said = told(words);
    const auto at = said.find("warning: data/campaign.toml");
    return at == std::string::npos ? std::string() : said.substr(at, said.find('\n', at) + 1 - at);
  };
  fit();
  const Words both{"data/r2.csv"};
  const std::string first = "[[recording]]\nfile = \"r1.csv\"\n";
  const std::string second = "[[recording]]\nfile = \"r2.csv\"\n";
  declare("model = \"bouc-wen\"\n[by_current]\nc0 = 1\n" + first + "start = 2026-11-24T14:50:58\noil = 3\n" + second +
          "role = \"validate\"\n");
  EXPECT_EQ(said_of(fit_of("data/r1.csv", {}), both), line(", and its laws, roles, starts and numbers are not taken"));
  // One start tells nothing, and other laws are asked for.
  EXPECT_EQ(said_of(fit_of("data/r1.csv", {"--by-frequency", "c0:0"}), {}),
            line(", and its laws and numbers are not taken"));
  EXPECT_EQ(said_of(fit_of("data/r2.csv", {"--by-current", "c0:0"}), {}), line(", and its roles are not taken"));
  EXPECT_EQ(said_of(fit_of("data", {"--by-current", "c0:0"}), {}), "");
  // Of a model that is fitted neither model nor laws nor roles are taken.
  EXPECT_EQ(said_of({"score", "fitted/model.json", "data/r1.csv"}, {}), "");
  EXPECT_EQ(said_of({"simulate", "fitted/model.json", "data/r2.csv", "--out", "p.csv"}, {}), "");
  declare(first + "temperature = 40\n" + second);
  EXPECT_EQ(said_of({"score", "fitted/model.json", "data/r1.csv"}, {}), line(", and its numbers are not taken"));
  EXPECT_EQ(said_of({"compare", "fitted/model.json", "data/r2.csv", "--out", "compared"}, {}), "");
  // With the folder these are not read.
  declare("model = \"viscous\"\n[by_current]\nc0 = 1\n" + second);
  EXPECT_EQ(said_of(fit_of("data/r1.csv", {}), {}), "");
  declare("model = \"viscous\"\n");
  EXPECT_EQ(said_of(fit_of("data/r1.csv", {}), {}), "");
  EXPECT_TRUE(run({"fit", "data/r1.csv", "--out", "none"}).err.starts_with(line(", and its model is not taken")));
  declare("modle = 3\n");
  EXPECT_EQ(said_of(fit_of("data/r1.csv", {}), {}), line(""));
}

TEST_F(WithoutEffect, ANumberBesideAnotherIsTold) {
  for (const int minute : {10, 20, 35}) {
    const std::string at = std::to_string(minute);
    write(folder_ / "starts" / ("m" + at + ".csv"),
          "# start: 2026-11-24T14:" + at + ":00\n" + testing::csv(1.0, 0.2, 80, 1.0 + 0.01 * minute));
  }
  told({"fit", "starts", "--model", "viscous", "--by", "clock=c0:1", "--budget", "100", "--quiet", "--out", "later"});
  const Words at{"score", "later/model.json", "starts", "--at", "clock=60"};
  EXPECT_EQ(told(at),
            "warning: m10.csv: its start, 2026-11-24T14:10:00, is not taken, since --at gives its clock as a number; "
            "expected one of the two (2 more recordings alike)\n");
  EXPECT_EQ(told({"score", "later/model.json", "starts"}), "");
  fs::create_directories(folder_ / "numbers");
  fs::copy_file(folder_ / "starts/m20.csv", folder_ / "numbers/m20.csv");
  write(folder_ / "numbers/campaign.toml",
        "schema = \"hysteron.campaign/1\"\n[[recording]]\nfile = \"m20.csv\"\nclock = 600\n");
  EXPECT_EQ(told({"score", "later/model.json", "numbers"}),
            "warning: m20.csv: its start, 2026-11-24T14:20:00, is not taken, since line 4 of campaign.toml gives its "
            "clock as a number; expected one of the two\n");
  EXPECT_TRUE(told({"score", "later/model.json", "numbers", "--at", "clock=60"})
                  .starts_with("warning: m20.csv: its clock is 600 by line 4 of campaign.toml and 60 by --at, "
                               "expected one number: that of --at is taken\n"));
  write(folder_ / "bare/r1.csv", testing::csv(1.0, 0.2));
  EXPECT_EQ(told({"score", "later/model.json", "bare", "--at", "clock=60"}), "");
}

// Folders of a model that is fitted already may say what they like of laws.
TEST_F(WithoutEffect, LawsThatAreNotTakenContradictNothing) {
  fit();
  const auto declare = [&](const std::string& name, const std::string& text) {
    write(folder_ / name / "r.csv", testing::csv(name == "a" ? 1.0 : 1.5, 0.4));
    write(folder_ / name / "campaign.toml", "schema = \"hysteron.campaign/1\"\n" + text);
  };
  declare("a", "model = \"bouc-wen\"\n[by_current]\nalpha = 1\nc0 = 1\n[by.pressure]\nc0 = 1\n");
  declare("b", "model = \"viscous\"\n[by_current]\nc0 = 2\nalpha = 1\n");
  EXPECT_EQ(told({"score", "fitted/model.json", "a", "b"}), "");
  EXPECT_EQ(told({"compare", "fitted/model.json", "a", "b", "--quiet", "--out", "out"}), "");
  fs::remove_all(folder_ / "out");
  refused({"fit", "a", "b", "--model", "viscous", "--by", "pressure=c0:0", "--out", "out"},
          "b/campaign.toml: order 2 of 'c0' in [by_current] contradicts order 1 of another folder, expected the same");
  declare("a", "model = \"bouc-wen\"\n[by_current]\nalpha = 1\nc0 = 1\n");
  told({"fit", "a", "b", "--model", "viscous", "--by-current", "c0:0", "--budget", "50", "--quiet", "--out", "out"});
}

TEST_F(WithoutEffect, AFrequencyThatNoParameterFollowsIsTold) {
  fit();
  const auto pushed = [&](const std::string& model) {
    return told({"respond", model, "data/r1.csv", "--excitation", "base", "--mass", "20", "--stiffness", "1e4",
                 "--frequency", "1.5", "--out", "motion.csv"});
  };
  EXPECT_EQ(pushed("fitted/model.json"),
            "warning: fitted/model.json: a frequency is given, and no parameter of the model follows one: it changes "
            "nothing\n");
  told(fit_of("data", {"--by-frequency", "c0:1"}));
  EXPECT_EQ(pushed("out/model.json").find("changes nothing"), std::string::npos);
}

TEST_F(WithoutEffect, AFigureIsAnSvgAndNothingElse) {
  refused({"describe", "bouc-wen", "--figure", "x.png"},
          "--figure x.png: an SVG is written, and no .png, expected a name that ends in .svg");
  EXPECT_FALSE(fs::exists(folder_ / "x.png"));
  refused({"describe", "bouc-wen", "--figure", "x.svg", "--json"},
          "--json: expected no --figure beside it (see hysteron describe --help)");
  for (const char* name : {"x.SVG", "x"}) {
    EXPECT_EQ(told({"describe", "bouc-wen", "--figure", name}), "");
    EXPECT_TRUE(read(folder_ / name).starts_with("<svg")) << name;
  }
}

TEST_F(WithoutEffect, NothingIsHiddenThatCouldBeChosen) {
  for (const auto& [option, value] : {std::pair{"--effect", "inertia"},
                                      {"--forms", "inertia/entrained"},
                                      {"--without-forms", "inertia/entrained"},
                                      {"--foreign", "foreign:cogging"}}) {
    refused({"challenge", "--level", "none", option, value, "--campaigns", "1", "--generate-only", "--out", "out"},
            std::string(option) + " " + value + ": at --level none nothing is hidden, expected another level, or no " +
                option);
  }
  told({"challenge", "--level", "none,plain", "--effect", "inertia", "--campaigns", "2", "--generate-only", "--quiet",
        "--out", "out"});
}

// As every command does that writes a report.html.
TEST_F(WithoutEffect, AChallengeReplacesNoOtherReport) {
  fit();
  const std::string report = read(folder_ / "fitted/report.html");
  refused({"challenge", "--level", "none", "--campaigns", "1", "--generate-only", "--out", "fitted"},
          "--out fitted: holds a fit (fit.json), whose report.html would be replaced, expected another folder");
  EXPECT_EQ(read(folder_ / "fitted/report.html"), report);
  EXPECT_FALSE(fs::exists(folder_ / "fitted/settings.json"));
  const Words made{"challenge", "--level", "none", "--campaigns", "1", "--out", "out", "--generate-only", "--quiet"};
  told(made);
  told(made);  // its own folder
}

TEST_F(WithoutEffect, WhatStaysAnInputIsNoNumber) {
  fit();
  refused({"export", "fitted/model.json", "--to", "c", "--at", "current=2 A", "--out", "out"},
          "--at: the current stays an input of the exported model, expected no number for it");
  ASSERT_EQ(told(fit_of("data", {"--by-frequency", "c0:1", "--by-current", "c0:0"})).find("error"), std::string::npos);
  fs::rename(folder_ / "out", folder_ / "paced");
  refused({"export", "paced/model.json", "--to", "c", "--at", "frequency=2", "--out", "out"},
          "--at: the frequency stays an input of the exported model, expected no number for it");
  refused({"simulate", "paced/model.json", "data/r1.csv", "--at", "frequency=2", "--out", "out"},
          "--at: the frequency that parameters follow is the motion's own, expected no number for it");
  refused({"export", "paced/model.json", "--to", "c", "--at", "current=2 A", "--out", "out"},
          "--at: no parameter of the model follows 'current', expected no --at, since they follow nothing that it "
          "gives");
}

TEST_F(WithoutEffect, StepsBeyondTheMost) {
  fit();
  refused({"export", "fitted/model.json", "--to", "c", "--substeps", "4", "--most-substeps", "2", "--out", "out"},
          "--substeps 4: more than --most-substeps 2 allows, expected no more, or one of the two alone");
  told({"export", "fitted/model.json", "--to", "c", "--substeps", "64", "--most-substeps", "64", "--out", "out"});
}

TEST_F(WithoutEffect, NoTablesBesideStandardOutput) {
  fit();
  refused({"compare", "fitted/model.json", "data", "--mat", "--out", "-"},
          "--mat: with --out - no tables are written, expected a folder for them, or no --mat");
}

// Where the law stands that is wrong, and not an option that nobody gave.
TEST_F(WithoutEffect, ALawOfCampaignTomlThatTheModelCannotFollowIsToldByItsLine) {
  const auto declare = [&](const std::string& laws) {
    write(folder_ / "data/campaign.toml", "schema = \"hysteron.campaign/1\"\nmodel = \"bouc-wen\"\n" + laws);
  };
  const std::string why = " of 'alpha', which viscous does not have, expected one of c0, k0, f0, or --by-";
  declare("[by_current]\nc0 = 1\nalpha = 1\n");
  refused(fit_of("data", {}), "data/campaign.toml:5: a law in the current" + why + "current with other laws");
  declare("[by.Current]\nalpha = 1\n");
  refused(fit_of("data", {}), "data/campaign.toml:4: a law in the current" + why + "current with other laws");
  declare("[by_current]\nc0 = 1\n[by_frequency]\nalpha = 1\n");
  refused(fit_of("data", {}), "data/campaign.toml:6: a law in the frequency" + why + "frequency with other laws");
  declare("[by_current]\nalpha = 1\n");
  told(fit_of("data", {"--by-current", "c0:1"}));
}

TEST_F(WithoutEffect, ALawOfCampaignTomlInWhatDoesNotChangeIsToldByItsLine) {
  write(folder_ / "one/r.csv", testing::csv(1.0, 0.2));
  const auto declare = [&](const std::string& laws, const std::string& more = "") {
    write(folder_ / "one/campaign.toml", "schema = \"hysteron.campaign/1\"\nmodel = \"viscous\"\n" + laws +
                                             "[[recording]]\nfile = \"r.csv\"\n" + more);
  };
  const std::string current =
      "one/campaign.toml:4: a law in the current of 'c0', and the recordings hold no current or voltage, or only one "
      "level of it, expected at least two levels, or --by-current c0:0";
  declare("[by_current]\nc0 = 1\n");
  refused(fit_of("one", {}), current);
  refused({"diagnose", "one", "--out", "out"}, current);
  told(fit_of("one", {"--by-current", "c0:0"}));
  fs::remove_all(folder_ / "out");
  refused(
      fit_of("one", {"--by-current", "c0:1"}),
      "--by-current c0:1: the recordings hold no current or voltage, or only one level of it, expected at least two "
      "levels");
  declare("[by_frequency]\nc0 = 1\n");
  refused(
      fit_of("one", {}),
      "one/campaign.toml:4: a law in the frequency of 'c0', and the recordings hold only one frequency, expected at "
      "least two, or --by-frequency c0:0");
  declare("[by.temperature]\nc0 = 1\n", "temperature = 40\n");
  refused(
      fit_of("one", {}),
      "one/campaign.toml:4: a law in the temperature of 'c0', and the recordings hold only one temperature, expected "
      "at least two, or --by temperature=c0:0");
  // Of other recordings than those that judge.
  write(folder_ / "one/s.csv", testing::csv(1.0, 0.7));
  declare("[by_current]\nc0 = 1\n", "[[recording]]\nfile = \"s.csv\"\nrole = \"validate\"\n");
  refused(fit_of("one", {}),
          "one/campaign.toml:4: a law in the current of 'c0', and the recordings that are fitted hold no current or "
          "voltage, or only one level of it, expected at least two levels, or --by-current c0:0");
}

// Laws are left out of the models that do not have their parameter.
TEST_F(WithoutEffect, ALawThatNoModelOfADiagnosisHas) {
  const std::string expected = "the model has no parameter 'alpa' (did you mean 'alpha'?), expected one of ";
  const auto said_of = [&](const Words& laws) {
    Words words{"diagnose", "data", "--model", "bouc-wen", "--out", "out"};
    words.insert(words.end(), laws.begin(), laws.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return outcome.err;
  };
  for (const std::string option : {"--by-current", "--by-frequency"}) {
    const std::string said = said_of({option, "alpa:1"});
    EXPECT_TRUE(said.starts_with("error: " + option + ": " + expected)) << said;
  }
  write(folder_ / "data/campaign.toml", "schema = \"hysteron.campaign/1\"\n[by_current]\nalpa = 1\n");
  const std::string said = said_of({});
  EXPECT_TRUE(
      said.starts_with("error: data/campaign.toml:3: a law in the current of 'alpa', which bouc-wen does not "
                       "have (did you mean 'alpha'?), expected one of "))
      << said;
}

TEST_F(WithoutEffect, AScoreOfAChallengeMakesNothing) {
  const Words made{"challenge", "--level", "none", "--campaigns", "1", "--generate-only", "--quiet", "--out", "made"};
  told(made);
  for (const Words& option : {Words{"--effect", "inertia"},
                              {"--level", "plain"},
                              {"--campaigns", "2"},
                              {"--recordings", "3"},
                              {"--stops"},
                              {"--in", "data"}}) {
    for (const auto& [what, folder] : {std::pair{"--score-only", "made"}, {"--list", "out"}}) {
      Words words{"challenge", what, "--out", folder};
      words.insert(words.end(), option.begin(), option.end());
      refused(words, option[0] + ": expected no " + what + " beside it (see hysteron challenge --help)");
    }
  }
  refused({"challenge", "--list", "--forms", "inertia/entrained"},
          "--forms: expected no --list beside it (see hysteron challenge --help)");
  for (const char* option : {"--campaigns", "--recordings"}) {
    refused({"challenge", "--in", "data", option, "3", "--out", "out"},
            "--in: expected no " + std::string(option) + " beside it (see hysteron challenge --help)");
  }
}

// As a measured channel, a drive is of one kind.
TEST_F(WithoutEffect, APresetSaysWhichDriveItNeeds) {
  refused({"simulate", "--preset", "spencer-1997", "data/r1.csv", "--out", "out"},
          "r1.csv: records a current, expected a voltage for preset spencer-1997 or its value with --drive");
}

}  // namespace
}  // namespace hysteron

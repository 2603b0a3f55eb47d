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
  const testing::FileTable table{0.01,
                                 {{"displacement", "mm", {0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0}},
                                  {"force", "N", {1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0}}}};
  write(folder_ / "both/a.csv", testing::csv(1.0, 0.2));
  write(folder_ / "both/b.tdms", testing::tdms::file_of(table));
  const std::string said = run(fit_of("both", {"--group", "Run"})).err;
  EXPECT_EQ(said.find("have no groups"), std::string::npos) << said;
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

// As a measured channel, a drive is of one kind.
TEST_F(WithoutEffect, APresetSaysWhichDriveItNeeds) {
  refused({"simulate", "--preset", "spencer-1997", "data/r1.csv", "--out", "out"},
          "r1.csv: records a current, expected a voltage for preset spencer-1997 or its value with --drive");
}

}  // namespace
}  // namespace hysteron

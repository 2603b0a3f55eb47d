// `hysteron report` of a folder that diagnose wrote, of both schemas of diagnosis.json and of none.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using DiagnosisReport = Program;

json of_schema_1() {
  return {{"schema", "hysteron.diagnosis/1"},
          {"baseline",
           {{"model", "bouc-wen"}, {"nrmse_fit", 0.031}, {"nrmse_heldout", 0.034}, {"noise_floor_nrmse", 0.01}}},
          {"verdict", "missing-physics"},
          {"effects",
           {{{"id", "clearance"},
             {"confidence", 0.93},
             {"indistinguishable_from", json::array()},
             {"sentence", "Consistent with clearance."},
             {"parameters", {{{"name", "gap"}, {"value", 3.1e-4}, {"unit", "m"}, {"ci95", {2.9e-4, 3.3e-4}}}}},
             {"nrmse_heldout_before", 0.034},
             {"nrmse_heldout_after", 0.011},
             {"share_of_misfit", 0.93}}}},
          {"locations", json::array()},
          {"rejected", {{{"id", "inertia"}, {"reason", "explains less"}, {"p", 0.4}}}},
          {"not_observable", {{{"id", "coil-lag"}, {"reason", "the current is constant in every recording"}}}},
          {"augmented", {{"nrmse_fit", 0.0102}, {"nrmse_heldout", 0.011}, {"remaining_structure", false}}},
          {"next_experiment", "two strokes\x1b[2J at the same speed"}};
}

TEST_F(DiagnosisReport, OfSchema1) {
  write(folder_ / "old/diagnosis.json", of_schema_1().dump());
  const Outcome outcome = run({"report", "old"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* text :
       {"verdict: missing-physics", "Named: clearance.", "- named (93 %): Consistent with clearance.",
        "coil-lag: the current is constant", "report: old/report.html"}) {
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << " in " << outcome.out;
  }
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos) << "a record commands the terminal";
  EXPECT_NE(read(folder_ / "old/report.html").find("Consistent with clearance."), std::string::npos);
}

TEST_F(DiagnosisReport, KeepsToTheWidthOfATerminal) {
  json record = of_schema_1();
  std::string words;
  for (int k = 0; k < 60; ++k) words += "word" + std::to_string(k) + " ";
  record["summary"] = {words, words};
  record["effects"][0]["sentence"] = words;
  record["effects"][0]["experiment"] = words;
  record["locations"] = {{{"where", words}, {"share_of_misfit", 0.5}, {"share_of_samples", 0.1}}};
  record["not_observable"][0]["reason"] = words;
  record["next_experiment"] = words;
  record["notes"] = {words};
  record["warnings"] = {words};
  write(folder_ / "wide/diagnosis.json", record.dump());
  const Outcome outcome = run({"report", "wide"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_GT(count, 40U);
}

TEST_F(DiagnosisReport, IsWhatDiagnosePrintedAndKeepsThePlots) {
  const Outcome first = run({"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects",
                             "coulomb-friction,offset-force", "--quiet", "--out", "out"});
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string page = read(folder_ / "out/report.html");
  const Outcome again = run({"report", "out"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(read(folder_ / "out/report.html"), page);
  EXPECT_NE(page.find("\"curves\""), std::string::npos);
}

TEST_F(DiagnosisReport, RefusesOtherSchemasAndBrokenRecordsInOneLine) {
  json record = of_schema_1();
  record["schema"] = "hysteron.diagnosis/9";
  write(folder_ / "new/diagnosis.json", record.dump());
  record = of_schema_1();
  record["effects"][0]["sentence"] = 7;
  write(folder_ / "broken/diagnosis.json", record.dump());
  write(folder_ / "text/diagnosis.json", "no JSON");
  record = of_schema_1();
  record["alias_map"] = {{"effects", {"a", "b"}}, {"cosine", {{1.0}}}};
  write(folder_ / "short/diagnosis.json", record.dump());
  std::string number = of_schema_1().dump();
  number.replace(number.find("0.031"), 5, "1e999");
  write(folder_ / "number/diagnosis.json", number);
  write(folder_ / "deep/diagnosis.json", std::string(200000, '['));
  for (const std::string name : {"new", "broken", "text", "short", "number", "deep"}) {
    const Outcome outcome = run({"report", name});
    EXPECT_EQ(outcome.status, 2) << name;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("error: " + name + "/diagnosis.json:")) << outcome.err;
    EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / name / "report.html"));
  }
}

}  // namespace
}  // namespace hysteron

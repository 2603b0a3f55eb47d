// The program as a user runs it: results, determinism, wrong input, interruption. Every test runs HYSTERON_PROGRAM in a
// temporary folder of its own.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::csv;
using testing::finish;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::start;
using testing::write;

const char* const result_files[] = {"model.json", "fit.json", "report.html"};

TEST_F(Program, FitGivesTheSameBytesForAnyThreadsAndAnyOutputFolder) {
  const Outcome made = run({"generate", "rd8040-twin", "--only", "2.0Hz_0.", "--out", "twin"});
  ASSERT_EQ(made.status, 0) << made.err;
  for (const std::string solver : {"multistart-lm", "pso", "ukf"}) {
    std::vector<std::string> folders;
    for (const std::string threads : {"1", "2", "7", "2"}) {
      folders.push_back(solver + std::to_string(folders.size()) + "/nested");
      std::vector<std::string> words = {"fit",       "twin",  "--model",  "bouc-wen",    "--by-current", "alpha:1,c0:1",
                                        "--solver",  solver,  "--budget", "500",         "--seed",       "5",
                                        "--threads", threads, "--out",    folders.back()};
      if (threads == "7") words.insert(words.begin() + 2, "--quiet");
      const Outcome outcome = run(words);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_TRUE(fs::exists(folder_ / folders.back() / "environment.json"));
    }
    for (const char* file : result_files) {
      const std::string first = read(folder_ / folders[0] / file);
      EXPECT_GT(first.size(), 500U) << file;
      for (const std::string& folder : folders) EXPECT_TRUE(read(folder_ / folder / file) == first) << folder << file;
      EXPECT_EQ(first.find(folder_.string()), std::string::npos) << file << " holds an absolute path";
    }
  }
  const std::string other = "other";
  ASSERT_EQ(run({"fit", "twin", "--model", "bouc-wen", "--by-current", "alpha:1,c0:1", "--solver", "pso", "--budget",
                 "500", "--seed", "6", "--out", other})
                .status,
            0);
  EXPECT_FALSE(read(folder_ / other / "model.json") == read(folder_ / "pso0/nested/model.json"));
}

TEST_F(Program, FilterIsShownAgainstTime) {
  ASSERT_EQ(run({"fit", "data", "--model", "bouc-wen", "--by-current", "c0:1", "--solver", "ukf,pso", "--budget", "300",
                 "--quiet", "--out", "fitted"})
                .status,
            0);
  const json solvers = json::parse(read(folder_ / "fitted/fit.json")).at("solvers");
  EXPECT_TRUE(solvers.at(1).at("track").is_null());
  const json& track = solvers.at(0).at("track");
  const std::vector<double> time = track.at("time");
  ASSERT_GT(time.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(time));
  // 2 s of the first recording and 1 s of the second.
  EXPECT_NEAR(time.back(), 3.0, 1e-9);
  std::set<std::string> names;
  for (const json& row : track.at("parameters")) {
    names.insert(row.at("name"));
    ASSERT_EQ(row.at("mean").size(), time.size());
    for (std::size_t k = 0; k < time.size(); ++k) {
      EXPECT_LT(row.at("lower")[k], row.at("mean")[k]);
      EXPECT_LT(row.at("mean")[k], row.at("upper")[k]);
    }
  }
  EXPECT_TRUE(names.contains("c0 at 0.2 A"));
  EXPECT_TRUE(names.contains("c0 at 0.8 A"));
}

TEST_F(Program, LawsInTwoStagesStandBesideTheJointFit) {
  for (int k = 0; k < 5; ++k) write(folder_ / "laws" / ("r" + std::to_string(k) + ".csv"), csv(1.0, 0.2 * k));
  const std::vector<std::string> words{"fit",      "laws", "--model",  "viscous", "--by-current", "c0:1",
                                       "--stages", "two",  "--budget", "600",     "--out",        "two"};
  const Outcome outcome = run(words);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json stages = json::parse(read(folder_ / "two/fit.json")).at("stages");
  EXPECT_EQ(stages.at("conditions").size(), 4U);  // one is held out
  EXPECT_EQ(stages.at("parameters").size(), 3U);
  // Equal but for rounding where one condition each determines the laws.
  EXPECT_GE(stages.at("two_stages").at("nrmse_fit").get<double>(),
            stages.at("nrmse_free").get<double>() * (1.0 - 1e-12));
  EXPECT_GE(stages.at("two_stages").at("nrmse_fit").get<double>(),
            stages.at("joint").at("nrmse_fit").get<double>() * (1.0 - 1e-6));
  EXPECT_NE(outcome.out.find("two stages"), std::string::npos);
}

TEST_F(Program, FiguresAreSmallAndTheSameEveryTime) {
  for (const std::string name : {"bouc-wen", "preisach", "pso", "lm", "ukf"}) {
    ASSERT_EQ(run({"describe", name, "--figure", "first.svg"}).status, 0) << name;
    ASSERT_EQ(run({"describe", name, "--figure", "second.svg"}).status, 0) << name;
    const std::string figure = read(folder_ / "first.svg");
    EXPECT_EQ(figure, read(folder_ / "second.svg")) << name;
    EXPECT_LT(figure.size(), 15000U) << name;
    EXPECT_EQ(figure.find("nan"), std::string::npos) << name;
    EXPECT_EQ(figure.find("inf"), std::string::npos) << name;
    EXPECT_NE(figure.find("class=\"c\""), std::string::npos) << name;
  }
}

TEST_F(Program, ModelFileHasTheShapeOfTheContract) {
  fit();
  const json model = json::parse(read(folder_ / "fitted/model.json"));
  EXPECT_EQ(model.at("schema"), "hysteron.model/1");
  EXPECT_EQ(model.at("model"), "bouc-wen");
  EXPECT_TRUE(model.at("effects").is_array());
  EXPECT_EQ(model.at("by_current").at("c0"), 1);
  ASSERT_EQ(model.at("parameters").size(), 8U);
  for (const json& parameter : model["parameters"]) {
    for (const char* key : {"name", "value", "unit", "std_error", "at_bound"})
      EXPECT_TRUE(parameter.contains(key)) << key;
  }
  ASSERT_EQ(model.at("fitted_on").size(), 2U);
  EXPECT_EQ(model["fitted_on"][0].at("file"), "r1.csv");
  EXPECT_EQ(model["fitted_on"][0].at("sha256").get<std::string>().size(), 64U);
  EXPECT_EQ(model.at("nrmse").at("normalisation"), "max-abs");
  EXPECT_TRUE(model["nrmse"].at("fit").is_number());
  EXPECT_TRUE(model["nrmse"].contains("heldout"));
  EXPECT_TRUE(model.contains("provenance"));
}

TEST_F(Program, SimulateWritesOneRowPerInputRow) {
  fit();
  const Outcome outcome = run({"simulate", "fitted/model.json", "data/r2.csv", "--out", "prediction.csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream text(read(folder_ / "prediction.csv"));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "time [s],force [N]");
  std::istringstream input(csv(2.0, 0.8));
  std::string row;
  std::getline(input, row);
  std::size_t rows = 0;
  while (std::getline(text, line)) {
    ASSERT_TRUE(std::getline(input, row));
    EXPECT_DOUBLE_EQ(std::stod(line), std::stod(row));
    EXPECT_EQ(std::ranges::count(line, ','), 1);
    ++rows;
  }
  EXPECT_EQ(rows, 80U);
}

TEST_F(Program, SimulateNeedsNoForce) {
  fit();
  std::istringstream input(csv(2.0, 0.8));
  std::string motion_only;
  for (std::string line; std::getline(input, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    motion_only += cells[0] + ',' + cells[1] + ',' + cells[2] + ',' + cells[4] + '\n';
  }
  write(folder_ / "motion.csv", motion_only);
  ASSERT_EQ(run({"simulate", "fitted/model.json", "motion.csv", "--out", "a.csv"}).status, 0);
  ASSERT_EQ(run({"simulate", "fitted/model.json", "data/r2.csv", "--out", "b.csv"}).status, 0);
  EXPECT_EQ(read(folder_ / "a.csv"), read(folder_ / "b.csv"));
}

TEST_F(Program, ScoreOfTheFittedDataIsThatOfTheFitAndOfTheSimulation) {
  fit();
  const Outcome outcome = run({"score", "fitted/model.json", "data", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json scored = json::parse(outcome.out);
  const json fitted = json::parse(read(folder_ / "fitted/fit.json"));
  EXPECT_NEAR(scored.at("overall").at("nrmse").get<double>(), fitted.at("nrmse").at("fit").get<double>(), 1e-9);
  ASSERT_EQ(scored.at("recordings").size(), 2U);
  double mean_square = 0.0;
  for (std::size_t r = 0; r < 2; ++r) {
    const json& row = scored["recordings"][r];
    EXPECT_EQ(row.at("file"), "r" + std::to_string(r + 1) + ".csv");
    EXPECT_NEAR(row.at("nrmse").get<double>(), fitted.at("recordings")[r].at("nrmse").get<double>(), 1e-9);
    EXPECT_TRUE(row.at("fit_percent").is_number());
    mean_square += 0.5 * std::pow(row["nrmse"].get<double>(), 2);
    // The same from the simulated force.
    ASSERT_EQ(
        run({"simulate", "fitted/model.json", "data/r" + std::to_string(r + 1) + ".csv", "--out", "p.csv"}).status, 0);
    std::istringstream predicted(read(folder_ / "p.csv"));
    std::istringstream measured(read(folder_ / ("data/r" + std::to_string(r + 1) + ".csv")));
    std::string a;
    std::string b;
    std::getline(predicted, a);
    std::getline(measured, b);
    double square = 0.0;
    double peak = 0.0;
    int rows = 0;
    while (std::getline(predicted, a) && std::getline(measured, b)) {
      const double force = std::stod(a.substr(a.find(',') + 1));
      std::size_t at = 0;
      for (int comma = 0; comma < 3; ++comma) at = b.find(',', at) + 1;
      const double truth = std::stod(b.substr(at));
      square += (force - truth) * (force - truth);
      peak = std::max(peak, std::fabs(truth));
      ++rows;
    }
    EXPECT_NEAR(row.at("rmse_n").get<double>(), std::sqrt(square / rows), 1e-7 * peak);
    EXPECT_NEAR(row.at("nrmse").get<double>(), std::sqrt(square / rows) / peak, 1e-8);
  }
  EXPECT_NEAR(scored["overall"]["nrmse"].get<double>(), std::sqrt(mean_square), 1e-12);
}

TEST_F(Program, HelpOfEveryCommandHasAnExample) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("hysteron fit"), std::string::npos);
  for (const std::string command : {"fit", "simulate", "score", "list", "describe", "generate"}) {
    EXPECT_NE(help.out.find(command), std::string::npos);
    const Outcome page = run({command, "--help"});
    EXPECT_EQ(page.status, 0) << command;
    EXPECT_NE(page.out.find("Example"), std::string::npos) << command;
    EXPECT_NE(page.out.find("hysteron " + command), std::string::npos) << command;
    EXPECT_EQ(page.err, "") << command;
  }
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_TRUE(version.out.starts_with("hysteron ")) << version.out;
}

TEST_F(Program, HelpAndVersionAsPeopleTypeThem) {
  const std::string help = run({"--help"}).out;
  const std::string of_fit = run({"fit", "--help"}).out;
  const std::string version = run({"--version"}).out;
  EXPECT_NE(help, of_fit);
  struct Typed {
    std::vector<std::string> words;
    std::string out;
  };
  for (const Typed& typed : {Typed{{}, help}, Typed{{"help"}, help}, Typed{{"help", "fit"}, of_fit},
                             Typed{{"version"}, version}, Typed{{"-h"}, help}}) {
    const Outcome outcome = run(typed.words);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out, typed.out);
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Program, MistypedWordsAreToldWithTheNearestOne) {
  struct Typed {
    std::vector<std::string> words;
    std::string says;
  };
  const Typed cases[] = {
      {{"fot", "data"}, "error: there is no command 'fot' (did you mean 'fit'?), see hysteron --help\n"},
      {{"help", "dignose"}, "error: there is no command 'dignose' (did you mean 'diagnose'?), see hysteron --help\n"},
      {{"fit", "data", "--budgt", "5"},
       "error: fit has no option '--budgt' (did you mean '--budget'?), see hysteron fit --help\n"},
      {{"fit", "data", "--budgt=5"},
       "error: fit has no option '--budgt' (did you mean '--budget'?), see hysteron fit --help\n"},
      {{"--foo"}, "error: hysteron has no option '--foo', see hysteron --help\n"},
      {{"--verson"}, "error: hysteron has no option '--verson' (did you mean '--version'?), see hysteron --help\n"},
      {{"--foo", "fit", "data"}, "error: hysteron has no option '--foo', see hysteron --help\n"},
      {{"-x"}, "error: hysteron has no option '-x', see hysteron --help\n"},
      {{"fit", "data", "-q"}, "error: fit has no option '-q', see hysteron fit --help\n"},
      {{"--mass", "5", "respond", "m.json"},
       "error: '--mass' stands before a command, expected it behind one that has it, as in hysteron fit --mass\n"},
  };
  for (const Typed& typed : cases) {
    const Outcome outcome = run(typed.words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, typed.says);
  }
}

// ---- Wrong input ----

struct Wrong {
  std::string what;
  std::vector<std::string> words;
  std::vector<std::pair<std::string, std::string>> files = {};
};

std::vector<std::string> fit_with(std::vector<std::string> more) {
  std::vector<std::string> words{"fit", "data", "--model", "bouc-wen", "--budget", "60", "--out", "out"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Wrong bad_csv(const std::string& what, const std::string& text) {
  return {what, {"fit", "bad.csv", "--model", "bouc-wen", "--budget", "60", "--out", "out"}, {{"bad.csv", text}}};
}

Wrong bad_campaign(const std::string& what, const std::string& text) {
  return {"campaign: " + what,
          {"fit", "data", "--model", "bouc-wen", "--budget", "60", "--out", "out"},
          {{"data/campaign.toml", text}}};
}

// The good recording with one text replaced.
std::string spoiled(int row, const std::string& replacement) {
  std::istringstream input(csv(1.0, 0.2));
  std::string result;
  int n = 0;
  for (std::string line; std::getline(input, line); ++n) result += (n == row ? replacement : line) + '\n';
  return result;
}

std::vector<Wrong> wrong_command_lines() {
  return {
      {"unknown command", {"fitt"}},
      {"unknown option", fit_with({"--budgets", "5"})},
      {"unknown model", {"fit", "data", "--model", "bouc-wem", "--out", "out"}},
      {"no model", {"fit", "data", "--out", "out"}},
      {"unknown solver", fit_with({"--solver", "psoo"})},
      {"second solver unknown", fit_with({"--solver", "pso,psoo"})},
      {"unknown effect", fit_with({"--effects", "clearanse"})},
      {"unknown parameter in by-current", fit_with({"--by-current", "alfa:1"})},
      {"unknown parameter in by-frequency", fit_with({"--by-frequency", "alfa:1"})},
      {"order is not a number", fit_with({"--by-current", "alpha:x"})},
      {"order missing", fit_with({"--by-current", "alpha"})},
      {"order 6", fit_with({"--by-current", "alpha:6"})},
      {"order negative", fit_with({"--by-current", "alpha:-1"})},
      {"two stages without a law", fit_with({"--stages", "two"})},
      {"three stages", fit_with({"--by-current", "alpha:1", "--stages", "three"})},
      {"figure of an effect", {"describe", "clearance", "--figure", "figure.svg"}},
      {"missing --out", {"fit", "data", "--model", "bouc-wen"}},
      {"results below a file", {"fit", "data", "--model", "bouc-wen", "--budget", "60", "--out", "data/r1.csv/out"}},
      {"results where no folder can be made",
       {"fit", "data", "--model", "bouc-wen", "--budget", "60", "--out", "/proc/hysteron/out"}},
      {"no data", {"fit", "--model", "bouc-wen", "--out", "out"}},
      {"missing file", {"fit", "nothing.csv", "--model", "bouc-wen", "--out", "out"}},
      {"unknown extension", {"fit", "r.xlsx", "--model", "bouc-wen", "--out", "out"}, {{"r.xlsx", "x"}}},
      {"folder without recordings",
       {"fit", "empty", "--model", "bouc-wen", "--out", "out"},
       {{"empty/readme.md", "x"}}},
      {"recording given twice", {"fit", "data", "data/r1.csv", "--model", "bouc-wen", "--out", "out"}},
      {"budget 0", fit_with({"--budget", "0"})},
      {"budget is not a number", fit_with({"--budget", "many"})},
      {"threads -1", fit_with({"--threads", "-1"})},
      {"seed is not a number", fit_with({"--seed", "lucky"})},
      {"seed negative", fit_with({"--seed", "-3"})},
      {"seed beyond 64 bits", fit_with({"--seed", "18446744073709551616"})},
      {"seed broken", fit_with({"--seed", "1.5"})},
      {"budget broken", fit_with({"--budget", "1.5"})},
      {"budget beyond its range", fit_with({"--budget", "1e10"})},
      {"normalisation", fit_with({"--normalisation", "peak"})},
      {"weighting", fit_with({"--weighting", "equal"})},
      {"tolerance", fit_with({"--tolerance", "0"})},
      {"tolerance nan", fit_with({"--tolerance", "nan"})},
      {"effect twice", fit_with({"--effects", "inertia,inertia"})},
      {"solver twice", fit_with({"--solver", "pso,pso"})},
      {"law twice", fit_with({"--by-current", "alpha:1,alpha:2"})},
      {"--fix twice", fit_with({"--fix", "alpha=1", "--fix", "alpha=2"})},
      {"--bounds twice", fit_with({"--bounds", "alpha=1:5", "--bounds", "alpha=1:6"})},
      {"--set twice", fit_with({"--solver", "pso", "--set", "particles=10", "--set", "particles=20"})},
      {"--column twice", fit_with({"--column", "force=force [N]", "--column", "force=current [A]"})},
      {"effect twice in a diagnosis",
       {"diagnose", "data", "--model", "bouc-wen", "--effects", "inertia,inertia", "--out", "out"}},
      {"--fix unknown", fit_with({"--fix", "alfa=1"})},
      {"--fix without a value", fit_with({"--fix", "alpha"})},
      {"--fix text", fit_with({"--fix", "alpha=big"})},
      {"--fix nan", fit_with({"--fix", "alpha=nan"})},
      {"--bounds reversed", fit_with({"--bounds", "alpha=5:1"})},
      {"--bounds without a colon", fit_with({"--bounds", "alpha=5"})},
      {"--bounds unknown", fit_with({"--bounds", "alfa=1:5"})},
      {"--fix that divides by zero", fit_with({"--fix", "x_y=0"})},
      {"--fix with too many steps in it", fit_with({"--fix", "x_y=1e-12"})},
      {"--fix of the wrong sign", fit_with({"--fix", "x_y=-1e-3"})},
      {"--fix of no exponent", fit_with({"--fix", "n=0"})},
      {"--fix of a negative exponent", fit_with({"--fix", "n=-1"})},
      {"--fix of a negative damping", fit_with({"--fix", "c0=-100"})},
      {"--bounds of the wrong sign", fit_with({"--bounds", "x_y=-1:-0.5"})},
      {"--bounds down to what divides by zero", fit_with({"--bounds", "x_y=0:1e-3"})},
      {"--bounds through zero", fit_with({"--bounds", "alpha=-50:500"})},
      {"--bounds infinite", fit_with({"--bounds", "alpha=0:inf"})},
      {"--set unknown", fit_with({"--solver", "pso", "--set", "no-such-setting=1"})},
      {"--set text", fit_with({"--solver", "pso", "--set", "particles=many"})},
      {"--column without a name", fit_with({"--column", "force"})},
      {"--column of a missing column", fit_with({"--column", "force=CH9 [N]"})},
      {"--column of an unknown channel", fit_with({"--column", "colour=force [N]"})},
      {"by-current of a fixed parameter", fit_with({"--by-current", "alpha:1", "--fix", "alpha=100"})},
      {"all parameters fixed",
       {"fit", "data", "--model", "viscous", "--fix", "c0=1", "--fix", "k0=1", "--fix", "f0=0", "--out", "out"}},
      {"by-current with one level",
       {"fit", "data/r1.csv", "--model", "bouc-wen", "--by-current", "alpha:1", "--out", "out"}},
      {"list of nothing", {"list", "colours"}},
      {"describe of nothing", {"describe", "bouc-wem"}},
      {"unknown dataset", {"generate", "rd9999", "--out", "out"}},
      {"generate of no recording", {"generate", "rd8040-twin", "--only", "99Hz", "--out", "out"}},
      {"simulate without a recording", {"simulate", "model.json", "--out", "out"}},
  };
}

std::vector<Wrong> wrong_recordings() {
  const std::string header = "time [s],displacement [m],velocity [m/s],force [N],current [A]\n";
  std::vector<Wrong> cases{
      bad_csv("empty file", ""),
      bad_csv("only a header", header),
      bad_csv("one row", header + "0,0,0.1,5,0\n"),
      bad_csv("two rows", header + "0,0,0.1,5,0\n0.1,0.01,0.1,7,0\n"),
      bad_csv("nan", spoiled(20, "0.5,nan,0.1,5,0.2")),
      bad_csv("infinite", spoiled(20, "0.5,0.01,0.1,inf,0.2")),
      bad_csv("text in a number column", spoiled(20, "0.5,0.01,0.1,much,0.2")),
      bad_csv("empty cell", spoiled(20, "0.5,0.01,0.1,,0.2")),
      bad_csv("time runs back", spoiled(20, "0.01,0.01,0.1,5,0.2")),
      bad_csv("ragged row, short", spoiled(20, "0.5,0.01,0.1")),
      bad_csv("ragged row, long", spoiled(20, "0.5,0.01,0.1,5,0.2,7")),
      bad_csv("unknown unit", spoiled(0, "time [s],displacement [furlong],velocity [m/s],force [N],current [A]")),
      bad_csv("unit of another quantity",
              spoiled(0, "time [s],displacement [kg],velocity [m/s],force [N],current [A]")),
      bad_csv("missing force", spoiled(0, "time [s],displacement [m],velocity [m/s],colour,current [A]")),
      bad_csv("missing time", spoiled(0, "colour,displacement [m],velocity [m/s],force [N],current [A]")),
      bad_csv("duplicate column", spoiled(0, "time [s],displacement [m],force [N],force [N],current [A]")),
      bad_csv("zero force", csv(1.0, 0.2, 80, 0.0)),
      bad_csv("binary file", std::string("\x7f"
                                         "ELF\x02\x01\x01\0\0\0\0\0\0\0\0\xff\xfe\x80",
                                         18)),
      bad_csv("number too large", spoiled(20, "0.5,0.01,0.1,1e999,0.2")),
  };
  cases.push_back({"zero force in the second recording",
                   {"fit", "data", "--model", "bouc-wen", "--budget", "60", "--out", "out"},
                   {{"data/r3.csv", csv(1.0, 0.2, 80, 0.0)}}});
  cases.push_back({"MAT file that is none",
                   {"fit", "bad.mat", "--model", "bouc-wen", "--out", "out"},
                   {{"bad.mat", "not a MAT file"}}});
  cases.push_back({"by-current without a current",
                   {"fit", "bad.csv", "--model", "bouc-wen", "--by-current", "alpha:1", "--out", "out"},
                   {{"bad.csv", spoiled(0, "time [s],displacement [m],velocity [m/s],force [N],temperature [degC]")}}});
  const std::string schema = "schema = \"hysteron.campaign/1\"\n";
  cases.push_back(bad_campaign("not TOML", "schema = \n"));
  cases.push_back(bad_campaign("no schema", "model = \"bouc-wen\"\n"));
  cases.push_back(bad_campaign("unknown schema", "schema = \"hysteron.campaign/9\"\n"));
  cases.push_back(bad_campaign("unknown key", schema + "modle = \"bouc-wen\"\n"));
  cases.push_back(bad_campaign("order is text", schema + "[by_current]\nalpha = \"one\"\n"));
  cases.push_back(bad_campaign("order too high", schema + "[by_current]\nalpha = 99\n"));
  cases.push_back(bad_campaign("unknown parameter", schema + "[by_current]\nalfa = 1\n"));
  cases.push_back(bad_campaign("missing recording", schema + "[[recording]]\nfile = \"r9.csv\"\n"));
  cases.push_back(bad_campaign("unknown role", schema + "[[recording]]\nfile = \"r1.csv\"\nrole = \"test\"\n"));
  cases.push_back(
      bad_campaign("listed twice", schema + "[[recording]]\nfile = \"r1.csv\"\n[[recording]]\nfile = \"r1.csv\"\n"));
  cases.push_back(bad_campaign("all validate", schema + "[[recording]]\nfile = \"r1.csv\"\nrole = \"validate\"\n"));
  cases.push_back({"campaign: unknown model",
                   {"fit", "data", "--out", "out"},
                   {{"data/campaign.toml", schema + "model = \"bouc-wem\"\n"}}});
  return cases;
}

class Refusal : public Program {
 protected:
  void check(const std::vector<Wrong>& cases) {
    for (const Wrong& wrong : cases) {
      SCOPED_TRACE(wrong.what);
      for (const auto& [name, text] : wrong.files) write(folder_ / name, text);
      const Outcome outcome = run(wrong.words);
      EXPECT_EQ(outcome.status, 2);
      EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
      EXPECT_TRUE(outcome.err.ends_with('\n')) << outcome.err;
      EXPECT_GT(outcome.err.size(), 20U) << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_FALSE(fs::exists(folder_ / "out"));
      fs::remove_all(folder_ / "out");
      for (const auto& [name, text] : wrong.files) fs::remove(folder_ / name);
    }
  }
};

TEST_F(Refusal, OfWrongCommandLines) { check(wrong_command_lines()); }

TEST_F(Refusal, OfWrongRecordingsAndCampaigns) { check(wrong_recordings()); }

void erase_term(json& model, const std::string& name) {
  json& rows = model["parameters"];
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k].at("name") == name) rows.erase(k);
  }
}

json& value_of(json& model, const std::string& name) {
  json& rows = model["parameters"];
  return (*std::ranges::find_if(rows, [&](const json& row) { return row.at("name") == name; }))["value"];
}

TEST_F(Refusal, OfWrongModelFiles) {
  fit();
  const std::string good = read(folder_ / "fitted/model.json");
  const auto changed = [&](const auto& change) {
    json model = json::parse(good);
    change(model);
    return model.dump(2);
  };
  std::string number_too_large = changed([](json& m) { m["parameters"][0]["value"] = 12345.0; });
  number_too_large.replace(number_too_large.find("12345.0"), 7, "1e9999");
  std::string not_a_number = number_too_large;
  not_a_number.replace(not_a_number.find("1e9999"), 6, "NaN");
  std::string twice = good;
  twice.replace(twice.find("\"value\""), 7, "\"value\": 1.0, \"value\"");
  std::string deep_power = changed([](json& m) { m["parameters"][0]["drive_power"] = "here"; });
  deep_power.replace(deep_power.find("\"here\""), 6, std::string(100000, '[') + std::string(100000, ']'));
  const std::vector<std::pair<std::string, std::string>> texts{
      {"empty", ""},
      {"not JSON", "time,force\n1,2\n"},
      {"truncated", good.substr(0, good.size() / 2)},
      {"an array", "[]"},
      {"deeper than a stack", std::string(200000, '[')},
      {"a power deeper than a stack", deep_power},
      {"no schema", "{}"},
      {"unknown schema", changed([](json& m) { m["schema"] = "hysteron.model/2"; })},
      {"schema is a number", changed([](json& m) { m["schema"] = 1; })},
      {"unknown model", changed([](json& m) { m["model"] = "bouc-wem"; })},
      {"model is a number", changed([](json& m) { m["model"] = 3; })},
      {"unknown effect", changed([](json& m) { m["effects"] = {"clearanse"}; })},
      {"effects are text", changed([](json& m) { m["effects"] = "clearance"; })},
      {"no parameters", changed([](json& m) { m.erase("parameters"); })},
      {"missing parameter", changed([](json& m) { m["parameters"].erase(0); })},
      {"unknown parameter", changed([](json& m) { m["parameters"][0]["parameter"] = "alfa"; })},
      {"value is null", changed([](json& m) { m["parameters"][0]["value"] = nullptr; })},
      {"value is text", changed([](json& m) { m["parameters"][0]["value"] = "big"; })},
      {"parameter is a number", changed([](json& m) { m["parameters"][0] = 7; })},
      {"value that cannot be", changed([](json& m) { value_of(m, "x_y") = -0.001; })},
      {"power too high", changed([](json& m) { m["parameters"][0]["drive_power"] = 99; })},
      {"parameter given twice", changed([](json& m) { m["parameters"].push_back(m["parameters"][0]); })},
      {"power is broken", changed([](json& m) { m["parameters"][1]["drive_power"] = 1.5; })},
      {"power is text", changed([](json& m) { m["parameters"][1]["drive_power"] = "1"; })},
      {"wrong unit", changed([](json& m) { m["parameters"][0]["unit"] = "kN"; })},
      {"unit is a number", changed([](json& m) { m["parameters"][0]["unit"] = 1; })},
      {"law without one of its terms", changed([](json& m) { erase_term(m, "c0*i"); })},
      {"law without its constant", changed([](json& m) { erase_term(m, "c0"); })},
      {"law with more terms than stated", changed([](json& m) { m["by_current"]["c0"] = 0; })},
      {"order is broken", changed([](json& m) { m["by_current"]["c0"] = 1.5; })},
      {"effect twice", changed([](json& m) {
         m["effects"] = {"offset-force", "offset-force"};
       })},
      {"key twice", twice},
      {"value is NaN", not_a_number},
      {"value too large", number_too_large},
  };
  for (const auto& [what, text] : texts) {
    check({{"simulate: " + what, {"simulate", "bad.json", "data/r1.csv", "--out", "out"}, {{"bad.json", text}}},
           {"score: " + what, {"score", "bad.json", "data"}, {{"bad.json", text}}}});
  }
  check({{"simulate: missing model", {"simulate", "none.json", "data/r1.csv", "--out", "out"}},
         {"simulate: folder of two recordings", {"simulate", "fitted/model.json", "data", "--out", "out"}},
         {"simulate: missing recording", {"simulate", "fitted/model.json", "none.csv", "--out", "out"}},
         {"score: folder instead of a model", {"score", "data", "data"}},
         {"score: missing data", {"score", "fitted/model.json", "none"}},
         {"score: zero force", {"score", "fitted/model.json", "zero.csv"}, {{"zero.csv", csv(1.0, 0.2, 80, 0.0)}}}});
}

TEST_F(Refusal, OfAVoltageWhereTheModelFollowsACurrent) {
  fit();
  std::string text = csv(1.0, 0.2);
  text.replace(text.find("current [A]"), 11, "voltage [V]");
  write(folder_ / "v.csv", text);
  const Outcome outcome = run({"score", "fitted/model.json", "v.csv"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(
      outcome.err,
      "error: v.csv: records a voltage, expected a current: parameters of fitted/model.json follow the current\n");
  text.replace(text.find("voltage [V]"), 11, "aside");
  write(folder_ / "n.csv", text);
  const Outcome none = run({"score", "fitted/model.json", "n.csv"});
  EXPECT_EQ(none.status, 0);
  EXPECT_EQ(none.err,
            "warning: n.csv: no current is read, and parameters of fitted/model.json follow the current: taken as "
            "zero\n");
}

TEST_F(Program, BudgetsMayBeWrittenAsPowersOfTen) {
  for (const std::string budget : {"300", "3e2", "+300", "0.3e3", "300.0"}) {
    ASSERT_EQ(run({"fit", "data", "--model", "viscous", "--solver", "pso", "--budget", budget, "--quiet", "--out", "b"})
                  .status,
              0)
        << budget;
    EXPECT_EQ(json::parse(read(folder_ / "b/fit.json")).at("solvers")[0].at("budget"), 300) << budget;
  }
}

TEST_F(Refusal, OfAnOutputThatIsAFile) {
  write(folder_ / "taken", "precious\n");
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "taken"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.err.starts_with("error: taken")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(read(folder_ / "taken"), "precious\n");
}

TEST_F(Refusal, OfAnOutputThatIsAFileBeforeTheWorkIsDone) {
  write(folder_ / "taken", "precious\n");
  const auto begun = std::chrono::steady_clock::now();
  const pid_t child = start(
      {"fit", "data", "--model", "bouc-wen", "--solver", "pso", "--budget", "900000000", "--out", "taken"}, folder_);
  int status = 0;
  bool ended = false;
  while (!ended && std::chrono::steady_clock::now() - begun < std::chrono::seconds(4)) {
    ended = waitpid(child, &status, WNOHANG) == child;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  if (!ended) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  EXPECT_TRUE(ended) << "the whole fit is run before the output folder is looked at";
}

TEST_F(Refusal, OfAReadOnlyPlace) {
  if (geteuid() == 0) GTEST_SKIP() << "root writes anywhere";
  fs::create_directory(folder_ / "locked");
  fs::permissions(folder_ / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome =
      run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "locked/out"});
  fs::permissions(folder_ / "locked", fs::perms::owner_all);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.err.starts_with("error: ")) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "locked/out"));
}

// ---- Interruption ----

TEST_F(Program, InterruptKeepsWhatIsFinishedAndExits130) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "out" + std::to_string(signal);
    const pid_t child = start({"fit", "data", "--model", "bouc-wen", "--by-current", "alpha:1,c0:1", "--solver", "pso",
                               "--budget", "900000000", "--quiet", "--out", out},
                              folder_);
    testing::wait_until_caught(child, signal);
    ASSERT_EQ(kill(child, signal), 0);
    const Outcome outcome = finish(child, folder_);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    std::size_t present = 0;
    for (const char* file : result_files) present += fs::exists(folder_ / out / file) ? 1 : 0;
    ASSERT_EQ(present, 3U) << "finished work is lost or half written";
    const json fitted = json::parse(read(folder_ / out / "fit.json"));
    EXPECT_EQ(fitted.at("solvers")[0].at("stopped"), "interrupted");
    EXPECT_FALSE(fitted.at("warnings").empty());
    for (const auto& entry : fs::directory_iterator(folder_ / out)) {
      EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
    }
    // What was kept can be used.
    EXPECT_EQ(run({"score", out + "/model.json", "data"}).status, 0);
  }
}

TEST_F(Program, WhatIsOutsideTheBoxButPossibleIsTaken) {
  for (const std::vector<std::string>& option : std::vector<std::vector<std::string>>{
           {"--fix", "n=0.9"}, {"--fix", "c0=0"}, {"--fix", "x_y=0.5"}, {"--bounds", "k0=-1e6:0"}}) {
    std::vector<std::string> words = {"fit", "data",    "--model", "bouc-wen", "--budget",
                                      "50",  "--quiet", "--out",   "out"};
    words.insert(words.end(), option.begin(), option.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << option[1] << ": " << outcome.err;
  }
  const Outcome refused = run({"fit", "data", "--model", "bouc-wen", "--fix", "n=-1", "--out", "none"});
  EXPECT_EQ(refused.err, "error: --fix n: -1 is no n (sharpness of the knee), expected more than 0\n");
}

TEST_F(Program, EveryCommandTakesTheCommonOptions) {
  const std::vector<std::string> common = {"--seed", "7", "--threads", "1", "--quiet", "--normalisation", "std"};
  const auto with_common = [&](std::vector<std::string> words) {
    words.insert(words.end(), common.begin(), common.end());
    return run(words);
  };
  ASSERT_EQ(with_common({"fit", "data", "--model", "viscous", "--budget", "50", "--out", "out"}).status, 0);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"simulate", "out/model.json", "data/r1.csv", "--out", "force.csv"},
                                             {"score", "out/model.json", "data"},
                                             {"compare", "out/model.json", "data", "--out", "compared"},
                                             {"export", "out/model.json", "--to", "c", "--out", "c"},
                                             {"list", "models"},
                                             {"describe", "bouc-wen"},
                                             {"generate", "rd8040-twin", "--only", "0.4Hz_0.0A", "--out", "twin"}}) {
    const Outcome outcome = with_common(words);
    EXPECT_EQ(outcome.status, 0) << words[0] << ": " << outcome.err;
  }
  EXPECT_EQ(run({"list", "models", "--normalisation", "peak"}).status, 2);
  EXPECT_EQ(run({"simulate", "out/model.json", "data/r1.csv", "--threads", "many", "--out", "f.csv"}).status, 2);
}

// A march within one evaluation may take longer than anyone waits.
TEST_F(Program, ASecondInterruptEndsAtOnce) {
  write(folder_ / "long/r1.csv", testing::csv(0.001, 0.2, 4000));
  const pid_t child =
      start({"fit", "long", "--model", "bouc-wen", "--fix", "x_y=1e-4", "--quiet", "--out", "out"}, folder_);
  testing::wait_until_caught(child, SIGTERM);
  usleep(300000);
  kill(child, SIGTERM);
  kill(child, SIGTERM);  // at the same time: one interruption
  usleep(1200000);
  kill(child, SIGTERM);
  const Outcome outcome = finish(child, folder_);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
}

}  // namespace
}  // namespace hysteron

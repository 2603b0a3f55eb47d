// Solvers and objectives that are programs of the user's own. The programs are small shell and Python ones; every test
// runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

const std::string examples = HYSTERON_SOURCE_DIR "/examples/solver/";

class OwnSolver : public Program {
 protected:
  // A shell script that speaks for a solver.
  std::string script(const std::string& text) {
    write(folder_ / "solver.sh", text);
    return "mine=sh solver.sh";
  }
  Outcome fitted(const std::string& command, const std::string& budget = "50") {
    return run({"fit", "data", "--model", "viscous", "--solver", "mine", "--solver-command", command, "--budget",
                budget, "--quiet", "--out", "out"});
  }
};

TEST_F(OwnSolver, IsAskedAndToldWithinTheBudget) {
  // What it is told is kept in a file.
  const Outcome outcome = fitted(script("read first; echo \"$first\" > first.json\n"
                                        "for k in 1 2 3 4; do\n"
                                        "  echo '{\"ask\": [[0.1, 0.2, 0.3], [0.3, 0.4, 0.5], [0.5, 0.6, 0.7]]}'\n"
                                        "  read answer || exit 0\n"
                                        "  echo \"$answer\" >> told.json\n"
                                        "done\n"),
                                 "8");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json first = json::parse(read(folder_ / "first.json"));
  EXPECT_EQ(first.at("protocol"), "hysteron.ask-tell/1");
  EXPECT_EQ(first.at("dimension"), 3);
  EXPECT_EQ(first.at("budget"), 8);
  EXPECT_LT(first.at("seed").get<double>(), 2147483648.0);
  const json fit = json::parse(read(folder_ / "out/fit.json"));
  const json& solver = fit.at("solvers").at(0);
  EXPECT_EQ(solver.at("id"), "mine");
  EXPECT_EQ(solver.at("evaluations"), 8);
  EXPECT_EQ(solver.at("stopped"), "budget");
  // Two answers of three costs; the last question was answered in part and ended the run.
  const std::string told = read(folder_ / "told.json");
  ASSERT_EQ(std::ranges::count(told, '\n'), 2);
  const json costs = json::parse(told.substr(0, told.find('\n'))).at("tell");
  ASSERT_EQ(costs.size(), 3U);
  double least = 1e300;
  for (const json& cost : costs) least = std::min(least, cost.get<double>());
  EXPECT_EQ(solver.at("cost").get<double>(), least);
}

TEST_F(OwnSolver, MayEndByItself) {
  const Outcome outcome =
      fitted(script("read first; echo '{\"ask\": [[0.1, 0.2, 0.3]]}'; read answer\n"
                    "echo; echo '{\"stop\": \"near enough\"}'\n"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(read(folder_ / "out/fit.json")).at("solvers").at(0).at("stopped"), "near enough");
}

TEST_F(OwnSolver, ThatAsksForNothingNeedsNoLargerBudget) {
  const Outcome outcome = fitted(script("read first; echo '{\"stop\": \"nothing\"}'\n"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "error: solver mine stopped before its first evaluation: nothing\n");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(OwnSolver, WhatItSaysWronglyIsOneLine) {
  struct Case {
    std::string says;
    std::string expected;
  };
  const Case cases[] = {
      {"hello",
       "solver 'mine' printed 'hello', expected {\"ask\": [[...], ...]} with at least one point, or {\"stop\": "
       "\"why\"}"},
      {"{\"ask\": []}",
       "solver 'mine' printed '{\"ask\": []}', expected {\"ask\": [[...], ...]} with at least one point, "
       "or {\"stop\": \"why\"}"},
      {"{\"ask\": [[0.1]]}", "solver 'mine' printed '{\"ask\": [[0.1]]}', expected points of 3 numbers"},
      {"{\"ask\": [[0.1, 0.2, 1.5]]}",
       "solver 'mine' printed '{\"ask\": [[0.1, 0.2, 1.5]]}', expected coordinates from 0 to 1"},
      {"{\"ask\": [[0.1, 0.2, null]]}",
       "solver 'mine' printed '{\"ask\": [[0.1, 0.2, null]]}', expected coordinates from 0 to 1"},
      {"{\"ask\": [[0.1, 0.2, 0.3]], \"stop\": \"x\"}",
       "solver 'mine' printed '{\"ask\": [[0.1, 0.2, 0.3]], \"stop\": \"x\"}', expected either {\"ask\": [[...], ...]} "
       "or {\"stop\": \"why\"}, not both in one line"},
  };
  for (const Case& one : cases) {
    const Outcome outcome = fitted(script("read first; echo '" + one.says + "'; read answer\n"));
    EXPECT_EQ(outcome.status, 1) << one.says;
    EXPECT_EQ(outcome.err, "error: " + one.expected + "\n");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  const Outcome silent = fitted("mine=true");
  EXPECT_EQ(silent.status, 1);
  EXPECT_EQ(std::ranges::count(silent.err, '\n'), 1) << silent.err;
}

TEST_F(OwnSolver, AQuestionBeforeTheAnswerIsRefused) {
  const Outcome outcome = fitted(
      script("read first; printf '{\"ask\": [[0.1, 0.2, 0.3]]}\\n{\"ask\": [[0.3, 0.2, 0.1]]}\\n'; read answer\n"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err,
            "error: solver 'mine' printed '{\"ask\": [[0.3, 0.2, 0.1]]}' without being asked, expected nothing before "
            "{\"tell\": [...]}\n");
}

TEST_F(OwnSolver, ThatFailsAtItsEndIsTold) {
  const Outcome outcome =
      fitted(script("read first; echo '{\"ask\": [[0.1, 0.2, 0.3]]}'; read answer\n"
                    "echo '{\"stop\": \"near enough\"}'; read end; exit 3\n"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: solver 'mine': 'sh' ended with status 3\n"), std::string::npos) << outcome.err;
}

// A setting that no solver has is a mistake, however many solvers there are.
TEST_F(OwnSolver, ASettingThatNoSolverHasIsRefused) {
  const std::vector<std::string> fit = {"fit", "data", "--model", "viscous"};
  const std::vector<std::string> minimise = {"minimise", "--objective", "python3 " + examples + "objective.py", "--box",
                                             "x=-2:2,y=-1:3"};
  for (const std::vector<std::string>& command : {fit, minimise}) {
    const auto set = [&](const std::string& solvers, const std::string& setting) {
      std::vector<std::string> words = command;
      words.insert(words.end(), {"--solver", solvers, "--set", setting, "--budget", "40", "--quiet", "--out", "out"});
      return run(words);
    };
    for (const auto& [solvers, setting, says] :
         {std::tuple{"pso,de", "populaton=5",
                     "--set: none of pso, de has a setting 'populaton' (did you mean 'population'?), see `hysteron "
                     "describe SOLVER`"},
          {"pso,de", "ants=3", "--set: none of pso, de has a setting 'ants', see `hysteron describe SOLVER`"},
          {"pso", "populaton=5",
           "--set: 'pso' has no setting 'populaton' (did you mean 'population'?), see `hysteron describe pso`"}}) {
      const Outcome outcome = set(solvers, setting);
      EXPECT_EQ(outcome.status, 2) << command[0];
      EXPECT_EQ(outcome.err, "error: " + std::string(says) + "\n");
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
    // One that one of them has goes to that one.
    EXPECT_EQ(set("pso,random-search", "topology=0").status, 0) << command[0];
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(OwnSolver, WrongCommandsAreRefused) {
  struct Case {
    std::string command;
    std::string says;
  };
  const Case cases[] = {
      {"mine", "--solver-command: 'mine' is wrong, expected NAME=COMMAND"},
      {"mine=", "command '' is empty"},
      {"mine=sh 'open", "a quote is not closed"},
      {"pso=true", "solver 'pso' exists already"},
      {"mine=no-such-program-at-all", "'no-such-program-at-all' cannot be started"},
  };
  for (const Case& one : cases) {
    const Outcome outcome = fitted(one.command);
    EXPECT_EQ(outcome.status, 2) << one.command;
    EXPECT_NE(outcome.err.find(one.says), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(OwnSolver, TheExampleRunsInAStudyToTheSameBytes) {
  const auto study = [&](const std::string& out, const std::string& threads) {
    const Outcome outcome = run({"bench", examples + "own-solver.toml", "--out", out, "--threads", threads, "--quiet",
                                 "--solver-command", "random-walk=python3 " + examples + "random_walk.py"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(run({"report", out, "--out", out + "-report"}).status, 0);
    return read(folder_ / (out + "-report") / "runs.csv");
  };
  const std::string one = study("one", "1");
  EXPECT_EQ(std::ranges::count(one, '\n'), 1 + 2 * 3 * 5);
  EXPECT_NE(one.find("random-walk"), std::string::npos);
  EXPECT_EQ(study("two", "2"), one);
}

TEST_F(OwnSolver, AStudyAloneStartsNothing) {
  const Outcome outcome = run({"bench", examples + "own-solver.toml", "--out", "out", "--quiet"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("unknown solver 'random-walk'"), std::string::npos) << outcome.err;
}

TEST_F(OwnSolver, OctaveSpeaksTheSameProtocol) {
  if (std::system("command -v octave-cli > /dev/null") != 0) GTEST_SKIP() << "octave-cli is not installed";
  const Outcome outcome = fitted("mine=octave-cli " + examples + "random_walk.m", "100");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(read(folder_ / "out/fit.json")).at("solvers").at(0).at("evaluations"), 100);
}

TEST_F(OwnSolver, IsRefusedWhereNoSolverIsAskedForByItsName) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--solver", "pso"}}) {
    std::vector<std::string> words{"fit",      "data", "--model", "viscous", "--solver-command", "mine=sh mine.sh",
                                   "--budget", "50",   "--out",   "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err,
              "error: --solver-command: 'mine' is not among the solvers asked for, expected --solver mine\n");
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

using Minimise = OwnSolver;

// Of the Kalman filter a small budget would leave one evaluation, in the middle of the box.
TEST_F(Minimise, ASolverThatNeedsMoreThanCostsIsRefusedWithThoseThatDoNot) {
  const std::string those = ", expected aco-r, adaptive-css, cma-es, ";
  for (const auto& [solver, why] :
       {std::pair{"ukf", "error: --solver: 'ukf' follows recordings in time, which an objective has none of"},
        {"lm", "error: --solver: 'lm' asks for derivatives, which a program does not give"}}) {
    for (const char* budget : {"5", "500"}) {
      const Outcome outcome =
          run({"minimise", "--objective", "python3 " + examples + "objective.py", "--box", "x=-2:2,y=-1:3", "--solver",
               std::string("pso,") + solver, "--budget", budget, "--quiet", "--out", "found.json"});
      EXPECT_EQ(outcome.status, 2);
      EXPECT_TRUE(outcome.err.starts_with(why + those)) << outcome.err;
      EXPECT_NE(outcome.err.find("nlopt:* without derivatives"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.err.find("minpack:*"), std::string::npos) << outcome.err;
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
      EXPECT_FALSE(fs::exists(folder_ / "found.json"));
    }
  }
}

// All that the message lists do work, and a member of a family where there is one for costs alone.
TEST_F(Minimise, EverySolverThatNeedsCostsAloneIsTaken) {
  const std::string said = run({"minimise", "--objective", "true", "--box", "x=0:1", "--solver", "ukf"}).err;
  const std::string expected = ", expected ";
  ASSERT_NE(said.find(expected), std::string::npos) << said;
  std::string list = said.substr(said.find(expected) + expected.size());
  list.replace(list.rfind(" or "), 4, ", ");
  std::istringstream words(list);
  std::string solvers = "nlopt:LN_COBYLA";
  for (std::string word; std::getline(words, word, ',');) {
    if (word.find('*') == std::string::npos) solvers += "," + word.substr(word.find_first_not_of(' '));
  }
  const Outcome outcome =
      run({"minimise", "--objective", "python3 " + examples + "objective.py", "--box", "x=-2:2,y=-1:3", "--solver",
           solvers, "--budget", "100", "--quiet", "--out", "found.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json runs = json::parse(read(folder_ / "found.json")).at("runs");
  EXPECT_GE(runs.size(), 16U);
  for (const json& one : runs) EXPECT_GT(one.at("evaluations"), 10) << one.at("solver");
}

TEST_F(Minimise, FindsTheMinimumOfAnObjectiveInPython) {
  const Outcome outcome =
      run({"minimise", "--objective", "python3 " + examples + "objective.py", "--box", "x=-2:2,y=-1:3", "--solver",
           "cma-es,random-search", "--budget", "1000", "--quiet", "--out", "found.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json found = json::parse(read(folder_ / "found.json"));
  const json& best = found.at("runs").at(0);
  EXPECT_EQ(best.at("evaluations"), 1000);
  EXPECT_LT(best.at("cost").get<double>(), 1e-10);
  EXPECT_NEAR(best.at("parameters").at("x").get<double>(), 1.0, 1e-4);
  EXPECT_NEAR(best.at("parameters").at("y").get<double>(), 1.0, 1e-4);
  EXPECT_EQ(best.at("trace").back().at(1), best.at("cost"));
  EXPECT_GT(found.at("runs").at(1).at("cost").get<double>(), 1e-6);
}

TEST_F(Minimise, PointsWithoutACostAreNoSuccess) {
  write(folder_ / "none.sh", "read first\nwhile read points; do echo '{\"costs\": [null]}'; done\n");
  const Outcome outcome = run({"minimise", "--objective", "sh none.sh", "--box", "x=0:1", "--solver", "nelder-mead",
                               "--budget", "1", "--quiet", "--out", "found.json"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "error: the objective gave no point a cost\n");
  EXPECT_EQ(json::parse(read(folder_ / "found.json")).at("runs").at(0).at("cost"), json());
}

// Energies in joule, squares of forces in newton: what counts as a cost is not for the program to say.
TEST_F(Minimise, AnyFiniteValueIsACost) {
  write(
      folder_ / "large.py",
      "import json, sys\n"
      "sys.stdin.readline()\n"
      "for line in sys.stdin:\n"
      "    points = json.loads(line)['evaluate']\n"
      "    print(json.dumps({'costs': [(1 + (x - 0.3) ** 2) * float(sys.argv[1]) for (x,) in points]}), flush=True)\n");
  for (const std::string scale : {"1e10", "3e100", "1e307"}) {
    const Outcome outcome = run({"minimise", "--objective", "python3 large.py " + scale, "--box", "x=0:1", "--solver",
                                 "cma-es,nelder-mead", "--budget", "300", "--quiet", "--out", "found.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const json found = json::parse(read(folder_ / "found.json"));
    for (const json& one : found.at("runs")) {
      EXPECT_NEAR(one.at("parameters").at("x").get<double>(), 0.3, 1e-5) << scale;
      EXPECT_NEAR(one.at("cost").get<double>() / std::stod(scale), 1.0, 1e-9) << scale;
      EXPECT_EQ(one.at("trace").back().at(1), one.at("cost"));
      EXPECT_EQ(one.at("without_cost"), 0);
    }
  }
}

TEST_F(Minimise, NegativeCostsAreMinimisedByEveryFamily) {
  write(folder_ / "five.py",
        "import json, sys\n"
        "sys.stdin.readline()\n"
        "for line in sys.stdin:\n"
        "    points = json.loads(line)['evaluate']\n"
        "    print(json.dumps({'costs': [x * x + (y - 1) ** 2 - 5 for x, y in points]}), flush=True)\n");
  const Outcome outcome =
      run({"minimise", "--objective", "python3 five.py", "--box", "x=-2:3,y=-1:4", "--solver",
           "nlopt:LN_BOBYQA,nlopt:LN_COBYLA,nlopt:GN_DIRECT_L", "--budget", "500", "--quiet", "--out", "found.json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json found = json::parse(read(folder_ / "found.json"));
  for (const json& one : found.at("runs")) EXPECT_NEAR(one.at("cost").get<double>(), -5.0, 1e-3) << one.at("solver");
}

TEST_F(Minimise, AnAnswerThatNobodyAskedForIsRefused) {
  write(folder_ / "stale.py",
        "import json, sys\n"
        "sys.stdin.readline()\n"
        "for k, line in enumerate(sys.stdin):\n"
        "    costs = json.dumps({'costs': [1.0 for _ in json.loads(line)['evaluate']]})\n"
        "    print(costs + ('\\n{\"costs\": [-1]}' if k == 0 else ''), flush=True)\n");
  // Before the next question, and where there is none any more.
  for (const char* budget : {"5", "1"}) {
    const Outcome outcome = run({"minimise", "--objective", "python3 stale.py", "--box", "x=0:1", "--solver",
                                 "nelder-mead", "--budget", budget, "--quiet", "--out", "found.json"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err,
              "error: the objective printed '{\"costs\": [-1]}' without being asked, expected one line for each "
              "question\n");
    EXPECT_FALSE(fs::exists(folder_ / "found.json"));
  }
}

TEST_F(Minimise, AnObjectiveThatFailsAtItsEndIsTold) {
  write(folder_ / "ends.sh", "read first\nwhile read points; do echo '{\"costs\": [1]}'; done\nexit 4\n");
  const Outcome outcome = run({"minimise", "--objective", "sh ends.sh", "--box", "x=0:1", "--solver", "nelder-mead",
                               "--budget", "1", "--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "warning: the objective, asked by nelder-mead: 'sh' ended with status 4\n");
}

TEST_F(Minimise, WrongWordsAreRefused) {
  const std::string objective = "python3 " + examples + "objective.py";
  const std::vector<std::vector<std::string>> cases = {
      {"--box", "x"},
      {"--box", "x=1"},
      {"--box", "x=1:0"},
      {"--box", "x=0:nan"},
      {"--box", "x=0:1,x=0:1"},
      {"--box", "x=0:1", "--solver", "psoo"},
      {"--box", "=0:1"},
      {"--box", "x=0:1", "--solver", "lm"},
      {"--box", "x=0:1", "--set", "steps=5"},
  };
  for (std::vector<std::string> words : cases) {
    words.insert(words.begin(), {"minimise", "--objective", objective, "--quiet", "--out", "found.json"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words.back();
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "found.json"));
  }
}

}  // namespace
}  // namespace hysteron

// The program as a user runs it: the same bytes for any number of threads, after kills, from shards.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/program.hpp"
#include "core/random.hpp"
#include "io/temporary_folder.hpp"
#include "study/small_study.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::read;
using testing::report_bytes;
using testing::run;
using testing::small_runs;
using testing::small_study;
using testing::start;
using testing::TemporaryFolder;
using testing::wait_for;

class Bench : public ::testing::Test {
 protected:
  void SetUp() override { folder.write("study.toml", small_study); }
  TemporaryFolder folder;
};

TEST_F(Bench, ThreadsDoNotChangeAByte) {
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    const std::string out = std::string("t") + threads;
    const Outcome outcome = run({"bench", "study.toml", "--out", out, "--threads", threads, "--quiet"}, folder.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string bytes = report_bytes(folder.path(), out);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads << " threads";
  }
  EXPECT_NE(first.find("\"done\": 60"), std::string::npos);
}

TEST_F(Bench, KilledAndResumedGivesTheSameBytes) {
  ASSERT_EQ(run({"bench", "study.toml", "--out", "whole", "--quiet"}, folder.path()).status, 0);
  const std::string expected = report_bytes(folder.path(), "whole");
  // Instants from a fixed stream; where a machine is so slow that a call adds nothing, the last call finishes.
  const Stream instants(20);
  int killed = 0;
  for (std::uint64_t k = 0; k < 10; ++k) {
    const pid_t child = start({"bench", "study.toml", "--out", "killed", "--threads", "2", "--quiet"}, folder.path());
    std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(2000 + 120000 * instants.uniform(k))));
    kill(child, SIGKILL);
    killed += wait_for(child) == testing::ended_by(SIGKILL) ? 1 : 0;
  }
  EXPECT_GT(killed, 0);
  const Outcome outcome = run({"bench", "study.toml", "--out", "killed", "--quiet"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(report_bytes(folder.path(), "killed"), expected);
}

TEST_F(Bench, InterruptKeepsFinishedRuns) {
  folder.write(
      "long.toml",
      "schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 5000\nseeds = 3000\n"
      "[[data]]\ndataset = \"rd8040-twin\"\nonly = \"2.0Hz_1.0A\"\n");
  const pid_t child = start({"bench", "long.toml", "--out", "out", "--quiet"}, folder.path());
  // Until the store holds runs; the plan alone, which comes first, takes a while to write. Watched from a folder of its
  // own, where the two programs' messages do not mix.
  fs::create_directory(folder.path() / "watch");
  for (int k = 0; k < 600; ++k) {
    const Outcome sofar = run({"report", "../out", "--json"}, folder.path() / "watch");
    if (sofar.status == 0 && nlohmann::json::parse(sofar.out).at("done") > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  EXPECT_NE(read(folder.path() / "stderr.txt").find("are kept"), std::string::npos);
  const Outcome report = run({"report", "out", "--json"}, folder.path());
  ASSERT_EQ(report.status, 0) << report.err;
  const auto analysis = nlohmann::json::parse(report.out);
  EXPECT_GT(analysis.at("done"), 0);
  EXPECT_LT(analysis.at("done"), 3000);
  EXPECT_NE(analysis.at("warnings").dump().find("runs are missing"), std::string::npos);
}

TEST_F(Bench, OneSolverIsNotRanked) {
  folder.write("one.toml",
               "schema = \"hysteron.study/1\"\nmodels = [\"viscous\", \"bingham\"]\nsolvers = [\"pso\"]\n"
               "budgets = 50\nseeds = 2\n[[data]]\ndataset = \"rd8040-twin\"\nonly = \"2.0Hz_1.0A\"\n");
  ASSERT_EQ(run({"bench", "one.toml", "--out", "one", "--quiet"}, folder.path()).status, 0);
  ASSERT_EQ(run({"report", "one"}, folder.path()).status, 0);
  const std::string text = read(folder.path() / "one" / "report.md");
  EXPECT_NE(text.find("One solver: models are ranked, solvers are not."), std::string::npos) << text;
  EXPECT_NE(text.find("2 problems, 1 solver, 2 seeds"), std::string::npos) << text;
  EXPECT_NE(text.find("## Ranking of models"), std::string::npos);
  EXPECT_EQ(text.find("Friedman"), std::string::npos);
}

TEST_F(Bench, AGrownStudyDoesOnlyWhatIsNew) {
  ASSERT_EQ(run({"bench", "study.toml", "--out", "out", "--quiet"}, folder.path()).status, 0);
  std::string grown = small_study;
  grown.replace(grown.find("seeds = 5"), 9, "seeds = 6");
  folder.write("study.toml", grown);
  const Outcome outcome = run({"bench", "study.toml", "--out", "out", "--quiet"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("12 runs done, 60 found"), 0U) << outcome.out;
  ASSERT_EQ(run({"bench", "study.toml", "--out", "fresh", "--quiet"}, folder.path()).status, 0);
  EXPECT_EQ(report_bytes(folder.path(), "out"), report_bytes(folder.path(), "fresh"));
}

TEST_F(Bench, ShardsMergeToTheWhole) {
  ASSERT_EQ(run({"bench", "study.toml", "--out", "whole", "--quiet"}, folder.path()).status, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const Outcome outcome = run(
        {"bench", "study.toml", "--out", std::string("part") + shard[0], "--shard", shard, "--quiet"}, folder.path());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  const Outcome merged = run({"merge", "part1", "part2", "part3", "--out", "merged"}, folder.path());
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(merged.out.find(std::to_string(small_runs) + " of " + std::to_string(small_runs)), 0U) << merged.out;
  // What needs the recordings, the identifiability of the best fits, is added by a call that finds all runs done.
  const Outcome again = run({"bench", "study.toml", "--out", "merged", "--quiet"}, folder.path());
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out.find("0 runs done, " + std::to_string(small_runs) + " found"), 0U) << again.out;
  EXPECT_EQ(report_bytes(folder.path(), "merged"), report_bytes(folder.path(), "whole"));
}

TEST_F(Bench, MergeRefusesAnotherStudy) {
  ASSERT_EQ(run({"bench", "study.toml", "--out", "a", "--shard", "1/9", "--quiet"}, folder.path()).status, 0);
  std::string other = small_study;
  other.replace(other.find("seeds = 5"), 9, "seeds = 4");
  folder.write("study.toml", other);
  ASSERT_EQ(run({"bench", "study.toml", "--out", "b", "--shard", "1/9", "--quiet"}, folder.path()).status, 0);
  const Outcome outcome = run({"merge", "a", "b", "--out", "c"}, folder.path());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("another study"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "c"));
}

TEST_F(Bench, WrongStudyWritesNothing) {
  folder.write("wrong.toml", "schema = \"hysteron.study/1\"\nmodels = [\"nothing\"]\n");
  const Outcome outcome = run({"bench", "wrong.toml", "--out", "out"}, folder.path());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err.find("error: wrong.toml:2: unknown model"), 0U) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
  EXPECT_EQ(run({"bench", "study.toml", "--out", "out", "--shard", "3/2"}, folder.path()).status, 2);
  EXPECT_EQ(run({"report", "nothing"}, folder.path()).status, 2);
}

TEST_F(Bench, AFullDiskIsToldAndLosesNothing) {
  ASSERT_EQ(run({"bench", "study.toml", "--out", "whole", "--quiet"}, folder.path()).status, 0);
  // A limit on file size stands for the full disk: writes beyond it fail.
  const Outcome outcome = run({"bench", "study.toml", "--out", "full", "--quiet"}, folder.path(), [] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{120000, 120000};
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_EQ(outcome.err.find("error: full/store.sqlite: "), 0U) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  const Outcome resumed = run({"bench", "study.toml", "--out", "full", "--quiet"}, folder.path());
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(resumed.out.find("60 runs done"), std::string::npos)
      << "nothing of the first call was kept: " << resumed.out;
  EXPECT_EQ(report_bytes(folder.path(), "full"), report_bytes(folder.path(), "whole"));
}

TEST_F(Bench, TwoProcessesOnOneStore) {
  std::string study = small_study;
  study.replace(study.find("seeds = 5"), 9, "seeds = 400");
  folder.write("study.toml", study);
  fs::create_directories(folder.path() / "other");
  const pid_t first = start({"bench", "study.toml", "--out", "out", "--quiet"}, folder.path());
  for (int k = 0; k < 600 && !fs::exists(folder.path() / "out/store.sqlite-wal"); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Outcome second = run({"bench", "../study.toml", "--out", "../out", "--quiet"}, folder.path() / "other");
  EXPECT_EQ(second.status, 1);
  EXPECT_NE(second.err.find("another process is writing"), std::string::npos) << second.err;
  kill(first, SIGTERM);
  EXPECT_EQ(wait_for(first), 130);
}

}  // namespace
}  // namespace hysteron

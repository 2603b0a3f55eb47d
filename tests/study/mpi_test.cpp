// Studies under mpirun as a user starts them: any number of ranks gives the bytes of a single process, also after
// kills.
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/random.hpp"
#include "io/temporary_folder.hpp"
#include "study/small_study.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::report_bytes;
using testing::small_study;
using testing::TemporaryFolder;

// Of a test only: more ranks than cores, as root in a container, and no noise of mpirun after an error.
void environment() {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMP_NUM_THREADS", "1", 1);
  // Open MPI keeps memory of plugins that it has unloaded by the end: leaks of ours are looked for by the other tests.
  const char* options = std::getenv("ASAN_OPTIONS");
  setenv("ASAN_OPTIONS", (std::string(options == nullptr ? "" : options) + ":detect_leaks=0").c_str(), 1);
}

class Mpi : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::string(HYSTERON_MPIRUN).empty()) GTEST_SKIP() << "built without MPI (HYSTERON_MPI, libopenmpi-dev)";
    if (access(HYSTERON_MPIRUN, X_OK) != 0) GTEST_SKIP() << "there is no " << HYSTERON_MPIRUN << " (openmpi-bin)";
    folder.write("study.toml", small_study);
  }

  [[nodiscard]] pid_t start(int ranks, const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{"--oversubscribe", "-n", std::to_string(ranks), HYSTERON_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return testing::start_other(HYSTERON_MPIRUN, words, folder.path(), environment);
  }
  [[nodiscard]] Outcome run(int ranks, const std::vector<std::string>& arguments) const {
    return testing::finish(start(ranks, arguments), folder.path());
  }
  // What a single process makes of the study.
  [[nodiscard]] std::string expected() const {
    const Outcome outcome = testing::run({"bench", "study.toml", "--out", "single", "--quiet"}, folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return report_bytes(folder.path(), "single");
  }
  // Lines that begin with "error: ": mpirun adds its own words about the exit status.
  static std::ptrdiff_t errors(const std::string& text) {
    std::ptrdiff_t count = 0;
    for (auto at = text.find("error: "); at != std::string::npos; at = text.find("error: ", at + 1)) {
      count += at == 0 || text[at - 1] == '\n' ? 1 : 0;
    }
    return count;
  }
  TemporaryFolder folder;
};

TEST_F(Mpi, RanksDoNotChangeAByte) {
  const std::string whole = expected();
  for (const int ranks : {1, 2, 4}) {
    const std::string out = "ranks" + std::to_string(ranks);
    const Outcome outcome = run(ranks, {"bench", "study.toml", "--out", out, "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("60 runs done, 0 found"), 0U) << outcome.out;
    EXPECT_FALSE(fs::exists(folder.path() / out / "rank-1")) << "the stores of the ranks were not taken in";
    EXPECT_EQ(report_bytes(folder.path(), out), whole) << ranks << " ranks";
  }
}

// A rank, or mpirun itself, is killed at instants of a fixed stream; a report may be asked for in between; the last
// call is of a single process, which takes in what the ranks left.
TEST_F(Mpi, KilledAndResumedGivesTheSameBytes) {
  const std::string whole = expected();
  const Stream instants(21);
  int killed = 0;
  for (std::uint64_t k = 0; k < 8; ++k) {
    const pid_t child = start(3, {"bench", "study.toml", "--out", "killed", "--quiet"});
    // Kills before the ranks have begun would show nothing.
    for (int wait = 0; wait < 600 && !fs::exists(folder.path() / "killed/rank-2/store.sqlite"); ++wait) {
      if (waitpid(child, nullptr, WNOHANG) != 0) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(150000 * instants.uniform(k))));
    pid_t victim = child;
    if (k % 2 == 1) {
      // The youngest child of mpirun: a rank.
      const std::string children =
          testing::read("/proc/" + std::to_string(child) + "/task/" + std::to_string(child) + "/children");
      const auto last = children.find_last_of(' ', children.size() < 2 ? 0 : children.size() - 2);
      if (!children.empty()) victim = std::stoi(children.substr(last == std::string::npos ? 0 : last + 1));
    }
    kill(victim, SIGKILL);
    int status = 0;
    // -1: it had ended by itself and was waited for above.
    if (waitpid(child, &status, 0) == child && !(WIFEXITED(status) && WEXITSTATUS(status) == 0)) ++killed;
    // Ranks notice in their own time that mpirun is gone.
    for (int wait = 0; wait < 600; ++wait) {
      bool held = false;
      for (const char* store : {"killed", "killed/rank-1", "killed/rank-2"}) {
        const int lock = open((folder.path() / store / "store.lock").c_str(), O_RDWR | O_CLOEXEC);
        if (lock < 0) continue;
        held = held || flock(lock, LOCK_EX | LOCK_NB) != 0;
        close(lock);
      }
      if (!held) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (fs::exists(folder.path() / "killed/store.sqlite") && k == 3) {
      const Outcome outcome = testing::run({"report", "killed", "--out", "between"}, folder.path());
      EXPECT_TRUE(outcome.status == 0 || outcome.err.find("no plan yet") != std::string::npos) << outcome.err;
    }
  }
  EXPECT_GT(killed, 0);
  const Outcome outcome = testing::run({"bench", "study.toml", "--out", "killed", "--quiet"}, folder.path());
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder.path() / "killed/rank-1"));
  EXPECT_EQ(report_bytes(folder.path(), "killed"), whole);
}

TEST_F(Mpi, ErrorsAreOneLineAndKeepTheirStatus) {
  folder.write("wrong.toml", "schema = \"hysteron.study/1\"\nmodels = [\"nothing\"]\n");
  const Outcome wrong = run(3, {"bench", "wrong.toml", "--out", "out"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(errors(wrong.err), 1) << wrong.err;
  EXPECT_NE(wrong.err.find("error: wrong.toml:2: unknown model"), std::string::npos) << wrong.err;
  EXPECT_FALSE(fs::exists(folder.path() / "out"));

  const Outcome option = run(2, {"bench", "study.toml", "--nonsense"});
  EXPECT_EQ(option.status, 2);
  EXPECT_EQ(errors(option.err), 1) << option.err;

  // A rank that cannot write its store, for a file is where its folder should be.
  folder.write("blocked/rank-1", "in the way");
  const Outcome blocked = run(2, {"bench", "study.toml", "--out", "blocked", "--quiet"});
  EXPECT_NE(blocked.status, 0);
  EXPECT_EQ(errors(blocked.err), 1) << blocked.err;
  EXPECT_NE(blocked.err.find("rank-1"), std::string::npos) << blocked.err;
}

// A build without MPI must not let several processes loose on one folder.
TEST(WithoutMpi, RefusesToBeOneOfSeveral) {
  if (!std::string(HYSTERON_MPIRUN).empty()) GTEST_SKIP() << "built with MPI";
  const TemporaryFolder folder;
  folder.write("study.toml", small_study);
  for (const char* rank : {"0", "1"}) {
    const Outcome outcome = testing::run({"bench", "study.toml", "--out", "out"}, folder.path(), [&] {
      setenv("OMPI_COMM_WORLD_RANK", rank, 1);
      setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
    });
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find("built without MPI") != std::string::npos, *rank == '0') << outcome.err;
    EXPECT_EQ(outcome.err.empty(), *rank == '1') << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hysteron

// The program in surroundings that are not as they should be. Every test runs HYSTERON_PROGRAM in a temporary folder of
// its own.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Use = Program;

TEST_F(Use, ASlipInTheNumberOfThreadsEndsNothing) {
  for (const char* threads : {"99999", "1000000000", "-1", "0", "many"}) {
    const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"},
                                [&] { setenv("OMP_NUM_THREADS", threads, 1); });
    EXPECT_EQ(outcome.status, 0) << threads << ": " << outcome.err;
  }
}

TEST_F(Use, AnIncompletePluginIsRefused) {
  const std::string whole = read(HYSTERON_PLUGIN);
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.999}) {
    write(folder_ / "cut.so", whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    const Outcome outcome = run({"--plugin", "./cut.so", "list", "models"});
    EXPECT_EQ(outcome.status, 2) << share;
    EXPECT_NE(outcome.err.find("expected a plugin library"), std::string::npos) << outcome.err;
  }
}

TEST_F(Use, OnlyFilesAreRead) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.csv").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero.csv");
  for (const std::string name : {"pipe.csv", "zero.csv"}) {
    const Outcome outcome = run({"fit", name, "--model", "viscous", "--out", "out"}, [] { alarm(20); });
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, "error: " + name + ": is a pipe or a device, expected a regular file\n");
  }
  fs::create_symlink("/dev/zero", folder_ / "data/campaign.toml");
  EXPECT_EQ(run({"fit", "data", "--model", "viscous", "--out", "out"}, [] { alarm(20); }).status, 2);
}

}  // namespace
}  // namespace hysteron

// Pieces of work that outlive the process, whatever ends it.
#include "io/checkpoint.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

// Of every byte, zero among them.
std::string bytes_of(int k) {
  std::string result(300, '\0');
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = static_cast<char>(n * static_cast<std::size_t>(k));
  return result;
}

void keep_some(const fs::path& path, int from, int to) {
  Checkpoint checkpoint(path, "command");
  for (int k = from; k < to; ++k) checkpoint.keep("piece " + std::to_string(k), bytes_of(k));
  ASSERT_EQ(checkpoint.trouble(), "");
}

std::string whole_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Checkpoint, GivesBackWhatWasKept) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "out/work.partial";
  {
    const Checkpoint untouched(path, "command");
    EXPECT_EQ(untouched.found(), Checkpoint::Found::nothing);
    EXPECT_FALSE(untouched.find("piece 1"));
  }
  EXPECT_FALSE(fs::exists(path.parent_path())) << "made before there is anything to keep";
  keep_some(path, 0, 5);
  keep_some(path, 5, 9);
  Checkpoint again(path, "command");
  EXPECT_EQ(again.found(), Checkpoint::Found::pieces);
  EXPECT_EQ(again.pieces(), 9U);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(again.find("piece " + std::to_string(k)), bytes_of(k)) << k;
  EXPECT_FALSE(again.find("piece 9"));
  again.remove();
  EXPECT_TRUE(fs::is_empty(path.parent_path()));
}

TEST(Checkpoint, OfAnotherCommandIsGivenUp) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "work.partial";
  keep_some(path, 0, 3);
  {
    Checkpoint other(path, "another command");
    EXPECT_EQ(other.found(), Checkpoint::Found::of_another_command);
    EXPECT_EQ(other.pieces(), 0U);
    other.keep("piece", "bytes");
  }
  EXPECT_EQ(Checkpoint(path, "another command").pieces(), 1U);
}

TEST(Checkpoint, ThatIsDamagedIsGivenUpAndNeverBelieved) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "work.partial";
  keep_some(path, 0, 40);
  const std::string good = whole_file(path);
  // Every part of the file in turn, and its end cut off.
  int given_up = 0;
  for (std::size_t at = 0; at < good.size(); at += good.size() / 97) {
    std::string bad = good;
    bad[at] = static_cast<char>(~bad[at]);
    std::ofstream(path, std::ios::binary) << bad;
    const Checkpoint checkpoint(path, "command");
    given_up += checkpoint.found() == Checkpoint::Found::damaged ? 1 : 0;
    for (int k = 0; k < 40; ++k) {
      const auto piece = checkpoint.find("piece " + std::to_string(k));
      EXPECT_TRUE(!piece || *piece == bytes_of(k)) << "byte " << at << ", piece " << k;
    }
  }
  EXPECT_GT(given_up, 0);
  for (const std::string& bad : {good.substr(0, good.size() / 2), std::string("no database\n"), std::string()}) {
    std::ofstream(path, std::ios::binary) << bad;
    const Checkpoint checkpoint(path, "command");
    EXPECT_EQ(checkpoint.pieces(), 0U);
    EXPECT_EQ(checkpoint.trouble(), "");
  }
}

TEST(Checkpoint, IsKeptByAProcessThatIsKilled) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "work.partial";
  int before = 0;
  for (int round = 0; round < 5; ++round) {
    int told[2];
    ASSERT_EQ(pipe(told), 0);
    const pid_t child = fork();
    if (child == 0) {
      Checkpoint checkpoint(path, "command");
      for (int k = before; true; ++k) {
        checkpoint.keep("piece " + std::to_string(k), bytes_of(k));
        if (write(told[1], &k, sizeof k) != sizeof k) _exit(1);
      }
    }
    close(told[1]);
    int last = -1;
    for (int k = 0; k < 20; ++k) ASSERT_EQ(read(told[0], &last, sizeof last), static_cast<ssize_t>(sizeof last));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (read(told[0], &last, sizeof last) == static_cast<ssize_t>(sizeof last)) continue;
    close(told[0]);
    const Checkpoint checkpoint(path, "command");
    ASSERT_EQ(checkpoint.found(), Checkpoint::Found::pieces);
    for (int k = 0; k <= last; ++k) EXPECT_EQ(checkpoint.find("piece " + std::to_string(k)), bytes_of(k)) << k;
    before = last + 1;
  }
}

TEST(Checkpoint, IsOneProcessesAtATime) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "work.partial";
  Checkpoint first(path, "command");
  first.keep("piece", "bytes");
  const pid_t child = fork();
  if (child == 0) {
    Checkpoint second(path, "command");
    const bool busy = second.found() == Checkpoint::Found::in_use && !second.trouble().empty();
    second.keep("other", "bytes");
    second.remove();
    _exit(busy && second.pieces() == 0 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(first.trouble(), "");
  first.keep("more", "bytes");
  EXPECT_EQ(first.pieces(), 2U);
  EXPECT_TRUE(fs::exists(path));
}

TEST(Checkpoint, WithoutAPlaceSaysSoAndLetsTheWorkGoOn) {
  const TemporaryFolder folder;
  folder.write("taken", "a file\n");
  Checkpoint checkpoint(folder.path() / "taken/work.partial", "command");
  checkpoint.keep("piece", "bytes");
  EXPECT_NE(checkpoint.trouble(), "");
  checkpoint.keep("other", "bytes");
  checkpoint.remove();
}

}  // namespace
}  // namespace hysteron

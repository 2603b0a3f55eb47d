// Work that is killed or interrupted at any instant: rerun, the command resumes and ends with the same bytes, and
// nothing looks finished before.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ended_by;
using testing::finish;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Words = std::vector<std::string>;

class Resume : public Program {
 protected:
  static Words diagnosis(const std::string& out, const Words& more = {}) {
    Words words{"diagnose",     "data",  "--model",   "viscous",
                "--by-current", "c0:1",  "--effects", "coulomb-friction,offset-force,quadratic-damping",
                "--quiet",      "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // Contents by name, but for what varies between identical runs.
  [[nodiscard]] std::map<std::string, std::string> files(const std::string& out) const {
    std::map<std::string, std::string> result;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / out)) {
      const std::string name = entry.path().lexically_relative(folder_ / out).string();
      if (entry.is_regular_file() && entry.path().filename() != "environment.json") result[name] = read(entry.path());
    }
    return result;
  }
  // Until a diagnosis has kept some pieces: the log of its checkpoint begins with tables, in four pages.
  void wait_for_pieces(const std::string& out) const {
    const fs::path log = folder_ / out / "diagnosis.partial-wal";
    constexpr std::uintmax_t tables = 24000;
    std::error_code none;
    for (int k = 0; k < 60000; ++k) {
      const std::uintmax_t size = fs::file_size(log, none);
      if (!none && size > tables) return;
      usleep(1000);
    }
    ADD_FAILURE() << log << " does not grow";
  }
  // Sends the signal so many ms after the program listens; whether it met a running program.
  bool end_after(const Words& words, int signal, int milliseconds) const {
    // With the processes that it starts itself.
    const pid_t child = testing::start(words, folder_, [] { setpgid(0, 0); });
    testing::wait_until_caught(child, SIGINT);
    usleep(static_cast<useconds_t>(1000 * milliseconds));
    kill(-child, signal);
    return testing::wait_for(child) == (signal == SIGKILL ? ended_by(SIGKILL) : 130);
  }
  void killed_again_and_again(const Words& words, const std::string& out, int kills, int longest, unsigned seed,
                              const std::function<void()>& check) const {
    std::mt19937 draw(seed);
    for (int k = 0; k < kills; ++k) {
      end_after(words, SIGKILL, static_cast<int>(draw() % static_cast<unsigned>(longest)));
      if (fs::exists(folder_ / out)) check();
    }
  }
};

TEST_F(Resume, AKilledDiagnosisEndsWithTheSameBytes) {
  ASSERT_EQ(run(diagnosis("whole")).status, 0);
  const auto whole = files("whole");
  ASSERT_EQ(whole.size(), 3U);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  killed_again_and_again(diagnosis("killed"), "killed", 4, 400, seed, [&] {
    // What is there under the name of a result is that result, whole.
    for (const auto& [name, text] : whole) {
      if (fs::exists(folder_ / "killed" / name)) {
        EXPECT_EQ(read(folder_ / "killed" / name), text) << name;
      }
    }
    if (fs::exists(folder_ / "killed/diagnosis.json")) {
      EXPECT_TRUE(fs::exists(folder_ / "killed/model.json") && fs::exists(folder_ / "killed/report.html"));
    }
  });
  ASSERT_EQ(run(diagnosis("killed")).status, 0);
  // A temporary file of a killed process may stay; nothing of the checkpoint does.
  auto killed = files("killed");
  std::erase_if(killed, [](const auto& file) { return file.first.find(".tmp-") != std::string::npos; });
  EXPECT_EQ(killed, whole);
}

TEST_F(Resume, AnInterruptedDiagnosisSaysWhatIsKnownAndGoesOn) {
  ASSERT_EQ(run(diagnosis("whole")).status, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string out = "out" + std::to_string(signal);
    const fs::path partial = folder_ / out / "diagnosis.partial";
    const pid_t child = testing::start(diagnosis(out, {"--threads", "1"}), folder_);
    wait_for_pieces(out);
    kill(child, signal);
    const Outcome outcome = finish(child, folder_);
    ASSERT_EQ(outcome.status, 130) << outcome.err;
    if (fs::exists(folder_ / out / "diagnosis.json")) continue;  // done before the signal came
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("interrupted while ")) << outcome.err;
    EXPECT_NE(outcome.err.find("rerun the command to resume"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_TRUE(fs::exists(partial));
    EXPECT_FALSE(fs::exists(folder_ / out / "model.json"));
    EXPECT_FALSE(fs::exists(folder_ / out / "report.html"));
    const json record = json::parse(read(folder_ / out / "interrupted.json"));
    EXPECT_EQ(record.at("schema"), "hysteron.interrupted/1");
    EXPECT_EQ(record.at("finished"), false);
    EXPECT_GT(record.at("pieces_kept"), 0);
    // On with another number of threads: what is kept does not depend on it.
    const Outcome again = run(diagnosis(out, {"--threads", "2"}));
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(files(out), files("whole"));
  }
}

TEST_F(Resume, AChangedCommandStartsAfresh) {
  const std::vector<std::pair<std::string, std::function<Words()>>> changes = {
      {"seed",
       [] {
         return diagnosis("out", {"--seed", "2"});
       }},
      {"tolerance",
       [] {
         return diagnosis("out", {"--tolerance", "1e-5"});
       }},
      {"effects",
       [] {
         return diagnosis("out", {"--most-effects", "1"});
       }},
      {"laws",
       [] {
         return diagnosis("out", {"--laws", "none"});
       }},
      {"recordings",
       [this] {
         write(folder_ / "data/r1.csv", testing::csv(1.0, 0.2, 80, 1.01));
         return diagnosis("out");
       }},
  };
  for (const auto& [what, changed] : changes) {
    const pid_t child = testing::start(diagnosis("out"), folder_);
    wait_for_pieces("out");
    kill(child, SIGKILL);
    testing::wait_for(child);
    const pid_t other = testing::start(changed(), folder_);
    // Told before the work, which need not be waited for.
    const std::string afresh = "diagnosis.partial is of other recordings, options or another program: starting afresh";
    bool told = false;
    for (int k = 0; k < 60000 && !told; ++k) {
      told = read(folder_ / "stderr.txt").find(afresh) != std::string::npos;
      usleep(1000);
    }
    EXPECT_TRUE(told) << what << ": " << read(folder_ / "stderr.txt");
    kill(other, SIGKILL);
    testing::wait_for(other);
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(Resume, AKilledFitLeavesNothingHalfWritten) {
  const auto words = [](const std::string& out) {
    return Words{"fit", "data", "--model", "bouc-wen", "--budget", "2000", "--quiet", "--out", out};
  };
  ASSERT_EQ(run(words("whole")).status, 0);
  const auto whole = files("whole");
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  killed_again_and_again(words("killed"), "killed", 4, 150, seed, [&] {
    for (const auto& [name, text] : whole) {
      if (fs::exists(folder_ / "killed" / name)) {
        EXPECT_EQ(read(folder_ / "killed" / name), text) << name;
      }
    }
  });
  ASSERT_EQ(run(words("killed")).status, 0);
  auto killed = files("killed");
  std::erase_if(killed, [](const auto& file) { return file.first.find(".tmp-") != std::string::npos; });
  EXPECT_EQ(killed, whole);
}

TEST_F(Resume, AKilledChallengeEndsWithTheSameScore) {
  const auto words = [](const std::string& out) {
    return Words{"challenge", "--in",    "data",    "--model", "viscous", "--by-current", "c0:1",
                 "--effect",  "inertia", "--sizes", "1",       "--quiet", "--out",        out};
  };
  ASSERT_EQ(run(words("whole")).status, 0);
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  killed_again_and_again(words("killed"), "killed", 2, 1500, seed, [] {});
  const Outcome outcome = run(words("killed"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* file : {"hidden.json", "hidden.md"}) {
    EXPECT_EQ(read(folder_ / "killed" / file), read(folder_ / "whole" / file)) << file;
  }
  EXPECT_NE(read(folder_ / "whole/hidden.json"), "");
}

}  // namespace
}  // namespace hysteron

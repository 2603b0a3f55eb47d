// The program in surroundings that are not as they should be. Every test runs HYSTERON_PROGRAM in a temporary folder of
// its own.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "app/program_fixture.hpp"
#include "app/progress_line.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Use = Program;

TEST_F(Use, ASlipInTheNumberOfThreadsEndsNothing) {
  for (const char* threads : {"99999", "1000000000", "2147483648", "4294967295", "4294967296", "99999999999999999999",
                              "-1", "0", "many", "2,2"}) {
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

TEST_F(Use, FewSamplesIdentifyNothing) {
  write(folder_ / "few.csv", testing::csv(1.0, 0.2, 15));
  const Outcome outcome = run({"fit", "few.csv", "--model", "viscous", "--out", "out"});
  EXPECT_EQ(outcome.status, 2);
  // That these are few a period stands above.
  EXPECT_TRUE(
      outcome.err.ends_with("a period\nerror: few.csv: 15 samples, expected at least 16 to identify a model "
                            "from\n"))
      << outcome.err;
  // Of 18 a diagnosis fits a part, in which no noise can be told: nothing is called complete.
  write(folder_ / "more.csv", testing::csv(1.0, 0.2, 18));
  const Outcome diagnosed =
      run({"diagnose", "more.csv", "--model", "viscous", "--effects", "inertia", "--laws", "none", "--out", "out"});
  EXPECT_EQ(diagnosed.status, 2);
  EXPECT_NE(diagnosed.err.find("fewer do not tell the noise of the force"), std::string::npos) << diagnosed.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/diagnosis.json"));
}

TEST_F(Use, ADeadChannelIdentifiesNothing) {
  const auto text = [](const auto& displacement, const auto& force) {
    std::string rows = "time [s],displacement [mm],force [N]\n";
    for (int n = 0; n < 80; ++n) rows += fmt::format("{},{},{}\n", 0.01 * n, displacement(n), force(n));
    return rows;
  };
  const auto moves = [](int n) { return std::sin(0.1 * n); };
  const auto rests = [](int) { return 3.0; };
  write(folder_ / "dead.csv", text(moves, rests));
  write(folder_ / "still.csv", text(rests, moves));
  write(folder_ / "study.toml",
        "schema = \"hysteron.study/1\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 20\nseeds = 1\n"
        "[[data]]\nrecordings = \"dead.csv\"\n");
  const std::string force = "dead.csv: the force is the same throughout, expected one that changes with the motion\n";
  const std::string motion = "still.csv: the displacement is the same throughout, expected a motion\n";
  for (const char* command : {"fit", "diagnose"}) {
    for (const auto& [file, says] : {std::pair("dead.csv", force), std::pair("still.csv", motion)}) {
      const Outcome outcome = run({command, file, "--model", "viscous", "--out", "out"});
      EXPECT_EQ(outcome.status, 2);
      // What the readers say of it stands above.
      EXPECT_TRUE(outcome.err.ends_with("\nerror: " + says)) << outcome.err;
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 2) << outcome.err;
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
  }
  EXPECT_EQ(run({"bench", "study.toml", "--quiet", "--out", "out"}).status, 2);
  // A model is scored on it all the same, and what is no number is not written as one.
  fit();
  const Outcome scored = run({"score", "fitted/model.json", "dead.csv"});
  EXPECT_EQ(scored.status, 0) << scored.err;
  EXPECT_EQ(scored.out.find("nan"), std::string::npos) << scored.out;
}

TEST_F(Use, LongRecordingsAreAveragedWithAWordAboutIt) {
  write(folder_ / "long.csv", testing::csv(1.0, 0.2, 9001));
  const std::string said = "long.csv: 9,001 samples read, every 5 averaged to one: 1,800 kept, 1.11 ms apart; ";
  const Outcome outcome = run(
      {"fit", "long.csv", "--model", "viscous", "--budget", "50", "--keep-samples", "2000", "--quiet", "--out", "out"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "warning: " + said + "--keep-samples 9001 keeps all\n");
  // Files are for callers that have no command line, too.
  EXPECT_NE(read(folder_ / "out/fit.json").find(said + "keep samples 9001 keeps all"), std::string::npos);
  // What simulates takes every sample.
  ASSERT_EQ(run({"simulate", "out/model.json", "long.csv", "--out", "force.csv"}).status, 0);
  const std::string rows = read(folder_ / "force.csv");
  EXPECT_EQ(std::ranges::count(rows, '\n'), 9002);
}

// A mass on a spring and a dashpot let go: x = x0 exp(-d t) (cos w t + d / w sin w t), in closed form.
TEST_F(Use, AFreeDecayTellsTheDamperBesideAMass) {
  const double mass = 2.0;
  const double damping = 8.0;
  const double stiffness = 800.0;
  const double d = damping / (2.0 * mass);
  const double w = std::sqrt(stiffness / mass - d * d);
  std::string text = "time [s],displacement [mm]\n";
  for (int n = 0; n < 1000; ++n) {
    const double t = n / 500.0;
    text += fmt::format("{},{}\n", t, 10.0 * std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t)));
  }
  fs::create_directories(folder_ / "decay");
  write(folder_ / "decay" / "d.csv", text);
  const auto fitted = [&](const std::string& out, const std::string& threads) {
    const Outcome outcome = run({"fit", "decay", "--response", "--mass", "2", "--model", "viscous", "--budget", "500",
                                 "--threads", threads, "--quiet", "--out", out});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("motion of the mass"), std::string::npos) << outcome.out;
    return read(folder_ / out / "fit.json");
  };
  const std::string one = fitted("one", "1");
  const nlohmann::json fit = nlohmann::json::parse(one);
  EXPECT_LT(fit.at("response").at("nrmse"), 1e-6);
  for (const nlohmann::json& parameter : fit.at("parameters")) {
    const std::string name = parameter.at("name");
    const double truth = name == "c0" ? damping : stiffness;
    if (name != "f0") {
      EXPECT_NEAR(parameter.at("value"), truth, 1e-4 * truth) << name;
    }
  }
  fitted("two", "2");
  EXPECT_EQ(read(folder_ / "one" / "model.json").substr(0, 200), read(folder_ / "two" / "model.json").substr(0, 200));
}

TEST_F(Use, AResponseWantsTheMass) {
  const Outcome outcome = run({"fit", "data", "--response", "--model", "viscous", "--out", "out"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--response: expected --mass beside it"), std::string::npos) << outcome.err;
  for (const char* mass : {"0", "-3", "nan", "inf", "20kg"}) {
    const Outcome wrong = run({"fit", "data", "--response", "--mass", mass, "--model", "viscous", "--out", "out"});
    EXPECT_EQ(wrong.status, 2) << mass;
    EXPECT_NE(wrong.err.find("is not a number from 1e-09 to 1e+12"), std::string::npos) << wrong.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Use, APublishedTableTakesSettingsOfItsSolvers) {
  const auto table = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"reproduce", "table-viii", "--seeds", "1", "--budget", "30", "--quiet", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Outcome plain = table({});
  // The paper's swarm is the whole one; the torus is another.
  const Outcome set = table({"--set", "topology=1"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  ASSERT_EQ(set.status, 0) << set.err;
  EXPECT_EQ(plain.out.find("set on the command line"), std::string::npos);
  EXPECT_NE(set.out.find("topology = 1"), std::string::npos);
  EXPECT_NE(plain.out.substr(0, plain.out.find("not_remade")), set.out.substr(0, set.out.find("not_remade")));
  for (const char* wrong : {"topologi=0", "topology=9", "topology", "topology=0,topology=1"}) {
    const Outcome outcome = table({"--set", wrong});
    EXPECT_EQ(outcome.status, 2) << wrong;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }
}

// What a command shows on a terminal of 40 columns, as lines that replace one another.
class Terminal : public Program {
 protected:
  void show(const std::vector<std::string>& words, std::vector<std::string>& lines) const {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(master, 0);
    ASSERT_EQ(grantpt(master), 0);
    ASSERT_EQ(unlockpt(master), 0);
    const std::string slave = ptsname(master);
    const int held = open(slave.c_str(), O_RDWR | O_NOCTTY);  // so that the end of the program is no error of reading
    constexpr winsize size{24, 40, 0, 0};
    ASSERT_EQ(ioctl(held, TIOCSWINSZ, &size), 0);
    std::string shown;
    std::thread reader([&] {
      char buffer[4096];
      for (ssize_t count = 0; !shown.ends_with('#') && (count = ::read(master, buffer, sizeof buffer)) > 0;) {
        shown.append(buffer, static_cast<std::size_t>(count));
      }
    });
    const Outcome outcome = run(words, [&] { dup2(open(slave.c_str(), O_WRONLY | O_NOCTTY), STDERR_FILENO); });
    EXPECT_EQ(::write(held, "#", 1), 1);
    reader.join();
    close(held);
    close(master);
    ASSERT_EQ(outcome.status, 0);
    std::stringstream parts(shown.substr(0, shown.rfind("\r\033[K")));
    for (std::string part; std::getline(parts, part, '\r');) {
      if (part.starts_with("\033[K")) lines.push_back(part.substr(3));
    }
  }
};

TEST_F(Terminal, ProgressIsOneLineNoWiderThanIt) {
  std::vector<std::string> lines;
  show({"fit", "data", "--model", "bouc-wen", "--solver", "pso", "--budget", "5000", "--out", "out"}, lines);
  for (const std::string& line : lines) {
    EXPECT_LE(line.size(), 39U) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  EXPECT_GT(lines.size(), 1U);
}

TEST_F(Terminal, ProgressOfADiagnosisGrowsInItsStages) {
  std::vector<std::string> lines;
  show({"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects",
        "coulomb-friction,offset-force,quadratic-damping,inertia", "--out", "out"},
       lines);
  int before = 0;
  std::set<int> shares;
  for (const std::string& line : lines) {
    if (line.find('%') == std::string::npos) continue;
    const int share = std::stoi(line);
    EXPECT_GE(share, before) << line;
    before = share;
    shares.insert(share);
  }
  EXPECT_GE(before, 69) << "what follows the diagnosis is shown too";
  EXPECT_GE(shares.size(), 6U);
}

TEST(ProgressText, SaysWhatHowFarHowLong) {
  using app::progress_text;
  EXPECT_EQ(progress_text("pso", 0.25, "250 of 1000", 10.0, 30.0, 80), "25 %  10 s, about 30 s left  pso  250 of 1000");
  EXPECT_EQ(progress_text("pso", 0.25, "", 400.0, 1200.0, 80), "25 %  7 min, about 20 min left  pso");
  EXPECT_EQ(progress_text("pso", 0.0, "", 5.0, {}, 80), "0 %  5 s  pso") << "nothing is known of what is left";
  EXPECT_EQ(progress_text("pso", 0.99, "", 50.0, 0.5, 80), "99 %  50 s, nearly done  pso");
  EXPECT_EQ(progress_text("\xc3\xa9\xc3\xa9\xc3\xa9", 0.5, "", 1.0, {}, 13), "50 %  1 s  \xc3\xa9\xc3\xa9")
      << "characters, not bytes";
  EXPECT_EQ(progress_text("a\x1B[2Jb", 0.5, "\n", 1.0, {}, 80), "50 %  1 s  a\\x1B[2Jb   ");
}

// Work that goes on evenly is foretold; what is a guess, or known to be wrong, is not said.
TEST(ProgressText, SaysWhatIsLeftOnceThatIsKnown) {
  app::TimeLeft even;
  EXPECT_FALSE(even.after(10.0));
  for (int k = 0; k <= 40; ++k) {
    even.advance(0.01 * k, 0.4 * k);
    EXPECT_EQ(even.after(0.4 * k).has_value(), k >= 25) << k;
  }
  EXPECT_NEAR(*even.after(16.0), 24.0, 1e-9);
  EXPECT_NEAR(*even.after(18.0), 22.0, 1e-9) << "it does not grow by waiting";
  EXPECT_FALSE(even.after(24.0)) << "the next share is overdue";
  even.advance(0.1, 0.0);
  EXPECT_FALSE(even.after(20.0)) << "other work";

  app::TimeLeft fitful;  // shares that promise 20 s, then 100 s
  fitful.advance(0.2, 4.0);
  fitful.advance(0.3, 6.0);
  EXPECT_TRUE(fitful.after(6.0));
  fitful.advance(0.31, 31.0);
  EXPECT_FALSE(fitful.after(31.0));
  fitful.advance(0.4, 40.0);
  EXPECT_FALSE(fitful.after(40.0));
  fitful.advance(0.6, 60.0);
  EXPECT_NEAR(fitful.after(60.0).value_or(0.0), 40.0, 1e-9) << "it has settled";
}

// ---- Motions that are not those of a damper ----

namespace motions {

constexpr int samples = 2000;

// A stiff hysteresis: a fast motion has time constants of nanoseconds in it.
std::string model(double yield_displacement) {
  return fmt::format(
      R"({{"schema":"hysteron.model/1","model":"bouc-wen","effects":[],"parameters":[
      {{"name":"alpha","value":400,"unit":"N"}},{{"name":"c0","value":0,"unit":"N s/m"}},
      {{"name":"k0","value":0,"unit":"N/m"}},{{"name":"f0","value":0,"unit":"N"}},
      {{"name":"x_y","value":{},"unit":"m"}},{{"name":"share","value":0.5,"unit":"1"}},
      {{"name":"n","value":1.5,"unit":"1"}}]}})",
      yield_displacement);
}

std::string push() {
  std::string text = "time [s],force [N]\n";
  for (int n = 0; n < samples; ++n) text += fmt::format("{},{}\n", 0.01 * n, 100.0 * std::sin(n));
  return text;
}

}  // namespace motions

TEST_F(Use, AMotionThatDoesNotAdvanceEnds) {
  write(folder_ / "stiff.json", motions::model(1e-7));
  write(folder_ / "push.csv", motions::push());
  const Outcome outcome =
      run({"respond", "stiff.json", "push.csv", "--mass", "250", "--stiffness", "2e4", "--x0", "9e4", "--out", "r.csv"},
          [] { alarm(60); });
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("the equations are too stiff for a motion of "), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "r.csv"));
  const Outcome far =
      run({"respond", "stiff.json", "push.csv", "--mass", "250", "--x0", "1e8", "--out", "r.csv"}, [] { alarm(60); });
  EXPECT_EQ(far.status, 2) << far.err;
  EXPECT_NE(far.err.find("not a number from -100000 to 100000"), std::string::npos) << far.err;
}

TEST_F(Use, AResponseIsInterrupted) {
  write(folder_ / "stiff.json", motions::model(1e-4));
  write(folder_ / "push.csv", motions::push());
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = testing::start({"respond", "stiff.json", "push.csv", "--mass", "250", "--stiffness", "2e4",
                                        "--x0", "1e3", "--periods", "10000", "--out", "r.csv"},
                                       folder_, [] { alarm(60); });
    testing::wait_until_caught(child, signal);
    usleep(300000);
    ASSERT_EQ(kill(child, signal), 0);
    const Outcome outcome = testing::finish(child, folder_);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("error: interrupted at ")) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "r.csv"));
  }
}

}  // namespace
}  // namespace hysteron

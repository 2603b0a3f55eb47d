// No result without its being one: what diverges, what cannot be written, names that are no text, magnitudes that
// cannot be. Every test runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::csv;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Results = Program;

// The fitted model with one parameter so large that its force is beyond every number.
void spoil(const fs::path& from, const fs::path& to) {
  json model = json::parse(read(from));
  for (json& parameter : model["parameters"]) {
    if (parameter["parameter"] == "alpha") parameter["value"] = 1e308;
  }
  write(to, model.dump());
}

TEST_F(Results, DivergenceIsAFailureAndWritesNothing) {
  fit();
  spoil(folder_ / "fitted/model.json", folder_ / "wild.json");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"simulate", "wild.json", "data/r1.csv", "--out", "p.csv"},
        {"score", "wild.json", "data"},
        {"score", "wild.json", "data", "--json"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 1) << words[0];
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("error: r1.csv: the simulation does not stay finite from ")) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "p.csv"));
  }
}

// A fit tells of its residual what a comparison on the same recordings does, and of its parameters as many
// correlations as it has values.
TEST_F(Results, AFitTellsHowGoodItIs) {
  fit();
  ASSERT_EQ(run({"compare", "fitted/model.json", "data", "--out", "compared"}).status, 0);
  const json fitted = json::parse(read(folder_ / "fitted/fit.json"));
  const json compared = json::parse(read(folder_ / "compared/compare.json"))["models"][0];
  for (const char* criterion : {"aic", "bic"}) {
    const double value = compared[criterion];
    EXPECT_NEAR(fitted["residual"][criterion].get<double>(), value, 1e-6 * std::abs(value)) << criterion;
  }
  EXPECT_NEAR(fitted["residual"]["autocorrelation"][0].get<double>(),
              compared["residual"]["autocorrelation"][0].get<double>(), 1e-6);
  const json& correlation = fitted["correlation"];
  ASSERT_EQ(correlation["values"].size(), correlation["names"].size());
  for (std::size_t k = 0; k < correlation["names"].size(); ++k) {
    EXPECT_EQ(correlation["values"][k][k], 1.0);
  }
  const json& sensitivity = fitted["sensitivity"];
  ASSERT_FALSE(sensitivity.empty());
  for (std::size_t k = 1; k < sensitivity.size(); ++k) {
    EXPECT_LE(sensitivity[k]["value"], sensitivity[k - 1]["value"]);
  }
  // The page holds them, for its pictures.
  EXPECT_NE(read(folder_ / "fitted/report.html").find("\"sensitivity\":[{"), std::string::npos);
}

// What was read stays as it was, whatever name or link leads to it; a file made before is replaced as ever.
TEST_F(Results, NothingThatIsReadIsReplaced) {
  fit();
  const std::string model = read(folder_ / "fitted/model.json");
  const std::string recording = read(folder_ / "data/r1.csv");
  fs::create_symlink(folder_ / "data/r1.csv", folder_ / "link.csv");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"score", "fitted/model.json", "data/r1.csv", "--out", "data/../data/r1.csv"},
        {"score", "fitted/model.json", "data", "--out", "data/r1.csv"},
        {"score", "fitted/model.json", "data", "--out", "fitted/model.json"},
        {"simulate", "fitted/model.json", "data/r1.csv", "--out", "data/r1.csv"},
        {"simulate", "fitted/model.json", "data/r1.csv", "--out", "link.csv"},
        {"simulate", "fitted/model.json", "data/r1.csv", "--out", "fitted/model.json"},
        {"respond", "fitted/model.json", "data/r1.csv", "--mass", "10", "--excitation", "base", "--out", "data/r1.csv"},
        {"export", "fitted/model.json", "--to", "python", "--out", "fitted/model.json"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_NE(outcome.err.find("would be replaced, expected another file"), std::string::npos) << outcome.err;
    EXPECT_EQ(read(folder_ / "fitted/model.json"), model);
    EXPECT_EQ(read(folder_ / "data/r1.csv"), recording);
  }
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(run({"score", "fitted/model.json", "data", "--out", "scores.csv"}).status, 0);
  }
  EXPECT_EQ(run({"simulate", "fitted/model.json", "data/r1.csv", "--out", "p.xlsx"}).err,
            "error: --out p.xlsx: tables are not written as .xlsx, expected .csv or .mat\n");
}

// A model exported anew has another header where its steps or its parts differ.
TEST_F(Results, AnExportIsReplacedByAnother) {
  fit();
  for (const char* target : {"c", "simulink", "modelica"}) {
    const auto exported = [&](std::vector<std::string> more) {
      std::vector<std::string> words = {"export", "fitted/model.json", "--to", target, "--out", target};
      words.insert(words.end(), more.begin(), more.end());
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.status, 0) << target << outcome.err;
      for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder_ / target)) {
        if (file.path().filename() == "bouc_wen.h") return read(file.path());
      }
      return std::string();
    };
    const std::string first = exported({});
    EXPECT_FALSE(first.empty()) << target;
    EXPECT_NE(exported({"--substeps", "4"}), first) << target;
  }
}

TEST_F(Results, NothingOfAnotherHandIsReplaced) {
  fit();
  const auto refused = [&](const std::vector<std::string>& words, const fs::path& file, const std::string& why) {
    fs::create_directories((folder_ / file).parent_path());
    write(folder_ / file, "mine\n");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_EQ(read(folder_ / file), "mine\n");
  };
  const std::vector<std::string> generate = {"generate", "rd8040-twin", "--only", "2.0Hz_0.5A", "--out", "twin"};
  refused(generate, "twin/2.0Hz_0.5A.csv", "2.0Hz_0.5A.csv is there and differs from what would be written");
  fs::remove(folder_ / "twin/2.0Hz_0.5A.csv");
  refused(generate, "twin/campaign.toml", "campaign.toml is there, which the dataset does not have");
  fs::remove(folder_ / "twin/campaign.toml");
  refused(generate, "twin/mine.csv", "mine.csv is there, which is no recording of the dataset");
  fs::remove(folder_ / "twin/mine.csv");
  write(folder_ / "twin/.mine.csv", "no recording");
  write(folder_ / "twin/log.xlsx", "no recording beside others");
  EXPECT_EQ(run(generate).status, 0);
  EXPECT_EQ(run({"generate", "rd8040-twin", "--only", "2.0Hz_0.2A", "--out", "twin"}).status, 0) << "another of them";
  EXPECT_EQ(run(generate).status, 0) << "what it wrote itself";
  const std::vector<std::string> exported = {"export", "fitted/model.json", "--to", "c", "--out", "c"};
  refused(exported, "c/bouc_wen.c", "bouc_wen.c is there and was not written by hysteron");
  fs::remove(folder_ / "c/bouc_wen.c");
  EXPECT_EQ(run(exported).status, 0);
  EXPECT_EQ(run(exported).status, 0);
  // A model that was fitted anew is exported to the same places.
  EXPECT_EQ(
      run({"fit", "data", "--model", "bouc-wen", "--fix", "n=2", "--budget", "300", "--quiet", "--out", "anew"}).status,
      0);
  for (const std::string to : {"c", "python", "modelica", "simulink", "fmu"}) {
    EXPECT_EQ(run({"export", "fitted/model.json", "--to", to, "--out", "again_" + to}).status, 0) << to;
    const Outcome outcome = run({"export", "anew/model.json", "--to", to, "--out", "again_" + to});
    EXPECT_EQ(outcome.status, 0) << to << ": " << outcome.err;
  }
  refused({"minimise", "--objective", "python3 mine.py", "--box", "x=0:1", "--budget", "10", "--out", "mine.py"},
          "mine.py", "--out mine.py: is read and would be replaced");
}

TEST_F(Results, RecordingsWithoutTheDriveThatParametersFollowAreRefused) {
  std::string without = csv(1.5, 0.5);
  for (auto at = without.find(",0.5\n"); at != std::string::npos; at = without.find(",0.5\n")) {
    without.erase(at, 4);
  }
  without.replace(without.find(",current [A]"), 12, "");
  write(folder_ / "data/r3.csv", without);
  const std::vector<std::string> fit = {"fit",      "data", "--model", "bouc-wen", "--by-current", "c0:1",
                                        "--budget", "400",  "--quiet", "--out",    "fitted"};
  const std::vector<std::string> diagnose = {"diagnose", "data", "--model", "bouc-wen", "--out", "found"};
  const std::string none =
      "error: r3.csv: no current or voltage, expected a current as in r1.csv: a column, or a line current = NUMBER of "
      "the recording in campaign.toml\n";
  EXPECT_EQ(run(fit).err, none);
  EXPECT_EQ(run(diagnose).err, none);
  EXPECT_FALSE(fs::exists(folder_ / "fitted"));
  std::string volts = csv(1.5, 0.5);
  volts.replace(volts.find("current [A]"), 11, "voltage [V]");
  write(folder_ / "data/r3.csv", volts);
  const std::string other = "error: r3.csv: records a voltage, expected a current as in r1.csv\n";
  EXPECT_EQ(run(fit).err, other);
  EXPECT_EQ(run(diagnose).err, other);
  // Where nothing follows the drive it need not be there; where campaign.toml gives it, it is.
  write(folder_ / "data/r3.csv", without);
  EXPECT_EQ(run({"fit", "data", "--model", "bouc-wen", "--budget", "400", "--quiet", "--out", "passive"}).status, 0);
  write(folder_ / "data/campaign.toml",
        "schema = \"hysteron.campaign/1\"\n"
        "[[recording]]\nfile = \"r1.csv\"\n[[recording]]\nfile = \"r2.csv\"\n"
        "[[recording]]\nfile = \"r3.csv\"\ncurrent = 0.5\n");
  EXPECT_EQ(run(fit).status, 0) << run(fit).err;
}

TEST_F(Results, FullStandardOutputIsAFailure) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  fit();
  const auto full = [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); };
  const auto closed = [] { close(STDOUT_FILENO); };
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"},
        {"fit", "--help"},
        {"--version"},
        {"list", "models"},
        {"list", "solvers", "--json"},
        {"describe", "bouc-wen"},
        {"score", "fitted/model.json", "data"},
        {"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "again"}}) {
    for (const auto& stdout_is : {std::function<void()>(full), std::function<void()>(closed)}) {
      const Outcome outcome = run(words, stdout_is);
      EXPECT_EQ(outcome.status, 1) << words[0];
      EXPECT_NE(outcome.err.find("error: standard output cannot be written"), std::string::npos) << words[0];
    }
  }
  EXPECT_TRUE(fs::exists(folder_ / "again/model.json"));
}

TEST_F(Results, NamesThatAreNoTextLoseNoFit) {
  fs::remove_all(folder_ / "data");
  write(folder_ / "data/r\xE9.csv", csv(1.0, 0.2));
  write(folder_ / "data/r\xE8.csv", csv(1.0, 0.8));
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out\xE9"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json model = json::parse(read(folder_ / "out\xE9/model.json"));
  EXPECT_EQ(model.at("fitted_on")[0].at("file"), "r\\xE8.csv");
  EXPECT_EQ(model.at("fitted_on")[1].at("file"), "r\\xE9.csv");
  EXPECT_NE(outcome.out.find("r\\xE8.csv"), std::string::npos);
  EXPECT_EQ(run({"score", "out\xE9/model.json", "data", "--json"}).status, 0);
}

TEST_F(Results, NamesDoNotCommandATerminal) {
  write(folder_ / "data/\x1B[2J.csv", csv(1.5, 0.4));
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\\x1B[2J.csv"), std::string::npos);
  const Outcome wrong = run({"fit", "\x1B[2J.csv", "--model", "viscous", "--out", "other"});
  EXPECT_EQ(wrong.status, 2);
  for (const std::string& text : {outcome.out, outcome.err, wrong.out, wrong.err}) {
    EXPECT_EQ(text.find('\x1B'), std::string::npos) << text;
  }
}

TEST_F(Results, MillimetresReadAsMetresAreRemarked) {
  for (const char* name : {"data/r1.csv", "data/r2.csv"}) {
    std::string text = csv(1.0, name[6] == '1' ? 0.2 : 0.8);
    text = "time,displacement,force\n" + [&] {
      std::string rows;
      std::istringstream lines(text);
      std::string line;
      std::getline(lines, line);
      while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string t, x, v, f;
        std::getline(cells, t, ',');
        std::getline(cells, x, ',');
        std::getline(cells, v, ',');
        std::getline(cells, f, ',');
        rows += t + "," + std::to_string(1e3 * std::stod(x)) + "," + f + "\n";
      }
      return rows;
    }();
    write(folder_ / name, text);
  }
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(
      outcome.err.starts_with("warning: data/r1.csv: displacement has no unit and was taken in m: a stroke of 40 m"))
      << outcome.err;
  EXPECT_NE(outcome.err.find("(1 more recording alike)"), std::string::npos) << outcome.err;
  EXPECT_TRUE(json::parse(read(folder_ / "out/fit.json")).at("warnings")[0].get<std::string>().starts_with("r1.csv: "));
}

TEST_F(Results, NoTemporaryFileIsLeftWhereFilesMayNotGrow) {
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"}, [] {
    const rlimit few{512, 512};
    setrlimit(RLIMIT_FSIZE, &few);
  });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(outcome.err.starts_with("error: out/model.json: cannot be written: File too large")) << outcome.err;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "out")) ADD_FAILURE() << entry.path();
}

TEST_F(Results, HeldOutRecordingsAreCalledSo) {
  for (int k = 3; k <= 5; ++k) write(folder_ / ("data/r" + std::to_string(k) + ".csv"), csv(1.0, 0.1 * k));
  ASSERT_EQ(run({"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"}).status, 0);
  const json fitted = json::parse(read(folder_ / "out/fit.json"));
  const std::string page = read(folder_ / "out/report.html");
  const std::string mark = "<script type=\"application/json\" id=\"report-data\">";
  const auto from = page.find(mark) + mark.size();
  const json shown = json::parse(page.substr(from, page.find("</script>", from) - from));
  std::size_t checked = 0;
  for (std::size_t k = 0; k < fitted.at("recordings").size(); ++k) {
    const bool held = fitted["recordings"][k].at("held_out_in_check");
    EXPECT_EQ(shown.at("recordings")[k].at("role"), held ? "checked" : "fit");
    checked += held ? 1 : 0;
  }
  EXPECT_EQ(checked, 1U);
}

}  // namespace
}  // namespace hysteron

// Published parameter sets, solvers of other libraries and plugins, as a user calls them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Outcome;
using testing::read;

class Extensions : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "hysteron-ext-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::ofstream file(folder_ / "r.csv");
    std::ofstream bare(folder_ / "motion.csv");
    file << "time [s],displacement [m],velocity [m/s],force [N],current [A]\n";
    bare << "time [s],displacement [m],velocity [m/s]\n";
    for (int n = 0; n <= 200; ++n) {
      const double t = 0.005 * n;
      const double v = 0.2 * std::cos(4.0 * std::numbers::pi * t);
      const double x = 0.2 / (4.0 * std::numbers::pi) * std::sin(4.0 * std::numbers::pi * t);
      file << t << ',' << x << ',' << v << ',' << 700.0 * v + 2e4 * v * v * v + 30.0 << ",0.5\n";
      bare << t << ',' << x << ',' << v << '\n';
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Words with spaces in single quotes.
  Outcome run(const std::string& line) {
    std::istringstream rest(line);
    std::vector<std::string> words;
    for (std::string word; rest >> std::quoted(word, '\'');) words.push_back(word);
    return testing::run(words, folder_);
  }
  void expect_refused(const std::string& words, const std::string& part) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words;
    EXPECT_EQ(outcome.err.rfind("error: ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder_ / "p.csv")) << words;
  }

  fs::path folder_;
};

TEST_F(Extensions, PresetsAreDescribedAndSimulated) {
  const json model = json::parse(run("describe bouc-wen --json").out);
  ASSERT_EQ(model["presets"].size(), 5U);
  const json preset = json::parse(run("describe spencer-1997 --json").out);
  EXPECT_EQ(preset["kind"], "preset");
  EXPECT_EQ(preset["model"], "modified-bouc-wen");
  ASSERT_EQ(run("simulate --preset review-25-26 r.csv --out p.csv").status, 0);
  std::ifstream file(folder_ / "p.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "time [s],force [N]");
  std::getline(file, line);
  // At 0.5 A and 0.2 m/s.
  const double fc = -85.19 * 0.125 + 75.67 * 0.25 + 24.95 * 0.5 + 0.14;
  const double c0 = 1e3 * (-0.079 * 0.125 - 0.133 * 0.25 + 0.184 * 0.5 + 0.004);
  EXPECT_NEAR(std::stod(line.substr(line.find(',') + 1)), fc + c0 * 0.2, 1e-9);
}

TEST_F(Extensions, PresetsRefuseWhatTheyCannotUse) {
  expect_refused("simulate --preset no-such r.csv --out p.csv", "unknown preset");
  expect_refused("simulate --preset spencer-1997 r.csv --out p.csv", "records a current");
  expect_refused("simulate --preset rd8040-1-pso motion.csv --out p.csv", "has no current or voltage");
  expect_refused("simulate --preset review-13-14 r.csv --out p.csv", "--set beta=");
  expect_refused("simulate --preset spencer-1997 --drive 1 --set c9=1 r.csv --out p.csv", "'c9' is no quantity");
  expect_refused("simulate --preset spencer-1997 --drive 1 --set c9 r.csv --out p.csv", "QUANTITY=NUMBER");
  expect_refused("simulate --preset spencer-1997 model.json r.csv --out p.csv", "RECORDING alone");
  expect_refused("simulate r.csv --out p.csv", "MODEL and RECORDING");
  expect_refused("simulate model.json r.csv --drive 1 --out p.csv", "belong to --preset");
  EXPECT_EQ(run("simulate --preset review-13-14 r.csv --set A=10 --set beta=100 --set gamma=100 --set n=1 --set k0=0 "
                "--set x0=0 --out p.csv")
                .status,
            0);
}

TEST_F(Extensions, LibrariesAreListedByName) {
  const json solvers = json::parse(run("list solvers --json").out);
  int found = 0;
  for (const json& row : solvers) found += row["id"].get<std::string>().starts_with("nlopt:") ? 1 : 0;
  EXPECT_GT(found, 30);
  EXPECT_EQ(json::parse(run("describe nlopt:LN_BOBYQA --json").out)["family"], "nlopt:*");
  ASSERT_EQ(run("fit r.csv --model viscous --solver nlopt:LN_BOBYQA --budget 500 --quiet --out a").status, 0);
  ASSERT_EQ(run("fit r.csv --model viscous --solver nlopt:LN_BOBYQA --budget 500 --quiet --out b --threads 2").status,
            0);
  EXPECT_EQ(read(folder_ / "a/model.json"), read(folder_ / "b/model.json"));
}

TEST_F(Extensions, PluginAddsItsModelAndSolver) {
  const std::string plugin = "--plugin '" HYSTERON_PLUGIN "' ";
  EXPECT_EQ(run("describe cubic-damper").status, 2);
  EXPECT_EQ(json::parse(run(plugin + "describe cubic-damper --json").out)["parameters"].size(), 3U);
  ASSERT_EQ(run(plugin +
                "fit r.csv --model cubic-damper --solver multistart-lm,uniform-search --quiet --budget 2000 --out out")
                .status,
            0);
  const json model = json::parse(read(folder_ / "out/model.json"));
  EXPECT_LT(model["nrmse"]["fit"].get<double>(), 1e-5);
  EXPECT_NEAR(model["parameters"][1]["value"].get<double>(), 2e4, 100.0);
  EXPECT_EQ(run(plugin + "score out/model.json r.csv").status, 0);
  EXPECT_EQ(run("score out/model.json r.csv").status, 2);
}

std::vector<std::string> ids_of(const json& rows) {
  std::vector<std::string> ids;
  for (const json& row : rows) ids.push_back(row["id"]);
  return ids;
}

TEST_F(Extensions, CardsOfEffectsAreDescribedAndListed) {
  const json effect = json::parse(run("describe entrapped-gas --json").out);
  EXPECT_EQ(effect["family"]["id"], "free-travel");
  EXPECT_EQ(ids_of(effect["related"]), (std::vector<std::string>{"compliance", "clearance"}));
  EXPECT_EQ(effect["related"][0]["how"], "which entrapped-gas is where its d_a is zero");
  EXPECT_EQ(effect["related"][1]["how"], "which entrapped-gas is at the lower end of its f_a");
  for (const json& row : json::parse(run("list effects --json").out)) {
    json described = json::parse(run("describe " + row["id"].get<std::string>() + " --json").out);
    for (const auto& [key, value] : row.items()) EXPECT_EQ(described[key], value) << row["id"] << " " << key;
    EXPECT_TRUE(row["family"].is_object() && row["experiment"].is_string()) << row["id"];
  }
  // Lines end where a terminal does.
  const std::string text = std::regex_replace(run("describe coil-lag").out, std::regex("\n  "), " ");
  EXPECT_NE(text.find("Family: drive-path, "), std::string::npos) << text;
  EXPECT_NE(text.find("Related effects: magnetic-remanence, magnetic-saturation\n"), std::string::npos) << text;
  EXPECT_NE(text.find("a current or voltage that changes within a recording"), std::string::npos) << text;
  EXPECT_NE(text.find("Told apart by: current steps"), std::string::npos) << text;
  EXPECT_NE(text.find("May also come from outside the damper: a current that was commanded"), std::string::npos)
      << text;
  EXPECT_EQ(run("describe bouc-wen").out.find("Related effects"), std::string::npos);
}

// A dashpot, a cubic term, an offset and a drift. What comes closest is set against the cubic term anyway; a dashpot,
// which the base law has as it has spring and offset, only because the card names it.
TEST_F(Extensions, EffectOfAPluginIsNamedAndSetAgainstItsKin) {
  const std::string plugin = "--plugin '" HYSTERON_PLUGIN "' ";
  EXPECT_EQ(ids_of(json::parse(run(plugin + "describe cubic-damping --json").out)["related"]),
            (std::vector<std::string>{"quadratic-damping", "viscous-damping"}));
  EXPECT_EQ(ids_of(json::parse(run(plugin + "describe quadratic-damping --json").out)["related"]),
            (std::vector<std::string>{"viscous-damping", "shear-thinning", "cubic-damping"}));
  EXPECT_EQ(ids_of(json::parse(run("describe quadratic-damping --json").out)["related"]),
            (std::vector<std::string>{"viscous-damping", "shear-thinning"}));
  std::ofstream file(folder_ / "drifting.csv");
  file << "time [s],displacement [m],velocity [m/s],force [N]\n";
  for (int n = 0; n <= 400; ++n) {
    const double t = 0.005 * n;
    const double v = 0.2 * std::cos(4.0 * std::numbers::pi * t);
    const double x = 0.2 / (4.0 * std::numbers::pi) * std::sin(4.0 * std::numbers::pi * t);
    file << t << ',' << x << ',' << v << ',' << 700.0 * v + 2e4 * v * v * v + 30.0 + 40.0 * t << '\n';
  }
  file.close();
  ASSERT_EQ(run(plugin + "diagnose drifting.csv --model viscous --quiet --out out").status, 0);
  const json found = json::parse(read(folder_ / "out/diagnosis.json"))["evidence"]["candidates"];
  ASSERT_EQ(ids_of(found), (std::vector<std::string>{"cubic-damping", "force-drift"}));
  // Strangers that came close are contenders too, to first order; related ones are refitted in its place.
  std::vector<std::string> related;
  for (const json& row : found[0]["contenders"]) {
    if (row["kin"].get<bool>()) {
      EXPECT_TRUE(row["refitted"].get<bool>()) << row["id"];
      related.push_back(row["id"]);
    }
  }
  EXPECT_EQ(std::ranges::count(related, "viscous-damping"), 1);
  EXPECT_EQ(std::ranges::count(related, "offset-force"), 0);
}

TEST_F(Extensions, PluginsThatAreNoneAreRefused) {
  expect_refused("--plugin none.so list models", "no such file");
  expect_refused("--plugin r.csv list models", "cannot be loaded");
  expect_refused("--plugin '" HYSTERON_PLUGIN "' '--plugin=" HYSTERON_PLUGIN "' list models", "is taken");
}

}  // namespace
}  // namespace hysteron

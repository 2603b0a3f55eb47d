// Laws in columns and numbers of recordings, and recordings without time, as a user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

// A Kelvin-Voigt damper whose c0 follows the pressure (bar); with the pressure as a column, or without.
std::string pressed(double frequency, double bar, bool column) {
  std::string text = std::string("time [s],displacement [m],force [N]") + (column ? ",pressure [bar]\n" : "\n");
  const double omega = 2.0 * std::acos(-1.0) * frequency;
  for (int n = 0; n < 120; ++n) {
    const double t = 2.0 / frequency * n / 119.0;
    const double x = 0.02 * std::sin(omega * t);
    const double v = 0.02 * omega * std::cos(omega * t);
    std::stringstream row;
    row.precision(14);
    row << t << ',' << x << ',' << (400.0 + 150.0 * bar) * v + 3000.0 * x;
    if (column) row << ',' << bar;
    text += row.str() + "\n";
  }
  return text;
}

class Pressed : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::string toml = "schema = \"hysteron.campaign/1\"\n[by.pressure]\nc0 = 1\n";
    int k = 0;
    for (const double bar : {1.0, 2.0, 3.1}) {
      const std::string name = "r" + std::to_string(++k) + ".csv";
      write(folder_ / "column" / name, pressed(1.0 + k, bar, true));
      write(folder_ / "number" / name, pressed(1.0 + k, bar, false));
      std::stringstream entry;
      entry << "[[recording]]\nfile = \"" << name << "\"\npressure = \"" << bar << " bar\"\n";
      toml += entry.str();
    }
    write(folder_ / "number/campaign.toml", toml);
  }
  [[nodiscard]] Outcome fit(const std::vector<std::string>& more, const std::string& out) const {
    std::vector<std::string> words = {"fit", "--model", "viscous", "--budget", "600", "--quiet", "--out", out};
    words.insert(words.begin() + 1, more.begin(), more.end());
    return run(words);
  }
  [[nodiscard]] json model(const std::string& out) const { return json::parse(read(folder_ / out / "model.json")); }
};

TEST_F(Pressed, ANumberAndAConstantColumnAreTheSame) {
  ASSERT_EQ(fit({"column", "--by", "pressure=c0:1"}, "a").status, 0);
  const Outcome number = fit({"number"}, "b");
  ASSERT_EQ(number.status, 0) << number.err;
  const json a = model("a");
  const json b = model("b");
  EXPECT_EQ(a["parameters"].dump(), b["parameters"].dump());
  EXPECT_EQ(a["by"].dump(), b["by"].dump());
  EXPECT_EQ(a["by"]["pressure"]["unit"], "Pa");
  EXPECT_EQ(a["by"]["pressure"]["parameters"], (json{{"c0", 1}}));
  for (const json& entry : a["parameters"]) {
    if (entry["name"] == "c0*pressure") {
      EXPECT_EQ(entry["unit"], "N s/m/Pa");
      EXPECT_NEAR(entry["value"].get<double>(), 150.0e-5, 1e-8);
    }
  }
}

// Plain numbers of campaign.toml have the unit that their name says, and where it says none that is told.
TEST_F(Pressed, UnitsAreOverThoseOfPlainNumbers) {
  const auto fitted = [&](const std::string& name) {
    std::string toml = "schema = \"hysteron.campaign/1\"\n[by." + name + "]\nc0 = 1\n";
    for (int k = 1; k <= 3; ++k) {
      toml += "[[recording]]\nfile = \"r" + std::to_string(k) + ".csv\"\n" + name + " = " + std::to_string(k) + "\n";
    }
    write(folder_ / "number/campaign.toml", toml);
    const Outcome outcome = fit({"number"}, name);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out;
  };
  const auto unit_of = [&](const std::string& out, const std::string& parameter, const char* key) {
    const json file = json::parse(read(folder_ / out / "fit.json"));
    for (const json& row : file["parameters"]) {
      if (row["name"] == parameter) return row[key].get<std::string>();
    }
    return std::string();
  };
  const std::string temperature = fitted("temperature");
  EXPECT_NE(temperature.find("N s/m per °C"), std::string::npos) << temperature;
  EXPECT_EQ(model("temperature")["by"]["temperature"]["unit"], "degC");
  EXPECT_EQ(unit_of("temperature", "c0*temperature", "unit"), "N s/m/degC");
  EXPECT_EQ(unit_of("temperature", "c0*temperature", "unit_text"), "N s/m per °C");
  fitted("pressure");
  EXPECT_EQ(unit_of("pressure", "c0*pressure", "unit_text"), "N s/m per Pa");
  const std::string valve = fitted("valve");
  EXPECT_NE(valve.find("N s/m per unit of valve"), std::string::npos) << valve;
  // What is stored has no unit that nobody gave.
  EXPECT_EQ(unit_of("valve", "c0*valve", "unit"), "N s/m");
  EXPECT_EQ(unit_of("valve", "c0", "unit_text"), "N s/m");
  const Outcome scored = run({"score", "valve/model.json", "number"});
  EXPECT_EQ(scored.status, 0) << scored.err;
}

TEST_F(Pressed, TheModelIsUsedAtOtherValues) {
  ASSERT_EQ(fit({"column", "--by", "pressure=c0:1"}, "a").status, 0);
  write(folder_ / "new.csv", pressed(2.2, 2.5, true));
  write(folder_ / "bare.csv", pressed(2.2, 2.5, false));
  const Outcome scored = run({"score", "a/model.json", "new.csv", "--json"});
  ASSERT_EQ(scored.status, 0) << scored.err;
  EXPECT_LT(json::parse(scored.out)["overall"]["nrmse"].get<double>(), 1e-3);
  ASSERT_EQ(run({"simulate", "a/model.json", "new.csv", "--out", "c.csv"}).status, 0);
  ASSERT_EQ(run({"simulate", "a/model.json", "bare.csv", "--at", "pressure=2.5 bar", "--out", "n.csv"}).status, 0);
  EXPECT_EQ(read(folder_ / "c.csv"), read(folder_ / "n.csv"));
  const Outcome compared = run({"compare", "a/model.json", "column", "--out", "compared"});
  EXPECT_EQ(compared.status, 0) << compared.err;
  EXPECT_EQ(run({"export", "a/model.json", "--to", "c", "--at", "pressure=250000", "--out", "c"}).status, 0);
  const Outcome responded = run({"respond", "a/model.json", "bare.csv", "--excitation", "force", "--mass", "20", "--at",
                                 "pressure=2 bar", "--out", "m.csv"});
  EXPECT_EQ(responded.status, 0) << responded.err;
  std::string unitless = read(folder_ / "new.csv");
  unitless.replace(unitless.find("pressure [bar]"), 14, "pressure");
  write(folder_ / "unitless.csv", unitless);
  const Outcome unknown = run({"score", "a/model.json", "unitless.csv"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(unknown.err,
            "error: unitless.csv: the pressure has no unit, and is in 'Pa' in the model, expected a unit in both or in "
            "neither\n");
  // Beyond what was fitted it is said.
  const Outcome far = run({"simulate", "a/model.json", "bare.csv", "--at", "pressure=9 bar", "--out", "f.csv"});
  EXPECT_EQ(far.status, 0);
  EXPECT_NE(far.err.find("the laws of a/model.json were fitted from 1e+05 to 3.1e+05 Pa"), std::string::npos)
      << far.err;
}

// A damper that gets stiffer with the hours: c0 follows the start of the recordings, wherever the first of them lies.
TEST_F(Pressed, TheClockOfRecordingsIsFollowed) {
  const auto started = [&](const std::string& folder, int minute, const std::string& words) {
    const std::string name = folder + "/m" + std::to_string(minute) + ".csv";
    write(folder_ / name, words + pressed(1.0 + 0.05 * minute, 0.1 * minute, false));
  };
  for (const int minute : {10, 20, 35}) {
    started("clock", minute, "# start: 2026-11-24T14:" + std::to_string(minute) + ":00\n");
  }
  const Outcome fitted = fit({"clock", "--by", "clock=c0:1"}, "a");
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  const json parameters = model("a")["parameters"];
  const auto slope = std::ranges::find_if(parameters, [](const json& one) { return one["name"] == "c0*clock"; });
  ASSERT_NE(slope, parameters.end()) << parameters;
  EXPECT_EQ((*slope)["unit"], "N s/m/s");
  EXPECT_NEAR((*slope)["value"].get<double>(), 15.0 / 60.0, 1e-4);
  // campaign.toml asks for it as well.
  write(folder_ / "clock/campaign.toml", "schema = \"hysteron.campaign/1\"\n[by.clock]\nc0 = 1\n");
  ASSERT_EQ(fit({"clock"}, "toml").status, 0);
  EXPECT_EQ(model("toml")["parameters"].dump(), parameters.dump());
  std::filesystem::remove(folder_ / "clock/campaign.toml");
  // The first of other recordings began at another time.
  started("later", 30, "# start: 2026-11-24T14:30:00\n");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--at", "clock=1200"}}) {
    std::vector<std::string> words{"score", "a/model.json", "later", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome scored = run(words);
    ASSERT_EQ(scored.status, 0) << scored.err;
    EXPECT_LT(json::parse(scored.out)["overall"]["nrmse"].get<double>(), 1e-4);
  }
  // Without its start one recording has no clock, which takes it from all.
  started("clock", 40, "# start: yesterday\n");
  const Outcome refused = fit({"clock", "--by", "clock=c0:1"}, "b");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("error: m40.csv: says no start, and parameters follow the clock"), std::string::npos)
      << refused.err;
  const Outcome plain = fit({"clock"}, "b");
  EXPECT_EQ(plain.status, 0);
  EXPECT_NE(plain.err.find("m40.csv: no start that can be read, while other recordings have one"), std::string::npos)
      << plain.err;
}

// A column named with its unit is the condition of its name.
TEST_F(Pressed, AUnitInTheNameIsTheColumns) {
  ASSERT_EQ(fit({"column", "--by", "Pressure [bar]=c0:1"}, "a").status, 0);
  ASSERT_EQ(fit({"column", "--by", "pressure=c0:1"}, "b").status, 0);
  EXPECT_EQ(model("a")["parameters"].dump(), model("b")["parameters"].dump());
  EXPECT_EQ(model("a")["by"].dump(), model("b")["by"].dump());
  write(folder_ / "bare.csv", pressed(2.2, 2.5, false));
  for (const char* at : {"pressure=2.5 bar", "PRESSURE [bar]=2.5 bar", "pressure [bar]=2.5"}) {
    const Outcome outcome = run({"simulate", "a/model.json", "bare.csv", "--at", at, "--out", "n.csv"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("guess"), std::string::npos) << outcome.err;
  }
}

TEST_F(Pressed, WhatIsWrongIsSaidInOneLine) {
  ASSERT_EQ(fit({"column", "--by", "pressure=c0:1"}, "a").status, 0);
  write(folder_ / "bare.csv", pressed(2.2, 2.5, false));
  const auto refused = [&](const std::vector<std::string>& words, const std::string& part) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << part;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  refused({"simulate", "a/model.json", "bare.csv", "--out", "o.csv"}, "no column 'pressure', which parameters follow");
  refused({"simulate", "a/model.json", "bare.csv", "--at", "pressure=2 mm", "--out", "o.csv"},
          "expected one of Pa, bar, psi");
  refused({"simulate", "a/model.json", "bare.csv", "--at", "pressure [mm]=2", "--out", "o.csv"},
          "--at: '2 mm' of 'pressure' has a unit of another quantity");
  refused({"simulate", "a/model.json", "bare.csv", "--at", "pressure=2 turns", "--out", "o.csv"}, "expected 'Pa'");
  refused({"simulate", "a/model.json", "bare.csv", "--at", "pressure=2,5 bar", "--out", "o.csv"},
          "--at: '2,5 bar' of 'pressure' has a comma in its number, expected a decimal point");
  refused({"export", "a/model.json", "--to", "c", "--out", "c"}, "expected its value by --at \"pressure=NUMBER Pa\"");
  refused({"export", "a/model.json", "--to", "c", "--at", "pressure=1", "--at", "valve=2", "--out", "c"},
          "--at: no parameter of the model follows 'valve', expected pressure");
  refused({"fit", "column", "--model", "viscous", "--by", "valve=c0:1", "--out", "o"}, "no column 'valve'");
  refused({"fit", "column", "--model", "viscous", "--by", "force=c0:1", "--out", "o"}, "is the force of the recording");
  refused({"fit", "column", "--model", "viscous", "--by", "pressure", "--out", "o"}, "expected NAME=PARAMETER:ORDER");
  refused({"fit", "column", "--model", "viscous", "--by", "pressure=c0:1", "--stages", "two", "--out", "o"},
          "--stages two");
  json model = json::parse(read(folder_ / "a/model.json"));
  model["by"]["pressure"]["origin"] = 3;
  write(folder_ / "m.json", model.dump());
  refused({"score", "m.json", "column"}, "unknown member 'origin'");
  model["by"] = json::object();
  write(folder_ / "m.json", model.dump());
  refused({"score", "m.json", "column"}, "which is not in by");
}

TEST_F(Pressed, ANumberThatNothingFollowsIsRefusedWithWhatIsFollowed) {
  ASSERT_EQ(fit({"column", "--by", "pressure=c0:1"}, "a").status, 0);
  ASSERT_EQ(
      run({"fit", "data", "--model", "viscous", "--by-current", "c0:1", "--budget", "300", "--quiet", "--out", "b"})
          .status,
      0);
  ASSERT_EQ(run({"fit", "data", "--model", "viscous", "--budget", "300", "--quiet", "--out", "c"}).status, 0);
  struct Case {
    std::string model;
    std::string data;
    std::string at;
    std::string expected;
  };
  const Case cases[] = {
      {"a", "column/r1.csv", "valve=2", "'valve', expected pressure"},
      {"a", "column/r1.csv", "current=2", "'current', expected pressure"},
      {"b", "data/r1.csv", "pressure=2 bar", "'pressure', expected current"},
      {"b", "data/r1.csv", "voltage=2", "'voltage', expected current"},
      {"c", "data/r1.csv", "pressure=2 bar", "'pressure', expected no --at, since they follow nothing that it gives"},
  };
  for (const Case& one : cases) {
    const std::string model = one.model + "/model.json";
    for (const std::vector<std::string>& words : {std::vector<std::string>{"simulate", model, one.data, "--out", "o"},
                                                  {"score", model, one.data},
                                                  {"compare", model, one.data, "--out", "o"},
                                                  {"respond", model, one.data, "--mass", "20", "--out", "o"},
                                                  {"export", model, "--to", "c", "--out", "o"}}) {
      if (words[0] == "export" && one.model == "b") continue;  // the current stays an input
      std::vector<std::string> given = words;
      if (words[0] == "export" && one.model == "a") given.insert(given.end(), {"--at", "pressure=1 bar"});
      given.insert(given.end(), {"--at", one.at});
      const Outcome outcome = run(given);
      EXPECT_EQ(outcome.status, 2) << words[0];
      EXPECT_EQ(outcome.out, "") << words[0];
      EXPECT_EQ(outcome.err, "error: --at: no parameter of the model follows " + one.expected + "\n") << words[0];
      EXPECT_FALSE(std::filesystem::exists(folder_ / "o")) << words[0];
    }
  }
}

TEST_F(Pressed, ByCurrentAndByFrequencyAreTwoCasesOfIt) {
  ASSERT_EQ(
      run({"fit", "data", "--model", "viscous", "--by-current", "c0:1", "--budget", "300", "--quiet", "--out", "a"})
          .status,
      0);
  ASSERT_EQ(
      run({"fit", "data", "--model", "viscous", "--by", "current=c0:1", "--budget", "300", "--quiet", "--out", "b"})
          .status,
      0);
  json a = model("a");
  json b = model("b");
  EXPECT_FALSE(a.contains("by"));
  a.erase("provenance");
  b.erase("provenance");
  EXPECT_EQ(a.dump(), b.dump());
}

TEST_F(Pressed, WithoutTimeOnlyALawWithoutRateIsFitted) {
  std::string text = "displacement [mm],force [N]\n";
  double z = 0.0;
  double before = 0.0;
  for (int n = 0; n < 400; ++n) {
    const double x = 10.0 * std::sin(0.05 * n);
    z = std::clamp(z + (x - before) / 2.0, -1.0, 1.0);  // an elastic, perfectly plastic element
    before = x;
    text += std::to_string(x) + "," + std::to_string(500.0 * z + 20.0 * x) + "\n";
  }
  write(folder_ / "slow/r1.csv", text);
  const std::vector<std::string> words = {"fit",  "slow",    "--model", "bouc-wen", "--budget",
                                          "3000", "--quiet", "--out",   "s"};
  EXPECT_NE(run(words).err.find("no time column"), std::string::npos);
  std::vector<std::string> without = words;
  without.insert(without.end(), {"--without-time"});
  const Outcome rated = run(without);
  EXPECT_EQ(rated.status, 2);
  EXPECT_NE(rated.err.find("the force depends on the rate through c0 [N s/m]"), std::string::npos) << rated.err;
  without.insert(without.end(), {"--fix", "c0=0"});
  const Outcome fitted = run(without);
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  const Outcome scored = run({"score", "s/model.json", "slow", "--without-time", "--json"});
  ASSERT_EQ(scored.status, 0) << scored.err;
  EXPECT_LT(json::parse(scored.out)["overall"]["nrmse"].get<double>(), 0.02);
}

}  // namespace
}  // namespace hysteron

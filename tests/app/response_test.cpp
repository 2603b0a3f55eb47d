// The force of a recording of a mass is what excites it, and not the damper's: no command takes one for the other.
// Every test runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

class ResponseOfAMass : public Program {
 protected:
  // A Kelvin-Voigt damper, and what it makes of a mass of 2 kg under a force.
  void SetUp() override {
    Program::SetUp();
    write(folder_ / "damper.json",
          R"({"schema":"hysteron.model/1","model":"viscous","effects":[],"parameters":[
          {"name":"k0","value":800,"unit":"N/m"},{"name":"c0","value":8,"unit":"N s/m"},
          {"name":"f0","value":0,"unit":"N"}]})");
    std::string text = "time [s],force [N]\n";
    for (int n = 0; n < 1000; ++n) {
      const double t = n / 500.0;
      text += fmt::format("{},{}\n", t, 20.0 * std::sin(9.0 * t) + 10.0 * std::sin(31.0 * t));
    }
    write(folder_ / "push.csv", text);
    std::filesystem::create_directories(folder_ / "shaker");
    const Outcome outcome = run({"respond", "damper.json", "push.csv", "--mass", "2", "--out", "shaker/motion.csv"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  // Of out/model.json, by name.
  [[nodiscard]] std::map<std::string, double> parameters() const {
    const json model = json::parse(read(folder_ / "out/model.json"));
    std::map<std::string, double> result;
    for (const json& one : model.at("parameters")) result[one.at("name").get<std::string>()] = one.at("value");
    return result;
  }

  [[nodiscard]] Outcome fit_response() const {
    return run({"fit", "shaker", "--response", "--mass", "2", "--model", "viscous", "--budget", "500", "--quiet",
                "--out", "out"});
  }
};

TEST_F(ResponseOfAMass, WhatIsWrittenIsIdentifiedFrom) {
  const std::string written = read(folder_ / "shaker/motion.csv");
  EXPECT_EQ(written.substr(0, written.find('\n')),
            "time [s],displacement [m],velocity [m/s],acceleration [m/s^2],force [N],damper force [N]");
  const Outcome outcome = fit_response();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::map<std::string, double> found = parameters();
  for (const auto& [name, truth] : {std::pair("c0", 8.0), {"k0", 800.0}, {"f0", 0.0}}) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found.at(name), truth, 1e-3) << name;
  }
  // Its own force is that of the damper where that is asked for.
  const Outcome damper = run({"fit", "shaker", "--column", "force=damper force [N]", "--model", "viscous", "--budget",
                              "500", "--quiet", "--out", "direct"});
  ASSERT_EQ(damper.status, 0) << damper.err;
  EXPECT_LT(json::parse(read(folder_ / "direct/fit.json")).at("nrmse").at("fit").get<double>(), 1e-6);
}

TEST_F(ResponseOfAMass, AnExcitationUnderAnotherNameIsNotTakenForNoneSilently) {
  std::string text = read(folder_ / "shaker/motion.csv");
  text.replace(text.find("force [N],damper force [N]"), 26, "Shaker [N],Cell [N]");
  write(folder_ / "shaker/motion.csv", text);
  const Outcome outcome = fit_response();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: motion.csv: no force on the mass and no base: taken as a free decay, without "
                             "'Shaker [N]', 'Cell [N]'"),
            std::string::npos)
      << outcome.err;
}

// A drive that is given is constant, whatever the file's is.
TEST_F(ResponseOfAMass, ADriveThatIsGivenStandsForOneThatVaries) {
  write(folder_ / "lagged.json",
        R"({"schema":"hysteron.model/1","model":"viscous","effects":["coil-lag"],"by_current":{"c0":1},"parameters":[
        {"name":"k0","value":800,"unit":"N/m"},{"name":"c0","parameter":"c0","value":8,"unit":"N s/m"},
        {"name":"c0*i","parameter":"c0","drive_power":1,"value":4,"unit":"N s/m/A"},
        {"name":"f0","value":0,"unit":"N"},{"name":"coil-lag.tau","value":0.01,"unit":"s"},
        {"name":"coil-lag.r","value":1,"unit":"1"}]})");
  std::string text = "time [s],force [N],current [A]\n";
  for (int n = 0; n < 500; ++n) {
    text += fmt::format("{},{},{}\n", n / 500.0, 20.0 * std::sin(9.0 * n / 500.0), n < 250 ? 0.2 : 0.8);
  }
  write(folder_ / "steps.csv", text);
  const std::vector<std::string> words{"respond", "lagged.json", "steps.csv", "--mass", "2", "--out", "steps_out.csv"};
  const Outcome varying = run(words);
  EXPECT_EQ(varying.status, 2) << varying.err;
  EXPECT_NE(varying.err.find("coil-lag acts on a drive that varies"), std::string::npos) << varying.err;
  std::vector<std::string> given = words;
  given.insert(given.end(), {"--drive", "0.5"});
  EXPECT_EQ(run(given).status, 0) << run(given).err;
}

TEST_F(ResponseOfAMass, ItsForceIsNotTakenForTheDampers) {
  const Outcome outcome = run({"fit", "shaker", "--model", "viscous", "--out", "out"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("error: motion.csv: its force excites a mass and is not the damper's, expected --column "
                             "force=\"damper force [N]\""),
            std::string::npos)
      << outcome.err;
}

TEST_F(ResponseOfAMass, AModelOfItIsNotScoredOnWhatExcitesIt) {
  // As a rig records it: without the force of the damper.
  std::string rig;
  const std::string written = read(folder_ / "shaker/motion.csv");
  for (std::size_t at = 0; at < written.size(); at = written.find('\n', at) + 1) {
    const std::string line = written.substr(at, written.find('\n', at) - at);
    rig += line.substr(0, line.rfind(',')) + "\n";
  }
  write(folder_ / "shaker/motion.csv", rig);
  write(folder_ / "other.csv", rig + "\n");
  ASSERT_EQ(fit_response().status, 0);
  const json response = json::parse(read(folder_ / "out/model.json")).at("response");
  EXPECT_EQ(response.at("excitation"), "force");
  EXPECT_EQ(response.at("mass_kg"), 2.0);
  EXPECT_EQ(response.at("recordings")[0].at("file"), "motion.csv");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"score", "out/model.json", "shaker"},
                                                {"compare", "out/model.json", "shaker", "--out", "compared"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("motion.csv: its force excites the mass"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "compared/compare.json"));
  }
  // Of another recording it is not known whose force it holds.
  const Outcome other = run({"score", "out/model.json", "other.csv"});
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_NE(other.err.find("was identified from the motion of a mass"), std::string::npos) << other.err;
  // A damper's own recordings are scored without a word by a model that was identified from such.
  fit();
  EXPECT_EQ(run({"score", "fitted/model.json", "data"}).err.find("mass"), std::string::npos);
}

// Columns of a CSV file without its names.
std::vector<std::vector<double>> columns_of(const std::string& text) {
  std::vector<std::vector<double>> result;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t k = 0; std::getline(cells, cell, ','); ++k) {
      if (result.size() <= k) result.emplace_back();
      result[k].push_back(std::stod(cell));
    }
  }
  return result;
}

// The benchmark as docs/response.md tells it, on one period of five of the noisy multisine.
TEST_F(ResponseOfAMass, TheHystereticOscillatorIsIdentified) {
  constexpr std::size_t period = 8192;
  ASSERT_EQ(run({"generate", "hysteretic-oscillator", "--out", "oscillator"}).status, 0);
  const std::string training = read(folder_ / "oscillator/training.csv");
  std::size_t end = 0;
  for (std::size_t line = 0; line <= period; ++line) end = training.find('\n', end) + 1;
  write(folder_ / "one/training.csv", training.substr(0, end));
  const Outcome fitted = run({"fit", "one", "--response", "--mass", "2", "--interpolation", "band-limited", "--model",
                              "hysteretic-spring", "--solver", "lm", "--budget", "300", "--quiet", "--out", "out"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  const std::map<std::string, double> truth = {
      {"k_z", 5e4}, {"c0", 10.0}, {"k0", 5e4}, {"on", -300.0}, {"off", 1900.0}};
  const std::map<std::string, double> found = parameters();
  for (const auto& [name, value] : truth) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_NEAR(found.at(name), value, 0.01 * std::fabs(value)) << name;
  }
  const Outcome moved = run({"respond", "out/model.json", "oscillator/multisine.csv", "--mass", "2", "--excitation",
                             "force", "--interpolation", "band-limited", "--out", "motion.csv"});
  ASSERT_EQ(moved.status, 0) << moved.err;
  const std::vector<double> measured = columns_of(read(folder_ / "oscillator/multisine.csv")).at(1);
  const std::vector<double> simulated = columns_of(read(folder_ / "motion.csv")).at(1);
  ASSERT_EQ(simulated.size(), measured.size());
  double square = 0.0;
  for (std::size_t n = measured.size() - period; n < measured.size(); ++n) {
    square += std::pow(simulated[n] - measured[n], 2.0) / static_cast<double>(period);
  }
  EXPECT_LT(std::sqrt(square), 1e-6);
}

// What is told of the recordings of a damper is told of what excites a mass.
class Excitation : public ResponseOfAMass {
 protected:
  // A sine of two seconds at 500 Hz under this header, with what `change` makes of time (s) and value of a sample.
  void excite(const std::string& head, double size, const std::function<bool(int, double&, double&)>& change) const {
    std::string text = head + "\n";
    for (int n = 0; n < 1000; ++n) {
      double t = n / 500.0;
      double value = size * std::sin(9.0 * t) * std::min(1.0, 4.0 * t);
      if (change(n, t, value)) text += fmt::format("{},{}\n", t, value);
    }
    write(folder_ / "excitation.csv", text);
  }
  // What is said when it moves a mass.
  [[nodiscard]] std::string told() const {
    const Outcome outcome = run({"respond", "damper.json", "excitation.csv", "--mass", "2", "--out", "motion.csv"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  }

  static bool plain(int /*n*/, double& /*t*/, double& /*value*/) { return true; }
  static bool with_gap(int n, double& /*t*/, double& /*value*/) { return n < 400 || n > 600; }
  static bool in_ms(int /*n*/, double& t, double& /*value*/) {
    t *= 1000.0;
    return true;
  }
};

TEST_F(Excitation, AsItShouldBeIsNotRemarkedOn) {
  excite("time [s],force [N]", 20.0, plain);
  EXPECT_EQ(told(), "");
  excite("time [s],base [mm]", 5.0, plain);
  EXPECT_EQ(told(), "");
  // A blow from rest, and a load that is put on at once.
  excite("time [s],force [N]", 20.0, [](int n, double& /*t*/, double& value) {
    value = n == 300 ? 500.0 : 0.0;
    return true;
  });
  EXPECT_EQ(told(), "");
  excite("time [s],force [N]", 20.0, [](int n, double& /*t*/, double& value) {
    value = n < 300 ? 0.0 : 50.0;
    return true;
  });
  EXPECT_EQ(told(), "");
}

TEST_F(Excitation, AGapInItsTimesIsTold) {
  for (const auto& [head, size] : {std::pair{"time [s],force [N]", 20.0}, {"time [s],base [mm]", 5.0}}) {
    excite(head, size, with_gap);
    EXPECT_EQ(
        told(),
        "warning: excitation.csv: no samples for 0.404 s from 0.798 s on, 202 times the usual spacing: the motion "
        "in between is taken to be smooth\n");
  }
}

TEST_F(Excitation, TimesInMillisecondsAreTold) {
  excite("time,force [N]", 20.0, in_ms);
  EXPECT_NE(told().find("warning: excitation.csv: the mass moves by "), std::string::npos);
  excite("time,base [mm]", 5.0, in_ms);
  EXPECT_NE(told().find("excitation.csv: the base moves by 10 mm at "), std::string::npos);
  EXPECT_NE(told().find(" mm/s at most: check the unit of the time, as in time [ms]\n"), std::string::npos);
}

TEST_F(Excitation, ABaseInMillimetresWithoutTheirUnitIsTold) {
  excite("time [s],base", 5.0, plain);
  EXPECT_NE(told().find("warning: excitation.csv: base: a stroke of 10 m is not of a damper's size: check the unit of "
                        "column 'base'\n"),
            std::string::npos);
}

TEST_F(Excitation, ASampleThatStandsOutIsTold) {
  const auto spike = [](int n, double& /*t*/, double& value) {
    if (n == 700) value *= -100.0;
    return true;
  };
  excite("time [s],force [N]", 20.0, spike);
  EXPECT_NE(told().find("warning: excitation.csv: a force of -67.2 N at 1.4 s where its neighbours tell 0.672 N"),
            std::string::npos)
      << told();
  excite("time [s],base [mm]", 5.0, spike);
  EXPECT_NE(told().find("warning: excitation.csv: a displacement of the base of -0.0"), std::string::npos) << told();
  // Within its range.
  excite("time [s],force [N]", 20.0, [](int n, double& /*t*/, double& value) {
    if (n == 700) value = -15.0;
    return true;
  });
  EXPECT_NE(told().find("warning: excitation.csv: a force of -15 N at 1.4 s where its neighbours tell "),
            std::string::npos)
      << told();
}

// By `fit --response` too, and in its results.
TEST_F(Excitation, ABaseThatAModelIsIdentifiedFromIsChecked) {
  excite("time [s],base [mm]", 5.0, plain);
  ASSERT_EQ(run({"respond", "damper.json", "excitation.csv", "--mass", "2", "--out", "moved.csv"}).status, 0);
  // The columns that a rig records.
  const auto recorded = [&](const std::string& head, const std::function<double(int, double)>& change) {
    std::stringstream moved(read(folder_ / "moved.csv"));
    std::string line;
    std::getline(moved, line);
    std::string text = head + "\n";
    for (int n = 0; std::getline(moved, line); ++n) {
      std::vector<double> cells;
      std::stringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(std::stod(cell));
      text += fmt::format("{},{},{}\n", cells[0], change(n, 1e3 * cells[5]), 1e3 * cells[1]);
    }
    write(folder_ / "shaker/motion.csv", text);
    const Outcome outcome = fit_response();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string told = json::parse(read(folder_ / "out/fit.json")).at("warnings").dump();
    return std::pair(outcome.err, told);
  };
  const std::string head = "time [s],base [mm],displacement [mm]";
  const auto same = [](int /*n*/, double b) { return b; };
  EXPECT_EQ(recorded(head, same).first.find("base"), std::string::npos);
  const std::string no_unit = "base: a stroke of 10 m is not of a damper's size: check the unit of column 'base'";
  const auto [err, warnings] = recorded("time [s],base,displacement [mm]", same);
  EXPECT_NE(err.find(no_unit), std::string::npos) << err;
  EXPECT_NE(warnings.find(no_unit), std::string::npos) << warnings;
  EXPECT_NE(recorded(head, [](int n, double b) { return n == 700 ? b + 50.0 : b; })
                .first.find("a displacement of the base of 0.05"),
            std::string::npos);
  EXPECT_NE(recorded(head, [](int n, double b) { return n > 500 ? b + 3.0 : b; })
                .first.find("base: the displacement leaps by "),
            std::string::npos);
}

}  // namespace
}  // namespace hysteron

// The force of a recording of a mass is what excites it, and not the damper's: no command takes one for the other.
// Every test runs HYSTERON_PROGRAM in a temporary folder of its own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
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

}  // namespace
}  // namespace hysteron

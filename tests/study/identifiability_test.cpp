// Identifiability against a problem that is linear, so that its intervals are known, and one with a redundant
// parameter.
#include "study/identifiability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/random.hpp"
#include "study/run.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr std::size_t samples = 2000;
constexpr double noise = 20.0;  // N
constexpr double stiffness = 2e4;
constexpr double damping = 3e3;

// Ten whole periods: displacement and velocity are then orthogonal.
Recording spring_and_dashpot() {
  Recording recording;
  recording.file = "made.csv";
  const double frequency = 2.0 * std::numbers::pi * 2.0;
  const Stream stream = Stream(5).child("noise");
  for (std::size_t k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) * 5.0 / static_cast<double>(samples);
    recording.time.push_back(t);
    recording.displacement.push_back(0.01 * std::sin(frequency * t));
    recording.velocity.push_back(0.01 * frequency * std::cos(frequency * t));
    // Uniform noise of the standard deviation wanted.
    recording.force.push_back(stiffness * recording.displacement.back() + damping * recording.velocity.back() +
                              noise * std::sqrt(12.0) * (stream.uniform(k) - 0.5));
  }
  return recording;
}

json identify(const std::vector<std::string>& effects) {
  Study study;
  study.title = "test";
  study.models = {{"model", "viscous", effects, {}, 0}};
  DataSpec data;
  data.label = "made";
  data.made = {spring_and_dashpot()};
  study.data = {data};
  study.solvers = {{"pso", "pso", {}, 0}};
  study.budgets = {400};
  study.seeds = {1, 2};
  const Plan plan = make_plan(study, "test");
  Store store = Store::memory();
  run_plan(plan, store, {}, {}, {});
  const std::vector<RunRecord> records = store.records();
  const json one = identifiability(plan, records, 1, {});
  EXPECT_EQ(one.dump(), identifiability(plan, records, 2, {}).dump()) << "threads must not matter";
  EXPECT_TRUE(identifiability(plan, records, 1, [] { return true; }).at("problems").is_null());
  return one.at("problems").at(0);
}

const json& named(const json& problem, const std::string& name) {
  for (const json& row : problem.at("parameters")) {
    if (row.at("name") == name) return row;
  }
  ADD_FAILURE() << "no parameter " << name << " in " << problem.at("parameters").dump();
  return problem;
}

TEST(Identifiability, ProfilesGiveTheIntervalsOfALinearModel) {
  const json found = identify({});
  const Recording recording = spring_and_dashpot();
  double squares = 0.0;
  for (const double v : recording.velocity) squares += v * v;
  const double deviation = noise / std::sqrt(squares);
  const json& row = named(found, "c0");
  EXPECT_NEAR(row.at("value").get<double>(), damping, 4.0 * deviation);
  // The noise is estimated from the data, and so is its correlation: some per cent of either.
  EXPECT_NEAR(row.at("high").get<double>() - row.at("value").get<double>(), 1.96 * deviation, 0.15 * 1.96 * deviation);
  EXPECT_NEAR(row.at("value").get<double>() - row.at("low").get<double>(), 1.96 * deviation, 0.15 * 1.96 * deviation);
  EXPECT_NEAR(found.at("effective_samples").get<double>(), samples, 0.1 * samples);
  for (std::size_t i = 0; i < found.at("free").size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_LT(std::fabs(found.at("correlation").at(i).at(j).get<double>()), 0.1);
  }
}

TEST(Identifiability, ARedundantParameterIsOpen) {
  const json found = identify({"viscous-damping"});
  double strongest = 0.0;
  for (const json& row : found.at("correlation")) {
    for (const json& value : row) strongest = std::min(strongest, value.get<double>());
  }
  EXPECT_LT(strongest, -0.999) << "two dashpots side by side: only their sum is known";
  EXPECT_LT(found.at("spectrum").back().at("eigenvalue").get<double>(), 1e-6);
  const json& row = named(found, "c0");
  EXPECT_TRUE(row.at("low").is_null() || row.at("high").is_null()) << row.dump();
}

}  // namespace
}  // namespace hysteron

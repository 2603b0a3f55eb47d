// What `profile` says, of runs of any size.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::Outcome;
using testing::Program;

using Profile = Program;

// An evaluation with derivatives counts as more than the whole budget: nothing is evaluated.
TEST_F(Profile, ABudgetBelowTheFirstEvaluationIsSaid) {
  const Outcome outcome = run({"profile", "data", "--model", "viscous", "--budget", "1", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("viscous, multistart-lm: no evaluation, since the first"), std::string::npos)
      << outcome.out;
  const json row =
      json::parse(run({"profile", "data", "--model", "viscous", "--budget", "1", "--json"}).out)["rows"][0];
  EXPECT_EQ(row.at("evaluations"), 0);
  EXPECT_TRUE(row.at("team").at("idle_share").is_null());
}

TEST_F(Profile, EverySolverSaysWhatItCanOfTheSmallestBudgets) {
  for (const char* budget : {"1", "2", "10"}) {
    const Outcome outcome = run({"profile", "data", "--model", "viscous", "--budget", budget, "--quiet", "--solver",
                                 "pso,lm,multistart-lm,nelder-mead,ukf,ga,pso-lm,shrinking-box-lm"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const char* none : {"nan", "inf"}) EXPECT_EQ(outcome.out.find(none), std::string::npos) << outcome.out;
  }
}

// What is not printed needs no explanation.
TEST_F(Profile, ExplainsWhatItPrints) {
  const auto said = [&](const std::string& solver, const std::string& threads) {
    return run({"profile", "data", "--model", "viscous", "--budget", "200", "--quiet", "--solver", solver, "--threads",
                threads})
        .out;
  };
  for (const char* solver : {"pso", "multistart-lm"}) {
    for (const char* threads : {"1", "2"}) {
      const std::string out = said(solver, threads);
      EXPECT_EQ(out.find("Idle is") != std::string::npos, out.find(", idle ") != std::string::npos) << out;
      EXPECT_EQ(out.find("An evaluation with derivatives") != std::string::npos,
                out.find("derivatives 0.0 %") == std::string::npos)
          << out;
    }
  }
  EXPECT_EQ(said("pso", "1").find("Idle"), std::string::npos);
  EXPECT_NE(said("pso", "2").find("Idle"), std::string::npos);
}

}  // namespace
}  // namespace hysteron

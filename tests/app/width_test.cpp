// What a terminal of 80 columns shows of the catalogue: no line is broken by the terminal itself.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/program_fixture.hpp"
#include "report/terminal.hpp"

namespace hysteron {
namespace {

using testing::Outcome;
using testing::Program;

using Width = Program;

// Equations are lines of their own, moved in by two.
void expect_narrow(const Outcome& outcome, const std::string& what) {
  ASSERT_EQ(outcome.status, 0) << what << outcome.err;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const bool equation = line.starts_with("  ") && line.find(" = ") != std::string::npos;
    if (!equation) {
      EXPECT_LE(display_width(line), usual_width) << what << ": " << line;
    }
  }
}

TEST_F(Width, OfListsAndDescriptions) {
  for (const std::string kind : {"models", "solvers", "effects", "datasets"}) {
    const Outcome listed = run({"list", kind});
    expect_narrow(listed, kind);
    for (const nlohmann::json& row : nlohmann::json::parse(run({"list", kind, "--json"}).out)) {
      const std::string id = row.at("id");
      const Outcome described = run({"describe", id});
      expect_narrow(described, id);
      EXPECT_EQ(described.out.find("N/A"), std::string::npos) << id << ": newtons per ampere are not 'N/A'";
    }
  }
}

TEST_F(Width, OfFitsComparisonsAndProfiles) {
  fit();
  expect_narrow(run({"fit", "data", "--model", "viscous", "--by-current", "c0:1", "--budget", "600", "--quiet", "--out",
                     "second"}),
                "fit");
  expect_narrow(run({"compare", "fitted/model.json", "second/model.json", "data", "--quiet", "--out", "both"}),
                "compare");
  expect_narrow(run({"profile", "data", "--model", "viscous", "--budget", "50", "--threads", "2"}), "profile");
  expect_narrow(run({"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects",
                     "coulomb-friction,offset-force", "--laws", "none", "--quiet", "--out", "diagnosis"}),
                "diagnose");
}

}  // namespace
}  // namespace hysteron

// What a terminal of 80 columns shows of results: no line is broken by the terminal itself.
#include <gtest/gtest.h>

#include "app/narrow.hpp"
#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using testing::expect_narrow;
using testing::Program;

using Width = Program;

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

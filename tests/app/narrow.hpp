// That no line of an output is broken by a terminal of 80 columns itself.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "app/program.hpp"
#include "report/terminal.hpp"

namespace hysteron::testing {

// Equations are lines of their own, moved in by two.
inline void expect_narrow(const Outcome& outcome, const std::string& what) {
  ASSERT_EQ(outcome.status, 0) << what << outcome.err;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const bool equation = line.starts_with("  ") && line.find(" = ") != std::string::npos;
    if (!equation) {
      EXPECT_LE(display_width(line), usual_width) << what << ": " << line;
    }
  }
}

}  // namespace hysteron::testing

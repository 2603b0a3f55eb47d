#include "challenge/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron::challenge {
namespace {

// Table of "exact" intervals in Newcombe, Statist. Med. 17 (1998) 857-872, four digits.
TEST(ClopperPearson, AgreesWithPublishedIntervals) {
  struct Case {
    int hits, trials;
    double low, high;
  };
  for (const Case& c : {Case{81, 263, 0.2527, 0.3676}, Case{15, 148, 0.0578, 0.1617}, Case{0, 20, 0.0, 0.1684},
                        Case{1, 29, 0.0009, 0.1776}}) {
    const Bounds bounds = clopper_pearson(c.hits, c.trials);
    EXPECT_NEAR(bounds.low, c.low, 5.1e-5) << c.hits << " of " << c.trials;
    EXPECT_NEAR(bounds.high, c.high, 5.1e-5) << c.hits << " of " << c.trials;
  }
}

TEST(ClopperPearson, ClosedFormsAtTheEnds) {
  EXPECT_NEAR(clopper_pearson(0, 60).high, 1.0 - std::pow(0.025, 1.0 / 60.0), 1e-12);
  EXPECT_NEAR(clopper_pearson(60, 60).low, std::pow(0.025, 1.0 / 60.0), 1e-12);
  EXPECT_EQ(clopper_pearson(0, 60).low, 0.0);
  EXPECT_EQ(clopper_pearson(60, 60).high, 1.0);
  EXPECT_EQ(clopper_pearson(0, 0).high, 1.0);
}

TEST(ClopperPearson, SymmetricInHitsAndMisses) {
  EXPECT_NEAR(clopper_pearson(37, 300).low, 1.0 - clopper_pearson(263, 300).high, 1e-12);
}

TEST(Median, LowerOfTwo) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 3.0, 2.0}), 2.0);
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace hysteron::challenge

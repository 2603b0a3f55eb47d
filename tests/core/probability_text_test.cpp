#include "core/probability_text.hpp"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(ProbabilityText, ReadsAsOfNoHigherGrade) {
  EXPECT_EQ(probability_text(0.9499), "94 %");
  EXPECT_EQ(probability_text(0.95), "95 %");
  EXPECT_EQ(probability_text(0.4999), "49 %");
  EXPECT_EQ(probability_text(0.07), "7 %");
  EXPECT_EQ(probability_text(0.0), "0 %");
  EXPECT_EQ(probability_text(0.9951), "over 99 %");
  EXPECT_EQ(probability_text(1.0), "100 %");
  for (int percent = 0; percent <= 100; ++percent) {
    EXPECT_EQ(probability_text(percent / 100.0), std::to_string(percent) + " %");
  }
}

}  // namespace
}  // namespace hysteron

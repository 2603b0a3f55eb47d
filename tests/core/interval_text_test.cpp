#include "core/interval_text.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace hysteron {
namespace {

TEST(IntervalText, EndsThatDifferReadSo) {
  const auto ends = [](double low, double high) {
    const auto [first, second] = interval_ends(low, high, 3, [](double value, int digits) {
      std::ostringstream text;
      text.precision(digits);
      text << value;
      return text.str();
    });
    return first + " to " + second;
  };
  EXPECT_EQ(ends(190.0, 210.0), "190 to 210");
  EXPECT_EQ(ends(199.96, 200.04), "199.96 to 200.04");
  EXPECT_EQ(ends(199.6, 200.4), "199.6 to 200.4");
  EXPECT_EQ(ends(-2.00004e-5, -1.99996e-5), "-2.00004e-05 to -1.99996e-05");
  EXPECT_EQ(ends(200.0, 200.0), "200 to 200") << "one number";
}

}  // namespace
}  // namespace hysteron

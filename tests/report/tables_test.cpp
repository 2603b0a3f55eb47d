// CSV and LaTeX text.
#include <gtest/gtest.h>

#include "report/csv.hpp"
#include "report/latex.hpp"

namespace hysteron {
namespace {

TEST(Csv, QuotesWhatNeedsIt) {
  EXPECT_EQ(csv_table({"a", "b"}, {{"1", "x, y"}, {"say \"so\"", "two\nlines"}}),
            "a,b\n1,\"x, y\"\n\"say \"\"so\"\"\",\"two\nlines\"\n");
}

TEST(Latex, MakesSignsPlain) {
  EXPECT_EQ(latex_escape("50 % of a_b & {c} < 1"), "50 \\% of a\\_b \\& \\{c\\} $<$ 1");
  EXPECT_EQ(latex_escape("a\\b"), "a\\textbackslash{}b");
}

TEST(Latex, SetsNumbersFlushRight) {
  const std::string text = latex_table("Title", "tab:x", {"name", "value"}, {{"a", "1.5"}, {"b", "-"}});
  EXPECT_NE(text.find("\\begin{tabular}{lr}"), std::string::npos) << text;
  EXPECT_NE(text.find("    a & 1.5 \\\\\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\\caption{Title}"), std::string::npos);
}

}  // namespace
}  // namespace hysteron

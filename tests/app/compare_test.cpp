// What `compare` says beside its tables.
#include <gtest/gtest.h>

#include <string>

#include "app/program_fixture.hpp"
#include "io/file.hpp"

namespace hysteron {
namespace {

using testing::csv;
using testing::Outcome;
using testing::Program;
using testing::write;

using Compare = Program;

TEST_F(Compare, ExplainsAStarWhereThereIsOne) {
  fit();
  const Outcome fitted = run({"compare", "fitted/model.json", "data", "--quiet", "--out", "a"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_EQ(fitted.out.find('*'), std::string::npos) << fitted.out;
  write(folder_ / "new.csv", csv(1.5, 0.5));
  const Outcome unseen = run({"compare", "fitted/model.json", "data", "new.csv", "--quiet", "--out", "b"});
  ASSERT_EQ(unseen.status, 0) << unseen.err;
  EXPECT_NE(unseen.out.find("* not fitted on by that model\n"), std::string::npos) << unseen.out;
}

TEST_F(Compare, HeadsItsPageWithWhatItIs) {
  fit();
  ASSERT_EQ(run({"compare", "fitted/model.json", "data", "--quiet", "--out", "a"}).status, 0);
  EXPECT_NE(read_file(folder_ / "a" / "report.html").find("\"title\":\"Comparison of models\""), std::string::npos);
}

}  // namespace
}  // namespace hysteron

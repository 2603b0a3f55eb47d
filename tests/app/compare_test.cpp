// What `compare` says beside its tables.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

// Line ends, a byte order mark and the last line end are no other recording.
TEST_F(Compare, KnowsCopiesOfWhatWasFittedByTheirNumbers) {
  fit();
  std::string copy = "\xEF\xBB\xBF" + read_file(folder_ / "data/r1.csv");
  for (std::size_t at = copy.find('\n'); at != std::string::npos; at = copy.find('\n', at + 2)) copy.insert(at, "\r");
  write(folder_ / "copies/c1.csv", copy);
  const Outcome outcome = run({"compare", "fitted/model.json", "copies", "--quiet", "--out", "a"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find('*'), std::string::npos) << outcome.out;
  copy[copy.find("\r\n0.") + 5] = '1';  // one digit of a time
  write(folder_ / "others/c1.csv", copy);
  EXPECT_NE(run({"compare", "fitted/model.json", "others", "--quiet", "--out", "b"}).out.find("* not fitted on"),
            std::string::npos);
}

// Of a law in the current the constant alone may look like a damping that pushes.
TEST_F(Compare, TellsALawThatSomebodyHasMadeImpossible) {
  fit();
  auto model = nlohmann::json::parse(read_file(folder_ / "fitted/model.json"));
  for (auto& parameter : model["parameters"]) {
    if (parameter["name"] == "c0") parameter["value"] = -1200.0;
  }
  write(folder_ / "edited.json", model.dump());
  const std::string said = "edited.json: at a current of 0.2 A the law of 'c0' gives ";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"compare", "edited.json", "data", "--quiet", "--out", "a"},
        {"score", "edited.json", "data"},
        {"simulate", "edited.json", "data/r1.csv", "--out", "force.csv"},
        {"export", "edited.json", "--to", "c", "--out", "code"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << words[0] << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("expected at least 0 N s/m"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run({"score", "fitted/model.json", "data"}).err.find("the law of"), std::string::npos);
}

TEST_F(Compare, HeadsItsPageWithWhatItIs) {
  fit();
  ASSERT_EQ(run({"compare", "fitted/model.json", "data", "--quiet", "--out", "a"}).status, 0);
  EXPECT_NE(read_file(folder_ / "a" / "report.html").find("\"title\":\"Comparison of models\""), std::string::npos);
}

}  // namespace
}  // namespace hysteron

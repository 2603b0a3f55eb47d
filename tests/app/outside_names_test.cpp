// Names and numbers from outside: what of them reaches a terminal, a table, another command's folder.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"
#include "io/csv_text.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::csv;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

using Words = std::vector<std::string>;
using OutsideNames = Program;

const char* const small_study =
    "schema = \"hysteron.study/1\"\ntitle = \"a\\u001B[2Jb\"\nmodels = [\"viscous\"]\nsolvers = [\"random-search\"]\n"
    "budgets = [20]\nseeds = [1]\n[[data]]\nrecordings = \"data\"\n";

TEST_F(OutsideNames, OfFoldersDoNotCommandATerminal) {
  fit();
  write(folder_ / "study.toml", small_study);
  const std::string wild = "o\x1B[2J\nx";
  for (const Words& words : {Words{"fit", "data", "--model", "viscous", "--budget", "50"},
                             {"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects",
                              "coulomb-friction", "--laws", "none"},
                             {"compare", "fitted/model.json", "data"},
                             {"export", "fitted/model.json", "--to", "c"},
                             {"generate", "rd8040-twin", "--only", "2.0Hz_0.5A"},
                             {"bench", "study.toml"}}) {
    Words with = words;
    with.insert(with.end(), {"--out", words[0] + wild});
    const Outcome outcome = run(with);
    ASSERT_EQ(outcome.status, 0) << words[0] << ": " << outcome.err;
    EXPECT_EQ((outcome.out + outcome.err).find('\x1B'), std::string::npos) << words[0] << ": " << outcome.out;
    EXPECT_NE(outcome.out.find("o\\x1B[2J x"), std::string::npos) << words[0] << ": " << outcome.out;
  }
  for (const Words& words : {Words{"report", "bench" + wild},
                             {"report", "diagnose" + wild},
                             {"merge", "bench" + wild, "--out", "merge" + wild}}) {
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ((outcome.out + outcome.err).find('\x1B'), std::string::npos) << words[0] << ": " << outcome.out;
    EXPECT_NE(outcome.out.find("o\\x1B[2J x"), std::string::npos) << words[0] << ": " << outcome.out;
  }
}

TEST(NameCell, IsNoFormulaAndNoCommand) {
  EXPECT_EQ(name_cell("r1.csv"), "r1.csv");
  EXPECT_EQ(name_cell("=1+1.csv"), "'=1+1.csv");
  EXPECT_EQ(name_cell("@SUM"), "'@SUM");
  EXPECT_EQ(name_cell("+a"), "'+a");
  EXPECT_EQ(name_cell("-a"), "'-a");
  EXPECT_EQ(name_cell("-1.5e3"), "-1.5e3");
  EXPECT_EQ(name_cell("+2"), "+2");
  EXPECT_EQ(name_cell("a\x1B[2J\n"), "a\\x1B[2J ");
  EXPECT_EQ(name_cell(""), "");
}

TEST_F(OutsideNames, OfRecordingsAreNoFormulasOfATable) {
  fit();
  write(folder_ / "data/=1+1.csv", csv(1.5, 0.4));
  write(folder_ / "data/a\x1B[2J.csv", csv(1.5, 0.5));
  fs::copy(folder_ / "fitted/model.json", folder_ / "@SUM.json");
  ASSERT_EQ(run({"score", "@SUM.json", "data", "--out", "scores.csv"}).status, 0);
  ASSERT_EQ(run({"compare", "@SUM.json", "fitted/model.json", "data", "--out", "compared"}).status, 0);
  for (const char* file : {"scores.csv", "compared/recordings.csv"}) {
    const std::string table = read(folder_ / file);
    EXPECT_EQ(table.find('\x1B'), std::string::npos) << table;
    EXPECT_NE(table.find("\n'=1+1.csv,"), std::string::npos) << table;
    EXPECT_NE(table.find("\na\\x1B[2J.csv,"), std::string::npos) << table;
  }
  EXPECT_EQ(read(folder_ / "compared/models.csv").find("\n@"), std::string::npos);
  write(folder_ / "study.toml", std::string(small_study) + "label = \"=A1\"\n");
  ASSERT_EQ(run({"bench", "study.toml", "--out", "study"}).status, 0);
  ASSERT_EQ(run({"report", "study"}).status, 0);
  EXPECT_NE(read(folder_ / "study/runs.csv").find(",'=A1,"), std::string::npos) << read(folder_ / "study/runs.csv");
}

TEST_F(OutsideNames, NothingIsLeftWhereFilesMayNotGrow) {
  write(folder_ / "study.toml", small_study);
  for (const rlim_t size : {512U, 20000U}) {
    const auto few = [&] {
      const rlimit limit{size, size};
      setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Outcome bench = run({"bench", "study.toml", "--quiet", "--out", "study"}, few);
    EXPECT_EQ(bench.status, 1) << bench.err;
    EXPECT_FALSE(fs::exists(folder_ / "study")) << size << bench.err;
  }
  const Outcome diagnosis = run({"diagnose", "data", "--model", "viscous", "--by-current", "c0:1", "--effects",
                                 "coulomb-friction", "--laws", "none", "--quiet", "--out", "d"},
                                [] {
                                  const rlimit limit{512, 512};
                                  setrlimit(RLIMIT_FSIZE, &limit);
                                });
  EXPECT_EQ(diagnosis.status, 1) << diagnosis.err;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "d")) ADD_FAILURE() << entry.path();
  EXPECT_EQ(run({"bench", "study.toml", "--quiet", "--out", "study"}).status, 0) << "and it can be made then";
}

TEST_F(OutsideNames, OfLawsOfNothingAreRefused) {
  fit();
  json model = json::parse(read(folder_ / "fitted/model.json"));
  for (const char* key : {"by_current", "by_frequency"}) {
    json other = model;
    other[key]["alpa"] = 0;
    write(folder_ / "other.json", other.dump());
    const Outcome outcome = run({"score", "other.json", "data"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err, std::string("error: other.json: ") + key +
                               ": the model has no parameter 'alpa' (did you mean 'alpha'?)\n");
  }
  model["by_current"]["fc"] = 1;  // of another law
  write(folder_ / "other.json", model.dump());
  EXPECT_EQ(run({"score", "other.json", "data"}).status, 2);
  model["provenance"]["command"] = "hysteron diagnose data --model bingham";  // which bouc-wen took the place of
  write(folder_ / "other.json", model.dump());
  EXPECT_EQ(run({"score", "other.json", "data"}).status, 0);
}

TEST_F(OutsideNames, NumbersAreDecimal) {
  const Words fit = {"fit", "data", "--model", "viscous", "--budget", "50", "--quiet", "--out", "out"};
  for (const char* number : {"0x10", "inf", "nan", "1e999", "", "1,5", "++1", "+-1", " 1"}) {
    for (const Words& option : {Words{"--fix", std::string("c0=") + number},
                                {"--bounds", std::string("c0=1:") + number},
                                {"--tolerance", number},
                                {"--set", std::string("starts=") + number}}) {
      Words words = fit;
      words.insert(words.end(), option.begin(), option.end());
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.status, 2) << option[0] << ' ' << option[1];
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
  }
  EXPECT_EQ(run({"fit", "data", "--model", "viscous", "--fix", "c0=0x10", "--out", "out"}).err,
            "error: --fix: '0x10' is not a number, expected a decimal one, e.g. 1200 or 1.2e3\n");
  for (const char* number : {"16", "+1.6e1", "16.", "1.6E+1"}) {
    Words words = fit;
    words.insert(words.end(), {"--fix", std::string("c0=") + number});
    EXPECT_EQ(run(words).status, 0) << number << run(words).err;
  }
}

TEST_F(OutsideNames, AFigureGoesToStandardOutput) {
  ASSERT_EQ(run({"describe", "bingham", "--figure", "loop.svg"}).status, 0);
  const Outcome outcome = run({"describe", "bingham", "--figure", "-"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, read(folder_ / "loop.svg"));
  EXPECT_FALSE(fs::exists(folder_ / "-"));
}

TEST_F(OutsideNames, OfADriveThatChangesNothingOrIsMissedAreTold) {
  fit();
  std::string without = csv(1.5, 0.5);
  for (auto at = without.find(",0.5\n"); at != std::string::npos; at = without.find(",0.5\n")) without.erase(at, 4);
  without.replace(without.find(",current [A]"), 12, "");
  write(folder_ / "motion.csv", without);
  const std::string zero =
      "warning: motion.csv: no current is read, and parameters of fitted/model.json follow the current: taken as "
      "zero\n";
  EXPECT_EQ(run({"export", "fitted/model.json", "--to", "python", "--out", "a.py", "--motion", "motion.csv"}).err,
            zero);
  EXPECT_EQ(run({"export", "fitted/model.json", "--to", "python", "--out", "a.py", "--motion", "data/r1.csv"}).err, "");
  ASSERT_EQ(run({"fit", "data", "--model", "viscous", "--budget", "200", "--quiet", "--out", "plain"}).status, 0);
  const auto respond = [&](const std::string& model) {
    return run({"respond", model, "data/r1.csv", "--excitation", "base", "--mass", "20", "--drive", "0.5", "--out",
                "r.csv"})
        .err;
  };
  const std::string nothing = "a drive is given, and no parameter of the model follows one: it changes nothing";
  EXPECT_NE(respond("plain/model.json").find("warning: plain/model.json: " + nothing), std::string::npos);
  EXPECT_EQ(respond("fitted/model.json").find(nothing), std::string::npos);
}

TEST_F(OutsideNames, OfFoldersWithOtherResultsAreRefused) {
  fit();
  write(folder_ / "study.toml", small_study);
  ASSERT_EQ(run({"bench", "study.toml", "--out", "study"}).status, 0);
  const std::string page = read(folder_ / "fitted/report.html");
  for (const Words& words : {Words{"compare", "fitted/model.json", "data", "--out", "fitted"},
                             {"bench", "study.toml", "--out", "fitted"},
                             {"merge", "study", "--out", "fitted"},
                             {"report", "study", "--out", "fitted"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 2) << words[0];
    EXPECT_EQ(outcome.err,
              "error: --out fitted: holds a fit (fit.json), whose report.html would be replaced, expected "
              "another folder\n");
    EXPECT_EQ(read(folder_ / "fitted/report.html"), page);
    EXPECT_FALSE(fs::exists(folder_ / "fitted/store.sqlite"));
  }
  fit();  // its own is replaced
  EXPECT_EQ(run({"bench", "study.toml", "--out", "study"}).status, 0) << "its own is continued";
  EXPECT_EQ(run({"report", "study"}).status, 0);
  for (const std::string out : {"data", "data/../data/"}) {
    EXPECT_NE(run({"compare", "fitted/model.json", "data/r1.csv", "--out", out})
                  .err.find("the recordings are in this folder, and tables written there would be read as such"),
              std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder_ / "data/models.csv"));
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(run({"compare", "fitted/model.json", "data", "--out", "compared"}).status, 0);
  }
  const std::string compared = read(folder_ / "compared/report.html");
  const Outcome outcome = run({"fit", "data", "--model", "viscous", "--quiet", "--out", "compared"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "error: --out compared: holds a comparison (compare.json), whose report.html would be replaced, expected "
            "another folder\n");
  EXPECT_FALSE(fs::exists(folder_ / "compared/fit.json"));
  fs::create_directories(folder_ / "diagnosed");
  write(folder_ / "diagnosed/diagnosis.json", "{}");
  EXPECT_NE(run({"fit", "data", "--model", "viscous", "--out", "diagnosed"})
                .err.find("--out diagnosed: diagnosis.json there is of an earlier command, whose model.json and "
                          "report.html are replaced"),
            std::string::npos);
  EXPECT_EQ(read(folder_ / "compared/report.html"), compared);
}

}  // namespace
}  // namespace hysteron

// Study files: what a right one means, and one line for every way to be wrong.
#include "study/study_file.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/temporary_folder.hpp"
#include "study/plan.hpp"

namespace hysteron {
namespace {

const std::string head = "schema = \"hysteron.study/1\"\n";
const std::string rest =
    "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 10\nseeds = 1\n"
    "[[data]]\ndataset = \"rd8040-twin\"\nonly = \"2.0Hz_1.0A\"\n";

Study read(const std::string& text) {
  const testing::TemporaryFolder folder;
  return read_study_file(folder.write("study.toml", text));
}

TEST(StudyFile, ReadsShortAndLongForms) {
  const Study study = read(head +
                           "models = [\"bouc-wen+offset-force\", { id = \"bingham\", by_current = { fc = 1 } }]\n"
                           "solvers = [\"pso\"]\nbudgets = [200, 100]\nseeds = 3\ntargets = [1.1]\n"
                           "[[solver]]\nid = \"pso\"\nlabel = \"pso-100\"\nsettings = { population = 100 }\n"
                           "[[data]]\ndataset = \"rd8040-twin\"\neach = true\n");
  ASSERT_EQ(study.models.size(), 2U);
  EXPECT_EQ(study.models[0].model, "bouc-wen");
  EXPECT_EQ(study.models[0].effects, std::vector<std::string>{"offset-force"});
  EXPECT_EQ(study.models[1].layout.by_current.at("fc"), 1);
  ASSERT_EQ(study.solvers.size(), 2U);
  EXPECT_EQ(study.solvers[1].label, "pso-100");
  EXPECT_EQ(study.solvers[1].settings.at("population"), 100.0);
  EXPECT_EQ(study.budgets, (std::vector<std::size_t>{100, 200}));
  EXPECT_EQ(study.seeds, (std::vector<std::uint64_t>{1, 2, 3}));
}

struct Wrong {
  std::string name;
  std::string text;
  int line;
  std::string says;
};

class WrongStudy : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongStudy, IsToldInOneLine) {
  const testing::TemporaryFolder folder;
  const auto path = folder.write("study.toml", GetParam().text);
  try {
    static_cast<void>(make_plan(read_study_file(path), "test"));
    FAIL() << "no error for " << GetParam().name;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find(GetParam().says), std::string::npos) << what;
    EXPECT_EQ(what.find(path.string() + ":" + std::to_string(GetParam().line) + ":"), 0U) << what;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, WrongStudy,
    ::testing::Values(
        Wrong{"no_schema", rest, 1, "schema = \"hysteron.study/1\""},
        Wrong{"other_schema", "schema = \"hysteron.study/9\"\n" + rest, 1, "unknown schema"},
        Wrong{"not_toml", head + "models = [\n" + rest, 3, "not valid TOML"},
        Wrong{"unknown_key", head + "modles = [\"viscous\"]\n" + rest, 2, "did you mean 'models'"},
        Wrong{"unknown_model",
              head + "models = [\"bouc-wenn\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "did you mean 'bouc-wen'"},
        Wrong{"unknown_effect",
              head + "models = [\"viscous+gas\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "unknown effect"},
        Wrong{"force_on_a_mass",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"hysteretic-oscillator\"\n",
              7, "force on a mass"},
        Wrong{"unknown_solver",
              head + "models = [\"viscous\"]\nsolvers = [\"psoo\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              3, "did you mean 'pso'"},
        Wrong{"unknown_setting", head + rest + "[[solver]]\nid = \"ga\"\nsettings = { populaton = 10 }\n", 11,
              "did you mean 'population'"},
        Wrong{"setting_out_of_range", head + rest + "[[solver]]\nid = \"ga\"\nsettings = { elite_share = 7 }\n", 11,
              "from 0 to 0.5"},
        Wrong{"solver_twice", head + rest + "[[solver]]\nid = \"pso\"\n", 9, "listed twice"},
        Wrong{"no_budget",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nseeds = 1\n[[data]]\ndataset = \"rd8040-twin\"\n", 1,
              "no 'budgets'"},
        Wrong{"zero_budget",
              head + "budgets = 0\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "'budgets' is 0, expected a whole number from 1 to "},
        Wrong{"negative_seed",
              head + "seeds = [-1]\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "'seeds' is -1, expected a whole number from 0 to "},
        Wrong{"seed_twice",
              head + "seeds = [1, 1]\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "seed 1 is given twice, expected each once"},
        Wrong{"text_budget",
              head + "budgets = \"many\"\nmodels = [\"viscous\"]\nsolvers = [\"pso\"]\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\n",
              2, "'budgets' is 'many', expected for example budgets = [1000, 10000]"},
        Wrong{"number_as_name", head + "title = 3\n" + rest, 2, "'title' is 3, expected text in double quotes"},
        Wrong{"tie_out_of_range", head + "tie = 0.75\n" + rest, 2, "'tie' is 0.75, expected a number from 0 to 0.5"},
        Wrong{"each_of_text", head + rest + "each = \"yes\"\n", 9, "'each' is 'yes', expected true or false"},
        Wrong{"empty_list", head + "targets = []\n" + rest, 2, "'targets' is an empty list, expected for example"},
        Wrong{"bounds_turned",
              head + "models = [{ id = \"viscous\", bounds = { c0 = [2, 1] } }]\nsolvers = [\"pso\"]\nbudgets = "
                     "1\nseeds = 1\n[[data]]\ndataset = \"rd8040-twin\"\n",
              2, "the bounds of 'c0' are 2 and 1, expected LOWER below UPPER"},
        Wrong{"bounds_alone",
              head + "models = [{ id = \"viscous\", bounds = { c0 = [2] } }]\nsolvers = [\"pso\"]\nbudgets = "
                     "1\nseeds = 1\n[[data]]\ndataset = \"rd8040-twin\"\n",
              2, "the bounds of 'c0' are 1 in number, expected [LOWER, UPPER]"},
        Wrong{"no_such_folder",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\nrecordings = "
                     "\"nowhere\"\n",
              7, "nowhere: there is no such file, expected a readable file"},
        Wrong{"target_below_one", head + "targets = [0.5]\n" + rest, 2, "from 1 to"},
        Wrong{"no_data", head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n", 1,
              "no 'data'"},
        Wrong{"both_data",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\nrecordings = \"x\"\n",
              6, "either dataset"},
        Wrong{"unknown_dataset",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8041-twin\"\n",
              7, "did you mean 'rd8040-twin'"},
        Wrong{"nothing_chosen",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\nonly = \"9Hz\"\n",
              6, "contains '9Hz' of 'only', expected a part of '"},
        Wrong{"one_of_two_chosen",
              head + "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n[[data]]\ndataset = "
                     "\"rd8040-twin\"\nonly = [\"2.0Hz\", \"2.0hz\"]\n",
              6, "contains '2.0hz' of 'only', expected a part of '"},
        Wrong{"unknown_parameter",
              head + "models = [{ id = \"viscous\", by_current = { zeta = 1 } }]\nsolvers = [\"pso\"]\nbudgets = "
                     "1\nseeds = 1\n[[data]]\ndataset = \"rd8040-twin\"\n",
              2, "zeta"},
        Wrong{"unknown_normalisation", head + "normalisation = \"peak\"\n" + rest, 2, "max-abs"},
        Wrong{"unknown_start", head + "start = \"zero\"\n" + rest, 2, "'random' or 'card'"},
        Wrong{"same_work", head + rest + "[[solver]]\nid = \"pso\"\nlabel = \"again\"\n", 9, "same work"}),
    [](const auto& row) { return row.param.name; });

TEST(StudyFile, MissingRecordingsAreNamed) {
  const testing::TemporaryFolder folder;
  const auto path =
      folder.write("study.toml", head +
                                     "models = [\"viscous\"]\nsolvers = [\"pso\"]\nbudgets = 1\nseeds = 1\n"
                                     "[[data]]\nrecordings = \"nowhere\"\n");
  try {
    static_cast<void>(make_plan(read_study_file(path), "test"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere"), std::string::npos);
  }
}

TEST(Plan, KeysNameTheConfigurationAndNothingElse) {
  const Study study = read(head + rest);
  const Plan plan = make_plan(study, "1");
  ASSERT_EQ(plan.runs.size(), 1U);
  const std::string key = plan.runs[0].key;
  const auto key_of = [](const Study& changed, const std::string& version) {
    return make_plan(changed, version).runs[0].key;
  };
  Study same = study;
  same.title = "another title";
  same.data[0].label = "another label";
  same.targets = {2.0};
  same.file = "elsewhere.toml";
  EXPECT_EQ(key_of(same, "1"), key);
  EXPECT_NE(key_of(study, "2"), key);
  Study changed = study;
  changed.seeds = {2};
  EXPECT_NE(key_of(changed, "1"), key);
  changed = study;
  changed.budgets = {11};
  EXPECT_NE(key_of(changed, "1"), key);
  changed = study;
  changed.data[0].seed = 2;
  EXPECT_NE(key_of(changed, "1"), key);
  changed = study;
  changed.objective.tolerance = 1e-5;
  EXPECT_NE(key_of(changed, "1"), key);
  changed = study;
  changed.start = StartPoint::card;
  EXPECT_NE(key_of(changed, "1"), key);
  changed = study;
  changed.solvers[0].settings["phi"] = 4.2;
  EXPECT_NE(key_of(changed, "1"), key);
  // A setting stated at its default is the same run.
  changed.solvers[0].settings["phi"] = 4.1;
  EXPECT_EQ(key_of(changed, "1"), key);
}

TEST(Plan, ShardsPartTheRuns) {
  Study study = read(head + rest);
  for (std::uint64_t seed = 2; seed < 100; ++seed) study.seeds.push_back(seed);
  const Plan plan = make_plan(study, "1");
  std::vector<std::size_t> sizes(3, 0);
  for (const PlannedRun& run : plan.runs) {
    int homes = 0;
    for (std::size_t i = 1; i <= 3; ++i) {
      if (!in_shard(run.key, i, 3)) continue;
      ++homes;
      ++sizes[i - 1];
    }
    EXPECT_EQ(homes, 1);
  }
  for (const std::size_t size : sizes) EXPECT_GT(size, 15U);
}

}  // namespace
}  // namespace hysteron

// Making campaigns: repeatable, sized as drawn, silent about the answer, sealed.
#include "challenge/concealed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "challenge/run.hpp"
#include "challenge/seal.hpp"
#include "core/error.hpp"
#include "io/campaign.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron::challenge {
namespace {

using testing::TemporaryFolder;

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(std::filesystem::relative(entry.path(), folder));
  }
  std::ranges::sort(files);
  return files;
}

TEST(Concealed, SameBytesForAnyNumberOfJobs) {
  const TemporaryFolder one;
  const TemporaryFolder three;
  const auto tasks = plan(6, {}, {}, 11);
  Steps steps;
  const std::string hash = make_all(one.path(), tasks, 11, steps);
  steps.jobs = 3;
  EXPECT_EQ(make_all(three.path(), tasks, 11, steps), hash);
  const auto files = files_below(one.path());
  ASSERT_EQ(files, files_below(three.path()));
  EXPECT_GT(files.size(), 24u);
  for (const auto& file : files) EXPECT_EQ(read_file(one.path() / file), read_file(three.path() / file)) << file;
}

TEST(Concealed, ChangesTheForceByTheDrawnShare) {
  for (const char* id : {"inertia", "gas-spring", "clearance", "coil-lag", "shear-thinning", "sensor-delay"}) {
    const Concealed c = make_concealed({1, Level::plain, {id}}, 3);
    ASSERT_EQ(c.truths.size(), 1u);
    EXPECT_GT(c.truths[0].share, 0.02 * 0.9) << id;
    EXPECT_LT(c.truths[0].share, 0.2 * 1.1) << id;
    EXPECT_GT(c.truths[0].change_nrmse, 0.0) << id;
    EXPECT_LE(c.truths[0].left_nrmse, c.truths[0].change_nrmse) << id;
    EXPECT_LE(c.truths[0].left_nrmse_single, c.truths[0].left_nrmse * (1.0 + 1e-9)) << id;
  }
}

TEST(Concealed, HalfOfTheCampaignsSayWhenTheirTestsWereMade) {
  int told = 0;
  for (int number = 1; number <= 12; ++number) {
    const Concealed c = make_concealed({number, Level::plain, {"inertia"}}, 17);
    const std::vector<challenge::Run>& tests = c.excitation.tests;
    if (!tests.front().started) {
      for (const challenge::Run& test : tests) EXPECT_FALSE(test.started || test.pause);
      continue;
    }
    ++told;
    for (std::size_t r = 1; r < tests.size(); ++r) {
      EXPECT_NEAR(*tests[r].started, *tests[r - 1].started + tests[r - 1].duration + *tests[r].pause, 1e-9);
      EXPECT_GE(*tests[r].pause, 20.0);
      EXPECT_LE(*tests[r].pause, 1501.0);
    }
    const TemporaryFolder folder;
    write_recordings(c, folder.path().string(), 17);
    const Campaign read = load_campaign({folder.path().string()});
    for (std::size_t r = 0; r < tests.size(); ++r) {
      ASSERT_TRUE(read.recordings[r].started.has_value());
      EXPECT_EQ(*read.recordings[r].started - *read.recordings[0].started, *tests[r].started);
      EXPECT_EQ(read.recordings[r].earlier.empty(), r == 0);
    }
  }
  EXPECT_GE(told, 3);
  EXPECT_LE(told, 9);
}

TEST(Concealed, PhysicsOfTwoEffectsHasBothNames) {
  Task task{1, Level::plain, {"compliance"}, {"compliance/aerated-oil"}};
  EXPECT_EQ(make_concealed(task, 3).acceptable, std::vector<std::string>{"entrapped-gas"});
  task.forms = {"compliance/hardening"};
  EXPECT_TRUE(make_concealed(task, 3).acceptable.empty());
}

TEST(Concealed, RecordingsEndAtRestWhereTheyAreToStop) {
  Task task{1, Level::plain, {"series-dashpot"}};
  const Concealed going = make_concealed(task, 5);
  task.stops = true;
  const Concealed stopped = make_concealed(task, 5);
  ASSERT_EQ(stopped.recordings.size(), going.recordings.size());
  for (const challenge::Run& test : stopped.excitation.tests) {
    EXPECT_EQ(test.motion.at(test.duration).v, 0.0);
    EXPECT_GE(test.duration - test.motion.stop - test.motion.stopping, 0.29);
  }
  for (std::size_t k = 0; k < going.excitation.tests.size(); ++k) {
    EXPECT_EQ(stopped.excitation.tests[k].motion.at(0.5).x, going.excitation.tests[k].motion.at(0.5).x);
  }
}

TEST(Concealed, FewRecordingsAreSomeOfTheSameCampaign) {
  std::set<std::size_t> counts;
  for (int number = 1; number <= 8; ++number) {
    Task task{number, Level::plain, {"inertia"}};
    const Concealed all = make_concealed(task, 5);
    task.most_recordings = 3;
    const Concealed few = make_concealed(task, 5);
    counts.insert(few.recordings.size());
    EXPECT_FALSE(few.roles_given);
    ASSERT_EQ(few.recordings.size(), few.excitation.tests.size());
    for (const Measured& recording : few.recordings) {
      EXPECT_TRUE(
          std::ranges::any_of(all.recordings, [&](const Measured& one) { return one.force == recording.force; }));
    }
    // A law in the drive is told where there are levels for it.
    std::set<double> levels;
    for (const Measured& recording : few.recordings) levels.insert(std::round(50.0 * recording.drive.front()));
    if (few.recordings.size() > 1 && levels.size() == few.recordings.size()) {
      EXPECT_EQ(few.told_by_current, all.told_by_current);
    }
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{1, 2, 3}));
}

TEST(Concealed, InertiaAtOneFrequencyIsTakenUpByTheLaw) {
  const Concealed c = make_concealed({2, Level::unexcited, {"inertia"}, {"inertia/sprung-fixture"}}, 3);
  EXPECT_GT(c.truths.at(0).change_nrmse, 1e-3);
  EXPECT_LT(c.truths.at(0).detectability, 1.0);
}

TEST(Concealed, FilesAreACampaignThatDoesNotTellTheAnswer) {
  const TemporaryFolder folder;
  const Concealed c = make_concealed({3, Level::plain, {"end-stop"}}, 4);
  write_recordings(c, folder.path().string(), 4);
  const Campaign campaign = load_campaign({folder.path().string()});
  ASSERT_EQ(campaign.recordings.size(), c.recordings.size());
  EXPECT_EQ(campaign.model, c.told_model);
  std::size_t samples = 0;
  for (std::size_t r = 0; r < c.recordings.size(); ++r) {
    samples += campaign.recordings[r].size();
    ASSERT_EQ(campaign.recordings[r].size(), c.recordings[r].force.size());
    for (std::size_t k = 0; k < campaign.recordings[r].size(); k += 211) {
      EXPECT_NEAR(campaign.recordings[r].force[k], c.recordings[r].force[k], 1e-5 * c.range.force);
      EXPECT_NEAR(campaign.recordings[r].displacement[k], c.recordings[r].x[k], 1e-5 * c.range.amplitude);
    }
  }
  EXPECT_LE(samples, 31000u);
  for (const auto& file : files_below(folder.path())) {
    const std::string text = read_file(folder.path() / file);
    EXPECT_EQ(text.find("stop"), std::string::npos) << file;
    EXPECT_EQ(text.find("plain"), std::string::npos) << file;
  }
}

TEST(Concealed, FloorOfTheAnswerIsTheNoiseOfTheFile) {
  const Concealed c = make_concealed({4, Level::none, {}}, 5);
  const nlohmann::json answer = answer_of(c);
  double squares = 0.0;
  double peak = 0.0;
  for (std::size_t k = 0; k < c.recordings[0].force.size(); ++k) {
    const double e = c.recordings[0].force[k] - c.recordings[0].clean[k];
    squares += e * e;
    peak = std::max(peak, std::abs(c.recordings[0].force[k]));
  }
  EXPECT_NEAR(answer.at("recordings")[0].at("floor_nrmse").get<double>(),
              std::sqrt(squares / static_cast<double>(c.recordings[0].force.size())) / peak, 1e-12);
  EXPECT_TRUE(answer.at("effects").empty());
}

TEST(Plan, EveryEffectOfTheCatalogueAndEveryLevelOccurs) {
  std::set<std::string> seen;
  std::set<Level> levels;
  int controls = 0;
  for (const Task& task : plan(300, {}, {}, 1)) {
    levels.insert(task.level);
    controls += task.level == Level::none ? 1 : 0;
    if (task.level == Level::plain) seen.insert(task.effects.begin(), task.effects.end());
    ASSERT_EQ(task.forms.size(), task.effects.size());
    if (task.level == Level::pairs) {
      EXPECT_EQ(task.effects.size(), 2U);
    }
    if (task.level == Level::plain) {
      EXPECT_EQ(task.effects.size(), 1U);
    }
    if (task.level != Level::beside) continue;
    const auto foreign = std::ranges::count_if(task.effects, [](const auto& id) { return id.starts_with("foreign:"); });
    const auto known = static_cast<std::ptrdiff_t>(task.effects.size()) - foreign;
    EXPECT_TRUE(foreign >= 1 && foreign <= 3 && known >= 1 && known <= 3) << task.number;
  }
  for (const char* id : {"offset-force",
                         "gas-spring",
                         "seal-friction",
                         "inertia",
                         "quadratic-damping",
                         "shear-thinning",
                         "asymmetry",
                         "clearance",
                         "compliance",
                         "end-stop",
                         "entrapped-gas",
                         "self-heating",
                         "coil-lag",
                         "magnetic-saturation",
                         "magnetic-remanence",
                         "sensor-delay",
                         "force-drift",
                         "stiction",
                         "cubic-stiffness",
                         "degradation",
                         "pinching",
                         "cavitation",
                         "series-dashpot",
                         "velocity-lag",
                         "pre-yield-hysteresis",
                         "linear-stiffness",
                         "viscous-damping",
                         "coulomb-friction"}) {
    EXPECT_TRUE(seen.contains(id)) << id;
  }
  EXPECT_EQ(levels.size(), static_cast<std::size_t>(level_count));
  EXPECT_GE(controls, 50);
}

TEST(Plan, FormsAndForeignCausesCanBeLeftOut) {
  const FormChoice one{.only = {"shear-thinning/cross", "clearance/hertz"}, .foreign = {"foreign:cogging"}};
  for (const Task& task : plan(40, {}, {}, 2, one)) {
    for (const std::string& form : task.forms) {
      EXPECT_TRUE(form == "shear-thinning/cross" || form == "clearance/hertz" || form == "foreign:cogging") << form;
    }
  }
  const FormChoice all_but{.without = {"inertia/of-place", "foreign:cogging"}};
  std::set<std::string> seen;
  for (const Task& task : plan(400, {}, {}, 2, all_but)) seen.insert(task.forms.begin(), task.forms.end());
  EXPECT_FALSE(seen.contains("inertia/of-place"));
  EXPECT_FALSE(seen.contains("foreign:cogging"));
  EXPECT_TRUE(seen.contains("inertia/entrained"));
}

TEST(Concealed, ForeignCausesHaveTheirPowerBesideTheStrongestEffect) {
  for (const int number : {1, 2, 3}) {
    const Task task{number, Level::beside, {"gas-spring", "foreign:place-friction", "foreign:cogging"}};
    const nlohmann::json answer = answer_of(make_concealed(task, 9));
    ASSERT_EQ(answer.at("forms").size(), 3U);
    EXPECT_EQ(answer.at("effects")[0].at("power_over_strongest"), 1.0);
    double sum = 0.0;
    for (const std::size_t k : {1, 2}) {
      const double power = answer.at("effects")[k].at("power_over_strongest");
      // Found within 3 % of the size, 6 % of the power.
      EXPECT_GT(power, 0.05 * 0.93);
      EXPECT_LT(power, 2.0 * 1.07);
      sum += power;
    }
    EXPECT_NEAR(answer.at("foreign_power_over_strongest").get<double>(), sum, 1e-12);
  }
}

TEST(Plan, RefusesUnknownNamesAndEmptySelections) {
  EXPECT_THROW(static_cast<void>(level_of("hard")), InputError);
  EXPECT_THROW(static_cast<void>(hidden_effect("ghost")), InputError);
  EXPECT_THROW(static_cast<void>(plan(3, {Level::unexcited}, {"asymmetry"}, 1)), InputError);
}

TEST(Seal, OpensOnlyWhatWasSealed) {
  const TemporaryFolder folder;
  const nlohmann::json answers = {{"campaigns", {1, 2}}};
  const std::string hash = seal(answers, folder.path());
  EXPECT_EQ(open_seal(folder.path()), answers);
  EXPECT_EQ(open_seal(folder.path(), hash), answers);
  write_file_atomically(folder.path() / "answers.sealed", "{\"campaigns\":[1,3]}\n");
  EXPECT_THROW(static_cast<void>(open_seal(folder.path())), InputError);
  // A new seal over new answers does not pass for the published one.
  seal({{"campaigns", {1, 3}}}, folder.path());
  EXPECT_NO_THROW(static_cast<void>(open_seal(folder.path())));
  EXPECT_THROW(static_cast<void>(open_seal(folder.path(), hash)), InputError);
}

TEST(Run, GoesOnWhereItStoppedAndRefusesOtherSettings) {
  const TemporaryFolder folder;
  const auto tasks = plan(2, {Level::none}, {}, 1);
  const std::string hash = make_all(folder.path(), tasks, 1, {});
  EXPECT_EQ(make_all(folder.path(), tasks, 1, {}), hash);
  EXPECT_THROW(static_cast<void>(make_all(folder.path(), tasks, 2, {})), InputError);
  int calls = 0;
  const Diagnose first_fails = [&](const std::filesystem::path& data, const std::filesystem::path& out) {
    ++calls;
    if (data.filename() == "campaign-0001") throw WorkError("no");
    write_file_atomically(out / "diagnosis.json",
                          R"({"verdict":"complete","effects":[],"baseline":{},"augmented":{}})");
  };
  EXPECT_EQ(diagnose_all(folder.path(), first_fails, {}), 1);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(diagnose_all(folder.path(), first_fails, {}), 1);
  EXPECT_EQ(calls, 3);
  const nlohmann::json result = score_all(folder.path(), hash);
  EXPECT_EQ(result.at("campaigns")[0].at("outcome"), "failed");
  EXPECT_EQ(result.at("campaigns")[1].at("outcome"), "right");
  EXPECT_EQ(result.at("not_diagnosed"), 0);
  std::filesystem::remove_all(folder.path() / "diagnoses" / "campaign-0002");
  const nlohmann::json some = score_all(folder.path(), hash);
  EXPECT_EQ(some.at("campaigns").size(), 1U);
  EXPECT_EQ(some.at("not_diagnosed"), 1);
}

}  // namespace
}  // namespace hysteron::challenge

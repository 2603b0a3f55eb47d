// The equations of the Modelica package, read and integrated by a program that knows nothing of the library, against
// simulate at its finest tolerance.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "export/exported_case.hpp"
#include "export/targets.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::Case;
using testing::every_entry;
using testing::first_samples;
using testing::model_of;
using testing::Outcome;
using testing::shell;
using testing::TemporaryFolder;
using testing::write;

// Where its packages belong to the system's interpreter, another one in front of it does not see them.
std::string evaluate(const std::string& package) {
  const std::string python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3 " : "python3 ";
  return python + HYSTERON_SOURCE_DIR + "/tests/export/modelica/evaluate.py " + package;
}

// Largest difference of the force as a share of the largest force; nothing where scipy is missing.
std::optional<double> off_simulate(ExportedModel exported, const Recording& motion) {
  const TemporaryFolder folder;
  exported.tolerance = 1e-10;
  write(export_modelica(exported, test_vector(exported, motion)).files, folder.path());
  const Outcome evaluated = shell(evaluate(exported.name + "/package.mo"), folder.path());
  if (evaluated.status == 77) return std::nullopt;
  EXPECT_EQ(evaluated.status, 0) << evaluated.err;
  return evaluated.status == 0 ? std::stod(evaluated.out) : std::nan("");
}

class InModelica : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Catalogue, InModelica, ::testing::ValuesIn(every_entry()),
                         [](const auto& instance) { return instance.param.test_name(); });

// The drive is constant: where it is not, simulate lets the mean of two samples act between them.
Recording motion_at_a_drive() {
  Recording motion = first_samples(motion_for_testing(), 250);
  motion.drive.assign(motion.size(), 0.6);
  return motion;
}

TEST_P(InModelica, EquationsGiveTheForce) {
  const std::optional<double> off = off_simulate(model_of(GetParam()), motion_at_a_drive());
  if (!off) GTEST_SKIP() << "scipy is not installed";
  EXPECT_LE(*off, 1e-6);
}

Recording every_other(Recording recording) {
  for (std::vector<double>* channel : channels_of(recording)) {
    std::vector<double> kept;
    for (std::size_t n = 0; n < channel->size(); n += 2) kept.push_back((*channel)[n]);
    *channel = std::move(kept);
  }
  return recording;
}

// Then the two differ by an error of second order in the sampling interval, where states follow the drive.
TEST(ExportModelica, ADriveThatVariesActsAtEveryInstant) {
  struct {
    Case of;
    bool states_follow;
  } const cases[] = {{{"bouc-wen", {"magnetic-remanence"}}, false},
                     {{"bouc-wen", {"coil-lag", "magnetic-saturation", "sensor-delay"}}, false},
                     {{"modified-bouc-wen", {}}, true},
                     {{"bouc-wen", {"compliance", "coil-lag", "sensor-delay"}}, true}};
  for (const auto& [of, states_follow] : cases) {
    const ExportedModel exported = model_of(of);
    const Recording motion = first_samples(motion_for_testing(), 301);
    const std::optional<double> off = off_simulate(exported, motion);
    if (!off) GTEST_SKIP() << "scipy is not installed";
    if (!states_follow) {
      EXPECT_LE(*off, 1e-6) << of;
      continue;
    }
    EXPECT_LE(*off, 1e-4) << of;
    EXPECT_NEAR(std::log2(*off_simulate(exported, every_other(motion)) / *off), 2.0, 0.5) << of;
  }
}

// The evaluation can fail: by a force that is wrong, and by a name that is not declared.
TEST(ExportModelica, EvaluationTellsWhatIsWrong) {
  const TemporaryFolder folder;
  const ExportedModel exported = model_of({"bouc-wen", {}});
  TestVector vector = test_vector(exported, motion_at_a_drive());
  vector.force[100] += 1e-2 * testing::peak(vector.force);
  const ExportedFiles files = export_modelica(exported, vector).files;
  write(files, folder.path());
  const Outcome wrong = shell(evaluate("bouc_wen/package.mo"), folder.path());
  if (wrong.status == 77) GTEST_SKIP() << "scipy is not installed";
  EXPECT_GT(std::stod(wrong.out), 5e-3);
  std::string text = files.at("bouc_wen/package.mo");
  const std::string declaration = "    Real state_of_bouc_wen(start = 0, fixed = true);\n";
  ASSERT_NE(text.find(declaration), std::string::npos);
  text.erase(text.find(declaration), declaration.size());
  write({{"bouc_wen/package.mo", text}}, folder.path());
  EXPECT_NE(shell(evaluate("bouc_wen/package.mo"), folder.path()).status, 0);
}

}  // namespace
}  // namespace hysteron

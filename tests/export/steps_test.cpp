// Few or fixed steps between two samples: the test vector is made in the steps that the exported code takes, so that
// its replay is exact, and is refused where they are too few.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "export/exported_case.hpp"
#include "export/targets.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::Case;
using testing::first_samples;
using testing::model_of;
using testing::Outcome;
using testing::shell;
using testing::strict;
using testing::TemporaryFolder;
using testing::write;

// Begins within its cycle: a period is marched beforehand.
Recording in_mid_motion() {
  Recording recording;
  const double w = 2.0 * std::numbers::pi * 2.0;
  for (int n = 0; n < 400; ++n) {
    const double t = n / 300.0;
    recording.time.push_back(t);
    recording.displacement.push_back(0.01 * std::sin(w * t + 1.0));
    recording.velocity.push_back(0.01 * w * std::cos(w * t + 1.0));
  }
  return recording;
}

void expect_right_replay(const ExportedModel& exported, const TestVector& vector) {
  const TemporaryFolder folder;
  ExportedFiles files = export_c(exported, vector).files;
  files.merge(ExportedFiles(export_python(exported, vector).files));
  write(files, folder.path());
  const Outcome built = shell(strict + exported.name + "_test.c " + exported.name + ".c -lm -o replay", folder.path());
  ASSERT_EQ(built.status, 0) << built.err;
  const Outcome in_c = shell("./replay", folder.path());
  EXPECT_EQ(in_c.status, 0) << in_c.out;
  const Outcome in_python = shell("python3 " + exported.name + "_test.py", folder.path());
  EXPECT_EQ(in_python.status, 0) << in_python.out << in_python.err;
}

class Steps : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Chains, Steps,
                         ::testing::Values(Case{"bingham", {}}, Case{"bouc-wen", {"coil-lag", "self-heating"}},
                                           Case{"lugre", {"sensor-delay"}}, Case{"guo-hu", {"compliance"}},
                                           Case{"modified-bouc-wen", {"clearance", "series-dashpot"}}),
                         [](const auto& instance) {
                           std::string name = instance.param.name();
                           std::ranges::replace_if(
                               name, [](char letter) { return letter == '-' || letter == '+'; }, '_');
                           return name;
                         });

TEST_P(Steps, FixedOnesAreReplayed) {
  ExportedModel exported = model_of(GetParam());
  exported.substeps = 32;
  for (const Recording& motion : {first_samples(motion_for_testing(), 200), in_mid_motion()}) {
    const TestVector vector = test_vector(exported, motion);
    ASSERT_TRUE(vector.steps_limited);
    expect_right_replay(exported, vector);
  }
}

TEST_P(Steps, LimitedOnesAreReplayed) {
  ExportedModel exported = model_of(GetParam());
  exported.most_substeps = 16;
  const TestVector vector = test_vector(exported, first_samples(motion_for_testing(), 200));
  ASSERT_TRUE(vector.steps_limited);
  expect_right_replay(exported, vector);
}

// Straight lines, which meet between samples; with the velocity of either line at its samples.
Recording triangle() {
  Recording recording;
  constexpr double period = 1.0;
  constexpr double speed = 0.04;
  for (int n = 0; n < 400; ++n) {
    const double t = n / 301.0;
    const double phase = std::fmod(t + 0.1, period);
    const bool rises = phase < 0.5 * period;
    recording.time.push_back(t);
    recording.displacement.push_back(speed * ((rises ? phase : period - phase) - 0.25 * period));
    recording.velocity.push_back(rises ? speed : -speed);
  }
  return recording;
}

// Its velocity changes sign where its slope does not tell.
Recording rough() {
  Recording recording = in_mid_motion();
  double noise = 0.4;
  for (double& v : recording.velocity) {
    noise = 3.9 * noise * (1.0 - noise);  // chaotic, in (0, 1)
    v += 0.01 * (noise - 0.5);
  }
  return recording;
}

TEST_P(Steps, TheirOwnAreReplayedOnAnyMotion) {
  const ExportedModel exported = model_of(GetParam());
  for (const Recording& motion : {triangle(), rough()}) {
    const TestVector vector = test_vector(exported, motion);
    ASSERT_FALSE(vector.steps_limited);
    EXPECT_DOUBLE_EQ(vector.allowed(), 1e-6);
    expect_right_replay(exported, vector);
  }
}

// Friction that falls with speed behind a play sticks and slips.
TEST(StepsBetweenSamples, WhereTheModelJumpsRoundingDecidesWhen) {
  ExportedModel exported = model_of({"modified-bouc-wen", {"seal-friction", "clearance"}});
  const std::map<std::string, double> values = {
      {"seal-friction.fc", 100.0}, {"seal-friction.fb", 100.0}, {"clearance.gap", 1e-3}};
  const std::vector<std::string> names = exported.model.parameter_names();
  for (Term& term : exported.terms) {
    const auto value = values.find(names[term.parameter]);
    if (value != values.end() && term.drive_power == 0) term.value = value->second;
  }
  const TestVector vector = test_vector(exported, motion_for_testing());
  EXPECT_GT(vector.off_rounding, 1e-6);
  EXPECT_DOUBLE_EQ(vector.allowed(), 2.0 * vector.off_rounding);
  expect_right_replay(exported, vector);
}

TEST(StepsBetweenSamples, CornersAreToldBySamplesThatExportedCodeDoesNotHave) {
  const TestVector vector = test_vector(model_of({"bouc-wen", {}}), triangle());
  EXPECT_EQ(vector.corners, 2U);
  EXPECT_GT(vector.off_simulate, 1e-3);
  EXPECT_EQ(test_vector(model_of({"bouc-wen", {}}), motion_for_testing()).corners, 0U);
}

// Its inner states relax within microseconds, a thousandth of the sampling interval of the test motion.
ExportedModel stiff() {
  ExportedModel exported = model_of({"extended-bingham", {}});
  const std::vector<std::string> names = exported.model.parameter_names();
  for (Term& term : exported.terms) {
    if (names[term.parameter] == "c1") term.value = 1.0;
  }
  return exported;
}

TEST(StepsBetweenSamples, TooFewAreRefusedAndEnoughAreNamed) {
  ExportedModel exported = stiff();
  exported.substeps = 1;
  const Recording motion = motion_for_testing();
  try {
    test_vector(exported, motion);
    FAIL() << "one step does";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("substeps 1: too few steps ")) << message;
    const std::string before = "expected ";
    exported.substeps = std::stoi(message.substr(message.find(before) + before.size()));
  }
  EXPECT_GT(exported.substeps, 1);
  EXPECT_NO_THROW(test_vector(exported, motion));
}

TEST(StepsBetweenSamples, AForceThatDoesNotStayFiniteIsRefused) {
  ExportedModel exported = model_of({"viscous", {}});
  exported.terms.front().value = std::numeric_limits<double>::max();
  EXPECT_THROW(test_vector(exported, motion_for_testing()), WorkError);
}

}  // namespace
}  // namespace hysteron

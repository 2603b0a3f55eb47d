#include "check/beside_others.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace hysteron {
namespace {

// Four periods of 10 mm at 1 Hz, driven by `drive` at every sample.
Recording recording(const std::string& file, const std::vector<double>& drive, DriveKind kind = DriveKind::current,
                    double force_unit = 1.0) {
  Recording result;
  result.file = file;
  for (std::size_t n = 0; n < 400; ++n) {
    const double phase = 0.02 * std::numbers::pi * static_cast<double>(n);
    result.time.push_back(0.01 * static_cast<double>(n));
    result.displacement.push_back(0.01 * std::sin(phase));
    result.velocity.push_back(0.02 * std::numbers::pi * std::cos(phase));
    result.force.push_back(900.0 * std::cos(phase) / force_unit);
    result.drive.push_back(drive[n % drive.size()]);
  }
  result.drive_kind = kind;
  return result;
}

std::vector<std::string> said_of(const std::vector<Recording>& recordings) {
  std::vector<std::string> lines;
  for (const Remark& remark : remarks_beside_others(recordings))
    lines.push_back(remark.file + ": " + remark.text.plain());
  return lines;
}

// Recordings at 0, 0.5, 1 and 2, and one of the drive given.
std::vector<std::string> said_of_drive(const std::vector<double>& drive, DriveKind kind = DriveKind::current) {
  return said_of({recording("a", {0.0}, kind), recording("b", {0.5}, kind), recording("c", {1.0}, kind),
                  recording("d", {2.0}, kind), recording("e", drive, kind)});
}

using Lines = std::vector<std::string>;

TEST(BesideOthers, ACurrentInMilliamperesThatIsHeadedAsAmperes) {
  EXPECT_EQ(said_of_drive({500.0}),
            Lines{"e: a current of 500 A, and 0.5 to 2 A in the other recordings, a factor of a thousand: check the "
                  "unit of the current"});
  EXPECT_EQ(said_of_drive({0.0, 0.0015}),
            Lines{"e: a current of 0.0015 A, and 0.5 to 2 A in the other recordings, a factor of a thousand: check "
                  "the unit of the current"});
  EXPECT_EQ(said_of_drive({2000.0}, DriveKind::voltage),
            Lines{"e: a voltage of 2e+03 V, and 0.5 to 2 V in the other recordings, a factor of a thousand: check the "
                  "unit of the voltage"});
}

Recording moved_by(double shift, const std::string& file) {
  Recording result = recording(file, {1.0});
  for (double& x : result.displacement) x += shift;
  return result;
}

TEST(BesideOthers, AZeroFarFromThatOfAllOthers) {
  EXPECT_EQ(said_of({moved_by(0.0, "a"), moved_by(0.003, "b"), moved_by(0.1, "c")}),
            Lines{"c: a displacement of 90 to 110 mm, and of -10 to 13 mm in all other recordings: if the "
                  "sensor's zero was set differently, correct it; a stiffness, a gas spring or an end stop would be "
                  "read from it"});
  // Nearer than the length that the others cover; at several positions; of two, either may be right.
  EXPECT_EQ(said_of({moved_by(0.0, "a"), moved_by(0.003, "b"), moved_by(0.04, "c")}), Lines{});
  EXPECT_EQ(said_of({moved_by(-0.05, "a"), moved_by(0.0, "b"), moved_by(0.05, "c")}), Lines{});
  EXPECT_EQ(said_of({moved_by(0.0, "a"), moved_by(0.1, "b")}), Lines{});
}

TEST(BesideOthers, DrivesThatDifferAreWhatTheyAre) {
  for (const double drive : {0.0, 0.01, 0.1, 5.0, 30.0}) EXPECT_EQ(said_of_drive({drive}), Lines{}) << drive;
  EXPECT_EQ(said_of_drive({-0.001, 0.0012}), Lines{}) << "noise of a drive that is off";
  // Over decades, and of two kinds.
  EXPECT_EQ(said_of({recording("a", {0.001}), recording("b", {0.03}), recording("c", {1.0}), recording("d", {30.0})}),
            Lines{});
  EXPECT_EQ(said_of({recording("a", {1.0}), recording("b", {1.0}), recording("c", {1.0}),
                     recording("d", {1000.0}, DriveKind::voltage)}),
            Lines{});
  EXPECT_EQ(said_of({recording("a", {1.0}), recording("b", {1000.0})}), Lines{}) << "of two neither is most";
}

TEST(BesideOthers, TheDriveDoesNotJudgeTheOtherChannels) {
  const Lines force = {
      "d: a force of 0.9 N, and 900 N in the other recordings, a factor of a thousand: check the unit "
      "of the force"};
  for (const double drive : {0.0, 1e-4, 1.0, 30.0}) {
    EXPECT_EQ(said_of({recording("a", {1.0}), recording("b", {2.0}), recording("c", {0.5}),
                       recording("d", {drive}, DriveKind::current, 1e3)}),
              force)
        << drive;
  }
}

// 10 mm at 1 Hz with 900 N, by the units of its displacement and force.
Recording in_units(const std::string& file, double metres, double newtons, double drive = 1.0) {
  Recording result = recording(file, {drive}, DriveKind::current, newtons);
  for (double& x : result.displacement) x /= metres;
  for (double& v : result.velocity) v /= metres;
  return result;
}

TEST(BesideOthers, InchesAndPoundsForceThatAreTakenForSi) {
  constexpr double inch = 0.0254;
  constexpr double lbf = 4.4482216152605;
  constexpr double kgf = 9.80665;
  const auto beside = [&](const Recording& odd) {
    return said_of({in_units("a", 1.0, 1.0), in_units("b", 1.2, 1.1), in_units("c", 0.9, 0.9), odd});
  };
  EXPECT_EQ(beside(in_units("d", inch, lbf)),
            Lines{"d: a stroke of 787 mm with a force of 202 N, and 16.7 to 22.2 mm with 818 to 1e+03 N in the other "
                  "recordings, as where the numbers of this one are in inches and pounds-force and taken for m and N: "
                  "check the units of displacement and force"});
  EXPECT_EQ(beside(in_units("d", inch, kgf)).size(), 1U);
  // One in SI among others that are not.
  const Lines among = said_of({in_units("a", inch, lbf), in_units("b", inch, 1.1 * lbf), in_units("c", 1.0, 1.0)});
  ASSERT_EQ(among.size(), 1U);
  EXPECT_NE(among[0].find("the numbers of the others are in inches and pounds-force"), std::string::npos) << among[0];
  // What a damper may do: a longer stroke with a larger force, or with as large a one; a smaller force of a smaller
  // drive; one of the two alone.
  EXPECT_EQ(beside(in_units("d", inch, 1.0 / lbf)), Lines{});
  EXPECT_EQ(beside(in_units("d", inch, 1.0)), Lines{});
  EXPECT_EQ(beside(in_units("d", inch, lbf, 0.1)), Lines{});
  EXPECT_EQ(beside(in_units("d", 1.0, lbf)), Lines{});
  EXPECT_EQ(said_of({in_units("a", 1.0, 1.0), in_units("d", inch, lbf)}), Lines{}) << "of two either may be right";
}

TEST(BesideOthers, ADriveOfTheOtherSign) {
  const auto of = [](const std::vector<double>& drives) {
    std::vector<Recording> all;
    for (const double drive : drives)
      all.push_back(recording(std::string(1, static_cast<char>('a' + all.size())), {drive}));
    return said_of(all);
  };
  EXPECT_EQ(of({0.0, -1.0, 0.5, 1.0, 0.2}),
            Lines{"b: a current of -1 A, and of 0.2 to 1 A in the others: a law in the current takes both signs for "
                  "opposite settings; if the leads were exchanged, correct the sign"});
  EXPECT_EQ(of({0.0, -1.0, -0.5, 1.0, -0.2}),
            Lines{"d: a current of 1 A, and of -1 to -0.2 A in the others: a law in the current takes both signs for "
                  "opposite settings; if the leads were exchanged, correct the sign"});
  // Driven both ways, in several recordings or in one; a level of its own; off.
  EXPECT_EQ(of({-1.0, -0.5, 0.5, 1.0, 1.5}), Lines{});
  EXPECT_EQ(of({-1.0, 0.0, 1.0}), Lines{});
  EXPECT_EQ(of({-0.3, 0.5, 1.0, 2.0}), Lines{});
  EXPECT_EQ(of({-0.01, 0.5, 0.01, 1.0, 1.0}), Lines{});
  EXPECT_EQ(said_of({recording("a", {-1.0}), recording("b", {1.0}), recording("c", {0.5}), recording("d", {1.0}),
                     recording("e", {1.0, -1.0})}),
            Lines{});
}

}  // namespace
}  // namespace hysteron

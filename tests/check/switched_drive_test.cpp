#include "check/switched_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/drive.hpp"
#include "core/random.hpp"

namespace hysteron {
namespace {

Recording with_drive(const std::string& file, std::vector<double> drive) {
  Recording recording;
  recording.file = file;
  recording.drive = std::move(drive);
  recording.drive_kind = DriveKind::current;
  return recording;
}

// `run` samples of each level in turn.
std::vector<double> switched(double low, double high, int run) {
  std::vector<double> drive(400);
  for (int n = 0; n < 400; ++n) drive[static_cast<std::size_t>(n)] = (n / run) % 2 == 0 ? low : high;
  return drive;
}

std::vector<double> noisy(double level, double deviation) {
  const Stream stream(3);
  std::vector<double> drive(400);
  for (std::size_t n = 0; n < drive.size(); ++n) drive[n] = level + deviation * stream.normal(n);
  return drive;
}

// A drive that is simulated at its mean although the device saw two levels is told of.
TEST(SwitchedDrive, IsToldWhereItCountsAsConstant) {
  for (const int run : {3, 5, 7}) {
    const std::vector<double> drive = switched(0.0, 2.0, run);
    ASSERT_FALSE(varies(drive)) << run;
    const auto remarks = remarks_on_switched_drives({with_drive("a.csv", drive)});
    ASSERT_EQ(remarks.size(), 1U) << run;
    EXPECT_EQ(remarks[0].file, "a.csv");
    EXPECT_NE(remarks[0].text.plain().find("the current goes between 0 A and 2 A"), std::string::npos);
  }
  std::vector<double> sine(400);
  for (std::size_t n = 0; n < sine.size(); ++n) {
    sine[n] = 1.0 + std::sin(2.0 * std::numbers::pi * 0.3 * static_cast<double>(n));
  }
  ASSERT_FALSE(varies(sine));
  EXPECT_EQ(remarks_on_switched_drives({with_drive("a.csv", sine)}).size(), 1U);
}

TEST(SwitchedDrive, NoiseIsNone) {
  EXPECT_TRUE(remarks_on_switched_drives({with_drive("a.csv", noisy(0.0, 0.01))}).empty()) << "of a damper without any";
  EXPECT_TRUE(remarks_on_switched_drives({with_drive("a.csv", noisy(1.0, 0.2))}).empty());
  EXPECT_TRUE(
      remarks_on_switched_drives({with_drive("a.csv", switched(0.0, 0.01, 3)), with_drive("b.csv", noisy(1.0, 0.0))})
          .empty())
      << "a last digit that flickers";
  EXPECT_TRUE(remarks_on_switched_drives({with_drive("a.csv", switched(0.0, 2.0, 40))}).empty()) << "is followed";
}

}  // namespace
}  // namespace hysteron

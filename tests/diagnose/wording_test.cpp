#include "diagnose/search/wording.hpp"

#include <gtest/gtest.h>

#include "diagnose/search/relatives.hpp"
#include "simulate/part.hpp"

namespace hysteron {
namespace {

TEST(Worded, FollowsTheDriveOfTheRecordings) {
  const std::string_view text = "equally far at any speed[ and current]; [two currents|two speeds]";
  EXPECT_EQ(worded(text, DriveKind::current), "equally far at any speed and current; two currents");
  EXPECT_EQ(worded(text, DriveKind::voltage), "equally far at any speed and voltage; two voltages");
  EXPECT_EQ(worded(text, DriveKind::none), "equally far at any speed; two speeds");
}

// A damper without a drive is given no advice on currents: what a card says of the drive stands in brackets, unless the
// effect needs one.
TEST(Worded, NoCardAdvisesOnCurrentsWithoutADrive) {
  for (const Part* effect : effect_catalogue()) {
    const Knowledge& known = knowledge_of(effect->id);
    const bool needs_drive = std::ranges::any_of(known.needs, [](Need need) {
      return need == Need::drive || need == Need::changing_drive || need == Need::returning_drive ||
             need == Need::three_drive_levels;
    });
    if (needs_drive) {
      continue;
    }
    for (const std::string_view text : {known.shows, known.experiment}) {
      EXPECT_EQ(worded(text, DriveKind::none).find("current"), std::string::npos) << effect->id << ": " << text;
    }
  }
}

TEST(Percent, IsAHundredForAllAndNoLess) {
  EXPECT_EQ(percent(0.071), "7 %");
  EXPECT_EQ(percent(0.994), "99 %");
  EXPECT_EQ(percent(0.9996), "over 99 %");
  EXPECT_EQ(percent(1.0), "100 %");
}

TEST(SizeText, IsInTheUnitThatItsNumberIsShortIn) {
  EXPECT_EQ(size_text(4.0e-4, "m", 2), "0.40 mm");
  EXPECT_EQ(size_text(0.25, "m", 2), "0.25 m");
  EXPECT_EQ(size_text(-0.0058, "s", 2), "-5.8 ms");
  EXPECT_EQ(size_text(12345.0, "N s/m", 3), "12.3 kN s/m");
  EXPECT_EQ(size_text(9.1e7, "N/m^3", 2), "91 MN/m^3");
  EXPECT_EQ(size_text(8.04, "kg", 2), "8.0 kg");
  EXPECT_EQ(size_text(0.14, "1", 2), "0.14");
  EXPECT_EQ(size_text(1.23e-6, "1/J", 2), "1.2e-6 1/J");
  EXPECT_EQ(size_text(620.0, "N/A", 3), "620 N A^-1") << "newtons per ampere are not 'N/A'";
  EXPECT_EQ(size_text(620.0, "N/V/V", 3), "620 N V^-2");
}

}  // namespace
}  // namespace hysteron

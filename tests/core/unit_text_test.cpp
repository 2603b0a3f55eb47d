#include "core/unit_text.hpp"

#include <gtest/gtest.h>

namespace hysteron {
namespace {

TEST(UnitText, LawsInTheDriveHaveTheirDriveInTheUnit) {
  EXPECT_EQ(term_unit("N", 0, 0, DriveKind::none), "N");
  EXPECT_EQ(term_unit("N", 1, 0, DriveKind::current), "N/A");
  EXPECT_EQ(term_unit("N s/m", 2, 1, DriveKind::voltage), "N s/m/V/V/Hz");
}

TEST(UnitText, NewtonsPerAmpereAreNotNotAvailable) {
  EXPECT_EQ(unit_text("N"), "N");
  EXPECT_EQ(unit_text("N/m"), "N/m");
  EXPECT_EQ(unit_text("N/A"), "N A^-1");
  EXPECT_EQ(unit_text("N s/m/V/V"), "N s/m V^-2");
}

}  // namespace
}  // namespace hysteron

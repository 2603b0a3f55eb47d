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
  EXPECT_EQ(unit_text("N s/m/V/V"), "N s m^-1 V^-2");
  EXPECT_EQ(unit_text("N/m^3/A"), "N m^-3 A^-1");
  EXPECT_EQ(unit_text("1/m/A/Hz"), "m^-1 A^-1 Hz^-1");
  EXPECT_EQ(unit_text("m/(N s)/A"), "m/(N s) A^-1");
  EXPECT_EQ(unit_text("1/A^2/A"), "A^-3");
  EXPECT_EQ(unit_text("N s/m/degC/degC"), "N s m^-1 degC^-2");
  for (const char* stays : {"N/Pa", "N/(l/min)"}) EXPECT_EQ(unit_text(stays), stays);
  for (const char* stays : {"N/m^x/A", "N/m^/A", "N/m^-2/A", "N/m^99999999999/A"}) EXPECT_EQ(unit_text(stays), stays);
}

TEST(UnitText, OfAConditionStandsBehindPer) {
  EXPECT_EQ(per_text("degC", "temperature", 1), "°C");
  EXPECT_EQ(per_text("Pa", "pressure", 2), "Pa^2");
  EXPECT_EQ(per_text("l/min", "flow", 2), "(l/min)^2");
  EXPECT_EQ(per_text("", "valve", 1), "unit of valve");
  EXPECT_EQ(per_text("", "valve", 2), "(unit of valve)^2");
}

}  // namespace
}  // namespace hysteron

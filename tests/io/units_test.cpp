#include "io/units.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

struct UnitCase {
  Quantity quantity;
  const char* text;
  double value;
  double inside;
};

TEST(Units, ConvertToSiAndBack) {
  const UnitCase cases[] = {
      {Quantity::time, "s", 2.0, 2.0},
      {Quantity::time, "ms", 2.0, 2e-3},
      {Quantity::time, "us", 2.0, 2e-6},
      {Quantity::time, "\xC2\xB5s", 2.0, 2e-6},
      {Quantity::time, "ns", 2.0, 2e-9},
      {Quantity::time, "min", 2.0, 120.0},
      {Quantity::displacement, "m", 1.0, 1.0},
      {Quantity::displacement, "mm", 25.0, 0.025},
      {Quantity::displacement, "cm", 1.0, 0.01},
      {Quantity::displacement, "um", 3.0, 3e-6},
      {Quantity::displacement, "\xCE\xBCm", 3.0, 3e-6},
      {Quantity::displacement, "in", 1.0, 0.0254},
      {Quantity::displacement, "ft", 1.0, 0.3048},
      {Quantity::displacement, "in.", 1.0, 0.0254},
      {Quantity::displacement, "\xC2\xA0mm\xC2\xA0", 1.0, 1e-3},
      {Quantity::velocity, "in./s", 1.0, 0.0254},
      {Quantity::time, "min.", 1.0, 60.0},
      {Quantity::velocity, "m/s", 1.0, 1.0},
      {Quantity::velocity, "mm/s", 1.0, 1e-3},
      {Quantity::velocity, "cm/s", 1.0, 1e-2},
      {Quantity::velocity, "in/s", 1.0, 0.0254},
      {Quantity::acceleration, "m/s^2", 1.0, 1.0},
      {Quantity::acceleration, "m/s2", 1.0, 1.0},
      {Quantity::acceleration, "m/s\xC2\xB2", 1.0, 1.0},
      {Quantity::acceleration, "mm/s^2", 1.0, 1e-3},
      {Quantity::acceleration, "g", 1.0, 9.80665},
      {Quantity::force, "N", 1.0, 1.0},
      {Quantity::force, "kN", 1.5, 1500.0},
      {Quantity::force, "MN", 1.0, 1e6},
      {Quantity::force, "mN", 1.0, 1e-3},
      {Quantity::force, "daN", 1.0, 10.0},
      {Quantity::force, "lbf", 1.0, 4.4482216152605},
      {Quantity::force, "lb", 1.0, 4.4482216152605},
      {Quantity::force, "kip", 1.0, 4448.2216152605},
      {Quantity::force, "kgf", 1.0, 9.80665},
      {Quantity::current, "A", 1.0, 1.0},
      {Quantity::current, "mA", 500.0, 0.5},
      {Quantity::voltage, "V", 1.0, 1.0},
      {Quantity::voltage, "mV", 1.0, 1e-3},
      {Quantity::temperature, "degC", 20.0, 20.0},
      {Quantity::temperature,
       "\xC2\xB0"
       "C",
       20.0, 20.0},
      {Quantity::temperature,
       "\xB0"
       "C",
       20.0, 20.0},
      {Quantity::temperature,
       "\xB0"
       "F",
       68.0, 20.0},
      {Quantity::displacement, "\xB5m", 3.0, 3e-6},
      {Quantity::acceleration, "m/s\xB2", 1.0, 1.0},
      {Quantity::temperature, "K", 293.15, 20.0},
      {Quantity::temperature, "degF", 68.0, 20.0},
  };
  for (const auto& c : cases) {
    const auto unit = find_unit(c.quantity, c.text);
    ASSERT_TRUE(unit) << c.text;
    EXPECT_NEAR(unit->to_si(c.value), c.inside, 1e-13 * std::abs(c.inside)) << c.text;
    EXPECT_NEAR(unit->from_si(unit->to_si(c.value)), c.value, 1e-12 * std::abs(c.value)) << c.text;
  }
}

TEST(Units, SimilarOnesAreOffered) {
  const auto of = [](Quantity quantity, const char* text) {
    return testing::message_of<InputError>([&] { (void)parse_unit(quantity, text, "a.csv", 1); });
  };
  const std::string forces = ", expected one of N, kN, MN, daN, mN, lbf, lb, kip, kgf";
  EXPECT_EQ(of(Quantity::force, "KN"), "a.csv:1: unknown unit 'KN' of force (did you mean kN?)" + forces);
  EXPECT_EQ(of(Quantity::force, "kn"), "a.csv:1: unknown unit 'kn' of force (did you mean kN?)" + forces);
  EXPECT_EQ(of(Quantity::force, "mn"), "a.csv:1: unknown unit 'mn' of force (did you mean MN or mN?)" + forces);
  EXPECT_EQ(of(Quantity::force, "N/mm"), "a.csv:1: unknown unit 'N/mm' of force" + forces);
  EXPECT_EQ(of(Quantity::displacement, "MM"),
            "a.csv:1: unknown unit 'MM' of displacement (did you mean mm?), expected one of m, mm, cm, um, in, ft");
  EXPECT_EQ(similar_units(Quantity::velocity, "MM/S"), std::vector<std::string>{"mm/s"});
  EXPECT_EQ(similar_units(Quantity::temperature, "deg C"), std::vector<std::string>{"degC"});
}

TEST(Units, RefuseWhatIsNoUnitOfTheQuantity) {
  EXPECT_FALSE(find_unit(Quantity::force, "mm"));
  EXPECT_FALSE(find_unit(Quantity::force, "n"));
  EXPECT_FALSE(find_unit(Quantity::displacement, "min"));
  EXPECT_FALSE(find_unit(Quantity::displacement, ""));
  EXPECT_FALSE(find_unit(Quantity::velocity, "/s"));
  EXPECT_FALSE(find_unit(Quantity::force, "kkN"));
  EXPECT_EQ(testing::message_of<InputError>([] { (void)parse_unit(Quantity::force, "stone", "a.csv", 1); }),
            "a.csv:1: unknown unit 'stone' of force, expected one of N, kN, MN, daN, mN, lbf, lb, kip, kgf");
  EXPECT_EQ(testing::message_of<InputError>([] { (void)parse_unit(Quantity::time, "fortnight"); }),
            "unknown unit 'fortnight' of time, expected one of s, ms, us, min, h");
}

}  // namespace
}  // namespace hysteron

// What laws follow beside drive and frequency: columns and numbers of recordings, their units, and what is refused.
#include "io/conditions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "io/campaign.hpp"
#include "io/clock_time.hpp"
#include "io/condition_faults.hpp"
#include "io/csv.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

const std::string schema = "schema = \"hysteron.campaign/1\"\n";

// Twenty rows of a motion with another column, whose values are value(n).
template <class Value>
std::string with_column(const std::string& head, Value value) {
  std::string text = "time [s],displacement [mm],force [N]" + (head.empty() ? "" : "," + head) + "\n";
  for (int n = 0; n < 20; ++n) {
    text += std::to_string(0.1 * n) + "," + std::to_string(std::sin(0.7 * n)) + "," + std::to_string(n % 5);
    text += head.empty() ? "\n" : "," + value(n) + "\n";
  }
  return text;
}
std::string plain() {
  return with_column("", [](int) { return std::string(); });
}

ReadOptions following(std::vector<std::string> names) {
  ReadOptions options;
  options.conditions = std::move(names);
  return options;
}

TEST(Conditions, UnitsOfEveryKindBecomeSi) {
  const auto inside = [](const char* text) { return condition_number(text)->value; };
  EXPECT_DOUBLE_EQ(inside("2.1 bar"), 2.1e5);
  EXPECT_DOUBLE_EQ(inside("3 mbar"), 300.0);
  EXPECT_NEAR(inside("1 psi"), 6894.757293168361, 1e-9);  // NIST SP 811
  EXPECT_DOUBLE_EQ(inside("20 lbf"), 20.0 * 4.4482216152605);
  EXPECT_DOUBLE_EQ(inside("25 mm"), 0.025);
  EXPECT_DOUBLE_EQ(inside("300 K"), 300.0 - 273.15);
  EXPECT_EQ(condition_number("4.5 turns")->unit, "turns");
  EXPECT_EQ(condition_number("4.5 turns")->value, 4.5);
  EXPECT_EQ(condition_number("2.1 bar")->unit, "Pa");
  EXPECT_EQ(condition_number("7")->unit, "");
  for (const char* text : {"", "bar", "nan", "inf", "1e999", "1e30 bar", "--1"}) {
    EXPECT_FALSE(condition_number(text)) << text;
  }
}

TEST(Conditions, WhatFollowsANumberIsAUnitOfTheCondition) {
  EXPECT_EQ(fault_of_condition("temperature", "10,5 degC"),
            "'10,5 degC' of 'temperature' has a comma in its number, expected a decimal point");
  EXPECT_EQ(fault_of_condition("run", "1,5").find("'1,5' of 'run' has a comma"), 0U);
  for (const char* text : {"10-12 turns", "10..12", "10 \xC2\xB1 1", "4 (of 5)", "3 [bar]"}) {
    EXPECT_NE(fault_of_condition("valve", text).find("behind its number, which is no unit"), std::string::npos) << text;
  }
  EXPECT_EQ(fault_of_condition("oil temperature", "10 bar"),
            "'10 bar' of 'oil temperature' has a unit of another quantity, expected one of degC, K, degF");
  for (const auto& [name, text] : {std::pair("pressure", "2 mm"),
                                   {"hours", "3 km"},
                                   {"hours", "2 bar"},
                                   {"voltage", "3 A"},
                                   {"current", "3 V"},
                                   {"valve frequency", "3 s"}}) {
    EXPECT_NE(fault_of_condition(name, text).find("a unit of another quantity"), std::string::npos)
        << name << " " << text;
  }
  for (const auto& [name, text] : {std::pair("temperature", "10 degC"),
                                   {"temperature", "283 K"},
                                   {"temperature", "-5"},
                                   {"pressure", "2 barg"},
                                   {"valve", "30 %"},
                                   {"valve", "3 bar"},
                                   {"crank", "60 1/min"},
                                   {"hours", "2.5 h"},
                                   {"frequency", "2 Hz"},
                                   {"current", "500 mA"},
                                   {"angle", "30 \xC2\xB0"},
                                   {"valve", "open"}}) {
    EXPECT_EQ(fault_of_condition(name, text), "") << name << " " << text;
  }
  const TemporaryFolder folder;
  folder.write("r1.csv", plain());
  const auto path =
      folder.write("campaign.toml", schema + "[[recording]]\nfile = \"r1.csv\"\ntemperature = \"10,5 degC\"\n");
  EXPECT_EQ(message_of<InputError>([&] { (void)load_campaign({folder.path().string()}); }),
            path.string() + ":4: '10,5 degC' of 'temperature' has a comma in its number, expected a decimal point");
}

TEST(Conditions, TwoUnitsOfOneColumnAreRefused) {
  std::string text = with_column("valve [bar]", [](int) { return std::string("1"); });
  text.insert(text.find('\n') + 1, "s,mm,N,kPa\n");
  EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv(text, "a.csv", following({"valve"})); }),
            "a.csv:2: column 'valve [bar]' is given in 'bar' and in 'kPa', expected one unit, or column "
            "valve=\"valve [UNIT]\" to choose");
  EXPECT_EQ(parse_csv(text, "a.csv").size(), 20U) << "nothing follows it";
}

TEST(Conditions, NamesOfTheMotionAreRefused) {
  EXPECT_EQ(condition_name(" Pressure ", "--by"), "pressure");
  EXPECT_EQ(condition_name("temp", "--by"), "temperature");
  for (const char* name : {"time", "x", "velocity", "F", "a", "base"}) {
    EXPECT_THROW(static_cast<void>(condition_name(name, "--by")), InputError) << name;
  }
}

TEST(Conditions, AColumnIsKeptWithItsValues) {
  const auto value = [](int n) { return std::to_string(1.0 + 0.25 * (n / 10)); };
  const Recording recording = parse_csv(with_column("Pressure [bar]", value), "r.csv", following({"pressure"}));
  ASSERT_EQ(recording.conditions.size(), 1U);
  EXPECT_EQ(recording.conditions[0].unit, "Pa");
  ASSERT_EQ(recording.conditions[0].values.size(), 20U);
  EXPECT_DOUBLE_EQ(recording.conditions[0].values[0], 1e5);
  EXPECT_DOUBLE_EQ(recording.conditions[0].values[19], 1.25e5);
  EXPECT_TRUE(recording.unused.empty());
}

TEST(Conditions, AConstantColumnIsTheNumberItself) {
  const auto value = [](int) { return std::string("0.1"); };
  const Recording column = parse_csv(with_column("valve", value), "r.csv", following({"valve"}));
  ReadOptions options = following({"valve"});
  options.numbers["valve"] = *condition_number("0.1");
  const Recording number = parse_csv(plain(), "r.csv", options);
  ASSERT_EQ(column.conditions.size(), 1U);
  EXPECT_EQ(column.conditions[0].values, std::vector<double>{0.1});
  EXPECT_EQ(number.conditions[0].values, column.conditions[0].values);
}

TEST(Conditions, AveragesOfManySamplesAreThoseOfTheBlocks) {
  ConditionMeans means(3);
  for (const double value : {1.0, 2.0, 6.0, 4.0, 4.0, 4.0, 9.0}) means.add(value);
  EXPECT_EQ(means.take(), (std::vector<double>{3.0, 4.0}));
}

TEST(Conditions, WhatIsMissingOrTwiceIsRefusedInOneLine) {
  const auto reads = [](const std::string& text, const ReadOptions& options) {
    return message_of<InputError>([&] { static_cast<void>(parse_csv(text, "r.csv", options)); });
  };
  EXPECT_NE(reads(plain(), following({"pressure"})).find("r.csv:1: no column 'pressure', which parameters follow"),
            std::string::npos);
  const std::string oil = with_column("Oil pressure [bar]", [](int) { return std::string("1"); });
  EXPECT_NE(reads(oil, following({"pressure"})).find("column pressure='Oil pressure'"), std::string::npos)
      << "a column that is likely meant is offered";
  ReadOptions both = following({"pressure"});
  both.numbers["pressure"] = {1.0, "Pa", "campaign.toml", 7};
  const std::string column = with_column("pressure [Pa]", [](int) { return std::string("1"); });
  EXPECT_EQ(reads(column, both),
            "campaign.toml:7: 'pressure' is given for 'r.csv', which has a column of it, expected one");
  const std::string words = with_column("pressure [Pa]", [](int n) { return std::string(n == 3 ? "high" : "1"); });
  EXPECT_EQ(reads(words, following({"pressure"})),
            "r.csv:5: pressure 'high' is not a number, expected a finite number");
  const std::string voltage = with_column("voltage [V]", [](int) { return std::string("1"); });
  EXPECT_NE(reads(voltage, following({"voltage"})).find("expected by current"), std::string::npos);
}

TEST(Conditions, ACampaignGivesNumbersAndLaws) {
  const TemporaryFolder folder;
  folder.write("r1.csv", plain());
  folder.write("r2.csv", plain());
  folder.write("campaign.toml",
               schema +
                   "[by.pressure]\nc0 = 1\n[by.current]\nalpha = 2\n"
                   "[[recording]]\nfile = \"r1.csv\"\npressure = \"2 bar\"\ncurrent = 1\nrun = 7\n"
                   "[[recording]]\nfile = \"r2.csv\"\npressure = 3e5\ncurrent = \"500 mA\"\nrun = 8\n");
  const Campaign campaign = load_campaign({folder.path().string()});
  EXPECT_EQ(campaign.by.at("pressure"), (LawOrders{{"c0", 1}}));
  EXPECT_EQ(campaign.by_current, (LawOrders{{"alpha", 2}}));
  for (const std::size_t k : {0U, 1U}) {
    const Recording& recording = campaign.recordings[k];
    ASSERT_EQ(recording.conditions.size(), 1U);
    EXPECT_EQ(recording.conditions[0].unit, "Pa");  // a number without a unit has that of the others
    EXPECT_EQ(recording.conditions[0].values, std::vector<double>{k == 0 ? 2e5 : 3e5});
    EXPECT_EQ(recording.drive_kind, DriveKind::current);
    EXPECT_EQ(recording.drive, std::vector<double>(20, k == 0 ? 1.0 : 0.5));
    ASSERT_EQ(recording.unused.size(), 1U);  // that no law follows, for diagnose
    EXPECT_EQ(recording.unused[0].name, "run");
    EXPECT_EQ(recording.unused[0].mean, k == 0 ? 7.0 : 8.0);
  }
}

TEST(Conditions, AColumnWithoutAUnitBesideOneWithAUnitIsRefused) {
  const TemporaryFolder folder;
  folder.write("r1.csv", with_column("pressure [bar]", [](int) { return std::string("2"); }));
  folder.write("r2.csv", with_column("pressure", [](int) { return std::string("2"); }));
  folder.write("campaign.toml", schema + "[by.pressure]\nc0 = 1\n");
  const std::string message =
      message_of<InputError>([&] { static_cast<void>(load_campaign({folder.path().string()})); });
  EXPECT_NE(message.find("r2.csv: 'pressure' has no unit, and is in 'Pa' in 'r1.csv', expected its unit in "
                         "all recordings or in none"),
            std::string::npos)
      << message;
}

TEST(Conditions, UnitsThatCannotBeConvertedMustAgree) {
  const TemporaryFolder folder;
  folder.write("r1.csv", plain());
  folder.write("r2.csv", plain());
  const auto message = [&](const std::string& one, const std::string& other) {
    folder.write("campaign.toml", schema + "[by.valve]\nc0 = 1\n[[recording]]\nfile = \"r1.csv\"\nvalve = " + one +
                                      "\n[[recording]]\nfile = \"r2.csv\"\nvalve = " + other + "\n");
    return message_of<InputError>([&] { static_cast<void>(load_campaign({folder.path().string()})); });
  };
  EXPECT_NE(message("\"2 turns\"", "\"3 mm\"").find("'valve' is given in 'm' and in line"), std::string::npos);
  EXPECT_NE(message("\"50 %\"", "0.2").find("'valve' is given without a unit and in line"), std::string::npos);
  EXPECT_NE(message("\"50 %\"", "0.2").find("in '%', expected one unit"), std::string::npos);
}

TEST(ClockTime, IsThatOfTheCalendar) {
  EXPECT_EQ(clock_time("1970-01-01T00:00:00Z"), 0.0);
  EXPECT_EQ(clock_time("2000-03-01T12:00"), 951912000.0);
  EXPECT_EQ(clock_time("2026-11-24 14:50:58.5"), clock_time("2026-11-24T15:50:58.5+01:00"));
  for (const char* text :
       {"", "2026-13-01T00:00", "2026-02-30T00:00", "24.11.2026 14:50", "2026-11-24", "2026-11-24T25:00"}) {
    EXPECT_FALSE(clock_time(text)) << text;
  }
  EXPECT_TRUE(clock_time_in("# Start: 2026-11-24T14:50:58"));
  EXPECT_FALSE(clock_time_in("# calibrated: 2026-11-24T14:50:58"));
}

// Of every recording, in the file or in campaign.toml: seconds since the first, for diagnose.
TEST(ClockTime, OfAllRecordingsIsKeptBesideTheUnusedColumns) {
  const TemporaryFolder folder;
  folder.write("r1.csv", "# start: 2026-11-24T10:00:30\n" + plain());
  folder.write("r2.csv", plain());
  const std::string head = schema + "[[recording]]\nfile = \"r1.csv\"\n[[recording]]\nfile = \"r2.csv\"\n";
  folder.write("campaign.toml", head);
  EXPECT_TRUE(load_campaign({folder.path().string()}).recordings[0].unused.empty());
  folder.write("campaign.toml", head + "start = 2026-11-24T10:00:00\n");
  const Campaign campaign = load_campaign({folder.path().string()});
  ASSERT_EQ(campaign.recordings[0].unused.size(), 1U);
  EXPECT_EQ(campaign.recordings[0].unused[0].name, "clock [s]");
  EXPECT_EQ(campaign.recordings[0].unused[0].mean, 30.0);
  EXPECT_EQ(campaign.recordings[1].unused[0].mean, 0.0);
}

TEST(WithoutTime, StepsAreEqualAndTheOrderIsKept) {
  std::string text = "displacement [mm],force [N]\n";
  for (int n = 0; n < 20; ++n) text += std::to_string(n < 10 ? n : 19 - n) + ",1\n";
  EXPECT_NE(message_of<InputError>([&] { static_cast<void>(parse_csv(text, "r.csv", {})); }).find("no time column"),
            std::string::npos);
  ReadOptions options;
  options.without_time = true;
  const Recording recording = parse_csv(text, "r.csv", options);
  EXPECT_FALSE(recording.timed);
  ASSERT_EQ(recording.size(), 20U);
  EXPECT_NEAR(recording.time[1], 0.01, 1e-12);  // 1 mm at 0.1 m/s
  EXPECT_TRUE(parse_csv(plain(), "r.csv", options).timed);
}

}  // namespace
}  // namespace hysteron

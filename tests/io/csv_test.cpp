#include "io/csv.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::ten_rows;

const std::string header = "time [s],displacement [mm],force [N]\n";

ReadOptions mapped(std::map<std::string, std::string> columns) { return {std::move(columns), true}; }

TEST(Csv, ReadsNamesAndUnits) {
  const auto r = parse_csv("# a comment\n\nTime (ms), DISP [in] ,Load [kip]\n" + ten_rows(), "a.csv");
  ASSERT_EQ(r.size(), 10U);
  EXPECT_DOUBLE_EQ(r.time[1], 1e-4);
  EXPECT_DOUBLE_EQ(r.displacement[3], 9 * 0.0254);
  EXPECT_DOUBLE_EQ(r.force[2], 20 * 4448.2216152605);
  EXPECT_FALSE(r.velocity_measured);
  EXPECT_EQ(r.velocity.size(), 10U);
  EXPECT_EQ(r.drive_kind, DriveKind::none);
  EXPECT_TRUE(r.drive.empty());
}

// What the readers remark of a text, line by line.
std::string remarks_of(const std::string& text, ReadOptions options = {}) {
  std::string said;
  options.remark = [&](const Remark& remark) {
    if (remark.kind == Remark::Kind::dialect) said += remark.text.plain() + "\n";
  };
  EXPECT_EQ(parse_csv(text, "a.csv", options).size(), 10U);
  return said;
}

TEST(Csv, ExportsOfRigsAreReadAsTheyAre) {
  const std::string ten = ten_rows();
  EXPECT_EQ(remarks_of(header + ten), "");
  EXPECT_EQ(remarks_of("# start: 2026-11-24T14:50:58\n" + header + ten), "");
  EXPECT_EQ(remarks_of("# date: 24.11.2026\n" + header + ten), "") << "a date starts nothing";
  EXPECT_NE(
      remarks_of("# start: 24.11.2026 14:50:58\n" + header + ten).find("the start '24.11.2026 14:50:58' is not read"),
      std::string::npos);
  EXPECT_EQ(remarks_of("Total Time (s),Axial_Position (mm),Load (pounds)\n" + ten),
            "'Total Time (s)' is taken for the time\n'Axial_Position (mm)' is taken for the displacement\n");
  EXPECT_EQ(remarks_of("Time (Sec),Crosshead (Inches),Load Cell (LBF)\n" + ten), "");
  const auto pounds = parse_csv("Total Time (s),Position (mm),Load (Pounds)\n" + ten, "a.csv");
  EXPECT_DOUBLE_EQ(pounds.force[2], 20 * 4.4482216152605);
  // A name of its own goes before a last word.
  const auto both =
      parse_csv("time [s],command position [mm],x [mm],force [N]\n" +
                    std::string("0,9,1,2\n1,9,1,2\n2,9,1,2\n3,9,1,2\n4,9,1,2\n5,9,1,2\n6,9,1,2\n7,9,1,2\n"),
                "a.csv");
  EXPECT_EQ(both.displacement[0], 1e-3);
  EXPECT_EQ(
      message_of<InputError>([&] { (void)parse_csv("time,upper position,lower position,force\n1,2,3,4\n", "a.csv"); }),
      "a.csv:1: 2 columns may be the displacement ('upper position', 'lower position'), expected one, or "
      "column displacement=NAME to choose");
}

TEST(Csv, CurrentsOfWhichNoneIsReadAreTold) {
  std::string rows;
  for (int n = 0; n < 10; ++n) rows += fmt::format("{},{},{},{},{}\n", n, n * n, 10 * n, 1, 2);
  const std::string motion = "time [s],displacement [mm],force [N],";
  EXPECT_EQ(remarks_of(motion + "coil 1 current [A],coil 2 current [A]\n" + rows),
            "2 columns may be the current ('coil 1 current [A]', 'coil 2 current [A]') and none is read; column "
            "current=NAME chooses\n");
  EXPECT_EQ(remarks_of(motion + "current coil 1 [mA],lot\n" + rows),
            "'current coil 1 [mA]' may be the current and is not read; column current=NAME chooses\n");
  EXPECT_EQ(remarks_of(motion + "current [A],pump current [A]\n" + rows), "") << "one is named alone";
  EXPECT_EQ(remarks_of(motion + "current cycle [min],lot\n" + rows), "") << "no unit of a current";
}

// What was asked for or worked out is nothing that was measured.
TEST(Csv, MeasuredColumnsGoBeforeCommandedOnes) {
  std::string rows;
  for (int n = 0; n < 10; ++n) rows += fmt::format("{},{},{},{}\n", n, 9, n * n, 10 * n);
  EXPECT_EQ(remarks_of("time [s],command position [mm],actual position [mm],force [N]\n" + rows),
            "'actual position [mm]' is taken for the displacement, not 'command position [mm]'\n");
  EXPECT_EQ(remarks_of("time [s],command position [mm],LVDT feedback [mm],force [N]\n" + rows),
            "'LVDT feedback [mm]' is taken for the displacement, not 'command position [mm]'\n");
  EXPECT_EQ(remarks_of("time [s],command position [mm],position error [mm],force [N]\n" + rows),
            "'command position [mm]' is taken for the displacement, not 'position error [mm]', which has a unit of it; "
            "column displacement=NAME chooses\n");
  EXPECT_EQ(remarks_of("time [s],computed force [N],x [mm],load_cell [N]\n" + rows), "");
  EXPECT_EQ(parse_csv("time [s],computed force [N],x [mm],load_cell_N\n" + rows, "a.csv").force[2], 20.0);
  EXPECT_EQ(
      remarks_of("time [s],computed force [N],x [mm],Reaction [N]\n" + rows),
      "'computed force [N]' is taken for the force, not 'Reaction [N]', which has a unit of it; column force=NAME "
      "chooses\n");
  EXPECT_EQ(remarks_of("time [s],computed force [N],x [mm],Reaction [V]\n" + rows),
            "'computed force [N]' is taken for the force\n");
}

// The number of a run would be followed as the current.
TEST(Csv, AColumnWithoutAUnitBesideOneOfTheChannelIsTold) {
  std::string rows;
  for (int n = 0; n < 10; ++n) rows += fmt::format("{},{},{},{},{}\n", n, n * n, 10 * n, 7, 0.5);
  const auto said = [&](const std::string& names) {
    return remarks_of("time [s],x [mm],F [N]," + names + "\n" + rows);
  };
  EXPECT_EQ(said("current,coil current [A]"),
            "'current', without a unit, is taken for the current, and 'coil current [A]' has a unit of one; column "
            "current=NAME chooses\n");
  EXPECT_EQ(said("current [A],coil current [A]"), "");
  EXPECT_EQ(said("current,coil current"), "");
  EXPECT_EQ(said("current,coil [A]"), "");
}

TEST(Csv, UnitsStandBehindInOrAComma) {
  const std::string ten = ten_rows();
  for (const char* names : {"Time in s,Displacement in mm,Force in kN", "Zeit in s,Weg in mm,Kraft in kN",
                            "\"Time, s\",\"Displacement, mm\",\"Force, kN\""}) {
    const Recording recording = parse_csv(names + ("\n" + ten), "a.csv");
    EXPECT_DOUBLE_EQ(recording.displacement[3], 9e-3) << names;
    EXPECT_DOUBLE_EQ(recording.force[2], 20e3) << names;
  }
  EXPECT_EQ(split_column("Force in clevis").unit, "");
  EXPECT_EQ(split_column("Axial Force in kN").name, "Axial Force");
}

TEST(Csv, ARotationIsNoVelocityOfTheRod) {
  std::string rows;
  for (int n = 0; n < 10; ++n) rows += fmt::format("{},{},{},{}\n", n, n * n, 10 * n, 60);
  EXPECT_EQ(remarks_of("time [s],x [mm],F [N],speed [rpm]\n" + rows),
            "'speed [rpm]' is not read as the velocity: its unit is one of a rotation\n");
  EXPECT_FALSE(parse_csv("time [s],x [mm],F [N],speed [rpm]\n" + rows, "a.csv").velocity_measured);
  EXPECT_NE(message_of<InputError>([&] {
              (void)parse_csv("time [s],x [mm],F [N],speed [knots]\n" + rows, "a.csv");
            }).find("unknown unit 'knots' of velocity"),
            std::string::npos);
}

TEST(Csv, LinesBeforeTheHeaderAreNotRead) {
  const std::string ten = ten_rows();
  const std::string said = "the header is taken from line 5, lines before it are not read\n";
  EXPECT_EQ(remarks_of("Station: 3\nOperator: Jane\n3/2/2024, 12:40, wet\n\n" + header + ten), said);
  const std::string second = "the header is taken from line 2, lines before it are not read\n";
  for (const char* title : {"Force,Damper 7,wet\n", "Load,12,7\n", "Load test,7\n"}) {
    EXPECT_EQ(remarks_of(title + header + ten), second) << title;
    EXPECT_EQ(remarks_of(title + std::string("t,x,F\ns,mm,N\n") + ten), second) << title;
  }
}

TEST(Csv, ChannelsMayBeNamedInOtherLanguages) {
  for (const char* names : {"Zeit [s];Weg [mm];Kraft [kN]", "temps (s);Déplacement (mm);force (kN)",
                            "tempo [s];spostamento [mm];forza [kN]", "Tiempo [s];Desplazamiento [mm];Fuerza [kN]"}) {
    std::string text = std::string(names) + "\n";
    for (int n = 0; n < 10; ++n) text += std::to_string(n) + ";" + std::to_string(n) + ",5;1,25\n";
    const Recording recording = parse_csv(text, "a.csv");
    EXPECT_DOUBLE_EQ(recording.displacement[3], 3.5e-3) << names;
    EXPECT_DOUBLE_EQ(recording.force[3], 1250.0) << names;
  }
}

// Names of another language are told by the row of units below them, and mapped by their names.
TEST(Csv, NamesNobodyKnowsStandAboveTheirUnits) {
  const std::string text = "Aika,Matka,Voima\ns,mm,kN\n" + ten_rows();
  EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv(text, "a.csv"); }),
            "a.csv:2: no time column, expected one named time, t (or its German, French, Italian or Spanish word), or "
            "column time=NAME; the columns are 'Aika', 'Matka', "
            "'Voima'");
  ReadOptions options;
  options.columns = {{"time", "Aika"}, {"displacement", "Matka"}, {"force", "Voima"}};
  EXPECT_EQ(remarks_of(text, options), "");
  EXPECT_EQ(parse_csv(text, "a.csv", options).force[2], 20e3);
}

TEST(Csv, LinesAreSkippedWhereThatIsAsked) {
  ReadOptions options;
  options.skip = 2;
  EXPECT_EQ(remarks_of("x,t,F\n1,2,3\n" + header + ten_rows(), options),
            "the first 2 lines are not read, as skip says\n");
  options.skip = 50;
  EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv(header + ten_rows(), "a.csv", options); }),
            "a.csv: skip 50 leaves nothing of the file, expected fewer lines");
}

// Semicolons and tabs with decimal points are as plain as commas.
TEST(Csv, DecimalCommasAndSkippedLinesAreToldInOneRemark) {
  const auto table = [](const std::string& separator, const std::string& mark, const std::string& quote) {
    std::string text = "time [s]" + separator + "displacement [mm]" + separator + "force [N]\n";
    for (int n = 0; n < 10; ++n) {
      for (const char* behind : {separator.c_str(), separator.c_str(), "\n"}) {
        text += quote + std::to_string(n) + mark + "5" + quote + behind;
      }
    }
    return text;
  };
  for (const char* separator : {",", ";", "\t"}) EXPECT_EQ(remarks_of(table(separator, ".", "")), "") << separator;
  EXPECT_EQ(remarks_of(table(";", ",", "")),
            "numbers are read with decimal commas, columns as separated by semicolons\n");
  EXPECT_EQ(remarks_of(table("\t", ",", "")), "numbers are read with decimal commas, columns as separated by tabs\n");
  EXPECT_EQ(remarks_of(table(",", ",", "\"")),
            "numbers are read with decimal commas, columns as separated by commas outside of quotes\n");
  ReadOptions options;
  options.skip = 1;
  EXPECT_EQ(remarks_of("1;2;3\n" + table(";", ",", ""), options),
            "the first line is not read, as skip says; numbers are read with decimal commas, columns as separated by "
            "semicolons\n");
}

// A frequency beside a force of another name would be fitted as the force.
TEST(Csv, ALetterBesideAColumnWithTheUnitIsTold) {
  std::string rows;
  for (int n = 0; n < 10; ++n) rows += fmt::format("{},{},{},{}\n", n, n * n, 2, 3 * n);
  const std::string said =
      "'f', without a unit, is taken for the force, and 'Reaction [N]' has a unit of one; column "
      "force=NAME chooses\n";
  EXPECT_NE(remarks_of("time [s],x [mm],f,Reaction [N]\n" + rows).find(said), std::string::npos);
  for (const char* names : {"time [s],x [mm],f [N],Reaction [N]", "time [s],x [mm],f,Reaction [V]",
                            "time [s],x [mm],force,Reaction [N]", "time [s],x [mm],f,Reaction"}) {
    EXPECT_EQ(remarks_of(names + ("\n" + rows)).find("a unit of one"), std::string::npos) << names;
  }
  ReadOptions options;
  options.columns = {{"force", "f"}};
  EXPECT_EQ(remarks_of("time [s],x [mm],f,Reaction [N]\n" + rows, options).find("a unit of one"), std::string::npos);
}

TEST(Csv, HeadersOfTestingMachinesAreRead) {
  const std::string rows = ten_rows();
  for (const char* names : {
           "Time\xC2\xA0(s),Extension\xC2\xA0(mm),Load\xE2\x80\xAF(kN)",
           "Time\xA0(s),Position\xA0[mm],Force\xA0[kN]",
           "time [s],displacement [\xC2\xA0mm],force [kN\xC2\xA0]",
           "Time,Displacement,Force\n(s)\xC2\xA0,(mm)\xC2\xA0,(kN)\xC2\xA0",
           "Total Time (s),Position(Linear:Position) (mm),Load(Linear:Load) (kN)",
           "Time (s),\"Position(8800 (0,1):Position) (mm)\",\"Load(8800 (0,1):Load) (kN)\"",
           "Pr\xC3\xBC"
           "fzeit;Standardweg;Standardkraft\ns;mm;kN",
           "Pr\xFC"
           "fzeit,Traversenweg,Standardkraft\ns,mm,kN",
           "Zeit [s],Verschiebung [mm],Last [kN]",
           "Zeit (s),Kompressive Verschiebung (mm),Kompressive Last (kN)",
           "Running Time (s),Axial Displacement (mm),Axial Force (kN)",
       }) {
    std::string body = rows;
    const std::string text(names);
    if (text.find(';') != std::string::npos) std::ranges::replace(body, ',', ';');
    const Recording recording = parse_csv(text + "\n" + body, "a.csv");
    EXPECT_DOUBLE_EQ(recording.displacement[3], 9e-3) << names;
    EXPECT_DOUBLE_EQ(recording.force[2], 20e3) << names;
  }
  const auto inches = parse_csv("Time (sec.),Extension (in.),Load (lbf)\n" + rows, "a.csv");
  EXPECT_DOUBLE_EQ(inches.displacement[3], 9 * 0.0254);
  // A mapping is typed with a space.
  EXPECT_DOUBLE_EQ(parse_csv("time [s],x [mm],Cell\xC2\xA0"
                             "2 [kN]\n" +
                                 rows,
                             "a.csv", mapped({{"force", "Cell 2"}}))
                       .force[2],
                   20e3);
  // The time of a cycle begins again.
  const std::string wave =
      "Total Time (s),Cycle Elapsed Time (s),Position(Linear:Position) (mm),Load(Linear:Load) (kN)\n";
  std::string cycles;
  for (int n = 0; n < 10; ++n) cycles += fmt::format("{},{},{},{}\n", n, n % 3, n * n, 10 * n);
  EXPECT_EQ(parse_csv(wave + cycles, "a.csv").time[7], 7.0);
  // What may be two is asked for.
  EXPECT_EQ(message_of<InputError>(
                [&] { (void)parse_csv("Zeit [s],Weg [mm],Standardkraft [N],Reibkraft [N]\n1,2,3,4\n", "a.csv"); }),
            "a.csv:1: 2 columns may be the force ('Standardkraft [N]', 'Reibkraft [N]'), expected one, or column "
            "force=NAME to choose");
  EXPECT_NE(message_of<InputError>([&] {
              (void)parse_csv("Zeit [s],Weg [mm],Last\n" + rows, "a.csv");
            }).find("no force column"),
            std::string::npos);
  EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv("time (hh:mm:ss),x [mm],F [N]\n" + rows, "a.csv"); }),
            "a.csv:1: unknown unit 'hh:mm:ss' of time, expected one of s, ms, us, min, h");
}

TEST(Csv, MistypedChannelsAreOfferedTheNearest) {
  const auto refused = [](const std::string& names, const ReadOptions& options = {}) {
    return message_of<InputError>([&] { (void)parse_csv(names + "\n" + ten_rows(), "a.csv", options); });
  };
  const auto begins = [](const std::string& text, const std::string& with) {
    EXPECT_TRUE(text.starts_with(with)) << text;
  };
  begins(refused("time [s],x [mm],F [N]", mapped({{"forse", "F"}})),
         "column forse=F: unknown channel 'forse' (did you mean 'force'?), expected one of time, ");
  begins(refused("time [s],x [mm],forse [N]"), "a.csv:1: no force column (did you mean 'forse [N]'?), expected one ");
  begins(refused("tmie [s],x [mm],F [N]"), "a.csv:1: no time column (did you mean 'tmie [s]'?), expected one ");
  begins(refused("time,Axial Displacment,F"),
         "a.csv:1: no displacement column (did you mean 'Axial Displacment'?), expected one ");
  begins(refused("time [s],x [mm],forse [V]"), "a.csv:1: no force column, expected one ");
  begins(refused("time [s],x [mm],valve [N]"), "a.csv:1: no force column, expected one ");
}

TEST(Csv, ColumnsThatAreNoChannelAreKeptAsTheirMean) {
  std::string text = "time [s],displacement [mm],oil [degC],force [N],note,valve,gaps,current [A],voltage [V]\n";
  for (int n = 0; n < 10; ++n) {
    text += fmt::format("0.{},{},{},{},ok,3,{},1.5,{}\n", n, n * n, 20 + n, 10 * n, n == 4 ? "" : "1", 2 * n);
  }
  const auto r = parse_csv(text, "a.csv");
  ASSERT_EQ(r.unused.size(), 3U) << "words and gaps are no numbers";
  EXPECT_EQ(r.unused[0].name, "voltage [V]") << "beside a current";
  EXPECT_DOUBLE_EQ(r.unused[0].mean, 9.0);
  EXPECT_EQ(r.unused[1].name, "oil [degC]");
  EXPECT_DOUBLE_EQ(r.unused[1].mean, 24.5);
  EXPECT_EQ(r.unused[2].name, "valve");
  EXPECT_DOUBLE_EQ(r.unused[2].mean, 3.0);
  EXPECT_TRUE(parse_csv(header + ten_rows(), "a.csv").unused.empty());
}

TEST(Csv, WithoutUnitsIsSiUnlessAUnitRowFollows) {
  EXPECT_DOUBLE_EQ(parse_csv("t,x,F\n" + ten_rows(), "a.csv").displacement[3], 9.0);
  const auto r = parse_csv("t,x,F\n[s],[mm],(kN)\n" + ten_rows(), "a.csv");
  EXPECT_DOUBLE_EQ(r.displacement[3], 9e-3);
  EXPECT_DOUBLE_EQ(r.force[3], 30e3);
  EXPECT_DOUBLE_EQ(parse_csv("t,x,F\ns,mm,N\n" + ten_rows(), "a.csv").displacement[3], 9e-3);
  // Both say the same, or one is a note; a mapping decides.
  EXPECT_DOUBLE_EQ(parse_csv("t,x [mm],F [N]\nsec,millimetres,CH1\n" + ten_rows(), "a.csv").displacement[3], 9e-3);
  EXPECT_DOUBLE_EQ(parse_csv("t,x,F [N]\ns,mm,kN\n" + ten_rows(), "a.csv", mapped({{"force", "F [kN]"}})).force[3],
                   30e3);
}

TEST(Csv, ByteOrderMarkWindowsLineEndsSemicolonAndDecimalComma) {
  std::string text = "\xEF\xBB\xBFtime [s];displacement [mm];force [kN]\r\n";
  for (int i = 0; i < 10; ++i) text += "0," + std::to_string(i) + ";-1,5e1;+" + std::to_string(i) + ",25\r\n";
  const auto r = parse_csv(text, "a.csv");
  EXPECT_DOUBLE_EQ(r.time[9], 0.9);
  EXPECT_DOUBLE_EQ(r.displacement[0], -0.015);
  EXPECT_DOUBLE_EQ(r.force[3], 3250.0);
}

// Rows of time, displacement and the force that is given, as spreadsheets of either kind write them.
std::string rows_with(const std::string& time, const std::string& force) {
  std::string text = "t [ms];x [um];F [N]\n";
  for (int n = 1; n < 10; ++n) {
    text += std::to_string(n) + time + ";" + std::to_string(10 * n) + ";" + (n == 7 ? force : "998") + "\n";
  }
  return text;
}

TEST(Csv, MarksOfThousandsAreNoDecimalMarks) {
  const auto refused = [](const std::string& text) {
    return message_of<InputError>([&] { (void)parse_csv(text, "a.csv"); });
  };
  const std::string one = "expected one decimal mark in all numbers and none between thousands";
  EXPECT_EQ(refused(rows_with(",5", "1.010")),
            "a.csv:8: force '1.010' has a point and '1,5' of line 2 a comma, " + one);
  EXPECT_EQ(refused(rows_with(".5", "1,010")),
            "a.csv:8: force '1,010' has a comma and '1.5' of line 2 a point, " + one);
  std::string quoted = "t,x,F\n";
  for (int n = 0; n < 9; ++n) quoted += std::to_string(n) + ".5,1,\"1,010\"\n";
  EXPECT_EQ(refused(quoted), "a.csv:2: force '1,010' has a comma and '0.5' of line 2 a point, " + one);
  for (const std::string mark : {".", ","}) {
    EXPECT_EQ(refused(rows_with("", "-1" + mark + "010")),
              "a.csv:8: force '-1" + mark +
                  "010' stands among whole numbers below 1000, as one with a mark of thousands does, expected decimals "
                  "in all numbers and no mark between thousands");
  }
}

// Decimals of the time say nothing of a force that counts 998, 999, 1.000.
TEST(Csv, MarksOfThousandsInOneColumnAreNoDecimalMarks) {
  const auto text = [](const std::string& mark, const std::vector<std::string>& forces) {
    std::string rows = "t [s];x [mm];F [N]\n";
    for (std::size_t n = 0; n < forces.size(); ++n) {
      rows += "0" + mark + std::to_string(n + 1) + ";" + std::to_string(n) + mark + "5;" + forces[n] + "\n";
    }
    return rows;
  };
  for (const std::string mark : {".", ","}) {
    const std::string thousand = "1" + mark + "000";
    EXPECT_EQ(
        message_of<InputError>([&] {
          (void)parse_csv(text(mark, {"994", "-997", thousand, "1" + mark + "003", "996", "9", "8", "7"}), "a.csv");
        }),
        "a.csv:4: force '" + thousand +
            "' stands among whole numbers below 1000, as one with a mark of thousands does, expected decimals in "
            "all numbers and no mark between thousands");
    // With decimals, a thousand without a mark, or levels far from a thousand the numbers are what they look like.
    for (const std::vector<std::string>& forces :
         {std::vector<std::string>{"994", "997", thousand, "1" + mark + "5", "3", "4", "5", "6"},
          {"994", "997", thousand, "1003", "3", "4", "5", "6"},
          {"0", "0", "1" + mark + "125", "1" + mark + "125", "0", "0", "0", "0"}}) {
      EXPECT_EQ(parse_csv(text(mark, forces), "a.csv").size(), forces.size());
    }
  }
}

TEST(Csv, DecimalsThatMayBeThousandsAreTold) {
  const auto said = [](const std::string& text) {
    std::string lines;
    ReadOptions options;
    options.remark = [&](const Remark& remark) {
      if (remark.kind == Remark::Kind::dialect) lines += remark.text.plain() + "\n";
    };
    (void)parse_csv(text, "a.csv", options);
    return lines;
  };
  std::string three = "t [s];x [mm];F [N]\n";
  for (int n = 1; n < 10; ++n)
    three += std::to_string(n) + ";" + std::to_string(n * n) + ";1,12" + std::to_string(n) + "\n";
  EXPECT_EQ(said(three),
            "force '1,121' of line 2 is read with three decimals, as all numbers with a mark: where that stands "
            "between thousands, export them without\n");
  // One number that has decimals for certain, or a thousand without a mark, tells of all.
  const std::string commas = "numbers are read with decimal commas, columns as separated by semicolons\n";
  for (const char* more : {"20;1;0,5\n", "20;1;1,5\n", "20;1;1500\n"}) EXPECT_EQ(said(three + more), commas) << more;
  EXPECT_EQ(said(rows_with("", "1.01")), "");
}

// Columns that are no channel may hold anything; what cannot be of one mark has no mean.
TEST(Csv, AColumnOfTheOtherMarkIsNoNumber) {
  std::string text = "t;x;F;version\n";
  for (int n = 0; n < 9; ++n) text += std::to_string(n) + ",5;1;2;1.2\n";
  EXPECT_TRUE(parse_csv(text, "a.csv").unused.empty());
}

TEST(Csv, TabsQuotesAndDelimiterAtTheEndOfRows) {
  EXPECT_DOUBLE_EQ(parse_csv("t\tx\tF\n" + ten_rows('\t'), "a.csv").force[9], 90.0);
  std::string text = "\"time [s]\",\"stroke [mm]\",\"force [N]\",\n";
  for (int i = 0; i < 10; ++i) text += "\"" + std::to_string(i) + "\", 1 ,\"2,5\",\n";
  EXPECT_DOUBLE_EQ(parse_csv(text, "a.csv").force[9], 2.5);
}

TEST(Csv, LastRowNeedsNoLineEndAndLoneCarriageReturnsAreLineEnds) {
  std::string text = header + ten_rows();
  text.pop_back();
  EXPECT_EQ(parse_csv(text, "a.csv").size(), 10U);
  for (char& c : text) c = c == '\n' ? '\r' : c;
  EXPECT_EQ(parse_csv(text, "a.csv").size(), 10U);
}

// As a spreadsheet writes what was once below the table.
TEST(Csv, RowsOfSeparatorsEndTheTable) {
  for (const std::string tail : {",,\n,,\n", ",,", " , ,\n\n,,,\n", "\"\",\"\",\"\"\n"}) {
    EXPECT_EQ(parse_csv(header + ten_rows() + tail, "a.csv").size(), 10U) << tail;
  }
  EXPECT_EQ(parse_csv("t;x;F\n" + ten_rows(';') + ";;\n;;\n", "a.csv").size(), 10U);
  EXPECT_EQ(message_of<InputError>([] { (void)parse_csv(header + ten_rows() + ",,\n,,\n1,2,3\n", "a.csv"); }),
            "a.csv:12: an empty row among the numbers, expected a finite number each");
  EXPECT_EQ(message_of<InputError>([] { (void)parse_csv(header + ten_rows() + ",2,\n", "a.csv"); }),
            "a.csv:12: time is empty, expected a finite number");
}

TEST(Csv, CurrentGoesBeforeVoltageAndOtherColumnsMayHoldText) {
  std::string text = "t,x,F,u [mV],i [mA],note,temp [K],v [mm/s],acc [g]\n";
  for (int i = 0; i < 10; ++i) text += std::to_string(i) + ",1,2,3000,500,hello,293.15,7,1\n";
  const auto r = parse_csv(text, "a.csv");
  EXPECT_EQ(r.drive_kind, DriveKind::current);
  EXPECT_DOUBLE_EQ(r.drive[0], 0.5);
  EXPECT_NEAR(r.temperature[0], 20.0, 1e-12);
  EXPECT_TRUE(r.velocity_measured);
  EXPECT_DOUBLE_EQ(r.velocity[0], 7e-3);
  EXPECT_DOUBLE_EQ(r.acceleration[0], 9.80665);
}

TEST(Csv, UnitTellsVoltageFromVelocity) {
  std::string text = "t,x,F,v [V]\n";
  for (int i = 0; i < 10; ++i) text += std::to_string(i) + ",1,2,3\n";
  const auto r = parse_csv(text, "a.csv");
  EXPECT_EQ(r.drive_kind, DriveKind::voltage);
  EXPECT_FALSE(r.velocity_measured);
}

TEST(Csv, UnitTellsTemperatureFromTime) {
  std::string rows;
  for (int i = 0; i < 10; ++i) rows += std::to_string(i) + ",1,2,30\n";
  const auto temperature = [&](const std::string& name) {
    const auto r = parse_csv("Time [s],Stroke [mm],Force [kN]," + name + "\n" + rows, "a.csv");
    EXPECT_EQ(r.time[1], 1.0) << name;
    return r.temperature.empty() ? std::nan("") : r.temperature[1];
  };
  for (const std::string name : {"T [\u00B0C]", "T [degC]", "T_degC", "t [C]"})
    EXPECT_EQ(temperature(name), 30.0) << name;
  EXPECT_NEAR(temperature("t [K]"), -243.15, 1e-9);
  const auto r = parse_csv("t,x,F,T\ns,mm,N,degC\n" + rows, "a.csv");
  EXPECT_EQ(r.temperature.at(1), 30.0);
  EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv("time [s],x,F,t [ms]\n" + rows, "a.csv"); }),
            "a.csv:1: two columns for time ('time [s]' and 't [ms]'), expected one, or column time=NAME to choose");
}

TEST(Csv, MappedColumns) {
  const std::string text = "t,CH1 [lbf],CH2 (raw)\n" + ten_rows();
  const auto r = parse_csv(text, "a.csv", mapped({{"force", "CH1 [kgf]"}, {"disp", "ch2 (raw) [mm]"}}));
  EXPECT_DOUBLE_EQ(r.force[3], 9 * 9.80665);
  EXPECT_DOUBLE_EQ(r.displacement[3], 0.03);
  // Without a unit in the mapping the header's holds; a mapping wins over a synonym.
  const auto s =
      parse_csv("t,x,F [N],F2 [kN]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n3,1,2,3\n4,1,2,3\n5,1,2,3\n6,1,2,3\n7,1,2,3\n", "a.csv",
                mapped({{"force", "F2"}}));
  EXPECT_DOUBLE_EQ(s.force[0], 3000.0);
}

TEST(Csv, AUnitInTheNameThatIsNearlyOneIsTold) {
  EXPECT_EQ(message_of<InputError>([] { (void)parse_csv("time_s,disp_mm,force_kn\n" + ten_rows(), "a.csv"); }),
            "a.csv:1: unknown unit 'kn' of force (did you mean kN?), expected one of N, kN, MN, daN, mN, lbf, lb, kip, "
            "kgf");
  std::string text = "time_s,disp_mm,force_kN,current_ma\n";
  for (int i = 0; i < 10; ++i) text += std::to_string(i) + ",1,2,3\n";
  EXPECT_EQ(remarks_of(text), "'current_ma' is not read as the current: 'ma' is no unit, mA is\n");
}

TEST(Csv, ForceMayBeLeftOutForSimulation) {
  std::string text = "t,x\n";
  for (int i = 0; i < 10; ++i) text += std::to_string(i) + ",1\n";
  EXPECT_TRUE(parse_csv(text, "a.csv", {{}, false}).force.empty());
}

struct WrongCsv {
  const char* what;
  std::string text;
  std::string message;  // after "a.csv"
  ReadOptions options = {};
};

TEST(Csv, WrongInputsAreOneClearLine) {
  const std::string present = "the columns are ";
  const std::string ten = ten_rows();
  const std::string good = header + ten;
  const std::string unit_list = ", expected one of N, kN, MN, daN, mN, lbf, lb, kip, kgf";
  const std::string number_end = ", expected a finite number";
  const WrongCsv cases[] = {
      {"empty", "", ": the file is empty, expected a header row and at least 8 rows of numbers"},
      {"bom only", "\xEF\xBB\xBF", ": the file is empty, expected a header row and at least 8 rows of numbers"},
      {"blank", "\n# x\n \n",
       ": the file holds only blank lines and comments, expected a header row and at least 8 rows of numbers"},
      {"binary", header + std::string("0,1\0,2\n", 7), ":2: a NUL byte, the file is not text, expected UTF-8 CSV"},
      {"utf-16", "\xFF\xFEt", ": the file is UTF-16 text, expected UTF-8"},
      {"no header", ten,
       ":1: the first row holds only numbers, expected names and units such as 'time [s],displacement [mm],force [N]'"},
      {"header only", header, ": 0 rows of numbers, expected at least 8"},
      {"one row", header + "0,1,2\n", ": 1 row of numbers, expected at least 8"},
      {"seven rows", header + "0,1,2\n1,1,2\n2,1,2\n3,1,2\n4,1,2\n5,1,2\n6,1,2\n",
       ": 7 rows of numbers, expected at least 8"},
      {"beyond anything measured", good + "1,2,1e31\n",
       ":12: force '1e31' is too large, expected at most 1e30 in SI units"},
      {"text", good + "1,abc,2\n", ":12: displacement 'abc' is not a number" + number_end},
      {"half a number", good + "1,2,3x\n", ":12: force '3x' is not a number" + number_end},
      {"two signs", good + "1,2,+-3\n", ":12: force '+-3' is not a number" + number_end},
      {"thousands", "t;x;F\n0;1;1.000,5\n", ":2: force '1.000,5' is not a number" + number_end},
      {"empty field", good + "1,,2\n", ":12: displacement is empty" + number_end},
      {"nan", good + "1,2,NaN\n", ":12: force is 'NaN'" + number_end},
      {"inf", good + "1,2,-inf\n", ":12: force is '-inf'" + number_end},
      {"too large", good + "1,2,1e999\n", ":12: force '1e999' is too large" + number_end},
      {"control bytes", good + "1,2,\x01\x1B[2J\n", ":12: force '??[2J' is not a number" + number_end},
      {"ragged short", good + "1,2\n2,3,4\n", ":12: 2 fields, expected 3 as in the header"},
      {"ragged long", good + "1,2,3,4\n", ":12: 4 fields, expected 3 as in the header"},
      {"decimal commas with commas", header + "0,0,1,5,2,5\n", ":2: 6 fields, expected 3 as in the header"},
      {"one field", good + "1\n", ":12: 1 field, expected 3 as in the header"},
      {"cut off", good + "1,2",
       ":12: the last row has 2 of 3 fields and no line end, the file is cut off, expected a complete row"},
      {"cut off at a comma", good + "1,2,",
       ":12: the last row has 2 of 3 fields and no line end, the file is cut off, expected a complete row"},
      {"comments are counted", header + "# c\n\n" + ten + "1,x,2\n",
       ":14: displacement 'x' is not a number" + number_end},
      {"time repeats", good + "0.9,1,2\n",
       ":12: time 0.9 s does not increase after 0.9 s, expected strictly increasing times"},
      {"time goes back", good + "0.25,1,2\n",
       ":12: time 0.25 s does not increase after 0.9 s, expected strictly increasing times"},
      {"no time", "x,F\n1,2\n",
       ":1: no time column, expected one named time, t (or its German, French, Italian or Spanish word), or column "
       "time=NAME; " +
           present + "'x', 'F'; a law whose force does not depend on the rate needs none, with without time"},
      {"no displacement", "t,F\n1,2\n",
       ":1: no displacement column, expected one named displacement, disp, x, displ, position, pos, travel, lvdt, "
       "stroke, crosshead, extension, "
       "deflection (or its German, French, Italian or Spanish word), or column displacement=NAME; " +
           present + "'t', 'F'"},
      {"no force", "t [s],x [mm]\n1,2\n",
       ":1: no force column, expected one named force, f, load, load cell (or its German, French, Italian or Spanish "
       "word), or column force=NAME; " +
           present + "'t [s]', 'x [mm]'"},
      {"one column", "hello world\n1 2\n",
       ":1: no time column, expected one named time, t (or its German, French, Italian or Spanish word), or column "
       "time=NAME; " +
           present + "'hello world'"},
      {"duplicate", "t,x,F [N],load [kN]\n1,2,3,4\n",
       ":1: two columns for force ('F [N]' and 'load [kN]'), expected one, or column force=NAME to choose"},
      {"same name twice", "t,x,x,F\n1,2,3,4\n",
       ":1: two columns for displacement ('x' and 'x'), expected one, or column displacement=NAME to choose"},
      {"unknown unit", "t,x,F [stone]\n1,2,3\n", ":1: unknown unit 'stone' of force" + unit_list},
      {"unit of another quantity", "t,x,F [mm]\n1,2,3\n", ":1: unknown unit 'mm' of force" + unit_list},
      {"empty unit row", "t,x,F\ns,mm,stone\n1,2,3\n", ":2: unknown unit 'stone' of force" + unit_list},
      {"units that contradict", "t [s],x [mm],F [N]\ns,mm,kN\n1,2,3\n",
       ":2: column 'F [N]' is given in 'N' and in 'kN', expected one unit, or column force=\"F [UNIT]\" to choose"},
      {"text instead of units", "t,x,F\nfoo,bar,baz\n1,2,3\n", ":2: time 'foo' is not a number" + number_end},
      {"mapped column missing", good,
       ":1: no column 'CH9' for force, expected one of 'time [s]', 'displacement [mm]', 'force [N]'",
       mapped({{"force", "CH9 [kN]"}})},
      {"mapped unit unknown", good, ":1: unknown unit 'x' of force" + unit_list, mapped({{"force", "force [x]"}})},
      {"mapped name twice", "t,x,F,c [N],c [kN]\n1,2,3,4,5\n",
       ":1: 2 columns are named 'c' for force, expected one; " + present + "'t', 'x', 'F', 'c [N]', 'c [kN]'",
       mapped({{"force", "c"}})},
      {"channel mapped twice", good, ":1: two mappings for force, expected one",
       mapped({{"f", "force"}, {"force", "force"}})},
      {"column mapped twice", good,
       ":1: column 'force [N]' is mapped to both displacement and force, expected one channel per column",
       mapped({{"displacement", "force [mm]"}, {"force", "force [N]"}})},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(message_of<InputError>([&] { (void)parse_csv(c.text, "a.csv", c.options); }), "a.csv" + c.message)
        << c.what;
  }
  EXPECT_EQ(message_of<InputError>([&] {
              (void)parse_csv(good, "a.csv", mapped({{"torque", "CH1"}}));
            }),
            "column torque=CH1: unknown channel 'torque', expected one of time, displacement, velocity, acceleration, "
            "force, current, voltage, temperature, base");
}

// No prefix of a good file and no single damaged byte may do anything but succeed or throw InputError.
TEST(Csv, DamagedFilesNeverCrash) {
  const std::string good = "# c\n\"time [s]\";x [mm];F [kN]\r\n" + ten_rows(';');
  for (std::size_t i = 0; i < good.size(); ++i) {
    (void)message_of<InputError>([&] { (void)parse_csv(good.substr(0, i), "a.csv"); });
    for (const char byte : {'\0', '"', ';', ',', '\n', '\r', '[', ']', '\xFF', '-', 'e'}) {
      std::string damaged = good;
      damaged[i] = byte;
      (void)message_of<InputError>([&] { (void)parse_csv(damaged, "a.csv"); });
    }
  }
}

TEST(Csv, AFileCutWithinItsLastNumberIsTold) {
  const auto told = [](int rows, const std::string& last, const char* decimals = "%.3f") {
    std::string text = "time [s],displacement [m],force [N]\n";
    for (int n = 0; n < rows; ++n) {
      std::array<char, 32> force{};
      (void)std::snprintf(force.data(), force.size(), decimals, 1000.0 * std::sin(0.1 * n));
      text += std::to_string(0.01 * n) + "," + std::to_string(0.01 * std::cos(0.1 * n)) + "," + force.data() + "\n";
    }
    text += std::to_string(0.01 * rows) + ",0.001," + last;
    bool cut = false;
    ReadOptions options;
    options.remark = [&](const Remark& remark) { cut = cut || remark.key == "cut"; };
    (void)parse_csv(text, "a.csv", options);
    return cut;
  };
  EXPECT_TRUE(told(200, "108"));
  EXPECT_TRUE(told(200, "-1080.6"));
  EXPECT_FALSE(told(200, "108\n")) << "the line has its end";
  EXPECT_FALSE(told(200, "-1080.679")) << "whole";
  EXPECT_FALSE(told(200, "108", "%.6g")) << "zeros are left out";
  EXPECT_FALSE(told(200, "10", "%.0f")) << "whole numbers";
  EXPECT_FALSE(told(200, "1", "%.3e")) << "exponents";
  EXPECT_FALSE(told(50, "108")) << "too few to tell";
}

}  // namespace
}  // namespace hysteron

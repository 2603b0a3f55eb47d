// Readers of TDMS, MDF 4, RPC III and xlsx on files written byte by byte (measuring_files.hpp).
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/campaign.hpp"
#include "io/format.hpp"
#include "io/measuring_files.hpp"
#include "io/resample.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using namespace testing;

// Values that a float and a 16-bit integer in quarters hold.
FileTable damper(std::size_t rows = 150) {
  FileTable table{0.0078125, {{"disp", "mm", {}}, {"Load", "kN", {}}, {"Pressure", "bar", {}}}};
  for (std::size_t k = 0; k < rows; ++k) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(k) / 50.0;
    table.channels[0].values.push_back(0.25 * std::round(160.0 * std::sin(phase)));
    table.channels[1].values.push_back(0.25 * std::round(80.0 * std::cos(phase)));
    table.channels[2].values.push_back(0.25 * static_cast<double>(k % 7));
  }
  return table;
}

const InputFormat& format_called(std::string_view name) {
  for (const InputFormat* format : formats()) {
    if (format->name == name) return *format;
  }
  throw std::runtime_error("no format " + std::string(name));
}

Recording read(std::string_view format, const std::string& bytes, const ReadOptions& options = {}) {
  return format_called(format).parse(bytes, "r", options);
}

std::string refusal(std::string_view format, const std::string& bytes, const ReadOptions& options = {}) {
  return message_of<InputError>([&] { (void)read(format, bytes, options); });
}

void expect_same(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.drive, b.drive);
  EXPECT_EQ(a.drive_kind, b.drive_kind);
  ASSERT_EQ(a.unused.size(), b.unused.size());
  for (std::size_t k = 0; k < a.unused.size(); ++k) {
    EXPECT_EQ(a.unused[k].name, b.unused[k].name);
    EXPECT_DOUBLE_EQ(a.unused[k].mean, b.unused[k].mean);
  }
}

std::vector<std::pair<std::string, std::string>> files_of(const FileTable& table) {
  return {{"r.tdms", tdms::file_of(table)},
          {"r.mf4", mdf4_of(table)},
          {"r.rsp", rpc3::file_of(table)},
          {"r.xlsx", xlsx_of(table)}};
}

TEST(Formats, ARecordingIsTheSameInEveryFormat) {
  const TemporaryFolder folder;
  const Recording expected = load_recording(folder.write("r.csv", csv_of(damper())));
  ASSERT_EQ(expected.size(), 150U);
  EXPECT_EQ(expected.force[0], 20e3);
  EXPECT_EQ(expected.unused.size(), 1U);
  for (const auto& [name, bytes] : files_of(damper())) {
    SCOPED_TRACE(name);
    const Recording recording = load_recording(folder.write(name, bytes));
    expect_same(recording, expected);
    EXPECT_EQ(recording.file, name);
    EXPECT_EQ(recording.sha256.size(), 64U);
  }
}

TEST(Formats, AUnitOfTemperatureIsNoTime) {
  FileTable table = damper();
  table.channels[2] = {"T", "degC", std::vector<double>(table.rows(), 30.0)};
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files_of(table)) {
    const Recording r = load_recording(folder.write(name, bytes));
    EXPECT_EQ(r.temperature, table.channels[2].values) << name;
    EXPECT_EQ(r.time.at(1), table.step) << name;
  }
}

TEST(Formats, BytesTellTheFormatWhateverTheName) {
  const TemporaryFolder folder;
  const Recording expected = load_recording(folder.write("r.csv", csv_of(damper())));
  for (const auto& [name, bytes] : files_of(damper())) {
    SCOPED_TRACE(name);
    expect_same(load_recording(folder.write(name + ".dat", bytes)), expected);
    expect_same(load_recording(folder.write(name + ".unknown", bytes)), expected);
  }
  const auto path = folder.write("t.tdms", csv_of(damper()));
  EXPECT_EQ(message_of<InputError>([&] { (void)load_recording(path); }),
            path.string() + ": does not begin with TDSm, expected a TDMS file");
}

TEST(Formats, MappingsAndGroupsReachChannels) {
  FileTable table = damper();
  table.channels[1].name = "CH1";
  table.channels[1].unit = "";
  ReadOptions options;
  options.columns = {{"force", "CH1 [kN]"}};
  for (const auto& [format, bytes] : {std::pair<std::string_view, std::string>{"TDMS", tdms::file_of(table)},
                                      {"MDF 4", mdf4_of(table)},
                                      {"RPC III", rpc3::file_of(table)}}) {
    SCOPED_TRACE(format);
    EXPECT_EQ(read(format, bytes, options).force[0], 20e3);
    ReadOptions wrong = options;
    wrong.columns = {{"force", "CH9"}};
    EXPECT_EQ(refusal(format, bytes, wrong),
              "r: no column 'CH9' for force, expected one of 'disp [mm]', 'CH1', 'Pressure [bar]'");
    wrong = options;
    wrong.group = "nothing";
    EXPECT_NE(refusal(format, bytes, wrong).find("no group 'nothing' for group, expected "), std::string::npos);
  }
  options.group = "test";
  EXPECT_EQ(read("TDMS", tdms::file_of(table), options).force[0], 20e3);
  EXPECT_EQ(read("MDF 4", mdf4_of(table), options).force[0], 20e3);
  options.columns = {{"force", "Test/CH1 [kN]"}};
  EXPECT_EQ(read("TDMS", tdms::file_of(table), options).force[0], 20e3);
}

// A start in UTC beside one by the clock of the place.
TEST(Formats, EveryFormatTellsWhetherItsStartHasAZone) {
  const auto zone_of = [](std::string_view format, const std::string& bytes) {
    std::optional<bool> zone;
    ReadOptions options;
    options.start_zone = [&](bool has_zone) { zone = has_zone; };
    (void)read(format, bytes, options);
    return zone;
  };
  const FileTable table = damper(20);
  EXPECT_EQ(zone_of("CSV", "# start: 2026-11-27T12:00:00Z\n" + csv_of(table)), true);
  EXPECT_EQ(zone_of("CSV", "# start: 2026-11-27T12:00:00\n" + csv_of(table)), false);
  EXPECT_EQ(zone_of("CSV", csv_of(table)), std::nullopt);
  using namespace tdms;
  const auto channel = [](const std::string& name) {
    return object("/'G'/'" + name + "'", index(f64, 20),
                  {property("wf_increment", 0.25), time_property("wf_start_time", 3'800'000'000, 0)});
  };
  EXPECT_EQ(zone_of("TDMS", segment(metadata | new_list | tdms::numbers, objects({channel("disp"), channel("Load")}),
                                    bytes_of(table.channels[0].values) + bytes_of(table.channels[1].values))),
            true);
  const auto mdf = [](std::uint8_t flags) {
    Mdf4Writer w;
    std::string records;
    for (int k = 0; k < 20; ++k) records += bytes_of(0.1 * k) + bytes_of(1.0 * k) + bytes_of(2.0 * k);
    const std::uint64_t channels = w.chain({{.name = "t", .kind = 2, .counts = 1},
                                            {.name = "disp", .unit = "mm", .byte = 8},
                                            {.name = "force", .unit = "N", .byte = 16}});
    w.data_group(w.channel_group("", channels, 20, 24), w.block("DT", {}, records));
    w.start(1'700'000'000'000'000'000, 60, 0, flags);
    return w.bytes();
  };
  EXPECT_EQ(zone_of("MDF 4", mdf(0)), true);
  EXPECT_EQ(zone_of("MDF 4", mdf(1)), false);
  EXPECT_EQ(zone_of("MDF 4", mdf(2)), false);
  for (const bool zone : {true, false}) {
    const std::string start =
        std::string("<row>") + cell("Start") + cell(zone ? "2026-11-27T13:00+01:00" : "2026-11-27 12:00") + "</row>";
    EXPECT_EQ(zone_of("xlsx", zip_of(workbook_parts({{"A", start + sheet_of(table)}}))), zone);
  }
}

TEST(Formats, AFolderHoldsAllOfThemAndWorkbooksOnlyAlone) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files_of(damper())) folder.write("all/" + name, bytes);
  const auto names = [](const Campaign& campaign) {
    std::vector<std::string> result;
    for (const Recording& recording : campaign.recordings) result.push_back(recording.file);
    return result;
  };
  EXPECT_EQ(names(load_campaign({(folder.path() / "all").string()})),
            (std::vector<std::string>{"r.mf4", "r.rsp", "r.tdms"}));
  folder.write("books/b.xlsx", xlsx_of(damper()));
  folder.write("books/~$b.xlsx", "locked");
  EXPECT_EQ(names(load_campaign({(folder.path() / "books").string()})), (std::vector<std::string>{"b.xlsx"}));
}

TEST(Formats, ManySamplesAreAveragedAsThoseOfCsv) {
  const TemporaryFolder folder;
  ReadOptions options;
  options.keep_samples = 2000;
  const FileTable table = damper(6000);
  const Recording expected = load_recording(folder.write("r.csv", csv_of(table)), options);
  ASSERT_EQ(expected.size(), 2000U);
  for (const auto& [name, bytes] : files_of(table)) {
    SCOPED_TRACE(name);
    expect_same(load_recording(folder.write(name, bytes), options), expected);
  }
}

// No file that ends early is a shorter recording, and every place where it may end is told in one line.
TEST(Formats, CutFilesAreRefused) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files_of(damper(16))) {
    SCOPED_TRACE(name);
    const InputFormat& format = *find_format(folder.write(name, bytes));
    for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 37) {
      const std::string message = message_of<InputError>([&] { (void)format.parse(bytes.substr(0, size), "r", {}); });
      EXPECT_TRUE(message.starts_with("r: ")) << size << " bytes: " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
}

// A byte that is wrong is refused or changes what it stands for; it never breaks the reader.
TEST(Formats, EveryWrongByteIsSurvived) {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : files_of(damper(10))) {
    SCOPED_TRACE(name);
    const InputFormat& format = *find_format(folder.write(name, bytes));
    int refused = 0;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      for (const char wrong : {'\x00', '\xFF', static_cast<char>(bytes[at] ^ 1)}) {
        std::string damaged = bytes;
        damaged[at] = wrong;
        const std::string message = message_of<InputError>([&] { (void)format.parse(damaged, "r", {}); });
        if (message == "no error") continue;
        ++refused;
        EXPECT_TRUE(message.starts_with("r:")) << message;
      }
    }
    EXPECT_GT(refused, 100);
  }
}

// --- several rates ---

TEST(Resampled, PolynomialsOfDegreeSevenAreExact) {
  std::vector<double> time;
  std::vector<double> values;
  std::vector<double> at;
  const auto p = [](double t) { return 1.0 + t * (2.0 + t * (-1.0 + t * t * (0.5 + t * t * 0.25))); };
  for (int k = 0; k <= 20; ++k) time.push_back(0.1 * k + 0.02 * std::sin(k));
  for (const double t : time) values.push_back(p(t));
  for (double t = 0.5; t < 1.5; t += 0.013) at.push_back(t);
  const std::vector<double> placed = resampled(time, values, at, Between::smooth);
  for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(placed[k], p(at[k]), 1e-13);
  EXPECT_EQ(resampled(time, values, time, Between::smooth), values);
  EXPECT_EQ(resampled(time, values, time, Between::straight), values);
}

// Of a sine the error falls with the eighth power of the step and stays below 0.27 (pi / N)^8.
TEST(Resampled, ASineIsMissedByTheEighthPowerOfTheStep) {
  const auto error = [](double samples_a_period) {
    std::vector<double> time;
    std::vector<double> values;
    std::vector<double> at;
    for (int k = 0; k < 100; ++k) {
      time.push_back(k);
      values.push_back(std::sin(2.0 * std::numbers::pi * k / samples_a_period));
    }
    for (double t = 10.0; t < 90.0; t += 0.05) at.push_back(t);
    const std::vector<double> placed = resampled(time, values, at, Between::smooth);
    double worst = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      worst = std::max(worst, std::abs(placed[k] - std::sin(2.0 * std::numbers::pi * at[k] / samples_a_period)));
    }
    return worst;
  };
  for (const double n : {8.0, 10.0, 16.0, 20.0}) {
    EXPECT_LT(error(n), 0.274 * std::pow(std::numbers::pi / n, 8)) << n;
  }
  EXPECT_NEAR(std::log2(error(12.0) / error(24.0)), 8.0, 0.3);
}

TEST(Resampled, AGapIsCrossedByAStraightLine) {
  std::vector<double> time;
  std::vector<double> values;
  for (int k = 0; k < 30; ++k) {
    time.push_back(k < 15 ? k : k + 20);
    values.push_back(k < 15 ? 0.0 : 1.0);
  }
  const std::vector<double> placed = resampled(time, values, std::vector<double>{13.5, 24.5, 35.5}, Between::smooth);
  EXPECT_EQ(placed[0], 0.0);
  EXPECT_NEAR(placed[1], 0.5, 1e-12);
  EXPECT_EQ(placed[2], 1.0);
}

struct Told {
  std::vector<std::string> lines;
  ReadOptions options;
  Told() {
    options.remark = [this](const Remark& remark) { lines.push_back(remark.text.plain()); };
  }
};

// Force at 1000 Hz, displacement at 200 Hz, temperature at 10 Hz.
std::string tdms_of_three_rates() {
  using namespace tdms;
  std::vector<double> force;
  std::vector<double> displacement;
  std::vector<double> temperature;
  for (int k = 0; k < 1000; ++k) force.push_back(100.0 * std::cos(2.0 * std::numbers::pi * 2.0 * 1e-3 * k));
  for (int k = 0; k < 200; ++k) displacement.push_back(10.0 * std::sin(2.0 * std::numbers::pi * 2.0 * 5e-3 * k));
  for (int k = 0; k < 10; ++k) temperature.push_back(20.0 + k);
  const auto channel = [](const std::string& name, const std::string& unit, double step, std::size_t count) {
    return object("/'A'/'" + name + "'", index(f64, count),
                  {property("unit_string", unit), property("wf_increment", step), property("wf_start_offset", 0.0)});
  };
  return segment(
      metadata | new_list | numbers,
      objects({channel("Load", "N", 1e-3, 1000), channel("Stroke", "mm", 5e-3, 200), channel("Temp", "K", 0.1, 10)}),
      bytes_of(force) + bytes_of(displacement) + bytes_of(temperature));
}

TEST(Rates, ChannelsComeOnTheTimesOfTheForce) {
  Told told;
  const Recording r = read("TDMS", tdms_of_three_rates(), told.options);
  // The last displacement is at 0.995 s.
  ASSERT_EQ(r.size(), 996U);
  EXPECT_EQ(r.time[1], 1e-3);
  EXPECT_EQ(r.force[1], 100.0 * std::cos(2.0 * std::numbers::pi * 2.0 * 1e-3));
  double worst = 0.0;
  for (std::size_t k = 25; k < 970; ++k) {
    worst = std::max(worst, std::abs(r.displacement[k] - 0.01 * std::sin(2.0 * std::numbers::pi * 2.0 * r.time[k])));
  }
  EXPECT_LT(worst, 1e-14);  // at 100 samples a period rounding is all there is
  EXPECT_DOUBLE_EQ(r.temperature[50], 20.5 - 273.15);
  EXPECT_DOUBLE_EQ(r.temperature[995], 29.0 - 273.15);  // held for one step behind its last value
  ASSERT_FALSE(told.lines.empty());
  EXPECT_EQ(
      told.lines[0],
      "displacement (200 Hz) is put on the times of the force (1000 Hz) by polynomials through the 8 nearest "
      "samples; temperature (10 Hz) by straight lines; 4 samples of the force outside of the other channels' times "
      "are left out");
}

TEST(Rates, ChannelsThatNeverOverlapAreRefused) {
  using namespace tdms;
  const std::vector<double> values(20, 1.0);
  const auto channel = [](const std::string& name, double start) {
    return object("/'A'/'" + name + "'", index(f64, 20),
                  {property("wf_increment", 0.01), property("wf_start_offset", start)});
  };
  const auto bytes = [&](double start) {
    return segment(metadata | new_list | numbers, objects({channel("force", 0.0), channel("disp", start)}),
                   bytes_of(values) + bytes_of(values));
  };
  EXPECT_EQ(refusal("TDMS", bytes(5.0)),
            "r: 'disp' and 'force' were not recorded at the same time, expected times that overlap");
  EXPECT_EQ(refusal("TDMS", bytes(0.16)), "r: 4 samples, expected at least 8");
  EXPECT_EQ(read("TDMS", bytes(0.1)).size(), 10U);
}

TEST(Rates, AChannelThatEndsEarlyIsSaid) {
  using namespace tdms;
  const auto channel = [](const std::string& name, std::size_t count) {
    return object("/'A'/'" + name + "'", index(f64, count), {property("wf_increment", 0.01)});
  };
  Told told;
  const Recording r = read("TDMS",
                           segment(metadata | new_list | numbers, objects({channel("force", 20), channel("disp", 15)}),
                                   std::string(280, '\0')),
                           told.options);
  EXPECT_EQ(r.size(), 15U);
  EXPECT_EQ(told.lines.at(0), "5 samples of the force outside of the other channels' times are left out");
}

// --- TDMS ---

TEST(Tdms, SegmentsGoOnFromThoseBefore) {
  using namespace tdms;
  const FileTable table = damper(96);
  const auto part = [&](std::size_t channel, std::size_t from, std::size_t count) {
    const auto& values = table.channels[channel].values;
    return bytes_of(std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(from),
                                        values.begin() + static_cast<std::ptrdiff_t>(from + count)));
  };
  const std::vector<std::string> about_disp = {property("unit_string", "mm"), property("wf_increment", table.step)};
  const std::vector<std::string> about_load = {property("unit_string", "kN"), property("wf_increment", table.step)};
  // Ten of each; again without metadata, in two chunks; the same as before; other lengths; the unit at last.
  std::string bytes = segment(metadata | new_list | numbers,
                              objects({object("/", no_numbers(), {property("author", "nobody")}),
                                       object("/'G'/'disp'", index(f64, 10), {about_disp[0]}),
                                       object("/'G'/'Load'", index(f64, 10), about_load)}),
                              part(0, 0, 10) + part(1, 0, 10));
  bytes += segment(numbers, "", part(0, 10, 10) + part(1, 10, 10) + part(0, 20, 10) + part(1, 20, 10));
  bytes += segment(metadata | new_list | numbers,
                   objects({object("/'G'/'disp'", as_before(), {}), object("/'G'/'Load'", as_before(), {})}),
                   part(0, 30, 10) + part(1, 30, 10));
  bytes += segment(metadata | numbers, objects({object("/'G'/'Load'", index(f64, 20), {})}),
                   part(0, 40, 10) + part(1, 40, 20));
  bytes += segment(metadata | new_list | numbers, objects({object("/'G'/'disp'", index(f64, 46), {about_disp[1]})}),
                   part(0, 50, 46));
  bytes +=
      segment(metadata | new_list | numbers, objects({object("/'G'/'Load'", index(f64, 36), {})}), part(1, 60, 36));
  FileTable two = table;
  two.channels.pop_back();
  const TemporaryFolder folder;
  expect_same(read("TDMS", bytes), load_recording(folder.write("r.csv", csv_of(two))));
}

// One step, unit and start hold for all numbers of a channel: what says another of later ones is refused where the
// channel is used.
TEST(Tdms, SegmentsThatContradictThoseBeforeAreRefused) {
  using namespace tdms;
  const FileTable table = damper(20);
  const std::string data = bytes_of(table.channels[0].values) + bytes_of(table.channels[1].values);
  const auto file = [&](const std::vector<std::string>& first, const std::vector<std::string>& second,
                        const std::string& name = "Load") {
    const auto channels = [&](const std::vector<std::string>& about) {
      return objects({object("/'G'/'disp'", index(f64, 20), {property("wf_increment", 0.25)}),
                      object("/'G'/'" + name + "'", index(f64, 20), about)});
    };
    return segment(metadata | new_list | numbers, channels(first), data) +
           segment(metadata | new_list | numbers, channels(second), data);
  };
  const auto refused = [&](const std::vector<std::string>& first, const std::vector<std::string>& second) {
    return refusal("TDMS", file(first, second));
  };
  const std::string step = property("wf_increment", 0.25);
  const std::string load = "r: channel '/'G'/'Load'' changes its ";
  EXPECT_EQ(refused({step}, {property("wf_increment", 0.5)}),
            load + "wf_increment from 0.25 to 0.5 behind 20 values, expected one for all of them");
  EXPECT_EQ(refused({step, property("unit_string", "N")}, {property("unit_string", "kN")}),
            load + "unit_string from 'N' to 'kN' behind 20 values, expected one for all of them");
  const std::string parts = ", expected one start and no pause: save the parts as recordings of their own";
  EXPECT_EQ(refused({step}, {property("wf_start_offset", 8.0)}),
            load + "wf_start_offset behind 20 values, by 8 s where they last 5 s" + parts);
  EXPECT_EQ(refused({step, property("wf_start_offset", 1.0)}, {step, property("wf_start_offset", 9.0)}),
            load + "wf_start_offset behind 20 values, by 8 s where they last 5 s" + parts);
  EXPECT_EQ(refused({step, time_property("wf_start_time", 100, 0)}, {time_property("wf_start_time", 200, 0)}),
            load + "wf_start_time behind 20 values, by 100 s where they last 5 s" + parts);
  // What says the same, goes on, or is said at last is none.
  for (const auto& [first, second] : std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>{
           {{step, property("unit_string", "N")}, {step, property("unit_string", "N ")}},
           {{step, property("wf_start_offset", 0.0)}, {step, property("wf_start_offset", 5.0)}},
           {{}, {step, property("wf_start_offset", 0.0)}},
           {{step, property("unit_string", "")}, {property("unit_string", "N")}}}) {
    const Recording r = read("TDMS", file(first, second));
    ASSERT_EQ(r.size(), 40U);
    EXPECT_EQ(r.time[39], 0.25 * 39.0);
    EXPECT_EQ(r.force[39], table.channels[1].values[19]);
  }
  // A channel that nothing uses may.
  std::string bytes = file({step}, {});
  bytes += segment(metadata | new_list | numbers,
                   objects({object("/'G'/'oil'", index(f64, 20), {property("unit_string", "K")})}),
                   bytes_of(table.channels[2].values));
  bytes += segment(metadata | new_list | numbers,
                   objects({object("/'G'/'oil'", index(f64, 20), {property("unit_string", "C")})}),
                   bytes_of(table.channels[2].values));
  EXPECT_EQ(read("TDMS", bytes).size(), 40U);
  EXPECT_TRUE(read("TDMS", bytes).unused.empty());
}

TEST(Tdms, UnitsThatContradictEachOtherAreRefused) {
  using namespace tdms;
  const FileTable table = damper(20);
  const auto file = [&](const std::string& name, const std::vector<std::string>& about) {
    std::vector<std::string> properties = {property("wf_increment", 0.25)};
    properties.insert(properties.end(), about.begin(), about.end());
    return segment(metadata | new_list | numbers,
                   objects({object("/'G'/'disp'", index(f64, 20), {property("wf_increment", 0.25)}),
                            object("/'G'/'" + name + "'", index(f64, 20), properties)}),
                   bytes_of(table.channels[0].values) + bytes_of(table.channels[1].values));
  };
  const std::string newtons = property("unit_string", "N");
  const std::string kilonewtons = property("NI_UnitDescription", "kN");
  const auto message = [](const std::string& column, const std::string& name, const std::string& units) {
    return "r: column '" + column + "' is given in " + units + ", expected one unit, or column force=\"" + name +
           " [UNIT]\" to choose";
  };
  EXPECT_EQ(refusal("TDMS", file("Load", {newtons, kilonewtons})), message("Load [N]", "Load", "'N' and in 'kN'"));
  EXPECT_EQ(refusal("TDMS", file("Load [kN]", {newtons})), message("Load [kN]", "Load", "'N' and in 'kN'"));
  EXPECT_EQ(refusal("TDMS", file("Load [N]", {newtons, kilonewtons})), message("Load [N]", "Load", "'N' and in 'kN'"));
  EXPECT_EQ(refusal("TDMS", file("Load [kN]", {newtons, kilonewtons})),
            message("Load [kN]", "Load", "'N' and in 'kN'"));
  ReadOptions chosen;
  chosen.columns = {{"force", "Load [kN]"}};
  EXPECT_EQ(read("TDMS", file("Load", {newtons, kilonewtons}), chosen).force[0], 20e3);
  // One unit, in any spelling; one alone; a note that is none.
  EXPECT_EQ(read("TDMS", file("Load", {newtons, property("NI_UnitDescription", "newtons")})).force[0], 20.0);
  EXPECT_EQ(read("TDMS", file("Load", {kilonewtons})).force[0], 20e3);
  EXPECT_EQ(read("TDMS", file("Load", {newtons, property("NI_UnitDescription", "of rig 3")})).force[0], 20.0);
}

TEST(Tdms, AStepThatIsNoneIsNotThatOfAnotherChannel) {
  using namespace tdms;
  const FileTable table = damper(20);
  const auto file = [&](double step) {
    return segment(metadata | new_list | numbers,
                   objects({object("/'G'/'disp'", index(f64, 20), {property("wf_increment", step)}),
                            object("/'G'/'Load'", index(f64, 20), {property("wf_increment", 0.25)})}),
                   bytes_of(table.channels[0].values) + bytes_of(table.channels[1].values));
  };
  const std::string times = "r: the times of 'disp' have a step of ";
  EXPECT_EQ(refusal("TDMS", file(-0.25)), times + "-0.25, expected one above zero in s");
  EXPECT_EQ(refusal("TDMS", file(0.0)), times + "0, expected one above zero in s");
  EXPECT_EQ(refusal("TDMS", file(std::nan(""))), times + "nan, expected one above zero in s");
  EXPECT_EQ(refusal("TDMS", file(std::numeric_limits<double>::infinity())),
            times + "inf, expected one above zero in s");
  EXPECT_EQ(read("TDMS", file(0.25)).size(), 20U);
}

TEST(Tdms, InterleavedAndBigEndianNumbersAreRead) {
  using namespace tdms;
  const FileTable table = damper(40);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string data;
    for (std::size_t k = 0; k < 40; ++k) {
      data += bytes_of(static_cast<float>(table.channels[0].values[k]), order);
      data += bytes_of(static_cast<std::int16_t>(4.0 * table.channels[1].values[k]), order);
    }
    const std::string about =
        objects({object("/'G'/'disp'", index(f32, 20, order),
                        {property("unit_string", "mm", order), property("wf_increment", 0.5, order)}, order),
                 object("/'G'/'Load'", index(i16, 20, order),
                        {property("unit_string", "N", order), property("wf_increment", 0.5, order)}, order)},
                order);
    const std::uint32_t endian = order == std::endian::big ? big_endian : 0;
    const Recording r = read("TDMS", segment(metadata | new_list | numbers | interleaved | endian, about, data));
    ASSERT_EQ(r.size(), 40U);
    for (std::size_t k = 0; k < 40; ++k) {
      EXPECT_EQ(r.displacement[k], table.channels[0].values[k] * 1e-3);
      EXPECT_EQ(r.force[k], 4.0 * table.channels[1].values[k]);
      EXPECT_EQ(r.time[k], 0.5 * static_cast<double>(k));
    }
  }
}

TEST(Tdms, ATimeChannelServesItsGroup) {
  using namespace tdms;
  const std::vector<double> values = damper(20).channels[0].values;
  std::vector<double> ms;
  std::string stamps;
  for (int k = 0; k < 20; ++k) {
    ms.push_back(2.0 * k);
    // 2 ms are 2^64 / 500 fractions; half seconds are exact.
    stamps += bytes_of(k % 2 == 0 ? std::uint64_t{0} : std::uint64_t{1} << 63U) +
              bytes_of(std::int64_t{3'900'000'000 + k / 2});
  }
  const auto file = [&](const std::string& time, const std::string& data) {
    return segment(metadata | new_list | numbers,
                   objects({time, object("/'G'/'x'", index(f64, 20), {property("unit_string", "mm")}),
                            object("/'G'/'F'", index(f64, 20), {})}),
                   data + bytes_of(values) + bytes_of(values));
  };
  const Recording r =
      read("TDMS", file(object("/'G'/'Time'", index(f64, 20), {property("unit_string", "ms")}), bytes_of(ms)));
  EXPECT_DOUBLE_EQ(r.time[3], 6e-3);
  EXPECT_DOUBLE_EQ(read("TDMS", file(object("/'G'/'Total Time (ms)'", index(f64, 20), {}), bytes_of(ms))).time[3],
                   6e-3);
  EXPECT_EQ(
      refusal("TDMS", file(object("/'G'/'Time [s]'", index(f64, 20), {property("unit_string", "ms")}), bytes_of(ms))),
      "r: column 'Time [s]' is given in 'ms' and in 's', expected one unit, or column time=\"Time [UNIT]\" to "
      "choose");
  EXPECT_EQ(read("TDMS", file(object("/'G'/'Time'", index(time_type, 20), {}), stamps)).time[3], 1.5);
  EXPECT_EQ(
      refusal("TDMS", file(object("/'G'/'Clock'", index(f64, 20), {}), bytes_of(ms))),
      "r: 'F' has no times: neither a start and a step nor a channel named time with as many values in its group, "
      "expected one, or column time=NAME");
  ReadOptions mapped;
  mapped.columns = {{"time", "Clock [ms]"}};
  EXPECT_DOUBLE_EQ(read("TDMS", file(object("/'G'/'Clock'", index(f64, 20), {}), bytes_of(ms)), mapped).time[3], 6e-3);
}

TEST(Tdms, StartTimesShiftChannels) {
  using namespace tdms;
  std::vector<double> ramp;
  for (int k = 0; k < 40; ++k) ramp.push_back(k);
  const auto channel = [](const std::string& name, std::int64_t seconds, std::uint64_t fraction) {
    return object("/'G'/'" + name + "'", index(f64, 40),
                  {property("wf_increment", 0.25), time_property("wf_start_time", seconds, fraction)});
  };
  const Recording r =
      read("TDMS", segment(metadata | new_list | numbers,
                           objects({channel("disp", 100, 0), channel("force", 101, std::uint64_t{1} << 63U)}),
                           bytes_of(ramp) + bytes_of(ramp)));
  // The force begins 1.5 s, six samples, later.
  ASSERT_EQ(r.size(), 34U);
  EXPECT_EQ(r.time[0], 1.5);
  EXPECT_EQ(r.force[0], 0.0);
  EXPECT_EQ(r.displacement[0], 6.0);
}

// The force begins 1.5 s after the displacement: the recording starts with it.
TEST(Tdms, TheStartOfAWaveformIsThatOfItsFirstValue) {
  using namespace tdms;
  constexpr std::int64_t from_1904 = 2'082'844'800;
  std::vector<double> ramp;
  for (int k = 0; k < 40; ++k) ramp.push_back(k);
  const auto file = [&](const std::string& root, std::int64_t start) {
    const auto channel = [](const std::string& name, std::int64_t seconds, std::uint64_t fraction) {
      return object("/'G'/'" + name + "'", index(f64, 40),
                    {property("wf_increment", 0.25), time_property("wf_start_time", seconds, fraction)});
    };
    return segment(metadata | new_list | numbers,
                   objects({root, channel("disp", start, 0),
                            channel("force", start == 0 ? 0 : start + 1, start == 0 ? 0 : std::uint64_t{1} << 63U)}),
                   bytes_of(ramp) + bytes_of(ramp));
  };
  const std::string bare = object("/", no_numbers(), {});
  const std::string dated = object("/", no_numbers(), {time_property("DateTime", 1'700'000'100 + from_1904, 0)});
  EXPECT_EQ(read("TDMS", file(bare, 1'700'000'000 + from_1904)).started, 1'700'000'001.5);
  EXPECT_EQ(read("TDMS", file(dated, 1'700'000'000 + from_1904)).started, 1'700'000'001.5);
  // Zero stands for times without a date: that of the file counts, where it has one.
  EXPECT_EQ(read("TDMS", file(dated, 0)).started, 1'700'000'100.0);
  EXPECT_FALSE(read("TDMS", file(bare, 0)).started);
  EXPECT_FALSE(read("TDMS", file(object("/", no_numbers(), {property("DateTime", "yesterday")}), 0)).started);
}

TEST(Tdms, TheFirstTimeStampIsTheStart) {
  using namespace tdms;
  constexpr std::int64_t from_1904 = 2'082'844'800;
  const std::vector<double> values = damper(20).channels[0].values;
  std::string stamps;
  for (int k = 0; k < 20; ++k) stamps += bytes_of(std::uint64_t{1} << 62U) + bytes_of(1'700'000'000 + from_1904 + k);
  const Recording r =
      read("TDMS", segment(metadata | new_list | numbers,
                           objects({object("/'G'/'Time'", index(time_type, 20), {}),
                                    object("/'G'/'x'", index(f64, 20), {}), object("/'G'/'F'", index(f64, 20), {})}),
                           stamps + bytes_of(values) + bytes_of(values)));
  EXPECT_EQ(r.started, 1'700'000'000.25);
  EXPECT_EQ(r.time[1], 1.0);
}

TEST(Tdms, LinearScalesAreApplied) {
  using namespace tdms;
  const std::vector<double> values = damper(20).channels[0].values;
  const auto file = [&](const std::vector<std::string>& about) {
    return segment(metadata | new_list | numbers,
                   objects({object("/'G'/'disp'", index(f64, 20), {property("wf_increment", 0.1)}),
                            object("/'G'/'force'", index(f64, 20), about)}),
                   bytes_of(values) + bytes_of(values));
  };
  std::vector<std::string> about = {property("wf_increment", 0.1),
                                    property("NI_Scaling_Status", "unscaled"),
                                    property("NI_Number_Of_Scales", 2.0),
                                    property("NI_Scale[0]_Scale_Type", "Linear"),
                                    property("NI_Scale[0]_Linear_Slope", 2.0),
                                    property("NI_Scale[0]_Linear_Y_Intercept", 1.0),
                                    property("NI_Scale[0]_Linear_Input_Source", 4294967295.0),
                                    property("NI_Scale[1]_Scale_Type", "Linear"),
                                    property("NI_Scale[1]_Linear_Slope", 10.0),
                                    property("NI_Scale[1]_Linear_Y_Intercept", -3.0),
                                    property("NI_Scale[1]_Linear_Input_Source", 0.0)};
  EXPECT_DOUBLE_EQ(read("TDMS", file(about)).force[5], 10.0 * (2.0 * values[5] + 1.0) - 3.0);
  about[1] = property("NI_Scaling_Status", "scaled");
  EXPECT_DOUBLE_EQ(read("TDMS", file(about)).force[5], values[5]);
  about[1] = property("NI_Scaling_Status", "unscaled");
  about[7] = property("NI_Scale[1]_Scale_Type", "Thermocouple");
  EXPECT_EQ(
      refusal("TDMS", file(about)),
      "r: channel '/'G'/'force'' is stored unscaled with a scale 'Thermocouple', expected a linear one, or numbers "
      "saved scaled");
}

TEST(Tdms, TwoGroupsWithAForceAskForOne) {
  using namespace tdms;
  std::vector<std::string> all;
  std::string data;
  for (const std::string group : {"A", "B"}) {
    for (const std::string name : {"disp", "force"}) {
      all.push_back(object("/'" + group + "'/'" + name + "'", index(f64, 20), {property("wf_increment", 0.1)}));
      data += bytes_of(std::vector<double>(20, group == "A" ? 1.0 : 2.0));
    }
  }
  const std::string bytes = segment(metadata | new_list | numbers, objects(all), data);
  EXPECT_EQ(refusal("TDMS", bytes),
            "r: groups 'A' and 'B' hold a displacement each, expected one, or group NAME to choose a group, or column "
            "displacement=GROUP/NAME");
  ReadOptions options;
  options.group = "B";
  EXPECT_EQ(read("TDMS", bytes, options).force[0], 2.0);
  options.group.clear();
  options.columns = {{"force", "A/force"}, {"displacement", "B/disp"}};
  EXPECT_EQ(read("TDMS", bytes, options).force[0], 1.0);
  EXPECT_EQ(read("TDMS", bytes, options).displacement[0], 2.0);
}

TEST(Tdms, WhatIsNotReadIsRefused) {
  using namespace tdms;
  const auto channel = [](std::uint32_t type) {
    return objects({object("/'G'/'disp'", index(type, 20), {property("wf_increment", 0.1)}),
                    object("/'G'/'force'", index(type, 20), {property("wf_increment", 0.1)})});
  };
  const std::string data(320, '\0');
  EXPECT_EQ(
      refusal("TDMS", segment(metadata | numbers | daqmx, channel(f64), data)),
      "r: the file holds raw data of DAQmx, which this program does not scale, expected numbers: save them scaled");
  EXPECT_EQ(
      refusal("TDMS",
              segment(metadata | numbers, objects({object("/'G'/'disp'", bytes_of(std::uint32_t{0x1269}), {})}), data)),
      "r: channel '/'G'/'disp'' holds raw data of DAQmx, which this program does not scale, expected numbers: save "
      "them scaled");
  EXPECT_EQ(refusal("TDMS", segment(metadata | new_list | numbers, channel(0x08000C), data)),
            "r: channel '/'G'/'disp'' holds complex or extended numbers, expected numbers");
  EXPECT_EQ(
      refusal("TDMS", segment(metadata | new_list | numbers, channel(0x4F), data)),
      "r: channel '/'G'/'disp'' holds numbers of the unknown type 79, expected integers, floating numbers or times");
  EXPECT_EQ(refusal("TDMS", segment(metadata | new_list | numbers, channel(f64), data.substr(0, 300))),
            "r: the segment at byte 0 has fewer bytes than its channels, the file is damaged, expected a complete TDMS "
            "file");
  EXPECT_EQ(
      refusal("TDMS", segment(metadata | new_list | numbers, channel(f64), data + "1234")),
      "r: the segment at byte 0 has bytes left behind its last chunk, the file is damaged, expected a complete TDMS "
      "file");
  std::string open = segment(metadata | new_list | numbers, channel(f64), data);
  open.replace(12, 8, 8, '\xFF');
  EXPECT_EQ(refusal("TDMS", open),
            "r: the segment at byte 0 was never closed, its program ended early, expected a complete TDMS file");
  EXPECT_EQ(refusal("TDMS", segment(metadata | new_list | numbers, channel(f64), data, 4711)),
            "r: TDMS of the unknown version 4711, expected 4712 or 4713");
}

// --- MDF 4 ---

std::string packed(const std::string& plain) {
  uLongf size = compressBound(static_cast<uLong>(plain.size()));
  std::string bytes(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(plain.data()),
                     static_cast<uLong>(plain.size())),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

// Records of 14 bytes: time as 32-bit ticks of 1 ms, displacement as a float, 12 bits of force from bit 3 on,
// big-endian current of 16 bits, a byte of marks.
std::string mdf_records(std::size_t count) {
  std::string records;
  for (std::size_t k = 0; k < count; ++k) {
    const auto n = static_cast<std::int32_t>(k);
    const auto force = static_cast<std::uint16_t>((static_cast<std::uint32_t>(n * n - 900) & 0xFFFU) << 3U);
    records += bytes_of(static_cast<std::uint32_t>(10 * k)) + bytes_of(0.5F * static_cast<float>(k)) + bytes_of(force) +
               bytes_of(static_cast<std::int16_t>(-n), std::endian::big) + std::string(1, '\0') + std::string(1, '\0');
  }
  return records;
}

template <class MakeData>
std::string mdf_file(std::size_t count, const MakeData& make_data, std::uint32_t flags = 2) {
  Mdf4Writer w;
  const std::uint64_t ticks = w.linear(0.0, 1e-3);
  const std::uint64_t force = w.linear(5.0, 2.0);
  const std::vector<Mdf4Writer::Channel> channels = {
      {.name = "t", .unit = "s", .kind = 2, .counts = 1, .type = 0, .bits = 32, .conversion = ticks},
      {.name = "x", .unit = "mm", .type = 4, .byte = 4, .bits = 32},
      {.name = "F", .unit = "N", .type = 2, .bit = 3, .byte = 8, .bits = 12, .conversion = force, .flags = flags},
      {.name = "I", .unit = "mA", .type = 3, .byte = 10, .bits = 16}};
  const std::uint64_t group = w.channel_group("", w.chain(channels), count, 13, 1);
  w.data_group(group, make_data(w, mdf_records(count)));
  return w.bytes();
}

void expect_mdf_records(const Recording& r, std::size_t count) {
  ASSERT_EQ(r.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto n = static_cast<double>(k);
    EXPECT_EQ(r.time[k], 1e-3 * (10.0 * n));
    EXPECT_EQ(r.displacement[k], 0.5 * n * 1e-3);
    EXPECT_EQ(r.force[k], 5.0 + 2.0 * (n * n - 900.0));
    EXPECT_EQ(r.drive[k], -n * 1e-3);
  }
}

std::string transposed(const std::string& records, std::size_t columns) {
  const std::size_t rows = records.size() / columns;
  std::string bytes;
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < rows; ++r) bytes += records[r * columns + c];
  }
  return bytes + records.substr(rows * columns);
}

TEST(Mdf4, DataBlocksOfEveryKindAreRead) {
  constexpr std::size_t n = 40;
  expect_mdf_records(
      read("MDF 4", mdf_file(n, [](Mdf4Writer& w, const std::string& r) { return w.block("DT", {}, r); })), n);
  expect_mdf_records(
      read("MDF 4", mdf_file(n, [](Mdf4Writer& w, const std::string& r) { return w.block("DV", {}, r); })), n);
  expect_mdf_records(
      read("MDF 4",
           mdf_file(n, [](Mdf4Writer& w, const std::string& r) { return w.packed(0, 0, r.size(), packed(r)); })),
      n);
  // Pieces that end within records, in two lists, some packed, one transposed with a rest, behind a header.
  expect_mdf_records(
      read("MDF 4", mdf_file(n,
                             [](Mdf4Writer& w, const std::string& r) {
                               const std::string second = r.substr(100, 205);
                               const std::uint64_t last = w.list({w.block("DT", {}, r.substr(305))});
                               const std::uint64_t list =
                                   w.list({w.block("DT", {}, r.substr(0, 100)),
                                           w.packed(1, 14, second.size(), packed(transposed(second, 14)))},
                                          last);
                               return w.block("HL", {list}, std::string("\x01\x00\x01", 3) + std::string(5, '\0'));
                             })),
      n);
}

TEST(Mdf4, RecordsWithAnIdentificationAreRead) {
  Mdf4Writer w;
  std::string records;
  for (int k = 0; k < 20; ++k) records += '\x07' + bytes_of(0.1 * k) + bytes_of(1.0 * k) + bytes_of(2.0 * k);
  const std::uint64_t channels = w.chain({{.name = "t", .kind = 2, .counts = 1},
                                          {.name = "disp", .unit = "mm", .byte = 8},
                                          {.name = "force", .unit = "N", .byte = 16}});
  w.data_group(w.channel_group("", channels, 20, 24, 0, 7), w.block("DT", {}, records), 1);
  const Recording r = read("MDF 4", w.bytes());
  EXPECT_EQ(r.time[3], 0.1 * 3);
  EXPECT_EQ(r.force[19], 38.0);
}

TEST(Mdf4, GroupsOfTheirOwnTimesAreJoined) {
  Mdf4Writer w;
  std::string slow;
  std::string fast;
  for (int k = 0; k < 50; ++k) slow += bytes_of(0.02 * k) + bytes_of(1.0 * k);
  for (int k = 0; k < 99; ++k) fast += bytes_of(0.01 * k) + bytes_of(100.0 * k);
  const std::uint64_t of_slow =
      w.chain({{.name = "time", .kind = 2, .counts = 1}, {.name = "disp", .unit = "mm", .byte = 8}});
  const std::uint64_t of_fast =
      w.chain({{.name = "time", .kind = 2, .counts = 1}, {.name = "force", .unit = "N", .byte = 8}});
  w.data_group(w.channel_group("fast", of_fast, 99, 16), w.block("DT", {}, fast));
  w.data_group(w.channel_group("slow", of_slow, 50, 16), w.block("DT", {}, slow));
  Told told;
  const Recording r = read("MDF 4", w.bytes(), told.options);
  ASSERT_EQ(r.size(), 99U);
  EXPECT_EQ(r.force[98], 9800.0);
  EXPECT_NEAR(r.displacement[51], 25.5e-3, 1e-15);
  EXPECT_TRUE(told.lines.at(0).starts_with("displacement (50 Hz) is put on the times of the force (100 Hz)"));
}

TEST(Mdf4, AVirtualMasterCountsRecords) {
  Mdf4Writer w;
  std::string records;
  for (int k = 0; k < 20; ++k) records += bytes_of(1.0 * k) + bytes_of(2.0 * k);
  const std::uint64_t clock = w.linear(0.5, 0.01);
  const std::uint64_t channels =
      w.chain({{.name = "t", .kind = 3, .counts = 1, .type = 0, .bits = 0, .conversion = clock},
               {.name = "disp", .unit = "mm", .byte = 0},
               {.name = "force", .unit = "N", .byte = 8}});
  w.data_group(w.channel_group("", channels, 20, 16), w.block("DT", {}, records));
  EXPECT_EQ(read("MDF 4", w.bytes()).time[3], 0.5 + 0.01 * 3.0);
}

// Times count from the start of the measurement, which is told in UTC, with or without the offsets to local time, or in
// local time.
TEST(Mdf4, TheStartIsThatOfTheMeasurementAndTheFirstTime) {
  const auto started = [](std::uint64_t moment, std::uint8_t flags) {
    Mdf4Writer w;
    std::string records;
    for (int k = 0; k < 20; ++k) records += bytes_of(2.5 + 0.25 * k) + bytes_of(1.0 * k) + bytes_of(2.0 * k);
    const std::uint64_t channels = w.chain({{.name = "t", .kind = 2, .counts = 1},
                                            {.name = "disp", .unit = "mm", .byte = 8},
                                            {.name = "force", .unit = "N", .byte = 16}});
    w.data_group(w.channel_group("", channels, 20, 24), w.block("DT", {}, records));
    w.start(moment, -300, 60, flags);
    return read("MDF 4", w.bytes()).started;
  };
  constexpr std::uint64_t moment = 1'700'000'000'500'000'000;
  EXPECT_EQ(started(moment, 0), 1'700'000'003.0);
  EXPECT_EQ(started(moment, 1), 1'700'000'003.0);
  EXPECT_EQ(started(moment, 2), 1'700'000'003.0 - 240.0 * 60.0);
  EXPECT_EQ(started(moment, 3), 1'700'000'003.0);
  EXPECT_FALSE(started(0, 2));
}

TEST(Mdf4, UnitsMayBeComments) {
  Mdf4Writer w;
  std::string records;
  for (int k = 0; k < 20; ++k) records += bytes_of(0.1 * k) + bytes_of(1.0 * k) + bytes_of(2.0 * k);
  const std::uint64_t unit = w.block("MD", {}, std::string("<CNunit xmlns=\"x\"><TX>kN</TX></CNunit>") + '\0');
  const std::uint64_t name = w.text("force");
  const std::uint64_t force = w.block("CN", {0, 0, name, 0, 0, 0, unit, 0},
                                      std::string("\x00\x00\x04\x00", 4) + bytes_of(std::uint32_t{16}) +
                                          bytes_of(std::uint32_t{64}) + std::string(60, '\0'));
  const std::uint64_t disp = w.channel({.name = "disp", .unit = "mm", .byte = 8}, force);
  const std::uint64_t time = w.channel({.name = "t", .kind = 2, .counts = 1}, disp);
  w.data_group(w.channel_group("", time, 20, 24), w.block("DT", {}, records));
  EXPECT_EQ(read("MDF 4", w.bytes()).force[1], 2000.0);
}

// The standard has the unit of a conversion apply where its channel has none.
TEST(Mdf4, TheUnitOfAChannelGoesBeforeThatOfItsConversion) {
  const auto file = [](const std::string& name, const std::string& unit, const std::string& of_conversion) {
    Mdf4Writer w;
    std::string records;
    for (int k = 0; k < 20; ++k) records += bytes_of(0.1 * k) + bytes_of(1.0 * k) + bytes_of(2.0 * k);
    const std::uint64_t text = of_conversion.empty() ? 0 : w.text(of_conversion);
    const std::uint64_t conversion = w.linear(0.0, 1.0, text);
    const std::uint64_t channels = w.chain({{.name = "t", .kind = 2, .counts = 1},
                                            {.name = "disp", .unit = "mm", .byte = 8},
                                            {.name = name, .unit = unit, .byte = 16, .conversion = conversion}});
    w.data_group(w.channel_group("", channels, 20, 24), w.block("DT", {}, records));
    return w.bytes();
  };
  EXPECT_EQ(read("MDF 4", file("force", "N", "kN")).force[1], 2.0);
  EXPECT_NE(refusal("MDF 4", file("force [kN]", "N", "")).find("is given in 'N' and in 'kN'"), std::string::npos);
  EXPECT_EQ(read("MDF 4", file("force", "kN", "kN")).force[1], 2000.0);
  EXPECT_EQ(read("MDF 4", file("force", "", "kN")).force[1], 2000.0);
}

TEST(Mdf4, WhatIsNotReadIsRefused) {
  const auto plain = [](Mdf4Writer& w, const std::string& r) { return w.block("DT", {}, r); };
  std::string bytes = mdf_file(20, plain);
  bytes.replace(0, 8, "UnFinMF ");
  EXPECT_EQ(refusal("MDF 4", bytes),
            "r: was never finished by the program that wrote it, expected a finished MDF file: open and save it there");
  bytes = mdf_file(20, plain);
  bytes.replace(8, 4, "3.30");
  bytes.replace(28, 2, bytes_of(std::uint16_t{330}));
  EXPECT_EQ(refusal("MDF 4", bytes), "r: MDF of version 3.30, expected version 4: save it as MDF 4");

  Mdf4Writer unsorted;
  const std::uint64_t other = unsorted.channel_group("", unsorted.chain({{.name = "force"}}), 5, 8, 0, 2);
  const std::uint64_t one = unsorted.channel_group("", unsorted.chain({{.name = "disp"}}), 5, 8, 0, 1, other);
  unsorted.data_group(one, unsorted.block("DT", {}, std::string(90, '\0')), 1);
  EXPECT_EQ(
      refusal("MDF 4", unsorted.bytes()),
      "r: data group 1 is unsorted (records of several channel groups follow one another), expected a sorted file: "
      "save it sorted");

  EXPECT_EQ(refusal("MDF 4", mdf_file(20, plain, 1)), "r: channel 'F' is marked invalid as a whole, expected values");
  EXPECT_EQ(refusal("MDF 4", mdf_file(20,
                                      [](Mdf4Writer& w, std::string r) {
                                        r[14 * 6 + 13] = '\x01';
                                        return w.block("DT", {}, r);
                                      })),
            "r: value 7 of 'F' is marked invalid, expected a number");
  EXPECT_EQ(refusal("MDF 4",
                    mdf_file(20, [](Mdf4Writer& w, const std::string& r) { return w.block("DT", {}, r.substr(1)); })),
            "r: channel group 1 tells of 20 records of 14 bytes and has 279 bytes, the file is damaged, expected a "
            "complete MDF file");
  EXPECT_EQ(
      refusal("MDF 4", mdf_file(20, [](Mdf4Writer& w, const std::string& r) { return w.packed(3, 0, r.size(), r); })),
      "r: data packed by method 3, expected zlib, 0 or 1");
  // One block may not stand for many.
  EXPECT_NE(refusal("MDF 4", mdf_file(20,
                                      [](Mdf4Writer& w, const std::string& r) {
                                        const std::uint64_t half = w.block("DT", {}, r.substr(0, r.size() / 2));
                                        return w.list({half, half});
                                      }))
                .find("two links to the block at byte"),
            std::string::npos);
  // Nor may a few bytes unpack to more than they can.
  EXPECT_NE(
      refusal("MDF 4", mdf_file(20, [](Mdf4Writer& w,
                                       const std::string&) { return w.packed(0, 0, std::uint64_t{1} << 40U, "xx"); }))
          .find("packed data that cannot hold what they say"),
      std::string::npos);
}

// --- RPC III ---

TEST(Rpc3, IntegersAreScaledInBothByteOrders) {
  const FileTable table = damper(100);
  const TemporaryFolder folder;
  const Recording expected = load_recording(folder.write("r.csv", csv_of(table)));
  for (const auto& [name, order] :
       {std::pair{"BINARY_IEEE_LITTLE_END", std::endian::little}, std::pair{"BINARY", std::endian::little},
        std::pair{"BINARY_IEEE_BIG_END", std::endian::big}}) {
    SCOPED_TRACE(name);
    const std::string header = rpc3::header_of(name, rpc3::entries_of(table, 16, 32, "SHORT_INTEGER"));
    const std::string data = rpc3::data_of(table, 32, true, order);
    expect_same(read("RPC III", header + data), expected);
  }
}

TEST(Rpc3, UnitsOfWindowsAreUnderstood) {
  FileTable table = damper(64);
  table.channels[0].unit = "\xB5m";
  EXPECT_DOUBLE_EQ(read("RPC III", rpc3::file_of(table)).displacement[1], 1e-6 * table.channels[0].values[1]);
}

TEST(Rpc3, WithoutTheNumberOfSamplesTheFillOfTheLastFrameIsLeftOut) {
  const auto read_whole = [](const FileTable& table, std::vector<std::string>& lines) {
    rpc3::Entries entries = rpc3::entries_of(table, 32, 64, "FLOATING_POINT");
    std::erase_if(entries, [](const auto& entry) { return entry.first == "SAMPLES"; });
    Told told;
    Recording r = read("RPC III", rpc3::header_of("BINARY_IEEE_LITTLE_END", entries) + rpc3::data_of(table, 64, false),
                       told.options);
    lines = told.lines;
    std::erase_if(lines, [](const std::string& line) { return !line.starts_with("the header has no SAMPLES"); });
    return r;
  };
  const auto left_out = [](const std::string& count) {
    return std::vector<std::string>{"the header has no SAMPLES: the last " + count +
                                    ", in which no channel changes, are taken as what fills up the last frame and left "
                                    "out"};
  };
  const FileTable table = damper(100);
  std::vector<std::string> lines;
  // Filled with the last value, which was measured once.
  Recording r = read_whole(table, lines);
  ASSERT_EQ(r.size(), 100U);
  EXPECT_EQ(r.force[99], 1e3 * table.channels[1].values[99]);
  EXPECT_EQ(lines, left_out("28 samples"));
  // Filled with zeros.
  FileTable zeros = table;
  for (FileChannel& channel : zeros.channels) channel.values.resize(128, 0.0);
  r = read_whole(zeros, lines);
  ASSERT_EQ(r.size(), 100U);
  EXPECT_EQ(r.force[99], 1e3 * table.channels[1].values[99]);
  EXPECT_EQ(lines, left_out("28 samples"));
  // One channel at rest is no fill, nor are more zeros than the last frame holds.
  FileTable full = damper(128);
  std::ranges::fill(full.channels[1].values, 0.0);
  EXPECT_EQ(read_whole(full, lines).size(), 128U);
  EXPECT_TRUE(lines.empty());
  for (FileChannel& channel : full.channels) std::fill(channel.values.begin() + 80, channel.values.end(), 0.0);
  EXPECT_EQ(read_whole(full, lines).size(), 97U);
  EXPECT_EQ(lines, left_out("31 samples"));
}

TEST(Rpc3, TheDateIsTheStart) {
  const FileTable table = damper(64);
  const auto started = [&](const std::string& date) {
    rpc3::Entries entries = rpc3::entries_of(table, 32, 64, "FLOATING_POINT");
    entries.emplace_back("DATE", date);
    return read("RPC III", rpc3::header_of("BINARY", entries) + rpc3::data_of(table, 64, false)).started;
  };
  for (const std::string date :
       {"12:30:05 12-JAN-2020", "12-Jan-2020  12:30:05", "\"12:30:05 12-Jan-2020\"", "2020-01-12T12:30:05"}) {
    EXPECT_EQ(started(date), 1'578'832'205.0) << date;
  }
  // Day or month first, a century that is not told, no time of day, no day of the calendar.
  for (const std::string date : {"12:30:05 12-01-2020", "12:30:05 12-JAN-20", "12-JAN-2020", "12:30:05 31-FEB-2020",
                                 "12:30:05 PM 12-JAN-2020", "12:30:05 12-JNA-2020", ""}) {
    EXPECT_FALSE(started(date)) << date;
  }
}

// 3 frames of 32 points, groups of 64: some programs fill the second group, others end the file.
TEST(Rpc3, TheLastGroupMayBeCutOff) {
  FileTable table = damper(96);
  const std::string header = rpc3::header_of("BINARY", rpc3::entries_of(table, 32, 64, "FLOATING_POINT"));
  const Recording filled = read("RPC III", header + rpc3::data_of(table, 64, false));
  std::string data;
  for (const auto& [from, to] : {std::pair{0, 64}, std::pair{64, 96}}) {
    for (const FileChannel& channel : table.channels) {
      for (int k = from; k < to; ++k) data += bytes_of(static_cast<float>(channel.values[static_cast<std::size_t>(k)]));
    }
  }
  ASSERT_EQ(filled.size(), 96U);
  expect_same(read("RPC III", header + data), filled);
}

TEST(Rpc3, WrongHeadersAreToldByTheirKey) {
  const FileTable table = damper(64);
  const auto refused = [&](const std::string& key, const std::string& value) {
    rpc3::Entries entries = rpc3::entries_of(table, 32, 64, "FLOATING_POINT");
    for (auto& entry : entries) {
      if (entry.first == key) entry.second = value;
    }
    return refusal("RPC III", rpc3::header_of("BINARY", entries) + rpc3::data_of(table, 64, false));
  };
  EXPECT_EQ(refused("CHANNELS", "0"), "r: CHANNELS is '0', expected a whole number from 1 to 4096");
  EXPECT_EQ(refused("CHANNELS", "4"),
            "r: the header tells of 1024 bytes of data and 768 are there, the file is cut off or damaged, expected a "
            "complete RPC III file");
  EXPECT_EQ(refused("FRAMES", "9999999999999"),
            "r: FRAMES is '9999999999999', expected a whole number from 1 to 34359738368");
  EXPECT_EQ(refused("PTS_PER_GROUP", "48"), "r: PTS_PER_GROUP is 48, expected a multiple of PTS_PER_FRAME, 32");
  EXPECT_EQ(refused("DELTA_T", "-1"), "r: DELTA_T is '-1', expected a time in s above zero");
  EXPECT_EQ(refused("DATA_TYPE", "DOUBLE"), "r: DATA_TYPE is 'DOUBLE', expected SHORT_INTEGER or FLOATING_POINT");
  EXPECT_EQ(refused("HALF_FRAMES", "1"),
            "r: HALF_FRAMES is '1', expected 0: save the file without half frames at its ends");
  EXPECT_EQ(refused("UNITS.CHAN_2", "furlong"),
            "r: unknown unit 'furlong' of force, expected one of N, kN, MN, daN, mN, lbf, lb, kip, kgf");
}

// --- xlsx ---

std::string row(std::initializer_list<std::string> cells, const std::string& number = "") {
  std::string text = number.empty() ? "<row>" : "<row r=\"" + number + "\">";
  for (const std::string& cell : cells) text += cell;
  return text + "</row>";
}

std::string rows_of_numbers(int count, const std::string& second = "") {
  std::string text;
  for (int k = 0; k < count; ++k) {
    text += row({cell(0.1 * k), k == 3 && !second.empty() ? second : cell(1.0 * k), cell(2.0 * k)});
  }
  return text;
}

TEST(Rpc3, AKeyWithTwoValuesIsRefused) {
  const FileTable table = damper(64);
  const auto file = [&](const std::string& key, const std::string& value) {
    rpc3::Entries entries = rpc3::entries_of(table, 32, 64, "FLOATING_POINT");
    entries.emplace_back(key, value);
    return rpc3::header_of("BINARY", entries) + rpc3::data_of(table, 64, false);
  };
  EXPECT_EQ(refusal("RPC III", file("DELTA_T", "0.01")),
            "r: the header says DELTA_T twice, '0.0078125' and '0.01', expected one value");
  for (const char* key : {"UNITS.CHAN_2", "UNITS.CHAN_2 "}) {
    EXPECT_EQ(refusal("RPC III", file(key, "N")),
              "r: the header says UNITS.CHAN_2 twice, 'kN' and 'N', expected one value");
  }
  EXPECT_EQ(refusal("RPC III", file("NUM_PARAMS", "9")),
            "r: the header says NUM_PARAMS twice, '24' and '9', expected one value");
  // The same twice, and what nobody asks for.
  for (const auto& [key, value] :
       {std::pair("DELTA_T", "7.8125e-3"), {"UNITS.CHAN_2", "\"kN\" "}, {"TIME_TYPE", "DRIVE"}, {"UNITS.CHAN_2", ""}}) {
    EXPECT_EQ(read("RPC III", file(key, value)).force[0], 20e3) << key;
  }
}

TEST(Xlsx, TheTableIsFoundAmongNotes) {
  // A title, notes beside the table and below it, a row of units, an empty column.
  const std::string sheet =
      row({cell("Damper 7")}, "2") +
      row({"<c r=\"B4\" t=\"inlineStr\"><is><t>Time</t></is></c>",
           "<c r=\"D4\" t=\"inlineStr\"><is><r><t>Str</t></r><r><t>oke</t></r></is></c>",
           "<c r=\"E4\" t=\"str\"><f>A1</f><v>Load</v></c>"},
          "4") +
      row({"<c r=\"B5\" t=\"inlineStr\"><is><t>ms</t></is></c>", "<c r=\"D5\" t=\"inlineStr\"><is><t>mm</t></is></c>",
           "<c r=\"E5\" t=\"inlineStr\"><is><t>kN</t></is></c>"},
          "5");
  std::string numbers;
  for (int k = 0; k < 12; ++k) {
    const std::string n = std::to_string(6 + k);
    numbers += row({"<c r=\"B" + n + "\"><v>" + std::to_string(k) + "</v></c>",
                    "<c r=\"D" + n + "\" s=\"3\"><v>" + std::to_string(2 * k) + "</v></c>",
                    "<c r=\"E" + n + "\"><f>D" + n + "*2</f><v>" + std::to_string(4 * k) + "E0</v></c>",
                    "<c r=\"H" + n + "\" t=\"inlineStr\"><is><t>note</t></is></c>"},
                   n);
  }
  numbers += row({"<c r=\"A20\" t=\"inlineStr\"><is><t>the end</t></is></c>"}, "20");
  Told told;
  const Recording r = read("xlsx", zip_of(workbook_parts({{"Data", sheet + numbers}})), told.options);
  ASSERT_EQ(r.size(), 12U);
  EXPECT_DOUBLE_EQ(r.time[3], 3e-3);
  EXPECT_DOUBLE_EQ(r.displacement[3], 6e-3);
  EXPECT_DOUBLE_EQ(r.force[3], 12e3);
  EXPECT_EQ(told.lines.at(0), "the header is taken from row 4 of sheet 'Data', rows before it are not read");
}

// Rows from `first` on of times that go on, in the columns B to D.
std::string numbers_from(int first, int count, double time) {
  std::string text;
  for (int k = 0; k < count; ++k) {
    const std::string n = std::to_string(first + k);
    text += row({"<c r=\"B" + n + "\"><v>" + std::to_string(time + 0.1 * k) + "</v></c>",
                 "<c r=\"C" + n + "\"><v>" + std::to_string(k % 5) + "</v></c>",
                 "<c r=\"D" + n + "\"><v>" + std::to_string(k % 3) + "</v></c>"},
                n);
  }
  return text;
}
std::string names_at(const std::string& n) {
  const auto name = [&](const std::string& column, const std::string& word) {
    return "<c r=\"" + column + n + "\" t=\"inlineStr\"><is><t>" + word + "</t></is></c>";
  };
  return row({name("B", "time"), name("C", "disp"), name("D", "force")}, n);
}

TEST(Xlsx, AnEmptyRowEndsNoRecordingWithoutAWord) {
  const auto read_sheet = [](const std::string& below, std::vector<std::string>& lines) {
    Told told;
    const Recording r =
        read("xlsx", zip_of(workbook_parts({{"A", names_at("1") + numbers_from(2, 20, 0.0) + below}})), told.options);
    lines = told.lines;
    std::erase_if(lines,
                  [](const std::string& line) { return !line.starts_with("row ") && !line.starts_with("the table"); });
    return r.size();
  };
  std::vector<std::string> lines;
  const std::string read_on = "row 22 of sheet 'A' is empty and the numbers go on below: they are read";
  EXPECT_EQ(read_sheet(numbers_from(23, 10, 5.0), lines), 30U);
  EXPECT_EQ(lines, std::vector<std::string>{read_on});
  EXPECT_EQ(read_sheet(row({}, "22") + numbers_from(23, 10, 5.0) + numbers_from(40, 4, 9.0), lines), 34U);
  EXPECT_EQ(lines, std::vector<std::string>{read_on});
  // Another table, and a row of what somebody made of this one.
  EXPECT_EQ(read_sheet(names_at("23") + numbers_from(24, 10, 0.0), lines), 20U);
  EXPECT_EQ(lines, std::vector<std::string>{
                       "the table ends with row 21 of sheet 'A', the numbers from row 24 on are not read"});
  std::string mean = numbers_from(23, 1, 9.0);
  mean.insert(mean.find("<c "), "<c r=\"A23\" t=\"inlineStr\"><is><t>mean</t></is></c>");
  EXPECT_EQ(read_sheet(mean, lines), 20U);
  EXPECT_TRUE(lines.empty());
}

TEST(Xlsx, ATitleRightAboveTheNamesIsPassedOver) {
  const std::string title = row({"<c/>", cell("Load test"), cell("Damper 7"), cell("J. Doe")}, "1");
  const auto header_of = [&](const std::string& sheet, const ReadOptions& columns = {}) {
    Told told;
    told.options.columns = columns.columns;
    EXPECT_EQ(read("xlsx", zip_of(workbook_parts({{"A", sheet}})), told.options).size(), 20U);
    return told.lines.at(0);
  };
  const std::string second = "the header is taken from row 2 of sheet 'A', rows before it are not read";
  EXPECT_EQ(header_of(title + names_at("2") + numbers_from(3, 20, 0.0)), second);
  const std::string units = row({"<c/>", cell("s"), cell("mm"), cell("N")}, "3");
  EXPECT_EQ(header_of(title + names_at("2") + units + numbers_from(4, 20, 0.0)), second);
  // Names nobody knows.
  const std::string others = row({"<c/>", cell("Zeit"), cell("Weg"), cell("Kraft")}, "2");
  ReadOptions columns;
  columns.columns = {{"time", "Zeit"}, {"displacement", "Weg"}, {"force", "Kraft"}};
  EXPECT_EQ(header_of(title + others + numbers_from(3, 20, 0.0), columns), second);
}

TEST(Xlsx, WrongCellsAreToldByTheirRow) {
  const std::string head = row({cell("time"), cell("disp"), cell("force")});
  const auto refused = [&](const std::string& second) {
    return refusal("xlsx", zip_of(workbook_parts({{"A", head + rows_of_numbers(20, second)}})));
  };
  EXPECT_EQ(refused("<c/>"), "r:5: displacement is empty, expected a finite number");
  EXPECT_EQ(refused("<c t=\"e\"><v>#N/A</v></c>"), "r:5: displacement 'N/A' is not a number, expected a finite number");
  EXPECT_EQ(refused("<c t=\"s\"><v>7</v></c>"),
            "r: the workbook is not read: a cell with text '7', which is not there, expected an .xlsx file");
}

// A workbook of one sheet with formats of cells: 0 General, 1 a built-in date, then one of each code.
std::string workbook_with_formats(const std::string& sheet, const std::vector<std::string>& codes,
                                  const std::string& properties = "") {
  auto parts = workbook_parts({{"A", sheet}});
  std::string& workbook = parts[parts.size() - 2].second;
  workbook.insert(workbook.find("<sheets>"), properties);
  const std::string target = "http://schemas.openxmlformats.org/officeDocument/2006/relationships/styles";
  std::string& relations = parts.back().second;
  relations.insert(relations.find("</Relationships>"),
                   "<Relationship Id=\"rIdS\" Type=\"" + target + "\" Target=\"styles.xml\"/>");
  std::string formats;
  std::string styles = "<xf numFmtId=\"0\"/><xf numFmtId=\"22\"/>";
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const std::string id = std::to_string(164 + k);
    formats += "<numFmt numFmtId=\"" + id + "\" formatCode=\"" + codes[k] + "\"/>";
    styles += "<xf numFmtId=\"" + id + "\"/>";
  }
  parts.emplace_back("xl/styles.xml", "<styleSheet><numFmts>" + formats +
                                          "</numFmts><cellStyleXfs><xf numFmtId=\"14\"/>"
                                          "</cellStyleXfs><cellXfs>" +
                                          styles + "</cellXfs></styleSheet>");
  return zip_of(parts);
}

// 10 mm at 2 Hz, 100 samples a second from 27 November 2026, 12:00 on, in cells of a style for each column.
std::string dated_sheet(const std::string& header, int time_style, int force_style = 0) {
  const auto styled = [](double value, int style) {
    return "<c s=\"" + std::to_string(style) + "\"><v>" + digits_of(value) + "</v></c>";
  };
  std::string sheet = header;
  for (int k = 0; k < 100; ++k) {
    const double phase = 0.04 * std::numbers::pi * k;
    sheet += row({styled(46353.5 + 0.01 * k / 86400.0, time_style), cell(10.0 * std::sin(phase)),
                  styled(500.0 * std::cos(phase), force_style)});
  }
  return sheet;
}

// Stored as 1 and 0, they are no numbers among numbers.
TEST(Xlsx, ATruthIsNoNumberAmongNumbers) {
  const std::string yes = "<c t=\"b\"><v>1</v></c>";
  const std::string no = "<c t=\"b\"><v>0</v></c>";
  const auto book = [&](const std::string& third, const std::string& valve) {
    std::string rows = row({cell("time [s]"), cell("x [mm]"), cell("force [N]"), cell("valve")});
    for (int k = 0; k < 10; ++k) {
      rows += row({cell(0.1 * k), cell(1.0 * k), k == 3 ? third : cell(2.0 * k), k < 5 ? valve : no});
    }
    return zip_of(workbook_parts({{"A", rows}}));
  };
  EXPECT_EQ(refusal("xlsx", book(yes, yes)), "r:5: force 'TRUE' is not a number, expected a finite number");
  EXPECT_EQ(refusal("xlsx", book(no, yes)), "r:5: force 'FALSE' is not a number, expected a finite number");
  // A column of its own is on or off.
  const Recording r = read("xlsx", book(cell(6.0), yes));
  ASSERT_EQ(r.unused.size(), 1U);
  EXPECT_EQ(r.unused[0].mean, 0.5);
  EXPECT_TRUE(read("xlsx", book(cell(6.0), cell(2.0))).unused.empty());
}

TEST(Xlsx, SkippedRowsAreTold) {
  std::string rows = row({cell("t"), cell("F")}) + row({cell(1.0), cell(2.0)});
  rows += row({cell("time [s]"), cell("x [mm]"), cell("force [N]")});
  for (int k = 0; k < 10; ++k) rows += row({cell(0.1 * k), cell(1.0 * k), cell(2.0 * k)});
  Told told;
  told.options.skip = 2;
  EXPECT_EQ(read("xlsx", zip_of(workbook_parts({{"A", rows}})), told.options).force[3], 6.0);
  ASSERT_FALSE(told.lines.empty());
  EXPECT_EQ(told.lines[0], "the first 2 rows of sheet 'A' are not read, as skip says");
}

TEST(Xlsx, DatesAreReadInSecondsSinceTheFirst) {
  const std::string head = row({cell("Time"), cell("disp [mm]"), cell("force [N]")});
  const std::vector<std::string> dates = {"hh:mm:ss.000", "[$-409]d/mmm/yy h:mm", "[h]:mm:ss", "yyyy\\-mm\\-dd;@",
                                          "[ss].00"};
  for (std::size_t style = 1; style < 2 + dates.size(); ++style) {
    Told told;
    const Recording r =
        read("xlsx", workbook_with_formats(dated_sheet(head, static_cast<int>(style)), dates), told.options);
    ASSERT_EQ(r.size(), 100U);
    EXPECT_EQ(r.time[0], 0.0);
    EXPECT_NEAR(r.time[99], 0.99, 1e-6);
    ASSERT_EQ(told.lines.size(), 1U) << told.lines.back();
    EXPECT_EQ(told.lines[0],
              "the times of column 'Time' are dates or times of day: they are read in seconds since the first");
  }
  // Numbers, whatever letters their formats hold.
  for (const std::string code :
       {"0.00", "0.000 s", "0.0&quot; days&quot;", "[Red]0.00", "General&quot; s&quot;", "\\s0"}) {
    const Recording r = read("xlsx", workbook_with_formats(dated_sheet(head, 2), {code}));
    EXPECT_EQ(r.time[0], 46353.5) << code;
  }
}

// Style 2 and those behind it are the formats.
std::string sheet_in_styles(const std::string& head, int displacement_style, int force_style) {
  const auto styled = [](double value, int style) {
    return "<c s=\"" + std::to_string(style) + "\"><v>" + digits_of(value) + "</v></c>";
  };
  std::string sheet = head;
  for (int k = 0; k < 20; ++k) {
    sheet += row({cell(0.1 * k), styled(1.0 * (k % 7), displacement_style), styled(2.0 * (k % 5), force_style)});
  }
  return sheet;
}

TEST(Xlsx, TheFormatOfNumbersTellsTheirUnit) {
  const std::string head = row({cell("time [s]"), cell("disp"), cell("Force")});
  for (const std::string code :
       {"0.0&quot; kN&quot;", "0.00 &quot;kN&quot;", "0\\ \\k\\N", "#,##0.0\\ [$kN]",
        "[Blue]0.00E+00&quot; [kN]&quot;;[Red]-0.0&quot; N&quot;", "General&quot; kN&quot;", "0.0_) &quot;kN&quot;"}) {
    Told told;
    const Recording r =
        read("xlsx", workbook_with_formats(sheet_in_styles(head, 3, 2), {code, "0.00 &quot;mm&quot;"}), told.options);
    EXPECT_EQ(r.force[1], 2000.0) << code;
    EXPECT_EQ(r.displacement[1], 1e-3) << code;
    ASSERT_GE(told.lines.size(), 2U) << code;
    EXPECT_EQ(told.lines[0], "the numbers of column 'disp', whose header has no unit, are shown in 'mm': it is taken");
    EXPECT_EQ(told.lines[1], "the numbers of column 'Force', whose header has no unit, are shown in 'kN': it is taken");
  }
  // Where --column gives a unit it is that one, without a word of the format.
  Told told;
  told.options.columns = {{"force", "Force [N]"}};
  const std::string bytes = workbook_with_formats(sheet_in_styles(head, 0, 2), {"0.0&quot; kN&quot;"});
  EXPECT_EQ(read("xlsx", bytes, told.options).force[1], 2.0);
  EXPECT_TRUE(std::ranges::none_of(told.lines, [](const std::string& line) { return line.find("'kN'") != line.npos; }));
}

TEST(Xlsx, AFormatThatContradictsTheHeaderIsRefused) {
  const auto book = [](const std::string& force, const std::string& code) {
    return workbook_with_formats(sheet_in_styles(row({cell("time [s]"), cell("disp [mm]"), cell(force)}), 0, 2),
                                 {code});
  };
  const std::string kilonewtons = "0.0&quot; kN&quot;";
  EXPECT_EQ(refusal("xlsx", book("Force [N]", kilonewtons)),
            "r:1: column 'Force [N]' is given in 'N' and in 'kN', expected one unit, or column force=\"Force "
            "[UNIT]\" to choose");
  ReadOptions chosen;
  chosen.columns = {{"force", "Force [N]"}};
  EXPECT_EQ(read("xlsx", book("Force [N]", kilonewtons), chosen).force[1], 2.0);
  EXPECT_EQ(read("xlsx", book("Force [kN]", kilonewtons)).force[1], 2000.0);
  // A row of units, too.
  const std::string rows = row({cell("time"), cell("disp"), cell("Force")}) + row({cell("s"), cell("mm"), cell("N")});
  EXPECT_NE(
      refusal("xlsx", workbook_with_formats(sheet_in_styles(rows, 0, 2), {kilonewtons})).find("in 'N' and in 'kN'"),
      std::string::npos);
  // Two formats in one column; below the table there may be any.
  std::string sheet = sheet_in_styles(row({cell("time [s]"), cell("disp [mm]"), cell("Force")}), 0, 2);
  const std::string newtons = "<c s=\"3\"><v>7</v></c>";
  const std::vector<std::string> codes = {kilonewtons, "0.0&quot; N&quot;"};
  EXPECT_EQ(refusal("xlsx", workbook_with_formats(sheet + row({cell(2.0), cell(1.0), newtons}), codes)),
            "r:22: a number of column 'Force' is shown in 'N', and that of row 2 in 'kN', expected one format");
  EXPECT_EQ(read("xlsx", workbook_with_formats(sheet + row({cell("largest"), "<c/>", newtons}, "25"), codes)).force[1],
            2000.0);
}

TEST(Xlsx, AFormatWithoutAKnownUnitIsTold) {
  const std::string head = row({cell("time [s]"), cell("disp [mm]"), cell("Force")});
  const auto told_of = [&](const std::string& code) {
    Told told;
    EXPECT_EQ(read("xlsx", workbook_with_formats(sheet_in_styles(head, 0, 2), {code}), told.options).force[1], 2.0);
    std::string line;
    for (const std::string& text : told.lines) line += text.find("column 'Force'") != text.npos ? text : "";
    return line;
  };
  EXPECT_EQ(told_of("0.0&quot; kp&quot;"),
            "the numbers of column 'Force', whose header has no unit, are shown in 'kp', which is no unit that is "
            "known: SI is taken");
  EXPECT_EQ(told_of("0.0,&quot; kN&quot;"),
            "the numbers of column 'Force', whose header has no unit, are shown in parts or multiples of 'kN': SI is "
            "taken, expected a unit in the header");
  for (const char* code : {"0.0", "#,##0.00", "0.0_);(0.0)", "# ?/?", "0.00E+00", "@", "[Red]0.0"}) {
    EXPECT_EQ(told_of(code), "") << code;
  }
}

TEST(Xlsx, TheFirstDateIsTheStart) {
  const std::string head = row({cell("Time"), cell("disp [mm]"), cell("force [N]")});
  EXPECT_EQ(read("xlsx", workbook_with_formats(dated_sheet(head, 1), {})).started, 1'795'780'800.0);
  // The same numbers in a workbook that counts days from 1904 are 1462 days later.
  const std::string since_1904 = workbook_with_formats(dated_sheet(head, 1), {}, "<workbookPr date1904=\"1\"/>");
  EXPECT_EQ(read("xlsx", since_1904).started, 1'795'780'800.0 + 1462.0 * 86400.0);
  // Times of day have no date.
  std::string times = head;
  for (int k = 0; k < 20; ++k) {
    times += row({"<c s=\"1\"><v>" + digits_of(0.5 + 1e-6 * k) + "</v></c>", cell(1.0 * k), cell(2.0 * k)});
  }
  EXPECT_FALSE(read("xlsx", workbook_with_formats(times, {})).started);
}

TEST(Xlsx, ARowAboveTheNamesTellsTheStart) {
  const std::string table = row({cell("time"), cell("disp"), cell("force")}) + rows_of_numbers(20);
  const auto date = [](double days) { return "<c s=\"1\"><v>" + digits_of(days) + "</v></c>"; };
  Told told;
  const auto started = [&](const std::string& above) {
    told.lines.clear();
    return read("xlsx", workbook_with_formats(above + table, {}), told.options).started;
  };
  for (const std::string& above :
       {row({cell("Started"), date(46353.5)}), row({cell("Start:"), cell("2026-11-27 12:00")}),
        row({cell("Damper 7")}) + row({cell("Date"), cell("2026-11-27T12:00:00"), cell("J. Doe")}),
        row({cell("# start: 2026-11-27T12:00:00")})}) {
    EXPECT_EQ(started(above), 1'795'780'800.0) << above;
    EXPECT_NE(told.lines.at(0).find(", of the rows before it the start alone is read"), std::string::npos);
  }
  // A date without its time of day, a number, a date of something else, a date that is not beside the word.
  for (const std::string& above :
       {row({cell("Date"), date(46353.0)}), row({cell("Start"), cell(46353.5)}),
        row({cell("Calibrated"), date(46353.5)}), row({cell("Start"), cell("by hand"), date(46353.5)})}) {
    EXPECT_FALSE(started(above)) << above;
    EXPECT_NE(told.lines.at(0).find(", rows before it are not read"), std::string::npos);
  }
}

TEST(Xlsx, DatesInAColumnWithAUnit) {
  const auto heads = [](const std::string& time) { return row({cell(time), cell("disp [mm]"), cell("force [N]")}); };
  for (const std::string time : {"Time [s]", "Time [hh:mm:ss]", "Test time"}) {
    EXPECT_NEAR(read("xlsx", workbook_with_formats(dated_sheet(heads(time), 1), {})).time[99], 0.99, 1e-6) << time;
  }
  const std::string units =
      row({cell("Time"), cell("disp"), cell("force")}) + row({cell("h:m:s"), cell("mm"), cell("N")});
  EXPECT_NEAR(read("xlsx", workbook_with_formats(dated_sheet(units, 1), {})).time[99], 0.99, 1e-6);
  EXPECT_EQ(refusal("xlsx", workbook_with_formats(dated_sheet(heads("Time [ms]"), 1), {})),
            "r:1: the times of column 'Time [ms]' are dates and their unit is 'ms', expected numbers, or dates without "
            "a unit");
  EXPECT_EQ(refusal("xlsx", workbook_with_formats(dated_sheet(heads("Time"), 0, 1), {})),
            "r:2: the force in column 'force [N]' is formatted as a date, expected a number");
}

TEST(Xlsx, WhatLooksLikeNumbersAndIsNoneIsTold) {
  const std::string head = row({cell("time [s]"), cell("disp [mm]"), cell("force [N]")});
  const auto refused = [&](const std::string& before, const auto& cell_of) {
    std::string sheet = head + before;
    for (int k = 0; k < 20; ++k) sheet += row({cell_of(k), cell_of(2 * k), cell_of(3 * k)});
    const std::string bytes = zip_of(workbook_parts({{"A", sheet}}));
    ReadOptions options;
    options.group = "A";
    EXPECT_EQ(refusal("xlsx", bytes, options), refusal("xlsx", bytes));
    return refusal("xlsx", bytes);
  };
  const auto text = [](int k) { return cell(std::string_view(std::to_string(k) + (k % 2 == 0 ? ".5" : ",5"))); };
  const auto formula = [](int k) { return "<c><f>" + std::to_string(k) + (k % 2 == 0 ? "</f></c>" : "</f><v/></c>"); };
  const std::string texts =
      " of sheet 'A', below names, holds numbers that are stored as text, expected cells of numbers";
  EXPECT_EQ(refused("", text), "r: row 2" + texts);
  EXPECT_EQ(refused(row({cell("s"), cell("mm"), cell("N")}), text), "r: row 3" + texts);
  EXPECT_EQ(
      refused("", formula),
      "r: row 2 of sheet 'A', below names, holds formulas whose values are not stored, expected a workbook that a "
      "spreadsheet program has saved");
}

TEST(Xlsx, SheetsAreChosenByGroup) {
  const std::string head = row({cell("time"), cell("disp"), cell("force")});
  const std::string bytes = zip_of(workbook_parts({{"Notes", row({cell("what"), cell("who")})},
                                                   {"Run 1", head + rows_of_numbers(20)},
                                                   {"Run 2", head + rows_of_numbers(30)}}));
  EXPECT_EQ(refusal("xlsx", bytes),
            "r: 2 sheets hold recordings ('Run 1', 'Run 2'), expected one, or group NAME to choose a sheet");
  ReadOptions options;
  options.group = "run 2";
  EXPECT_EQ(read("xlsx", bytes, options).size(), 30U);
  options.group = "Run 3";
  EXPECT_EQ(refusal("xlsx", bytes, options),
            "r: no sheet 'Run 3' for group, expected one of 'Notes', 'Run 1', 'Run 2'");
  options.group = "Notes";
  EXPECT_EQ(refusal("xlsx", bytes, options),
            "r: sheet 'Notes' has no row of names above rows of numbers, expected one");
}

TEST(Xlsx, WhichOfSeveralSheetsIsReadIsTold) {
  const std::string table = row({cell("time"), cell("disp"), cell("force")}) + rows_of_numbers(20);
  const std::string notes = row({cell("what"), cell("who")});
  // Sheets, and which of them are hidden.
  const auto told_of = [](const std::vector<std::pair<std::string, std::string>>& sheets,
                          const std::vector<std::string>& hidden, const std::string& group = "") {
    auto parts = workbook_parts(sheets);
    std::string& workbook = parts[parts.size() - 2].second;
    for (const std::string& name : hidden) {
      workbook.insert(workbook.find("<sheet name=\"" + name + "\"") + 7, "state=\"hidden\" ");
    }
    Told told;
    told.options.group = group;
    EXPECT_EQ(read("xlsx", zip_of(parts), told.options).size(), 20U);
    std::string line;
    for (const std::string& text : told.lines) line += text.starts_with("sheet ") ? text : "";
    return line;
  };
  EXPECT_EQ(told_of({{"Notes", notes}, {"Data", table}, {"Old", notes}}, {"Data"}),
            "sheet 'Data', which is hidden, is read, of 3 sheets: the others ('Notes', 'Old') hold no recording");
  EXPECT_EQ(told_of({{"Notes", notes}, {"Data", table}, {"Old", notes}}, {"Notes"}),
            "sheet 'Data' is read, of 3 sheets: the others ('Old', hidden: 'Notes') hold no recording");
  EXPECT_EQ(told_of({{"Data", table}, {"Raw", notes}}, {"Raw"}),
            "sheet 'Data' is read, of 2 sheets: the others (hidden: 'Raw') hold no recording");
  EXPECT_EQ(told_of({{"Data", table}, {"Raw", notes}}, {"Data"}, "data"), "") << "it is named";
  EXPECT_EQ(told_of({{"Data", table}}, {}), "");
}

// A filter hides rows, and what hides a column may be that another one was corrected.
TEST(Xlsx, HiddenRowsAndColumnsAreReadAndTold) {
  const std::string head = row({cell("time [s]"), cell("disp [mm]"), cell("force [N]"), cell("note")});
  const auto told_of = [&](int from, int to, const std::string& columns) {
    std::string sheet = head;
    for (int k = 0; k < 20; ++k) {
      std::string one = row({cell(0.1 * k), cell(1.0 * k), cell(2.0 * k), cell(3.0)});
      if (k >= from && k < to) one.insert(one.find("<row") + 4, " hidden=\"1\"");
      sheet += one;
    }
    auto parts = workbook_parts({{"A", sheet}});
    parts[0].second.insert(parts[0].second.find("<sheetData>"), columns);
    Told told;
    EXPECT_EQ(read("xlsx", zip_of(parts), told.options).size(), 20U);
    std::string lines;
    for (const std::string& line : told.lines) lines += line.find("hidden") == std::string::npos ? "" : line + "\n";
    return lines;
  };
  EXPECT_EQ(told_of(0, 0, ""), "");
  EXPECT_EQ(told_of(5, 6, ""), "row 7 of sheet 'A' is hidden: its numbers are read all the same\n");
  EXPECT_EQ(told_of(5, 9, ""), "4 rows of sheet 'A', from row 7 on, are hidden: their numbers are read all the same\n");
  const auto hides = [](const std::string& ends) { return "<cols><col " + ends + " hidden=\"1\"/></cols>"; };
  EXPECT_EQ(told_of(0, 0, hides(R"(min="3" max="3")")),
            "column 'force [N]' of sheet 'A' is hidden: it is read all the same\n");
  EXPECT_EQ(told_of(0, 0, hides(R"(min="2" max="16384")")),
            "columns 'disp [mm]', 'force [N]' of sheet 'A' are hidden: they are read all the same\n");
  EXPECT_EQ(told_of(0, 0, hides(R"(min="4" max="4")")), "") << "no channel";
}

TEST(Xlsx, EntitiesAndBombsAreRefused) {
  auto parts = workbook_parts({{"A", ""}});
  parts[0].second = "<?xml version=\"1.0\"?><!DOCTYPE x [<!ENTITY a \"aaaa\">]><worksheet><sheetData/></worksheet>";
  EXPECT_EQ(refusal("xlsx", zip_of(parts)),
            "r: the workbook is not read: its XML is not as it should be, a document type, expected an .xlsx file");
  std::string deep;
  for (int k = 0; k < 100; ++k) deep += "<a>";
  parts[0].second = deep;
  EXPECT_NE(refusal("xlsx", zip_of(parts)).find("nested deeper than 64"), std::string::npos);
  EXPECT_EQ(refusal("xlsx", std::string("\xD0\xCF\x11\xE0") + std::string(600, '\0')),
            "r: the workbook is not read: it is an old .xls file or protected by a password, expected an .xlsx file");
  EXPECT_EQ(refusal("xlsx", zip_of({{"mimetype", "application/vnd.oasis.opendocument.spreadsheet"}})),
            "r: the workbook is not read: it has no part '_rels/.rels', the file is damaged, expected an .xlsx file");
}

// 20 MiB of blanks in 20 KiB: a part that grows a thousandfold.
TEST(Xlsx, PartsThatGrowAThousandfoldAreRefused) {
  const std::string blanks(std::size_t{20} << 20U, ' ');
  const std::string with_zlib_head = packed("<worksheet>" + blanks + "</worksheet>");
  const std::string deflated = with_zlib_head.substr(2, with_zlib_head.size() - 6);
  auto parts = workbook_parts({{"A", ""}});
  parts[0].second = deflated;
  std::string bytes = zip_of(parts);
  // The first part is said to be deflated, in both of its heads; its size is that of the blanks.
  const std::string size = bytes_of(static_cast<std::uint32_t>(blanks.size() + 23));
  bytes.replace(8, 1, "\x08");
  bytes.replace(22, 4, size);
  const std::size_t directory = bytes.find("PK\x01\x02");
  bytes.replace(directory + 10, 1, "\x08");
  bytes.replace(directory + 24, 4, size);
  EXPECT_EQ(refusal("xlsx", bytes), "r: the workbook is not read: its part 'xl/worksheets/sheet1.xml' of " +
                                        std::to_string(deflated.size()) +
                                        " bytes unpacks to 20971543, which no recording does, expected an .xlsx file");
}

}  // namespace
}  // namespace hysteron

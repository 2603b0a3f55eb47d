// Recordings in every format through the program, and results for other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "app/program_fixture.hpp"
#include "io/campaign.hpp"
#include "io/measuring_files.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::FileTable;
using testing::Outcome;
using testing::Program;
using testing::read;
using testing::write;

// A viscous damper under a sine, in values that a float holds.
FileTable damper() {
  FileTable table{0.0078125, {{"Stroke", "mm", {}}, {"CH1", "", {}}}};
  for (int k = 0; k < 256; ++k) {
    const double phase = 2.0 * std::numbers::pi * k / 64.0;
    table.channels[0].values.push_back(0.0625 * std::round(160.0 * std::sin(phase)));
    table.channels[1].values.push_back(0.0625 * std::round(80.0 * std::cos(phase) + 40.0 * std::sin(phase)));
  }
  return table;
}

// model.json without the names and checksums of the recordings and the words of the command.
std::string model_of(const fs::path& folder) {
  json model = json::parse(read(folder / "model.json"));
  for (json& recording : model.at("fitted_on")) recording = nullptr;
  for (const char* key : {"command", "recordings"}) {
    if (model.contains("provenance")) model["provenance"].erase(key);
  }
  return model.dump();
}

std::vector<std::string> fit_of(const std::string& data, const std::string& out) {
  return {"fit", data, "--model", "viscous", "--column", "force=CH1 [kN]", "--budget", "300", "--quiet", "--out", out};
}

TEST_F(Program, FitsAreTheSameFromEveryFormat) {
  const FileTable table = damper();
  write(folder_ / "csv/r.csv", testing::csv_of(table));
  write(folder_ / "tdms/r.tdms", testing::tdms::file_of(table));
  write(folder_ / "mdf/r.mf4", testing::mdf4_of(table));
  write(folder_ / "rpc/r.rsp", testing::rpc3::file_of(table));
  write(folder_ / "xlsx/r.xlsx", testing::xlsx_of(table));
  ASSERT_EQ(run(fit_of("csv", "from-csv")).status, 0);
  const std::string expected = model_of(folder_ / "from-csv");
  EXPECT_GT(expected.size(), 300U);
  for (const std::string format : {"tdms", "mdf", "rpc", "xlsx"}) {
    const Outcome outcome = run(fit_of(format, "from-" + format));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(model_of(folder_ / ("from-" + format)), expected) << format;
  }
}

TEST_F(Program, RatesAreSaidInALine) {
  using namespace testing::tdms;
  const FileTable table = damper();
  std::vector<double> fast;
  for (const double value : table.channels[1].values) fast.insert(fast.end(), {value, value});
  const auto channel = [](const std::string& name, const std::string& unit, double step, std::size_t count) {
    return object("/'Run'/'" + name + "'", index(f64, count),
                  {property("unit_string", unit), property("wf_increment", step)});
  };
  write(folder_ / "r.tdms",
        segment(metadata | new_list | numbers,
                objects({channel("Stroke", "mm", 0.0078125, 256), channel("Load", "kN", 0.00390625, 512)}),
                testing::bytes_of(table.channels[0].values) + testing::bytes_of(fast)));
  const Outcome outcome =
      run({"fit", "r.tdms", "--model", "viscous", "--group", "run", "--budget", "300", "--quiet", "--out", "out"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(
      outcome.err,
      "warning: r.tdms: displacement (128 Hz) is put on the times of the force (256 Hz) by polynomials through the "
      "8 nearest samples; 1 sample of the force outside of the other channels' times is left out\n");
  const Outcome wrong = run({"fit", "r.tdms", "--model", "viscous", "--group", "walk", "--out", "none"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.err, "error: r.tdms: no group 'walk' for --group, expected 'Run'\n");
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Program, DamagedFilesEndInOneLine) {
  const std::string whole = testing::mdf4_of(damper());
  write(folder_ / "r.mf4", whole.substr(0, whole.size() / 2));
  const Outcome outcome = run(fit_of("r.mf4", "out"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(outcome.err.starts_with("error: r.mf4: ")) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Program, ResultsGoToMatFiles) {
  write(folder_ / "mine/r.csv", testing::csv_of(damper()));
  ASSERT_EQ(run(fit_of("mine", "out")).status, 0);
  for (const std::string out : {"p.csv", "p.mat"}) {
    ASSERT_EQ(run({"simulate", "out/model.json", "mine/r.csv", "--column", "force=CH1 [kN]", "--out", out}).status, 0);
    ASSERT_EQ(run({"score", "out/model.json", "mine", "--column", "force=CH1 [kN]", "--out", "score-" + out}).status,
              0);
  }
  ReadOptions options;
  options.displacement_required = false;
  const Recording csv = load_recording(folder_ / "p.csv", options);
  const Recording mat = load_recording(folder_ / "p.mat", options);
  EXPECT_EQ(csv.time, mat.time);
  EXPECT_EQ(csv.force, mat.force);
  ASSERT_EQ(csv.size(), 256U);
  const std::string table = read(folder_ / "score-p.csv");
  EXPECT_TRUE(table.starts_with("recording,nrmse,rmse [N],fit_percent\nr.csv,0.")) << table;
  EXPECT_TRUE(read(folder_ / "score-p.mat").starts_with("MATLAB 5.0 MAT-file"));
  const Outcome to_stdout = run({"score", "out/model.json", "mine", "--out", "-"});
  EXPECT_EQ(to_stdout.status, 2);

  const Outcome compared =
      run({"compare", "out/model.json", "mine", "--column", "force=CH1 [kN]", "--mat", "--out", "c"});
  ASSERT_EQ(compared.status, 0) << compared.err;
  EXPECT_TRUE(read(folder_ / "c/models.csv").starts_with("model,free_parameters,nrmse_overall,"));
  EXPECT_TRUE(read(folder_ / "c/recordings.csv")
                  .starts_with("recording,model,fitted,nrmse,rmse_n,fit_percent\nr.csv,viscous,1,0."));
  EXPECT_TRUE(read(folder_ / "c/tables.mat").starts_with("MATLAB 5.0 MAT-file"));
}

// An independent writer: python3-openpyxl.
TEST_F(Program, WorkbooksOfAnotherProgramAreRead) {
  const char* const script =
      "import sys, csv\n"
      "try:\n"
      "  import openpyxl\n"
      "except ImportError:\n"
      "  sys.exit(77)\n"
      "book = openpyxl.Workbook()\n"
      "book.active.title = 'Log'\n"
      "book.active.append(['tested by', 'somebody'])\n"
      "sheet = book.create_sheet('Run')\n"
      "for k, row in enumerate(csv.reader(open('r.csv'))):\n"
      "  sheet.append(row if k == 0 else [float(cell) for cell in row])\n"
      "book.save('r.xlsx')\n";
  write(folder_ / "r.csv", testing::csv_of(damper()));
  write(folder_ / "make.py", script);
  const pid_t made = testing::start_other("/usr/bin/python3", {"make.py"}, folder_);
  const int status = testing::wait_for(made);
  if (status == 77 || status == 99) GTEST_SKIP() << "python3-openpyxl is not installed";
  ASSERT_EQ(status, 0) << read(folder_ / "stderr.txt");
  ReadOptions options;
  options.columns = {{"force", "CH1 [kN]"}};
  const Recording csv = load_recording(folder_ / "r.csv", options);
  const Recording xlsx = load_recording(folder_ / "r.xlsx", options);
  EXPECT_EQ(csv.time, xlsx.time);
  EXPECT_EQ(csv.displacement, xlsx.displacement);
  EXPECT_EQ(csv.velocity, xlsx.velocity);
  EXPECT_EQ(csv.force, xlsx.force);
}

}  // namespace
}  // namespace hysteron

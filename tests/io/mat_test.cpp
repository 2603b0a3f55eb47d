#include "io/mat.hpp"

#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/campaign.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

// Writes a MAT file variable by variable.
class MatWriter {
 public:
  MatWriter(const std::filesystem::path& path, mat_ft version) : mat_(Mat_CreateVer(path.c_str(), nullptr, version)) {}
  ~MatWriter() { Mat_Close(mat_); }
  MatWriter(const MatWriter&) = delete;
  MatWriter& operator=(const MatWriter&) = delete;

  void matrix(const char* name, std::size_t rows, std::size_t columns, std::vector<double> values) {
    std::size_t dims[2] = {rows, columns};
    put(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, values.data(), 0));
  }
  void column(const char* name, std::vector<double> values) { matrix(name, values.size(), 1, values); }
  void singles(const char* name, std::vector<float> values) {
    std::size_t dims[2] = {1, values.size()};
    put(Mat_VarCreate(name, MAT_C_SINGLE, MAT_T_SINGLE, 2, dims, values.data(), 0));
  }
  void units(std::vector<std::pair<const char*, std::string>> fields) {
    std::vector<const char*> names;
    for (const auto& field : fields) names.push_back(field.first);
    std::size_t one[2] = {1, 1};
    matvar_t* units = Mat_VarCreateStruct("units", 2, one, names.data(), static_cast<unsigned>(names.size()));
    for (auto& [name, text] : fields) {
      std::size_t dims[2] = {1, text.size()};
      Mat_VarSetStructFieldByName(units, name, 0,
                                  Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, dims, text.data(), 0));
    }
    put(units);
  }

 private:
  void put(matvar_t* variable) {
    EXPECT_EQ(Mat_VarWrite(mat_, variable, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(variable);
  }
  mat_t* mat_;
};

std::vector<double> ramp(std::size_t n, double step) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = step * static_cast<double>(i);
  return values;
}

class MatVersions : public ::testing::TestWithParam<mat_ft> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(MatVersions, OneVariablePerChannel) {
  const auto path = folder_.path() / "a.mat";
  {
    MatWriter mat(path, GetParam());
    mat.column("Time", ramp(20, 0.1));
    mat.column("x", ramp(20, 1.0));
    mat.singles("F", std::vector<float>(20, 2.5F));
    mat.column("voltage", std::vector<double>(20, 3.0));
    mat.units({{"x", "mm"}, {"F", "kN"}});
  }
  const auto r = load_recording(path);
  ASSERT_EQ(r.size(), 20U);
  EXPECT_EQ(r.file, "a.mat");
  EXPECT_EQ(r.sha256.size(), 64U);
  EXPECT_DOUBLE_EQ(r.time[3], 0.3 + 5e-17);
  EXPECT_DOUBLE_EQ(r.displacement[3], 3e-3);
  EXPECT_DOUBLE_EQ(r.force[3], 2500.0);
  EXPECT_EQ(r.drive_kind, DriveKind::voltage);
  EXPECT_NEAR(r.velocity[10], 0.01, 1e-9);
}

TEST_P(MatVersions, OneMatrix) {
  const auto path = folder_.path() / "a.mat";
  auto values = ramp(20, 0.1);
  for (const double x : ramp(20, 2.0)) values.push_back(x);
  for (const double f : ramp(20, 3.0)) values.push_back(f);
  {
    MatWriter mat(path, GetParam());
    mat.matrix("run", 20, 3, values);
    mat.column("single", {1.0});
  }
  for (const std::string matrix : {"", "run:"}) {
    const auto r = read_mat(
        path, {{{"time", matrix + "1"}, {"displacement", matrix + "2 [mm]"}, {"force", matrix + "3 [kN]"}}, true});
    ASSERT_EQ(r.size(), 20U);
    EXPECT_DOUBLE_EQ(r.displacement[19], 0.038);
    EXPECT_DOUBLE_EQ(r.force[2], 6000.0);
  }
  EXPECT_EQ(message_of<InputError>([&] {
              (void)read_mat(path, {{{"time", "4"}}, true});
            }),
            path.string() + ": no column '4' for time, expected one of 'run:1', 'run:2', 'run:3', 'single'");
  EXPECT_EQ(message_of<InputError>([&] { (void)read_mat(path); }),
            path.string() +
                ": no time column, expected one named time, t, or --column time=NAME; the columns are 'run:1', "
                "'run:2', 'run:3', 'single'");
}

TEST_P(MatVersions, WrongContents) {
  const auto message = [&](auto&& fill) {
    const auto path = folder_.path() / "w.mat";
    std::filesystem::remove(path);
    {
      MatWriter mat(path, GetParam());
      fill(mat);
    }
    return message_of<InputError>([&] { (void)read_mat(path); }).substr(path.string().size());
  };
  const auto with = [&](std::vector<double> time, std::vector<double> x, std::vector<double> f) {
    return message([&](MatWriter& mat) {
      mat.column("t", time);
      mat.column("x", x);
      mat.column("f", f);
    });
  };
  EXPECT_EQ(with(ramp(20, 1), ramp(19, 1), ramp(20, 1)),
            ": variable 'x' has 19 values and time has 20, expected the same number");
  EXPECT_EQ(with(ramp(5, 1), ramp(5, 1), ramp(5, 1)), ": 5 rows of numbers, expected at least 8");
  EXPECT_EQ(with(ramp(9, 0), ramp(9, 1), ramp(9, 1)),
            ": time does not increase at value 2, expected strictly increasing times");
  auto bad = ramp(9, 1);
  bad[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(with(ramp(9, 1), ramp(9, 1), bad), ": value 5 of 'f' is NaN, expected a finite number");
  EXPECT_EQ(message([&](MatWriter& mat) {
              mat.column("t", ramp(9, 1));
              mat.column("x", ramp(9, 1));
              mat.column("f", ramp(9, 1));
              mat.units({{"f", "stone"}});
            }),
            ": unknown unit 'stone' of force, expected one of N, kN, MN, daN, mN, lbf, lb, kip, kgf");
}

TEST_P(MatVersions, DamagedFilesAreRefused) {
  const auto path = folder_.path() / "a.mat";
  {
    MatWriter mat(path, GetParam());
    mat.column("t", ramp(2000, 0.1));
    mat.column("x", ramp(2000, 1.0));
    mat.column("f", ramp(2000, 1.0));
  }
  const auto size = std::filesystem::file_size(path);
  for (const auto part : {size / 2, size / 4, size / 100, size - 100}) {
    std::filesystem::resize_file(path, part);
    EXPECT_NE(message_of<InputError>([&] { (void)read_mat(path); }), "no error") << part;
    std::filesystem::resize_file(path, size);
  }
}

INSTANTIATE_TEST_SUITE_P(Mat, MatVersions, ::testing::Values(MAT_FT_MAT5, MAT_FT_MAT73),
                         [](const auto& version) { return version.param == MAT_FT_MAT5 ? "Level5" : "Level73"; });

TEST(Mat, NotAMatFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.mat", "hello\n");
  EXPECT_EQ(message_of<InputError>([&] { (void)load_recording(path); }),
            path.string() + ": not a readable MAT file, expected MATLAB level 5 or 7.3");
}

}  // namespace
}  // namespace hysteron

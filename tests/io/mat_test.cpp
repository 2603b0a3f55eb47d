#include "io/mat.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <malloc.h>
#include <matio.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/random.hpp"
#include "io/campaign.hpp"
#include "io/fence.hpp"
#include "io/file.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

// Writes a MAT file variable by variable.
class MatWriter {
 public:
  MatWriter(const std::filesystem::path& path, mat_ft version, matio_compression compression = MAT_COMPRESSION_NONE)
      : mat_(Mat_CreateVer(path.c_str(), nullptr, version)), compression_(compression) {}
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
  void units(std::vector<std::pair<const char*, std::string>> fields, const char* called = "units") {
    std::vector<const char*> names;
    for (const auto& field : fields) names.push_back(field.first);
    std::size_t one[2] = {1, 1};
    matvar_t* units = Mat_VarCreateStruct(called, 2, one, names.data(), static_cast<unsigned>(names.size()));
    for (auto& [name, text] : fields) {
      std::size_t dims[2] = {1, text.size()};
      Mat_VarSetStructFieldByName(units, name, 0,
                                  Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, dims, text.data(), 0));
    }
    put(units);
  }

 private:
  void put(matvar_t* variable) {
    EXPECT_EQ(Mat_VarWrite(mat_, variable, compression_), 0);
    Mat_VarFree(variable);
  }
  mat_t* mat_;
  matio_compression compression_;
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

TEST_P(MatVersions, ManySamplesAreAveraged) {
  const auto path = folder_.path() / "a.mat";
  {
    MatWriter mat(path, GetParam());
    mat.column("time", ramp(6000, 0.1));
    mat.column("x", ramp(6000, 1e-6));
    mat.column("F", ramp(6000, 2.0));
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.keep_samples = 2000;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  const auto r = load_recording(path, options);
  ASSERT_EQ(r.size(), 2000U);
  EXPECT_NEAR(r.time[10], 3.1, 1e-12);
  EXPECT_NEAR(r.displacement[10], 31e-6, 1e-15);
  EXPECT_NEAR(r.force[10], 62.0, 1e-12);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said[0],
            "6,000 samples read, every 3 averaged to one: 2,000 kept, 300 ms apart; keep samples 6000 keeps all");
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
                ": no time column, expected one named time, t (or its German, French, Italian or Spanish word), or "
                "column time=NAME; the columns are 'run:1', "
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

TEST_P(MatVersions, UnitsOfOtherNamesAreNotDroppedWithoutAWord) {
  std::vector<std::string> said;
  const auto read = [&](std::vector<std::pair<const char*, std::string>> units, const char* called) {
    const auto path = folder_.path() / "u.mat";
    std::filesystem::remove(path);
    {
      MatWriter mat(path, GetParam());
      mat.column("t", ramp(20, 0.1));
      mat.column("x", ramp(20, 1.0));
      mat.column("Load", ramp(20, 1.0));
      mat.units(std::move(units), called);
    }
    said.clear();
    ReadOptions options;
    options.remark = [&](const Remark& remark) {
      if (remark.kind == Remark::Kind::dialect) said.push_back(remark.text.plain());
    };
    return read_mat(path, options);
  };
  EXPECT_DOUBLE_EQ(read({{"x", "mm"}, {"load", "kN"}}, "Unit").force[3], 3e3);
  EXPECT_TRUE(said.empty());
  EXPECT_DOUBLE_EQ(read({{"x", "mm"}, {"torque", "Nm"}}, "units").displacement[3], 3e-3);
  EXPECT_EQ(said, std::vector<std::string>{"there is a unit of 'torque' and no variable of that name: it is not used"});
  EXPECT_EQ(message_of<InputError>([&] {
              (void)read({{"x", "mm"}, {"force", "kN"}}, "units");
            }).substr((folder_.path() / "u.mat").string().size()),
            ": there is a unit of 'force', 'kN', and none of 'Load', expected the name of the variable");
}

TEST_P(MatVersions, AColumnIsOneChannel) {
  const auto path = folder_.path() / "a.mat";
  {
    MatWriter mat(path, GetParam());
    mat.column("t", ramp(20, 0.1));
    mat.column("a", ramp(20, 1.0));
  }
  EXPECT_EQ(message_of<InputError>([&] {
              (void)read_mat(path, {{{"displacement", "a"}, {"force", "a"}}, true});
            }),
            path.string() + ": column 'a' is mapped to both displacement and force, expected one channel per column");
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

// ---- Damaged files ----

struct Written {
  const char* name;
  mat_ft version;
  matio_compression compression;
};
const Written kinds[] = {{"level 5", MAT_FT_MAT5, MAT_COMPRESSION_NONE},
                         {"level 5, compressed", MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
                         {"7.3", MAT_FT_MAT73, MAT_COMPRESSION_NONE},
                         {"7.3, compressed", MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}};

std::string recording_bytes(const Written& kind) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mat";
  {
    MatWriter mat(path, kind.version, kind.compression);
    mat.column("time", ramp(60, 0.1));
    mat.singles("x", std::vector<float>(60, 1.5F));
    mat.column("f", ramp(60, 2.0));
    mat.units({{"x", "mm"}, {"f", "kN"}});
  }
  return read_file(path);
}

// The message, or every bit of what was read.
std::string outcome_of(const std::string& bytes) {
  try {
    const auto r = parse_mat(bytes, "a.mat");
    std::string all;
    for (const auto* channel : {&r.time, &r.displacement, &r.force}) {
      all.append(reinterpret_cast<const char*>(channel->data()), channel->size() * sizeof(double));
    }
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
}

// Fresh and freed memory reads so from here on.
void fill_heap(int value) { mallopt(M_PERTURB, value); }

TEST(DamagedMat, CutAnywhereIsRefused) {
  for (const auto& kind : kinds) {
    const std::string whole = recording_bytes(kind);
    ASSERT_EQ(outcome_of(whole).size(), 3 * 60 * sizeof(double)) << kind.name;
    const std::size_t step = kind.version == MAT_FT_MAT5 ? 1 : whole.size() / 40;
    std::size_t accepted = 0;
    for (std::size_t size = 0; size < whole.size(); size += step) {
      accepted += outcome_of(whole.substr(0, size)).starts_with("a.mat: ") ? 0 : 1;
    }
    // Level 5 is a chain of variables: cut between the last two it is a whole file without the last, the units.
    EXPECT_LE(accepted, kind.version == MAT_FT_MAT5 ? 1U : 0U) << kind.name;
  }
}

TEST(DamagedMat, OutcomeIsTheSameWhateverTheHeapHolds) {
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    const std::string whole = recording_bytes(kinds[k]);
    const Stream stream = Stream(7).child(kinds[k].name);
    for (std::uint64_t round = 0; round < 75; ++round) {
      const Stream draw = stream.child(round);
      std::string bytes = whole;
      for (std::uint64_t change = 0; change < 1 + round % 4; ++change) {
        const auto at = static_cast<std::size_t>(draw.uniform(3 * change) * static_cast<double>(bytes.size()));
        bytes[at] = static_cast<char>(256.0 * draw.uniform(3 * change + 1));
      }
      if (round % 3 == 0) bytes.resize(static_cast<std::size_t>(draw.uniform(99) * static_cast<double>(bytes.size())));
      fill_heap(0xFF);
      const std::string first = outcome_of(bytes);
      fill_heap(0xA5);
      const std::string second = outcome_of(bytes);
      fill_heap(0);
      EXPECT_EQ(first, second) << kinds[k].name << ", round " << round;
    }
  }
}

// A variable of level 5, as the format says.
std::string mat5_with(std::uint32_t stored_type, std::uint32_t rows, const std::string& data) {
  const auto word = [](std::uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); };
  std::string body = word(6) + word(8) + word(6) + word(0) + word(5) + word(8) + word(rows) + word(1);
  body += word(1U | (1U << 16U)) + std::string("f\0\0\0", 4) + word(stored_type) +
          word(static_cast<std::uint32_t>(data.size()));
  body += data + std::string((8 - data.size() % 8) % 8, '\0');
  std::string file(124, ' ');
  file += std::string("\x00\x01IM", 4);
  return file + word(14) + word(static_cast<std::uint32_t>(body.size())) + body;
}

TEST(DamagedMat, SizesAreHeldAgainstTheBytes) {
  EXPECT_NE(outcome_of(mat5_with(2, 9, "123456789")).find("no time column"), std::string::npos);
  EXPECT_NE(outcome_of(mat5_with(2, 10, "123456789")).find("'f' holds 9 values and its size says 10"),
            std::string::npos);
  EXPECT_NE(outcome_of(mat5_with(9, 1, "123456789")).find("'f' holds 1 values"), std::string::npos);
  EXPECT_NE(outcome_of(mat5_with(33, 9, "123456789")).find("'f' holds no numbers"), std::string::npos);
  EXPECT_NE(outcome_of(mat5_with(2, 0xFFFFFFFF, "123456789")).find("impossible dimensions"), std::string::npos);
}

TEST(DamagedMat, FilesOfTheOtherByteOrderAreRead) {
  std::string file(124, ' ');
  file += std::string("\x01\x00MI", 4);
  const auto word = [](std::uint32_t value) {
    value = __builtin_bswap32(value);
    return std::string(reinterpret_cast<const char*>(&value), 4);
  };
  for (const char name : {'t', 'x', 'f'}) {
    std::string body = word(6) + word(8) + word(6) + word(0) + word(5) + word(8) + word(8) + word(1);
    body += word(1U << 16U | 1U) + std::string(1, name) + std::string(3, '\0') + word(9) + word(64);
    for (int i = 0; i < 8; ++i) {
      const auto bits = __builtin_bswap64(std::bit_cast<std::uint64_t>(i + 0.25));
      body.append(reinterpret_cast<const char*>(&bits), 8);
    }
    file += word(14) + word(static_cast<std::uint32_t>(body.size())) + body;
  }
  const auto r = parse_mat(file, "a.mat");
  ASSERT_EQ(r.size(), 8U);
  EXPECT_EQ(r.force[3], 3.25);
}

// ---- HDF5 files as other programs write them ----

class Hdf5Writer {
 public:
  enum class Class { none, null_padded, variable_length };

  explicit Hdf5Writer(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Hdf5Writer() { H5Fclose(file_); }
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  // Where its first chunk lies in the file, if it is in chunks.
  haddr_t column(const char* name, const std::vector<double>& values, Class how, bool chunked = false) {
    const hsize_t size[2] = {1, values.size()};
    const hid_t space = H5Screate_simple(2, size, nullptr);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    if (chunked) {
      H5Pset_chunk(creation, 2, size);
      H5Pset_deflate(creation, 6);
    }
    const hid_t set = H5Dcreate2(file_, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    if (how != Class::none) put_class(set, how);
    haddr_t at = 0;
    if (chunked) {
      H5Fflush(file_, H5F_SCOPE_GLOBAL);
      hsize_t offset[2];
      hsize_t bytes = 0;
      unsigned filters = 0;
      EXPECT_GE(H5Dget_chunk_info(set, space, 0, offset, &filters, &at, &bytes), 0);
    }
    H5Dclose(set);
    H5Pclose(creation);
    H5Sclose(space);
    return at;
  }

 private:
  static void put_class(hid_t set, Class how) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, how == Class::null_padded ? 6 : H5T_VARIABLE);
    H5Tset_strpad(type, how == Class::null_padded ? H5T_STR_NULLPAD : H5T_STR_NULLTERM);
    const hid_t scalar = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(set, "MATLAB_class", type, scalar, H5P_DEFAULT, H5P_DEFAULT);
    const char* text = "double";
    EXPECT_GE(H5Awrite(attribute, type, how == Class::null_padded ? static_cast<const void*>(text) : &text), 0);
    H5Aclose(attribute);
    H5Sclose(scalar);
    H5Tclose(type);
  }
  hid_t file_;
};

TEST(Mat73, ClassesAreReadHoweverTheyArePadded) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "h5py.mat";
  {
    Hdf5Writer file(path);
    file.column("time", ramp(20, 0.1), Hdf5Writer::Class::null_padded);
    file.column("x", ramp(20, 1.0), Hdf5Writer::Class::variable_length);
    file.column("f", ramp(20, 3.0), Hdf5Writer::Class::none, true);
  }
  const auto r = read_mat(path);
  ASSERT_EQ(r.size(), 20U);
  EXPECT_EQ(r.force[5], 15.0);
}

TEST(Mat73, AVariableThatCannotBeReadHidesNoOther) {
  const TemporaryFolder folder;
  for (const std::string damaged : {"aside", "current", "f"}) {
    const auto path = folder.path() / (damaged + ".mat");
    haddr_t at = 0;
    {
      Hdf5Writer file(path);
      at = file.column(damaged.c_str(), ramp(20, 0.1), Hdf5Writer::Class::null_padded, true);
      for (const char* name : {"time", "x", "f"}) {
        if (damaged != name) file.column(name, ramp(20, 1.0), Hdf5Writer::Class::null_padded);
      }
    }
    std::string bytes = read_file(path);
    for (std::size_t i = 0; i < 12; ++i) bytes.at(at + i) = static_cast<char>(~bytes.at(at + i));
    if (damaged == "aside") {
      EXPECT_EQ(parse_mat(bytes, "a.mat").size(), 20U);
    } else {
      EXPECT_EQ(outcome_of(bytes),
                "a.mat: variable '" + damaged + "' cannot be read, the file is damaged, expected a complete MAT file");
    }
  }
}

// ---- The fence ----

TEST(Fence, GivesBackWhatWasMadeAndNothingOfWhatFailed) {
  const FenceLimits limits{std::size_t{64} << 20U, 1};
  EXPECT_EQ(behind_fence([] { return std::string(300000, 'x'); }, limits, 0), std::string(300000, 'x'));
  EXPECT_EQ(behind_fence([]() -> std::string { throw std::bad_alloc(); }, limits, 0), std::nullopt);
  EXPECT_EQ(behind_fence([]() -> std::string { abort(); }, limits, 0), std::nullopt);
  EXPECT_EQ(behind_fence(
                []() -> std::string {
                  for (volatile bool forever = true; forever;) {
                  }
                  return {};
                },
                limits, 0),
            std::nullopt);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_EQ(behind_fence([] { return std::to_string(std::string(std::size_t{200} << 20U, 'x').size()); }, limits, 0),
            std::nullopt);
#endif
}

TEST(Mat, VariablesThatAreNoChannelAreKeptAsTheirMean) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mat";
  {
    MatWriter mat(path, MAT_FT_MAT5);
    const std::vector<double> numbers = {0, 1, 2, 3, 4, 5, 6, 7};
    for (const char* name : {"t", "x", "f", "pressure"}) mat.column(name, numbers);
    mat.column("oil", {38.5});
    mat.column("other", {1.0, 2.0});
  }
  const auto r = load_recording(path);
  ASSERT_EQ(r.unused.size(), 2U);
  EXPECT_EQ(r.unused[0].name, "pressure");
  EXPECT_DOUBLE_EQ(r.unused[0].mean, 3.5);
  EXPECT_EQ(r.unused[1].name, "oil");
  EXPECT_DOUBLE_EQ(r.unused[1].mean, 38.5);
}

TEST(Mat, NamesMayEndInTheirUnit) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.mat";
  const std::vector<double> numbers = {0, 1, 2, 3, 4, 5, 6, 7};
  const auto write = [&](const std::vector<std::pair<const char*, std::string>>& units) {
    MatWriter mat(path, MAT_FT_MAT5);
    for (const char* name : {"Time_s", "Displacement_mm", "Force_kN", "Current_mA"}) mat.column(name, numbers);
    if (!units.empty()) mat.units(units);
  };
  write({});
  const auto r = load_recording(path);
  EXPECT_DOUBLE_EQ(r.time[3], 3.0);
  EXPECT_DOUBLE_EQ(r.displacement[3], 3e-3);
  EXPECT_DOUBLE_EQ(r.force[3], 3e3);
  EXPECT_DOUBLE_EQ(r.drive.at(3), 3e-3);
  write({{"Force_kN", "kN"}});
  EXPECT_DOUBLE_EQ(load_recording(path).force[3], 3e3);
  write({{"Force_kN", "N"}});
  EXPECT_EQ(message_of<InputError>([&] { (void)load_recording(path); }),
            path.string() +
                ": column 'Force_kN' is given in 'N' and in 'kN', expected one unit, or column "
                "force=\"Force [UNIT]\" to choose");
}

TEST(Mat, AStructIsToldWhereNothingElseIsAChannel) {
  const TemporaryFolder folder;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    for (const bool rate : {false, true}) {
      const auto path = folder.path() / ("a" + std::to_string(static_cast<int>(version)) + (rate ? "r" : "") + ".mat");
      {
        MatWriter mat(path, version);
        mat.units({{"t", "1"}, {"x", "2"}}, "run");
        if (rate) mat.column("fs", {1000.0});
      }
      EXPECT_EQ(message_of<InputError>([&] { (void)load_recording(path); }),
                path.string() +
                    ": variable 'run' is a struct, whose fields are not read, expected them as variables, "
                    "as MATLAB saves them by save('FILE.mat', '-struct', 'run')");
    }
  }
}

TEST(Mat, NotAMatFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.mat", "hello\n");
  EXPECT_EQ(message_of<InputError>([&] { (void)load_recording(path); }),
            path.string() + ": not a readable MAT file, expected MATLAB level 5 or 7.3");
}

}  // namespace
}  // namespace hysteron

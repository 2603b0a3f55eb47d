#include "io/mat5_writer.hpp"

#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "io/mat.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::TemporaryFolder;

struct Free {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

// A file of ours as matio reads it.
class Read {
 public:
  explicit Read(const std::string& bytes) : mat_(Mat_Open(folder_.write("a.mat", bytes).c_str(), MAT_ACC_RDONLY)) {}
  ~Read() { Mat_Close(mat_); }
  Read(const Read&) = delete;
  Read& operator=(const Read&) = delete;
  [[nodiscard]] Variable variable(const char* name) { return Variable(Mat_VarRead(mat_, name)); }

 private:
  TemporaryFolder folder_;
  mat_t* mat_;
};

std::vector<double> numbers_of(const matvar_t* variable) {
  EXPECT_NE(variable, nullptr);
  if (variable == nullptr || variable->class_type != MAT_C_DOUBLE) return {};
  const auto* data = static_cast<const double*>(variable->data);
  return {data, data + variable->nbytes / sizeof(double)};
}

std::u16string text_of(const matvar_t* variable) {
  EXPECT_NE(variable, nullptr);
  if (variable == nullptr || variable->class_type != MAT_C_CHAR || variable->nbytes == 0) return {};
  const auto* data = static_cast<const char16_t*>(variable->data);
  return {data, data + variable->nbytes / sizeof(char16_t)};
}

TEST(Mat5Writer, AnotherReaderFindsWhatWasWritten) {
  const MatValue fields{MatValue::Fields{{"gain [N s/m]", MatValue{std::vector<double>{1.5, -2.5}}},
                                         {"gain (N s/m)", MatValue{std::string("\xC2\xB5m")}}}};
  Read file(mat5_of({{"time", MatValue{std::vector<double>{0.0, 0.1, 0.2}}},
                     {"2nd result", MatValue{std::vector<double>{}}},
                     {"words", MatValue{std::vector<std::string>{"one", "", "three"}}},
                     {"table", fields}}));
  EXPECT_EQ(numbers_of(file.variable("time").get()), (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(numbers_of(file.variable("x2nd_result").get()), std::vector<double>{});
  const Variable words = file.variable("words");
  ASSERT_NE(words, nullptr);
  EXPECT_EQ(text_of(Mat_VarGetCell(words.get(), 0)), u"one");
  EXPECT_EQ(text_of(Mat_VarGetCell(words.get(), 1)), u"");
  EXPECT_EQ(text_of(Mat_VarGetCell(words.get(), 2)), u"three");
  const Variable table = file.variable("table");
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(numbers_of(Mat_VarGetStructFieldByName(table.get(), "gain_N_s_m", 0)), (std::vector<double>{1.5, -2.5}));
  EXPECT_EQ(text_of(Mat_VarGetStructFieldByName(table.get(), "gain_N_s_m_2", 0)), u"\u00B5m");
}

TEST(Mat5Writer, ATableKeepsNumbersAndTextsApart) {
  const MatValue table = mat_table("name,value,none,mixed\n\"a, \"\"b\"\"\",1e-3,,1\nc,,,x\n");
  const auto& fields = std::get<MatValue::Fields>(table.value);
  ASSERT_EQ(fields.size(), 4U);
  EXPECT_EQ(std::get<std::vector<std::string>>(fields[0].value.value), (std::vector<std::string>{"a, \"b\"", "c"}));
  const auto& values = std::get<std::vector<double>>(fields[1].value.value);
  EXPECT_EQ(values[0], 1e-3);
  EXPECT_TRUE(std::isnan(values[1]));
  EXPECT_EQ(std::get<std::vector<std::string>>(fields[2].value.value), (std::vector<std::string>{"", ""}));
  EXPECT_EQ(std::get<std::vector<std::string>>(fields[3].value.value), (std::vector<std::string>{"1", "x"}));
}

// The program's own reader takes columns, with their units, for what they are.
TEST(Mat5Writer, ColumnsAreARecordingAgain) {
  std::string csv = "time [ms],displacement [mm],force [kN]\n";
  for (int k = 0; k < 20; ++k)
    csv += std::to_string(k) + "," + std::to_string(k * k) + ".25,0." + std::to_string(k) + "\n";
  const Recording expected = parse_csv(csv, "a.csv");
  const Recording again = parse_mat(mat5_of_columns(csv), "a.mat");
  EXPECT_EQ(again.time, expected.time);
  EXPECT_EQ(again.displacement, expected.displacement);
  EXPECT_EQ(again.force, expected.force);
}

}  // namespace
}  // namespace hysteron

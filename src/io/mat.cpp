#include "io/mat.hpp"

#include <matio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

struct CloseMat {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// matio reports to standard error by default; here every failure becomes one InputError.
void discard_message(int /*level*/, char* /*message*/) {}

bool is_numeric(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 && variable.rank == 2;
}

template <typename T>
void copy_values(const matvar_t& variable, std::size_t first, std::vector<double>& values) {
  const auto* data = static_cast<const T*>(variable.data) + first;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(data[i]);
}

// `count` values from `first` on, in MATLAB's column-major order; empty when the type is not a real number.
std::vector<double> values_of(const matvar_t& variable, std::size_t first, std::size_t count) {
  std::vector<double> values(count);
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      copy_values<double>(variable, first, values);
      break;
    case MAT_T_SINGLE:
      copy_values<float>(variable, first, values);
      break;
    case MAT_T_INT8:
      copy_values<std::int8_t>(variable, first, values);
      break;
    case MAT_T_UINT8:
      copy_values<std::uint8_t>(variable, first, values);
      break;
    case MAT_T_INT16:
      copy_values<std::int16_t>(variable, first, values);
      break;
    case MAT_T_UINT16:
      copy_values<std::uint16_t>(variable, first, values);
      break;
    case MAT_T_INT32:
      copy_values<std::int32_t>(variable, first, values);
      break;
    case MAT_T_UINT32:
      copy_values<std::uint32_t>(variable, first, values);
      break;
    case MAT_T_INT64:
      copy_values<std::int64_t>(variable, first, values);
      break;
    case MAT_T_UINT64:
      copy_values<std::uint64_t>(variable, first, values);
      break;
    default:
      values.clear();
  }
  return values;
}

// Text of a char array as UTF-8; MATLAB stores bytes or UTF-16 (units need no surrogate pairs).
std::string text_of(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.data == nullptr || variable.data_size <= 0) return {};
  const std::size_t count = variable.nbytes / static_cast<std::size_t>(variable.data_size);
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (variable.data_size == 1) {
      text += static_cast<const char*>(variable.data)[i];
      continue;
    }
    const unsigned code = static_cast<const std::uint16_t*>(variable.data)[i];
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += static_cast<char>(0xC0U | (code >> 6));
      text += static_cast<char>(0x80U | (code & 0x3FU));
    } else {
      text += static_cast<char>(0xE0U | (code >> 12));
      text += static_cast<char>(0x80U | ((code >> 6) & 0x3FU));
      text += static_cast<char>(0x80U | (code & 0x3FU));
    }
  }
  return std::string(trimmed(text.substr(0, text.find('\0'))));
}

// A vector variable or one column of a matrix.
struct Slice {
  std::size_t variable;
  std::size_t first;
  std::size_t count;
};

class MatReader {
 public:
  MatReader(const std::filesystem::path& path, const ReadOptions& options)
      : path_(path), file_(path.string()), options_(options) {}

  Recording run() {
    read_variables();
    list_columns();
    const Sources sources = assign_columns(columns_, options_, file_, 0);
    Channels channels;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i].column >= 0) channels[i] = read(sources[i]);
    }
    check(channels, sources);
    return make_recording(std::move(channels));
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }

  void read_variables() {
    Mat_LogInitFunc("hysteron", discard_message);
    std::error_code code;
    if (!std::filesystem::exists(path_, code)) fail("there is no such file, expected a readable file");
    const MatFile mat(Mat_Open(file_.c_str(), MAT_ACC_RDONLY));
    if (!mat) fail("not a readable MAT file, expected MATLAB level 5 or 7.3");
    while (Variable variable{Mat_VarReadNext(mat.get())}) variables_.push_back(std::move(variable));
    if (variables_.empty()) fail("no variables, the file is empty or damaged, expected one per channel or a matrix");
  }

  // Units by lower-case variable name.
  [[nodiscard]] std::map<std::string, std::string> read_units() const {
    std::map<std::string, std::string> units;
    for (const auto& variable : variables_) {
      if (variable->name == nullptr || lower_case(variable->name) != "units") continue;
      if (variable->class_type != MAT_C_STRUCT) fail("variable 'units' is not a struct, expected one text per channel");
      const unsigned count = Mat_VarGetNumberOfFields(variable.get());
      char* const* names = Mat_VarGetStructFieldnames(variable.get());
      for (unsigned i = 0; i < count; ++i) {
        const matvar_t* field = Mat_VarGetStructFieldByIndex(variable.get(), i, 0);
        if (field == nullptr || field->class_type != MAT_C_CHAR) {
          fail("field " + in_quotes(names[i]) + " of 'units' is not text, expected a unit such as 'mm'");
        }
        units[lower_case(names[i])] = text_of(*field);
      }
    }
    return units;
  }

  void list_columns() {
    const auto units = read_units();
    const auto is_matrix = [](const Variable& variable) {
      return is_numeric(*variable) && variable->dims[0] > 1 && variable->dims[1] > 1;
    };
    const bool one_matrix = std::ranges::count_if(variables_, is_matrix) == 1;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const auto& variable = *variables_[i];
      if (variable.name == nullptr || !is_numeric(variable)) continue;
      const std::string name = variable.name;
      const std::size_t rows = variable.dims[0];
      const std::size_t columns = variable.dims[1];
      if (!is_matrix(variables_[i])) {
        const auto unit = units.find(lower_case(name));
        add(name, {}, unit == units.end() ? std::string{} : unit->second, {i, 0, rows * columns});
        continue;
      }
      for (std::size_t k = 0; k < columns; ++k) {
        const std::string number = std::to_string(k + 1);
        add(name + ":" + number, one_matrix ? number : std::string{}, {}, {i, k * rows, rows});
      }
    }
    if (columns_.empty()) fail("no numeric variables, expected one vector per channel or a matrix");
  }

  void add(std::string name, std::string alias, std::string unit, Slice slice) {
    columns_.push_back({name, name, std::move(unit), std::move(alias)});
    slices_.push_back(slice);
  }

  [[nodiscard]] std::vector<double> read(const Source& source) const {
    const auto index = static_cast<std::size_t>(source.column);
    const auto& slice = slices_[index];
    const auto& variable = *variables_[slice.variable];
    const std::string name = in_quotes(columns_[index].text);
    if (variable.isComplex != 0) fail("variable " + name + " is complex, expected real numbers");
    if (slice.count == 0) fail("variable " + name + " is empty, expected numbers");
    const bool whole = variable.data != nullptr && variable.data_size > 0 &&
                       variable.nbytes / static_cast<std::size_t>(variable.data_size) >= slice.first + slice.count;
    if (!whole) fail("variable " + name + " cannot be read, the file is damaged, expected a complete MAT file");
    auto values = values_of(variable, slice.first, slice.count);
    if (values.empty()) fail("variable " + name + " has an unknown type, expected real numbers");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        fail("value " + std::to_string(i + 1) + " of " + name + " is " + (std::isnan(values[i]) ? "NaN" : "infinite") +
             ", expected a finite number");
      }
      values[i] = source.unit.to_si(values[i]);
    }
    return values;
  }

  void check(const Channels& channels, const Sources& sources) const {
    const auto& time = channels[0];
    for (std::size_t i = 1; i < channels.size(); ++i) {
      if (sources[i].column < 0 || channels[i].size() == time.size()) continue;
      fail("variable " + in_quotes(columns_[static_cast<std::size_t>(sources[i].column)].text) + " has " +
           std::to_string(channels[i].size()) + " values and time has " + std::to_string(time.size()) +
           ", expected the same number");
    }
    if (time.size() < fewest_rows) {
      fail(std::to_string(time.size()) + (time.size() == 1 ? " row" : " rows") + " of numbers, expected at least " +
           std::to_string(fewest_rows));
    }
    for (std::size_t i = 1; i < time.size(); ++i) {
      if (!(time[i] > time[i - 1])) {
        fail("time does not increase at value " + std::to_string(i + 1) + ", expected strictly increasing times");
      }
    }
  }

  const std::filesystem::path& path_;
  std::string file_;
  const ReadOptions& options_;
  std::vector<Variable> variables_;
  std::vector<Column> columns_;
  std::vector<Slice> slices_;
};

}  // namespace

Recording read_mat(const std::filesystem::path& path, const ReadOptions& options) {
  return MatReader(path, options).run();
}

}  // namespace hysteron

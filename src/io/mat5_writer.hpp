// MATLAB files of level 5, as save -v6 writes them: numbers, texts, structs. Source: MathWorks, MAT-File Format
// (R2015b), chapter 1.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hysteron {

// A column of numbers; a text; a column of texts, a cell array; a struct of further values.
struct MatField;
struct MatValue {
  using Fields = std::vector<MatField>;
  std::variant<std::vector<double>, std::string, std::vector<std::string>, Fields> value;
};
struct MatField {
  std::string name;
  MatValue value;
};

// The bytes of a file with these variables, the same for the same values: it says no date. Names are made what MATLAB
// takes for one: letters, digits and underscores, 63 at most, a letter first. Throws WorkError where a variable is
// larger than the format holds, 2 GiB.
[[nodiscard]] std::string mat5_of(const MatValue::Fields& variables);

// "std error [N s/m]" -> "std_error_N_s_m".
[[nodiscard]] std::string mat_name(std::string_view text);

// A table with a row of names as CSV text (report/csv.hpp) -> a struct with a field a column: numbers where every field
// is one or empty (NaN), else texts.
[[nodiscard]] MatValue mat_table(std::string_view csv);

// The same as a file: a variable a column, and a struct `units` with the units that stand behind the names, as the
// program reads it (io/mat.hpp).
[[nodiscard]] std::string mat5_of_columns(std::string_view csv);

}  // namespace hysteron

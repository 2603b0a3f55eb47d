// What the formats of a workbook's cells show. Source: ECMA-376, part 1, 18.8.
#pragma once

#include <string>
#include <vector>

#include "io/workbook_archive.hpp"

namespace hysteron::workbook {

// What a format shows beside a number: a unit as in 0.0" kN", and whether it shows a part of the number, as a comma
// behind the digits and a percent sign do.
struct Shown {
  bool date = false;
  std::string unit;
  bool scaled = false;
};

// Of every style of cells, what its format shows.
std::vector<Shown> styles_of(Archive& archive, const std::string& path);

}  // namespace hysteron::workbook

// The cells of a sheet. Source: ECMA-376, part 1, 18.3.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/workbook_archive.hpp"
#include "io/workbook_styles.hpp"

namespace hysteron::workbook {

struct Cell {
  enum class Kind : std::uint8_t { number, text, truth, error };
  std::uint32_t column = 0;
  Kind kind = Kind::number;
  bool date = false;        // a number of days, by its format
  std::uint16_t style = 0;  // of the workbook
  std::uint32_t length = 0;
  std::size_t at = 0;  // in Sheet::letters
};

struct SheetRow {
  std::uint32_t number = 0;
  std::size_t first = 0;  // in Sheet::cells
  std::size_t count = 0;
  bool hidden = false;
};

struct Sheet {
  std::string name;
  std::string letters;
  std::vector<Cell> cells;  // those that are not empty
  std::vector<SheetRow> rows;
  std::vector<std::uint32_t> unvalued;  // rows of formulas without a value, once for each
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hidden_columns;  // first and last of stretches

  [[nodiscard]] std::string_view text(const Cell& cell) const {
    return std::string_view(letters).substr(cell.at, cell.length);
  }
  void write(Cell& cell, std::string_view text) {
    cell.at = letters.size();
    cell.length = static_cast<std::uint32_t>(text.size());
    letters += text;
  }
  [[nodiscard]] std::span<const Cell> cells_of(const SheetRow& row) const {
    return std::span(cells).subspan(row.first, row.count);
  }
};

// The finite number that a text is, and is alone.
std::optional<double> number_of(std::string_view text);

// Texts that cells name by number.
std::vector<std::string> shared_texts(Archive& archive, const std::string& path);

// The sheet in a part; styles and texts are those of the workbook.
Sheet sheet_of(Archive& archive, const std::string& path, const std::string& name,
               const std::vector<std::string>& texts, const std::vector<Shown>& styles);

}  // namespace hysteron::workbook

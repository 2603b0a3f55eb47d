// The table of a sheet: its names and the rows of numbers below.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "io/workbook_sheet.hpp"

namespace hysteron::workbook {

struct Table {
  std::size_t header = 0;  // in Sheet::rows
  std::vector<std::uint32_t> columns;
};

// The first row with two names or more that has numbers below half of them, next to it or below a row of units; the
// first `skip` rows are not looked at.
std::optional<Table> table_of(const Sheet& sheet, std::uint32_t skip);

// Why the rows below names are no numbers, as they look like: they hold texts, or formulas whose values are not stored.
// Empty where they do not.
std::string why_no_table(const Sheet& sheet);

// How many of the columns hold a number in a row.
std::size_t numbers_in(const Sheet& sheet, const SheetRow& row, const std::vector<std::uint32_t>& columns);

// Whether a header names a channel, by itself or by a mapping.
bool names_a_channel(const Sheet& sheet, const Table& table, const ReadOptions& options);

// The table as text, row N of the sheet is line N, what is not of the table is left out; and what of the sheet was not
// taken as it stands.
struct TableText {
  std::string text;
  std::vector<std::string> remarks;
};
TableText text_of(const Sheet& sheet, const Table& table);

}  // namespace hysteron::workbook

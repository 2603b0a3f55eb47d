#include "io/workbook_table.hpp"

#include <algorithm>
#include <span>

#include "io/header_row.hpp"
#include "io/text.hpp"

namespace hysteron::workbook {
namespace {

// With a decimal comma, too.
bool looks_like_a_number(std::string_view text) {
  std::string copy(text);
  std::ranges::replace(copy, ',', '.');
  return number_of(copy).has_value();
}

// Whether the row below one of words holds the names of the numbers that follow.
bool is_title_above(const Sheet& sheet, const SheetRow& row, const SheetRow& below) {
  const auto words_of = [&](const SheetRow& of) {
    std::vector<std::string_view> words;
    for (const Cell& cell : sheet.cells_of(of)) {
      if (cell.kind == Cell::Kind::text) words.push_back(sheet.text(cell));
    }
    return words;
  };
  const std::vector<std::string_view> words = words_of(below);
  return names_columns(words) || (!names_columns(words_of(row)) && !has_a_unit(words));
}

// Whether a row holds numbers of the table: one in every column in which the row before has one, and no words where
// that has none, as beside a maximum or a mean.
bool goes_on(const Sheet& sheet, const SheetRow& row, const SheetRow& before,
             const std::vector<std::uint32_t>& columns) {
  const std::span<const Cell> cells = sheet.cells_of(row);
  const std::span<const Cell> above = sheet.cells_of(before);
  const auto has = [](std::span<const Cell> of, const Cell& like) {
    return std::ranges::any_of(of,
                               [&](const Cell& cell) { return cell.column == like.column && cell.kind == like.kind; });
  };
  return std::ranges::none_of(cells,
                              [&](const Cell& cell) { return cell.kind == Cell::Kind::text && !has(above, cell); }) &&
         std::ranges::all_of(above, [&](const Cell& cell) {
           return cell.kind != Cell::Kind::number || !std::ranges::binary_search(columns, cell.column) ||
                  has(cells, cell);
         });
}

// A cell as a field between semicolons, without what would end one.
void append_field(std::string& text, const Sheet& sheet, const Cell& cell, bool among_numbers) {
  std::string_view content = sheet.text(cell);
  // Stored as 1 and 0, which among numbers would be one.
  if (cell.kind == Cell::Kind::truth && among_numbers) content = content == "0" ? "FALSE" : "TRUE";
  // "#N/A" in the first column would make its row a comment.
  if (cell.kind == Cell::Kind::error && content.starts_with('#')) content.remove_prefix(1);
  for (const char c : content) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7F ? ' ' : c == ';' ? ',' : c == '"' ? '\'' : c;
  }
}

// Of columns, whether they hold numbers below the header.
std::vector<bool> with_numbers(const Sheet& sheet, const Table& table) {
  std::vector<bool> result(table.columns.empty() ? 0 : table.columns.back() + 1, false);
  for (std::size_t r = table.header + 1; r < sheet.rows.size(); ++r) {
    for (const Cell& cell : sheet.cells_of(sheet.rows[r])) {
      if (cell.kind == Cell::Kind::number && cell.column < result.size()) result[cell.column] = true;
    }
  }
  return result;
}

}  // namespace

std::size_t numbers_in(const Sheet& sheet, const SheetRow& row, const std::vector<std::uint32_t>& columns) {
  return static_cast<std::size_t>(std::ranges::count_if(sheet.cells_of(row), [&](const Cell& cell) {
    return cell.kind == Cell::Kind::number && std::ranges::binary_search(columns, cell.column);
  }));
}

std::optional<Table> table_of(const Sheet& sheet, std::uint32_t skip) {
  constexpr std::size_t most_rows_before = 200;
  std::size_t looked_at = 0;
  for (std::size_t r = 0; r < sheet.rows.size() && looked_at < most_rows_before; ++r) {
    if (sheet.rows[r].number <= skip) continue;
    ++looked_at;
    Table table{r, {}};
    for (const Cell& cell : sheet.cells_of(sheet.rows[r])) {
      if (cell.kind == Cell::Kind::text) table.columns.push_back(cell.column);
    }
    if (table.columns.size() < 2) continue;
    for (std::size_t below = r + 1; below < std::min(r + 3, sheet.rows.size()); ++below) {
      const std::size_t numbers = numbers_in(sheet, sheet.rows[below], table.columns);
      if (numbers < 2 || 2 * numbers < table.columns.size()) continue;
      if (below == r + 1 || !is_title_above(sheet, sheet.rows[r], sheet.rows[r + 1])) return table;
    }
  }
  return std::nullopt;
}

std::string why_no_table(const Sheet& sheet) {
  constexpr std::size_t most_rows_before = 200;
  for (std::size_t r = 0; r < std::min(sheet.rows.size(), most_rows_before); ++r) {
    const auto names = std::ranges::count_if(sheet.cells_of(sheet.rows[r]), [&](const Cell& cell) {
      return cell.kind == Cell::Kind::text && quantity_of_column(split_column(sheet.text(cell)));
    });
    if (names < 2) continue;
    // Next to it or below a row of units.
    for (std::size_t below = r + 1; below < std::min(r + 3, sheet.rows.size()); ++below) {
      const std::uint32_t number = sheet.rows[below].number;
      const std::string where =
          "row " + std::to_string(number) + " of sheet " + in_quotes(sheet.name) + ", below names";
      if (std::ranges::count(sheet.unvalued, number) > 1) {
        return where +
               ", holds formulas whose values are not stored, expected a workbook that a spreadsheet program has saved";
      }
      if (std::ranges::count_if(sheet.cells_of(sheet.rows[below]), [&](const Cell& cell) {
            return cell.kind == Cell::Kind::text && looks_like_a_number(sheet.text(cell));
          }) > 1) {
        return where + ", holds numbers that are stored as text, expected cells of numbers";
      }
    }
  }
  return {};
}

TableText text_of(const Sheet& sheet, const Table& table) {
  TableText result;
  std::string& text = result.text;
  const std::vector<bool> of_numbers = with_numbers(sheet, table);
  std::uint32_t line = 1;
  std::size_t before = table.header;  // the last row that was taken
  bool gone_on = false;
  for (std::size_t r = table.header; r < sheet.rows.size(); ++r) {
    const SheetRow& row = sheet.rows[r];
    const std::span<const Cell> cells = sheet.cells_of(row);
    const bool empty = std::ranges::none_of(
        cells, [&](const Cell& cell) { return std::ranges::binary_search(table.columns, cell.column); });
    if (empty) continue;
    if (r > table.header && row.number != line) {
      // Below an empty row stand more numbers of the recording, or what somebody wrote about it.
      if (!goes_on(sheet, row, sheet.rows[before], table.columns)) {
        for (std::size_t k = r; k < sheet.rows.size(); ++k) {
          if (!goes_on(sheet, sheet.rows[k], sheet.rows[before], table.columns)) continue;
          result.remarks.push_back("the table ends with row " + std::to_string(line - 1) + " of sheet " +
                                   in_quotes(sheet.name) + ", the numbers from row " +
                                   std::to_string(sheet.rows[k].number) + " on are not read");
          break;
        }
        break;
      }
      if (!gone_on) {
        result.remarks.push_back("row " + std::to_string(line) + " of sheet " + in_quotes(sheet.name) +
                                 " is empty and the numbers go on below: they are read");
      }
      gone_on = true;
    }
    before = r;
    text.append(row.number - line, '\n');
    auto cell = cells.begin();
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (k > 0) text += ';';
      while (cell != cells.end() && cell->column < table.columns[k]) ++cell;
      if (cell != cells.end() && cell->column == table.columns[k]) {
        append_field(text, sheet, *cell, of_numbers[cell->column]);
      }
    }
    text += '\n';
    line = row.number + 1;
  }
  return result;
}

bool names_a_channel(const Sheet& sheet, const Table& table, const ReadOptions& options) {
  return std::ranges::any_of(sheet.cells_of(sheet.rows[table.header]), [&](const Cell& cell) {
    const Column column = split_column(sheet.text(cell));
    return quantity_of_name(column.name).has_value() || quantity_of_last_word(column.name).has_value() ||
           std::ranges::any_of(options.columns, [&](const auto& entry) {
             return lower_case(split_column(entry.second).name) == lower_case(column.name) ||
                    trimmed(entry.second) == column.text;
           });
  });
}

}  // namespace hysteron::workbook

// Workbooks of Excel and of programs that write alike (Office Open XML, .xlsx). Source: ECMA-376, part 1, chapters 12
// and 18.
//
// A workbook is a zip archive of XML. One of its sheets is read as CSV text is: the same names, units, rules and
// messages, whose line numbers are the rows of the sheet. The table of a sheet begins with the first row of names that
// has numbers below; its columns are those with a name, and it ends where all of them are empty.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/message.hpp"
#include "io/bytes.hpp"
#include "io/clock_time.hpp"
#include "io/csv.hpp"
#include "io/format.hpp"
#include "io/header_row.hpp"
#include "io/text.hpp"
#include "io/workbook_archive.hpp"
#include "io/workbook_sheet.hpp"
#include "io/workbook_styles.hpp"
#include "io/workbook_table.hpp"

namespace hysteron {
namespace {

using namespace workbook;

constexpr double seconds_a_day = 86'400.0;
// Workbooks count days from either year.
constexpr double days_from_1900_to_1904 = 1462.0;

class WorkbookReader {
 public:
  WorkbookReader(std::string_view bytes, const std::string& file, const ReadOptions& options)
      : archive_(bytes), file_(file), options_(options) {}

  Recording run() {
    find_sheets();
    if (!options_.group.empty()) {
      const auto wanted = std::ranges::find_if(
          names_, [&](const std::string& name) { return lower_case(name) == lower_case(options_.group); });
      if (wanted == names_.end()) {
        fail("no sheet " + in_quotes(options_.group) + " for " + Option::group + ", expected one of " + list(names_));
      }
      Sheet sheet = read_sheet(static_cast<std::size_t>(wanted - names_.begin()));
      const auto table = table_of(sheet, skip());
      if (!table) {
        const std::string why = why_no_table(sheet);
        if (!why.empty()) fail(why);
        fail("sheet " + in_quotes(sheet.name) + " has no row of names above rows of numbers, expected one");
      }
      return read_table(sheet, *table);
    }
    std::optional<Sheet> chosen;
    std::optional<Table> table;
    std::vector<std::string> with_tables;
    std::string why;  // a sheet is none that has one
    for (std::size_t k = 0; k < names_.size(); ++k) {
      Sheet sheet = read_sheet(k);
      auto of_sheet = table_of(sheet, skip());
      if (!of_sheet && why.empty()) why = why_no_table(sheet);
      if (!of_sheet || !names_a_channel(sheet, *of_sheet, options_)) continue;
      with_tables.push_back(sheet.name);
      if (chosen) continue;
      chosen = std::move(sheet);
      table = std::move(of_sheet);
    }
    if (!chosen && !why.empty()) fail(why);
    if (!chosen) {
      fail(
          "no sheet has a row of names such as time, displacement and force above rows of numbers, expected one; the "
          "sheets are " +
          list(names_));
    }
    if (with_tables.size() > 1) {
      fail(std::to_string(with_tables.size()) + " sheets hold recordings (" + list(with_tables) +
           "), expected one, or " + Option::group + " NAME to choose a sheet");
    }
    if (options_.remark && names_.size() > 1) {
      options_.remark({file_, Remark::Kind::dialect, "sheet",
                       "sheet " + with_state(chosen->name) + " is read, of " + std::to_string(names_.size()) +
                           " sheets: the others (" + others_than(chosen->name) + ") hold no recording"});
    }
    return read_table(*chosen, *table);
  }

 private:
  [[noreturn]] void fail(const Message& message) const { throw OptionError(file_, 0, message); }

  // 'Data (2)', which is hidden
  [[nodiscard]] std::string with_state(const std::string& name) const {
    const auto k = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
    return in_quotes(name) + (hidden_[k] ? ", which is hidden," : "");
  }

  [[nodiscard]] std::string others_than(const std::string& name) const {
    std::vector<std::string> shown;
    std::vector<std::string> hidden;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k] != name) (hidden_[k] ? hidden : shown).push_back(names_[k]);
    }
    return list(shown) + (shown.empty() || hidden.empty() ? "" : ", ") +
           (hidden.empty() ? "" : "hidden: " + list(hidden));
  }

  [[nodiscard]] std::uint32_t skip() const { return static_cast<std::uint32_t>(std::max(options_.skip, 0)); }

  static std::string list(const std::vector<std::string>& names) {
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t k = 0; k < std::min(names.size(), most); ++k) text += (k > 0 ? ", " : "") + in_quotes(names[k]);
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
  }

  void find_sheets() {
    std::string workbook;
    for (const Relation& relation : relations_of(archive_, "")) {
      if (relation.type.ends_with("/officeDocument")) workbook = relation.target;
    }
    if (workbook.empty()) throw Damage("it holds no workbook");
    const std::vector<Relation> relations = relations_of(archive_, workbook);
    for (const Relation& relation : relations) {
      if (relation.type.ends_with("/sharedStrings")) texts_ = shared_texts(archive_, relation.target);
      if (relation.type.ends_with("/styles")) styles_ = styles_of(archive_, relation.target);
    }
    XmlEvents events;
    events.begin = [&](std::string_view element, const XmlAttributes& attributes) {
      if (element == "workbookPr") {
        if (is_true(attribute(attributes, "date1904"))) days_at_1970_ -= days_from_1900_to_1904;
      }
      if (element != "sheet") return;
      const std::string_view id = attribute(attributes, "*:id");
      for (const Relation& relation : relations) {
        // Sheets of charts hold no cells.
        if (relation.id != id || !relation.type.ends_with("/worksheet")) continue;
        constexpr std::size_t most_sheets = 1000;
        if (names_.size() == most_sheets) throw Damage("it has more than 1000 sheets");
        if (std::ranges::find(paths_, relation.target) != paths_.end()) throw Damage("it names a sheet twice");
        names_.emplace_back(attribute(attributes, "name"));
        const std::string_view state = attribute(attributes, "state");
        hidden_.push_back(state == "hidden" || state == "veryHidden");
        paths_.push_back(relation.target);
        return;
      }
    };
    archive_.read(workbook, std::move(events));
    if (names_.empty()) throw Damage("it has no sheet");
  }

  [[nodiscard]] Sheet read_sheet(std::size_t k) { return sheet_of(archive_, paths_[k], names_[k], texts_, styles_); }

  [[noreturn]] void fail_at(std::uint32_t row, const Message& message) const {
    throw OptionError(file_, static_cast<int>(row), message);
  }

  // s since 1970 of the number of days that a date cell holds; nothing for a time of day without its date.
  [[nodiscard]] std::optional<double> clock_of(double days) const {
    return clock_time((days - days_at_1970_) * seconds_a_day);
  }

  // A row above the names may say when the recording was started: in a comment as a CSV file does, or in a cell "start"
  // with a date and its time of day beside it, formatted as one or as text.
  [[nodiscard]] std::optional<double> start_above(const Sheet& sheet, const Table& table) const {
    for (std::size_t r = 0; r < table.header; ++r) {
      if (sheet.rows[r].number <= skip()) continue;
      const std::span<const Cell> cells = sheet.cells_of(sheet.rows[r]);
      for (std::size_t k = 0; k < cells.size(); ++k) {
        std::string_view word = sheet.text(cells[k]);
        if (const auto start = clock_time_in(word)) {
          if (options_.start_zone) options_.start_zone(has_zone(word));
          return start;
        }
        if (k + 1 == cells.size()) break;
        if (word.ends_with(':')) word.remove_suffix(1);
        if (cells[k].kind != Cell::Kind::text || !announces_start(word)) continue;
        const std::string_view text = sheet.text(cells[k + 1]);
        const std::optional<double> days = cells[k + 1].date ? number_of(text) : std::nullopt;
        const bool has_time = days && *days != std::floor(*days);
        const auto start = has_time ? clock_of(*days) : clock_time(text);
        if (start && !has_time && options_.start_zone) options_.start_zone(has_zone(text));
        if (start) return start;
      }
    }
    return std::nullopt;
  }

  // Dates of a time column become seconds since its first, which is given; dates of any other channel are refused.
  std::optional<double> read_dates(Sheet& sheet, const Table& table) const {
    std::optional<double> start;
    std::vector<Column> columns;
    for (const std::uint32_t at : table.columns) columns.push_back(column_at(sheet, table, at));
    const std::map<std::uint32_t, std::uint32_t> dates = first_dates(sheet, table);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto date = dates.find(table.columns[k]);
      const std::optional<Quantity> quantity = date == dates.end() ? std::nullopt : channel_of(columns[k]);
      if (!quantity) continue;
      if (*quantity != Quantity::time) {
        fail_at(date->second, "the " + std::string(quantity_name(*quantity)) + " in column " +
                                  in_quotes(columns[k].text) + " is formatted as a date, expected a number");
      }
      start = dates_to_seconds(sheet, table, columns[k], table.columns[k]);
    }
    return start;
  }

  static const Cell* cell_of(const Sheet& sheet, const SheetRow& row, std::uint32_t column) {
    const std::span<const Cell> cells = sheet.cells_of(row);
    const auto found = std::ranges::find(cells, column, &Cell::column);
    return found == cells.end() ? nullptr : &*found;
  }

  // Of columns that hold dates, the row of the first.
  static std::map<std::uint32_t, std::uint32_t> first_dates(const Sheet& sheet, const Table& table) {
    std::map<std::uint32_t, std::uint32_t> rows;
    for (std::size_t r = table.header + 1; r < sheet.rows.size(); ++r) {
      for (const Cell& cell : sheet.cells_of(sheet.rows[r])) {
        if (cell.date) rows.emplace(cell.column, sheet.rows[r].number);
      }
    }
    return rows;
  }

  // By a mapping or its name; a time by the last word of its name, too.
  [[nodiscard]] std::optional<Quantity> channel_of(const Column& column) const {
    const auto mapped = std::ranges::find_if(options_.columns, [&](const auto& entry) {
      return trimmed(entry.second) == column.text ||
             lower_case(split_column(entry.second).name) == lower_case(column.name);
    });
    if (mapped != options_.columns.end()) return quantity_of_name(mapped->first);
    if (const auto quantity = quantity_of_column(column)) return quantity;
    return quantity_of_last_word(column.name) == Quantity::time ? std::optional(Quantity::time) : std::nullopt;
  }

  // Gives the first of them.
  std::optional<double> dates_to_seconds(Sheet& sheet, const Table& table, const Column& column,
                                         std::uint32_t at) const {
    std::optional<double> first;
    std::uint32_t before = 0;  // the last row with a date
    for (std::size_t r = table.header; r < sheet.rows.size(); ++r) {
      const Cell* found = cell_of(sheet, sheet.rows[r], at);
      if (found == nullptr) continue;
      Cell& cell = sheet.cells[static_cast<std::size_t>(found - sheet.cells.data())];
      const std::uint32_t row = sheet.rows[r].number;
      if (r == table.header) {
        refuse_other_unit(column.unit, column, row);
        sheet.write(cell, column.name + " [s]");
      } else if (cell.kind == Cell::Kind::text && !first) {
        // A row of units: what shows a date is said to be in "hh:mm:ss" as well.
        refuse_other_unit(without_brackets(sheet.text(cell)), column, row);
        sheet.write(cell, "s");
      } else if (cell.kind == Cell::Kind::number) {
        if (!cell.date && before + 1 != row) continue;  // below the table, or a serial number above the dates
        if (!cell.date) {
          fail_at(row, "time " + in_quotes(sheet.text(cell)) + " is no date among dates, expected one format");
        }
        const std::optional<double> days = number_of(sheet.text(cell));
        if (!days) continue;  // refused as text that is no number
        if (!first) first = days;
        before = row;
        sheet.write(cell, fmt::format("{}", (*days - *first) * seconds_a_day));
      }
    }
    if (options_.remark) {
      options_.remark({file_, Remark::Kind::dialect, "dates",
                       "the times of column " + in_quotes(column.text) +
                           " are dates or times of day: they are read in seconds since the first"});
    }
    return first ? clock_of(*first) : std::nullopt;
  }

  void refuse_other_unit(std::string_view unit, const Column& column, std::uint32_t row) const {
    const auto known = find_unit(Quantity::time, unit);
    if (!known || *known == UnitConversion{}) return;
    fail_at(row, "the times of column " + in_quotes(column.text) + " are dates and their unit is " + in_quotes(unit) +
                     ", expected numbers, or dates without a unit");
  }

  // Of the columns of the table, down to its last row, the unit that the format of their numbers shows. It stands for
  // one in the header, and contradicts another one there. Numbers of a channel in two units are refused.
  [[nodiscard]] std::vector<std::string> units_of_formats(const Sheet& sheet, const Table& table,
                                                          std::uint32_t last) const {
    struct Found {
      const Shown* shown = nullptr;
      std::uint32_t row = 0;
    };
    std::vector<Found> found(table.columns.size());
    for (std::size_t r = table.header + 1; r < sheet.rows.size() && sheet.rows[r].number <= last; ++r) {
      for (const Cell& cell : sheet.cells_of(sheet.rows[r])) {
        const bool has_unit = cell.style < styles_.size() && !styles_[cell.style].unit.empty();
        const auto at = std::ranges::lower_bound(table.columns, cell.column);
        if (cell.kind != Cell::Kind::number || !has_unit || at == table.columns.end() || *at != cell.column) continue;
        Found& first = found[static_cast<std::size_t>(at - table.columns.begin())];
        const Shown& shown = styles_[cell.style];
        if (first.shown == nullptr) first = {&shown, sheet.rows[r].number};
        const bool same = first.shown == &shown ||
                          (!contradict(first.shown->unit, shown.unit) && first.shown->scaled == shown.scaled);
        if (same) continue;
        const Column column = column_at(sheet, table, cell.column);
        if (!is_channel(column)) continue;
        fail_at(sheet.rows[r].number, "a number of column " + in_quotes(column.text) + " is shown in " +
                                          in_quotes(shown.unit) + ", and that of row " + std::to_string(first.row) +
                                          " in " + in_quotes(first.shown->unit) + ", expected one format");
      }
    }
    std::vector<std::string> units(found.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k].shown == nullptr) continue;
      const std::string& unit = found[k].shown->unit;
      const bool known = is_any_unit(unit) || find_pressure(unit).has_value();
      if (known && !found[k].shown->scaled) units[k] = unit;
      const Column column = column_at(sheet, table, table.columns[k]);
      const Cell* below = cell_of(sheet, sheet.rows[table.header + 1], table.columns[k]);
      const bool has_unit = !column.unit.empty() || (below != nullptr && below->kind == Cell::Kind::text);
      if (!options_.remark || has_unit || has_mapped_unit(column) || !is_channel(column)) continue;
      options_.remark(
          {file_, Remark::Kind::dialect, "format of " + column.text,
           "the numbers of column " + in_quotes(column.text) + ", whose header has no unit, are shown in " +
               (!units[k].empty() ? in_quotes(unit) + ": it is taken"
                : known ? "parts or multiples of " + in_quotes(unit) + ": SI is taken, expected a unit in the header"
                        : in_quotes(unit) + ", which is no unit that is known: SI is taken")});
    }
    return units;
  }

  [[nodiscard]] bool is_channel(const Column& column) const {
    return channel_of(column).has_value() || quantity_of_last_word(column.name).has_value();
  }

  // Whether --column gives it.
  [[nodiscard]] bool has_mapped_unit(const Column& column) const {
    return std::ranges::any_of(options_.columns, [&](const auto& entry) {
      const Column mapped = split_column(entry.second);
      return !mapped.unit.empty() && lower_case(mapped.name) == lower_case(column.name);
    });
  }

  static Column column_at(const Sheet& sheet, const Table& table, std::uint32_t column) {
    const Cell* name = cell_of(sheet, sheet.rows[table.header], column);
    return split_column(name == nullptr ? std::string_view{} : sheet.text(*name));
  }

  // A filter or a hand hides rows and columns of what is seen; their numbers are those of the recording all the same.
  void tell_hidden_rows(const Sheet& sheet, const Table& table, std::uint32_t last) const {
    std::size_t count = 0;
    std::uint32_t first = 0;
    for (std::size_t r = table.header + 1; r < sheet.rows.size() && sheet.rows[r].number <= last; ++r) {
      const SheetRow& row = sheet.rows[r];
      if (!row.hidden || numbers_in(sheet, row, table.columns) == 0) continue;
      if (count++ == 0) first = row.number;
    }
    if (count == 0 || !options_.remark) return;
    const std::string row = "row " + std::to_string(first);
    const std::string of_sheet = " of sheet " + in_quotes(sheet.name);
    options_.remark({file_, Remark::Kind::dialect, "hidden rows",
                     count == 1 ? row + of_sheet + " is hidden: its numbers are read all the same"
                                : std::to_string(count) + " rows" + of_sheet + ", from " + row +
                                      " on, are hidden: their numbers are read all the same"});
  }

  void tell_hidden_columns(const Sheet& sheet, const Table& table) const {
    std::vector<std::string> names;
    for (const std::uint32_t at : table.columns) {
      const bool hidden = std::ranges::any_of(sheet.hidden_columns,
                                              [&](const auto& ends) { return at >= ends.first && at <= ends.second; });
      const Column column = column_at(sheet, table, at);
      if (hidden && channel_of(column)) names.push_back(column.text);
    }
    if (names.empty() || !options_.remark) return;
    options_.remark({file_, Remark::Kind::dialect, "hidden columns",
                     (names.size() == 1 ? "column " : "columns ") + list(names) + " of sheet " + in_quotes(sheet.name) +
                         (names.size() == 1 ? " is hidden: it is" : " are hidden: they are") + " read all the same"});
  }

  [[nodiscard]] Recording read_table(Sheet& sheet, const Table& table) const {
    const std::optional<double> first_date = read_dates(sheet, table);
    const std::optional<double> start = first_date ? first_date : start_above(sheet, table);
    const std::uint32_t row = sheet.rows[table.header].number;
    if (options_.remark && table.header > 0 && row > skip() + 1) {
      options_.remark({file_, Remark::Kind::dialect, "header",
                       "the header is taken from row " + std::to_string(row) + " of sheet " + in_quotes(sheet.name) +
                           (start && !first_date ? ", of the rows before it the start alone is read"
                                                 : ", rows before it are not read")});
    }
    if (options_.remark && skip() > 0) {
      options_.remark(
          {file_, Remark::Kind::dialect, "skipped",
           (skip() == 1 ? "the first row of sheet " : "the first " + std::to_string(skip()) + " rows of sheet ") +
               in_quotes(sheet.name) + (skip() == 1 ? " is" : " are") + " not read, as " + Option::skip + " says"});
    }
    const TableText table_text = text_of(sheet, table);
    for (const std::string& remark : table_text.remarks) {
      if (options_.remark) options_.remark({file_, Remark::Kind::dialect, "empty row", remark});
    }
    ReadOptions of_table = options_;
    of_table.skip = 0;  // the text begins with the rows above the header, which are empty
    const auto last = static_cast<std::uint32_t>(std::ranges::count(table_text.text, '\n'));
    tell_hidden_rows(sheet, table, last);
    tell_hidden_columns(sheet, table);
    Recording recording = parse_csv(table_text.text, file_, of_table, units_of_formats(sheet, table, last));
    if (start) recording.started = start;
    return recording;
  }

  Archive archive_;
  const std::string& file_;
  const ReadOptions& options_;
  std::vector<std::string> texts_;
  std::vector<Shown> styles_;       // of cells
  std::vector<std::string> names_;  // of the sheets
  std::vector<bool> hidden_;        // likewise
  std::vector<std::string> paths_;
  double days_at_1970_ = 25'569.0;  // the number that stands for the first of January 1970
};

constexpr Ending endings[] = {{".xlsx", InFolders::without_others}, {".xlsm", InFolders::without_others}};

bool begins(std::string_view head) { return head.starts_with("PK\x03\x04"); }

Recording parse(std::string_view bytes, const std::string& file, const ReadOptions& options) {
  const auto fail = [&](const std::string& what) {
    throw InputError(file, 0, "the workbook is not read: " + what + ", expected an .xlsx file");
  };
  if (bytes.starts_with("\xD0\xCF\x11\xE0")) fail("it is an old .xls file or protected by a password");
  try {
    return WorkbookReader(bytes, file, options).run();
  } catch (const Damage& damage) {
    fail(damage.what());
  } catch (const XmlDamage& damage) {
    fail(std::string("its XML is not as it should be, ") + damage.what());
  }
  return {};
}

}  // namespace

extern const InputFormat format_xlsx;
const InputFormat format_xlsx = {.name = "xlsx",
                                 .endings = endings,
                                 .begins = begins,
                                 .parse = parse,
                                 .samples = samples_by_size,
                                 .groups = true,
                                 .lines = true};

}  // namespace hysteron

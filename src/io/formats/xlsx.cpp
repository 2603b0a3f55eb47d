// Workbooks of Excel and of programs that write alike (Office Open XML, .xlsx). Source: ECMA-376, part 1, chapters 12
// and 18.
//
// A workbook is a zip archive of XML. One of its sheets is read as CSV text is: the same names, units, rules and
// messages, whose line numbers are the rows of the sheet. The table of a sheet begins with the first row of names that
// has numbers below; its columns are those with a name, and it ends where all of them are empty.
#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
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
#include "io/xml.hpp"

namespace hysteron {
namespace {

constexpr std::uint32_t most_rows = 1'048'576;  // of a sheet
constexpr std::uint32_t most_columns = 16'384;
constexpr std::size_t longest_cell = 32'767;  // characters
// Sheets of measured numbers shrink to a fifth or a tenth. What grows more than this is no recording.
constexpr std::uint64_t most_growth = 100;
constexpr std::uint64_t growth_allowed = std::uint64_t{1} << 20U;  // bytes that may grow by any factor
constexpr std::uint64_t largest_part = std::uint64_t{2} << 30U;    // unpacked
constexpr double seconds_a_day = 86'400.0;
// Workbooks count days from either year.
constexpr double days_from_1900_to_1904 = 1462.0;

// A part of a workbook that is not what it should be, without the name of the file.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Archive {
 public:
  explicit Archive(std::string_view bytes) : room_(growth_allowed + most_growth * bytes.size()) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr) throw std::bad_alloc();
    archive_ = zip_open_from_source(source, ZIP_RDONLY, &error);
    zip_error_fini(&error);
    if (archive_ == nullptr) {
      zip_source_free(source);
      throw Damage("the zip archive cannot be opened, the file is cut off or damaged");
    }
  }
  ~Archive() { zip_discard(archive_); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // The XML of a part, told in pieces.
  void read(const std::string& path, XmlEvents events) {
    const zip_int64_t index = zip_name_locate(archive_, path.c_str(), ZIP_FL_ENC_RAW);
    zip_stat_t stat;
    zip_stat_init(&stat);
    constexpr zip_uint64_t needed =
        ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
    if (index < 0 || zip_stat_index(archive_, static_cast<zip_uint64_t>(index), 0, &stat) != 0 ||
        (stat.valid & needed) != needed) {
      throw Damage("it has no part " + in_quotes(path) + ", the file is damaged");
    }
    if (stat.encryption_method != ZIP_EM_NONE) throw Damage("it is encrypted");
    if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE) {
      throw Damage("its part " + in_quotes(path) + " is packed by method " + std::to_string(stat.comp_method));
    }
    if (stat.size > largest_part || stat.size > growth_allowed + most_growth * stat.comp_size) {
      throw Damage("its part " + in_quotes(path) + " of " + std::to_string(stat.comp_size) + " bytes unpacks to " +
                   std::to_string(stat.size) + ", which no recording does");
    }
    // Parts may be made of the same bytes.
    if (stat.size > room_)
      throw Damage("its parts unpack to more than a hundred times its size, which no recording does");
    room_ -= stat.size;
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
        zip_fopen_index(archive_, static_cast<zip_uint64_t>(index), 0), zip_fclose);
    if (!file) throw Damage("its part " + in_quotes(path) + " cannot be unpacked, the file is damaged");
    XmlReader reader(std::move(events));
    std::string piece(std::size_t{1} << 16U, '\0');
    zip_uint64_t total = 0;
    for (;;) {
      const zip_int64_t got = zip_fread(file.get(), piece.data(), piece.size());
      // The checksum of a part is found wrong at its end.
      if (got < 0 || (total += static_cast<zip_uint64_t>(got)) > stat.size || (got == 0 && total != stat.size)) {
        throw Damage("its part " + in_quotes(path) + " cannot be unpacked, the file is damaged");
      }
      if (got == 0) break;
      reader.add(std::string_view(piece).substr(0, static_cast<std::size_t>(got)));
    }
    reader.finish();
  }

 private:
  zip_t* archive_ = nullptr;
  std::uint64_t room_;  // bytes that may still be unpacked
};

// "xl/workbook.xml" and "worksheets/sheet1.xml" -> "xl/worksheets/sheet1.xml"; a target that begins with a slash counts
// from the archive.
std::string resolved(std::string_view part, std::string_view target) {
  if (target.starts_with('/')) return std::string(target.substr(1));
  std::string folder(part.substr(0, part.rfind('/') == std::string_view::npos ? 0 : part.rfind('/') + 1));
  while (target.starts_with("../") && !folder.empty()) {
    target.remove_prefix(3);
    folder.pop_back();
    folder.resize(folder.rfind('/') == std::string::npos ? 0 : folder.rfind('/') + 1);
  }
  return folder + std::string(target);
}

struct Relation {
  std::string id;
  std::string type;
  std::string target;  // a path in the archive
};

// What a part relates to; `part` empty: what the archive does.
std::vector<Relation> relations_of(Archive& archive, const std::string& part) {
  const std::size_t slash = part.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : part.substr(0, slash + 1);
  const std::string name = slash == std::string::npos ? part : part.substr(slash + 1);
  std::vector<Relation> relations;
  XmlEvents events;
  events.begin = [&](std::string_view element, const XmlAttributes& attributes) {
    if (element != "Relationship" || attribute(attributes, "TargetMode") == "External") return;
    relations.push_back({std::string(attribute(attributes, "Id")), std::string(attribute(attributes, "Type")),
                         resolved(part, attribute(attributes, "Target"))});
  };
  archive.read(folder + "_rels/" + name + ".rels", std::move(events));
  return relations;
}

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

// "AB12" -> 27, counted from 0; nothing where it is none.
std::optional<std::uint32_t> column_of(std::string_view reference) {
  std::uint32_t column = 0;
  std::size_t letters = 0;
  for (; letters < reference.size() && reference[letters] >= 'A' && reference[letters] <= 'Z'; ++letters) {
    column = 26 * column + static_cast<std::uint32_t>(reference[letters] - 'A' + 1);
    if (column > most_columns) return std::nullopt;
  }
  return letters == 0 ? std::nullopt : std::optional(column - 1);
}

std::optional<std::uint32_t> whole(std::string_view text) {
  std::uint32_t value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_true(std::string_view attribute) { return attribute == "1" || attribute == "true"; }

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = read.ec == std::errc() && read.ptr == text.data() + text.size();
  return whole_text && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// With a decimal comma, too.
bool looks_like_a_number(std::string_view text) {
  std::string copy(text);
  std::ranges::replace(copy, ',', '.');
  return number_of(copy).has_value();
}

// Texts that cells name by number.
std::vector<std::string> shared_texts(Archive& archive, const std::string& path) {
  std::vector<std::string> texts;
  bool in_text = false;
  int phonetic = 0;  // how a text is read aloud, which is not part of it
  XmlEvents events;
  events.begin = [&](std::string_view name, const XmlAttributes& /*attributes*/) {
    if (name == "si") texts.emplace_back();
    if (name == "rPh") ++phonetic;
    in_text = name == "t" && phonetic == 0;
  };
  events.end = [&](std::string_view name) {
    if (name == "rPh") --phonetic;
    in_text = false;
  };
  events.text = [&](std::string_view piece) {
    if (!in_text || texts.empty()) return;
    if (texts.back().size() + piece.size() > 4 * longest_cell) throw Damage("a text longer than a cell holds");
    texts.back() += piece;
  };
  archive.read(path, std::move(events));
  return texts;
}

// "[h]", "[mm]": hours, minutes or seconds that go on beyond a day.
bool is_elapsed(std::string_view bracket) {
  const std::string lower = lower_case(bracket);
  return !lower.empty() && std::string_view("hms").find(lower.front()) != std::string_view::npos &&
         lower.find_first_not_of(lower.front()) == std::string::npos;
}

// Whether a format shows a number of days as a date or a time: a letter of one stands before the first digit, outside
// of quotes and brackets. "0.00 s" is a number with a unit.
bool shows_a_date(std::string_view code) {
  for (std::size_t k = 0; k < code.size(); ++k) {
    const char c = code[k];
    if (c == ';' || c == '0' || c == '#' || c == '?') return false;
    if (c == '\\' || c == '_' || c == '*') {  // the next character stands for itself, or for a blank
      ++k;
    } else if (c == '"' || c == '[') {
      const std::size_t end = std::min(code.find(c == '"' ? '"' : ']', k + 1), code.size());
      if (c == '[' && is_elapsed(code.substr(k + 1, end - k - 1))) return true;
      k = end;
    } else if (lower_case(code.substr(k, 7)) == "general") {
      return false;
    } else if (std::string_view("ydhmsYDHMS").find(c) != std::string_view::npos) {
      return true;
    }
  }
  return false;
}

// Formats that have a number and no code (ECMA-376, 18.8.30): dates and times of every language.
bool is_built_in_date(std::uint32_t format) {
  return (format >= 14 && format <= 22) || (format >= 27 && format <= 36) || (format >= 45 && format <= 47) ||
         (format >= 50 && format <= 58);
}

// What a format shows beside a number: a unit as in 0.0" kN", and whether it shows a part of the number, as a comma
// behind the digits and a percent sign do.
struct Shown {
  bool date = false;
  std::string unit;
  bool scaled = false;
};

// Of a format of positive numbers: what stands behind its digits.
Shown shown_by(std::string_view code) {
  Shown shown{shows_a_date(code), {}, false};
  if (shown.date) return shown;
  bool behind = false;
  const auto is_exponent = [&](std::size_t k) {
    return lower_case(code.substr(k, 1)) == "e" &&
           (code.substr(k + 1).starts_with('+') || code.substr(k + 1).starts_with('-'));
  };
  for (std::size_t k = 0; k < code.size() && code[k] != ';'; ++k) {
    const char c = code[k];
    std::string_view text;
    if (c == '"' || c == '[') {
      const std::size_t end = std::min(code.find(c == '"' ? '"' : ']', k + 1), code.size());
      text = code.substr(k + 1, end - k - 1);
      // [$kN-409] is a text and the number of a language; other brackets are colours and conditions.
      if (c == '[') text = text.starts_with('$') ? text.substr(1, text.rfind('-') - 1) : std::string_view{};
      k = end;
    } else if (c == '\\' && k + 1 < code.size()) {
      text = code.substr(++k, 1);
    } else if (c == '_' || c == '*' || is_exponent(k)) {
      ++k;  // a blank as wide as the next character, that character as often as it fits, or the exponent's sign
    } else if (c == '0' || c == '#' || c == '?') {
      behind = true;
      shown.scaled = false;  // commas so far stand between thousands
      shown.unit.clear();
    } else if (lower_case(code.substr(k, 7)) == "general") {
      behind = true;
      k += 6;
    } else if (c == ',' || c == '%') {
      shown.scaled = behind;
    } else if (c != '.') {
      text = code.substr(k, 1);
    }
    if (behind) shown.unit += text;
  }
  shown.unit = without_brackets(without_blanks(shown.unit));
  // Parentheses, strokes of fractions and the like are none; a degree sign is no ASCII.
  const auto is_letter = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalpha(byte) != 0 || byte >= 0x80;
  };
  constexpr std::size_t longest_unit = 32;
  if (shown.unit.size() > longest_unit || std::ranges::none_of(shown.unit, is_letter)) shown.unit.clear();
  return shown;
}

// Of every style of cells, what its format shows.
std::vector<Shown> styles_of(Archive& archive, const std::string& path) {
  constexpr std::size_t most_styles = 65'536;
  std::vector<std::pair<std::uint32_t, Shown>> formats;  // those with a code
  std::vector<Shown> styles;
  bool of_cells = false;
  XmlEvents events;
  events.begin = [&](std::string_view name, const XmlAttributes& attributes) {
    of_cells = of_cells || name == "cellXfs";
    const std::optional<std::uint32_t> format = whole(attribute(attributes, "numFmtId"));
    if (name == "numFmt" && format && formats.size() < most_styles) {
      formats.emplace_back(*format, shown_by(attribute(attributes, "formatCode")));
    }
    if (name != "xf" || !of_cells) return;
    if (styles.size() == most_styles) throw Damage("it has more than 65536 styles");
    const auto coded = std::ranges::find(formats, format.value_or(0), &std::pair<std::uint32_t, Shown>::first);
    styles.push_back(coded != formats.end() ? coded->second : Shown{format && is_built_in_date(*format), {}, false});
  };
  events.end = [&](std::string_view name) { of_cells = of_cells && name != "cellXfs"; };
  archive.read(path, std::move(events));
  return styles;
}

class SheetParser {
 public:
  SheetParser(Sheet& sheet, const std::vector<std::string>& texts, const std::vector<Shown>& styles)
      : sheet_(sheet), texts_(texts), styles_(styles) {}

  [[nodiscard]] XmlEvents events() {
    XmlEvents events;
    events.begin = [this](std::string_view name, const XmlAttributes& attributes) { begin(name, attributes); };
    events.end = [this](std::string_view name) { end(name); };
    events.text = [this](std::string_view piece) {
      if (!in_value_) return;
      if (value_.size() + piece.size() > 4 * longest_cell) throw Damage("a text longer than a cell holds");
      value_ += piece;
    };
    return events;
  }

 private:
  void begin(std::string_view name, const XmlAttributes& attributes) {
    if (name == "row") {
      begin_row(attribute(attributes, "r"), is_true(attribute(attributes, "hidden")));
    } else if (name == "col") {
      const std::optional<std::uint32_t> first = whole(attribute(attributes, "min"));
      const std::optional<std::uint32_t> last = whole(attribute(attributes, "max"));
      // Counted from 1.
      if (first && last && *first > 0 && is_true(attribute(attributes, "hidden")) &&
          sheet_.hidden_columns.size() < most_columns) {
        sheet_.hidden_columns.emplace_back(*first - 1, *last - 1);
      }
    } else if (name == "c") {
      if (sheet_.rows.empty()) throw Damage("a cell outside of a row");
      const std::string_view reference = attribute(attributes, "r");
      const std::optional<std::uint32_t> column = reference.empty() ? next_column_ : column_of(reference);
      if (!column || *column >= most_columns || *column < next_column_) {
        throw Damage("a cell " + in_quotes(reference) + " out of order");
      }
      column_ = *column;
      next_column_ = *column + 1;
      type_ = attribute(attributes, "t");
      const std::optional<std::uint32_t> style = whole(attribute(attributes, "s"));
      style_ = style && *style < styles_.size() ? static_cast<std::uint16_t>(*style) : 0;
      value_.clear();
      has_formula_ = false;
      in_cell_ = true;
    }
    has_formula_ = has_formula_ || name == "f";
    in_value_ = in_cell_ && (name == "v" || (name == "t" && phonetic_ == 0));
    if (name == "rPh") ++phonetic_;
  }

  void begin_row(std::string_view number, bool hidden) {
    if (in_cell_) throw Damage("a row in a cell");
    const std::optional<std::uint32_t> row = number.empty() ? next_row_ : whole(number);
    if (!row || *row < next_row_ || *row > most_rows) throw Damage("a row " + in_quotes(number) + " out of order");
    next_row_ = *row + 1;
    next_column_ = 0;
    sheet_.rows.push_back({*row, sheet_.cells.size(), 0, hidden});
  }

  void end(std::string_view name) {
    if (name == "rPh") --phonetic_;
    in_value_ = false;
    if (name != "c") return;
    in_cell_ = false;
    Cell::Kind kind = Cell::Kind::text;
    std::string_view text = value_;
    if (type_ == "s") {
      const std::optional<std::uint32_t> k = whole(value_);
      if (!k || *k >= texts_.size()) throw Damage("a cell with text " + in_quotes(value_) + ", which is not there");
      text = texts_[*k];
    } else if (type_.empty() || type_ == "n") {
      kind = Cell::Kind::number;
    } else if (type_ == "b") {
      kind = Cell::Kind::truth;
    } else if (type_ == "e") {
      kind = Cell::Kind::error;
    }
    text = trimmed(text);
    // An empty text is a value.
    if (has_formula_ && value_.empty() && type_ != "str") sheet_.unvalued.push_back(sheet_.rows.back().number);
    if (text.empty()) return;
    if (sheet_.letters.size() + text.size() > largest_part) throw Damage("more text than 2 GiB");
    const bool date = style_ < styles_.size() && styles_[style_].date && kind == Cell::Kind::number;
    sheet_.cells.push_back(
        {column_, kind, date, style_, static_cast<std::uint32_t>(text.size()), sheet_.letters.size()});
    sheet_.letters += text;
    ++sheet_.rows.back().count;
  }

  Sheet& sheet_;
  const std::vector<std::string>& texts_;
  const std::vector<Shown>& styles_;
  std::uint32_t next_row_ = 1;
  std::uint32_t next_column_ = 0;
  std::uint32_t column_ = 0;
  std::string type_;
  std::string value_;
  std::uint16_t style_ = 0;
  bool has_formula_ = false;
  bool in_cell_ = false;
  bool in_value_ = false;
  int phonetic_ = 0;
};

// The table of a sheet.
struct Table {
  std::size_t header = 0;  // in Sheet::rows
  std::vector<std::uint32_t> columns;
};

// How many of the columns hold a number in a row.
std::size_t numbers_in(const Sheet& sheet, const SheetRow& row, const std::vector<std::uint32_t>& columns) {
  return static_cast<std::size_t>(std::ranges::count_if(sheet.cells_of(row), [&](const Cell& cell) {
    return cell.kind == Cell::Kind::number && std::ranges::binary_search(columns, cell.column);
  }));
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

// The first row with two names or more that has numbers below half of them, next to it or below a row of units.
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

// Why the rows below names are no numbers, as they look like: they hold texts, or formulas whose values are not stored.
// Empty where they do not.
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

// The table as text, row N of the sheet is line N, what is not of the table is left out; and what of the sheet was not
// taken as it stands.
struct TableText {
  std::string text;
  std::vector<std::string> remarks;
};
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

// Whether a header names a channel, by itself or by a mapping.
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

  [[nodiscard]] Sheet read_sheet(std::size_t k) {
    Sheet sheet;
    sheet.name = names_[k];
    SheetParser parser(sheet, texts_, styles_);
    archive_.read(paths_[k], parser.events());
    return sheet;
  }

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

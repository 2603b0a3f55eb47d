#include "io/workbook_sheet.hpp"

#include <charconv>
#include <cmath>

#include "io/text.hpp"

namespace hysteron::workbook {
namespace {

constexpr std::uint32_t most_rows = 1'048'576;  // of a sheet
constexpr std::uint32_t most_columns = 16'384;
constexpr std::size_t longest_cell = 32'767;  // characters

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

}  // namespace

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = read.ec == std::errc() && read.ptr == text.data() + text.size();
  return whole_text && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

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

Sheet sheet_of(Archive& archive, const std::string& path, const std::string& name,
               const std::vector<std::string>& texts, const std::vector<Shown>& styles) {
  Sheet sheet;
  sheet.name = name;
  SheetParser parser(sheet, texts, styles);
  archive.read(path, parser.events());
  return sheet;
}

}  // namespace hysteron::workbook

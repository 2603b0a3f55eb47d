#include "io/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/plausible.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
    field = trimmed(field.substr(1, field.size() - 2));
  }
  return field;
}

// Cuts a line at the delimiter, not inside double quotes.
void split(std::string_view line, char delimiter, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0;
  bool inside = false;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') inside = !inside;
    if (i == line.size() || (line[i] == delimiter && !inside)) {
      fields.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    }
  }
}

enum class NumberError { none, empty, not_a_number, not_finite, out_of_range };

// Locale-independent; with `decimal_comma`, "1,5" is read as 1.5.
NumberError parse_number(std::string_view field, bool decimal_comma, double& value) {
  std::array<char, 64> copy{};
  if (decimal_comma && field.size() < copy.size()) {
    const auto comma = field.find(',');
    if (comma != std::string_view::npos && field.find('.') == std::string_view::npos) {
      std::ranges::copy(field, copy.begin());
      copy[comma] = '.';
      field = {copy.data(), field.size()};
    }
  }
  if (field.empty()) return NumberError::empty;
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  const char* begin = field.data() + (plus ? 1 : 0);
  const char* end = field.data() + field.size();
  const auto result = std::from_chars(begin, end, value);
  if (result.ptr != end || result.ec == std::errc::invalid_argument) return NumberError::not_a_number;
  if (result.ec == std::errc::result_out_of_range) {
    // Too small is zero; too large is an error.
    if (field.find("e-") == std::string_view::npos && field.find("E-") == std::string_view::npos) {
      return NumberError::out_of_range;
    }
    value = 0.0;
    return NumberError::none;
  }
  return std::isfinite(value) ? NumberError::none : NumberError::not_finite;
}

bool is_number(std::string_view field) {
  double value = 0.0;
  const auto error = parse_number(unquoted(field), true, value);
  return error != NumberError::not_a_number && error != NumberError::empty;
}

std::string_view without_brackets(std::string_view unit) {
  if (unit.size() >= 2 &&
      ((unit.front() == '[' && unit.back() == ']') || (unit.front() == '(' && unit.back() == ')'))) {
    return trimmed(unit.substr(1, unit.size() - 2));
  }
  return unit;
}

bool is_any_unit(std::string_view text) {
  for (int i = 0; i < quantity_count; ++i) {
    if (find_unit(static_cast<Quantity>(i), text)) return true;
  }
  return false;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file, const ReadOptions& options)
      : text_(text), file_(file), options_(options) {}

  Recording run() {
    check_text();
    read_header();
    read_rows();
    const auto rows = static_cast<double>(channels_[0].size());
    Recording recording = make_recording(std::move(channels_));
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (unused_[i].numbers) recording.unused.push_back({columns_[i].text, unused_[i].sum / rows});
    }
    remark_on_sizes(recording, sources_, columns_, options_, file_);
    return recording;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const { throw InputError(file_, line, message); }

  void check_text() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
      fail(0, "the file is UTF-16 text, expected UTF-8");
    }
    if (text_.empty()) fail(0, "the file is empty, expected a header row and at least 8 rows of numbers");
    if (const auto nul = text_.find('\0'); nul != std::string_view::npos) {
      fail(1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(nul), '\n')),
           "a NUL byte, the file is not text, expected UTF-8 CSV");
    }
    // Line ends of a lone CR, as some old instruments write.
    if (text_.find('\n') == std::string_view::npos && text_.find('\r') != std::string_view::npos) line_end_ = '\r';
    has_quotes_ = text_.find('"') != std::string_view::npos;
  }

  // The next line that is neither blank nor a comment; false at the end of the text.
  bool next_line(std::string_view& line) {
    while (position_ < text_.size()) {
      ++line_;
      const void* found = std::memchr(text_.data() + position_, line_end_, text_.size() - position_);
      ended_ = found != nullptr;
      const std::size_t end =
          ended_ ? static_cast<std::size_t>(static_cast<const char*>(found) - text_.data()) : text_.size();
      line = text_.substr(position_, end - position_);
      position_ = end + 1;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      const auto first = line.find_first_not_of(" \t");
      if (first != std::string_view::npos && line[first] != '#') return true;
    }
    return false;
  }

  static char delimiter_of(std::string_view line) {
    return line.find('\t') != std::string_view::npos && line.find_first_of(",;") == std::string_view::npos ? '\t'
           : line.find(';') != std::string_view::npos                                                      ? ';'
           : line.find('\t') != std::string_view::npos                                                     ? '\t'
                                                                                                           : ',';
  }

  void skip_lines() {
    for (int k = 0; k < options_.skip; ++k) {
      const std::size_t end = position_ < text_.size() ? text_.find(line_end_, position_) : std::string_view::npos;
      if (end == std::string_view::npos) {
        fail(0, "--skip " + std::to_string(options_.skip) + " leaves nothing of the file, expected fewer lines");
      }
      position_ = end + 1;
      ++line_;
    }
  }

  // Cells of the next line by a delimiter, an empty last one left out; none at the end of the text.
  std::vector<std::string_view> next_cells(char delimiter) {
    std::vector<std::string_view> cells;
    std::string_view line;
    if (!next_line(line)) return cells;
    split(line, delimiter, cells);
    if (cells.size() > 1 && unquoted(cells.back()).empty()) cells.pop_back();
    return cells;
  }

  // Instruments write lines of their own before the header, which is the first line of words above as many numbers,
  // with or without a row of units between. Left where it is where there is none: what is wrong is said of the first
  // line then.
  void find_header() {
    constexpr int most_lines = 200;
    const auto mostly_numbers = [](const std::vector<std::string_view>& cells) {
      return 2 * std::ranges::count_if(cells, is_number) >= std::ssize(cells);
    };
    const auto names_a_channel = [](const std::vector<std::string_view>& cells) {
      return std::ranges::any_of(
          cells, [](std::string_view cell) { return quantity_of_name(split_column(unquoted(cell)).name).has_value(); });
    };
    const auto begin = position_;
    const auto before = line_;
    for (int k = 0; k < most_lines; ++k) {
      const auto here = position_;
      const auto number = line_;
      std::string_view line;
      if (!next_line(line)) break;
      const char delimiter = delimiter_of(line);
      position_ = here;
      line_ = number;
      const std::vector<std::string_view> names = next_cells(delimiter);
      if (mostly_numbers(names)) break;
      const auto behind = position_;
      const auto at = line_;
      std::vector<std::string_view> below = next_cells(delimiter);
      // A row of units below the names, or words where numbers are expected, which is said then: no title above a
      // header.
      if (below.size() == names.size() && !mostly_numbers(below) && names_a_channel(names)) {
        below = next_cells(delimiter);
      }
      if (names.size() > 1 && below.size() == names.size() && mostly_numbers(below)) {
        position_ = here;
        line_ = number;
        if (k > 0 && options_.remark) {
          const std::string text =
              "the header is taken from line " + std::to_string(at) + ", lines before it are not read";
          options_.remark({file_, Remark::Kind::dialect, "header", text});
        }
        return;
      }
      position_ = behind;
      line_ = at;
    }
    position_ = begin;
    line_ = before;
  }

  void read_header() {
    skip_lines();
    find_header();
    std::string_view line;
    if (!next_line(line)) {
      fail(0, "the file holds only blank lines and comments, expected a header row and at least 8 rows of numbers");
    }
    header_line_ = line_;
    delimiter_ = delimiter_of(line);
    std::vector<std::string_view> cells;
    split(line, delimiter_, cells);
    if (cells.size() > 1 && unquoted(cells.back()).empty()) cells.pop_back();  // a delimiter at the end of each row
    if (std::ranges::all_of(cells, is_number)) {
      fail(line_,
           "the first row holds only numbers, expected names and units such as 'time [s],displacement [mm],force [N]'");
    }
    for (const auto cell : cells) columns_.push_back(split_column(unquoted(cell)));
    read_unit_row();
    sources_ = assign_columns(columns_, options_, file_, header_line_);
  }

  // A row below the names without any number and with at least one known unit.
  void read_unit_row() {
    const auto position = position_;
    const auto line_number = line_;
    std::string_view line;
    if (!next_line(line)) return;
    std::vector<std::string_view> cells;
    split(line, delimiter_, cells);
    const bool units = std::ranges::none_of(cells, is_number) && std::ranges::any_of(cells, [](std::string_view cell) {
                         return is_any_unit(without_brackets(unquoted(cell)));
                       });
    if (!units) {
      position_ = position;
      line_ = line_number;
      return;
    }
    for (std::size_t i = 0; i < std::min(cells.size(), columns_.size()); ++i) {
      if (columns_[i].unit.empty()) columns_[i].unit = without_brackets(unquoted(cells[i]));
    }
    header_line_ = line_;
  }

  void read_rows() {
    std::vector<int> channel_of(columns_.size(), -1);
    const auto rows =
        static_cast<std::size_t>(std::ranges::count(text_.substr(position_ < text_.size() ? position_ : 0), line_end_));
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].column < 0) continue;
      // One column may serve only one channel, except by two mappings.
      auto& channel = channel_of[static_cast<std::size_t>(sources_[i].column)];
      if (channel >= 0)
        fail(header_line_, "column " + in_quotes(columns_[static_cast<std::size_t>(sources_[i].column)].text) +
                               " is mapped to both " + name_of(channel) + " and " + name_of(static_cast<int>(i)) +
                               ", expected one channel per column");
      channel = static_cast<int>(i);
      channels_[i].reserve(rows + 1);
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      unused_.push_back({0.0, channel_of[i] < 0 && !columns_[i].text.empty()});
    }
    const bool decimal_comma = delimiter_ != ',' || has_quotes_;
    std::vector<std::string_view> fields;
    std::string_view line;
    while (next_line(line)) {
      if (has_quotes_) {
        split(line, delimiter_, fields);
      } else {
        split_plain(line, fields);
      }
      check_width(fields);
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (channel_of[i] >= 0) {
          add(channel_of[i], unquoted(fields[i]), decimal_comma);
        } else if (unused_[i].numbers) {
          double value = 0.0;
          unused_[i].numbers = parse_number(unquoted(fields[i]), decimal_comma, value) == NumberError::none;
          unused_[i].sum += value;
        }
      }
      check_time();
    }
    const std::size_t count = channels_[0].size();
    if (count < fewest_rows) {
      fail(0, std::to_string(count) + (count == 1 ? " row" : " rows") + " of numbers, expected at least " +
                  std::to_string(fewest_rows));
    }
  }

  void split_plain(std::string_view line, std::vector<std::string_view>& fields) const {
    fields.clear();
    const char* begin = line.data();
    const char* const end = begin + line.size();
    for (const char* at = begin; at != end; ++at) {
      if (*at == delimiter_) {
        fields.emplace_back(begin, static_cast<std::size_t>(at - begin));
        begin = at + 1;
      }
    }
    fields.emplace_back(begin, static_cast<std::size_t>(end - begin));
  }

  void check_width(std::vector<std::string_view>& fields) const {
    const std::size_t width = columns_.size();
    if (fields.size() == width + 1 && trimmed(fields.back()).empty()) fields.pop_back();
    const bool short_of_it = fields.size() < width || (fields.size() == width && trimmed(fields.back()).empty());
    if (!ended_ && short_of_it) {
      const auto there = fields.size() - (trimmed(fields.back()).empty() ? 1 : 0);
      fail(line_, "the last row has " + std::to_string(there) + " of " + std::to_string(width) +
                      " fields and no line end, the file is cut off, expected a complete row");
    }
    if (fields.size() != width) {
      fail(line_, std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields") + ", expected " +
                      std::to_string(width) + " as in the header");
    }
  }

  static std::string name_of(int channel) { return std::string(quantity_name(static_cast<Quantity>(channel))); }

  void add(int channel, std::string_view field, bool decimal_comma) {
    double value = 0.0;
    const auto index = static_cast<std::size_t>(channel);
    switch (parse_number(field, decimal_comma, value)) {
      case NumberError::none:
        channels_[index].push_back(sources_[index].unit.to_si(value));
        return;
      case NumberError::empty:
        fail(line_, name_of(channel) + " is empty, expected a finite number");
      case NumberError::not_finite:
        fail(line_, name_of(channel) + " is " + in_quotes(field) + ", expected a finite number");
      case NumberError::out_of_range:
        fail(line_, name_of(channel) + " " + in_quotes(field) + " is too large, expected a finite number");
      case NumberError::not_a_number:
        fail(line_, name_of(channel) + " " + in_quotes(field) + " is not a number, expected a finite number");
    }
  }

  void check_time() const {
    const auto& time = channels_[0];
    const std::size_t n = time.size();
    if (n < 2 || time[n - 1] > time[n - 2]) return;
    fail(line_, "time " + shortest(time[n - 1]) + " s does not increase after " + shortest(time[n - 2]) +
                    " s, expected strictly increasing times");
  }

  static std::string shortest(double value) {
    std::array<char, 32> digits{};
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return {digits.data(), result.ptr};
  }

  // A column that is no channel.
  struct Unused {
    double sum = 0.0;
    bool numbers = false;  // in every row
  };

  std::string_view text_;
  const std::string& file_;
  const ReadOptions& options_;
  std::size_t position_ = 0;
  int line_ = 0;
  int header_line_ = 0;
  char line_end_ = '\n';
  char delimiter_ = ',';
  bool has_quotes_ = false;
  bool ended_ = true;  // the current line has a line end
  std::vector<Column> columns_;
  Sources sources_;
  Channels channels_;
  std::vector<Unused> unused_;
};

}  // namespace

Recording parse_csv(std::string_view text, const std::string& file, const ReadOptions& options) {
  return CsvReader(text, file, options).run();
}

}  // namespace hysteron

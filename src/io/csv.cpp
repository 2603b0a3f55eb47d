#include "io/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/printable.hpp"
#include "io/block_means.hpp"
#include "io/clock_time.hpp"
#include "io/conditions.hpp"
#include "io/decimal_mark.hpp"
#include "io/file.hpp"
#include "io/header_row.hpp"
#include "io/plausible.hpp"
#include "io/rounded_times.hpp"
#include "io/sha256.hpp"
#include "io/text.hpp"
#include "io/time_packets.hpp"

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

// What is to be known of a text before its first line is read.
struct Survey {
  std::uint64_t bytes = 0;
  std::uint64_t newlines = 0;
  std::uint64_t returns = 0;
  bool quotes = false;
  char last = '\0';
  std::optional<std::uint64_t> nul_line;

  void add(std::string_view part) {
    if (!nul_line) {
      const auto nul = part.find('\0');
      if (nul != std::string_view::npos) {
        const auto before = part.substr(0, nul);
        nul_line = 1 + newlines + static_cast<std::uint64_t>(std::ranges::count(before, '\n'));
      }
    }
    bytes += part.size();
    newlines += static_cast<std::uint64_t>(std::ranges::count(part, '\n'));
    returns += static_cast<std::uint64_t>(std::ranges::count(part, '\r'));
    quotes = quotes || part.find('"') != std::string_view::npos;
    if (!part.empty()) last = part.back();
  }
};

// Whether the last number of a text may be cut off: those above it all have as many decimals, and it has fewer.
class LastDecimals {
 public:
  // Takes the next number; whether it is such.
  bool look(std::string_view number) {
    // Fewer might end with a digit other than zero by chance, as those without zeros at their end do.
    constexpr std::size_t fewest = 100;
    const std::size_t digits = number.find_first_not_of("+-");
    const bool plain = digits != std::string_view::npos && digits < 2 &&
                       number.find_first_not_of("0123456789.,", digits) == std::string_view::npos;
    const std::size_t mark = number.find_last_of(".,");
    const std::size_t decimals = mark == std::string_view::npos ? 0 : number.size() - 1 - mark;
    const bool fewer = alike_ && plain && count_ >= fewest && decimals < decimals_;
    alike_ = plain && (count_ == 0 || (alike_ && decimals == decimals_));
    decimals_ = decimals;
    ++count_;
    return fewer;
  }

 private:
  std::size_t count_ = 0;
  std::size_t decimals_ = 0;
  bool alike_ = true;
};

class CsvReader {
 public:
  // Text in memory.
  CsvReader(std::string_view text, const std::string& file, const ReadOptions& options,
            const std::vector<std::string>& units)
      : text_(text), file_(file), options_(options), units_elsewhere_(units.begin(), units.end()) {
    survey_.add(text);
  }
  // Text of which the head is in memory, enough for what comes before the rows, and `rest` is to be read on.
  CsvReader(std::string head, InputFile& rest, const Survey& survey, const std::string& file,
            const ReadOptions& options)
      : buffer_(std::move(head)), text_(buffer_), rest_(&rest), survey_(survey), file_(file), options_(options) {}

  Recording run() {
    check_text();
    read_header();
    read_rows();
    const auto rows = static_cast<double>(rows_read_);
    bool made_time = false;
    if (means_) {
      const double bend = means_->bend();
      channels_ = means_->take();
      made_time = make_time(channels_);
      if (options_.remark) {
        options_.remark(thinning_remark(file_, rows_read_, options_.samples_of_all, stride_, channels_[0], bend));
      }
    }
    made_time = make_time(channels_) || made_time;
    if (means_) {
      for (std::size_t c = 0; c < conditions_.size(); ++c) condition_values_[c] = condition_means_[c].take();
    }
    even_out_rounded_times(channels_, options_, file_);
    even_out_packets(channels_, options_, file_);
    remark_on_settings(sources_, channels_, conditions_, condition_values_, columns_, options_, file_);
    std::vector<ConditionChannel> conditions = make_conditions(conditions_, std::move(condition_values_), channels_);
    Recording recording = make_recording(std::move(channels_));
    recording.conditions = std::move(conditions);
    recording.timed = !made_time;
    recording.started = started_;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (unused_[i].numbers && std::isfinite(unused_[i].sum))
        recording.unused.push_back({columns_[i].text, unused_[i].sum / rows});
    }
    remark_on_sizes(recording, sources_, columns_, options_, file_);
    return recording;
  }

 private:
  [[noreturn]] void fail(int line, const Message& message) const { throw OptionError(file_, line, message); }

  void check_text() {
    if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
      fail(0, "the file is UTF-16 text, expected UTF-8");
    }
    if (text_.size() == position_) fail(0, "the file is empty, expected a header row and at least 8 rows of numbers");
    if (survey_.nul_line) {
      fail(static_cast<int>(*survey_.nul_line), "a NUL byte, the file is not text, expected UTF-8 CSV");
    }
    // Line ends of a lone CR, as some old instruments write.
    if (survey_.newlines == 0 && survey_.returns > 0) line_end_ = '\r';
    has_quotes_ = survey_.quotes;
  }

  // More of the file behind the line that is begun, which moves; false at its end and before the rows.
  bool read_on() {
    constexpr std::size_t at_once = std::size_t{4} << 20U;
    constexpr std::size_t longest_line = std::size_t{64} << 20U;
    if (rest_ == nullptr || !in_rows_) return false;
    buffer_.erase(0, position_);
    position_ = 0;
    if (buffer_.size() > longest_line) fail(line_ + 1, "a line of more than 64 MiB, expected a row of numbers");
    const std::size_t before = buffer_.size();
    rest_->read(buffer_, at_once);
    text_ = buffer_;
    return buffer_.size() > before;
  }

  // The next line that is neither blank nor a comment; false at the end of the text.
  bool next_line(std::string_view& line) {
    while (position_ < text_.size() || read_on()) {
      const void* found = std::memchr(text_.data() + position_, line_end_, text_.size() - position_);
      if (found == nullptr && read_on()) continue;
      ++line_;
      ended_ = found != nullptr;
      const std::size_t end =
          ended_ ? static_cast<std::size_t>(static_cast<const char*>(found) - text_.data()) : text_.size();
      line = text_.substr(position_, end - position_);
      position_ = end + 1;
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      const auto first = line.find_first_not_of(" \t");
      if (first != std::string_view::npos && line[first] != '#') return true;
      if (!in_rows_ && !started_) read_start(line);
    }
    return false;
  }

  void read_start(std::string_view comment) {
    started_ = clock_time_in(comment);
    if (started_ && options_.start_zone) options_.start_zone(has_zone(comment));
    if (const auto said = unread_start_in(comment); said && options_.remark) {
      options_.remark({file_, Remark::Kind::dialect, "start",
                       "the start '" + valid_utf8(std::string(*said)) +
                           "' is not read, expected one as 2026-11-24T14:50:58 or 24-Nov-2026 14:50:58"});
    }
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
        fail(0,
             Option::skip + " " + std::to_string(options_.skip) + " leaves nothing of the file, expected fewer lines");
      }
      position_ = end + 1;
      ++line_;
    }
  }

  // Cells of the next line by a delimiter, without quotes, an empty last one left out; none at the end of the text.
  std::vector<std::string_view> next_cells(char delimiter) {
    std::vector<std::string_view> cells;
    std::string_view line;
    if (!next_line(line)) return cells;
    split(line, delimiter, cells);
    if (cells.size() > 1 && unquoted(cells.back()).empty()) cells.pop_back();
    std::ranges::transform(cells, cells.begin(), unquoted);
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
          cells, [](std::string_view cell) { return quantity_of_name(split_column(cell).name).has_value(); });
    };
    const auto are_units = [](const std::vector<std::string_view>& cells) {
      return std::ranges::all_of(cells, [](std::string_view cell) { return is_any_unit(without_brackets(cell)); });
    };
    const auto begin = position_;
    const auto before = line_;
    std::vector<std::string_view> above;
    for (int k = 0; k < most_lines; ++k) {
      const auto here = position_;
      const auto number = line_;
      std::string_view line;
      if (!next_line(line)) break;
      const char delimiter = delimiter_of(line);
      position_ = here;
      line_ = number;
      const std::vector<std::string_view> names = next_cells(delimiter);
      const auto behind = position_;
      const auto at = line_;
      std::vector<std::string_view> below = next_cells(delimiter);
      // The rows have begun; a title may hold a number, too.
      const bool begun = mostly_numbers(names);
      if (begun && mostly_numbers(below)) break;
      // A row of units below the names, or words where numbers are expected, which is said then. Names of another
      // language are names too where units stand below.
      const bool units = are_units(below);
      if (below.size() == names.size() && !mostly_numbers(below) && (names_a_channel(names) || units) &&
          !names_columns(below)) {
        below = next_cells(delimiter);
      }
      if (!begun && names.size() > 1 && below.size() == names.size() && mostly_numbers(below)) {
        position_ = here;
        line_ = number;
        const bool units_above = above.size() == names.size() && are_units(above);
        if (units_above) units_above_ = above;
        if (k > 0 && options_.remark) {
          const std::string text = "the header is taken from line " + std::to_string(at) +
                                   (units_above ? ", units from the line before it" : ", lines before it are not read");
          options_.remark({file_, Remark::Kind::dialect, "header", text});
        }
        return;
      }
      above = names;
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
    take_units(units_above_);
    take_units(units_elsewhere_);
    sources_ = assign_columns(columns_, options_, file_, header_line_);
    conditions_ = assign_conditions(columns_, sources_, options_, file_, header_line_);
    condition_row_.resize(conditions_.size());
    condition_values_.resize(conditions_.size());
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
    take_units(cells);
    header_line_ = line_;
  }

  // Of the columns, from a row of its own.
  void take_units(const std::vector<std::string_view>& cells) {
    for (std::size_t i = 0; i < std::min(cells.size(), columns_.size()); ++i) {
      Column& column = columns_[i];
      const std::string_view unit = without_brackets(unquoted(cells[i]));
      if (column.unit.empty()) {
        column.unit = unit;
      } else if (!contradict(column.unit, column.other_unit)) {
        column.other_unit = unit;
      }
    }
  }

  void read_rows() {
    std::vector<int> channel_of(columns_.size(), -1);
    in_rows_ = true;
    const std::uint64_t lines = line_end_ == '\n' ? survey_.newlines : survey_.returns;
    const std::size_t rows = lines - std::min<std::uint64_t>(lines, static_cast<std::uint64_t>(line_));
    if (options_.keep_samples > 0 && rows > options_.keep_samples) {
      stride_ = (rows + options_.keep_samples - 1) / options_.keep_samples;
      means_.emplace(sources_, stride_);
      condition_means_.assign(conditions_.size(), ConditionMeans(stride_));
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].column < 0) continue;
      channel_of[static_cast<std::size_t>(sources_[i].column)] = static_cast<int>(i);
      if (!means_) channels_[i].reserve(rows + 1);
    }
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      if (conditions_[c].column < 0) continue;
      channel_of[static_cast<std::size_t>(conditions_[c].column)] = quantity_count + static_cast<int>(c);
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      unused_.push_back({0.0, channel_of[i] < 0 && !columns_[i].text.empty()});
    }
    decimal_comma_ = delimiter_ != ',' || has_quotes_;
    std::vector<std::string_view> fields;
    std::string_view line;
    int separators_alone = 0;  // the line of the first row of these
    const bool open_ended = survey_.last != '\n' && survey_.last != '\r';
    while (next_line(line)) {
      // Below a table a spreadsheet leaves rows of empty cells.
      if (is_separators(line)) {
        if (separators_alone == 0) separators_alone = line_;
        continue;
      }
      if (separators_alone > 0) fail(separators_alone, "an empty row among the numbers, expected a finite number each");
      if (has_quotes_) {
        split(line, delimiter_, fields);
      } else {
        split_plain(line, fields);
      }
      check_width(fields);
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (channel_of[i] >= 0) {
          add(channel_of[i], unquoted(fields[i]));
        } else if (unused_[i].numbers) {
          double value = 0.0;
          const std::string_view field = unquoted(fields[i]);
          unused_[i].numbers =
              parse_number(field, decimal_comma_, value) == NumberError::none && !mark_.is_other(field);
          unused_[i].sum += value;
        }
      }
      check_time();
      if (open_ended) {
        cut_short_ = decimals_.look(unquoted(fields[columns_.size() - 1])) && !ended_;
      }
      take_row();
    }
    const std::size_t count = rows_read_;
    if (count < fewest_rows) {
      fail(0, std::to_string(count) + (count == 1 ? " row" : " rows") + " of numbers, expected at least " +
                  std::to_string(fewest_rows));
    }
    tell_dialect();
    doubt_mark();
    if (cut_short_ && options_.remark) {
      options_.remark({file_, Remark::Kind::dialect, "cut",
                       "line " + std::to_string(line_) +
                           ", the last, has no line end and fewer decimals in its last number than all lines above: a "
                           "file that is cut off within that number looks so; remove the line, or copy the file anew"});
    }
  }

  // What is not plain: lines that are left out, and decimal commas, with what separates the columns then.
  void tell_dialect() const {
    const bool commas = mark_.is_comma() && !mark_.doubt();  // a doubt is told by itself
    if (!options_.remark || (options_.skip <= 0 && !commas)) return;
    Message text("");
    if (options_.skip > 0) {
      text += (options_.skip == 1 ? Message("the first line is")
                                  : "the first " + std::to_string(options_.skip) + " lines are") +
              " not read, as " + Option::skip + " says";
    }
    if (commas) {
      const std::string_view separator = delimiter_ == ';'    ? "semicolons"
                                         : delimiter_ == '\t' ? "tabs"
                                                              : "commas outside of quotes";
      text += std::string(options_.skip > 0 ? "; " : "") +
              "numbers are read with decimal commas, columns as separated by " + std::string(separator);
    }
    options_.remark({file_, Remark::Kind::dialect, "dialect", text});
  }

  // No number has decimals for certain: those with a mark may be thousands.
  void doubt_mark() const {
    const std::optional<DecimalMark::Doubt> doubt = mark_.doubt();
    if (!doubt) return;
    const std::string name = name_of(static_cast<int>(doubt->column));
    if (doubt->likely) {
      fail(doubt->line, name + " " + in_quotes(doubt->text) +
                            " stands among whole numbers below 1000, as one with a mark of thousands does, expected "
                            "decimals in all numbers and no mark between thousands");
    }
    if (!options_.remark) return;
    options_.remark({file_, Remark::Kind::dialect, "thousands",
                     name + " " + in_quotes(doubt->text) + " of line " + std::to_string(doubt->line) +
                         " is read with three decimals, as all numbers with a mark: where that stands between "
                         "thousands, export them without"});
  }

  [[nodiscard]] bool is_separators(std::string_view line) const {
    const char* const end = line.data() + line.size();
    return std::all_of(line.data(), end, [&](char c) { return c == delimiter_ || c == ' ' || c == '\t' || c == '"'; });
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

  [[nodiscard]] std::string name_of(int channel) const {
    return channel < quantity_count ? std::string(quantity_name(static_cast<Quantity>(channel)))
                                    : conditions_[static_cast<std::size_t>(channel - quantity_count)].name;
  }

  void add(int channel, std::string_view field) {
    double value = 0.0;
    const auto index = static_cast<std::size_t>(channel);
    const ConditionSource* condition =
        channel < quantity_count ? nullptr : &conditions_[static_cast<std::size_t>(channel - quantity_count)];
    switch (parse_number(field, decimal_comma_, value)) {
      case NumberError::none:
        // Where commas separate the columns, only points between thousands are to be feared.
        if (decimal_comma_ || !mark_.known(index)) {
          if (const auto wrong = mark_.look(field, index, line_)) fail(line_, name_of(channel) + " " + *wrong);
        }
        value = condition == nullptr ? sources_[index].unit.to_si(value) : condition->unit.conversion.to_si(value);
        if (!(std::abs(value) <= largest_value)) {
          fail(line_, name_of(channel) + " " + in_quotes(field) + " is too large, expected at most 1e30 in SI units");
        }
        (condition == nullptr ? row_[index] : condition_row_[index - quantity_count]) = value;
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
    if (sources_[0].column < 0 || rows_read_ == 0 || row_[0] - time_before_ > shortest_step) return;
    fail(line_, "time " + shortest(row_[0]) + " s does not increase after " + shortest(time_before_) +
                    " s, expected strictly increasing times");
  }

  void take_row() {
    ++rows_read_;
    time_before_ = row_[0];
    if (means_) {
      means_->add(row_);
      for (std::size_t c = 0; c < conditions_.size(); ++c) condition_means_[c].add(condition_row_[c]);
      return;
    }
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (sources_[i].column >= 0) channels_[i].push_back(row_[i]);
    }
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      if (conditions_[c].column >= 0) condition_values_[c].push_back(condition_row_[c]);
    }
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

  std::string buffer_;  // of a file
  std::string_view text_;
  InputFile* rest_ = nullptr;  // of a file, behind the buffer
  Survey survey_;
  const std::string& file_;
  const ReadOptions& options_;
  std::size_t position_ = 0;
  int line_ = 0;
  int header_line_ = 0;
  char line_end_ = '\n';
  char delimiter_ = ',';
  bool has_quotes_ = false;
  bool decimal_comma_ = false;  // a comma may stand in a number
  DecimalMark mark_;
  bool ended_ = true;  // the current line has a line end
  LastDecimals decimals_;
  bool cut_short_ = false;  // the last line, within its last number
  std::vector<Column> columns_;
  std::vector<std::string_view> units_above_;
  std::vector<std::string_view> units_elsewhere_;
  Sources sources_;
  bool in_rows_ = false;
  Channels channels_;
  Row row_{};
  std::size_t rows_read_ = 0;
  double time_before_ = 0.0;
  std::size_t stride_ = 1;  // samples averaged to one
  std::optional<BlockMeans> means_;
  std::optional<double> started_;  // by a comment before the rows
  std::vector<Unused> unused_;
  std::vector<ConditionSource> conditions_;
  std::vector<double> condition_row_;
  std::vector<std::vector<double>> condition_values_;  // of those with a column
  std::vector<ConditionMeans> condition_means_;
};

}  // namespace

Recording parse_csv(std::string_view text, const std::string& file, const ReadOptions& options) {
  return parse_csv(text, file, options, {});
}

Recording parse_csv(std::string_view text, const std::string& file, const ReadOptions& options,
                    const std::vector<std::string>& units) {
  return CsvReader(text, file, options, units).run();
}

Recording read_csv(const std::filesystem::path& path, const ReadOptions& options) {
  constexpr std::size_t head_bytes = std::size_t{16} << 20U;
  const std::string name = path.string();
  InputFile input(path);
  Survey survey;
  Sha256 sum;
  const auto take = [&](std::string_view part) {
    survey.add(part);
    sum.add(part);
  };
  std::string head;
  input.read(head, head_bytes);
  take(head);
  if (head.size() == head_bytes) {
    for (std::string part; !survey.nul_line && (input.read(part, head_bytes), !part.empty()); part.clear()) take(part);
    input.seek(head.size());
  }
  const std::string sha256 = sum.hex();
  Recording recording = CsvReader(std::move(head), input, survey, name, options).run();
  input.check_unchanged();
  recording.sha256 = sha256;
  return recording;
}

std::size_t count_rows(const std::filesystem::path& path) {
  InputFile input(path);
  Survey survey;
  constexpr std::size_t at_once = std::size_t{1} << 20U;
  for (std::string part; input.read(part, at_once), !part.empty(); part.clear()) survey.add(part);
  const std::uint64_t lines = survey.newlines == 0 ? survey.returns : survey.newlines;
  return lines > 0 ? lines - 1 : 0;
}

}  // namespace hysteron

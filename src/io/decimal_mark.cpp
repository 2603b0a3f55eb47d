#include "io/decimal_mark.hpp"

#include <algorithm>

#include "io/text.hpp"

namespace hysteron {
namespace {

constexpr std::size_t in_a_group = 3;  // digits between two marks of thousands

std::size_t digits_at(std::string_view text) {
  const auto end = std::ranges::find_if(text, [](char c) { return c < '0' || c > '9'; });
  return static_cast<std::size_t>(end - text.begin());
}

std::string_view without_sign(std::string_view number) {
  if (!number.empty() && (number.front() == '-' || number.front() == '+')) number.remove_prefix(1);
  return number;
}

// "1.010", "-12,500": one to three digits without a zero before them, and three behind the mark.
bool may_be_thousands(std::string_view number) {
  const std::string_view digits = without_sign(number);
  const std::size_t before = digits_at(digits);
  if (before == 0 || before > in_a_group || digits.front() == '0') return false;
  const std::string_view behind = digits.substr(before + 1);
  return behind.size() == in_a_group && digits_at(behind) == in_a_group;
}

std::string_view word_of(char mark) { return mark == ',' ? "comma" : "point"; }

}  // namespace

std::optional<std::string> DecimalMark::look(std::string_view number, std::size_t column, int line) {
  const std::size_t at = number.find_first_of(",.");
  if (columns_.size() <= column) columns_.resize(column + 1);
  Seen& seen = columns_[column];
  if (at == std::string_view::npos) {
    const std::string_view digits = without_sign(number);
    const bool below = digits.size() <= in_a_group && digits_at(digits) == digits.size();
    (below ? seen.below : seen.above) = true;
    seen.hundreds = seen.hundreds || (below && digits.size() == in_a_group);
    return std::nullopt;
  }
  const char mark = number[at];
  if (mark_ == '\0') {
    mark_ = mark;
    first_ = number;
    line_ = line;
  }
  if (mark != mark_) {
    return in_quotes(number) + " has a " + std::string(word_of(mark)) + " and " + in_quotes(first_) + " of line " +
           std::to_string(line_) + " a " + std::string(word_of(mark_)) +
           ", expected one decimal mark in all numbers and none between thousands";
  }
  if (!may_be_thousands(number)) {
    known_ = true;
    seen.decimals = true;
    return std::nullopt;
  }
  if (seen.marked.empty()) {
    seen.marked = number;
    seen.line = line;
  }
  return std::nullopt;
}

bool DecimalMark::is_other(std::string_view number) const {
  return mark_ != '\0' && number.find(mark_ == ',' ? '.' : ',') != std::string_view::npos;
}

std::optional<DecimalMark::Doubt> DecimalMark::doubt() const {
  if (known_) {
    const auto thousands = std::ranges::find_if(columns_, [](const Seen& seen) {
      return seen.hundreds && !seen.marked.empty() && !seen.above && !seen.decimals;
    });
    if (thousands == columns_.end()) return std::nullopt;
    return Doubt{static_cast<std::size_t>(thousands - columns_.begin()), thousands->line, thousands->marked, true};
  }
  std::optional<Doubt> result;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Seen& seen = columns_[k];
    if (seen.marked.empty()) continue;
    if (seen.above) return std::nullopt;  // a thousand is written without a mark
    if (!result || (seen.below && !result->likely)) result = Doubt{k, seen.line, seen.marked, seen.below};
  }
  return result;
}

}  // namespace hysteron

// The mark before the decimals of the numbers of a text: a point or a comma, the same one in all of them. Where both
// occur, one of them stands between thousands, and read as a decimal mark it makes 1.01 N of 1,010 N.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

class DecimalMark {
 public:
  // A number of a column as it is written; what is wrong with it, or nothing.
  [[nodiscard]] std::optional<std::string> look(std::string_view number, std::size_t column, int line);
  // Whether nothing is left to be learned of a column: it has decimals for certain, and only the other mark is wrong.
  [[nodiscard]] bool known(std::size_t column) const { return column < columns_.size() && columns_[column].decimals; }
  // Whether a number was seen with a comma.
  [[nodiscard]] bool is_comma() const { return mark_ == ','; }
  // Whether the number has the other mark than those before.
  [[nodiscard]] bool is_other(std::string_view number) const;

  // A number whose mark may stand between thousands.
  struct Doubt {
    std::size_t column = 0;
    int line = 0;
    std::string text;
    bool likely = false;  // its column holds whole numbers below 1000 and none above
  };
  // After the last number: the gravest doubt, where no number had decimals for certain; else that of a column whose
  // whole numbers have up to three digits, and whose numbers with a mark all three behind it.
  [[nodiscard]] std::optional<Doubt> doubt() const;

 private:
  struct Seen {
    bool below = false;     // whole numbers without a mark, below 1000
    bool hundreds = false;  // of these, such of three digits
    bool above = false;     // others without a mark
    bool decimals = false;  // for certain
    std::string marked;     // the first number with a mark, where that may stand between thousands
    int line = 0;
  };

  char mark_ = '\0';
  bool known_ = false;
  std::string first_;  // the first number with a mark, and its line
  int line_ = 0;
  std::vector<Seen> columns_;
};

}  // namespace hysteron

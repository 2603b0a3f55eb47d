// Recordings as CSV. Every number of a recording that is taken is finite and stands in the text, in one unit a channel;
// written as plain CSV it is the same recording.
#include "io/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "io/text.hpp"
#include "target.hpp"

namespace {

using namespace hysteron;

constexpr std::string_view around_numbers = ",;\t\r\n\" ";
// With a decimal comma it is no end of a number.
constexpr std::string_view around_comma_numbers = ";\t\r\n\"";

void pieces_of(std::string_view text, std::string_view ends, const auto& take) {
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(ends, at), text.size());
    take(trimmed(text.substr(at, end - at)));
    at = end + 1;
  }
}

void add_number(std::string piece, std::set<double>& numbers) {
  if (const auto comma = piece.find(','); comma != std::string::npos) piece[comma] = '.';
  double value = 0.0;
  const char* begin = piece.data() + (piece.starts_with('+') ? 1 : 0);
  const auto read = std::from_chars(begin, piece.data() + piece.size(), value);
  if (read.ec == std::errc::invalid_argument) return;
  numbers.insert(read.ec == std::errc::result_out_of_range ? 0.0 : value);
}

// Whether all values are numbers of the text in one of the units.
bool in_text(std::span<const double> values, const std::set<double>& numbers,
             const std::vector<UnitConversion>& units) {
  return std::ranges::any_of(units, [&](const UnitConversion& unit) {
    std::set<double> converted;
    for (const double number : numbers) converted.insert(unit.to_si(number));
    return std::ranges::all_of(values, [&](double value) { return converted.contains(value); });
  });
}

void check_numbers(std::string_view text, const Recording& recording) {
  std::set<double> numbers;
  pieces_of(text, around_numbers, [&](std::string_view piece) { add_number(std::string(piece), numbers); });
  pieces_of(text, around_comma_numbers, [&](std::string_view piece) { add_number(std::string(piece), numbers); });
  const auto check = [&](Quantity quantity, std::span<const double> values) {
    std::vector<UnitConversion> units(1);
    // Units stand between these in a header; a unit row is made of cells.
    for (const std::string_view ends : {std::string_view("[](),;\t\r\n\""), std::string_view(",;\t\r\n\"")}) {
      pieces_of(text, ends, [&](std::string_view piece) {
        if (const auto unit = find_unit(quantity, piece)) units.push_back(*unit);
      });
    }
    fuzz::require(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }), "numbers are finite");
    fuzz::require(in_text(values, numbers, units), "numbers stand in the text");
  };
  check(Quantity::time, recording.time);
  check(Quantity::displacement, recording.displacement);
  check(Quantity::force, recording.force);
  if (recording.velocity_measured) check(Quantity::velocity, recording.velocity);
  check(Quantity::acceleration, recording.acceleration);
  check(Quantity::temperature, recording.temperature);
  check(recording.drive_kind == DriveKind::voltage ? Quantity::voltage : Quantity::current, recording.drive);
}

void check_written(const Recording& recording) {
  std::string text = "time [s],displacement [m],force [N]\n";
  const auto add = [&](double value, char end) {
    std::array<char, 32> digits{};
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    text += end;
  };
  for (std::size_t n = 0; n < recording.size(); ++n) {
    add(recording.time[n], ',');
    add(recording.displacement[n], ',');
    add(recording.force[n], '\n');
  }
  const Recording again = parse_csv(text, "again.csv");
  fuzz::require(
      again.time == recording.time && again.displacement == recording.displacement && again.force == recording.force,
      "written and read again it is the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  ReadOptions options;
  options.remark = [](const Remark& remark) { fuzz::require(!remark.text.empty(), "a remark says something"); };
  Recording recording;
  if (fuzz::taken([&] { recording = parse_csv(text, "input.csv", options); })) {
    check_numbers(text, recording);
    check_written(recording);
  }
  ReadOptions of_excitation;
  of_excitation.force_required = of_excitation.displacement_required = false;
  of_excitation.skip = 1;
  of_excitation.columns = {{"force", "2 [kN]"}};
  fuzz::taken([&] { static_cast<void>(parse_csv(text, "input.csv", of_excitation)); });
  return 0;
}

#include "app/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::app {
namespace {

// "100000", "1e5", "+7", "2.5e3": the digits with the point moved, exactly.
std::optional<std::uint64_t> whole_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto e = text.find_first_of("eE");
  std::string digits(text.substr(0, e));
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    const auto read = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (power.empty() || read.ec != std::errc{} || read.ptr != power.data() + power.size()) return std::nullopt;
    if (exponent < 0 || exponent > 20) return std::nullopt;
  }
  if (const auto point = digits.find('.'); point != std::string::npos) {
    exponent -= static_cast<int>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  for (; exponent < 0 && digits.ends_with('0'); ++exponent) digits.pop_back();
  if (exponent < 0 || digits.empty()) return std::nullopt;
  digits.append(static_cast<std::size_t>(exponent), '0');
  std::uint64_t value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size()) return std::nullopt;
  return value;
}

// "1200", "+1.2e3", "-.5": finite and decimal, neither 0x10 nor inf or nan.
std::optional<double> decimal_of(std::string_view text) {
  if (text.starts_with("+-")) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

CLI::Validator whole_number(std::uint64_t low, std::uint64_t high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return {[=](std::string& text) {
            const auto value = whole_of(text);
            if (!value || *value < low || *value > high) {
              return fmt::format("'{}' is not a whole number from {}", text, range);
            }
            text = std::to_string(*value);
            return std::string{};
          },
          range};
}

CLI::Validator seed_number() { return whole_number(0, std::numeric_limits<std::uint64_t>::max()).description(""); }

CLI::Validator real_number(double low, double high) {
  const std::string range = fmt::format("{:g} to {:g}", low, high);
  return {[=](std::string& text) {
            const auto value = decimal_of(text);
            const bool good = value && *value >= low && *value <= high;
            return good ? std::string{} : fmt::format("'{}' is not a number from {}", text, range);
          },
          range};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string list;
  std::string expected;
  for (const std::string& word : words) {
    list += (list.empty() ? "" : ",") + word;
    expected += (expected.empty() ? "" : &word == &words.back() ? " or " : ", ") + word;
  }
  return {[=](std::string& text) {
            if (std::ranges::find(words, text) != words.end()) return std::string{};
            return fmt::format("'{}' is not known{}, expected {}", text, suggestion(text, words), expected);
          },
          "{" + list + "}"};
}

double parse_number(const std::string& option, const std::string& text) {
  const auto value = decimal_of(text);
  if (!value) throw InputError(option + ": '" + text + "' is not a number, expected a decimal one, e.g. 1200 or 1.2e3");
  return *value;
}

std::pair<std::string, std::string> split_pair(const std::string& option, const std::string& text,
                                               const std::string& expected) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(option + ": '" + text + "' is wrong, expected " + expected);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::pair<double, double> parse_range(const std::string& option, const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) throw InputError(option + ": '" + text + "' is wrong, expected LOWER:UPPER");
  const double lower = parse_number(option, text.substr(0, colon));
  const double upper = parse_number(option, text.substr(colon + 1));
  if (!(lower < upper)) throw InputError(option + ": '" + text + "' is empty, expected LOWER below UPPER");
  return {lower, upper};
}

std::map<std::string, double> settings_of(const std::vector<std::string>& words) {
  std::map<std::string, double> result;
  for (const std::string& word : words) {
    const auto [name, value] = split_pair("--set", word, "SETTING=NUMBER, see `hysteron describe SOLVER`");
    if (!result.emplace(name, parse_number("--set", value)).second) {
      throw InputError("--set: '" + name + "' is given twice, expected each setting once");
    }
  }
  return result;
}

}  // namespace hysteron::app

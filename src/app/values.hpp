// Values of options: what a word of the command line must be.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "task/words.hpp"

namespace hysteron::app {

// A whole number from `low` to `high`, also written 1e5; anything else, and what no integer of the program holds, is
// refused rather than rounded or clamped.
[[nodiscard]] CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
// Of 64 bits, 0 included.
[[nodiscard]] CLI::Validator seed_number();

// A finite number from `low` to `high`.
[[nodiscard]] CLI::Validator real_number(double low, double high);

// One of these words, named by --help and completion; the nearest is offered for another.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

// "NAME=VALUE" -> its two halves, the name not empty; `expected` ends the message.
std::pair<std::string, std::string> split_pair(const std::string& option, const std::string& text,
                                               const std::string& expected);
// A finite number; "LOWER:UPPER" with the first below the second. InputError that names the option.
double parse_number(const std::string& option, const std::string& text);
std::pair<double, double> parse_range(const std::string& option, const std::string& text);

// Of --set, SETTING=NUMBER each; InputError for a wrong word and a setting that is given twice.
std::map<std::string, double> settings_of(const std::vector<std::string>& words);

}  // namespace hysteron::app

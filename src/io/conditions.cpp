#include "io/conditions.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/drive.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

bool may_be_followed(Quantity quantity) {
  return quantity == Quantity::current || quantity == Quantity::voltage || quantity == Quantity::temperature;
}

[[noreturn]] void fail_both(const ConditionNumber& number, const std::string& name, const std::string& file) {
  throw InputError(number.file, number.line,
                   in_quotes(name) + " is given for " + in_quotes(file) + ", which has a column of it, expected one");
}

// The columns named so: by a mapping, else by their names without case and unit.
int column_of(const std::string& name, const std::vector<Column>& columns, const ReadOptions& options,
              std::string& unit, const std::string& file, int line) {
  const auto mapped = std::ranges::find_if(options.columns,
                                           [&](const auto& entry) { return lower_case(trimmed(entry.first)) == name; });
  const Column wanted = split_column(mapped == options.columns.end() ? name : mapped->second);
  const std::string text = lower_case(wanted.text);
  std::vector<int> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& column = columns[i];
    if (lower_case(column.text) == text || lower_case(column.name) == lower_case(wanted.name) ||
        (!column.alias.empty() && column.alias == wanted.name)) {
      found.push_back(static_cast<int>(i));
    }
  }
  if (found.size() > 1) {
    throw OptionError(file, line,
                      std::to_string(found.size()) + " columns are named " + in_quotes(wanted.name) +
                          ", expected one, or " + Option::column + " " + name + "=NAME to choose");
  }
  if (found.empty()) {
    if (mapped != options.columns.end()) {
      throw InputError(file, line, "no column " + in_quotes(wanted.name) + " for " + name + ", expected one");
    }
    return -1;
  }
  const Column& column = columns[static_cast<std::size_t>(found.front())];
  if (wanted.unit.empty()) refuse_two_units(column, name, file, line);
  unit = wanted.unit.empty() ? column.unit : wanted.unit;
  return found.front();
}

// A condition whose column a channel or a condition before it has.
void refuse_shared(const ConditionSource& source, const std::vector<ConditionSource>& before,
                   const std::vector<Column>& columns, const Sources& sources, const std::string& file, int line) {
  std::string other;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].column == source.column) other = quantity_name(static_cast<Quantity>(i));
  }
  for (const ConditionSource& one : before) {
    if (one.column == source.column) other = in_quotes(one.name);
  }
  if (other.empty()) return;
  throw InputError(file, line,
                   "column " + in_quotes(columns[static_cast<std::size_t>(source.column)].text) + " is both " + other +
                       " and " + in_quotes(source.name) + ", expected a column for each");
}

}  // namespace

std::string_view unit_of_plain(std::string_view name) {
  if (name == "pressure") return "Pa";
  if (name == clock_condition) return "s";
  if (name == quantity_name(Quantity::temperature)) return "degC";
  if (name == quantity_name(Quantity::current)) return "A";
  if (name == quantity_name(Quantity::voltage)) return "V";
  return {};
}

std::string condition_name(std::string_view text, const std::string& where) {
  const std::string name = lower_case(trimmed(text));
  if (name.empty()) throw InputError(where + ": empty, expected the name of a column, e.g. pressure");
  if (const auto quantity = quantity_of_name(name); quantity && !may_be_followed(*quantity)) {
    throw InputError(where + ": " + in_quotes(name) + " is the " + std::string(quantity_name(*quantity)) +
                     " of the recording, expected a column beside motion and force, e.g. pressure");
  } else if (quantity) {
    return std::string(quantity_name(*quantity));
  }
  return name;
}

ConditionUnit condition_unit(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return {};
  if (const auto pressure = find_pressure(text)) return {*pressure, "Pa"};
  constexpr std::array<std::pair<Quantity, std::string_view>, 8> known = {{
      {Quantity::temperature, "degC"},
      {Quantity::force, "N"},
      {Quantity::displacement, "m"},
      {Quantity::velocity, "m/s"},
      {Quantity::acceleration, "m/s^2"},
      {Quantity::current, "A"},
      {Quantity::voltage, "V"},
      {Quantity::time, "s"},
  }};
  for (const auto& [quantity, inside] : known) {
    if (const auto unit = find_unit(quantity, text)) return {*unit, std::string(inside)};
  }
  return {{}, std::string(text)};
}

std::optional<ConditionNumber> condition_number(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  const ConditionUnit unit = condition_unit(text.substr(static_cast<std::size_t>(read.ptr - text.data())));
  const double inside = unit.conversion.to_si(value);
  if (!(std::abs(inside) <= largest_value)) return std::nullopt;
  return ConditionNumber{inside, unit.inside, {}, 0};
}

std::vector<ConditionSource> assign_conditions(const std::vector<Column>& columns, const Sources& sources,
                                               const ReadOptions& options, const std::string& file, int line) {
  const auto has = [&](Quantity quantity) { return sources[static_cast<std::size_t>(quantity)].column >= 0; };
  std::vector<ConditionSource> result;
  for (const std::string& name : options.conditions) {
    ConditionSource source;
    source.name = name;
    const auto quantity = quantity_of_name(name);
    if (quantity == Quantity::voltage && has(Quantity::voltage) && !has(Quantity::current)) {
      throw OptionError(
          file, line, "the voltage is the drive of the recording, expected " + Option::by_current + " for laws in it");
    }
    if (quantity && has(*quantity)) {
      source.channel = quantity;
      source.unit.inside = *quantity == Quantity::voltage ? "V" : "degC";
    } else if (!quantity) {
      std::string unit;
      source.column = column_of(name, columns, options, unit, file, line);
      source.unit = condition_unit(unit);
    }
    const bool recorded = source.channel || source.column >= 0;
    if (source.column >= 0) refuse_shared(source, result, columns, sources, file, line);
    if (const auto number = options.numbers.find(name); number != options.numbers.end()) {
      if (recorded) fail_both(number->second, name, file);
      source.number = number->second;
      if (source.number->unit.empty()) source.number->unit = unit_of_plain(name);
    } else if (!recorded && name == clock_condition) {
      continue;
    } else if (!recorded) {
      std::string list;
      std::vector<std::string> names;
      std::string likely = "NAME";  // a column of which the name is a part, as "oil temperature" of a temperature
      for (const Column& column : columns) {
        list += (list.empty() ? "" : ", ") + in_quotes(column.text);
        if (lower_case(column.name).find(name) != std::string::npos) likely = in_quotes(column.name);
        names.push_back(column.name);
      }
      throw OptionError(file, line,
                        "no column " + in_quotes(name) + suggestion(name, names) +
                            ", which parameters follow; expected one, " + Option::column + " " + name + "=" + likely +
                            ", or a number for it in campaign.toml (for a model already fitted also by " + Option::at +
                            "); the columns are " + list);
    }
    result.push_back(std::move(source));
  }
  return result;
}

void ConditionMeans::add(double value) {
  if (held_ == 0) {
    first_ = value;
    sum_ = 0.0;
  }
  sum_ += value - first_;
  if (++held_ == k_) {
    means_.push_back(first_ + sum_ / static_cast<double>(k_));
    held_ = 0;
  }
}

void thin_conditions(std::vector<std::vector<double>>& values, std::size_t samples, const ReadOptions& options) {
  if (options.keep_samples == 0 || samples <= options.keep_samples) return;
  for (std::vector<double>& of_one : values) {
    if (of_one.size() != samples) continue;  // one number
    ConditionMeans means((samples + options.keep_samples - 1) / options.keep_samples);
    for (const double value : of_one) means.add(value);
    of_one = means.take();
  }
}

std::vector<ConditionChannel> make_conditions(const std::vector<ConditionSource>& sources,
                                              std::vector<std::vector<double>>&& columns, const Channels& channels) {
  std::vector<ConditionChannel> result;
  for (std::size_t c = 0; c < sources.size(); ++c) {
    const ConditionSource& source = sources[c];
    if (source.number) {
      result.push_back({source.name, source.number->unit, {source.number->value}});
    } else {
      const std::vector<double>& values =
          source.channel ? channels[static_cast<std::size_t>(*source.channel)] : columns[c];
      result.push_back({source.name, source.unit.inside, quiet_condition(values)});
    }
  }
  return result;
}

void take_numbers(Recording& recording, const ReadOptions& options) {
  for (const auto& given : options.numbers) {
    // References: clang 14 does not capture structured bindings.
    const auto& name = given.first;
    const auto& number = given.second;
    if (std::ranges::find(options.conditions, name) != options.conditions.end()) continue;
    const auto refuse_unit = [&](std::string_view unit) {
      if (!number.unit.empty() && number.unit != unit) {
        throw InputError(number.file, number.line,
                         "the " + name + " is in " + in_quotes(number.unit) + ", expected " + std::string(unit));
      }
    };
    const std::vector<double> along(recording.size(), number.value);
    if (name == "current" || name == "voltage") {
      refuse_unit(name == "current" ? "A" : "V");
      if (recording.drive_kind != DriveKind::none) fail_both(number, name, recording.file);
      recording.drive = along;
      recording.drive_kind = name == "current" ? DriveKind::current : DriveKind::voltage;
    } else if (name == "temperature") {
      refuse_unit("degC");
      if (!recording.temperature.empty()) fail_both(number, name, recording.file);
      recording.temperature = along;
    } else {
      if (std::ranges::any_of(recording.unused, [&](const UnusedColumn& column) {
            return lower_case(split_column(column.name).name) == name;
          })) {
        fail_both(number, name, recording.file);
      }
      recording.unused.push_back({number.unit.empty() ? name : name + " [" + number.unit + "]", number.value});
    }
  }
}

void agree_on_units(const std::vector<Recording>& recordings) {
  if (recordings.empty()) return;
  for (std::size_t c = 0; c < recordings.front().conditions.size(); ++c) {
    std::string unit;
    std::string first;
    for (const Recording& recording : recordings) {
      const ConditionChannel& condition = recording.conditions[c];
      if (first.empty()) {
        unit = condition.unit;
        first = recording.file;
      }
      if (condition.unit == unit) continue;
      const auto in = [](const std::string& one) { return one.empty() ? "has no unit" : "is in " + in_quotes(one); };
      throw InputError(recording.file, 0,
                       in_quotes(condition.name) + " " + in(condition.unit) + ", and " + in(unit) + " in " +
                           in_quotes(first) + ", expected " +
                           (condition.unit.empty() || unit.empty() ? "its unit in all recordings or in none"
                                                                   : "one unit that can be converted"));
    }
  }
}

}  // namespace hysteron

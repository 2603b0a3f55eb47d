#include "io/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/message.hpp"
#include "io/block_means.hpp"
#include "io/clock_time.hpp"
#include "io/conditions.hpp"
#include "io/plausible.hpp"
#include "io/resample.hpp"
#include "io/rounded_times.hpp"
#include "io/text.hpp"
#include "io/time_packets.hpp"

namespace hysteron {
namespace {

constexpr auto time_at = static_cast<std::size_t>(Quantity::time);

bool is_motion(Quantity quantity) {
  return quantity == Quantity::displacement || quantity == Quantity::velocity || quantity == Quantity::acceleration ||
         quantity == Quantity::force;
}

std::string frequency_of(const std::vector<double>& time) {
  return fmt::format("{:.4g} Hz", static_cast<double>(time.size() - 1) / (time.back() - time.front()));
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    text += (k == 0 ? std::string() : k + 1 < words.size() ? ", " : " " + std::string(last) + " ") + words[k];
  }
  return text;
}

class RecordingMaker {
 public:
  RecordingMaker(std::vector<MeasuredChannel> channels, const std::string& file, const ReadOptions& options)
      : channels_(std::move(channels)), file_(file), options_(options) {}

  Recording run() {
    choose_group();
    if (channels_.empty()) fail("no channels of numbers, expected time, displacement and force");
    if (!time_is_mapped()) find_time_channels();
    list_columns();
    if (options_.group.empty()) refuse_two_groups();
    assign();
    read_base();
    for (std::size_t i = 1; i < sources_.size(); ++i) {
      if (sources_[i].column >= 0) place(static_cast<Quantity>(i));
    }
    place_conditions();
    cut();
    check();
    if (options_.remark) remark_on_times();
    const std::vector<UnusedColumn> others = unused();
    std::optional<double> started;
    if (epoch_) started = clock_time(*epoch_ + values_[time_at].front());
    const std::size_t samples = values_[time_at].size();
    even_out_rounded_times(values_, options_, file_);
    even_out_packets(values_, options_, file_);
    thin(values_, sources_, options_, file_);
    thin_conditions(condition_values_, samples, options_);
    remark_on_settings(sources_, values_, conditions_, condition_values_, columns_, options_, file_);
    std::vector<ConditionChannel> conditions = make_conditions(conditions_, std::move(condition_values_), values_);
    Recording recording = make_recording(std::move(values_));
    recording.conditions = std::move(conditions);
    recording.started = started;
    recording.unused.insert(recording.unused.end(), others.begin(), others.end());
    remark_on_sizes(recording, sources_, columns_, options_, file_);
    return recording;
  }

 private:
  [[noreturn]] void fail(const Message& message) const { throw OptionError(file_, 0, message); }

  void choose_group() {
    if (options_.group.empty()) return;
    const std::string wanted = lower_case(options_.group);
    const auto is_wanted = [&](const MeasuredChannel& channel) { return lower_case(channel.group) == wanted; };
    if (std::ranges::none_of(channels_, is_wanted)) {
      fail("no group " + in_quotes(options_.group) + " for " + Option::group + ", expected " + list_of_groups());
    }
    for (MeasuredChannel& channel : channels_) {
      if (!is_wanted(channel)) channel.values = nullptr;
    }
  }

  [[nodiscard]] bool chosen(const MeasuredChannel& channel) const { return channel.values != nullptr; }

  [[nodiscard]] std::vector<std::string> groups() const {
    std::vector<std::string> names;
    std::set<std::string> seen;
    for (const MeasuredChannel& channel : channels_) {
      if (seen.insert(channel.group).second) names.push_back(channel.group);
    }
    return names;
  }

  [[nodiscard]] std::string list_of_groups() const {
    std::vector<std::string> names;
    for (const std::string& name : groups()) names.push_back(in_quotes(name));
    constexpr std::size_t most = 20;
    if (names.size() > most) {
      names[most - 1] = std::to_string(names.size() - most + 1) + " more";
      names.resize(most);
    }
    return joined(names, "or");
  }

  [[nodiscard]] bool time_is_mapped() const {
    return std::ranges::any_of(options_.columns,
                               [](const auto& entry) { return quantity_of_name(entry.first) == Quantity::time; });
  }

  // Channels that are named time give their times to the others of their group; where none is, the one whose last word
  // is such a name does, to those that have no clock.
  void find_time_channels() {
    using Key = std::pair<std::string, std::size_t>;  // group, number of values
    std::map<Key, std::size_t> named;
    std::map<Key, std::size_t> by_last_word;
    std::set<Key> undecided;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const MeasuredChannel& channel = channels_[i];
      if (!chosen(channel) || channel.times) continue;
      const Key key(channel.group, channel.count);
      const Column column = column_of(channel);
      if (quantity_of_column(column) == Quantity::time) {
        const auto [at, added] = named.emplace(key, i);
        if (!added) {
          fail("two channels for time (" + in_quotes(channels_[at->second].name) + " and " + in_quotes(channel.name) +
               "), expected one, or " + Option::column + " time=NAME to choose");
        }
      } else if (quantity_of_last_word(column.name) == Quantity::time && !by_last_word.emplace(key, i).second) {
        undecided.insert(key);
      }
    }
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      MeasuredChannel& channel = channels_[i];
      if (channel.times) continue;
      const Key key(channel.group, channel.count);
      if (const auto found = named.find(key); found != named.end()) {
        if (found->second != i) channel.times = found->second;
      } else if (const auto last = by_last_word.find(key);
                 last != by_last_word.end() && last->second != i && !has_step(channel) && !undecided.contains(key)) {
        channel.times = last->second;
      }
    }
  }

  static bool has_step(const MeasuredChannel& channel) {
    return channel.clock && channel.clock->step > 0.0 && std::isfinite(channel.clock->step);
  }

  // All but those that hold times.
  void list_columns() {
    std::set<std::size_t> holds_times;
    if (!time_is_mapped()) {
      for (const MeasuredChannel& channel : channels_) {
        if (channel.times) holds_times.insert(*channel.times);
      }
    }
    std::set<std::string> of_columns;
    for (const MeasuredChannel& channel : channels_) {
      if (chosen(channel)) of_columns.insert(channel.group);
    }
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (!chosen(channels_[i]) || holds_times.contains(i)) continue;
      Column column = column_of(channels_[i]);
      if (!time_is_mapped() && quantity_of_column(column) == Quantity::time) continue;
      column.alias = channels_[i].group + "/" + column.name;
      if (of_columns.size() > 1 && !channels_[i].group.empty()) column.text = channels_[i].group + "/" + column.text;
      columns_.push_back(std::move(column));
      channel_of_.push_back(i);
    }
  }

  static Column column_of(const MeasuredChannel& channel) {
    Column column = split_column(channel.name);
    const std::string unit(without_blanks(channel.unit));
    if (!unit.empty() && column.unit.empty()) {
      column.text += (column.text.empty() ? "[" : " [") + unit + "]";
    }
    if (!unit.empty()) column.other_unit = std::exchange(column.unit, unit);
    if (!contradict(column.unit, column.other_unit)) column.other_unit = without_blanks(channel.other_unit);
    return column;
  }

  // The same channel in two groups is two recordings, or two of one thing: the user knows.
  void refuse_two_groups() const {
    for (int q = 1; q < quantity_count; ++q) {
      const auto quantity = static_cast<Quantity>(q);
      if (std::ranges::any_of(options_.columns,
                              [&](const auto& entry) { return quantity_of_name(entry.first) == quantity; })) {
        continue;
      }
      std::vector<std::string> having;
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        const std::string& group = channels_[channel_of_[k]].group;
        if (quantity_of_column(columns_[k]) == quantity && (having.empty() || having.back() != in_quotes(group))) {
          having.push_back(in_quotes(group));
        }
      }
      if (having.size() < 2) continue;
      const std::string name(quantity_name(quantity));
      constexpr std::size_t most = 20;
      const std::size_t more = having.size() > most ? having.size() - most : 0;
      if (more > 0) having.resize(most);
      if (more > 0) having.push_back(std::to_string(more) + " more");
      fail("groups " + joined(having, "and") + " hold a " + name + " each, expected one, or " + Option::group +
           " NAME to choose a group, or " + Option::column + " " + name + "=GROUP/NAME");
    }
  }

  void assign() {
    ReadOptions of_columns = options_;
    of_columns.time_required = false;
    sources_ = assign_columns(columns_, of_columns, file_, 0);
    conditions_ = assign_conditions(columns_, sources_, options_, file_, 0);
    condition_values_.resize(conditions_.size());
    if (sources_[time_at].column < 0) return;
    times_are_a_column_ = true;
    // The times of all channels of its group with as many values.
    const std::size_t times = channel_of_[static_cast<std::size_t>(sources_[time_at].column)];
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      if (i != times && channels_[i].group == channels_[times].group && channels_[i].count == channels_[times].count) {
        channels_[i].times = times;
      }
    }
  }

  [[nodiscard]] const MeasuredChannel& channel_at(Quantity quantity) const {
    return channels_[channel_of_[static_cast<std::size_t>(sources_[static_cast<std::size_t>(quantity)].column)]];
  }
  [[nodiscard]] bool has(Quantity quantity) const { return sources_[static_cast<std::size_t>(quantity)].column >= 0; }
  [[nodiscard]] std::string text_of(Quantity quantity) const {
    const int column = sources_[static_cast<std::size_t>(quantity)].column;
    return in_quotes(columns_[static_cast<std::size_t>(column)].text);
  }

  // In SI, every one finite.
  [[nodiscard]] std::vector<double> read(const MeasuredChannel& channel, const UnitConversion& unit,
                                         const std::string& name) const {
    std::vector<double> values = channel.values();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        fail("value " + std::to_string(i + 1) + " of " + name + " is " + (std::isnan(values[i]) ? "NaN" : "infinite") +
             ", expected a finite number");
      }
      values[i] = unit.to_si(values[i]);
      if (!(std::abs(values[i]) <= largest_value)) {
        fail("value " + std::to_string(i + 1) + " of " + name + " is too large, expected at most 1e30 in SI units");
      }
    }
    return values;
  }

  // The times of a channel, in s; empty where it has none.
  [[nodiscard]] std::vector<double> times_of(const MeasuredChannel& channel, const std::string& name) const {
    std::vector<double> time;
    std::string of_times = name;
    if (channel.times) {
      const MeasuredChannel& times = channels_[*channel.times];
      const Column column = column_of(times);
      of_times = in_quotes(column.text);
      UnitConversion unit;
      if (times_are_a_column_) {
        unit = sources_[time_at].unit;
      } else if (!column.unit.empty()) {
        refuse_two_units(column, "time", file_, 0);
        unit = parse_unit(Quantity::time, column.unit, file_);
      }
      if (times.count != channel.count) {
        fail(of_times + " holds " + std::to_string(times.count) + " times and " + name + " " +
             std::to_string(channel.count) + " values, expected as many");
      }
      time = read(times, unit, of_times);
    } else if (channel.clock) {
      if (!has_step(channel)) {
        fail("the times of " + name +
             fmt::format(" have a step of {}, expected one above zero in s", channel.clock->step));
      }
      time.resize(channel.count);
      for (std::size_t k = 0; k < time.size(); ++k) {
        time[k] = channel.clock->start + static_cast<double>(k) * channel.clock->step;
      }
      of_times = "the times of " + name;
    }
    for (std::size_t k = 0; k < time.size(); ++k) {
      if (!(std::abs(time[k]) <= largest_value)) fail(of_times + " leave all bounds, expected times in s");
      if (k > 0 && !(time[k] - time[k - 1] > shortest_step)) {
        fail("value " + std::to_string(k + 1) + " of " + of_times +
             " does not increase, expected strictly increasing times");
      }
    }
    return time;
  }

  void read_base() {
    for (const Quantity quantity : {Quantity::force, Quantity::displacement}) {
      if (!has(quantity)) continue;
      base_ = quantity;
      break;
    }
    if (base_ == Quantity::time) {
      fail("neither a force nor a displacement, expected one of them");
    }
    values_[time_at] = times_of(channel_at(base_), text_of(base_));
    if (values_[time_at].empty()) {
      fail(text_of(base_) +
           " has no times: neither a start and a step nor a channel named time with as many values in its group, "
           "expected one, or " +
           Option::column + " time=NAME");
    }
    last_ = values_[time_at].size();
    if (last_ < fewest_rows) too_few(last_);
    const MeasuredChannel& base = channel_at(base_);
    if (base.times) epoch_ = channels_[*base.times].epoch;
    if (!epoch_ && base.began) epoch_ = *base.began - values_[time_at].front();
    if (times_are_a_column_) return;
    // Remarks name it.
    Column column;
    if (base.times) column = column_of(channels_[*base.times]);
    if (!base.times)
      column.text =
          "times of " + columns_[static_cast<std::size_t>(sources_[static_cast<std::size_t>(base_)].column)].text;
    sources_[time_at] = {static_cast<int>(columns_.size()), {}, base.times && column.unit.empty()};
    columns_.push_back(std::move(column));
    channel_of_.push_back(base.times.value_or(0));
  }

  [[noreturn]] void too_few(std::size_t count) const {
    fail(std::to_string(count) + (count == 1 ? " sample" : " samples") + ", expected at least " +
         std::to_string(fewest_rows));
  }

  [[nodiscard]] bool same_times(const MeasuredChannel& channel) const {
    const MeasuredChannel& base = channel_at(base_);
    if (channel.times || base.times) return channel.times == base.times;
    if (channel.clock && base.clock) return has_step(channel) && *channel.clock == *base.clock;
    return !channel.clock && channel.group == base.group && channel.count == base.count;
  }

  // Reads a channel and puts it on the times of the recording.
  void place(Quantity quantity) {
    const auto index = static_cast<std::size_t>(quantity);
    values_[index] = placed(channel_at(quantity), sources_[index].unit, text_of(quantity),
                            std::string(quantity_name(quantity)), is_motion(quantity));
  }

  void place_conditions() {
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      if (conditions_[c].column < 0) continue;
      const auto column = static_cast<std::size_t>(conditions_[c].column);
      condition_values_[c] = placed(channels_[channel_of_[column]], conditions_[c].unit.conversion,
                                    in_quotes(columns_[column].text), conditions_[c].name, false);
    }
  }

  std::vector<double> placed(const MeasuredChannel& channel, const UnitConversion& unit, const std::string& name,
                             const std::string& word, bool smooth) {
    std::vector<double> values = read(channel, unit, name);
    if (same_times(channel)) {
      last_ = std::min(last_, values.size());
      return values;
    }
    const std::vector<double> time = times_of(channel, name);
    if (time.empty()) {
      fail(name + " has no times of its own and not as many values as " + text_of(base_) +
           ", expected a start and a step, or a channel named time with as many values in its group");
    }
    const std::vector<double>& at = values_[time_at];
    if (time == at) return values;
    if (time.size() < 2) fail(name + " has one value, expected two at least to put it on the times of another channel");
    const Between between = smooth ? Between::smooth : Between::straight;
    const double before = between == Between::smooth ? 0.0 : time[1] - time[0];
    const double behind = between == Between::smooth ? 0.0 : time.back() - time[time.size() - 2];
    const auto from = std::ranges::lower_bound(at, time.front() - before) - at.begin();
    const auto to = std::ranges::upper_bound(at, time.back() + behind) - at.begin();
    first_ = std::max(first_, static_cast<std::size_t>(from));
    last_ = std::min(last_, static_cast<std::size_t>(to));
    if (first_ >= last_) {
      fail(name + " and " + text_of(base_) + " were not recorded at the same time, expected times that overlap");
    }
    std::vector<double> clamped(at.begin() + from, at.begin() + to);
    for (double& t : clamped) t = std::clamp(t, time.front(), time.back());
    const std::vector<double> there = resampled(time, values, clamped, between);
    std::vector<double> result(at.size(), 0.0);
    std::ranges::copy(there, result.begin() + from);
    (between == Between::smooth ? smooth_ : straight_).push_back(word + " (" + frequency_of(time) + ")");
    return result;
  }

  // To the times that all channels have.
  void cut() {
    const std::size_t count = values_[time_at].size();
    left_out_ = first_ + (count - std::min(count, last_));
    if (first_ >= last_ || last_ - first_ < fewest_rows) too_few(first_ < last_ ? last_ - first_ : 0);
    for (std::vector<double>& values : values_) {
      if (values.empty()) continue;
      values.resize(last_);
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first_));
    }
    for (std::vector<double>& values : condition_values_) {
      if (values.empty()) continue;
      values.resize(last_);
      values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first_));
    }
  }

  void check() const {
    for (const std::vector<double>& values : values_) {
      if (!std::ranges::all_of(values, [](double value) { return std::abs(value) <= largest_value; })) {
        fail("a channel swings out of bounds between its samples, expected one that is sampled often enough");
      }
    }
  }

  void remark_on_times() const {
    if (smooth_.empty() && straight_.empty() && left_out_ == 0) return;
    std::string text;
    if (!smooth_.empty()) {
      text += joined(smooth_, "and") + (smooth_.size() > 1 ? " are" : " is") + " put on the times of the " +
              std::string(quantity_name(base_)) + " (" + frequency_of(values_[time_at]) +
              ") by polynomials through the 8 nearest samples";
    }
    if (!straight_.empty()) {
      text += (text.empty() ? "" : "; ") + joined(straight_, "and");
      text += smooth_.empty() ? std::string(straight_.size() > 1 ? " are" : " is") + " put on the times of the " +
                                    std::string(quantity_name(base_)) + " (" + frequency_of(values_[time_at]) + ")"
                              : std::string();
      text += " by straight lines";
    }
    if (left_out_ > 0) {
      text += (text.empty() ? "" : "; ") + std::to_string(left_out_) + (left_out_ == 1 ? " sample" : " samples") +
              " of the " + std::string(quantity_name(base_)) + " outside of the other channels' times " +
              (left_out_ == 1 ? "is" : "are") + " left out";
    }
    options_.remark({file_, Remark::Kind::dialect, "rates", text});
  }

  // Channels that no quantity takes: their mean, where it is a number.
  [[nodiscard]] std::vector<UnusedColumn> unused() const {
    std::vector<UnusedColumn> result;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const auto taken = [&](const auto& source) { return source.column == static_cast<int>(k); };
      if (std::ranges::any_of(sources_, taken) || std::ranges::any_of(conditions_, taken)) continue;
      const MeasuredChannel& channel = channels_[channel_of_[k]];
      if (channel.count == 0) continue;
      std::vector<double> values;
      try {
        values = channel.values();
      } catch (const InputError&) {
        continue;  // no channel of the recording: nobody asked for it
      }
      const double sum = std::accumulate(values.begin(), values.end(), 0.0);
      if (!values.empty() && std::isfinite(sum)) {
        result.push_back({columns_[k].text, sum / static_cast<double>(values.size())});
      }
    }
    return result;
  }

  std::vector<MeasuredChannel> channels_;
  const std::string& file_;
  const ReadOptions& options_;
  std::vector<Column> columns_;
  std::vector<std::size_t> channel_of_;  // of each column
  Sources sources_;
  bool times_are_a_column_ = false;
  Quantity base_ = Quantity::time;  // whose times are those of the recording
  std::optional<double> epoch_;     // when they are zero, s since 1970
  Channels values_;
  std::vector<ConditionSource> conditions_;
  std::vector<std::vector<double>> condition_values_;  // of those with a column
  std::size_t first_ = 0;
  std::size_t last_ = 0;
  std::size_t left_out_ = 0;
  std::vector<std::string> smooth_;
  std::vector<std::string> straight_;
};

}  // namespace

Recording recording_of(std::vector<MeasuredChannel> channels, const std::string& file, const ReadOptions& options) {
  return RecordingMaker(std::move(channels), file, options).run();
}

}  // namespace hysteron

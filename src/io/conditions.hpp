// Conditions that laws of parameters follow (--by, [by.NAME]): columns of a file that are no channel of the motion, the
// temperature and the voltage among them, or one number of a whole recording, of campaign.toml or the command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// The condition that needs no column: the start of every recording, s since that of the first (io/campaign.hpp).
inline constexpr std::string_view clock_condition = "clock";

// A name as the command line or campaign.toml writes it, in lower case without spaces around it. What is wrong with it
// is said behind `where` in an InputError: empty, or a channel of the motion or the force.
[[nodiscard]] std::string condition_name(std::string_view text, const std::string& where);

// The unit of a plain number, which is in SI, where the condition's name says what it is; else empty.
[[nodiscard]] std::string_view unit_of_plain(std::string_view name);

// What a unit becomes inside: SI for every unit of a channel and of pressure, degC for temperatures; any other stays as
// it is written.
struct ConditionUnit {
  UnitConversion conversion;
  std::string inside;
};
[[nodiscard]] ConditionUnit condition_unit(std::string_view text);

// "2.1e5", "2.1 bar": a finite number, without a unit in SI; nothing where it is none.
[[nodiscard]] std::optional<ConditionNumber> condition_number(std::string_view text);

// Where the values of a condition come from.
struct ConditionSource {
  std::string name;
  int column = -1;
  ConditionUnit unit;
  std::optional<Quantity> channel;  // the values are those of this channel
  std::optional<ConditionNumber> number;
};

// Of every name of options.conditions, but for a clock that has neither. InputError at file:line where a recording has
// neither column nor number for one, or both.
[[nodiscard]] std::vector<ConditionSource> assign_conditions(const std::vector<Column>& columns, const Sources& sources,
                                                             const ReadOptions& options, const std::string& file,
                                                             int line);

// Averages of every k values, as those of the channels (io/block_means.hpp).
class ConditionMeans {
 public:
  explicit ConditionMeans(std::size_t k) : k_(k) {}
  void add(double value);
  [[nodiscard]] std::vector<double> take() { return std::move(means_); }

 private:
  std::size_t k_;
  std::size_t held_ = 0;
  double first_ = 0.0;
  double sum_ = 0.0;  // less the first
  std::vector<double> means_;
};

// The values of conditions in memory, averaged as `thin` does where there are more samples than are kept.
void thin_conditions(std::vector<std::vector<double>>& values, std::size_t samples, const ReadOptions& options);

// Conditions from their sources, the values of the columns in SI (one entry a source, empty where it has no column) and
// the channels, from which no channel was taken yet.
[[nodiscard]] std::vector<ConditionChannel> make_conditions(const std::vector<ConditionSource>& sources,
                                                            std::vector<std::vector<double>>&& columns,
                                                            const Channels& channels);

// Numbers that no law follows, once the recording is read: those of a current, a voltage or a temperature are its
// channel, any other is kept beside its unused columns. InputError where the file records the same.
void take_numbers(Recording& recording, const ReadOptions& options);

// InputError where two recordings have a condition in different units, or one in none.
void agree_on_units(const std::vector<Recording>& recordings);

}  // namespace hysteron

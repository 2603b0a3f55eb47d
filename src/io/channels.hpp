// From named columns to the channels of a recording: synonyms, mappings, units. Shared by the CSV and MAT readers.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/message.hpp"
#include "core/recording.hpp"
#include "io/units.hpp"

namespace hysteron {

// What a reader wants known of a file that it reads all the same.
struct Remark {
  enum class Kind { implausible, dialect, thinned };
  std::string file;
  Kind kind;
  std::string key;  // the same for the same remark on another file
  Message text;     // one line
};

// One number for a whole recording, in SI, with its unit (empty: not said) and where it is said, for messages.
struct ConditionNumber {
  double value = 0.0;
  std::string unit;
  std::string file;
  int line = 0;
};

struct ReadOptions {
  // Channel -> column, e.g. "force" -> "CH1 [kgf]": the column's full text or name; a unit given here overrides
  // the file's. In MAT files also a column number "3 [kN]" or "MATRIX:3 [kN]", counted from 1; in files with groups
  // also "GROUP/NAME".
  std::map<std::string, std::string> columns;
  bool force_required = true;
  bool displacement_required = true;
  bool without_time = false;  // a file may have no time, and one is made (make_time)
  int skip = 0;               // lines at the head of a CSV file that are not read
  // What laws follow beside drive and frequency, in order: columns to keep (io/conditions.hpp).
  std::vector<std::string> conditions = {};
  std::map<std::string, ConditionNumber> numbers = {};  // of the recording
  // Laws follow the frequency, which is that of the motion: a column or a number of that name is told not to be taken.
  bool follows_frequency = false;
  // Samples kept of all recordings together, 0 for all samples (io/block_means.hpp).
  std::size_t keep_samples = 0;
  std::size_t samples_of_all = 0;  // that these have; 0: of one recording
  std::function<void(const Remark&)> remark = {};
  // Group of a TDMS or MDF file, or sheet of a workbook, that alone is read; empty for all of them.
  std::string group = {};
  bool time_required = true;  // otherwise only a mapping and a column's whole name make it the time
  // Told of the start that a file says for itself: whether it names a time zone.
  std::function<void(bool has_zone)> start_zone = {};
};

// A column as the file names it.
struct Column {
  std::string text;             // as written, shown in messages
  std::string name;             // without the unit
  std::string unit;             // empty: SI
  std::string alias;            // another name it answers to in a mapping, or empty
  std::string other_unit = {};  // that the file gives beside it, in a row of units or a property
};

// Where a channel comes from; column -1 when the file does not have it.
struct Source {
  int column = -1;
  UnitConversion unit;
  bool assumed = false;  // the file gives no unit: SI
};

using Sources = std::array<Source, quantity_count>;
using Channels = std::array<std::vector<double>, quantity_count>;

inline constexpr std::size_t fewest_rows = 8;

// In SI. Far from anything measured, and near enough to one that the squares of what is derived are numbers.
inline constexpr double largest_value = 1e30;
inline constexpr double shortest_step = 1e-30;  // s

// The channel a column name stands for, by its usual synonyms and without case.
[[nodiscard]] std::optional<Quantity> quantity_of_name(std::string_view name);

// That of a column, where the unit tells as well: a bare `v` may be a voltage, `a` a current, `t` a temperature.
[[nodiscard]] std::optional<Quantity> quantity_of_column(const Column& column);

// The channel that the last word of "Total Time" or "Axial_Force" names; nothing for a single word or letter.
[[nodiscard]] std::optional<Quantity> quantity_of_last_word(std::string_view name);

// "force [kN]" or "force (kN)" -> name and unit; the unit is empty when there is none.
[[nodiscard]] Column split_column(std::string_view text);

// Whether both texts are units and not of one size. What is no unit is a note.
[[nodiscard]] bool contradict(std::string_view unit, std::string_view other);

// InputError at file:line where a column is given in two units; `name` is what --column calls it.
void refuse_two_units(const Column& column, const std::string& name, const std::string& file, int line);

// Finds each channel's column. Time, displacement and (if required) force must be there; every failure is an
// InputError at file:line that lists the columns present.
[[nodiscard]] Sources assign_columns(const std::vector<Column>& columns, const ReadOptions& options,
                                     const std::string& file, int line);

// One sample of every channel; of those that the file does not have it says nothing.
using Row = std::array<double, quantity_count>;

// Where the channels have no time, one for laws that do not depend on the rate: equal steps, such that the fastest
// speed between two samples is 0.1 m/s. Whether one was made.
bool make_time(Channels& channels);

// A velocity that is one number while the rod goes to and fro is none: it is kept as a column that no model uses.
inline constexpr std::string_view set_velocity = "velocity [m/s]";

// Checked channels in SI -> recording: a missing velocity is derived, current goes before voltage as the drive.
[[nodiscard]] Recording make_recording(Channels&& channels);

}  // namespace hysteron

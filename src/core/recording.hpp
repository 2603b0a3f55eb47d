// A measured recording and a campaign of them: plain values in SI units.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/earlier_work.hpp"

namespace hysteron {

// What the drive channel of a recording measures. `none` when the recording has neither.
enum class DriveKind { none, current, voltage };

// How the force of a recording that begins in mid-motion begins: as in the periods after it, or building up from
// nothing, as that of a damper that was at rest in the first sample's position (start_of, fit/start.hpp).
enum class Start { unknown, in_cycle, from_nothing };

// A recorded column that no channel takes, as one number of its recording: a pressure, a temperature of the oil.
struct UnusedColumn {
  std::string name;  // as in the file, with its unit
  double mean = 0.0;
};

// What parameters may follow beside motion, frequency and drive: a column of the file (a pressure, a temperature, the
// position of a valve), or one number of the whole recording.
struct ConditionChannel {
  std::string name;            // in lower case
  std::string unit;            // of the values: in SI where the program knows the unit, else as written; may be empty
  std::vector<double> values;  // without the noise of the measurement; one a sample, or one where it does not vary
};

// Parameter -> order of its polynomial.
using LawOrders = std::map<std::string, int>;

// One test of one damper. All channels have the length of `time`; absent optional channels are empty.
struct Recording {
  std::string file;                          // as the user named it, relative to the campaign folder, forward slashes
  std::string sha256;                        // of the file's bytes, lower-case hex
  std::vector<double> time;                  // s, strictly increasing
  std::vector<double> displacement;          // m
  std::vector<double> velocity;              // m/s, measured or derived (see velocity_measured)
  std::vector<double> force;                 // N; empty only where a motion without force is allowed (simulate)
  std::vector<double> acceleration;          // m/s^2, optional
  std::vector<double> derived_acceleration;  // m/s^2, slope of the velocity, smoothed as its noise asks; may be empty
  std::vector<double> drive;                 // A or V, optional
  std::vector<double> temperature;           // degC, optional
  std::vector<double> base;                  // m, displacement of what the mass stands on, optional
  std::vector<UnusedColumn> unused;          // numbers all along, in the order of the file
  std::vector<ConditionChannel> conditions;  // that laws follow, in order of name, the same in all of a campaign
  DriveKind drive_kind = DriveKind::none;
  bool velocity_measured = false;
  std::optional<double> started;     // s since 1970 by the clock that the file or campaign.toml names
  std::vector<EarlierWork> earlier;  // of the recordings made before it, oldest first; empty where that is not known
  bool timed = true;  // else the file has no time, and one was made for a law that does not depend on the rate
  Start start = Start::unknown;  // known of copies with fewer samples, which no longer show it

  [[nodiscard]] std::size_t size() const { return time.size(); }
};

// All channels, absent ones too, and the conditions that vary.
std::vector<std::vector<double>*> channels_of(Recording& recording);
// Recordings where they are, for what needs no copy of them: all, or those of the indices.
std::vector<const Recording*> refer_to(const std::vector<Recording>& recordings);
std::vector<const Recording*> refer_to(const std::vector<Recording>& recordings,
                                       const std::vector<std::size_t>& indices);
// The columns that no model uses and that every recording has, a temperature among them: name and mean of each
// recording.
struct UnusedOfAll {
  std::string name;
  std::vector<double> means;
};
std::vector<UnusedOfAll> unused_of_all(const std::vector<Recording>& recordings);
// Every k-th sample of every channel, from the first on; k > 0.
Recording every_kth(const Recording& recording, std::size_t k);
// Whether the drive moves, by more than its noise (core/drive.hpp); false when there is none.
bool drive_varies(const Recording& recording);
// count_levels() of all recordings: of one in which the drive is constant its mean counts, else every sample.
std::size_t drive_levels(const std::vector<Recording>& recordings);

enum class Role { unassigned, fit, validate };

// A line of a file, for messages; 0 where none is known.
struct LineOfFile {
  std::string file;
  int line = 0;
};

// Recordings that belong together, with what campaign.toml says of them.
struct Campaign {
  std::vector<Recording> recordings;
  std::vector<Role> roles;              // one per recording
  std::string model;                    // default for --model, may be empty
  LawOrders by_current;                 // in the drive
  LawOrders by_frequency;               // in the frequency of the motion
  std::map<std::string, LawOrders> by;  // in a condition, by its name
  // Of these laws, by what each follows ("current", "frequency" or a condition) and its parameter.
  std::map<std::pair<std::string, std::string>, LineOfFile> lines_of_laws;
};

}  // namespace hysteron

// RPC III time histories of MTS test rigs. Source: MTS, RPC III File Formats.
//
// A header of blocks of 512 bytes, each of four entries: a key of 32 bytes and a value of 96, both text that ends with
// NUL. The first three are FORMAT, NUM_HEADER_BLOCKS and NUM_PARAMS. Behind it lie groups: PTS_PER_GROUP points of the
// first channel, then of the second, and so on; all channels have one rate, 1 / DELTA_T. FRAMES frames of PTS_PER_FRAME
// points are valid; the last group is filled up, or, by some programs, cut off. Integers are multiplied by
// SCALE.CHAN_n. SAMPLES, where a program writes it, is the number of points before the last frame is filled up, with
// zeros or the last value. DATE is when the file or its header was created.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/bytes.hpp"
#include "io/clock_time.hpp"
#include "io/format.hpp"
#include "io/mat_variable.hpp"
#include "io/measured.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

constexpr std::size_t block = 512;  // bytes
constexpr std::size_t key_size = 32;
constexpr std::size_t value_size = 96;
constexpr std::uint64_t most_blocks = 1024;
constexpr std::uint64_t most_channels = 4096;

class Rpc3Reader {
 public:
  Rpc3Reader(std::string_view bytes, const std::string& file, const ReadOptions& options)
      : bytes_(bytes), file_(file), options_(options) {}

  std::vector<MeasuredChannel> run() {
    try {
      read_header();
      read_layout();
    } catch (const BeyondTheEnd&) {
      fail("the header is cut off, expected a complete RPC III file");
    }
    const double step = number("DELTA_T");
    if (!(step > 0.0 && std::isfinite(step))) {
      fail("DELTA_T is " + in_quotes(text("DELTA_T")) + ", expected a time in s above zero");
    }
    const std::string date = without_quotes(text_or_none("DATE"));
    auto began = clock_time_with_month(date);
    if (!began && (began = clock_time(date)) && options_.start_zone) options_.start_zone(has_zone(date));
    std::vector<MeasuredChannel> channels;
    for (std::uint64_t c = 0; c < channels_; ++c) {
      const std::string number_of_it = std::to_string(c + 1);
      MeasuredChannel channel;
      channel.name = without_quotes(text_or_none("DESC.CHAN_" + number_of_it));
      if (channel.name.empty()) channel.name = "CHAN_" + number_of_it;
      channel.unit = without_quotes(text_or_none("UNITS.CHAN_" + number_of_it));
      channel.count = static_cast<std::size_t>(samples_);
      channel.clock = Clock{0.0, step};
      channel.began = began;
      channel.values = [this, c] { return numbers_of(c); };
      channels.push_back(std::move(channel));
    }
    return channels;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }

  // Text before the first NUL.
  static std::string_view cut(std::string_view field) {
    return trimmed(field.substr(0, std::min(field.find('\0'), field.size())));
  }

  static std::string without_quotes(std::string_view text) {
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    text = trimmed(text);
    std::string result = valid_utf8(text);
    if (result == text) return result;
    // Windows and the programs of its time: a micron, a degree.
    result.clear();
    for (const char c : text) append_utf8(result, static_cast<unsigned char>(c));
    return result;
  }

  void read_header() {
    ByteCursor cursor(bytes_);
    const auto next = [&] {
      const std::string_view key = cut(cursor.take(key_size));
      return std::pair(key, cut(cursor.take(value_size)));
    };
    for (const std::string_view expected : {"FORMAT", "NUM_HEADER_BLOCKS", "NUM_PARAMS"}) {
      const auto [key, value] = next();
      if (key != expected) {
        fail("the header says " + in_quotes(key) + " where " + std::string(expected) +
             " belongs, expected an RPC III file");
      }
      entries_[std::string(key)] = value;
    }
    const std::uint64_t blocks = count("NUM_HEADER_BLOCKS", 1, most_blocks);
    data_at_ = blocks * block;
    const std::uint64_t entries = count("NUM_PARAMS", 3, blocks * (block / (key_size + value_size)));
    for (std::uint64_t k = 3; k < entries; ++k) {
      const auto [key, value] = next();
      if (!key.empty()) take_entry(std::string(key), value);
    }
    // They have been used.
    (void)text("NUM_HEADER_BLOCKS");
    (void)text("NUM_PARAMS");
  }

  // A key may be there twice with one value; with two it is refused where it is asked for.
  void take_entry(const std::string& key, std::string_view value) {
    const auto [at, added] = entries_.emplace(key, value);
    if (added || value.empty()) return;
    if (at->second.empty()) at->second = value;
    if (!same(at->second, value)) other_values_.emplace(key, value);
  }

  static bool same(std::string_view a, std::string_view b) {
    const std::optional<double> x = number_in(a);
    return without_quotes(a) == without_quotes(b) || (x && x == number_in(b));
  }

  static std::optional<double> number_in(std::string_view value) {
    double result = 0.0;
    if (value.starts_with('+')) value.remove_prefix(1);
    const auto read = std::from_chars(value.data(), value.data() + value.size(), result);
    if (read.ec != std::errc() || read.ptr != value.data() + value.size()) return std::nullopt;
    return result;
  }

  void read_layout() {
    const std::string format = text("FORMAT");
    if (format == "ASCII") fail("FORMAT is ASCII, expected binary data");
    if (format != "BINARY_IEEE_LITTLE_END" && format != "BINARY_IEEE_BIG_END" && format != "BINARY") {
      fail("FORMAT is " + in_quotes(format) + ", expected BINARY_IEEE_LITTLE_END, BINARY_IEEE_BIG_END or BINARY");
    }
    layout_.order = format == "BINARY_IEEE_BIG_END" ? std::endian::big : std::endian::little;
    const std::string kind = text_or_none("FILE_TYPE");
    if (!kind.empty() && kind != "TIME_HISTORY") fail("FILE_TYPE is " + in_quotes(kind) + ", expected TIME_HISTORY");
    if (const std::string half = text_or_none("HALF_FRAMES"); !half.empty() && half != "0") {
      fail("HALF_FRAMES is " + in_quotes(half) + ", expected 0: save the file without half frames at its ends");
    }
    std::string type = text_or_none("DATA_TYPE");
    if (type.empty()) type = "SHORT_INTEGER";
    if (type != "SHORT_INTEGER" && type != "FLOATING_POINT") {
      fail("DATA_TYPE is " + in_quotes(type) + ", expected SHORT_INTEGER or FLOATING_POINT");
    }
    is_integer_ = type == "SHORT_INTEGER";
    layout_.kind = is_integer_ ? NumberLayout::Kind::signed_integer : NumberLayout::Kind::floating;
    layout_.size = is_integer_ ? 2 : 4;
    constexpr std::uint64_t most_points = std::uint64_t{1} << 40U;
    channels_ = count("CHANNELS", 1, most_channels);
    const std::uint64_t frame = count("PTS_PER_FRAME", 1, most_points);
    const std::uint64_t frames = count("FRAMES", 1, most_points / frame);
    group_ = count("PTS_PER_GROUP", frame, most_points);
    if (group_ % frame != 0) {
      fail("PTS_PER_GROUP is " + std::to_string(group_) + ", expected a multiple of PTS_PER_FRAME, " +
           std::to_string(frame));
    }
    const std::uint64_t points = frame * frames;
    const std::uint64_t groups = points / group_ + (points % group_ != 0 ? 1 : 0);
    const std::uint64_t there = bytes_.size() - std::min<std::uint64_t>(bytes_.size(), data_at_);
    const std::uint64_t point = channels_ * layout_.size;
    if (there == groups * group_ * point) {
      last_group_ = group_;
    } else if (there == points * point) {
      last_group_ = points - (groups - 1) * group_;
    } else {
      fail("the header tells of " + std::to_string(groups * group_ * point) + " bytes of data and " +
           std::to_string(there) + " are there, the file is cut off or damaged, expected a complete RPC III file");
    }
    groups_ = groups;
    if (!text_or_none("SAMPLES").empty()) {
      samples_ = count("SAMPLES", 0, points);
      return;
    }
    const std::uint64_t fill = filled(points, frame);
    samples_ = points - fill;
    if (fill > 0 && options_.remark) {
      options_.remark({file_, Remark::Kind::dialect, "filled frame",
                       "the header has no SAMPLES: the last " +
                           (fill == 1 ? "sample, in which no channel changes, is"
                                      : std::to_string(fill) + " samples, in which no channel changes, are") +
                           " taken as what fills up the last frame and left out"});
    }
  }

  // Points that fill up the last frame, less than all of it: they are zero in all channels, or go on with the last
  // value of each, the first of which was measured.
  [[nodiscard]] std::uint64_t filled(std::uint64_t points, std::uint64_t frame) const {
    std::vector<double> last;
    for (std::uint64_t c = 0; c < channels_; ++c) last.push_back(stored(c, points - 1));
    const auto is_as_last = [&](std::uint64_t point) {
      for (std::uint64_t c = 0; c < channels_; ++c) {
        if (stored(c, point) != last[static_cast<std::size_t>(c)]) return false;
      }
      return true;
    };
    std::uint64_t count = 1;
    while (count < frame && is_as_last(points - 1 - count)) ++count;
    const bool is_zero = std::ranges::all_of(last, [](double value) { return value == 0.0; });
    return is_zero ? std::min(count, frame - 1) : count - 1;
  }

  // A point of a channel, unscaled.
  [[nodiscard]] double stored(std::uint64_t channel, std::uint64_t point) const {
    const std::uint64_t group = point / group_;
    const std::uint64_t stride = group + 1 == groups_ ? last_group_ : group_;
    return value_at(bytes_, data_at_ + (group * group_ * channels_ + channel * stride + point % group_) * layout_.size,
                    layout_);
  }

  [[nodiscard]] std::vector<double> numbers_of(std::uint64_t channel) const {
    double scale = 1.0;
    if (is_integer_) scale = number("SCALE.CHAN_" + std::to_string(channel + 1));
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(samples_));
    for (std::uint64_t k = 0; k < samples_; ++k) values.push_back(scale * stored(channel, k));
    return values;
  }

  [[nodiscard]] std::string text_or_none(const std::string& key) const {
    const auto found = entries_.find(key);
    if (const auto other = other_values_.find(key); other != other_values_.end()) {
      fail("the header says " + key + " twice, " + in_quotes(found->second) + " and " + in_quotes(other->second) +
           ", expected one value");
    }
    return found == entries_.end() ? std::string() : std::string(found->second);
  }

  [[nodiscard]] std::string text(const std::string& key) const {
    const std::string value = text_or_none(key);
    if (value.empty()) fail("the header has no " + key + ", expected a complete RPC III header");
    return value;
  }

  [[nodiscard]] std::uint64_t count(const std::string& key, std::uint64_t least, std::uint64_t most) const {
    const std::string value = text(key);
    std::uint64_t result = 0;
    const auto read = std::from_chars(value.data(), value.data() + value.size(), result);
    if (read.ec != std::errc() || read.ptr != value.data() + value.size() || result < least || result > most) {
      fail(key + " is " + in_quotes(value) + ", expected a whole number from " + std::to_string(least) + " to " +
           std::to_string(most));
    }
    return result;
  }

  [[nodiscard]] double number(const std::string& key) const {
    const std::string value = text(key);
    const std::optional<double> result = number_in(value);
    if (!result) fail(key + " is " + in_quotes(value) + ", expected a number");
    return *result;
  }

  std::string_view bytes_;
  const std::string& file_;
  const ReadOptions& options_;
  std::map<std::string, std::string_view> entries_;
  std::map<std::string, std::string_view> other_values_;  // of keys that are there with two
  std::uint64_t data_at_ = 0;
  NumberLayout layout_;
  bool is_integer_ = true;
  std::uint64_t channels_ = 0;
  std::uint64_t group_ = 0;  // points of a channel in a group
  std::uint64_t groups_ = 0;
  std::uint64_t last_group_ = 0;  // points of a channel that are stored in the last group
  std::uint64_t samples_ = 0;     // of a channel
};

// Drive files hold what the rig was told, without a force.
constexpr Ending endings[] = {{".rsp"}, {".rpc"}, {".rpc3"}, {".drv", InFolders::none}, {".tim", InFolders::none}};

bool begins(std::string_view head) { return head.starts_with(std::string_view("FORMAT\0", 7)); }

Recording parse(std::string_view bytes, const std::string& file, const ReadOptions& options) {
  Rpc3Reader reader(bytes, file, options);
  return recording_of(reader.run(), file, options);
}

}  // namespace

extern const InputFormat format_rpc3;
const InputFormat format_rpc3 = {
    .name = "RPC III", .endings = endings, .begins = begins, .parse = parse, .samples = samples_by_size};

}  // namespace hysteron

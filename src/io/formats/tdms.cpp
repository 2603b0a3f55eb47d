// TDMS files of LabVIEW and DIAdem, versions 4712 and 4713. Source: National Instruments, TDMS File Format Internal
// Structure.
//
// A file is a row of segments. Each begins with 28 bytes: "TDSm", what is in it, the version, where the next one begins
// and where its numbers do. Its metadata list objects (/'group'/'channel'), for each how many numbers of what type a
// chunk of the segment holds, or that this is as before, and properties. What is not said goes on from the segment
// before. Behind the metadata lie chunks to the end of the segment: the numbers of one channel behind those of another,
// or, interleaved, one of each in turn.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <variant>

#include "core/error.hpp"
#include "io/bytes.hpp"
#include "io/clock_time.hpp"
#include "io/format.hpp"
#include "io/measured.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

constexpr std::string_view tag = "TDSm";
constexpr std::uint64_t lead_in = 28;  // bytes

// What is in a segment.
constexpr std::uint32_t has_metadata = 1U << 1U;
constexpr std::uint32_t has_new_list = 1U << 2U;
constexpr std::uint32_t has_numbers = 1U << 3U;
constexpr std::uint32_t is_interleaved = 1U << 5U;
constexpr std::uint32_t is_big_endian = 1U << 6U;
constexpr std::uint32_t is_daqmx = 1U << 7U;

// In place of the length of an object's index.
constexpr std::uint32_t no_numbers = 0xFFFFFFFF;
constexpr std::uint32_t as_before = 0;
constexpr std::uint32_t daqmx_scaler = 0x00001269;  // as two of its bytes lie in the file: 69 12 and 69 13
constexpr std::uint32_t daqmx_digital = 0x0000126A;
constexpr std::uint32_t daqmx_scaler_swapped = 0x69120000;
constexpr std::uint32_t daqmx_digital_swapped = 0x69130000;

constexpr std::uint32_t type_text = 0x20;
constexpr std::uint32_t type_truth = 0x21;
constexpr std::uint32_t type_time = 0x44;
constexpr std::uint32_t type_daqmx = 0xFFFFFFFF;

// Bytes of a number; 0 of a text or of what is not known.
std::uint64_t size_of(std::uint32_t type) {
  switch (type) {
    case 1:
    case 5:
    case type_truth:
      return 1;
    case 2:
    case 6:
      return 2;
    case 3:
    case 7:
    case 9:
    case 0x19:
      return 4;
    case 4:
    case 8:
    case 10:
    case 0x1A:
    case 0x08000C:
      return 8;
    case type_time:
    case 0x10000D:
    case 11:
    case 0x1B:
      return 16;
    default:
      return 0;
  }
}

// How a type of numbers that are read lies in a file; nothing for texts, complex and extended numbers.
std::optional<NumberLayout> layout_of(std::uint32_t type) {
  using Kind = NumberLayout::Kind;
  const auto size = static_cast<std::uint8_t>(size_of(type));
  if (type >= 1 && type <= 4) return NumberLayout{Kind::signed_integer, size, {}};
  if ((type >= 5 && type <= 8) || type == type_truth) return NumberLayout{Kind::unsigned_integer, size, {}};
  if (type == 9 || type == 10 || type == 0x19 || type == 0x1A) return NumberLayout{Kind::floating, size, {}};
  return std::nullopt;
}

// Seconds since 1904 and fractions of 2^-64 s.
struct Moment {
  std::int64_t seconds = 0;
  std::uint64_t fraction = 0;
};

Moment moment_at(std::string_view bytes, std::uint64_t at, std::endian order) {
  const bool little = order == std::endian::little;
  return {number_at<std::int64_t>(bytes, at + (little ? 8 : 0), order),
          number_at<std::uint64_t>(bytes, at + (little ? 0 : 8), order)};
}

// s
double between(const Moment& from, const Moment& to) {
  const double fractions = (static_cast<double>(to.fraction) - static_cast<double>(from.fraction)) * 0x1p-64;
  return (static_cast<double>(to.seconds) - static_cast<double>(from.seconds)) + fractions;
}

// s since 1970, UTC as all moments of these files; nothing for zero, which stands for times without a date.
std::optional<double> since_1970(const Moment& moment) {
  constexpr double from_1904 = 2'082'844'800.0;
  return clock_time(static_cast<double>(moment.seconds) - from_1904 + static_cast<double>(moment.fraction) * 0x1p-64);
}

using Property = std::variant<double, std::string, Moment>;

struct Object {
  std::string path;
  std::map<std::string, Property, std::less<>> properties;  // those that are asked for
  bool known = false;                                       // its index was told
  bool listed = false;                                      // has numbers in the segment that is read
  bool in_list = false;                                     // of the reader
  std::uint32_t type = 0;                                   // of its numbers
  std::uint64_t count = 0;                                  // of them, in a chunk
  std::uint64_t bytes = 0;                                  // in a chunk
  std::uint64_t total = 0;                                  // of them, in the file
  std::vector<double> values;                               // as they are stored; of times, s since the first
  std::optional<Moment> first;                              // of times
  std::string fault;                                        // why its numbers cannot be read, or nothing
};

// What holds for all numbers of a channel.
bool is_of_numbers(std::string_view property) {
  return property == "unit_string" || property == "NI_UnitDescription" || property == "wf_increment" ||
         property.starts_with("NI_Scal") || property == "NI_Number_Of_Scales";
}

std::string text_of(const Property& property) {
  if (const auto* number = std::get_if<double>(&property)) return fmt::format("{}", *number);
  const auto* text = std::get_if<std::string>(&property);
  return text == nullptr ? "another time" : in_quotes(*text);
}

bool is_blank(const Property& property) {
  const auto* text = std::get_if<std::string>(&property);
  return text != nullptr && trimmed(*text).empty();
}

bool same(const Property& a, const Property& b) {
  const auto* one = std::get_if<double>(&a);
  const auto* other = std::get_if<double>(&b);
  if (one != nullptr && other != nullptr) return *one == *other || (std::isnan(*one) && std::isnan(*other));
  const auto* text = std::get_if<std::string>(&a);
  const auto* other_text = std::get_if<std::string>(&b);
  return text != nullptr && other_text != nullptr && trimmed(*text) == trimmed(*other_text);
}

bool is_asked_for(std::string_view property) {
  constexpr std::string_view names[] = {"unit_string",         "NI_UnitDescription", "wf_increment",
                                        "wf_start_offset",     "wf_start_time",      "NI_Scaling_Status",
                                        "NI_Number_Of_Scales", "DateTime",           "datetime"};
  return std::ranges::find(names, property) != std::end(names) || property.starts_with("NI_Scale[");
}

std::string_view text_at(ByteCursor& cursor) { return cursor.take(cursor.number<std::uint32_t>()); }

// "/'group'/'channel'" -> its names; quotes in a name are doubled.
std::vector<std::string> names_of(std::string_view path) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at + 1 < path.size() && path[at] == '/' && path[at + 1] == '\'';) {
    std::string name;
    for (at += 2; at < path.size(); ++at) {
      if (path[at] == '\'') {
        if (at + 1 >= path.size() || path[at + 1] != '\'') break;
        ++at;
      }
      name += path[at];
    }
    names.push_back(std::move(name));
    ++at;
  }
  return names;
}

class TdmsReader {
 public:
  TdmsReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  void read() {
    std::uint64_t at = 0;
    try {
      while (at < bytes_.size()) at = read_segment(at);
    } catch (const BeyondTheEnd&) {
      fail("the segment at byte " + std::to_string(at) +
           " names bytes that are not there, the file is cut off or damaged, expected a complete TDMS file");
    }
  }

  [[nodiscard]] std::size_t count() const { return objects_.size(); }

  // An object as a channel, but for its numbers; nothing where it holds none.
  [[nodiscard]] std::optional<MeasuredChannel> channel(std::size_t k) {
    const Object& object = objects_[k];
    const std::vector<std::string> names = names_of(object.path);
    if (names.size() != 2 || object.total == 0 || object.type == type_text) return std::nullopt;
    MeasuredChannel result;
    result.group = names[0];
    result.name = names[1];
    result.unit = text_property(object, "unit_string");
    (result.unit.empty() ? result.unit : result.other_unit) = text_property(object, "NI_UnitDescription");
    // Times of day are counted from the first.
    if (object.type == type_time) {
      result.unit = "s";
      result.other_unit.clear();
    }
    if (object.type == type_time && object.first) result.epoch = since_1970(*object.first);
    result.count = static_cast<std::size_t>(object.total);
    const double offset = number_property(object, "wf_start_offset").value_or(0.0);
    const std::optional<Moment> moment = moment_property(object, "wf_start_time");
    // What is no step of time is refused where the times are asked for.
    if (const auto step = number_property(object, "wf_increment")) {
      double begin = offset;
      if (moment) {
        if (!start_) start_ = *moment;
        begin += between(*start_, *moment);
      }
      result.clock = Clock{begin, *step};
    }
    std::optional<double> start = moment ? since_1970(*moment) : std::nullopt;
    if (!start) start = start_of_file();
    if (start) result.began = clock_time(*start + offset);
    return result;
  }

  [[nodiscard]] std::vector<double> numbers_of(std::size_t k) const {
    const Object& object = objects_[k];
    const std::string name = in_quotes(object.path);
    if (!is_read(object.type)) fail("channel " + name + " holds complex or extended numbers, expected numbers");
    if (!object.fault.empty()) fail("channel " + name + " " + object.fault);
    std::vector<double> values = object.values;
    if (object.type == type_time) return values;
    const Scale scale = scale_of(object, name);
    if (scale.slope == 1.0 && scale.intercept == 0.0) return values;
    for (double& value : values) value = scale.intercept + scale.slope * value;
    return values;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }

  [[noreturn]] void damaged(std::uint64_t segment, const std::string& what) const {
    fail("the segment at byte " + std::to_string(segment) + " " + what +
         ", the file is damaged, expected a complete TDMS file");
  }

  // Gives the place of the next one.
  std::uint64_t read_segment(std::uint64_t at) {
    if (bytes_.substr(static_cast<std::size_t>(at), tag.size()) != tag) {
      if (at == 0) fail("does not begin with TDSm, expected a TDMS file");
      damaged(at, "does not begin with TDSm");
    }
    const auto contents = number_at<std::uint32_t>(bytes_, at + 4);
    const std::endian order = (contents & is_big_endian) != 0 ? std::endian::big : std::endian::little;
    const auto version = number_at<std::uint32_t>(bytes_, at + 8, order);
    const auto next = number_at<std::uint64_t>(bytes_, at + 12, order);
    const auto numbers = number_at<std::uint64_t>(bytes_, at + 20, order);
    if (version != 4712 && version != 4713) {
      fail("TDMS of the unknown version " + std::to_string(version) + ", expected 4712 or 4713");
    }
    if (next == std::numeric_limits<std::uint64_t>::max()) {
      fail("the segment at byte " + std::to_string(at) +
           " was never closed, its program ended early, expected a complete TDMS file");
    }
    if ((contents & is_daqmx) != 0) refuse_daqmx("the file");
    const std::string_view segment = bytes_at(bytes_, at + lead_in, next);
    if (numbers > next) damaged(at, "has its numbers behind its end");
    if ((contents & has_metadata) != 0) {
      read_metadata(at, segment.substr(0, static_cast<std::size_t>(numbers)), order, (contents & has_new_list) != 0);
    }
    if ((contents & has_numbers) != 0 && next > numbers) {
      place_numbers(at, at + lead_in + numbers, next - numbers, order, (contents & is_interleaved) != 0);
    }
    return at + lead_in + next;
  }

  [[noreturn]] void refuse_daqmx(const std::string& what) const {
    fail(what + " holds raw data of DAQmx, which this program does not scale, expected numbers: save them scaled");
  }

  Object& object_at(std::string_view path) {
    constexpr std::size_t most = 100'000;
    const auto [found, added] = by_path_.emplace(std::string(path), objects_.size());
    if (added && objects_.size() == most) fail("more than 100000 channels and groups, expected fewer");
    if (added) objects_.emplace_back().path = path;
    return objects_[found->second];
  }

  void read_metadata(std::uint64_t at, std::string_view bytes, std::endian order, bool new_list) {
    if (new_list) {
      for (const std::size_t k : list_) objects_[k].listed = objects_[k].in_list = false;
      list_.clear();
    }
    ByteCursor cursor(bytes, order);
    const auto count = cursor.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::string_view path = text_at(cursor);
      Object& object = object_at(path);
      read_index(at, cursor, object);
      const auto properties = cursor.number<std::uint32_t>();
      const std::optional<double> step = object.total > 0 ? step_of(object) : std::nullopt;
      for (std::uint32_t k = 0; k < properties; ++k) {
        const std::string_view name = text_at(cursor);
        Property property = read_property(at, cursor, order);
        if (is_asked_for(name)) set_property(object, step, std::string(name), std::move(property));
      }
    }
  }

  // Of time; nothing for what is none.
  static std::optional<double> step_of(const Object& object) {
    const std::optional<double> step = number_property(object, "wf_increment");
    return step && *step > 0.0 ? step : std::nullopt;
  }

  // What is said last counts for all numbers; what contradicts those before it is a fault. `step` is that of the
  // numbers before.
  static void set_property(Object& object, std::optional<double> step, const std::string& name, Property property) {
    const auto before = object.properties.find(name);
    const bool said =
        before != object.properties.end() && !is_blank(before->second) && (name != "wf_increment" || step);
    const std::string values = std::to_string(object.total) + (object.total == 1 ? " value" : " values");
    if (object.total > 0 && said && is_of_numbers(name) && !same(before->second, property)) {
      if (object.fault.empty()) {
        object.fault = "changes its " + name + " from " + text_of(before->second) + " to " + text_of(property) +
                       " behind " + values + ", expected one for all of them";
      }
      return;
    }
    if (step && (name == "wf_start_offset" || (said && name == "wf_start_time"))) {
      take_start(object, name, said ? before->second : Property(0.0), property, *step, values);
      return;
    }
    object.properties[name] = std::move(property);
  }

  // Of numbers behind others: they begin when all numbers do, or when the last one before them ends. What lies between
  // is a pause, and one step for all numbers would leave it out.
  static void take_start(Object& object, const std::string& name, const Property& before, const Property& now,
                         double step, const std::string& values) {
    std::optional<double> later;
    if (const auto* from = std::get_if<Moment>(&before), *to = std::get_if<Moment>(&now);
        from != nullptr && to != nullptr) {
      later = between(*from, *to);
    } else if (const auto* first = std::get_if<double>(&before), *next = std::get_if<double>(&now);
               first != nullptr && next != nullptr) {
      later = *next - *first;
    }
    constexpr double of_a_step = 0.5;
    const auto count = static_cast<double>(object.total);
    const bool goes_on = later && (*later == 0.0 || std::abs(*later - count * step) < of_a_step * step);
    if (goes_on || !object.fault.empty()) return;
    object.fault =
        "changes its " + name + " behind " + values +
        (later ? fmt::format(", by {:.6g} s where they last {:.6g} s", *later, count * step) : std::string()) +
        ", expected one start and no pause: save the parts as recordings of their own";
  }

  void read_index(std::uint64_t at, ByteCursor& cursor, Object& object) {
    const auto length = cursor.number<std::uint32_t>();
    if (length == no_numbers) {
      object.listed = false;
      return;
    }
    if (length == daqmx_scaler || length == daqmx_digital || length == daqmx_scaler_swapped ||
        length == daqmx_digital_swapped) {
      refuse_daqmx("channel " + in_quotes(object.path));
    }
    if (length != as_before) {
      const auto type = cursor.number<std::uint32_t>();
      if (type == type_daqmx) refuse_daqmx("channel " + in_quotes(object.path));
      const auto dimension = cursor.number<std::uint32_t>();
      const auto count = cursor.number<std::uint64_t>();
      const std::uint64_t size = size_of(type);
      if (type == type_text) {
        object.bytes = cursor.number<std::uint64_t>();
      } else if (size == 0) {
        fail("channel " + in_quotes(object.path) + " holds numbers of the unknown type " + std::to_string(type) +
             ", expected integers, floating numbers or times");
      } else if (count > bytes_.size() / size) {
        throw BeyondTheEnd();
      } else {
        object.bytes = count * size;
      }
      if (dimension != 1) damaged(at, "has an array of " + std::to_string(dimension) + " dimensions");
      if (object.total > 0 && object.type != type) {
        fail("channel " + in_quotes(object.path) + " changes the type of its numbers, expected one");
      }
      object.type = type;
      object.count = count;
      object.known = true;
    }
    if (!object.known) damaged(at, "has channel " + in_quotes(object.path) + " as before, and there is none before");
    if (!object.in_list) list_.push_back(by_path_.find(object.path)->second);
    object.listed = object.in_list = true;
  }

  Property read_property(std::uint64_t at, ByteCursor& cursor, std::endian order) {
    const auto type = cursor.number<std::uint32_t>();
    if (type == type_text) return std::string(text_at(cursor));
    const std::uint64_t size = size_of(type);
    if (size == 0) damaged(at, "has a property of the unknown type " + std::to_string(type));
    const std::string_view value = cursor.take(size);
    if (type == type_time) return moment_at(value, 0, order);
    auto layout = layout_of(type);
    if (!layout) return std::string();
    layout->order = order;
    return value_at(value, 0, *layout);
  }

  void place_numbers(std::uint64_t segment, std::uint64_t at, std::uint64_t size, std::endian order, bool interleaved) {
    std::uint64_t chunk = 0;  // bytes
    std::uint64_t row = 0;    // bytes of one number of each
    const Object* first = nullptr;
    // Objects without numbers are left out, so that a segment takes no longer than its bytes do.
    std::erase_if(list_, [&](std::size_t k) {
      const bool none = !objects_[k].listed || objects_[k].bytes == 0;
      if (none) objects_[k].listed = objects_[k].in_list = false;
      return none;
    });
    for (const std::size_t k : list_) {
      const Object& object = objects_[k];
      if (object.bytes > size - chunk) damaged(segment, "has fewer bytes than its channels");
      chunk += object.bytes;
      row += size_of(object.type);
      if (!interleaved) continue;
      if (object.type == type_text) damaged(segment, "has texts interleaved");
      if (first == nullptr) first = &object;
      if (object.count != first->count) damaged(segment, "has channels of different lengths interleaved");
    }
    if (chunk == 0) damaged(segment, "has bytes that belong to no channel");
    if (size % chunk != 0) damaged(segment, "has bytes left behind its last chunk");
    for (std::uint64_t from = at; from < at + size; from += chunk) {
      std::uint64_t here = from;
      for (const std::size_t k : list_) {
        Object& object = objects_[k];
        const std::uint64_t stride = size_of(object.type);
        take_numbers(object, here, interleaved ? row : stride, order);
        here += interleaved ? stride : object.bytes;
      }
    }
  }

  static bool is_read(std::uint32_t type) { return type == type_time || layout_of(type).has_value(); }

  // A chunk of an object's numbers, `stride` bytes apart.
  void take_numbers(Object& object, std::uint64_t at, std::uint64_t stride, std::endian order) const {
    object.total += object.count;
    if (!is_read(object.type)) return;
    std::optional<NumberLayout> layout = layout_of(object.type);
    if (layout) layout->order = order;
    for (std::uint64_t i = 0; i < object.count; ++i, at += stride) {
      if (layout) {
        object.values.push_back(value_at(bytes_, at, *layout));
      } else {
        const Moment moment = moment_at(bytes_, at, order);
        if (!object.first) object.first = moment;
        object.values.push_back(between(*object.first, moment));
      }
    }
  }

  [[nodiscard]] static std::string text_property(const Object& object, const char* name) {
    const auto found = object.properties.find(name);
    const auto* text = found == object.properties.end() ? nullptr : std::get_if<std::string>(&found->second);
    return text == nullptr ? std::string() : *text;
  }

  [[nodiscard]] static std::optional<Moment> moment_property(const Object& object, const char* name) {
    const auto found = object.properties.find(name);
    const auto* moment = found == object.properties.end() ? nullptr : std::get_if<Moment>(&found->second);
    return moment == nullptr ? std::nullopt : std::optional(*moment);
  }

  // As LabVIEW and DIAdem write it.
  [[nodiscard]] std::optional<double> start_of_file() const {
    const auto root = by_path_.find("/");
    if (root == by_path_.end()) return std::nullopt;
    const Object& object = objects_[root->second];
    auto moment = moment_property(object, "DateTime");
    if (!moment) moment = moment_property(object, "datetime");
    return moment ? since_1970(*moment) : std::nullopt;
  }

  [[nodiscard]] static std::optional<double> number_property(const Object& object, const std::string& name) {
    const auto found = object.properties.find(name);
    const auto* number = found == object.properties.end() ? nullptr : std::get_if<double>(&found->second);
    return number == nullptr ? std::nullopt : std::optional(*number);
  }

  // The last of the scales of a channel that is stored unscaled; each takes the numbers or what one before gives.
  struct Scale {
    double slope = 1.0;
    double intercept = 0.0;
  };

  [[nodiscard]] Scale scale_of(const Object& object, const std::string& name) const {
    Scale total;
    const double count = number_property(object, "NI_Number_Of_Scales").value_or(0.0);
    if (!(count >= 1.0) || text_property(object, "NI_Scaling_Status") == "scaled") return total;
    double at = count - 1.0;
    for (double steps = 0.0; steps < count; ++steps) {
      const std::string prefix = "NI_Scale[" + std::to_string(static_cast<std::uint32_t>(std::min(at, 1e6))) + "]_";
      const std::string kind = text_property(object, (prefix + "Scale_Type").c_str());
      const auto slope = number_property(object, prefix + "Linear_Slope");
      const auto intercept = number_property(object, prefix + "Linear_Y_Intercept");
      if (kind != "Linear" || !slope || !intercept) {
        fail("channel " + name + " is stored unscaled with a scale " + in_quotes(kind.empty() ? "?" : kind) +
             ", expected a linear one, or numbers saved scaled");
      }
      total.intercept += total.slope * *intercept;
      total.slope *= *slope;
      const double source = number_property(object, prefix + "Linear_Input_Source").value_or(4294967295.0);
      if (source >= 4294967295.0) return total;
      if (!(source < at) || source < 0.0) break;
      at = source;
    }
    fail("channel " + name + " has scales that lead nowhere, expected a linear one");
  }

  std::string_view bytes_;
  std::string file_;
  std::vector<Object> objects_;
  std::map<std::string, std::size_t> by_path_;
  std::vector<std::size_t> list_;  // objects with numbers, in the order of their numbers
  std::optional<Moment> start_;    // of the first channel that has one
};

constexpr Ending endings[] = {{".tdms"}};

bool begins(std::string_view head) { return head.starts_with(tag); }

Recording parse(std::string_view bytes, const std::string& file, const ReadOptions& options) {
  TdmsReader reader(bytes, file);
  reader.read();
  std::vector<MeasuredChannel> channels;
  for (std::size_t k = 0; k < reader.count(); ++k) {
    auto channel = reader.channel(k);
    if (!channel) continue;
    channel->values = [&reader, k] { return reader.numbers_of(k); };
    channels.push_back(std::move(*channel));
  }
  Recording recording = recording_of(std::move(channels), file, options);
  if (recording.started && options.start_zone) options.start_zone(true);
  return recording;
}

}  // namespace

extern const InputFormat format_tdms;
const InputFormat format_tdms = {
    .name = "TDMS", .endings = endings, .begins = begins, .parse = parse, .samples = samples_by_size, .groups = true};

}  // namespace hysteron

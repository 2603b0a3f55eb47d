// Files of measuring programs, written byte by byte from the specifications of their formats.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hysteron::testing {

template <class T>
std::string bytes_of(T value, std::endian order = std::endian::little) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return bytes;
}

template <class T>
std::string bytes_of(const std::vector<T>& values, std::endian order = std::endian::little) {
  std::string bytes;
  for (const T value : values) bytes += bytes_of(value, order);
  return bytes;
}

inline std::string digits_of(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

// A channel as every format can hold it.
struct FileChannel {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

// Channels of one rate.
struct FileTable {
  double step = 0.0;  // s; times are k step
  std::vector<FileChannel> channels;

  [[nodiscard]] std::size_t rows() const { return channels.front().values.size(); }
  [[nodiscard]] double time(std::size_t k) const { return static_cast<double>(k) * step; }
};

inline std::string csv_of(const FileTable& table) {
  std::string text = "time [s]";
  for (const FileChannel& channel : table.channels) text += "," + channel.name + " [" + channel.unit + "]";
  text += '\n';
  for (std::size_t k = 0; k < table.rows(); ++k) {
    text += digits_of(table.time(k));
    for (const FileChannel& channel : table.channels) text += "," + digits_of(channel.values[k]);
    text += '\n';
  }
  return text;
}

// TDMS.
namespace tdms {

inline constexpr std::uint32_t metadata = 2, new_list = 4, numbers = 8, interleaved = 32, big_endian = 64, daqmx = 128;
inline constexpr std::uint32_t i16 = 2, i32 = 3, u8 = 5, f32 = 9, f64 = 10, text_type = 0x20, time_type = 0x44;

inline std::string text(std::string_view value, std::endian order = std::endian::little) {
  return bytes_of(static_cast<std::uint32_t>(value.size()), order) + std::string(value);
}
inline std::string property(std::string_view name, std::string_view value, std::endian order = std::endian::little) {
  return text(name, order) + bytes_of(text_type, order) + text(value, order);
}
inline std::string property(std::string_view name, double value, std::endian order = std::endian::little) {
  return text(name, order) + bytes_of(f64, order) + bytes_of(value, order);
}
inline std::string time_property(std::string_view name, std::int64_t seconds, std::uint64_t fraction) {
  return text(name) + bytes_of(time_type) + bytes_of(fraction) + bytes_of(seconds);
}
inline std::string index(std::uint32_t type, std::uint64_t count, std::endian order = std::endian::little) {
  return bytes_of(std::uint32_t{20}, order) + bytes_of(type, order) + bytes_of(std::uint32_t{1}, order) +
         bytes_of(count, order);
}
inline std::string no_numbers() { return bytes_of(std::uint32_t{0xFFFFFFFF}); }
inline std::string as_before() { return bytes_of(std::uint32_t{0}); }
inline std::string object(std::string_view path, const std::string& index, const std::vector<std::string>& properties,
                          std::endian order = std::endian::little) {
  std::string bytes = text(path, order) + index + bytes_of(static_cast<std::uint32_t>(properties.size()), order);
  for (const std::string& property : properties) bytes += property;
  return bytes;
}
inline std::string objects(const std::vector<std::string>& all, std::endian order = std::endian::little) {
  std::string bytes = bytes_of(static_cast<std::uint32_t>(all.size()), order);
  for (const std::string& object : all) bytes += object;
  return bytes;
}
inline std::string segment(std::uint32_t contents, const std::string& about, const std::string& data,
                           std::uint32_t version = 4713) {
  const std::endian order = (contents & big_endian) != 0 ? std::endian::big : std::endian::little;
  return "TDSm" + bytes_of(contents) + bytes_of(version, order) +
         bytes_of(std::uint64_t{about.size() + data.size()}, order) + bytes_of(std::uint64_t{about.size()}, order) +
         about + data;
}

// One segment, contiguous.
inline std::string file_of(const FileTable& table) {
  std::vector<std::string> all = {object("/", no_numbers(), {}), object("/'Test'", no_numbers(), {})};
  std::string data;
  for (const FileChannel& channel : table.channels) {
    all.push_back(object("/'Test'/'" + channel.name + "'", index(f64, channel.values.size()),
                         {property("unit_string", channel.unit), property("wf_increment", table.step),
                          property("wf_start_offset", 0.0)}));
    data += bytes_of(channel.values);
  }
  return segment(metadata | new_list | numbers, objects(all), data);
}

}  // namespace tdms

// MDF 4.
class Mdf4Writer {
 public:
  explicit Mdf4Writer(std::uint16_t version = 410, std::string_view kind = "MDF     ") {
    bytes_ = std::string(kind) + "4.10    hysteron" + std::string(4, '\0') + bytes_of(version) + std::string(34, '\0');
    header_ = block("HD", {0, 0, 0, 0, 0, 0}, std::string(32, '\0'));
  }

  std::uint64_t block(std::string_view id, const std::vector<std::uint64_t>& links, const std::string& data) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    const std::uint64_t at = bytes_.size();
    bytes_ += "##" + std::string(id) + std::string(4, '\0') +
              bytes_of(std::uint64_t{24 + 8 * links.size() + data.size()}) + bytes_of(std::uint64_t{links.size()}) +
              bytes_of(links) + data;
    return at;
  }
  std::uint64_t text(const std::string& value) { return block("TX", {}, value + '\0'); }
  std::uint64_t linear(double offset, double factor, std::uint64_t unit = 0) {
    return block("CC", {0, unit, 0, 0},
                 std::string("\x01\x00", 2) + bytes_of(std::uint16_t{0}) + bytes_of(std::uint16_t{0}) +
                     bytes_of(std::uint16_t{2}) + std::string(16, '\0') + bytes_of(offset) + bytes_of(factor));
  }
  struct Channel {
    std::string name = {};
    std::string unit = {};
    std::uint8_t kind = 0;    // 2: master
    std::uint8_t counts = 0;  // 1: time
    std::uint8_t type = 4;    // 4: floating, 2: signed, 0: unsigned, little-endian
    std::uint8_t bit = 0;
    std::uint32_t byte = 0;
    std::uint32_t bits = 64;
    std::uint64_t conversion = 0;
    std::uint32_t flags = 0;
    std::uint32_t invalid_bit = 0;
  };
  std::uint64_t channel(const Channel& c, std::uint64_t next) {
    const std::uint64_t name = text(c.name);
    const std::uint64_t unit = c.unit.empty() ? 0 : text(c.unit);
    return block("CN", {next, 0, name, 0, c.conversion, 0, unit, 0},
                 bytes_of(c.kind) + bytes_of(c.counts) + bytes_of(c.type) + bytes_of(c.bit) + bytes_of(c.byte) +
                     bytes_of(c.bits) + bytes_of(c.flags) + bytes_of(c.invalid_bit) + std::string(52, '\0'));
  }
  // Channels in a chain; gives the first.
  std::uint64_t chain(const std::vector<Channel>& channels) {
    std::uint64_t next = 0;
    for (auto c = channels.rbegin(); c != channels.rend(); ++c) next = channel(*c, next);
    return next;
  }
  std::uint64_t channel_group(const std::string& name, std::uint64_t channels, std::uint64_t count,
                              std::uint32_t data_bytes, std::uint32_t invalid_bytes = 0, std::uint64_t id = 0,
                              std::uint64_t next = 0) {
    return block(
        "CG", {next, channels, name.empty() ? 0 : text(name), 0, 0, 0},
        bytes_of(id) + bytes_of(count) + std::string(8, '\0') + bytes_of(data_bytes) + bytes_of(invalid_bytes));
  }
  // The last of the data groups is written first.
  void data_group(std::uint64_t channel_group, std::uint64_t data, std::uint8_t id_size = 0) {
    first_ = block("DG", {first_, channel_group, data, 0}, bytes_of(id_size) + std::string(7, '\0'));
  }
  std::uint64_t list(const std::vector<std::uint64_t>& data, std::uint64_t next = 0) {
    std::vector<std::uint64_t> links = {next};
    links.insert(links.end(), data.begin(), data.end());
    return block("DL", links,
                 std::string(4, '\0') + bytes_of(static_cast<std::uint32_t>(data.size())) +
                     bytes_of(std::vector<std::uint64_t>(data.size(), 0)));
  }
  // `packed` by zlib.
  std::uint64_t packed(std::uint8_t method, std::uint32_t columns, std::uint64_t size, const std::string& packed) {
    return block("DZ", {},
                 "DT" + bytes_of(method) + '\0' + bytes_of(columns) + bytes_of(size) +
                     bytes_of(std::uint64_t{packed.size()}) + packed);
  }
  // When the measurement was started, in ns since 1970; offsets in minutes.
  void start(std::uint64_t moment, std::int16_t time_zone, std::int16_t summer_time, std::uint8_t flags) {
    const std::string about = bytes_of(moment) + bytes_of(time_zone) + bytes_of(summer_time) + bytes_of(flags);
    bytes_.replace(header_ + 72, about.size(), about);
  }
  std::string bytes() {
    std::string result = bytes_;
    result.replace(header_ + 24, 8, bytes_of(first_));
    return result;
  }

 private:
  std::string bytes_;
  std::uint64_t header_ = 0;
  std::uint64_t first_ = 0;
};

// Records of doubles, the times first; sorted, in one DT block.
inline std::string mdf4_of(const FileTable& table) {
  Mdf4Writer writer;
  std::vector<Mdf4Writer::Channel> channels = {{.name = "t", .unit = "s", .kind = 2, .counts = 1}};
  std::uint32_t at = 8;
  for (const FileChannel& channel : table.channels) {
    channels.push_back({.name = channel.name, .unit = channel.unit, .byte = at});
    at += 8;
  }
  std::string records;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    records += bytes_of(table.time(k));
    for (const FileChannel& channel : table.channels) records += bytes_of(channel.values[k]);
  }
  const std::uint64_t data = writer.block("DT", {}, records);
  writer.data_group(writer.channel_group("Test", writer.chain(channels), table.rows(), at), data);
  return writer.bytes();
}

// RPC III.
namespace rpc3 {

using Entries = std::vector<std::pair<std::string, std::string>>;

inline std::string header_of(const std::string& format, const Entries& entries) {
  const std::size_t blocks = (entries.size() + 3 + 3) / 4;
  Entries all = {{"FORMAT", format},
                 {"NUM_HEADER_BLOCKS", std::to_string(blocks)},
                 {"NUM_PARAMS", std::to_string(entries.size() + 3)}};
  all.insert(all.end(), entries.begin(), entries.end());
  std::string bytes;
  for (const auto& [key, value] : all) {
    std::string entry = key;
    entry.resize(32);
    entry += value;
    entry.resize(128);
    bytes += entry;
  }
  bytes.resize(512 * blocks);
  return bytes;
}

inline Entries entries_of(const FileTable& table, std::size_t frame, std::size_t group, const std::string& type) {
  const std::size_t frames = (table.rows() + frame - 1) / frame;
  Entries entries = {{"FILE_TYPE", "TIME_HISTORY"},
                     {"TIME_TYPE", "RESPONSE"},
                     {"DELTA_T", digits_of(table.step)},
                     {"CHANNELS", std::to_string(table.channels.size())},
                     {"DATA_TYPE", type},
                     {"PTS_PER_FRAME", std::to_string(frame)},
                     {"PTS_PER_GROUP", std::to_string(group)},
                     {"FRAMES", std::to_string(frames)},
                     {"HALF_FRAMES", "0"},
                     {"INT_FULL_SCALE", "32752"},
                     {"SAMPLES", std::to_string(table.rows())}};
  for (std::size_t c = 0; c < table.channels.size(); ++c) {
    const std::string n = std::to_string(c + 1);
    entries.emplace_back("DESC.CHAN_" + n, table.channels[c].name);
    entries.emplace_back("UNITS.CHAN_" + n, table.channels[c].unit);
    entries.emplace_back("SCALE.CHAN_" + n, "0.25");
  }
  return entries;
}

// Groups of `group` points a channel, the last one filled with the last value. Integers are the values over 0.25.
inline std::string data_of(const FileTable& table, std::size_t group, bool integers,
                           std::endian order = std::endian::little) {
  std::string data;
  for (std::size_t first = 0; first < table.rows(); first += group) {
    for (const FileChannel& channel : table.channels) {
      for (std::size_t k = first; k < first + group; ++k) {
        const double value = channel.values[std::min(k, table.rows() - 1)];
        data += integers ? bytes_of(static_cast<std::int16_t>(value / 0.25), order)
                         : bytes_of(static_cast<float>(value), order);
      }
    }
  }
  return data;
}

// Of values that a float holds.
inline std::string file_of(const FileTable& table) {
  return header_of("BINARY_IEEE_LITTLE_END", entries_of(table, 32, 64, "FLOATING_POINT")) + data_of(table, 64, false);
}

}  // namespace rpc3

// A zip archive of files that are stored as they are.
inline std::string zip_of(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto checksum = [](std::string_view bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : bytes) {
      crc ^= static_cast<unsigned char>(c);
      for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
  };
  const auto two = [](std::size_t value) { return bytes_of(static_cast<std::uint16_t>(value)); };
  const auto four = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  std::string bytes;
  std::string directory;
  for (const auto& [path, content] : files) {
    // Version, flags, method (stored), time, date (1 January 1980), checksum, sizes, lengths of name and extra.
    const std::string about = two(20) + two(0) + two(0) + two(0) + two(0x21) + four(checksum(content)) +
                              four(content.size()) + four(content.size()) + two(path.size()) + two(0);
    directory += "PK\x01\x02" + two(20) + about + two(0) + two(0) + two(0) + four(0) + four(bytes.size()) + path;
    bytes += "PK\x03\x04" + about + path + content;
  }
  return bytes + directory + "PK\x05\x06" + two(0) + two(0) + two(files.size()) + two(files.size()) +
         four(directory.size()) + four(bytes.size()) + two(0);
}

// Parts of a workbook with one sheet after another, as <sheetData> of each.
inline std::vector<std::pair<std::string, std::string>> workbook_parts(
    const std::vector<std::pair<std::string, std::string>>& sheets) {
  const std::string head = R"(<?xml version="1.0" encoding="UTF-8" standalone="yes"?>)";
  const std::string office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
  const std::string package = "http://schemas.openxmlformats.org/package/2006/relationships";
  const std::string main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
  std::string list;
  std::string relations;
  std::vector<std::pair<std::string, std::string>> parts;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    const std::string n = std::to_string(k + 1);
    list += "<sheet name=\"" + sheets[k].first + "\" sheetId=\"" + n + "\" r:id=\"rId" + n + "\"/>";
    relations += "<Relationship Id=\"rId" + n + "\" Type=\"" + office + "/worksheet\" Target=\"worksheets/sheet" + n +
                 ".xml\"/>";
    parts.emplace_back("xl/worksheets/sheet" + n + ".xml", head + "<worksheet xmlns=\"" + main + "\"><sheetData>" +
                                                               sheets[k].second + "</sheetData></worksheet>");
  }
  parts.emplace_back("_rels/.rels", head + "<Relationships xmlns=\"" + package +
                                        "\"><Relationship Id=\"rId1\" Type=\"" + office +
                                        "/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>");
  parts.emplace_back("xl/workbook.xml", head + "<workbook xmlns=\"" + main + "\" xmlns:r=\"" + office + "\"><sheets>" +
                                            list + "</sheets></workbook>");
  parts.emplace_back("xl/_rels/workbook.xml.rels",
                     head + "<Relationships xmlns=\"" + package + "\">" + relations + "</Relationships>");
  return parts;
}

inline std::string cell(std::string_view text) {
  return "<c t=\"inlineStr\"><is><t>" + std::string(text) + "</t></is></c>";
}
inline std::string cell(double value) { return "<c><v>" + digits_of(value) + "</v></c>"; }

inline std::string sheet_of(const FileTable& table) {
  std::string rows = "<row>" + cell("time [s]");
  for (const FileChannel& channel : table.channels) rows += cell(channel.name + " [" + channel.unit + "]");
  rows += "</row>";
  for (std::size_t k = 0; k < table.rows(); ++k) {
    rows += "<row>" + cell(table.time(k));
    for (const FileChannel& channel : table.channels) rows += cell(channel.values[k]);
    rows += "</row>";
  }
  return rows;
}

inline std::string xlsx_of(const FileTable& table) { return zip_of(workbook_parts({{"Test", sheet_of(table)}})); }

}  // namespace hysteron::testing

// MDF files of version 4 (ASAM). Source: ASAM MDF 4.1 and 4.2, Programmers Guide; numbers are little-endian.
//
// 64 bytes of identification, then blocks: "##", two letters, four bytes, the length, the number of links, the links
// (places of other blocks), data. The header block leads to the data groups (DG), each to its data and its channel
// groups (CG), each of these to its channels (CN), each to its name, its unit and its conversion (CC). A sorted data
// group has one channel group, whose records lie one behind the other in one block of data (DT, DV, DZ packed by zlib)
// or in a list of them (DL, HL, LD). A channel says where in a record its number lies.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "io/bytes.hpp"
#include "io/clock_time.hpp"
#include "io/format.hpp"
#include "io/measured.hpp"
#include "io/text.hpp"
#include "io/xml.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t identification = 64;  // bytes
constexpr std::uint64_t block_head = 24;
// Of all records of a file, unpacked. Far above any recording.
constexpr std::uint64_t most_unpacked = std::uint64_t{4} << 30U;
// zlib packs at most so many bytes into one.
constexpr std::uint64_t most_packing = 1032;

struct Block {
  std::uint64_t at = 0;
  std::string_view id;  // "DG"
  std::string_view links;
  std::string_view data;

  [[nodiscard]] std::size_t link_count() const { return links.size() / 8; }
  // Zero where it leads nowhere or is not there, as in files of older versions.
  [[nodiscard]] std::uint64_t link(std::size_t k) const {
    return k < link_count() ? number_at<std::uint64_t>(links, 8 * k) : 0;
  }
};

// Kinds of channels.
constexpr std::uint8_t fixed_length = 0;
constexpr std::uint8_t master = 2;
constexpr std::uint8_t virtual_master = 3;
constexpr std::uint8_t synchronisation = 4;
constexpr std::uint8_t virtual_data = 6;
// What a master counts.
constexpr std::uint8_t counts_time = 1;

// y = (p1 x^2 + p2 x + p3) / (p4 x^2 + p5 x + p6); linear where the denominator is one.
struct Conversion {
  double p1 = 0.0, p2 = 1.0, p3 = 0.0;
  double p4 = 0.0, p5 = 0.0, p6 = 1.0;
  [[nodiscard]] double of(double x) const {
    if (p1 == 0.0 && p4 == 0.0 && p5 == 0.0 && p6 == 1.0) return p2 == 1.0 && p3 == 0.0 ? x : p3 + p2 * x;
    return ((p1 * x + p2) * x + p3) / ((p4 * x + p5) * x + p6);
  }
};

// The records of a channel group.
struct Records {
  std::string_view bytes;
  std::string unpacked;       // what `bytes` shows, where it is not the file itself
  std::uint64_t id_size = 0;  // bytes before each record
  std::uint64_t stride = 0;
  std::uint64_t count = 0;
  std::uint64_t invalidation_at = 0;  // in a record, behind its identification
  std::uint64_t invalidation_size = 0;
};

struct Channel {
  std::string name;
  std::string group;
  std::string unit;
  std::uint8_t kind = 0;
  std::uint8_t counts = 0;
  std::uint8_t type = 0;  // of its numbers
  std::uint8_t bit = 0;
  std::uint32_t byte = 0;
  std::uint32_t bits = 0;
  bool may_be_invalid = false;
  std::uint32_t invalid_bit = 0;
  Conversion conversion;
  std::string refusal;  // why it is not read
  std::size_t records = 0;
};

class Mdf4Reader {
 public:
  Mdf4Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  std::vector<MeasuredChannel> run() {
    try {
      check_identification();
      const Block header = block(identification, "HD");
      start_ = start_of(header);
      if (start_) utc_ = (number_at<std::uint8_t>(header.data, 12) & (is_local | offsets_are_valid)) == 0;
      read_groups(header.link(0));
    } catch (const BeyondTheEnd&) {
      fail("names bytes that are not there, the file is cut off or damaged, expected a complete MDF file");
    }
    return measured();
  }

  // Whether the start is in UTC.
  [[nodiscard]] bool tells_utc() const { return utc_; }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }
  [[noreturn]] void damaged(const std::string& what) const {
    fail(what + ", the file is damaged, expected a complete MDF file");
  }

  void check_identification() const {
    const std::string_view kind = bytes_at(bytes_, 0, 8);
    if (kind == "UnFinMF ") {
      fail("was never finished by the program that wrote it, expected a finished MDF file: open and save it there");
    }
    if (kind != "MDF     ") fail("does not begin with MDF, expected an MDF file of version 4");
    const auto version = number_at<std::uint16_t>(bytes_, 28);
    if (version < 400 || version >= 500) {
      fail("MDF of version " + std::string(trimmed(printable_version())) + ", expected version 4: save it as MDF 4");
    }
  }

  [[nodiscard]] std::string printable_version() const {
    std::string text(bytes_at(bytes_, 8, 8));
    std::ranges::replace_if(
        text, [](char c) { return c < ' ' || c > '~'; }, ' ');
    return text;
  }

  // A block at a place; `id` empty: of any kind.
  [[nodiscard]] Block block(std::uint64_t at, std::string_view id) const {
    const std::string_view head = bytes_at(bytes_, at, block_head);
    const auto length = number_at<std::uint64_t>(head, 8);
    const auto links = number_at<std::uint64_t>(head, 16);
    if (!head.starts_with("##") || length < block_head || links > (length - block_head) / 8) {
      damaged("no block at byte " + std::to_string(at));
    }
    const std::string_view body = bytes_at(bytes_, at, length).substr(block_head);
    const Block result{at, head.substr(2, 2), body.substr(0, 8 * links), body.substr(8 * links)};
    if (!id.empty() && result.id != id) {
      damaged("a block " + in_quotes(result.id) + " at byte " + std::to_string(at) + " where " + std::string(id) +
              " belongs");
    }
    return result;
  }

  // A block that nothing else leads to: no circles, and no bytes read more often than they are there.
  Block block_once(std::uint64_t at, std::string_view id) {
    if (!seen_.insert(at).second) damaged("two links to the block at byte " + std::to_string(at));
    return block(at, id);
  }

  // A text block, or the text of a comment in XML, its first 256 bytes; empty where there is none.
  [[nodiscard]] std::string text_at(std::uint64_t at) const {
    constexpr std::size_t most = 256;
    return whole_text_at(at).substr(0, most);
  }

  [[nodiscard]] std::string whole_text_at(std::uint64_t at) const {
    constexpr std::size_t longest = 4096;
    if (at == 0) return {};
    const Block found = block(at, {});
    const std::string_view text = found.data.substr(0, std::min(found.data.find('\0'), found.data.size()));
    if (text.size() > longest) return {};
    if (found.id == "TX") return std::string(trimmed(text));
    if (found.id != "MD") damaged("a block " + in_quotes(found.id) + " where a text belongs");
    std::string result;
    bool inside = false;
    bool done = false;
    XmlEvents events;
    events.begin = [&](std::string_view name, const XmlAttributes& /*attributes*/) { inside = !done && name == "TX"; };
    events.end = [&](std::string_view name) {
      done = done || name == "TX";
      inside = false;
    };
    events.text = [&](std::string_view piece) {
      if (inside) result += piece;
    };
    try {
      XmlReader reader(std::move(events));
      reader.add(text);
      reader.finish();
    } catch (const XmlDamage&) {
      return {};  // a comment
    }
    return std::string(trimmed(result));
  }

  static constexpr unsigned is_local = 1;
  static constexpr unsigned offsets_are_valid = 2;

  // The moment from which the time masters count. It is told in UTC or local time. Local time is taken where it is
  // known, as the clock on the wall that a start in a text names; else UTC.
  [[nodiscard]] static std::optional<double> start_of(const Block& header) {
    constexpr std::size_t size = 13;  // bytes that tell it
    constexpr std::uint64_t nanoseconds = 1'000'000'000;
    if (header.data.size() < size) return std::nullopt;
    const auto moment = number_at<std::uint64_t>(header.data, 0);
    if (moment == 0) return std::nullopt;
    double start = static_cast<double>(moment / nanoseconds) + 1e-9 * static_cast<double>(moment % nanoseconds);
    const auto flags = number_at<std::uint8_t>(header.data, 12);
    if ((flags & is_local) == 0 && (flags & offsets_are_valid) != 0) {
      // Of the time zone and of summer time, in minutes.
      start += 60.0 * number_at<std::int16_t>(header.data, 8) + 60.0 * number_at<std::int16_t>(header.data, 10);
    }
    return clock_time(start);
  }

  void read_groups(std::uint64_t at) {
    for (std::size_t number = 1; at != 0; ++number) {
      const Block group = block_once(at, "DG");
      at = group.link(0);
      const auto id_size = number_at<std::uint8_t>(group.data, 0);
      if (group.link(1) == 0) continue;
      const Block records = block_once(group.link(1), "CG");
      const auto count = number_at<std::uint64_t>(records.data, 8);
      const bool several = records.link(0) != 0;
      if (several) {
        // Empty groups beside the one with records do no harm.
        if (id_size == 0) damaged("several channel groups without identification of their records");
        fail("data group " + std::to_string(number) +
             " is unsorted (records of several channel groups follow one another), expected a sorted file: save it "
             "sorted");
      }
      if (count == 0) continue;
      read_group(number, group, records, id_size, count);
    }
  }

  void read_group(std::size_t number, const Block& group, const Block& cg, std::uint8_t id_size, std::uint64_t count) {
    const std::string where = "channel group " + std::to_string(number);
    const auto flags = number_at<std::uint16_t>(cg.data, 16);
    if ((flags & 1U) != 0) return;  // of values of variable length
    if ((flags & 8U) != 0) fail(where + " keeps its times in another group, which is not read, expected its own");
    const auto data_bytes = number_at<std::uint32_t>(cg.data, 24);
    const auto invalid_bytes = number_at<std::uint32_t>(cg.data, 28);
    if (id_size != 0 && id_size != 1 && id_size != 2 && id_size != 4 && id_size != 8) {
      damaged(where + " identifies its records by " + std::to_string(id_size) + " bytes");
    }
    auto records = std::make_unique<Records>();
    records->id_size = id_size;
    records->stride = std::uint64_t{id_size} + data_bytes + invalid_bytes;
    records->count = count;
    records->invalidation_at = data_bytes;
    records->invalidation_size = invalid_bytes;
    if (data_bytes == 0) return;  // nothing that was measured
    read_records(group.link(2), *records, where);
    if (records->bytes.size() / records->stride != count || records->bytes.size() % records->stride != 0) {
      damaged(where + " tells of " + std::to_string(count) + " records of " + std::to_string(records->stride) +
              " bytes and has " + std::to_string(records->bytes.size()) + " bytes");
    }
    check_identifications(*records, number_at<std::uint64_t>(cg.data, 0), where);
    std::string name = text_at(cg.link(2));
    if (name.empty()) name = std::to_string(number);
    const std::size_t first = channels_.size();
    // Bits of a record; more channels would read it again and again.
    const std::uint64_t most = 8 * (std::uint64_t{data_bytes} + invalid_bytes) + 1;
    for (std::uint64_t at = cg.link(1); at != 0;) {
      const Block cn = block_once(at, "CN");
      at = cn.link(0);
      if (channels_.size() - first == most) damaged(where + " has more channels than its records have bits");
      channels_.push_back(read_channel(cn, data_bytes));
      channels_.back().group = name;
      channels_.back().records = records_.size();
    }
    records_.push_back(std::move(records));
  }

  void check_identifications(const Records& records, std::uint64_t id, const std::string& where) const {
    if (records.id_size == 0) return;
    const NumberLayout layout{NumberLayout::Kind::unsigned_integer, static_cast<std::uint8_t>(records.id_size), {}};
    for (std::uint64_t k = 0; k < records.count; ++k) {
      if (value_at(records.bytes, k * records.stride, layout) != static_cast<double>(id)) {
        damaged(where + " has a record of another group");
      }
    }
  }

  // Bytes of a data block, or of a list of them.
  void read_records(std::uint64_t at, Records& records, const std::string& where) {
    if (at == 0) damaged(where + " has no data");
    Block data = block_once(at, {});
    if (data.id == "HL") data = block_once(data.link(0), {});
    if (data.id == "DT" || data.id == "DV") {
      records.bytes = data.data;
      return;
    }
    if (data.id == "DZ") {
      unpack(data, records.unpacked);
    } else if (data.id == "DL" || data.id == "LD") {
      read_list(data, records.unpacked);
    } else {
      fail(where + " keeps its data in a block " + in_quotes(data.id) + ", expected DT, DV, DZ, DL, HL or LD");
    }
    records.bytes = records.unpacked;
  }

  void read_list(Block list, std::string& to) {
    for (;;) {
      const bool columns = list.id == "LD";
      // Lists with times have more links behind those of the data.
      const auto flags = number_at<std::uint32_t>(list.data, 0);
      if (columns && (flags & 0x80000000U) != 0) {
        fail("values marked invalid are kept in blocks of their own, which are not read, expected them in the records");
      }
      const auto count = number_at<std::uint32_t>(list.data, 4);
      if (count > list.link_count() - std::min<std::size_t>(1, list.link_count())) {
        damaged("a list of data shorter than it says");
      }
      for (std::size_t k = 1; k <= count; ++k) {
        if (list.link(k) == 0) continue;
        const Block data = block_once(list.link(k), {});
        if (data.id == "DZ") {
          unpack(data, to);
        } else if (data.id == "DT" || data.id == "DV") {
          take_room(data.data.size());
          to += data.data;
        } else {
          fail("a list of data has a block " + in_quotes(data.id) + ", expected DT, DV or DZ");
        }
      }
      if (list.link(0) == 0) return;
      list = block_once(list.link(0), columns ? "LD" : "DL");
    }
  }

  void take_room(std::uint64_t count) {
    if (count > most_unpacked - unpacked_) fail("unpacks to more than 4 GiB, expected a smaller file");
    unpacked_ += count;
  }

  void unpack(const Block& packed, std::string& to) {
    const std::string_view kind = bytes_at(packed.data, 0, 2);
    const auto method = number_at<std::uint8_t>(packed.data, 2);
    const auto columns = number_at<std::uint32_t>(packed.data, 4);
    const auto size = number_at<std::uint64_t>(packed.data, 8);
    const std::string_view bytes = bytes_at(packed.data, 24, number_at<std::uint64_t>(packed.data, 16));
    if (kind != "DT" && kind != "DV") fail("packed data of the kind " + in_quotes(kind) + ", expected DT or DV");
    if (method > 1) fail("data packed by method " + std::to_string(method) + ", expected zlib, 0 or 1");
    if (size / most_packing > bytes.size()) damaged("packed data that cannot hold what they say");
    take_room(size);
    std::string plain(static_cast<std::size_t>(size), '\0');
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    // zlib takes its input by a pointer to non-const and does not write to it. It counts in 32 bits.
    int status = Z_OK;
    std::size_t in = 0;
    std::size_t out = 0;
    constexpr std::size_t step = std::size_t{1} << 30U;
    while (status == Z_OK) {
      const std::size_t in_now = std::min(step, bytes.size() - in);
      const std::size_t out_now = std::min(step, plain.size() - out);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + in));
      stream.avail_in = static_cast<uInt>(in_now);
      stream.next_out = reinterpret_cast<Bytef*>(plain.data() + out);
      stream.avail_out = static_cast<uInt>(out_now);
      status = inflate(&stream, Z_NO_FLUSH);
      in += in_now - stream.avail_in;
      out += out_now - stream.avail_out;
    }
    inflateEnd(&stream);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status != Z_STREAM_END || out != plain.size()) damaged("packed data that cannot be unpacked");
    if (method == 0) {
      to += plain;
      return;
    }
    // Whole records were laid down column by column; what is left over stands behind them.
    const std::uint64_t rows = columns == 0 ? 0 : size / columns;
    const std::size_t before = to.size();
    to.resize(before + plain.size());
    for (std::uint64_t c = 0; c < columns && rows > 0; ++c) {
      for (std::uint64_t r = 0; r < rows; ++r) to[before + r * columns + c] = plain[c * rows + r];
    }
    std::ranges::copy(std::string_view(plain).substr(rows * columns),
                      to.begin() + static_cast<std::ptrdiff_t>(before + rows * columns));
  }

  Channel read_channel(const Block& cn, std::uint32_t data_bytes) const {
    Channel channel;
    channel.name = text_at(cn.link(2));
    channel.kind = number_at<std::uint8_t>(cn.data, 0);
    channel.counts = number_at<std::uint8_t>(cn.data, 1);
    channel.type = number_at<std::uint8_t>(cn.data, 2);
    channel.bit = number_at<std::uint8_t>(cn.data, 3);
    channel.byte = number_at<std::uint32_t>(cn.data, 4);
    channel.bits = number_at<std::uint32_t>(cn.data, 8);
    const auto flags = number_at<std::uint32_t>(cn.data, 12);
    channel.invalid_bit = number_at<std::uint32_t>(cn.data, 16);
    channel.may_be_invalid = (flags & 2U) != 0;
    if ((flags & 1U) != 0) channel.refusal = "is marked invalid as a whole, expected values";
    channel.unit = text_at(cn.link(6));
    if (cn.link(1) != 0) channel.refusal = "is an array or a structure, expected numbers";
    const bool is_virtual = channel.kind == virtual_master || channel.kind == virtual_data;
    if (channel.kind != fixed_length && channel.kind != master && channel.kind != synchronisation && !is_virtual) {
      channel.refusal = "is of variable length, expected numbers";
    }
    if (!is_virtual) check_place(channel, data_bytes);
    if (cn.link(4) != 0) read_conversion(block(cn.link(4), "CC"), channel);
    return channel;
  }

  // That the number of a channel lies in the record and is one that is read.
  void check_place(Channel& channel, std::uint32_t data_bytes) const {
    const auto refuse = [&](const std::string& why) {
      if (channel.refusal.empty()) channel.refusal = why;
    };
    if (channel.type > 5) return refuse("holds no real numbers (type " + std::to_string(channel.type) + ")");
    const bool floating = channel.type >= 4;
    if (floating && ((channel.bits != 32 && channel.bits != 64) || channel.bit != 0)) {
      return refuse("holds floating numbers of " + std::to_string(channel.bits) + " bits, expected 32 or 64");
    }
    if (channel.bits == 0 || channel.bits > 64 || channel.bit > 7 || channel.bits + channel.bit > 64) {
      return refuse("holds integers of " + std::to_string(channel.bits) + " bits from bit " +
                    std::to_string(channel.bit) + " on, expected 1 to 64 in 8 bytes");
    }
    const std::uint64_t bytes = (channel.bits + channel.bit + 7U) / 8U;
    if (std::uint64_t{channel.byte} + bytes > data_bytes) {
      damaged("channel " + in_quotes(channel.name) + " lies behind the end of its records");
    }
  }

  void read_conversion(const Block& cc, Channel& channel) const {
    // ASAM MDF: the unit of the conversion is that of channels without one.
    if (channel.unit.empty()) channel.unit = text_at(cc.link(1));
    const auto kind = number_at<std::uint8_t>(cc.data, 0);
    const auto count = number_at<std::uint16_t>(cc.data, 6);
    const auto value = [&](std::uint64_t k) {
      if (k >= count) damaged("a conversion of " + in_quotes(channel.name) + " with too few numbers");
      return number_at<double>(cc.data, 24 + 8 * k);
    };
    Conversion& conversion = channel.conversion;
    if (kind == 1) {
      conversion.p3 = value(0);
      conversion.p2 = value(1);
    } else if (kind == 2) {
      conversion = {value(0), value(1), value(2), value(3), value(4), value(5)};
    } else if (kind != 0 && channel.refusal.empty()) {
      channel.refusal = "is converted by a table or a formula (kind " + std::to_string(kind) +
                        "), expected a linear or rational conversion";
    }
  }

  [[nodiscard]] std::vector<double> numbers_of(const Channel& channel) const {
    const std::string name = in_quotes(channel.name);
    if (!channel.refusal.empty()) fail("channel " + name + " " + channel.refusal);
    const Records& records = *records_[channel.records];
    std::vector<double> values(static_cast<std::size_t>(records.count));
    const bool is_virtual = channel.kind == virtual_master || channel.kind == virtual_data;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const std::string_view record =
          records.bytes.substr(k * records.stride + records.id_size, records.stride - records.id_size);
      if (channel.may_be_invalid && is_invalid(channel, records, record)) {
        fail("value " + std::to_string(k + 1) + " of " + name + " is marked invalid, expected a number");
      }
      const double raw = is_virtual ? static_cast<double>(k) : number_of(channel, record);
      values[k] = channel.conversion.of(raw);
    }
    return values;
  }

  [[nodiscard]] bool is_invalid(const Channel& channel, const Records& records, std::string_view record) const {
    if (channel.invalid_bit / 8 >= records.invalidation_size) {
      damaged("channel " + in_quotes(channel.name) + " has its mark behind the end of its records");
    }
    const auto byte = static_cast<unsigned char>(record[records.invalidation_at + channel.invalid_bit / 8]);
    return ((byte >> (channel.invalid_bit % 8)) & 1U) != 0;
  }

  static double number_of(const Channel& channel, std::string_view record) {
    const std::endian order = channel.type % 2 == 0 ? std::endian::little : std::endian::big;
    if (channel.type >= 4) {
      return value_at(record, channel.byte,
                      {NumberLayout::Kind::floating, static_cast<std::uint8_t>(channel.bits / 8), order});
    }
    const std::string_view bytes = record.substr(channel.byte, (channel.bits + channel.bit + 7U) / 8U);
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t from = order == std::endian::big ? i : bytes.size() - 1 - i;
      word = word << 8U | static_cast<unsigned char>(bytes[from]);
    }
    word >>= channel.bit;
    if (channel.bits < 64) word &= (std::uint64_t{1} << channel.bits) - 1;
    const bool is_signed = channel.type == 2 || channel.type == 3;
    if (!is_signed) return static_cast<double>(word);
    if (channel.bits < 64 && (word >> (channel.bits - 1)) != 0) word |= ~std::uint64_t{0} << channel.bits;
    return static_cast<double>(std::bit_cast<std::int64_t>(word));
  }

  [[nodiscard]] std::vector<MeasuredChannel> measured() const {
    // Groups of one name are told apart, as the channels of one are.
    std::map<std::string, std::set<std::size_t>> of_name;
    for (const Channel& channel : channels_) of_name[channel.group].insert(channel.records);
    std::map<std::size_t, std::size_t> master_of;  // records -> channel
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const Channel& channel = channels_[k];
      if ((channel.kind == master || channel.kind == virtual_master) && channel.counts == counts_time) {
        master_of.emplace(channel.records, k);
      }
    }
    std::vector<MeasuredChannel> result;
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const Channel& channel = channels_[k];
      MeasuredChannel one;
      one.group = channel.group;
      if (of_name[channel.group].size() > 1) one.group += " (" + std::to_string(channel.records + 1) + ")";
      one.name = channel.name;
      one.unit = channel.unit;
      one.count = static_cast<std::size_t>(records_[channel.records]->count);
      one.values = [this, k] { return numbers_of(channels_[k]); };
      if (const auto found = master_of.find(channel.records); found != master_of.end()) {
        if (found->second == k) one.epoch = start_;
        if (found->second != k) one.times = found->second;
      }
      result.push_back(std::move(one));
    }
    return result;
  }

  std::string_view bytes_;
  const std::string& file_;
  std::set<std::uint64_t> seen_;  // places of blocks
  std::uint64_t unpacked_ = 0;    // bytes
  std::optional<double> start_;   // of the measurement, s since 1970
  bool utc_ = false;              // it is in UTC, else in local time
  std::vector<std::unique_ptr<Records>> records_;
  std::vector<Channel> channels_;
};

constexpr Ending endings[] = {{".mf4"}, {".mdf", InFolders::none}};

bool begins(std::string_view head) { return head.starts_with("MDF     ") || head.starts_with("UnFinMF "); }

Recording parse(std::string_view bytes, const std::string& file, const ReadOptions& options) {
  Mdf4Reader reader(bytes, file);
  Recording recording = recording_of(reader.run(), file, options);
  if (recording.started && options.start_zone) options.start_zone(reader.tells_utc());
  return recording;
}

}  // namespace

extern const InputFormat format_mdf4;
const InputFormat format_mdf4 = {
    .name = "MDF 4", .endings = endings, .begins = begins, .parse = parse, .samples = samples_by_size, .groups = true};

}  // namespace hysteron

// A workbook as an archive: parts of XML, which name each other. Source: ECMA-376, part 2.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/xml.hpp"

struct zip;

namespace hysteron::workbook {

inline constexpr std::uint64_t largest_part = std::uint64_t{2} << 30U;  // bytes, unpacked

// A part of a workbook that is not what it should be, without the name of the file.
class Damage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A zip archive in memory, which outlives it. What unpacks to more than a recording does is refused.
class Archive {
 public:
  explicit Archive(std::string_view bytes);
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // The XML of a part, told in pieces. Throws Damage, or XmlDamage.
  void read(const std::string& path, XmlEvents events);

 private:
  zip* archive_ = nullptr;
  std::uint64_t room_;  // bytes that may still be unpacked
};

struct Relation {
  std::string id;
  std::string type;
  std::string target;  // a path in the archive
};

// What a part relates to; `part` empty: what the archive does.
std::vector<Relation> relations_of(Archive& archive, const std::string& part);

// Attributes as numbers, nothing where they are none, and as truths.
std::optional<std::uint32_t> whole(std::string_view attribute);
bool is_true(std::string_view attribute);

}  // namespace hysteron::workbook

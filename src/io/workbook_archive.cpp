#include "io/workbook_archive.hpp"

#include <zip.h>

#include <charconv>
#include <memory>
#include <new>

#include "io/text.hpp"

namespace hysteron::workbook {
namespace {

// Sheets of measured numbers shrink to a fifth or a tenth. What grows more than this is no recording.
constexpr std::uint64_t most_growth = 100;
constexpr std::uint64_t growth_allowed = std::uint64_t{1} << 20U;  // bytes that may grow by any factor

// "xl/workbook.xml" and "worksheets/sheet1.xml" -> "xl/worksheets/sheet1.xml"; a target that begins with a slash counts
// from the archive.
std::string resolved(std::string_view part, std::string_view target) {
  if (target.starts_with('/')) return std::string(target.substr(1));
  std::string folder(part.substr(0, part.rfind('/') == std::string_view::npos ? 0 : part.rfind('/') + 1));
  while (target.starts_with("../") && !folder.empty()) {
    target.remove_prefix(3);
    folder.pop_back();
    folder.resize(folder.rfind('/') == std::string::npos ? 0 : folder.rfind('/') + 1);
  }
  return folder + std::string(target);
}

}  // namespace

Archive::Archive(std::string_view bytes) : room_(growth_allowed + most_growth * bytes.size()) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) throw std::bad_alloc();
  archive_ = zip_open_from_source(source, ZIP_RDONLY, &error);
  zip_error_fini(&error);
  if (archive_ == nullptr) {
    zip_source_free(source);
    throw Damage("the zip archive cannot be opened, the file is cut off or damaged");
  }
}

Archive::~Archive() { zip_discard(archive_); }

void Archive::read(const std::string& path, XmlEvents events) {
  const zip_int64_t index = zip_name_locate(archive_, path.c_str(), ZIP_FL_ENC_RAW);
  zip_stat_t stat;
  zip_stat_init(&stat);
  constexpr zip_uint64_t needed =
      ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
  if (index < 0 || zip_stat_index(archive_, static_cast<zip_uint64_t>(index), 0, &stat) != 0 ||
      (stat.valid & needed) != needed) {
    throw Damage("it has no part " + in_quotes(path) + ", the file is damaged");
  }
  if (stat.encryption_method != ZIP_EM_NONE) throw Damage("it is encrypted");
  if (stat.comp_method != ZIP_CM_STORE && stat.comp_method != ZIP_CM_DEFLATE) {
    throw Damage("its part " + in_quotes(path) + " is packed by method " + std::to_string(stat.comp_method));
  }
  if (stat.size > largest_part || stat.size > growth_allowed + most_growth * stat.comp_size) {
    throw Damage("its part " + in_quotes(path) + " of " + std::to_string(stat.comp_size) + " bytes unpacks to " +
                 std::to_string(stat.size) + ", which no recording does");
  }
  // Parts may be made of the same bytes.
  if (stat.size > room_)
    throw Damage("its parts unpack to more than a hundred times its size, which no recording does");
  room_ -= stat.size;
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(archive_, static_cast<zip_uint64_t>(index), 0), zip_fclose);
  if (!file) throw Damage("its part " + in_quotes(path) + " cannot be unpacked, the file is damaged");
  XmlReader reader(std::move(events));
  std::string piece(std::size_t{1} << 16U, '\0');
  zip_uint64_t total = 0;
  for (;;) {
    const zip_int64_t got = zip_fread(file.get(), piece.data(), piece.size());
    // The checksum of a part is found wrong at its end.
    if (got < 0 || (total += static_cast<zip_uint64_t>(got)) > stat.size || (got == 0 && total != stat.size)) {
      throw Damage("its part " + in_quotes(path) + " cannot be unpacked, the file is damaged");
    }
    if (got == 0) break;
    reader.add(std::string_view(piece).substr(0, static_cast<std::size_t>(got)));
  }
  reader.finish();
}

std::vector<Relation> relations_of(Archive& archive, const std::string& part) {
  const std::size_t slash = part.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : part.substr(0, slash + 1);
  const std::string name = slash == std::string::npos ? part : part.substr(slash + 1);
  std::vector<Relation> relations;
  XmlEvents events;
  events.begin = [&](std::string_view element, const XmlAttributes& attributes) {
    if (element != "Relationship" || attribute(attributes, "TargetMode") == "External") return;
    relations.push_back({std::string(attribute(attributes, "Id")), std::string(attribute(attributes, "Type")),
                         resolved(part, attribute(attributes, "Target"))});
  };
  archive.read(folder + "_rels/" + name + ".rels", std::move(events));
  return relations;
}

std::optional<std::uint32_t> whole(std::string_view attribute) {
  std::uint32_t value = 0;
  const auto read = std::from_chars(attribute.data(), attribute.data() + attribute.size(), value);
  if (read.ec != std::errc() || read.ptr != attribute.data() + attribute.size()) return std::nullopt;
  return value;
}

bool is_true(std::string_view attribute) { return attribute == "1" || attribute == "true"; }

}  // namespace hysteron::workbook

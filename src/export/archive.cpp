#include "export/archive.hpp"

#include <zip.h>

#include "core/error.hpp"

namespace hysteron {
namespace {

constexpr zip_uint16_t first_of_january_1980 = 0x21;

[[noreturn]] void fail(const std::string& what) { throw WorkError("the zip archive could not be made: " + what); }

}  // namespace

std::string zip_of(const std::map<std::string, std::string>& files) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* memory = zip_source_buffer_create(nullptr, 0, 0, &error);
  if (memory == nullptr) {
    fail(zip_error_strerror(&error));
  }
  zip_source_keep(memory);
  zip_t* archive = zip_open_from_source(memory, ZIP_TRUNCATE, &error);
  if (archive == nullptr) {
    zip_source_free(memory);
    fail(zip_error_strerror(&error));
  }
  for (const auto& [path, bytes] : files) {
    zip_source_t* file = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index =
        file == nullptr ? -1 : zip_file_add(archive, path.c_str(), file, ZIP_FL_ENC_UTF_8 | ZIP_FL_OVERWRITE);
    if (index < 0) {
      const std::string reason = zip_strerror(archive);
      zip_source_free(file);
      zip_discard(archive);
      zip_source_free(memory);
      fail(reason);
    }
    zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, first_of_january_1980, 0);
  }
  if (zip_close(archive) != 0) {
    const std::string reason = zip_strerror(archive);
    zip_discard(archive);
    zip_source_free(memory);
    fail(reason);
  }
  zip_stat_t stat;
  zip_stat_init(&stat);
  std::string result;
  const bool read = zip_source_stat(memory, &stat) == 0 && zip_source_open(memory) == 0;
  if (read) {
    result.resize(stat.size);
    const zip_int64_t count = zip_source_read(memory, result.data(), stat.size);
    zip_source_close(memory);
    if (count < 0 || static_cast<zip_uint64_t>(count) != stat.size) {
      result.clear();
    }
  }
  zip_source_free(memory);
  if (result.empty()) {
    fail("it cannot be read back");
  }
  return result;
}

}  // namespace hysteron

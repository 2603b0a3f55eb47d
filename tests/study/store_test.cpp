// The store: what goes in comes out, damage is found, one writer at a time.
#include "study/store.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "core/error.hpp"
#include "io/sha256.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

RunRecord record(int k) {
  RunRecord result;
  result.config = "{\"seed\":" + std::to_string(k) + "}";
  result.key = sha256_hex(result.config);
  result.nrmse = 0.1 / (k + 1);
  result.evaluations = 100;
  result.stopped = "budget";
  result.best = {0.25, 1.0 / 3.0};
  result.parameters = "{\"c0\":1.5}";
  result.trace = {{1, 0.5}, {7, 0.1 / (k + 1)}};
  return result;
}

void fill(const fs::path& folder, int count) {
  Store store = Store::open(folder, Store::Mode::write);
  store.set_plan("{}");
  for (int k = 0; k < count; ++k) store.add(record(k), {record(k).key, 0.1, "host", 2, 1});
}

std::string message(const std::function<void()>& work) { return testing::message_of<InputError>(work); }

TEST(Store, GivesBackWhatItTook) {
  const TemporaryFolder folder;
  fill(folder.path(), 3);
  const Store store = Store::open(folder.path(), Store::Mode::read);
  const auto records = store.records();
  ASSERT_EQ(records.size(), 3U);
  EXPECT_TRUE(records[0].key < records[1].key && records[1].key < records[2].key);
  for (const RunRecord& found : records) {
    bool same = false;
    for (int k = 0; k < 3; ++k) same = same || record_text(found) == record_text(record(k));
    EXPECT_TRUE(same);
  }
  EXPECT_EQ(store.timings().size(), 3U);
  EXPECT_EQ(store.plan().value(), "{}");
}

TEST(Store, KeepsTheFirstResultOfAKey) {
  const TemporaryFolder folder;
  fill(folder.path(), 1);
  Store store = Store::open(folder.path(), Store::Mode::write);
  RunRecord other = record(0);
  other.nrmse = 7.0;
  store.add(other, {other.key, 0.1, "host", 1, 1});
  EXPECT_EQ(store.records().front().nrmse, record(0).nrmse);
}

TEST(Store, RefusesASecondWriterAndAllowsAReader) {
  const TemporaryFolder folder;
  fill(folder.path(), 1);
  const Store first = Store::open(folder.path(), Store::Mode::write);
  EXPECT_NE(
      testing::message_of<WorkError>([&] { Store::open(folder.path(), Store::Mode::write); }).find("another process"),
      std::string::npos);
  EXPECT_EQ(Store::open(folder.path(), Store::Mode::read).records().size(), 1U);
}

// Every 512 bytes a flipped byte: the store must be refused or give the records unchanged, never other ones.
TEST(Store, FindsFlippedBytes) {
  const TemporaryFolder folder;
  fill(folder.path() / "whole", 40);
  const auto size = fs::file_size(folder.path() / "whole/store.sqlite");
  std::string expected;
  for (const RunRecord& one : Store::open(folder.path() / "whole", Store::Mode::read).records())
    expected += record_text(one);
  std::size_t refused = 0;
  for (std::uintmax_t at = 20; at < size; at += 512 + 37) {
    const fs::path copy = folder.path() / "copy";
    fs::remove_all(copy);
    fs::create_directories(copy);
    fs::copy_file(folder.path() / "whole/store.sqlite", copy / "store.sqlite");
    {
      std::fstream file(copy / "store.sqlite", std::ios::in | std::ios::out | std::ios::binary);
      file.seekg(static_cast<std::streamoff>(at));
      const char byte = static_cast<char>(file.get() ^ 0x15);
      file.seekp(static_cast<std::streamoff>(at));
      file.put(byte);
    }
    try {
      std::string found;
      for (const RunRecord& one : Store::open(copy, Store::Mode::read).records()) found += record_text(one);
      EXPECT_EQ(found, expected) << "byte " << at;
    } catch (const InputError&) {
      ++refused;
    }
  }
  // Bytes that SQLite does not use, and those of the environment, may change unseen.
  EXPECT_GT(refused, 0U);
}

TEST(Store, FindsTruncationAtAnyPlace) {
  const TemporaryFolder folder;
  fill(folder.path(), 40);
  const fs::path file = folder.path() / "store.sqlite";
  for (auto size = fs::file_size(file); size > 0; size = size > 5000 ? size - 5000 : 0) {
    if (size == fs::file_size(file)) continue;
    fs::resize_file(file, size);
    EXPECT_NE(message([&] { Store::open(folder.path(), Store::Mode::write); }), "no error") << size << " bytes left";
    EXPECT_NE(message([&] { Store::open(folder.path(), Store::Mode::read); }), "no error") << size << " bytes left";
  }
  fs::resize_file(file, 0);
  EXPECT_NE(message([&] { Store::open(folder.path(), Store::Mode::write); }).find("damaged"), std::string::npos);
}

TEST(Store, FindsChangedNumbers) {
  const TemporaryFolder folder;
  fill(folder.path(), 2);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "store.sqlite").c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "UPDATE runs SET nrmse = 0.001", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_NE(
      message([&] { static_cast<void>(Store::open(folder.path(), Store::Mode::read).records()); }).find("checksum"),
      std::string::npos);
}

// A text that is not UTF-8 has no canonical form to be compared with.
TEST(Store, FindsTextThatIsNone) {
  for (const char* change : {"UPDATE runs SET stopped = CAST(x'e9' AS TEXT)", "UPDATE runs SET parameters = 'none'",
                             "UPDATE runs SET parameters = '{\"k\": \"much\"}'", "UPDATE runs SET trace = '[[1]]'"}) {
    const TemporaryFolder folder;
    fill(folder.path(), 2);
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open((folder.path() / "store.sqlite").c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, change, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
    EXPECT_NE(
        message([&] { static_cast<void>(Store::open(folder.path(), Store::Mode::read).records()); }).find("is damaged"),
        std::string::npos)
        << change;
  }
}

TEST(Store, RefusesForeignFilesAndOtherSchemas) {
  const TemporaryFolder folder;
  folder.write("text/store.sqlite", "this is no database, but long enough to look at: " + std::string(2000, 'x'));
  EXPECT_NE(message([&] { Store::open(folder.path() / "text", Store::Mode::read); }), "no error");
  fill(folder.path() / "newer", 1);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "newer/store.sqlite").c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database, "PRAGMA user_version=99", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_NE(message([&] { Store::open(folder.path() / "newer", Store::Mode::read); }).find("schema 99"),
            std::string::npos);
  EXPECT_NE(message([&] { Store::open(folder.path() / "nothing", Store::Mode::read); }).find("holds no study"),
            std::string::npos);
}

TEST(Store, ReadsFromAReadOnlyFolder) {
  const TemporaryFolder folder;
  fill(folder.path(), 2);
  chmod(folder.path().c_str(), 0555);
  EXPECT_EQ(Store::open(folder.path(), Store::Mode::read).records().size(), 2U);
  if (geteuid() != 0) {
    EXPECT_NE(message([&] { Store::open(folder.path(), Store::Mode::write); }).find("cannot be written"),
              std::string::npos);
  }
  chmod(folder.path().c_str(), 0755);
}

}  // namespace
}  // namespace hysteron

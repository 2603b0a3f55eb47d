#include "io/checkpoint.hpp"

#include <sqlite3.h>

#include <chrono>
#include <system_error>

#include "io/sha256.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int application_id = 0x48796370;  // "Hycp"
// A process that is killed loses nothing that was kept; a machine without power what was kept within this time.
constexpr std::chrono::seconds between_syncs{2};

// One process at a time, without files for locks.
constexpr const char* settings = R"sql(
PRAGMA locking_mode=EXCLUSIVE;
PRAGMA journal_mode=WAL;
PRAGMA synchronous=NORMAL;
)sql";
constexpr const char* schema = R"sql(
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS command (hash TEXT PRIMARY KEY) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS pieces (key TEXT PRIMARY KEY, bytes BLOB NOT NULL, checksum TEXT NOT NULL) WITHOUT ROWID;
)sql";

std::string checksum_of(const std::string& key, std::string_view bytes) { return sha256_hex(key + std::string(bytes)); }

std::string text_of(sqlite3_stmt* row, int column) {
  const void* bytes = sqlite3_column_blob(row, column);
  const int size = sqlite3_column_bytes(row, column);
  return bytes == nullptr ? std::string{}
                          : std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace

struct Checkpoint::Database {
  sqlite3* handle = nullptr;
  sqlite3_stmt* insert = nullptr;
  Clock::time_point synced = Clock::now();

  Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  Database(Database&&) = delete;
  Database& operator=(Database&&) = delete;
  ~Database() {
    sqlite3_finalize(insert);
    sqlite3_close_v2(handle);
  }

  [[nodiscard]] int execute(const char* sql) const { return sqlite3_exec(handle, sql, nullptr, nullptr, nullptr); }
  // Calls `take` for every row; the first failure, or SQLITE_OK.
  template <class Take>
  [[nodiscard]] int rows(const char* sql, const Take& take) const {
    sqlite3_stmt* statement = nullptr;
    int code = sqlite3_prepare_v2(handle, sql, -1, &statement, nullptr);
    while (code == SQLITE_OK || code == SQLITE_ROW) {
      code = sqlite3_step(statement);
      if (code == SQLITE_ROW) take(statement);
    }
    sqlite3_finalize(statement);
    return code == SQLITE_DONE ? SQLITE_OK : code;
  }
};

Checkpoint::Checkpoint(fs::path path, std::string_view command)
    : path_(std::move(path)), command_(sha256_hex(command)) {
  std::error_code ignored;
  if (fs::exists(path_, ignored)) read();
}

Checkpoint::~Checkpoint() = default;

// With tables and this command in them; false with trouble_ or found_ saying why not.
bool Checkpoint::opened(bool create) {
  std::error_code ignored;
  const bool fresh = create && !fs::exists(path_, ignored);
  if (create && path_.has_parent_path()) fs::create_directories(path_.parent_path(), ignored);
  database_ = std::make_unique<Database>();
  const int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
  int code = sqlite3_open_v2(path_.c_str(), &database_->handle, flags, nullptr);
  if (code == SQLITE_OK) code = database_->execute(settings);
  if (code == SQLITE_OK) code = database_->execute(schema);
  if (code == SQLITE_OK && create) {
    const std::string mark = "PRAGMA application_id=" + std::to_string(application_id) +
                             "; INSERT OR IGNORE INTO command VALUES ('" + command_ + "')";
    code = database_->execute(mark.c_str());
  }
  if (code == SQLITE_OK) code = database_->execute("COMMIT");
  if (code == SQLITE_OK) {
    code = sqlite3_prepare_v2(database_->handle, "INSERT OR REPLACE INTO pieces VALUES (?, ?, ?)", -1,
                              &database_->insert, nullptr);
  }
  if (code == SQLITE_OK) return true;
  if (code == SQLITE_BUSY) {
    found_ = Found::in_use;
    trouble_ = "another process is at work there";
  } else if (!create && (code == SQLITE_NOTADB || code == SQLITE_CORRUPT || code == SQLITE_ERROR)) {
    found_ = Found::damaged;
  } else {
    trouble_ = sqlite3_errmsg(database_->handle);
    if (fresh) discard();
  }
  database_.reset();
  return false;
}

void Checkpoint::read() {
  if (!opened(false)) {
    if (found_ == Found::damaged) discard();
    return;
  }
  bool own = false;
  bool same = false;
  bool whole = true;
  int code = database_->rows("PRAGMA application_id",
                             [&](sqlite3_stmt* row) { own = sqlite3_column_int(row, 0) == application_id; });
  if (code == SQLITE_OK) {
    code = database_->rows("SELECT hash FROM command", [&](sqlite3_stmt* row) { same = text_of(row, 0) == command_; });
  }
  if (code == SQLITE_OK && own && same) {
    code = database_->rows("SELECT key, bytes, checksum FROM pieces", [&](sqlite3_stmt* row) {
      const std::string key = text_of(row, 0);
      const std::string bytes = text_of(row, 1);
      whole = whole && checksum_of(key, bytes) == text_of(row, 2);
      pieces_[key] = bytes;
    });
  }
  if (code == SQLITE_OK && same && whole) {
    found_ = pieces_.empty() ? Found::nothing : Found::pieces;
    return;
  }
  // A file that a killed process had only begun holds no command.
  const bool begun = code == SQLITE_OK && !own;
  found_ = begun ? Found::nothing : code != SQLITE_OK || !whole ? Found::damaged : Found::of_another_command;
  discard();
}

void Checkpoint::discard() {
  database_.reset();
  pieces_.clear();
  std::error_code ignored;
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) fs::remove(path_.string() + ending, ignored);
}

std::size_t Checkpoint::pieces() const {
  const std::scoped_lock lock(mutex_);
  return pieces_.size();
}

std::string Checkpoint::trouble() const {
  const std::scoped_lock lock(mutex_);
  return trouble_;
}

std::optional<std::string> Checkpoint::find(const std::string& key) const {
  const std::scoped_lock lock(mutex_);
  const auto at = pieces_.find(key);
  return at == pieces_.end() ? std::nullopt : std::optional(at->second);
}

void Checkpoint::keep(const std::string& key, std::string_view bytes) {
  const std::scoped_lock lock(mutex_);
  if (!trouble_.empty() || (!database_ && !opened(true))) return;
  const bool due = Clock::now() - database_->synced > between_syncs;
  if (due) static_cast<void>(database_->execute("PRAGMA synchronous=FULL"));
  const std::string checksum = checksum_of(key, bytes);
  sqlite3_stmt* insert = database_->insert;
  sqlite3_bind_text(insert, 1, key.data(), static_cast<int>(key.size()), SQLITE_STATIC);
  sqlite3_bind_blob(insert, 2, bytes.data(), static_cast<int>(bytes.size()), SQLITE_STATIC);
  sqlite3_bind_text(insert, 3, checksum.data(), static_cast<int>(checksum.size()), SQLITE_STATIC);
  const int code = sqlite3_step(insert);
  sqlite3_reset(insert);
  sqlite3_clear_bindings(insert);
  if (due) {
    static_cast<void>(database_->execute("PRAGMA synchronous=NORMAL"));
    database_->synced = Clock::now();
  }
  if (code != SQLITE_DONE) {
    trouble_ = sqlite3_errmsg(database_->handle);
    database_.reset();
    if (pieces_.empty()) discard();  // a file that holds nothing
    return;
  }
  pieces_.emplace(key, bytes);
}

void Checkpoint::remove() {
  const std::scoped_lock lock(mutex_);
  if (found_ == Found::in_use) return;
  discard();
}

}  // namespace hysteron

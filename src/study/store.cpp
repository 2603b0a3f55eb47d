#include "study/store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/printable.hpp"
#include "io/output.hpp"
#include "io/sha256.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int application_id = 0x48797374;  // "Hyst"
constexpr int schema_version = 1;

constexpr const char* schema = R"sql(
CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL, checksum TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE problems (hash TEXT PRIMARY KEY, config TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE runs (
  key TEXT PRIMARY KEY,
  config TEXT NOT NULL,
  nrmse REAL,
  nrmse_tight REAL,
  nrmse_heldout REAL,
  evaluations INTEGER NOT NULL,
  diverged INTEGER NOT NULL,
  stopped TEXT NOT NULL,
  best TEXT NOT NULL,
  parameters TEXT NOT NULL,
  trace TEXT NOT NULL,
  checksum TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE environment (
  key TEXT PRIMARY KEY,
  seconds REAL NOT NULL,
  host TEXT NOT NULL,
  threads INTEGER NOT NULL,
  finished INTEGER NOT NULL) WITHOUT ROWID;
)sql";

std::string trace_text(const std::vector<TracePoint>& trace) {
  json rows = json::array();
  for (const TracePoint& point : trace) rows.push_back({point.evaluations, point.best});
  return rows.dump();
}

class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

 private:
  int value_;
};

constexpr const char* lock_name = "store.lock";
constexpr const char* fresh_name = "store.sqlite.new";

// Held until the process ends, however it ends: the kernel drops it.
Descriptor take_lock(const fs::path& folder) {
  const fs::path path = folder / lock_name;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throw WorkError(path.string() + ": cannot be opened: " + std::strerror(errno));
  Descriptor lock(descriptor);
  struct stat status {};
  // A file that has no name any more was taken away by a process whose store could not be made.
  const bool held = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (held && ::fstat(descriptor, &status) == 0 && status.st_nlink == 0) return take_lock(folder);
  if (!held) {
    throw WorkError(folder.string() +
                    ": another process is writing this study; wait for it, or write to another folder and merge both");
  }
  return lock;
}

}  // namespace

struct Store::State {
  fs::path path;
  sqlite3* database = nullptr;
  Descriptor lock;
  bool writing = false;
  // By the address of their text, a literal; one use of each at a time.
  mutable std::map<const char*, sqlite3_stmt*> statements;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  State(State&&) = delete;
  State& operator=(State&&) = delete;
  ~State() {
    if (database == nullptr) return;
    for (const auto& [sql, statement] : statements) sqlite3_finalize(statement);
    // One plain file at rest, readable from read-only folders; where that fails the log beside it stays valid.
    if (writing) sqlite3_exec(database, "PRAGMA journal_mode=DELETE", nullptr, nullptr, nullptr);
    sqlite3_close_v2(database);
  }

  [[nodiscard]] std::string name() const { return path.empty() ? std::string("store in memory") : path.string(); }

  [[noreturn]] void fail(int code) const {
    const int primary = code & 0xff;
    if (primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB) damaged(sqlite3_errmsg(database));
    std::string reason = database != nullptr ? sqlite3_errmsg(database) : sqlite3_errstr(code);
    if (primary == SQLITE_FULL) reason = "the disk is full";
    if (primary == SQLITE_READONLY || primary == SQLITE_PERM) reason = "it cannot be written to";
    throw WorkError(name() + ": " + reason + "; all runs recorded before are kept");
  }
  [[noreturn]] void damaged(const std::string& what) const {
    throw InputError(name(), 0,
                     "the store is damaged (" + what +
                         "), expected the file as hysteron left it; restore it from a copy, "
                         "or move it away and run the study again");
  }
  void check(int code) const {
    if (code != SQLITE_OK && code != SQLITE_DONE && code != SQLITE_ROW) fail(code);
  }
  void execute(const char* sql) const { check(sqlite3_exec(database, sql, nullptr, nullptr, nullptr)); }
};

namespace {

// A use of a prepared statement, which the store keeps for the next one: parsing SQL takes longer than a row.
template <class State>
class Statement {
 public:
  Statement(const State& state, const char* sql) : state_(state) {
    sqlite3_stmt*& kept = state_.statements[sql];
    if (kept == nullptr) state_.check(sqlite3_prepare_v2(state_.database, sql, -1, &kept, nullptr));
    statement_ = kept;
  }
  ~Statement() {
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  Statement(Statement&&) = delete;
  Statement& operator=(Statement&&) = delete;

  Statement& bind(const std::string& text) {
    state_.check(sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
    return *this;
  }
  Statement& bind(std::int64_t value) {
    state_.check(sqlite3_bind_int64(statement_, ++bound_, value));
    return *this;
  }
  Statement& bind(double value) {
    state_.check(sqlite3_bind_double(statement_, ++bound_, value));
    return *this;
  }
  Statement& bind(const std::optional<double>& value) {
    if (value) return bind(*value);
    state_.check(sqlite3_bind_null(statement_, ++bound_));
    return *this;
  }
  bool step() {
    const int code = sqlite3_step(statement_);
    state_.check(code);
    return code == SQLITE_ROW;
  }
  [[nodiscard]] std::string text(int column) const {
    const auto* bytes = sqlite3_column_text(statement_, column);
    return bytes == nullptr ? std::string{}
                            : std::string(reinterpret_cast<const char*>(bytes),
                                          static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
  }
  [[nodiscard]] std::int64_t whole(int column) const { return sqlite3_column_int64(statement_, column); }
  [[nodiscard]] double real(int column) const { return sqlite3_column_double(statement_, column); }
  [[nodiscard]] std::optional<double> optional(int column) const {
    if (sqlite3_column_type(statement_, column) == SQLITE_NULL) return {};
    return real(column);
  }

 private:
  const State& state_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

template <class State>
void verify(const State& state) {
  {
    Statement<State> statement(state, "PRAGMA application_id");
    statement.step();
    if (statement.whole(0) != application_id) {
      throw InputError(state.name(), 0, "is not a store of hysteron, expected one written by `hysteron bench`");
    }
  }
  {
    Statement<State> statement(state, "PRAGMA user_version");
    statement.step();
    if (statement.whole(0) != schema_version) {
      throw InputError(state.name(), 0,
                       "has schema " + std::to_string(statement.whole(0)) +
                           " of the store, which this version does not know, expected " +
                           std::to_string(schema_version));
    }
  }
  Statement<State> statement(state, "PRAGMA integrity_check(1)");
  statement.step();
  if (statement.text(0) != "ok") {
    std::string what = statement.text(0);
    for (char& c : what) c = c == '\n' ? ' ' : c;
    state.damaged(what);
  }
}

template <class State>
void open_database(State& state, const std::string& name, int flags) {
  const int code = sqlite3_open_v2(name.c_str(), &state.database, flags, nullptr);
  state.check(code);
  sqlite3_extended_result_codes(state.database, 1);
  sqlite3_busy_timeout(state.database, 10000);
}

template <class State>
void lay_out(const State& state) {
  state.execute("BEGIN");
  state.execute(schema);
  state.execute(("PRAGMA application_id=" + std::to_string(application_id)).c_str());
  state.execute(("PRAGMA user_version=" + std::to_string(schema_version)).c_str());
  state.execute("COMMIT");
}

// Makes the store where there is none.
template <class State>
void open_for_writing(State& state, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(state.path, ignored)) {
    // Made under another name, so that an empty or half made store.sqlite is never a new one.
    const fs::path fresh = folder / fresh_name;
    fs::remove(fresh, ignored);
    fs::remove(fresh.string() + "-journal", ignored);
    {
      State young;
      young.path = fresh;
      open_database(young, fresh.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
      lay_out(young);
    }
    // A log without its store belongs to one that was taken away.
    fs::remove(state.path.string() + "-wal", ignored);
    fs::remove(state.path.string() + "-shm", ignored);
    std::error_code code;
    fs::rename(fresh, state.path, code);
    if (code) throw WorkError(state.name() + ": cannot be made: " + code.message());
  }
  if (fs::file_size(state.path, ignored) == 0) state.damaged("the file is empty");
  open_database(state, state.path.string(), SQLITE_OPEN_READWRITE);
  verify(state);
  state.writing = true;
  state.execute("PRAGMA journal_mode=WAL");
  state.execute("PRAGMA synchronous=NORMAL");
}

}  // namespace

Store::Store(std::unique_ptr<State> state) : state_(std::move(state)) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

Store Store::memory() {
  auto state = std::make_unique<State>();
  open_database(*state, ":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  lay_out(*state);
  return Store(std::move(state));
}

Store Store::open(const fs::path& folder, Mode mode) {
  auto state = std::make_unique<State>();
  state->path = folder / "store.sqlite";
  std::error_code ignored;
  if (mode == Mode::read) {
    if (!fs::exists(state->path, ignored)) {
      throw InputError(folder.string(), 0,
                       "holds no study (store.sqlite), expected a folder written by `hysteron bench`");
    }
    if (fs::file_size(state->path, ignored) == 0) state->damaged("the file is empty");
    // Without a log beside it the file is whole, and a folder that cannot be written needs no lock files.
    const bool alone =
        !fs::exists(state->path.string() + "-wal", ignored) && !fs::exists(state->path.string() + "-journal", ignored);
    const bool writable = ::access(folder.c_str(), W_OK) == 0 && ::access(state->path.c_str(), W_OK) == 0;
    if (alone && !writable) {
      std::string uri = "file:";
      for (const char c : fs::absolute(state->path).string()) {
        if (c == '%' || c == '?' || c == '#') {
          char hex[8];
          std::snprintf(hex, sizeof hex, "%%%02x", static_cast<unsigned>(c));
          uri += hex;
        } else {
          uri += c;
        }
      }
      open_database(*state, uri + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    } else {
      open_database(*state, state->path.string(), SQLITE_OPEN_READWRITE);
    }
    verify(*state);
    return Store(std::move(state));
  }
  const bool folder_was_there = fs::exists(folder, ignored);
  make_output_folder(folder);
  state->lock = take_lock(folder);
  const bool store_was_there = fs::exists(state->path, ignored);
  try {
    open_for_writing(*state, folder);
    Store store(std::move(state));
    // A run is skipped because of its row: the row must be right.
    static_cast<void>(store.records());
    return store;
  } catch (...) {
    // Of a store that could not be made nothing stays; the lock is held until then.
    const Descriptor lock = state ? std::move(state->lock) : Descriptor();
    state.reset();
    if (!store_was_there) {
      for (const char* name : {"store.sqlite", fresh_name}) {
        for (const char* ending : {"", "-wal", "-shm", "-journal"}) {
          fs::remove(folder / (std::string(name) + ending), ignored);
        }
      }
      fs::remove(folder / lock_name, ignored);
      if (!folder_was_there) fs::remove(folder, ignored);
    }
    throw;
  }
}

void Store::set_meta(const std::string& name, const std::string& text) {
  Statement<State> statement(*state_, "INSERT OR REPLACE INTO meta VALUES (?, ?, ?)");
  statement.bind(name).bind(text).bind(sha256_hex(text)).step();
}

std::optional<std::string> Store::meta(const std::string& name) const {
  Statement<State> statement(*state_, "SELECT value, checksum FROM meta WHERE name = ?");
  if (!statement.bind(name).step()) return {};
  std::string text = statement.text(0);
  if (sha256_hex(text) != statement.text(1)) state_->damaged("the checksum of the " + name + " does not fit");
  return text;
}

void Store::set_plan(const std::string& text) { set_meta("plan", text); }
std::optional<std::string> Store::plan() const { return meta("plan"); }
void Store::set_identifiability(const std::string& text) { set_meta("identifiability", text); }
std::optional<std::string> Store::identifiability() const { return meta("identifiability"); }

void Store::add_problem(const std::string& hash, const std::string& config) {
  Statement<State> statement(*state_, "INSERT OR IGNORE INTO problems VALUES (?, ?)");
  statement.bind(hash).bind(config).step();
}

std::vector<std::pair<std::string, std::string>> Store::problems() const {
  std::vector<std::pair<std::string, std::string>> result;
  Statement<State> statement(*state_, "SELECT hash, config FROM problems ORDER BY hash");
  while (statement.step()) result.emplace_back(statement.text(0), statement.text(1));
  return result;
}

namespace {

template <class State>
void insert(const State& state, const RunRecord& record, const RunTiming& timing) {
  {
    Statement<State> statement(state, "INSERT OR IGNORE INTO runs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    statement.bind(record.key)
        .bind(record.config)
        .bind(record.nrmse)
        .bind(record.nrmse_tight)
        .bind(record.nrmse_heldout);
    statement.bind(static_cast<std::int64_t>(record.evaluations)).bind(static_cast<std::int64_t>(record.diverged));
    statement.bind(record.stopped)
        .bind(json(record.best).dump())
        .bind(record.parameters)
        .bind(trace_text(record.trace));
    statement.bind(sha256_hex(record_text(record))).step();
  }
  Statement<State> statement(state, "INSERT OR IGNORE INTO environment VALUES (?, ?, ?, ?, ?)");
  statement.bind(timing.key).bind(timing.seconds).bind(timing.host).bind(static_cast<std::int64_t>(timing.threads));
  statement.bind(timing.finished).step();
}

// All of what `work` does or, when it throws, nothing.
template <class State, class Work>
void in_transaction(const State& state, const Work& work) {
  state.execute("BEGIN IMMEDIATE");
  try {
    work();
    state.execute("COMMIT");
  } catch (...) {
    sqlite3_exec(state.database, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

}  // namespace

void Store::add(const RunRecord& record, const RunTiming& timing) {
  in_transaction(*state_, [&] { insert(*state_, record, timing); });
}

void Store::add(std::span<const Entry> entries) {
  if (entries.empty()) return;
  state_->execute("PRAGMA synchronous=FULL");
  in_transaction(*state_, [&] {
    for (const Entry& entry : entries) insert(*state_, entry.record, entry.timing);
  });
  state_->execute("PRAGMA synchronous=NORMAL");
}

std::set<std::string> Store::keys() const {
  std::set<std::string> result;
  Statement<State> statement(*state_, "SELECT key FROM runs");
  while (statement.step()) result.insert(statement.text(0));
  return result;
}

std::vector<RunRecord> Store::records() const {
  std::vector<RunRecord> result;
  Statement<State> statement(
      *state_,
      "SELECT key, config, nrmse, nrmse_tight, nrmse_heldout, evaluations, diverged, stopped, best, "
      "parameters, trace, checksum FROM runs ORDER BY key");
  while (statement.step()) {
    RunRecord record;
    record.key = statement.text(0);
    record.config = statement.text(1);
    record.nrmse = statement.optional(2);
    record.nrmse_tight = statement.optional(3);
    record.nrmse_heldout = statement.optional(4);
    record.evaluations = static_cast<std::size_t>(statement.whole(5));
    record.diverged = static_cast<std::size_t>(statement.whole(6));
    record.stopped = statement.text(7);
    record.parameters = statement.text(9);
    try {
      record.best = json::parse(statement.text(8)).get<std::vector<double>>();
      for (const json& point : json::parse(statement.text(10))) {
        record.trace.push_back({point.at(0).get<std::size_t>(), point.at(1).get<double>()});
      }
      static_cast<void>(json::parse(record.parameters).get<std::map<std::string, double>>());
      // Where a text is not UTF-8 there is no checksum either.
      if (sha256_hex(record_text(record)) != statement.text(11) || sha256_hex(record.config) != record.key) {
        state_->damaged("the checksum of run " + printable(record.key.substr(0, 12)) + " does not fit");
      }
    } catch (const json::exception&) {
      state_->damaged("run " + printable(record.key.substr(0, 12)) + " cannot be read");
    }
    result.push_back(std::move(record));
  }
  return result;
}

std::vector<RunTiming> Store::timings() const {
  std::vector<RunTiming> result;
  Statement<State> statement(*state_, "SELECT key, seconds, host, threads, finished FROM environment ORDER BY key");
  while (statement.step()) {
    result.push_back({statement.text(0), statement.real(1), statement.text(2), static_cast<int>(statement.whole(3)),
                      statement.whole(4)});
  }
  return result;
}

std::string record_text(const RunRecord& record) {
  const auto value = [](const std::optional<double>& number) { return number ? json(*number) : json(nullptr); };
  return json{{"key", record.key},
              {"config", record.config},
              {"nrmse", value(record.nrmse)},
              {"nrmse_tight", value(record.nrmse_tight)},
              {"nrmse_heldout", value(record.nrmse_heldout)},
              {"evaluations", record.evaluations},
              {"diverged", record.diverged},
              {"stopped", record.stopped},
              {"best", record.best},
              {"parameters", record.parameters},
              {"trace", trace_text(record.trace)}}
      .dump();
}

}  // namespace hysteron

// The records of a study: one embedded SQLite file a folder, safe against being killed at any instant.
//
// FOLDER/store.sqlite holds runs (results, nothing else), problems, meta (the plan) and, apart, environment (host,
// threads, seconds), so that results of two stores can be compared byte for byte. docs/studies.md states the schema.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "fit/driver.hpp"

namespace hysteron {

// What a finished run leaves: depends on its configuration only.
struct RunRecord {
  std::string key;
  std::string config;                 // canonical JSON whose sha256 is the key
  std::optional<double> nrmse;        // absent when no candidate stayed finite
  std::optional<double> nrmse_tight;  // the same point with a 256 times smaller integration tolerance
  std::optional<double> nrmse_heldout;
  std::size_t evaluations = 0;
  std::size_t diverged = 0;
  std::string stopped;
  std::vector<double> best;       // unit coordinates
  std::string parameters;         // JSON object: term -> value in SI units
  std::vector<TracePoint> trace;  // evaluations and best cost at every improvement
};

// What it took, which is no result.
struct RunTiming {
  std::string key;
  double seconds = 0.0;
  std::string host;
  int threads = 1;            // runs under way beside each other
  std::int64_t finished = 0;  // seconds since 1970
};

struct Entry {
  RunRecord record;
  RunTiming timing;
};

class Store {
 public:
  enum class Mode { read, write };

  // write: makes the folder and the store where there is none, takes the folder's lock. Throws InputError for a folder
  // that cannot be written, a store that is damaged, of another schema, or (read) missing; WorkError when another
  // process holds the lock. `memory` gives a store without files.
  static Store open(const std::filesystem::path& folder, Mode mode);
  static Store memory();
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  // All of these throw WorkError with the path and the reason when the file system fails; what was added before stays.
  void set_plan(const std::string& json);
  [[nodiscard]] std::optional<std::string> plan() const;
  // Identifiability of the best runs, see study/identifiability.hpp.
  void set_identifiability(const std::string& json);
  [[nodiscard]] std::optional<std::string> identifiability() const;
  void add_problem(const std::string& hash, const std::string& config);
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> problems() const;
  // In one transaction; a record whose key is there already is left alone.
  void add(const RunRecord& record, const RunTiming& timing);
  // Likewise, and on the disk when this returns: their other copy may go.
  void add(std::span<const Entry> entries);
  [[nodiscard]] std::set<std::string> keys() const;
  // In the order of keys. Throws InputError for a row whose checksum does not fit.
  [[nodiscard]] std::vector<RunRecord> records() const;
  [[nodiscard]] std::vector<RunTiming> timings() const;

 private:
  struct State;
  explicit Store(std::unique_ptr<State> state);
  void set_meta(const std::string& name, const std::string& text);
  [[nodiscard]] std::optional<std::string> meta(const std::string& name) const;
  std::unique_ptr<State> state_;
};

// Canonical JSON of a record; its sha256 is the row's checksum.
[[nodiscard]] std::string record_text(const RunRecord& record);

}  // namespace hysteron

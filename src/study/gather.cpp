#include "study/gather.hpp"

#include <algorithm>
#include <map>
#include <system_error>

#include "core/error.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "rank-";

// Adds records that a store does not hold yet.
class Gathering {
 public:
  explicit Gathering(Store& into) : into_(into) {
    for (const RunRecord& record : into.records()) have_.emplace(record.key, record_text(record));
  }

  std::size_t take(const Store& from, const fs::path& folder) {
    std::map<std::string, RunTiming> timings;
    for (RunTiming& timing : from.timings()) timings.emplace(timing.key, std::move(timing));
    std::vector<Entry> fresh;
    for (RunRecord& record : from.records()) {
      std::string text = record_text(record);
      if (const auto found = have_.find(record.key); found != have_.end()) {
        if (found->second == text) continue;
        throw InputError(folder.string(), 0,
                         "run " + record.key.substr(0, 12) +
                             " has another result than in the folder above, expected the same bytes for the same "
                             "configuration; were they run by different builds?");
      }
      have_.emplace(record.key, std::move(text));
      const auto timing = timings.find(record.key);
      RunTiming none;
      none.key = record.key;
      fresh.push_back({std::move(record), timing == timings.end() ? none : timing->second});
    }
    into_.add(fresh);
    return fresh.size();
  }

 private:
  Store& into_;
  std::map<std::string, std::string> have_;
};

}  // namespace

fs::path rank_folder(const fs::path& folder, int rank) { return folder / (std::string(prefix) + std::to_string(rank)); }

std::vector<fs::path> rank_folders(const fs::path& folder) {
  std::vector<std::pair<long, fs::path>> found;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    const std::string number = name.substr(prefix.size());
    if (number.empty() || number.size() > 9 || number.find_first_not_of("0123456789") != std::string::npos) continue;
    found.emplace_back(std::stol(number), entry.path());
  }
  std::ranges::sort(found);
  std::vector<fs::path> result;
  for (auto& [number, path] : found) result.push_back(std::move(path));
  return result;
}

std::size_t absorb_ranks(Store& store, const fs::path& folder) {
  const std::vector<fs::path> folders = rank_folders(folder);
  if (folders.empty()) return 0;
  Gathering gathering(store);
  std::size_t count = 0;
  for (const fs::path& path : folders) {
    // For writing: takes the lock, which a rank that outlived its job would hold, and reads the log of a killed one.
    const Store from = Store::open(path, Store::Mode::write);
    count += gathering.take(from, path);
  }
  for (const fs::path& path : folders) {
    std::error_code code;
    fs::remove_all(path, code);
    if (code) throw WorkError(path.string() + ": cannot be removed: " + code.message() + "; its runs are kept");
  }
  return count;
}

Store open_gathered(const fs::path& folder) {
  Store own = Store::open(folder, Store::Mode::read);
  const std::vector<fs::path> folders = rank_folders(folder);
  if (folders.empty()) return own;
  Store all = Store::memory();
  if (const auto plan = own.plan()) all.set_plan(*plan);
  if (const auto text = own.identifiability()) all.set_identifiability(*text);
  for (const auto& [hash, config] : own.problems()) all.add_problem(hash, config);
  Gathering gathering(all);
  gathering.take(own, folder);
  for (const fs::path& path : folders) {
    std::error_code code;
    // A rank that has only made its folder yet.
    if (!fs::exists(path / "store.sqlite", code)) continue;
    gathering.take(Store::open(path, Store::Mode::read), path);
  }
  return all;
}

}  // namespace hysteron

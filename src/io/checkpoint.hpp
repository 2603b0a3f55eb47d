// Finished pieces of a long work, beside its results until it is done: the command, rerun after it was ended at
// any instant, reads them in place of working again. An SQLite file, removed when the work is done.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace hysteron {

class Checkpoint {
 public:
  // What the file held: nothing, pieces of the same command, or what had to be given up.
  enum class Found { nothing, pieces, of_another_command, damaged, in_use };

  // `command` is everything that decides the results: pieces of another one are given up. Without a file nothing is
  // made until the first piece is kept.
  Checkpoint(std::filesystem::path path, std::string_view command);
  ~Checkpoint();
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;
  Checkpoint(Checkpoint&&) = delete;
  Checkpoint& operator=(Checkpoint&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] Found found() const { return found_; }
  [[nodiscard]] std::size_t pieces() const;
  // Why nothing is kept (another process at work, a full disk), empty while all is well. The work itself may go on.
  [[nodiscard]] std::string trouble() const;

  // From any thread.
  [[nodiscard]] std::optional<std::string> find(const std::string& key) const;
  void keep(const std::string& key, std::string_view bytes);

  // The work is done: the file goes.
  void remove();

 private:
  struct Database;
  void read();
  void discard();
  [[nodiscard]] bool opened(bool create);

  std::filesystem::path path_;
  std::string command_;  // hash
  Found found_ = Found::nothing;
  mutable std::mutex mutex_;  // of all below
  std::unique_ptr<Database> database_;
  std::unordered_map<std::string, std::string> pieces_;
  std::string trouble_;
};

}  // namespace hysteron

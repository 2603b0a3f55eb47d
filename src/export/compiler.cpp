#include "export/compiler.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "io/file.hpp"

namespace hysteron {
namespace {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "hysteron-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw WorkError("no temporary folder can be made in " + std::filesystem::temp_directory_path().string());
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  TemporaryFolder(TemporaryFolder&&) = delete;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Runs a program of the path in a folder without its output; false where it is missing or fails.
bool runs(const std::vector<std::string>& words, const std::filesystem::path& folder) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    return false;
  }
  if (child == 0) {
    const int silence = open("/dev/null", O_RDWR);
    dup2(silence, STDOUT_FILENO);
    dup2(silence, STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) {
      execvp(arguments[0], arguments.data());
    }
    _exit(127);
  }
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<std::string> shared_library(const std::map<std::string, std::string>& files,
                                          const std::vector<std::string>& sources) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) {
    std::ofstream(folder.path() / name, std::ios::binary) << text;
  }
  std::vector<std::string> words = {"cc", "-std=c99",  "-O2", "-fPIC", "-shared", "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
                                    "-o", "library.so"};
  words.insert(words.end(), sources.begin(), sources.end());
  words.emplace_back("-lm");
  if (!runs(words, folder.path())) {
    return std::nullopt;
  }
  return read_file((folder.path() / "library.so").string());
}

std::string fmi_platform() {
#if defined(__linux__) && defined(__x86_64__)
  return "linux64";
#else
  return "";
#endif
}

}  // namespace hysteron

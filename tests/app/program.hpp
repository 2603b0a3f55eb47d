// Runs HYSTERON_PROGRAM as a user does, in a folder, and reads what it wrote.
#pragma once

#include <fcntl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace hysteron::testing {

// Told apart from every exit status, 130 among them.
constexpr int ended_by(int signal) { return 1000 + signal; }

struct Outcome {
  int status = -1;  // or ended_by(SIGNAL)
  std::string out;
  std::string err;
};

inline std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// `before` runs in the child, for limits, environment and signal dispositions.
inline pid_t start_other(const char* program, const std::vector<std::string>& words,
                         const std::filesystem::path& folder, const std::function<void()>& before = {}) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder.c_str()) != 0) _exit(99);
  dup2(open("stdout.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
  dup2(open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
  if (before) before();
  std::vector<char*> arguments{const_cast<char*>(program)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(program, arguments.data());
  _exit(99);
}

inline pid_t start(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::function<void()>& before = {}) {
  return start_other(HYSTERON_PROGRAM, words, folder, before);
}

// Waits until a child has a handler for a signal: one sent before would end it as it ends any program.
inline void wait_until_caught(pid_t child, int signal) {
  const std::string status = "/proc/" + std::to_string(child) + "/status";
  const std::string key = "SigCgt:";
  for (int k = 0; k < 3000; ++k) {
    const std::string text = read(status);
    const auto at = text.find(key);
    if (at != std::string::npos && (std::stoull(text.substr(at + key.size()), nullptr, 16) >> (signal - 1)) % 2 == 1)
      return;
    usleep(10000);
  }
}

inline int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : ended_by(WTERMSIG(status));
}

inline Outcome finish(pid_t child, const std::filesystem::path& folder) {
  const int status = wait_for(child);
  return {status, read(folder / "stdout.txt"), read(folder / "stderr.txt")};
}

inline Outcome run(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::function<void()>& before = {}) {
  return finish(start(words, folder, before), folder);
}

}  // namespace hysteron::testing

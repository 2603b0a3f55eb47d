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

struct Outcome {
  int status = -1;  // 128 + number of the signal that ended it
  std::string out;
  std::string err;
};

inline std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// `before` runs in the child, for limits and signal dispositions.
inline pid_t start(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::function<void()>& before = {}) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder.c_str()) != 0) _exit(99);
  dup2(open("stdout.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644), STDOUT_FILENO);
  dup2(open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0644), STDERR_FILENO);
  if (before) before();
  std::vector<char*> arguments{const_cast<char*>(HYSTERON_PROGRAM)};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execv(HYSTERON_PROGRAM, arguments.data());
  _exit(99);
}

inline int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
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

#include "external/line_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "core/error.hpp"
#include "fit/solver.hpp"

extern char** environ;

namespace hysteron {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 28;
constexpr const char* blanks = " \t\r\n";
constexpr int waits = 200;
constexpr int most_rounds = 16;  // of output after the end of its input
constexpr std::chrono::milliseconds wait{10};

// A pipe that ends for its reader is an error of writing it here, not a signal that ends the program.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec none{};
    while (sigtimedwait(&pipe_, nullptr, &none) == -1 && errno == EINTR) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;
  NoPipeSignal(NoPipeSignal&&) = delete;
  NoPipeSignal& operator=(NoPipeSignal&&) = delete;

 private:
  sigset_t pipe_{};
  sigset_t before_{};
};

}  // namespace

std::vector<std::string> words_of_command(const std::string& command) {
  std::vector<std::string> words;
  bool within = false;
  char quote = 0;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const char c = command[k];
    if (quote == 0 && (c == ' ' || c == '\t')) {
      within = false;
      continue;
    }
    if (!within) {
      words.emplace_back();
      within = true;
    }
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote && quote != 0) {
      quote = 0;
    } else if (c == '\\' && quote != '\'' && k + 1 < command.size()) {
      words.back() += command[++k];
    } else {
      words.back() += c;
    }
  }
  if (quote != 0) throw InputError("command '" + command + "': a quote is not closed");
  if (words.empty() || words.front().empty()) {
    throw InputError("command '" + command + "' is empty, expected a program and its words");
  }
  return words;
}

std::string printed(const std::string& line) {
  constexpr std::size_t most_shown = 80;
  return "printed '" + line.substr(0, most_shown) + (line.size() > most_shown ? "...'" : "'");
}

LineProgram::LineProgram(const std::vector<std::string>& words) : words_(words) {
  std::array<int, 2> in{};
  std::array<int, 2> out{};
  if (pipe2(in.data(), O_CLOEXEC) != 0) throw WorkError("no pipe to " + name() + ": " + std::strerror(errno));
  if (pipe2(out.data(), O_CLOEXEC) != 0) {
    close(in[0]);
    close(in[1]);
    throw WorkError("no pipe from " + name() + ": " + std::strerror(errno));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words_) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int failed = posix_spawnp(&child_, arguments.front(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(in[0]);
  close(out[1]);
  to_ = in[1];
  from_ = out[0];
  if (failed != 0) {
    close(to_);
    close(from_);
    throw InputError(name() + " cannot be started: " + std::strerror(failed) + ", expected a program in PATH");
  }
}

LineProgram::~LineProgram() { end(); }

std::string LineProgram::end() {
  if (child_ < 0) return {};
  close(to_);
  const pid_t child = std::exchange(child_, -1);
  int status = 0;
  pid_t ended = 0;
  int rounds = most_rounds;
  for (int k = 0; k < waits && ended == 0; ++k) {
    // What it still prints is read, so that it can end by itself; one that prints without end is left to its signal.
    pending_.clear();
    take_in();
    if (!pending_.empty() && --rounds == 0) close(std::exchange(from_, -1));
    ended = waitpid(child, &status, WNOHANG);
    if (ended == -1 && errno == EINTR) ended = 0;
    if (ended == 0) std::this_thread::sleep_for(wait);
  }
  if (from_ >= 0) close(from_);
  if (ended == 0) {
    kill(child, SIGKILL);
    while (waitpid(child, nullptr, 0) == -1 && errno == EINTR) {
    }
  }
  if (ended != child) return {};
  if (WIFSIGNALED(status)) return name() + " was ended by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return name() + " ended with status " + std::to_string(WEXITSTATUS(status));
  return {};
}

void LineProgram::write(const std::string& line) {
  const NoPipeSignal guard;
  const std::string text = line + "\n";
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(to_, text.data() + written, text.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EINTR) {
      throw Stopped{};
    } else {
      throw WorkError(name() + " reads no more (" + std::strerror(errno) + "): what it said is above, if anything");
    }
  }
}

std::string LineProgram::read() {
  while (true) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string line = pending_.substr(0, end);
      pending_.erase(0, end + 1);
      if (line.find_first_not_of(" \t\r") != std::string::npos) return line;
      continue;
    }
    if (pending_.size() > longest_line) throw WorkError(name() + " printed a line of more than 256 MB");
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(from_, buffer.data(), buffer.size());
    if (count > 0) {
      pending_.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count == 0) {
      throw WorkError(name() + " ended without an answer: what it said is above, if anything");
    } else if (errno == EINTR) {
      throw Stopped{};
    } else {
      throw WorkError(name() + " cannot be read: " + std::strerror(errno));
    }
  }
}

void LineProgram::take_in() {
  std::array<char, 65536> buffer{};
  pollfd ready{from_, POLLIN, 0};
  while (pending_.find_first_not_of(blanks) == std::string::npos && poll(&ready, 1, 0) > 0) {
    const ssize_t count = ::read(from_, buffer.data(), buffer.size());
    if (count <= 0) return;  // it has ended, which whoever reads next is told
    pending_.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::optional<std::string> LineProgram::unread() {
  take_in();
  const std::size_t begin = pending_.find_first_not_of(blanks);
  if (begin == std::string::npos) {
    pending_.clear();
    return std::nullopt;
  }
  return pending_.substr(begin, pending_.find_first_of("\r\n", begin) - begin);
}

}  // namespace hysteron

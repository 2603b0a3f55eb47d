#include "io/fence.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace hysteron {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_is_limited = false;  // the sanitizers reserve terabytes of addresses
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool memory_is_limited = false;
#else
constexpr bool memory_is_limited = true;
#endif
#else
constexpr bool memory_is_limited = true;
#endif

// Addresses in use, in bytes; 0 where the system does not tell.
std::size_t addresses_used() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, std::size_t value) {
  const rlimit both{value, value};
  setrlimit(resource, &both);
}

[[noreturn]] void child(const std::function<std::string()>& work, const FenceLimits& limits, unsigned char heap,
                        int out) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGPIPE}) ::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  limit(RLIMIT_FSIZE, 0);
  if (memory_is_limited) limit(RLIMIT_AS, addresses_used() + limits.memory);
  // M_PERTURB fills fresh bytes with the complement of its value and freed ones with the value.
  mallopt(M_PERTURB, heap);
  try {
    const std::string result = work();
    std::size_t at = 0;
    while (at < result.size()) {
      const auto written = ::write(out, result.data() + at, result.size() - at);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) _exit(1);
      at += static_cast<std::size_t>(written);
    }
    _exit(0);
  } catch (...) {
    _exit(1);
  }
}

}  // namespace

std::optional<std::string> behind_fence(const std::function<std::string()>& work, const FenceLimits& limits,
                                        unsigned char heap) {
  std::array<int, 2> ends{};
  const auto fail = [](const char* what) { throw WorkError(std::string(what) + ": " + std::strerror(errno)); };
  if (pipe(ends.data()) != 0) fail("no pipe to a process of its own for reading a file");
  const pid_t process = fork();
  if (process < 0) {
    close(ends[0]);
    close(ends[1]);
    fail("no process of its own for reading a file");
  }
  if (process == 0) {
    close(ends[0]);
    child(work, limits, heap, ends[1]);
  }
  close(ends[1]);
  std::string result;
  std::array<char, 1U << 16U> part{};
  for (;;) {
    const auto got = ::read(ends[0], part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    result.append(part.data(), static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return result;
}

}  // namespace hysteron

// What the programs of this folder share.
#pragma once

#include <cstdio>
#include <ctime>
#include <exception>

namespace hysteron::bench {

// Exit status of `run`; 1 with a line on standard error where it throws.
inline int guarded(int (*run)(int, char**), int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "error: %s\n", problem.what());
    return 1;
  }
}

// Processor time of the calling thread, s.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace hysteron::bench

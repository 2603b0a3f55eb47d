// What the programs of this folder share.
#pragma once

#include <cstdio>
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

}  // namespace hysteron::bench

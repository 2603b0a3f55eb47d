#include "fit/parallel.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace hysteron {
namespace {

// ThreadSanitizer does not see the barriers of GCC's OpenMP library, which is not built for it, and would report every
// hand-over between the threads of a loop. It is told here what a loop's beginning and end guarantee, and nothing more:
// rounds of one loop stay unordered, so races between them are found.
#if defined(__SANITIZE_THREAD__)
void hand_over(char* place) { __tsan_release(place); }
void take_over(char* place) { __tsan_acquire(place); }
#define HYSTERON_NOT_WATCHED __attribute__((no_sanitize("thread")))
#else
void hand_over(char* /*place*/) {}
void take_over(char* /*place*/) {}
#define HYSTERON_NOT_WATCHED
#endif

struct Loop {
  const std::function<void(std::size_t)>& body;
  std::atomic<bool> failed{false};
  std::mutex guard{};
  std::size_t first_failed = 0;
  std::exception_ptr failure{};
  char begun = 0;  // places to hand over at
  char ended = 0;
};

// An exception may not leave an OpenMP region.
[[gnu::noinline]] void do_round(Loop& loop, std::size_t round) {
  if (loop.failed.load(std::memory_order_relaxed)) {
    return;
  }
  try {
    loop.body(round);
  } catch (...) {
    const std::lock_guard lock(loop.guard);
    if (!loop.failure || round < loop.first_failed) {
      loop.failure = std::current_exception();
      loop.first_failed = round;
    }
    loop.failed = true;
  }
}

// Not watched are only the reads of the arguments the compiler passes to the threads behind the scenes.
HYSTERON_NOT_WATCHED void run_team(std::size_t count, [[maybe_unused]] int threads, Loop& loop) {
  hand_over(&loop.begun);
#pragma omp parallel num_threads(threads)
  {
    take_over(&loop.begun);
#pragma omp for schedule(dynamic, 1) nowait
    for (std::size_t round = 0; round < count; ++round) {
      do_round(loop, round);
    }
    hand_over(&loop.ended);
  }
  take_over(&loop.ended);
}

}  // namespace

// As many as --threads allows. The OpenMP library keeps what it knows of a team on the stack, which a slip in
// OMP_NUM_THREADS would overflow.
constexpr int most_threads = 1024;

int team_size(int threads) {
  if (threads <= 0) threads = omp_get_max_threads();
  // What OMP_NUM_THREADS says beyond an int comes out of the library as zero or a negative number.
  if (threads <= 0) threads = omp_get_num_procs();
  return std::min(threads, most_threads);
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  Loop loop{body};
  // A loop of one round leaves the threads to the loops within it.
  run_team(count, std::min(team_size(threads), static_cast<int>(std::clamp<std::size_t>(count, 1, most_threads))),
           loop);
  if (loop.failure) {
    std::rethrow_exception(loop.failure);
  }
}

}  // namespace hysteron

// The one place where OpenMP makes threads.
#pragma once

#include <cstddef>
#include <functional>

namespace hysteron {

// Threads a loop gets when `threads` are asked for; 0 leaves it to OMP_NUM_THREADS or the number of cores.
int team_size(int threads);

// body(0) ... body(count - 1), each once, in any order and at the same time. Throws what the body threw, of several
// rounds the lowest; rounds not begun by then may be left out.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

}  // namespace hysteron

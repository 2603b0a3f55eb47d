// Work on bytes one does not trust, by a library one cannot check, in a process of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace hysteron {

struct FenceLimits {
  std::size_t memory = std::size_t{4} << 30U;  // bytes on top of what the program holds
  unsigned seconds = 60;                       // of computing
};

// What `work` returns, computed in a child process that may use so much memory and time; nothing when it failed, ran
// into a limit or crashed. `work` sees a copy of the program's memory and can change nothing of it. With a heap whose
// fresh and freed bytes read `heap`.
[[nodiscard]] std::optional<std::string> behind_fence(const std::function<std::string()>& work,
                                                      const FenceLimits& limits, unsigned char heap);

}  // namespace hysteron

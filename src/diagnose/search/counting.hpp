// How much is done of pieces of work that threads share.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace hysteron {

class Counting {
 public:
  // `done`, which may be empty, is told the share of the pieces that are done, from one thread at a time.
  Counting(std::size_t pieces, const std::function<void(double share)>& done) : pieces_(pieces), done_(done) {}
  void add(std::size_t count = 1) {
    if (!done_) return;
    const std::scoped_lock lock(mutex_);
    count_ += count;
    done_(static_cast<double>(count_) / static_cast<double>(pieces_));
  }

 private:
  std::size_t pieces_;
  const std::function<void(double share)>& done_;
  std::mutex mutex_;
  std::size_t count_ = 0;
};

}  // namespace hysteron

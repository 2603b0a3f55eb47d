#include "fit/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace hysteron {
namespace {

TEST(ParallelFor, DoesEveryRoundOnce) {
  for (const int threads : {1, 2, 7}) {
    std::vector<int> done(1000);
    parallel_for(done.size(), threads, [&](std::size_t k) { ++done[k]; });
    EXPECT_EQ(done, std::vector<int>(1000, 1)) << threads << " threads";
  }
  parallel_for(0, 2, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, TakesTheThreadsAskedFor) {
  EXPECT_EQ(team_size(3), 3);
  EXPECT_GE(team_size(0), 1);
}

TEST(ParallelFor, ThrowsTheLowestRoundsException) {
  for (const int threads : {1, 3}) {
    std::atomic<int> waiting{0};
    try {
      // With three threads all three rounds are under way before the first one throws.
      parallel_for(3, threads, [&](std::size_t k) {
        ++waiting;
        while (threads == 3 && waiting < 3) {
          std::this_thread::yield();
        }
        throw std::runtime_error(std::to_string(k));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "0") << threads << " threads";
    }
  }
}

TEST(ParallelFor, OrdersWhatComesAfterIt) {
  // Plain variables written by rounds and read afterwards, and the other way round: ThreadSanitizer watches this test.
  std::vector<std::string> words(64, "before");
  for (int turn = 0; turn < 10; ++turn) {
    parallel_for(words.size(), 4, [&](std::size_t k) { words[k] += std::to_string(k); });
    for (std::string& word : words) {
      word += ';';
    }
  }
  EXPECT_TRUE(words[7].ends_with("7;7;"));
}

}  // namespace
}  // namespace hysteron

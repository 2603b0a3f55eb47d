#include "study/together.hpp"

#include <chrono>
#include <ctime>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.hpp"
#include "io/sha256.hpp"
#include "study/dispatch.hpp"
#include "study/gather.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

enum Kind {
  hello,   // a rank: the hash of its plan, or why it has none
  begin,   // the first rank: all see the same study
  ask,     // a rank: runs that ended, and a wish for more
  batch,   // the first rank: runs to do, none when there are no more
  left,    // a rank: its store is closed, and why it stopped
  finish,  // the first rank: the exit status of all
};

constexpr int interrupted_status = 130;

// Processor time of this thread: what a question costs, also on a machine that does other things.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string pack(const json& message) {
  const std::vector<std::uint8_t> bytes = json::to_msgpack(message);
  return {bytes.begin(), bytes.end()};
}
json unpack(const std::string& bytes) { return json::from_msgpack(bytes); }

// Waiting without taking the processor from the runs: a message is looked for at once, then at longer and longer
// intervals. (The library's own waiting spins.)
class Pause {
 public:
  void reset() { wait_ = shortest; }
  void operator()() {
    std::this_thread::sleep_for(wait_);
    wait_ = std::min(2 * wait_, longest);
  }

 private:
  static constexpr std::chrono::microseconds shortest{20};
  static constexpr std::chrono::microseconds longest{1000};
  std::chrono::microseconds wait_ = shortest;
};

Peers::Message wait_message(Peers& peers) {
  Pause pause;
  for (;;) {
    if (auto message = peers.poll()) return std::move(*message);
    pause();
  }
}

struct Failure {
  int status = 0;
  std::string message;
};

// Exit status and text of whatever `work` throws.
template <class Work>
Failure failure_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {2, error.what()};
  } catch (const WorkError& error) {
    return {1, error.what()};
  } catch (const std::bad_alloc&) {
    return {1, "out of memory"};
  } catch (const std::exception& error) {
    return {1, std::string("internal: ") + error.what()};
  }
  return {};
}

std::string plan_hash(const PlanOrFailure& own) {
  return own.plan ? sha256_hex(plan_json(*own.plan).dump()) : std::string{};
}

// A rank other than the first.
class Worker {
 public:
  Worker(const PlanOrFailure& own, const fs::path& folder, const RunOptions& options, Peers& peers,
         const std::function<bool()>& stop)
      : own_(own), folder_(rank_folder(folder, peers.rank())), options_(options), peers_(peers), stop_(stop) {}

  int run() {
    tell({{"kind", hello}, {"plan", plan_hash(own_)}, {"status", own_.status}, {"message", own_.message}});
    json answer = hear();
    if (answer.at("kind") == begin) {
      const Failure failure = failure_of([&] { work(); });
      const bool interrupted = stop_ && stop_();
      tell({{"kind", left},
            {"status", failure.status},
            {"message", failure.message},
            {"interrupted", interrupted},
            {"ended", ended()}});
      // An answer to a question asked before the failure may come first.
      do answer = hear();
      while (answer.at("kind") != finish);
    }
    return answer.at("status");
  }

 private:
  void tell(const json& message) { peers_.send(0, pack(message)); }
  json hear() { return unpack(wait_message(peers_).bytes); }

  // What ended since the last message.
  json ended() {
    const std::lock_guard guard(mutex_);
    json rows = json::array();
    for (const auto& [run, seconds, nrmse] : ended_)
      rows.push_back({run, seconds, nrmse ? json(*nrmse) : json(nullptr)});
    ended_.clear();
    return rows;
  }

  void work() {
    Store store = Store::open(folder_, Store::Mode::write);
    std::deque<std::size_t> todo;
    bool more = true;
    const auto next = [&]() -> std::optional<std::size_t> {
      if (todo.empty() && more) {
        tell({{"kind", ask}, {"ended", ended()}});
        const json answer = hear();
        for (const json& run : answer.at("runs")) todo.push_back(run);
        more = !todo.empty();
      }
      if (todo.empty()) return {};
      const std::size_t run = todo.front();
      todo.pop_front();
      return run;
    };
    run_from(*own_.plan, store, options_.threads, {}, next, stop_, [&](const RunProgress& now) {
      const std::lock_guard guard(mutex_);
      ended_.push_back({now.index, now.seconds, now.nrmse});
    });
  }

  struct Ended {
    std::size_t run;
    double seconds;
    std::optional<double> nrmse;
  };
  const PlanOrFailure& own_;
  fs::path folder_;
  const RunOptions& options_;
  Peers& peers_;
  const std::function<bool()>& stop_;
  std::mutex mutex_;
  std::vector<Ended> ended_;
};

// The first rank.
class Leader {
 public:
  Leader(const PlanOrFailure& own, const fs::path& folder, const RunOptions& options, Peers& peers,
         const std::function<bool()>& stop, const RunObserver& show)
      : own_(own), folder_(folder), options_(options), peers_(peers), stop_(stop), show_(show) {}

  RanksOutcome run() {
    meet();
    if (outcome_.status == 0) keep(failure_of([&] { work(); }));
    for (int rank = 1; rank < peers_.size(); ++rank) tell(rank, {{"kind", finish}, {"status", outcome_.status}});
    return std::move(outcome_);
  }

 private:
  void tell(int rank, const json& message) { peers_.send(rank, pack(message)); }

  // The first failure is the one told.
  void keep(const Failure& failure, int rank = 0) {
    if (failure.status == 0 || (outcome_.status != 0 && outcome_.status != interrupted_status)) return;
    outcome_.status = failure.status;
    outcome_.message = (rank > 0 ? "rank " + std::to_string(rank) + ": " : std::string{}) + failure.message;
  }

  void meet() {
    keep({own_.status, own_.message});
    const std::string hash = plan_hash(own_);
    for (int met = 1; met < peers_.size(); ++met) {
      const Peers::Message message = wait_message(peers_);
      const json said = unpack(message.bytes);
      keep({said.at("status"), said.at("message")}, message.from);
      if (said.at("status") == 0 && own_.plan && said.at("plan") != hash) {
        keep({2, "the study or its recordings are not those of the first rank, expected the same files everywhere"},
             message.from);
      }
    }
  }

  void work() {
    const Plan& plan = *own_.plan;
    Store store = Store::open(folder_, Store::Mode::write);
    absorb_ranks(store, folder_);
    for (const StudyProblem& problem : plan.problems) store.add_problem(problem.hash, problem.config);
    store.set_plan(plan_json(plan).dump());
    const std::vector<std::size_t> todo = missing_runs(plan, store.keys(), options_, outcome_.progress);
    Dispatcher dispatcher(assignments(plan, todo), static_cast<std::size_t>(peers_.size()));
    for (int rank = 1; rank < peers_.size(); ++rank) tell(rank, {{"kind", begin}});
    // Between the thread that works and the one that answers.
    std::mutex mutex;
    std::atomic<bool> halted{false};
    std::atomic<bool> idle{false};
    Failure failure;
    const auto halt = [&] {
      halted = true;
      dispatcher.halt();
    };
    const auto ended = [&](std::size_t run, double seconds, const std::optional<double>& nrmse) {
      dispatcher.finished(run, seconds);
      ++outcome_.progress.done;
      outcome_.progress.index = run;
      outcome_.progress.seconds = seconds;
      outcome_.progress.nrmse = nrmse;
      if (show_) show_(outcome_.progress);
    };
    const auto stopped = [&] { return halted.load(std::memory_order_relaxed) || (stop_ && stop_()); };
    std::thread own([&] {
      failure = failure_of([&] {
        std::deque<std::size_t> mine;
        const auto next = [&]() -> std::optional<std::size_t> {
          if (mine.empty()) {
            const std::lock_guard guard(mutex);
            for (const std::size_t run : dispatcher.take()) mine.push_back(run);
          }
          if (mine.empty()) return {};
          const std::size_t run = mine.front();
          mine.pop_front();
          return run;
        };
        run_from(plan, store, options_.threads, {}, next, stopped, [&](const RunProgress& now) {
          const std::lock_guard guard(mutex);
          ended(now.index, now.seconds, now.nrmse);
        });
      });
      if (failure.status != 0) {
        const std::lock_guard guard(mutex);
        halt();
      }
      idle = true;
    });
    bool interrupted = false;
    Pause pause;
    for (int there = peers_.size() - 1; there > 0 || !idle;) {
      if (stop_ && stop_()) {
        const std::lock_guard guard(mutex);
        interrupted = true;
        halt();
      }
      const auto message = peers_.poll();
      if (!message) {
        pause();
        continue;
      }
      pause.reset();
      const double asked = processor_seconds();
      const json said = unpack(message->bytes);
      const std::lock_guard guard(mutex);
      for (const json& row : said.at("ended")) {
        ended(row.at(0), row.at(1), row.at(2).is_null() ? std::optional<double>{} : row.at(2).get<double>());
      }
      if (said.at("kind") == ask) {
        tell(message->from, {{"kind", batch}, {"runs", dispatcher.take()}});
        ++outcome_.questions;
        outcome_.answering += processor_seconds() - asked;
        continue;
      }
      --there;
      keep({said.at("status"), said.at("message")}, message->from);
      interrupted = interrupted || said.at("interrupted").get<bool>();
      if (outcome_.status != 0 || interrupted) halt();
    }
    own.join();
    if (interrupted || (stop_ && stop_())) keep({interrupted_status, {}});
    keep(failure);
    if (outcome_.status == 0 && outcome_.progress.found + outcome_.progress.done != outcome_.progress.planned) {
      keep({1, "internal: the ranks left runs undone; the same command continues"});
    }
    // Also after a failure: what the others did is in one place then. Its own failure comes after the first.
    const double begun = processor_seconds();
    absorb_ranks(store, folder_);
    outcome_.gathering = processor_seconds() - begun;
  }

  const PlanOrFailure& own_;
  const fs::path& folder_;
  const RunOptions& options_;
  Peers& peers_;
  const std::function<bool()>& stop_;
  const RunObserver& show_;
  RanksOutcome outcome_;
};

}  // namespace

PlanOrFailure try_plan(const std::function<Plan()>& make) {
  PlanOrFailure result;
  const Failure failure = failure_of([&] { result.plan = make(); });
  result.status = failure.status;
  result.message = failure.message;
  return result;
}

RanksOutcome run_ranks(const PlanOrFailure& own, const fs::path& folder, const RunOptions& options, Peers& peers,
                       const std::function<bool()>& stop, const RunObserver& show) {
  if (peers.rank() == 0) return Leader(own, folder, options, peers, stop, show).run();
  RanksOutcome outcome;
  outcome.status = Worker(own, folder, options, peers, stop).run();
  return outcome;
}

}  // namespace hysteron

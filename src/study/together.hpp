// One study by several processes: the first hands out runs, every process works and has a store of its own.
//
// A rank asks the first for a batch of runs, does them, and tells with the next question how long they took. The first
// rank answers from its main thread while it works in another one, writes to DIR/store.sqlite, and takes in DIR/rank-K
// of the others at the end. Nothing but the indices of runs and their lengths goes over the wire: results stay in the
// stores, so that a rank that dies loses the runs it has not stored and nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "study/run.hpp"

namespace hysteron {

// What the ranks need of a message-passing library. Calls come from one thread at a time, of any of the process.
class Peers {
 public:
  struct Message {
    int from = 0;
    std::string bytes;
  };
  Peers() = default;
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;
  Peers(Peers&&) = delete;
  Peers& operator=(Peers&&) = delete;
  virtual ~Peers() = default;
  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;
  virtual void send(int to, const std::string& bytes) = 0;
  // A message that has come, none when there is none yet.
  virtual std::optional<Message> poll() = 0;
};

// How a study by several ranks ended, the same on all of them; what follows the status on the first only.
struct RanksOutcome {
  int status = 0;             // exit status: 0, 1 and 2 as everywhere, 130 interrupted
  std::string message;        // what failed, and on which rank
  RunProgress progress;       // over all ranks
  std::size_t questions = 0;  // of the other ranks
  double answering = 0.0;     // s of processor time, spent on them
  double gathering = 0.0;     // s of processor time, spent on taking in the stores of the others
};

// The same call on every rank: a plan, or why there is none (an error's text and exit status). Throws nothing that a
// rank alone would know of.
struct PlanOrFailure {
  std::optional<Plan> plan;
  int status = 0;
  std::string message;
};
PlanOrFailure try_plan(const std::function<Plan()>& make);

// `show` is called on the first rank only, from one thread at a time.
RanksOutcome run_ranks(const PlanOrFailure& own, const std::filesystem::path& folder, const RunOptions& options,
                       Peers& peers, const std::function<bool()>& stop, const RunObserver& show);

}  // namespace hysteron

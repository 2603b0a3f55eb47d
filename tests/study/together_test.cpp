// Several ranks in one process: messages go through queues, so that the protocol is tested without MPI too.
#include "study/together.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "core/error.hpp"
#include "io/temporary_folder.hpp"
#include "study/dispatch.hpp"
#include "study/gather.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

struct Mailboxes {
  std::mutex mutex;
  std::vector<std::deque<Peers::Message>> boxes;
};

class QueuePeers : public Peers {
 public:
  QueuePeers(Mailboxes& mail, int rank) : mail_(mail), rank_(rank) {}
  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return static_cast<int>(mail_.boxes.size()); }
  void send(int to, const std::string& bytes) override {
    const std::lock_guard guard(mail_.mutex);
    mail_.boxes[static_cast<std::size_t>(to)].push_back({rank_, bytes});
  }
  std::optional<Message> poll() override {
    const std::lock_guard guard(mail_.mutex);
    auto& box = mail_.boxes[static_cast<std::size_t>(rank_)];
    if (box.empty()) return {};
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  Mailboxes& mail_;
  int rank_;
};

Study small_study(std::uint64_t seeds) {
  Study study;
  study.title = "test";
  study.models = {{"viscous", "viscous", {}, {}, 0}};
  study.data = {{"twin", "rd8040-twin", {}, {}, 1, {"2.0Hz_1.0A"}, false, 0}};
  study.solvers = {{"pso", "pso", {}, 0}, {"cma-es", "cma-es", {}, 0}};
  study.budgets = {60};
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) study.seeds.push_back(seed);
  study.objective.threads = 1;
  return study;
}

std::string bytes_of(const fs::path& folder) {
  std::string bytes;
  const Store store = Store::open(folder, Store::Mode::read);
  for (const RunRecord& record : store.records()) bytes += record_text(record) + "\n";
  return bytes;
}

// plans[k] is what rank k makes of the study.
std::vector<RanksOutcome> run_all(const std::vector<PlanOrFailure>& plans, const fs::path& folder,
                                  const RunObserver& show = {}) {
  Mailboxes mail;
  mail.boxes.resize(plans.size());
  std::vector<RanksOutcome> outcomes(plans.size());
  std::vector<std::thread> ranks;
  for (std::size_t k = 0; k < plans.size(); ++k) {
    ranks.emplace_back([&, k] {
      QueuePeers peers(mail, static_cast<int>(k));
      RunOptions options;
      options.threads = 1;
      outcomes[k] = run_ranks(plans[k], folder, options, peers, {}, show);
    });
  }
  for (std::thread& rank : ranks) rank.join();
  return outcomes;
}

std::vector<PlanOrFailure> same_plan(std::size_t ranks, std::uint64_t seeds = 12) {
  return {ranks, try_plan([&] { return make_plan(small_study(seeds), "test"); })};
}

TEST(Together, AnyNumberOfRanksGivesTheSameRecords) {
  const TemporaryFolder folder;
  const auto single = same_plan(1);
  {
    Store store = Store::open(folder.path() / "single", Store::Mode::write);
    run_plan(*single[0].plan, store, {}, {}, {});
  }
  const std::string expected = bytes_of(folder.path() / "single");
  for (const std::size_t ranks : {1U, 2U, 5U}) {
    const fs::path out = folder.path() / std::to_string(ranks);
    const auto outcomes = run_all(same_plan(ranks), out);
    for (const RanksOutcome& outcome : outcomes) EXPECT_EQ(outcome.status, 0) << outcome.message;
    EXPECT_EQ(outcomes[0].progress.done, 24U);
    EXPECT_TRUE(rank_folders(out).empty());
    EXPECT_EQ(bytes_of(out), expected) << ranks << " ranks";
  }
}

TEST(Together, EveryRunIsToldOnce) {
  const TemporaryFolder folder;
  std::set<std::size_t> shown;
  run_all(same_plan(3, 40), folder.path(), [&](const RunProgress& now) { shown.insert(now.index); });
  EXPECT_EQ(shown.size(), 80U) << "every run is told once, whoever did it";
}

TEST(Together, TakesInWhatAnEarlierCallLeft) {
  const TemporaryFolder folder;
  const auto plans = same_plan(1);
  const Plan& plan = *plans[0].plan;
  // As after a kill: five runs in the study's own store, seven in that of a rank that is not there any more.
  const auto leave = [&](const fs::path& where, std::size_t first, std::size_t count) {
    Store store = Store::open(where, Store::Mode::write);
    std::size_t at = first;
    run_from(plan, store, 1, {}, [&] { return at < first + count ? std::optional(at++) : std::nullopt; }, {}, {});
  };
  leave(folder.path(), 0, 5);
  leave(rank_folder(folder.path(), 7), 3, 7);
  {
    Store read = open_gathered(folder.path());
    EXPECT_EQ(read.keys().size(), 10U);
  }
  const auto outcomes = run_all(same_plan(2), folder.path());
  EXPECT_EQ(outcomes[0].status, 0) << outcomes[0].message;
  EXPECT_EQ(outcomes[0].progress.found, 10U);
  EXPECT_EQ(outcomes[0].progress.done, 14U);
  EXPECT_TRUE(rank_folders(folder.path()).empty());
  run_all(plans, folder.path() / "fresh");
  EXPECT_EQ(bytes_of(folder.path()), bytes_of(folder.path() / "fresh"));
}

TEST(Together, AFailureOnOneRankEndsAllWithItsStatus) {
  const TemporaryFolder folder;
  auto plans = same_plan(3);
  plans[2] = try_plan([]() -> Plan { throw InputError("far.csv", 3, "is wrong"); });
  auto outcomes = run_all(plans, folder.path() / "a");
  for (const RanksOutcome& outcome : outcomes) EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcomes[0].message, "rank 2: far.csv:3: is wrong");
  EXPECT_FALSE(fs::exists(folder.path() / "a"));

  plans[2] = try_plan([] { return make_plan(small_study(3), "test"); });
  outcomes = run_all(plans, folder.path() / "b");
  for (const RanksOutcome& outcome : outcomes) EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcomes[0].message.find("rank 2: the study"), std::string::npos) << outcomes[0].message;

  // A rank whose store is of another kind: the others finish what they have, and nothing is taken for done.
  folder.write("c/rank-2/store.sqlite", "not a store, but long enough to look at: " + std::string(2000, 'x'));
  outcomes = run_all(same_plan(3), folder.path() / "c");
  for (const RanksOutcome& outcome : outcomes) EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcomes[0].message.find("rank-2"), std::string::npos) << outcomes[0].message;
}

TEST(Gather, RefusesTwoResultsOfOneRun) {
  const TemporaryFolder folder;
  const auto plans = same_plan(1, 2);
  run_all(plans, folder.path());
  RunRecord other = Store::open(folder.path(), Store::Mode::read).records().front();
  other.nrmse = 0.5;
  {
    Store store = Store::open(rank_folder(folder.path(), 1), Store::Mode::write);
    store.add(other, {other.key, 0.1, "host", 1, 1});
  }
  Store store = Store::open(folder.path(), Store::Mode::write);
  EXPECT_THROW(absorb_ranks(store, folder.path()), InputError);
  EXPECT_TRUE(fs::exists(rank_folder(folder.path(), 1) / "store.sqlite"));
}

TEST(Dispatcher, HandsOutEveryRunOnce) {
  std::vector<Assignment> todo;
  for (std::size_t k = 0; k < 500; ++k) todo.push_back({k, k % 7, 1.0 + static_cast<double>(k % 3)});
  Dispatcher dispatcher(todo, 4);
  std::set<std::size_t> seen;
  std::size_t largest = 0;
  for (auto batch = dispatcher.take(); !batch.empty(); batch = dispatcher.take()) {
    largest = std::max(largest, batch.size());
    for (const std::size_t run : batch) {
      EXPECT_TRUE(seen.insert(run).second) << run;
      dispatcher.finished(run, 0.01);
    }
  }
  EXPECT_EQ(seen.size(), 500U);
  EXPECT_GT(largest, 5U) << "short runs must share a message";
  EXPECT_LE(largest, 30U) << "0.25 s of runs of 10 ms, and a rounding";
}

TEST(Dispatcher, LongRunsGoOutOneByOneAndTheLargestFirst) {
  std::vector<Assignment> todo;
  for (std::size_t k = 0; k < 40; ++k) todo.push_back({k, k < 20 ? 0U : 1U, k < 20 ? 1.0 : 50.0});
  Dispatcher dispatcher(todo, 2);
  for (std::size_t k = 0; k < 20; ++k) {
    const auto batch = dispatcher.take();
    ASSERT_EQ(batch.size(), 1U);
    EXPECT_EQ(batch[0], 20 + k);
    dispatcher.finished(batch[0], 5.0);
  }
  dispatcher.halt();
  EXPECT_TRUE(dispatcher.take().empty());
}

}  // namespace
}  // namespace hysteron

// The work that recordings did before another began, against sums by hand.
#include "core/earlier_work.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/recording.hpp"

namespace hysteron {
namespace {

// A constant force over a straight stroke: 100 N times `stroke` in `seconds`.
Recording straight(const std::string& file, double started, double seconds, double stroke) {
  Recording recording;
  recording.file = file;
  recording.started = started;
  for (int n = 0; n <= 100; ++n) {
    const double part = n / 100.0;
    recording.time.push_back(5.0 + part * seconds);
    recording.displacement.push_back(part * stroke);
    recording.velocity.push_back(stroke / seconds);
    recording.force.push_back(100.0);
  }
  return recording;
}

double total(const Recording& recording) {
  double sum = 0.0;
  for (const EarlierWork& stretch : recording.earlier) sum += stretch.work;
  return sum;
}

// What is left of the heat with the time constant tau.
double faded(const std::vector<EarlierWork>& earlier, double tau) {
  double sum = 0.0;
  for (const EarlierWork& stretch : earlier) sum += stretch.work * std::exp(-stretch.ago / tau);
  return sum;
}

TEST(EarlierWork, IsThatOfTheRecordingsStartedBefore) {
  std::vector<Recording> recordings = {straight("c.csv", 2000.0, 10.0, 0.3), straight("a.csv", 1000.0, 10.0, 0.1),
                                       straight("b.csv", 1100.0, 20.0, 0.2)};
  EXPECT_FALSE(carry_work(recordings).has_value());
  EXPECT_TRUE(recordings[1].earlier.empty()) << "the first";
  EXPECT_NEAR(total(recordings[2]), 10.0, 1e-12);
  EXPECT_NEAR(total(recordings[0]), 30.0, 1e-12);
  for (std::size_t k = 1; k < recordings[0].earlier.size(); ++k) {
    EXPECT_GT(recordings[0].earlier[k - 1].ago, recordings[0].earlier[k].ago);
  }
}

TEST(EarlierWork, FadesAsTheHeatOfEveryMomentDoes) {
  std::vector<Recording> recordings = {straight("a.csv", 0.0, 100.0, 1.0), straight("b.csv", 110.0, 5.0, 0.1)};
  ASSERT_FALSE(carry_work(recordings).has_value());
  // 1 W from 0 to 100 s, seen at 110 s: tau (exp(-10 / tau) - exp(-110 / tau)).
  for (const double tau : {20.0, 50.0, 300.0}) {
    const double exact = tau * (std::exp(-10.0 / tau) - std::exp(-110.0 / tau));
    EXPECT_NEAR(faded(recordings[1].earlier, tau), exact, 0.01 * exact) << tau;
  }
}

TEST(EarlierWork, OldStretchesArePutTogether) {
  std::vector<Recording> recordings;
  double exact = 0.0;
  constexpr double tau = 2000.0;
  for (int k = 0; k < 100; ++k) {
    recordings.push_back(straight("r.csv", 100.0 * k, 50.0, 0.5));
    const double end = 10000.0 - 100.0 * k - 50.0;
    exact += tau * (std::exp(-end / tau) - std::exp(-(end + 50.0) / tau));
  }
  recordings.push_back(straight("last.csv", 10000.0, 50.0, 0.5));
  ASSERT_FALSE(carry_work(recordings).has_value());
  EXPECT_LT(recordings.back().earlier.size(), 100U);
  EXPECT_NEAR(total(recordings.back()), 5000.0, 1e-9);
  EXPECT_NEAR(faded(recordings.back().earlier, tau), exact, 0.01 * exact);
}

TEST(EarlierWork, NeedsAllStartsAndForces) {
  std::vector<Recording> recordings = {straight("a.csv", 0.0, 10.0, 0.1), straight("b.csv", 100.0, 10.0, 0.1)};
  recordings[0].started.reset();
  EXPECT_FALSE(carry_work(recordings).has_value());
  EXPECT_TRUE(recordings[1].earlier.empty());
  recordings[0].started = 0.0;
  recordings[0].force.clear();
  EXPECT_FALSE(carry_work(recordings).has_value());
  EXPECT_TRUE(recordings[1].earlier.empty());
}

TEST(EarlierWork, TellsStartsThatContradictTheRecordings) {
  std::vector<Recording> recordings = {straight("a.csv", 0.0, 600.0, 0.1), straight("b.csv", 300.0, 10.0, 0.1)};
  const auto contradiction = carry_work(recordings);
  ASSERT_TRUE(contradiction.has_value());
  EXPECT_EQ(contradiction->file, "b.csv");
  EXPECT_TRUE(contradiction->why.starts_with("was started 300 s after a.csv, which takes 600 s")) << contradiction->why;
  EXPECT_TRUE(recordings[1].earlier.empty());
  // A clock of whole minutes.
  recordings[1].started = 540.0;
  EXPECT_FALSE(carry_work(recordings).has_value());
  EXPECT_NEAR(total(recordings[1]), 10.0, 1e-12);
  // The same overlap of a clock that tells seconds.
  recordings[0].started = 0.5;
  EXPECT_TRUE(carry_work(recordings).has_value());
  // Written by a program one after the other.
  recordings = {straight("a.csv", 0.0, 20.0, 0.1), straight("b.csv", 0.5, 20.0, 0.1)};
  EXPECT_TRUE(carry_work(recordings).has_value());
}

}  // namespace
}  // namespace hysteron

#include "io/time_packets.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/csv.hpp"

namespace hysteron {
namespace {

constexpr int count = 1000;
double at(double t) { return 0.02 * std::sin(2.0 * std::numbers::pi * t); }

// Samples every 2 ms whose stamps are those of packets: `within` from one to the next, in step at each packet's start.
double stamp(int n, int samples, double within) { return 0.002 * (n - n % samples) + within * (n % samples); }

using Of = std::function<double(int sample)>;
std::optional<TimePackets> packets(const Of& time, const Of& displacement) {
  std::vector<double> t;
  std::vector<double> x;
  for (int n = 0; n < count; ++n) {
    t.push_back(time(n));
    x.push_back(displacement(n));
  }
  return time_packets_of(t, x);
}

TEST(TimePackets, StampsOfPacketsAreNotThoseOfSamples) {
  for (const int samples : {3, 10, 50}) {
    const auto found = packets([&](int n) { return stamp(n, samples, 0.0012); }, [](int n) { return at(0.002 * n); });
    ASSERT_TRUE(found) << samples;
    EXPECT_EQ(found->samples, static_cast<std::size_t>(samples));
    EXPECT_NEAR(found->step, 0.002, 1e-12);
    EXPECT_NEAR(found->between, 0.0012 + 0.0008 * samples, 1e-12);
    EXPECT_TRUE(found->even);
  }
}

// The displacement goes on during a longer step that is one, however regular these are.
TEST(TimePackets, SamplesInBurstsAreWhereTheirTimesAre) {
  const Stream noise(7);
  for (const double within : {0.0001, 0.0005, 0.0012, 0.0018}) {
    const Of time = [=](int n) { return stamp(n, 10, within); };
    for (const double scatter : {0.0, 2e-5, 2e-4, 2e-3}) {
      EXPECT_FALSE(
          packets(time, [&](int n) { return at(time(n)) + scatter * noise.normal(static_cast<std::uint64_t>(n)); }))
          << within << " " << scatter;
    }
  }
}

// Samples that an encoder takes at every step: the displacement is even by nature, and its reversals take longer.
TEST(TimePackets, SamplesOfAnEncoderAreWhereTheirTimesAre) {
  EXPECT_FALSE(packets([](int n) { return 0.002 * n + 0.003 * (n / 20); },
                       [](int n) { return 1e-4 * (n / 20 % 2 == 0 ? n % 20 : 20 - n % 20); }));
}

TEST(TimePackets, UnevenTimesWithoutPackets) {
  const Stream random(5);
  for (const double jitter : {0.0003, 0.0009}) {
    EXPECT_FALSE(packets([&](int n) { return 0.002 * n + jitter * random.uniform(static_cast<std::uint64_t>(n)); },
                         [](int n) { return at(0.002 * n); }));
  }
  double t = 0.0;
  EXPECT_FALSE(
      packets([&](int n) { return t -= 0.002 * std::log(1e-9 + random.uniform(static_cast<std::uint64_t>(n))); },
              [&](int) { return at(t); }));
}

Recording read(const Of& time, std::vector<std::string>& said) {
  std::string text = "time [s],displacement [m],force [N]\n";
  for (int n = 0; n < count; ++n) {
    const double taken = 0.002 * n;
    text += fmt::format("{:.9f},{:.9f},{:.6f}\n", time(n), at(taken), 900.0 * std::cos(6.0 * taken));
  }
  ReadOptions options;
  options.remark = [&](const Remark& remark) { said.push_back(remark.text.plain()); };
  return parse_csv(text, "a.csv", options);
}

TEST(TimePackets, AreEvenedOutWithAWord) {
  std::vector<std::string> said;
  const Recording recording = read([](int n) { return stamp(n, 10, 0.0012); }, said);
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said[0],
            "the times come in packets of 10 samples, 1.2 ms apart and 9.2 ms to the next packet, and the displacement "
            "goes no further over a long step than over a short one: they tell when packets arrived; the samples are "
            "taken as evenly spaced, by 2 ms");
  EXPECT_NEAR(recording.time[517], 0.002 * 517, 1e-9);
  EXPECT_NEAR(recording.velocity[500], 0.02 * 2.0 * std::numbers::pi, 1e-4);
}

// One packet that is missing, over which the displacement goes far, does not hide the others.
TEST(TimePackets, AreFoundThoughOneIsMissing) {
  const auto sample = [](int n) { return n < 500 ? n : n + 10; };
  const auto found =
      packets([&](int n) { return stamp(sample(n), 10, 0.0012); }, [&](int n) { return at(0.002 * sample(n)); });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->samples, 10U);
  EXPECT_FALSE(found->even);
}

// Where packets are missing there is no even spacing.
TEST(TimePackets, OfWhichSomeAreMissingAreToldAlone) {
  std::vector<std::string> said;
  const Of time = [](int n) { return stamp(n, 10, 0.0012) + (n < 400 ? 0.0 : 0.5); };
  const Recording recording = read(time, said);
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(said[0].ends_with(
      "they tell when packets arrived, and not all packets are there: velocities are wrong; record the times of the "
      "samples"))
      << said[0];
  EXPECT_NEAR(recording.time[517], time(517), 1e-9);
}

}  // namespace
}  // namespace hysteron

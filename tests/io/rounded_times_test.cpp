#include "io/rounded_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "io/csv.hpp"

namespace hysteron {
namespace {

double at(double t) { return 0.02 * std::sin(2.0 * std::numbers::pi * t); }

std::optional<RoundedTimes> rounded(const std::function<double(double n)>& stamp,
                                    const std::function<double(double n)>& displacement) {
  std::vector<double> t;
  std::vector<double> x;
  for (int n = 0; n < 1000; ++n) {
    t.push_back(stamp(n));
    x.push_back(displacement(n));
  }
  return rounded_times_of(t, x);
}

TEST(RoundedTimes, AnEvenGridInMilliseconds) {
  for (const double rate : {30.0, 256.0, 400.0, 512.0, 600.0}) {
    const auto found =
        rounded([=](double n) { return 1e-3 * std::round(1e3 * n / rate); }, [=](double n) { return at(n / rate); });
    ASSERT_TRUE(found) << rate;
    EXPECT_NEAR(found->step, 1.0 / rate, 1e-6 / rate * 100.0);
    EXPECT_NEAR(found->resolution, 1e-3, 1e-9);
    EXPECT_NEAR(found->start, 0.0, 5e-4);
  }
}

TEST(RoundedTimes, InSinglePrecision) {
  const auto found = rounded([](double n) { return static_cast<double>(static_cast<float>(3e4 + 0.003 * n)); },
                             [](double n) { return at(0.003 * n); });
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->step, 0.003, 1e-6);
}

TEST(RoundedTimes, StepsThatAreRealStay) {
  const auto ticks = [](double n) { return 1e-3 * std::round(2.5 * n); };
  EXPECT_FALSE(rounded(ticks, [&](double n) { return at(ticks(n)); }));
  // Uneven by more than the resolution of the stamps.
  const Stream noise(5);
  const auto late = [&](double n) {
    return 1e-3 * std::round(1e3 * (0.005 * n + 8e-4 * noise.normal(static_cast<std::uint64_t>(n))));
  };
  EXPECT_FALSE(rounded(late, [](double n) { return at(0.005 * n); }));
  // A resolution that makes no difference, and noise that hides it.
  EXPECT_FALSE(
      rounded([](double n) { return 1e-6 * std::round(1e6 * n / 300.0); }, [](double n) { return at(n / 300.0); }));
  EXPECT_FALSE(
      rounded(ticks, [&](double n) { return at(0.0025 * n) + 5e-3 * noise.normal(static_cast<std::uint64_t>(n)); }));
}

TEST(RoundedTimes, AreTakenAsEvenAndTold) {
  std::string text = "time [s],displacement [m],force [N]\n";
  for (int n = 0; n < 200; ++n) {
    const double t = 0.0025 * n;
    text += std::to_string(1e-3 * std::round(1e3 * t)) + "," + std::to_string(at(t)) + "," +
            std::to_string(std::cos(6.28 * t)) + "\n";
  }
  ReadOptions options;
  std::vector<std::string> said;
  options.remark = [&](const Remark& remark) {
    if (remark.key == "rounded times") said.push_back(remark.text.plain());
  };
  const Recording recording = parse_csv(text, "r.csv", options);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said.front().find("the times are rounded to 1 ms, which makes steps of 2 and 3 ms"), 0U);
  EXPECT_NEAR(recording.time[101] - recording.time[100], 0.0025, 1e-5);
}

}  // namespace
}  // namespace hysteron

#include "check/copies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/random.hpp"

namespace hysteron {
namespace {

// A test of 2000 samples with noise of its own; resting with a force of zero in the first 500.
Recording test(const std::string& file, std::uint64_t seed) {
  const Stream noise(seed);
  Recording result;
  result.file = file;
  result.sha256 = file;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const double phase = n < 500 ? 0.0 : 0.02 * static_cast<double>(n - 500);
    result.time.push_back(0.002 * static_cast<double>(n));
    result.displacement.push_back(0.01 * std::sin(phase));
    result.force.push_back(n < 500 ? 0.0 : 800.0 * std::sin(phase + 1.0) + noise.normal(n));
  }
  return result;
}

Recording part_of(const Recording& whole, const std::string& file, std::ptrdiff_t first, std::ptrdiff_t last) {
  Recording result;
  result.file = file;
  result.sha256 = file;
  for (const auto& [from, to] :
       {std::pair(&whole.time, &result.time), std::pair(&whole.displacement, &result.displacement),
        std::pair(&whole.force, &result.force)}) {
    to->assign(from->begin() + first, from->begin() + last);
  }
  return result;
}

std::vector<std::string> said_of(const std::vector<Recording>& recordings) {
  std::vector<std::string> lines;
  for (const Remark& remark : remarks_on_copies(recordings)) lines.push_back(remark.file + ": " + remark.text.plain());
  return lines;
}

using Lines = std::vector<std::string>;

TEST(Copies, APartCutOutOfARecording) {
  const Recording whole = test("a", 1);
  EXPECT_EQ(said_of({whole, test("b", 2), part_of(whole, "c", 700, 1700)}),
            Lines{"c: samples 1 to 1000 have the displacement and force of samples 701 to 1700 of a, digit for digit, "
                  "as a part cut out of one recording has: neither is held out from the other"});
  EXPECT_EQ(said_of({part_of(whole, "b", 2, 2000), whole}),
            Lines{"a: samples 3 to 2000 have the displacement and force of samples 1 to 1998 of b, digit for digit, as "
                  "a part cut out of one recording has: neither is held out from the other"});
}

// Written again with steps of `displacement` and `force`.
Recording rounded(Recording recording, double displacement, double force) {
  for (double& x : recording.displacement) x = displacement * std::round(x / displacement);
  for (double& f : recording.force) f = force * std::round(f / force);
  for (double& t : recording.time) t -= recording.time.front();
  return recording;
}

TEST(Copies, APartCutOutOfARecordingWithOtherDigits) {
  const Recording whole = test("a", 1);
  // Of a thousandth, of the noise, and four times as coarse as that.
  for (const double step : {0.01, 1.0, 4.0}) {
    const Recording part = rounded(part_of(whole, "c", 700, 1700), 1e-6, step);
    EXPECT_EQ(said_of({whole, test("b", 2), part}),
              Lines{"c: samples 1 to 1000 have the displacement and force of samples 701 to 1700 of a, but for the "
                    "rounding of their digits, as a part cut out of one recording has: neither is held out from the "
                    "other"})
        << step;
  }
  // The coarser one before, and longer; the whole of one, coarser than its noise.
  const Recording coarse = rounded(test("b", 1), 1e-5, 4.0);
  EXPECT_EQ(said_of({coarse, part_of(whole, "c", 700, 1700)}).size(), 1U);
  EXPECT_EQ(said_of({whole, rounded(test("b", 1), 1e-5, 6.0)}).size(), 1U);
  // Of numbers that are rounded already, to a tenth of the step.
  EXPECT_EQ(said_of({rounded(whole, 1e-6, 0.1), rounded(part_of(whole, "c", 700, 1700), 1e-5, 1.0)}).size(), 1U);
}

// Honest repeats: noise of their own is rounded apart, however coarse the digits are.
TEST(Copies, TestsOfOneMotionInCoarseDigitsAreNone) {
  for (const double step : {0.1, 1.0, 4.0, 20.0}) {
    const Recording part = rounded(part_of(test("b", 2), "c", 700, 1700), 1e-5, step);
    EXPECT_EQ(said_of({test("a", 1), part}), Lines{}) << step;
    EXPECT_EQ(said_of({rounded(test("a", 1), 1e-5, step), part}), Lines{}) << step;
  }
  // The force alone is no copy.
  Recording moved = part_of(test("a", 1), "c", 700, 1700);
  for (double& x : moved.displacement) x += 2e-5;
  EXPECT_EQ(said_of({test("a", 1), rounded(moved, 1e-6, 1.0)}), Lines{});
}

TEST(Copies, TestsOfOneMotionAreNone) {
  const Recording one = test("a", 1);
  EXPECT_EQ(said_of({one, test("b", 2), test("c", 3)}), Lines{});
  // The same rest at their start.
  EXPECT_EQ(said_of({part_of(one, "a", 0, 900), part_of(test("b", 2), "b", 0, 800)}), Lines{});
  // A force in few steps repeats itself.
  Recording coarse = part_of(one, "a", 500, 1500);
  for (double& force : coarse.force) force = 500.0 * std::round(force / 500.0);
  for (double& x : coarse.displacement) x = 0.0;
  EXPECT_EQ(said_of({coarse, part_of(coarse, "b", 100, 900)}), Lines{});
}

}  // namespace
}  // namespace hysteron

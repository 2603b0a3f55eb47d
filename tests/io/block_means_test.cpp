#include "io/block_means.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"
#include "io/campaign.hpp"
#include "io/csv.hpp"
#include "io/sha256.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::TemporaryFolder;

constexpr double pi = std::numbers::pi;

// A sine of 10 mm, with the drive stepping in the middle and the force in phase with the velocity.
std::string sine(std::size_t rows, double step, double frequency, double noise_mm = 0.0) {
  std::string text = "time [s],displacement [mm],force [N],current [A],oil [bar]\n";
  text.reserve(rows * 48);
  const Stream stream(7);
  for (std::size_t n = 0; n < rows; ++n) {
    const double t = step * static_cast<double>(n);
    char row[128];
    const int length =
        std::snprintf(row, sizeof row, "%.7f,%.7f,%.5f,%g,5\n", t,
                      10.0 * std::sin(2.0 * pi * frequency * t) + (noise_mm > 0.0 ? noise_mm * stream.normal(n) : 0.0),
                      100.0 * std::cos(2.0 * pi * frequency * t), 2 * n < rows ? 0.5 : 1.5);
    text.append(row, static_cast<std::size_t>(length));
  }
  return text;
}

struct Told {
  std::vector<Remark> remarks;
  ReadOptions options;
  explicit Told(std::size_t keep) {
    options.keep_samples = keep;
    options.remark = [this](const Remark& remark) { remarks.push_back(remark); };
  }
};

TEST(BlockMeans, AllChannelsAreCentredOnTheirTime) {
  const double frequency = 1.0;
  Told told(2000);
  const Recording r = parse_csv(sine(20000, 1e-3, frequency, 0.05), "a.csv", told.options);
  ASSERT_EQ(r.size(), 2000U);
  // Amplitude and phase of the averages by correlation over whole periods.
  const auto wave = [&](const std::vector<double>& channel) {
    double in = 0.0;
    double out = 0.0;
    for (std::size_t n = 0; n < r.size(); ++n) {
      in += 2.0 * channel[n] * std::sin(2.0 * pi * frequency * r.time[n]) / static_cast<double>(r.size());
      out += 2.0 * channel[n] * std::cos(2.0 * pi * frequency * r.time[n]) / static_cast<double>(r.size());
    }
    return std::pair(in, out);
  };
  const double shrunk = std::sin(pi * 0.01) / (0.01 * pi);
  EXPECT_NEAR(wave(r.displacement).first, 0.01 * shrunk, 3e-6);
  EXPECT_NEAR(wave(r.displacement).second, 0.0, 3e-6);
  EXPECT_NEAR(wave(r.force).second, 100.0 * shrunk, 1e-3);
  EXPECT_NEAR(wave(r.force).first, 0.0, 1e-3);
  EXPECT_NEAR(r.time[0], 4.5e-3, 1e-12);
  ASSERT_EQ(r.unused.size(), 1U);
  EXPECT_DOUBLE_EQ(r.unused[0].mean, 5.0);
  ASSERT_EQ(told.remarks.size(), 1U);
  EXPECT_EQ(told.remarks[0].text.plain(),
            "20,000 samples read, every 10 averaged to one: 2,000 kept, 10 ms apart; keep samples 20000 keeps all");
}

TEST(BlockMeans, NoiseFallsByTheRootAndAStepStaysWithinOneSample) {
  Told told(2000);
  const Recording r = parse_csv(sine(33000, 1e-3, 0.25, 0.2), "a.csv", told.options);
  double square = 0.0;
  for (std::size_t n = 0; n < r.size(); ++n) {
    const double away = r.displacement[n] - 0.01 * std::sin(0.5 * pi * r.time[n]);
    square += away * away / static_cast<double>(r.size());
  }
  EXPECT_NEAR(std::sqrt(square), 2e-4 / std::sqrt(17.0), 1e-5);
  EXPECT_LE(std::ranges::count_if(r.drive, [](double i) { return i > 0.5 + 1e-12 && i < 1.5 - 1e-12; }), 1);
}

TEST(BlockMeans, AMotionTooFastForThemIsTold) {
  Told told(2000);
  (void)parse_csv(sine(20000, 1e-3, 7.0), "a.csv", told.options);
  ASSERT_EQ(told.remarks.size(), 1U);
  EXPECT_NE(told.remarks[0].text.plain().find("the motion is too fast for that"), std::string::npos)
      << told.remarks[0].text.plain();
  // What it asks for is enough.
  const std::string text = told.remarks[0].text.plain();
  const std::size_t at = text.find("expected ") + 9;
  std::string number = text.substr(at, text.find(' ', at) - at);
  std::erase(number, ',');
  Told more(std::stoul(number));
  (void)parse_csv(sine(20000, 1e-3, 7.0), "a.csv", more.options);
  for (const Remark& remark : more.remarks)
    EXPECT_EQ(remark.text.plain().find("too fast"), std::string::npos) << remark.text.plain();
}

TEST(BlockMeans, ShortRecordingsKeepAllTheirSamples) {
  EXPECT_EQ(kept_of_each({100, 5000, 1000000, 2000000}, 1000000), 497450U);
  EXPECT_EQ(kept_of_each({100, 200}, 1000000), 1000000U);
  EXPECT_EQ(kept_of_each(std::vector<std::size_t>(10000, 3000), 1000000), 2000U);
  const TemporaryFolder folder;
  folder.write("data/long.csv", sine(30000, 1e-3, 1.0));
  folder.write("data/short.csv", sine(2500, 1e-3, 1.0));
  Told told(12500);
  const Campaign campaign = load_campaign({(folder.path() / "data").string()}, told.options);
  EXPECT_EQ(campaign.recordings[0].size(), 10000U);
  EXPECT_EQ(campaign.recordings[1].size(), 2500U);
}

// Longer than what is in memory at a time.
TEST(CsvFile, IsReadInPiecesAsItIsInOne) {
  const TemporaryFolder folder;
  const std::string text = sine(520000, 1e-4, 1.0);
  ASSERT_GT(text.size(), std::size_t{18} << 20U);
  const auto path = folder.write("a.csv", text);
  const Recording one = parse_csv(text, "a.csv");
  const Recording pieces = load_recording(path);
  EXPECT_EQ(one.time, pieces.time);
  EXPECT_EQ(one.displacement, pieces.displacement);
  EXPECT_EQ(one.force, pieces.force);
  EXPECT_EQ(one.drive, pieces.drive);
  EXPECT_EQ(pieces.sha256, sha256_hex(text));
  folder.write("b.csv", text + "60.0,1,2,x,3\n");
  try {
    (void)load_recording(folder.path() / "b.csv");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder.path() / "b.csv").string() + ":520002: current 'x' is not a number, expected a finite number");
  }
}

}  // namespace
}  // namespace hysteron

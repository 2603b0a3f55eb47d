// Recordings that ship: the bytes that were converted, with licence and card, in sensible units; a missing or altered
// file is refused.
#include "datasets/support/shipped.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "core/error.hpp"
#include "datasets/dataset.hpp"
#include "io/file.hpp"
#include "io/sha256.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::TemporaryFolder;

namespace fs = std::filesystem;

struct Known {
  std::size_t recordings;
  DriveKind drive;
  double low_half_stroke, high_half_stroke;  // m
  double low_peak, high_peak;                // N
};
// From the cards of the sources.
const std::map<std::string, Known> known{
    {"utfsm-mr-damper", {20, DriveKind::current, 1.5e-3, 25e-3, 200.0, 1800.0}},
    {"utfpr-mr-damper", {30, DriveKind::voltage, 3.5e-3, 21e-3, 200.0, 1100.0}},
    {"rotary-friction-damper", {12, DriveKind::none, 25e-3, 27e-3, 7e3, 20e3}},
};

TEST(Shipped, MeasuredDatasetsAreWholeAndInTheirUnits) {
  for (const auto& [id, expected] : known) {
    const DatasetEntry* entry = find_dataset(id);
    ASSERT_NE(entry, nullptr) << id;
    EXPECT_FALSE(entry->licence.empty()) << id;
    const Campaign campaign = entry->generate(Stream(1));
    ASSERT_EQ(campaign.recordings.size(), expected.recordings) << id;
    for (const Recording& recording : campaign.recordings) {
      SCOPED_TRACE(id + "/" + recording.file);
      EXPECT_EQ(recording.drive_kind, expected.drive);
      const auto [low, high] = std::ranges::minmax(recording.displacement);
      EXPECT_GT(0.5 * (high - low), expected.low_half_stroke);
      EXPECT_LT(0.5 * (high - low), expected.high_half_stroke);
      double peak = 0.0;
      for (const double force : recording.force) peak = std::max(peak, std::abs(force));
      EXPECT_GT(peak, expected.low_peak);
      EXPECT_LT(peak, expected.high_peak);
    }
  }
}

// Independent of load_shipped: every line of SHA256SUMS against the bytes of the source tree, every recording listed.
TEST(Shipped, ChecksumsAreThoseOfTheFilesAndLicencesStandBeside) {
  for (const auto& [id, expected] : known) {
    const fs::path folder = fs::path(HYSTERON_SOURCE_DIR) / "datasets" / id;
    EXPECT_GT(read_file(folder / "LICENSE").size(), 1000U) << id;
    EXPECT_NE(read_file(folder / "README.md").find("licence"), std::string::npos) << id;
    std::ifstream sums(folder / shipped_checksums);
    std::string digest;
    std::string name;
    std::size_t count = 0;
    for (; sums >> digest >> name; ++count)
      EXPECT_EQ(sha256_hex(read_file(folder / name)), digest) << id << "/" << name;
    EXPECT_EQ(count, expected.recordings);
  }
  EXPECT_NE(read_file(fs::path(HYSTERON_SOURCE_DIR) / "datasets/rotary-friction-damper/LICENSE")
                .find("Attribution-ShareAlike 4.0 International"),
            std::string::npos);
}

class Elsewhere : public ::testing::Test {
 protected:
  void SetUp() override {
    copy_ = folder_.path() / "utfsm-mr-damper";
    fs::copy(fs::path(HYSTERON_SOURCE_DIR) / "datasets/utfsm-mr-damper", copy_);
    setenv("HYSTERON_DATASETS", folder_.path().c_str(), 1);
  }
  void TearDown() override { unsetenv("HYSTERON_DATASETS"); }

  std::string message(const std::string& id = "utfsm-mr-damper") {
    try {
      (void)load_shipped(id);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder_;
  fs::path copy_;
};

TEST_F(Elsewhere, IsFoundAndChecked) {
  EXPECT_EQ(message(), "");
  std::ofstream(copy_ / "2mm5Hz_1.00A.csv", std::ios::app) << "100,0,0,1\n";
  EXPECT_TRUE(message().starts_with((copy_ / "2mm5Hz_1.00A.csv").string() + ": sha256 ")) << message();
  fs::remove(copy_ / "2mm5Hz_1.00A.csv");
  EXPECT_TRUE(message().starts_with((copy_ / "2mm5Hz_1.00A.csv").string() + ": the recording is missing")) << message();
}

TEST_F(Elsewhere, ARecordingTooManyIsRefused) {
  fs::copy(copy_ / "2mm5Hz_1.00A.csv", copy_ / "3mm.csv");
  EXPECT_TRUE(message().starts_with((copy_ / "3mm.csv").string() + ": not a recording of dataset")) << message();
}

TEST_F(Elsewhere, AMissingFolderSaysWhereItLooked) {
  EXPECT_NE(message("utfpr-mr-damper").find("looked in " + (folder_.path() / "utfpr-mr-damper").string()),
            std::string::npos)
      << message("utfpr-mr-damper");
}

}  // namespace
}  // namespace hysteron

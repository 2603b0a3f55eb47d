#include "io/output.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "core/error.hpp"
#include "io/csv.hpp"
#include "io/file.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using testing::message_of;
using testing::TemporaryFolder;

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

TEST(Output, WritesAndReplacesWithoutLeavingTemporaries) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.json";
  write_file_atomically(path, "one");
  write_file_atomically(path, "two");
  EXPECT_EQ(read_file(path), "two");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(Output, FollowsSymbolicLinksAndDevices) {
  const TemporaryFolder folder;
  folder.write("real.json", "old");
  std::filesystem::create_symlink("real.json", folder.path() / "link.json");
  write_file_atomically(folder.path() / "link.json", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.json"));
  EXPECT_EQ(read_file(folder.path() / "real.json"), "new");
  write_file_atomically("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Output, FailuresNameThePathAndTheReason) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "no/a.json";
  EXPECT_EQ(message_of<WorkError>([&] { write_file_atomically(missing, "x"); }),
            missing.string() + ": cannot be written: No such file or directory");
  EXPECT_EQ(message_of<WorkError>([&] { write_file_atomically(folder.path(), "x"); }),
            folder.path().string() + ": cannot be written: Is a directory");
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(message_of<WorkError>([&] { write_file_atomically("/dev/full", "x"); }),
              "/dev/full: cannot be written: No space left on device");
  }
  if (::geteuid() == 0) return;  // root may write anywhere
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const auto path = folder.path() / "a.json";
  EXPECT_EQ(message_of<WorkError>([&] { write_file_atomically(path, "x"); }),
            path.string() + ": cannot be written: Permission denied");
  EXPECT_EQ(
      message_of<InputError>([&] { make_output_folder(folder.path()); }),
      folder.path().string() + ": the folder cannot be written to (Permission denied), expected a writable place");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(Output, AFileWithoutANameIsAWrongInput) { EXPECT_THROW(write_file_atomically("", "a"), InputError); }

TEST(Output, MakesFolders) {
  const TemporaryFolder folder;
  make_output_folder(folder.path() / "a/b/c");
  make_output_folder(folder.path() / "a/b/c/");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a/b/c"));
  const auto file = folder.write("f", "x");
  EXPECT_EQ(message_of<InputError>([&] { make_output_folder(file); }),
            file.string() + ": exists and is not a folder, expected a folder for the results");
  EXPECT_EQ(message_of<InputError>([&] { make_output_folder(file / "below"); }),
            (file / "below").string() + ": the folder cannot be made (Not a directory), expected a writable place");
  EXPECT_EQ(message_of<InputError>([&] { make_output_folder(""); }),
            "the output folder has no name, expected a folder for the results");
}

TEST(Output, PredictionReadsBackExactly) {
  std::array<double, 9> time{};
  std::array<double, 9> force{};
  for (std::size_t i = 0; i < time.size(); ++i) {
    time[i] = 0.1 * static_cast<double>(i);
    force[i] = std::numbers::pi * 1e-3 * static_cast<double>(i) - 0.1;
  }
  const auto text = csv_of_prediction(time, force);
  EXPECT_TRUE(text.starts_with("time [s],force [N]\n0,-0.1\n0.1,"));
  const auto r = parse_csv(text, "p.csv", {{{"displacement", "force [m]"}}, false});
  EXPECT_TRUE(std::ranges::equal(r.time, time));
  EXPECT_TRUE(std::ranges::equal(r.displacement, force));
}

}  // namespace
}  // namespace hysteron

// A study of seconds, and the bytes of a study's report.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace hysteron::testing {

inline const std::string small_study =
    "schema = \"hysteron.study/1\"\ntitle = \"test\"\nmodels = [\"viscous\"]\n"
    "solvers = [\"pso\", \"cma-es\", \"multistart-lm\"]\nbudgets = [60, 150]\nseeds = 5\ntarget_nrmse = [0.3]\n"
    "[[data]]\ndataset = \"rd8040-twin\"\nlabel = \"twin\"\nonly = [\"2.0Hz_1.0A\", \"0.4Hz_0.0A\"]\neach = true\n";
inline constexpr std::size_t small_runs = 60;

// Every file of a report that may not vary.
inline std::string report_bytes(const std::filesystem::path& folder, const std::string& study) {
  const Outcome outcome = run({"report", study, "--out", study + "-report", "--ioh"}, folder);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / (study + "-report"))) {
    if (entry.is_regular_file() && entry.path().filename() != "environment.json") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::string bytes;
  for (const std::filesystem::path& file : files) {
    bytes += std::filesystem::relative(file, folder / (study + "-report")).string() + "\n" + read(file) + "\n";
  }
  EXPECT_GT(files.size(), 8U);
  return bytes;
}

}  // namespace hysteron::testing

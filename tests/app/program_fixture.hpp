// A folder with two recordings of a damper in `data/`, and the program to run there.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace hysteron::testing {

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string csv(double frequency, double current, int samples = 80, double factor = 1.0) {
  std::string text = "time [s],displacement [m],velocity [m/s],force [N],current [A]\n";
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (int n = 0; n < samples; ++n) {
    const double t = 2.0 / frequency * n / (samples - 1);
    const double x = 0.02 * std::sin(omega * t);
    const double v = 0.02 * omega * std::cos(omega * t);
    const double force = factor * ((800.0 + 600.0 * current) * v + 3000.0 * x + 120.0 * std::tanh(40.0 * v));
    std::stringstream row;
    row.precision(12);
    row << t << ',' << x << ',' << v << ',' << force << ',' << current << '\n';
    text += row.str();
  }
  return text;
}

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "hysteron-cli-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    write(folder_ / "data/r1.csv", csv(1.0, 0.2));
    write(folder_ / "data/r2.csv", csv(2.0, 0.8));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Outcome run(const std::vector<std::string>& words, const std::function<void()>& before = {}) const {
    return testing::run(words, folder_, before);
  }

  // A fitted model in `fitted/`.
  void fit() const {
    const Outcome outcome = run({"fit", "data", "--model", "bouc-wen", "--by-current", "c0:1", "--budget", "400",
                                 "--quiet", "--out", "fitted"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  std::filesystem::path folder_;
};

}  // namespace hysteron::testing

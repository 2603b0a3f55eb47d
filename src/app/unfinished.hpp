// A diagnosis that is not done: what decides its result, what is known of it so far, and what an interruption leaves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/recording.hpp"
#include "diagnose/diagnose.hpp"

namespace hysteron::app {

// All that decides the result: the program and its plugins, the recordings as they were read, the options.
std::string identity_of(const Campaign& campaign, const DiagnoseOptions& options);

// What stands so far.
class Unfinished {
 public:
  void stage(double share, const std::string& name);
  void stands(const Fit& fit);
  // "while ...: bouc-wen with clearance, NRMSE 0.012 (bouc-wen alone 0.034)"
  [[nodiscard]] std::string sentence() const;
  // DIR/interrupted.json
  void write(const std::filesystem::path& path, std::size_t pieces) const;

 private:
  struct Model {
    Hypothesis what;
    double nrmse = 0.0;
  };
  double share_ = 0.0;
  std::string stage_ = "reading the recordings";
  std::optional<Model> base_;
  std::optional<Model> best_;
};

}  // namespace hysteron::app

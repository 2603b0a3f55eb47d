// Runs on BBOB functions in the format that COCO's post-processing reads (data_format 'bbob-new2'):
//   FOLDER/bbobexp_fK.info                 blocks of three lines, one a dimension: keys, comment, data file and runs
//   FOLDER/data_fK/bbobexp_fK_DIMn.dat     a row where the best value first falls below 10^(k/100)
//   FOLDER/data_fK/bbobexp_fK_DIMn.tdat    a row at 10^(k/20) and at 1, 2, 5 times powers of ten times n evaluations
// Rows: f-evaluations, constraint evaluations (0), best value less the optimum, value, best value, coordinates. A run
// begins with a line of column names after %, and its last evaluation is a row of both files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/bbob_functions.hpp"

namespace hysteron::bbob {

class Log {
 public:
  explicit Log(std::string algorithm) : algorithm_(std::move(algorithm)) {}

  void begin(const Function& function);
  void evaluated(const std::vector<double>& x, double value);
  void end();

  [[nodiscard]] std::size_t evaluations() const { return evaluations_; }
  [[nodiscard]] double best() const { return best_; }  // less the optimum
  // File names inside the folder and what is in them.
  [[nodiscard]] std::map<std::string, std::string> files() const;

 private:
  struct Block {
    std::string dat;
    std::string tdat;
    std::string runs;  // ", INSTANCE:EVALUATIONS|BEST" each
  };
  [[nodiscard]] std::string row(const std::vector<double>& x, double value) const;

  std::string algorithm_;
  std::map<int, std::map<std::size_t, Block>> blocks_;  // by function, dimension
  const Function* function_ = nullptr;
  std::size_t evaluations_ = 0;
  double best_ = 0.0;
  double target_ = 0.0;   // the next of the .dat
  std::string last_;      // the row of the last evaluation
  std::string last_dat_;  // written last
  std::string last_tdat_;
};

}  // namespace hysteron::bbob

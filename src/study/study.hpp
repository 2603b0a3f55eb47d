// What a study compares: models x data x solvers x budgets x seeds, as plain values.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/layout.hpp"
#include "fit/objective.hpp"

namespace hysteron {

// `line` is where the study file says it, for messages; 0 when a program made it.
struct ModelSpec {
  std::string label;
  std::string model;
  std::vector<std::string> effects;
  LayoutOptions layout;
  int line = 0;
  std::vector<std::string> on = {};  // labels of the data it is for; empty: all
};

struct DataSpec {
  std::string label;
  std::string dataset;             // id of a shipped dataset, or
  std::vector<std::string> paths;  // recordings and folders, or
  std::vector<Recording> made;     // recordings made by the program
  std::uint64_t seed = 1;          // of a shipped dataset's noise
  std::vector<std::string> only;   // recordings whose name contains one of these; empty: all
  bool each = false;               // every recording is a problem of its own
  int line = 0;
  // Recordings whose name contains one of these are scored, not fitted; empty: those the campaign says. Not with
  // `each`.
  std::vector<std::string> validate = {};
  int paths_line = 0;  // of `paths` in the study's file; 0: they are of a command line
};

struct SolverSpec {
  std::string label;
  std::string id;
  std::map<std::string, double> settings;
  int line = 0;
  bool project = false;  // without the affine coordinates (fit/projection.hpp)
  bool shipped = false;  // keeps the program's defaults, whatever a command sets
};

enum class StartPoint {
  random,  // drawn from the seed, the same for every solver
  card,    // the model's default values
};

struct Study {
  std::string file;  // as named by the user, for messages
  std::string title;
  std::vector<ModelSpec> models;
  std::vector<DataSpec> data;
  std::vector<SolverSpec> solvers;
  std::vector<std::size_t> budgets;
  std::vector<std::uint64_t> seeds;
  std::vector<double> targets{1.01, 1.1, 1.5};  // times the best cost known for the problem
  std::vector<double> target_nrmse;             // absolute
  double tie = 1e-3;                            // costs within this share count as equal
  double equivalence = 0.05;                    // mean costs within this share are equal for practical purposes
  StartPoint start = StartPoint::random;
  ObjectiveOptions objective;
};

}  // namespace hysteron

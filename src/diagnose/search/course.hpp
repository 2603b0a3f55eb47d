// A search as it goes.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/stage.hpp"

namespace hysteron {

// share of all the work done, what is being done
using SearchProgress = std::function<void(double share, const std::string& stage)>;

// A gain of less than this part of the strongest one is too small to be told from what the form of that one misses: no
// further effects are looked for.
constexpr double negligible = 0.05;

struct Course {
  const Workbench& bench;
  const Hypothesis& base;
  const Fit& quick_base;
  Fit current;
  const std::function<void(const Fit& fit)>& stands;  // told of every `current`
  std::vector<double> noise;                          // of each recording
  std::vector<Extension> told = {};                   // by the channels: they join first and stay
  double independent = 0.0;                           // samples worth of independent information
  double strongest = 0.0;                             // the largest gain of a stage whose form may be missed in part
  std::vector<std::vector<Tried>> stages = {};        // in the order tried
  std::vector<Fit> seen = {};                         // all fits so far
  int swaps = 0;                                      // of an effect for its rival

  [[nodiscard]] bool is_told(const Extension& part) const { return std::ranges::find(told, part) != told.end(); }
};

// Whether many times the squares of the noise stay, so that the model is asked for more, down to small gains.
bool is_far(const Misfit& left);

}  // namespace hysteron

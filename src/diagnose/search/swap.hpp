// What the effects are worth behind other damper laws: a shape that only makes up for what one law lacks is worth less
// behind another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// A law that leaves so many times the squares of another says nothing of what is missing behind it.
constexpr double comparable = 2.0;

// Another law with the effects of the augmented model.
struct Swap {
  std::string model;
  double squares_alone = 0.0;   // of NRMSE, without effects
  double squares = 0.0;         // with all of them
  std::vector<double> without;  // squares with all of them but the k-th, refitted
};

// Behind the best of `laws`, fits of other laws without effects, of those that leave at most twice the squares of
// `base`. `effects`, strongest first, are added in this order. `done` is told the share of it that is done, from one
// thread at a time.
std::vector<Swap> swaps(const Workbench& bench, const Fit& base, const std::vector<Fit>& laws,
                        const std::vector<std::string>& effects, const std::function<void(double share)>& done = {});

}  // namespace hysteron

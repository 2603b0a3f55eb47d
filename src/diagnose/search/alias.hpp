// Which effects look alike on these recordings: what each adds to the force, less what the parameters of the base model
// imitate of it, against what the others add.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

struct AliasMap {
  std::vector<std::string> effects;
  // |cosine| of what the effects add, symmetric, 1 on the diagonal: near 1 these recordings hardly tell the two apart.
  std::vector<std::vector<double>> cosine;
};

// Of those of `effects` that change the force of `fit` by a hundredth of its peak (root mean square over the fitted
// recordings) at some size, and are not imitated by the parameters of `fit`. Each has the smallest such size of a few;
// its other parameters stand at their initial values.
AliasMap alias_map(const Workbench& bench, const Fit& fit, const std::vector<std::string>& effects);

// Pairs whose cosine is at least this are told to the user.
constexpr double alike_from = 0.95;

struct AlikePair {
  std::string effect;
  std::string other;
  double cosine = 0.0;
};

// The pairs that look alike, most alike first.
std::vector<AlikePair> alike_pairs(const AliasMap& map);

}  // namespace hysteron

// What the evidence allows to say, and never more.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search.hpp"

namespace hysteron {

// One effect the verdict lists.
struct Named {
  std::string id;
  double confidence = 0.0;
  std::vector<std::string> indistinguishable_from;
  std::vector<std::string> laws_as_good;  // parameters whose richer law would do as well
  const Fit* fit = nullptr;               // hypothesis that holds it
  const Fit* without = nullptr;
  double share_of_misfit = 0.0;
};

struct Verdict {
  std::string word;  // complete, missing-physics, ambiguous, unattributed
  std::vector<Named> effects;
  bool remaining_structure = false;
  std::string reason;  // why nothing, or not more, was named; may be empty
};

// Pointers refer into `search`.
Verdict verdict_of(const Search& search);

// The recording that would separate an effect from its relatives.
std::string next_experiment(const std::vector<std::string>& candidates);

}  // namespace hysteron

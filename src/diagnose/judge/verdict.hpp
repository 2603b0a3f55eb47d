// What the evidence allows to say, and never more.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/judge/findings.hpp"

namespace hysteron {

// One effect the verdict lists.
struct Named {
  std::string id;
  double confidence = 0.0;
  std::vector<std::string> indistinguishable_from;
  std::vector<std::string> laws_as_good;  // parameters whose richer law would do as well
  double share_of_misfit = 0.0;
  std::size_t found = 0;             // which of the findings it is ...
  std::optional<std::size_t> rival;  // ... or which of that one's contenders
};

struct Verdict {
  std::string word;  // complete, missing-physics, ambiguous, unattributed
  std::vector<Named> effects;
  bool remaining_structure = false;
  std::string reason;      // why nothing, or not more, was named; may be empty
  std::string better_law;  // the damper law that does as well without effects, if that is why
};

// Whether the effect is needed there too.
bool survived(const Trial& trial);

Verdict verdict_of(const Findings& findings);

// The hypothesis that holds what was named, and the same less it. References into `search`, of which the findings are.
const Fit& fit_of(const Search& search, const Named& named);
const Fit& without_of(const Search& search, const Named& named);

}  // namespace hysteron

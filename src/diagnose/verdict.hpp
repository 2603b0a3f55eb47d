// What the evidence allows to say, and never more.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/observe.hpp"
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
  std::string reason;      // why nothing, or not more, was named; may be empty
  std::string better_law;  // the damper law that does as well without effects, if that is why
};

struct ParameterInterval {
  std::string name;
  std::string unit;
  double value = 0.0;
  std::optional<double> half_width;  // of the 95 % interval; absent on a bound and where the data do not tell it
  std::string bound = {};            // "lower" or "upper" where the value sits on its box
  double lower = -1e300;             // of its box
};

// What is known beside the errors of the fits.
struct Circumstances {
  // Of an effect's parameters in a fit, in the order of its card.
  std::function<std::vector<ParameterInterval>(const Fit& fit, const std::string& effect)> intervals;
  // What displacement and velocity tell of a lag between them, without a model.
  std::optional<ChannelLag> channel;
};

// Whether the effect is needed there too.
bool survived(const Trial& trial);

// Pointers refer into `search`.
Verdict verdict_of(const Search& search, const Circumstances& known);

}  // namespace hysteron

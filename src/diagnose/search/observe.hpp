// What these recordings could have shown, before anything is named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/search.hpp"
#include "simulate/knowledge.hpp"

namespace hysteron {

// An effect these recordings cannot show, or only above a size.
struct Unobservable {
  std::string id;
  std::string reason;           // why not at all; empty when there is a limit
  std::string detection_limit;  // "... of the peak force"; empty when not at all
};

// Why the recordings do not hold what an effect may need; empty where they do.
std::optional<std::string> unmet(Need need, const std::vector<Recording>& recordings);
// The first need of the effect's card that is not met, for reasons that lie in the inputs alone.
std::optional<std::string> excluded_by_inputs(const std::string& effect, const std::vector<Recording>& recordings);

// Detection limits of the effects that `fit` does not hold: the force in % of the peak force (root mean square over the
// fitted recordings) at which the criterion would have asked for the effect, in the form that it has at the smallest of
// several sizes which would have been seen, less what the parameters of the fit imitate. Empty where the fit itself
// cannot be simulated.
std::vector<Unobservable> detection_limits(const Workbench& bench, const Fit& fit, const Misfit& misfit,
                                           const std::vector<std::string>& effects);

// Of these effects those that the law of the fit has as a part of its own (relatives.hpp) and imitates all but a
// thousandth of on the fitted recordings, as its stiffness does a spring's: nothing of them can be missing. Empty where
// the fit cannot be simulated.
std::vector<std::string> had_by_the_law(const Workbench& bench, const Fit& fit,
                                        const std::vector<std::string>& effects);

}  // namespace hysteron

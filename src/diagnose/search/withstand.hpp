// Whether an effect is needed under other assumptions too: behind another damper law, and with a skew between the
// channels left free.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

struct Trial {
  std::string under;      // the assumption, as in "behind lugre"
  double share = 0.0;     // of the effect's gain that it keeps there
  double evidence = 0.0;  // for the effect there
};

// Behind another damper law than the one asked for.
bool is_of_another_law(const Trial& trial);

// `augmented` holds the effect, `without` is the same less it, both refitted on `bench`; `other_laws` are of other
// damper laws without effects. A law that leaves more than twice what `base` leaves says nothing. `effective` as in
// evidence().
std::vector<Trial> trials_of(const Workbench& bench, const std::string& effect, const Fit& augmented,
                             const Fit& without, const Fit& base, const std::vector<Fit>& other_laws, double effective);

}  // namespace hysteron

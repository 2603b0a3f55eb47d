// What a search found, with what was set in its place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/residual/contrast.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

// A hypothesis with another extension in the place of one that was found.
struct Rival {
  Extension part;
  double share = 0.0;      // of the gain of what was found
  double evidence = 0.0;   // for what was found against the rival
  std::optional<Fit> fit;  // where it was refitted; else the share is to first order
};

struct Found {
  Extension part;
  Fit without;         // the final hypothesis less this part, refitted
  double gain = 0.0;   // squares without - squares with
  double alone = 0.0;  // squares that it takes off alone behind the base, from the best start seen; 0 for laws
  double evidence = 0.0;
  std::vector<Rival> rivals;               // best first
  bool told = false;                       // by the channels, without a model (SearchOptions::told)
  std::optional<std::string> by_law = {};  // the parameter whose richer law in the drive shows the effect
  std::optional<std::string> of_law = {};  // the augmented model's law, which has it as a part of its own
  std::vector<Contrast> contrasts = {};    // of what `without` leaves of the fitted recordings; taken after the search
};

// Their effects, in this order.
inline std::vector<std::string> effects_of(const std::vector<Found>& found) {
  std::vector<std::string> result;
  result.reserve(found.size());
  for (const Found& one : found) {
    result.push_back(one.part.effect);
  }
  return result;
}

}  // namespace hysteron

// Which physics was left out: effects tried one by one behind the base model, refitted jointly, added while the data
// ask for it, dropped when they stop helping, and set against every rival that explains as much.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/stage.hpp"
#include "diagnose/search/withstand.hpp"

namespace hysteron {

struct Rival {
  std::string id;
  double share = 0.0;     // of the gain of the effect, explained by the rival in its place
  double evidence = 0.0;  // for the effect against the rival
  Fit fit;
};

struct Found {
  std::string id;
  Fit without;        // the final hypothesis less this effect, refitted
  double gain = 0.0;  // squares without - squares with
  double evidence = 0.0;
  double share_of_misfit = 0.0;           // of the base's structure
  std::vector<Rival> rivals;              // all that were refitted in its place, best first
  std::optional<Locality> locality = {};  // of an effect that acts in a part of the stroke
  std::string by_law = {};  // the parameter whose richer law in the drive shows the effect, where one does
};

struct Search {
  Fit base;
  Misfit base_misfit;
  Fit augmented;  // the base itself when nothing was found
  Misfit misfit;
  Recurrence recurrence;            // of what the augmented model leaves
  std::vector<Found> found;         // effects of the augmented model, strongest first
  std::vector<std::string> richer;  // parameter laws that were made richer
  // As the comparison saw them, on the quick workbench.
  Fit quick_base;
  Fit quick_augmented;
  double effective = 0.0;  // samples worth of independent information there
  // Evidence of the best further hypothesis behind the augmented model; none where that was not looked at.
  std::optional<double> further;
  std::vector<Tried> first_stage;      // every single hypothesis against the base, best first
  std::vector<std::string> promising;  // the best effects of the last stage
  std::vector<Fit> other_laws;         // other base laws without effects
  std::string tried;                   // the strongest effect, which was put to these trials
  std::vector<Trial> trials;
};

// share of all the work done, what is being done
using SearchProgress = std::function<void(double share, const std::string& stage)>;

struct SearchOptions {
  std::vector<std::string> candidates;  // effects to consider
  int most_effects = 3;
  std::size_t base_budget = 20000;
};

// Hypotheses are compared on `quick` (thinned recordings, coarse integration); the base and the augmented model are
// then fitted on `fine`, of the same box, and their costs and misfits are those there.
Search search(const Workbench& quick, const Workbench& fine, const Hypothesis& base, const SearchOptions& options,
              const SearchProgress& progress);

// The effect that a yield force is which rises ever less with the drive, whichever parameter law shows it.
constexpr const char* saturation = "magnetic-saturation";

}  // namespace hysteron

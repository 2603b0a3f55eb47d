// Which physics was left out: effects tried behind the base model, refitted jointly, added while the data ask for it,
// dropped when they stop helping, set against every rival that explains as much, and tried behind other laws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/course.hpp"
#include "diagnose/search/found.hpp"
#include "diagnose/search/saturation.hpp"
#include "diagnose/search/stage.hpp"
#include "diagnose/search/swap.hpp"

namespace hysteron {

struct Search {
  Fit base;
  Fit augmented;  // the base itself when nothing was found
  Misfit base_misfit;
  Misfit misfit;
  std::vector<Found> found;             // effects of the augmented model, strongest first
  std::vector<std::string> had_by_law;  // effects that the law has of its own and imitates wholly (observe.hpp)
  std::vector<std::string> richer;      // parameter laws that were made richer
  // "a richer dependence of c0 and f0 on the drive"; empty where none was.
  [[nodiscard]] std::string richer_dependence() const;
  // As the comparison saw them, on the quick workbench.
  Fit quick_base;
  Fit quick_augmented;
  bool limited = false;            // few effects were looked for, as another law takes most of the misfit off
  double independent = 0.0;        // samples there
  std::vector<Tried> first_stage;  // every extension of the base, best first
  std::vector<Fit> other_laws;     // other base laws without effects
  std::vector<Swap> swaps;         // behind these; `without` in the order of `found`
};

struct SearchOptions {
  std::vector<std::string> candidates;  // effects to consider
  std::vector<std::string> told;        // of these, what the channels show by themselves: it stays in the model
  std::vector<std::string> laws;        // damper laws that may take the place of the base's
  int most_effects = 5;
  std::size_t base_budget = 20000;
  bool in_full = false;  // all effects are looked for, whatever another law does
  // Told of the base fit and then of every fit that takes the place of what stood before.
  std::function<void(const Fit& fit)> stands = [](const Fit&) {};
};

// The progress of a part of the work that goes from one share of the whole to another; `before` opens its stages.
// `progress` outlives it.
SearchProgress within(const SearchProgress& progress, double from, double to, const std::string& before = {});

// Hypotheses are compared on `quick` (thinned recordings, coarse integration); the base and the augmented model are
// then fitted on `fine`, of the same box, and their costs and misfits are those there.
Search search(const Workbench& quick, const Workbench& fine, const Hypothesis& base, const SearchOptions& options,
              const SearchProgress& progress);

// What the effects found are worth behind other laws: Search::swaps. For a search that is judged, when all it has is
// found.
void try_behind_other_laws(Search& search, const Workbench& quick, const std::function<void(double share)>& done = {});

}  // namespace hysteron

// Missing effects named as regression is usually done: by F tests of each, and by forward selection.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron::baselines {

// What an effect gains behind a fit, all parameters refitted. Squares are of NRMSE.
struct Step {
  std::string effect;
  double before = 0.0;  // squares
  double after = 0.0;
  double more = 0.0;       // parameters
  double remaining = 0.0;  // parameters of the fit without it
};

// Probability of so large an F statistic where the effect does nothing, with `values` independent values.
double p_of(const Step& step, double values);
// Those that F tests hold for there at `level`, the largest gain of the Bayesian information criterion first. Holm's
// step-down correction for their number.
// Source: Holm, Scandinavian Journal of Statistics 6 (1979) 65.
std::vector<std::string> significant(std::vector<Step> steps, double values, double level);

// Every effect behind a fit, refitted from the starts that score best (score.hpp); in the order given.
std::vector<Fit> refits(const Workbench& bench, const Fit& before, const std::vector<std::string>& effects);
Step step_of(const Fit& before, const Fit& after);

// Effects that forward selection by the Bayesian information criterion adds, in its order: at each step the best of
// those refitted by stage() joins until none is worth its parameters, or `most` are in. `first`: refits of all effects
// behind the base.
std::vector<std::string> forward(const Workbench& bench, const Fit& base, const std::vector<Fit>& first,
                                 const std::vector<std::string>& effects, double values, std::size_t most);

}  // namespace hysteron::baselines

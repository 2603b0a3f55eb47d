// What a search found, in numbers: all that a verdict rests on. diagnosis.json holds them as its evidence.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/search/observe.hpp"
#include "diagnose/search/search.hpp"

namespace hysteron {

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

// NRMSE over the fitted and over the judging recordings.
struct Errors {
  double fit = 0.0;
  double heldout = 0.0;
};

// What was set in the place of an effect.
struct Contender {
  std::string id;
  double share = 0.0;     // of the effect's gain
  double evidence = 0.0;  // for the effect against it
  double heldout = 0.0;   // NRMSE
  // Of a pair in which one is a limit of the other: the parameter by which the wider form differs is surely not at
  // that limit. True of any other pair.
  bool apart = true;
  bool ended_as = false;       // the effect ends as this one, at a bound of its box
  bool as_channels = false;    // a lag of the velocity channel, and the one that the channels show
  bool follows_drive = false;  // a richer law of a parameter that follows the drive anyhow
};

struct Finding {
  std::string id;
  double gain = 0.0;      // squares without - squares with
  double evidence = 0.0;  // as of the search
  Errors without;         // of the final hypothesis less this effect, refitted
  double share_of_misfit = 0.0;
  bool as_channels = false;           // as of a contender
  std::optional<Locality> locality;   // of an effect that acts in a part of the stroke
  std::vector<Contender> contenders;  // best first
};

// Another damper law without effects.
struct OtherLaw {
  std::string model;
  double squares = 0.0;  // of NRMSE, as the comparison saw it
  // What was found, traces aside, are parameters of its own, which the law asked for lacks.
  bool has_found = false;
};

struct Findings {
  std::string model;
  Errors base;
  Errors augmented;
  Misfit base_misfit;
  Misfit misfit;
  Recurrence recurrence;    // of what the augmented model leaves; looked at only where something was found
  double quick_base = 0.0;  // squares, as the comparison saw them
  double quick_augmented = 0.0;
  bool richer = false;            // the augmented model has a richer law
  std::vector<Finding> found;     // strongest first
  std::optional<double> further;  // evidence of the best further hypothesis, where that was looked at
  std::vector<OtherLaw> other_laws;
  std::string tried;  // the strongest effect, which was put to these trials
  std::vector<Trial> trials;
  std::string doubt_of_completeness;  // why more than noise is left where no effect helps; empty when nothing shows it
  std::string doubt_of_data;          // why no name can be given on these recordings; empty when there is no reason
};

// The doubts are left empty.
Findings findings_of(const Search& search, const Circumstances& known);

}  // namespace hysteron

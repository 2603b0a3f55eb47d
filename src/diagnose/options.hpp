// What a diagnosis is asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"

namespace hysteron {

// Damper laws whose cards say that `diagnose` tries them in place of the one asked for, of plugins too.
std::vector<std::string> alternative_laws();

struct DiagnoseOptions {
  std::string model;
  LayoutOptions layout;  // laws of the base model; none given and a drive that varies: see base_laws
  ObjectiveOptions objective;
  std::uint64_t seed = 1;
  int most_effects = 5;
  std::vector<std::string> candidates;                 // empty: every effect of the catalogue
  std::vector<std::string> laws = alternative_laws();  // that the base law is set against
  // Asked often while fitting; once true the fits end soon and the progress is told, which may throw.
  std::function<bool()> stopped = [] { return false; };
  // Where finished pieces of the work are kept, and taken from; outlives the diagnosis.
  Checkpoint* checkpoint = nullptr;
  // Told of the base model and then of every model that takes the place of what stood before, on the recordings
  // compared. Of what is known so far, for one who may not wait.
  std::function<void(const Fit& fit)> stands = [](const Fit&) {};
};

// Orders of the laws of a base model when none are given: every yield force and damping that has a drive to depend on
// becomes linear in it.
std::map<std::string, int> base_laws(const std::string& model, const std::vector<Recording>& recordings);

}  // namespace hysteron

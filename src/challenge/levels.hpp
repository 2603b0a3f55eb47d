// What kinds of concealed campaigns there are, and which campaign of a run is of which kind.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "challenge/physics.hpp"

namespace hysteron::challenge {

enum class Level {
  plain,       // one effect of the catalogue, detectable to large
  buried,      // one effect, below the noise sample by sample
  absorbed,    // one effect that the base model swallows in any single recording
  pairs,       // two effects
  wrong_base,  // the campaign file names another law than the true one; with and without an effect
  foreign,     // a cause that is in no catalogue
  beside,      // one to three effects beside one to three foreign causes; every other one is told another law
  none,        // nothing is missing: coloured noise, coarse quantisation, outliers, sensor noise, scatter of the rig
  unexcited    // an effect is there, and these recordings do not excite it
};
inline constexpr int level_count = 9;

[[nodiscard]] std::string_view name_of(Level level);
// InputError when it is no level.
[[nodiscard]] Level level_of(std::string_view name);

// A campaign to be made: its level and what is hidden in it.
struct Task {
  int number = 1;  // from 1
  Level level = Level::plain;
  std::vector<std::string> effects;     // ids, foreign causes last; empty: nothing is missing
  std::vector<std::string> forms = {};  // of the effects, one each; empty: drawn when the campaign is made
  bool stops = false;                   // each test ends at rest
  int most_recordings = 0;              // that the campaign keeps, one to so many; 0: all
};

// Which forms and foreign causes may be drawn; an empty list of `only` or `foreign` leaves all.
struct FormChoice {
  std::vector<std::string> only = {};     // "effect/form"
  std::vector<std::string> without = {};  // "effect/form" or foreign causes
  std::vector<std::string> foreign = {};  // foreign causes
  [[nodiscard]] bool allows(const std::string& form) const;
};

// The first `count` tasks over the given levels (all when empty) and effects (all when empty). Each level goes through
// the effects that it can take in turn, and each effect through its forms, so that every one occurs.
[[nodiscard]] std::vector<Task> plan(int count, const std::vector<Level>& levels,
                                     const std::vector<std::string>& effects, std::uint64_t seed,
                                     const FormChoice& choice = {});

// The laws that all of these effects can be added to.
[[nodiscard]] std::vector<Law> common_laws(const std::vector<std::string>& effects);

}  // namespace hysteron::challenge

// What keeps a diagnosis from saying that nothing is missing, or from naming anything.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/residual/tone.hpp"
#include "diagnose/search/search.hpp"

namespace hysteron {

// Files of the held-out recordings that show what the fitted ones do not.
std::vector<std::string> surprises(const Workbench& bench, const Fit& fit);
// What is said of them, without a full stop, where the fitted recordings have structure left and where they have none.
std::string sentence_of_surprises(const std::vector<std::string>& files, bool fitted_have_structure);

// In N. Of every sample: a thinned recording has no high frequencies.
std::optional<Tone> tone_left(const Search& search, const Workbench& bench);
// "a tone of 50 Hz and 3.20 N runs through 6 of 6 recordings ...", of a tone in N, without a full stop.
std::string sentence_of(const Tone& tone);

// Why more than noise is left though no effect helps: a held-out recording, or the residual's bond to the force, shows
// it. Empty where nothing does.
struct Doubt {
  std::string why;
  bool of_tone = false;
  bool too_few = false;  // values to tell at all whether anything is missing
};
Doubt doubt_of_completeness(const Search& search, const Workbench& fine, const std::vector<std::string>& surprising,
                            const std::optional<Tone>& tone);

// Why no name can be given: the recorded velocity is not that of the displacement, and effects would explain a fault of
// the data. Empty where it is.
std::string doubt_of_velocity(const std::vector<Recording>& recordings);

// Likewise where a channel is cut off at an end of its range, or a load cell was not connected. Of all recordings: one
// beside the others shows it.
std::string doubt_of_channels(const std::vector<Recording>& recordings);

}  // namespace hysteron

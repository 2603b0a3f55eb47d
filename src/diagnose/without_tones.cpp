#include "diagnose/without_tones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "core/joined.hpp"
#include "diagnose/residual/leftover.hpp"

namespace hysteron {
WithoutTones without_tones(const Campaign& campaign, const Fit& fit, const Workbench& bench) {
  WithoutTones result{campaign, {}};
  std::vector<Recording>& recordings = result.campaign.recordings;
  std::vector<Residual> residuals;
  for (const Recording& recording : campaign.recordings) {
    residuals.push_back(bench.residual(fit, recording));
  }
  std::vector<Leftover> leftovers = leftovers_of(recordings, residuals, std::vector<double>(recordings.size(), 1.0));
  // Each takes at least a tenth of what is left, so that they come to an end.
  while (leftovers.size() == recordings.size()) {
    const std::optional<Tone> tone = tone_of(leftovers);
    bool taken = false;
    for (std::size_t k = 0; tone && k < recordings.size(); ++k) {
      const std::optional<Sine> sine = sine_of(leftovers[k], tone->frequency);
      if (!sine) {
        continue;
      }
      taken = true;
      for (std::size_t n = 0; n < leftovers[k].time.size(); ++n) {
        leftovers[k].residual[n] -= sine->at(leftovers[k].time[n]);
      }
      // What is left is the predicted force less the recorded one.
      for (std::size_t n = 0; n < recordings[k].size(); ++n) {
        recordings[k].force[n] += sine->at(recordings[k].time[n]);
      }
    }
    if (!taken) {
      break;
    }
    result.tones.push_back(*tone);
  }
  return result;
}

std::string sentence_of(const std::vector<Tone>& tones) {
  std::vector<std::string> parts;
  for (const Tone& tone : tones) {
    parts.push_back(fmt::format("{:.3g} Hz ({:.2g} N)", tone.frequency, tone.amplitude));
  }
  const bool one = parts.size() == 1;
  return fmt::format(
      "{} of {}, as of a machine, the mains or a sensor, {} taken out of the force before effects were looked for "
      "(table "
      "and plots of the recordings still hold {})",
      one ? "a tone" : "tones", joined(parts, " and "), one ? "was" : "were", one ? "it" : "them");
}

}  // namespace hysteron

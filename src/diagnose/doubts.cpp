#include "diagnose/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnose/residual/leftover.hpp"
#include "diagnose/residual/wander.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/wording.hpp"
#include "diagnose/signal/noise.hpp"
#include "io/clipped_ends.hpp"
#include "io/dead_force.hpp"
#include "io/velocity.hpp"

namespace hysteron {
namespace {

// A held-out recording that is this many times further above its white noise, in squares, than every fitted one shows
// what these do not.
constexpr double surprise = 4.0;
// Least share of the largest force that counts as noise there.
constexpr double least_noise = 1e-4;
// Squares over those of the white noise above which what is left is asked whether it follows the force.
constexpr double above_white = 1.5;
// Squares over those of the noise above which what is left is asked whether its size follows the motion.
constexpr double above_floor = 1.5;
// Independent values for each parameter without which nothing left cannot be told from too little data.
constexpr double values_per_parameter = 4.0;
// A recorded velocity correlates with the slope of the displacement at least so.
constexpr double least_likeness = 0.5;

}  // namespace

std::vector<std::string> surprises(const Workbench& bench, const Fit& fit) {
  const auto above_noise = [&](const Recording& recording) {
    const double least = least_noise * normaliser(recording, Normalisation::max_abs);
    const double white = noise_floor(recording).white;
    return bench.residual(fit, recording).mean_square() / (white * white + least * least);
  };
  double usual = 1.0;
  for (const Recording& recording : bench.split().fit) {
    usual = std::max(usual, above_noise(recording));
  }
  std::vector<std::string> result;
  for (const Judged& judged : bench.split().judge) {
    if (judged.from == 0 && above_noise(judged.recording) > surprise * usual) {
      result.push_back(judged.recording.file);
    }
  }
  return result;
}

std::string sentence_of_surprises(const std::vector<std::string>& files, bool fitted_have_structure) {
  const std::string where = joined(files, " and ");
  return fitted_have_structure
             ? fmt::format(
                   "over its noise more than {:.0f} times as much is left of {} as of any fitted recording: what "
                   "is missing shows most there, and only a fitted recording can tell its cause",
                   std::sqrt(surprise), where)
             : "nothing but noise is left on the fitted recordings, but not on " + where +
                   ": what is missing shows there only, and only a fitted recording can tell its cause";
}

std::optional<Tone> tone_left(const Search& search, const Workbench& bench) {
  const std::vector<Recording>& recordings = bench.split().fit;
  return tone_of(
      leftovers_of(recordings, bench.plain_residuals(search.augmented), std::vector<double>(recordings.size(), 1.0)));
}

std::string sentence_of(const Tone& tone) {
  return fmt::format(
      "a tone of {:.3g} Hz and {:.{}f} N runs through {} of {} recordings whatever the motion, as of a machine, the "
      "mains or a sensor",
      tone.frequency, tone.amplitude, tone.amplitude < 10.0 ? 2 : 0, tone.recordings, tone.of);
}

Doubt doubt_of_completeness(const Search& search, const Workbench& fine, const std::vector<std::string>& surprising,
                            const std::optional<Tone>& tone) {
  if (!surprising.empty()) {
    return {sentence_of_surprises(surprising, structured(search.misfit))};
  }
  const Misfit& left = search.misfit;
  const auto parameters = static_cast<double>(search.augmented.dimension());
  if (left.independent < values_per_parameter * parameters) {
    return {
        fmt::format(
            "what is left holds {:.0f} independent values for {:.0f} parameters: too few to tell noise from what is "
            "missing",
            left.independent, parameters),
        false, true};
  }
  if (left.squares <= above_white * left.white) {
    return {};
  }
  if (left.squares > above_floor * left.floor && uneven(left.evenness)) {
    return {"the size of the residual follows the motion, and that of noise would not"};
  }
  if (tone) {
    return {sentence_of(*tone), true, false};
  }
  const Residuals residuals = fine.residuals(search.augmented);
  const Wandering wander = wandering(leftovers_of(fine.split().fit, residuals.of, residuals.norms));
  if (!wanders(wander)) {
    return {};
  }
  return {fmt::format(
      "{:.0f} % of what is left is a factor of the force that {}", 100.0 * wander.share,
      wander.period > 0.0
          ? fmt::format("swings with a period of {:.2g} s whatever the motion, as of a supply that cycles",
                        wander.period)
          : std::string("changes between stretches of the recordings or from one to another, as of a supply, a "
                        "grip or an amplifier that changes"))};
}

std::string doubt_of_velocity(const std::vector<Recording>& recordings) {
  for (const Recording& recording : recordings) {
    if (!recording.velocity_measured) {
      continue;
    }
    const std::vector<double> slope = derive_velocity(recording.time, recording.displacement);
    double product = 0.0;
    double squares = 0.0;
    double recorded = 0.0;
    for (std::size_t n = 0; n < slope.size(); ++n) {
      product += slope[n] * recording.velocity[n];
      squares += slope[n] * slope[n];
      recorded += recording.velocity[n] * recording.velocity[n];
    }
    const double alike = product / std::max(std::sqrt(squares * recorded), 1e-300);
    if (alike < least_likeness) {
      return fmt::format(
          "{}: the recorded velocity is not the slope of the displacement (correlation {:.2f}); without that column "
          "the velocity would be derived",
          recording.file, alike);
    }
  }
  return {};
}

std::string doubt_of_channels(const std::vector<Recording>& recordings) {
  if (const auto clippings = clipping_of(recordings); !clippings.empty()) {
    return sentence_of(clippings.front(), recordings.size());
  }
  if (const auto dead = dead_forces_of(recordings); !dead.empty()) {
    return recordings[dead.front().recording].file + ": " + sentence_of(dead.front());
  }
  return {};
}

}  // namespace hysteron

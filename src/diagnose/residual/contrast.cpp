#include "diagnose/residual/contrast.hpp"

#include <algorithm>

#include "diagnose/residual/contrast_parts.hpp"

namespace hysteron {
std::vector<Contrast> contrasts(std::span<const Recording> recordings, std::span<const Residual> residuals,
                                std::span<const std::size_t> motions, Placebos placebos) {
  const std::size_t draws = placebos == Placebos::all ? contrast::all_placebos : 0;
  const std::vector<contrast::Track> tracks = contrast::tracks_of(recordings, residuals, motions);
  std::vector<Contrast> result;
  if (tracks.empty()) {
    return result;
  }
  contrast::add_rest_contrasts(tracks, draws, result);
  contrast::add_reversal_contrasts(tracks, draws, result);
  contrast::add_motion_contrasts(tracks, draws, result);
  contrast::add_slow_contrasts(tracks, draws, result);
  contrast::add_carried_contrast(tracks, draws, result);
  contrast::add_drive_contrasts(tracks, draws, result);
  contrast::add_channel_contrasts(tracks, draws, result);
  std::ranges::stable_sort(result, {}, &Contrast::kind);
  return result;
}

std::vector<Contrast> channel_contrasts(std::span<const Recording> recordings) {
  std::vector<Residual> nothing;
  for (const Recording& recording : recordings) {
    nothing.push_back({std::vector<double>(recording.size(), 0.0), 0});
  }
  std::vector<Contrast> result;
  const std::vector<contrast::Track> tracks = contrast::tracks_of(recordings, nothing);
  if (!tracks.empty()) {
    contrast::add_channel_contrasts(tracks, contrast::all_placebos, result);
  }
  return result;
}

}  // namespace hysteron

// Recordings with more samples than are kept: every k samples in a row averaged to one while they are read.
//
// All channels, time among them, are averaged over the same samples with the same weights. What the averages are of is
// centred on their time, so that no channel lags another; noise falls by the root of k and nothing folds down from
// above the new sampling rate, as it would if samples were dropped. A motion much slower than a block passes unchanged:
// of a sine of period P and blocks of length B the amplitude shrinks by (pi B / P)^2 / 6, alike in motion and force,
// 0.1 % at 40 blocks a period. A step, of the drive or of friction at a reversal, lies within one kept sample. What is
// left of the recording's end, fewer than k samples, is not used. Velocity and acceleration that are not recorded are
// derived from the averages.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "io/channels.hpp"

namespace hysteron {

// Few enough for any machine, and more than an identification needs.
inline constexpr std::size_t default_keep_samples = 4'000'000;

// How many samples of a recording are kept at most where `total` are kept of recordings that have `samples` each: all
// of the short ones and as many of each of the others, 2000 at least.
[[nodiscard]] std::size_t kept_of_each(const std::vector<std::size_t>& samples, std::size_t total);

class BlockMeans {
 public:
  // `present`: the channels the file has.
  BlockMeans(const Sources& sources, std::size_t k);
  // The next sample, in SI.
  void add(const Row& row);
  // How the displacement runs within a block: RMS of what a straight line leaves of it, without its noise, as a share
  // of its standard deviation. 1e-3 is a block of a fortieth of a period.
  [[nodiscard]] double bend() const;
  // The averages, after which there is nothing left to ask.
  [[nodiscard]] Channels take() { return std::move(means_); }

 private:
  void close_block();

  std::vector<std::size_t> present_;
  std::size_t k_;
  Channels means_;
  std::size_t held_ = 0;  // samples of the open block
  Row first_{};           // of it
  Row sum_{};             // over it, less the first
  double sum_tt_ = 0.0;
  double sum_tx_ = 0.0;
  double sum_xx_ = 0.0;
  double left_ = 0.0;  // sum of squares left by straight lines
  double left_of_ = 0.0;
  double noise_ = 0.0;  // sum of squares of second differences
  double noise_of_ = 0.0;
  double before_[2] = {0.0, 0.0};
  std::size_t seen_ = 0;
};

// Channels of a recording in memory, averaged where they have more samples than `options` keep of it, which is
// remarked. All have the length of the first, or are empty.
void thin(Channels& channels, const Sources& sources, const ReadOptions& options, const std::string& file);

// What happened, in one line: samples read and kept, what is between them, and whether the motion is told by them.
[[nodiscard]] Remark thinning_remark(const std::string& file, std::size_t read, std::size_t of_all, std::size_t k,
                                     const std::vector<double>& time, double bend);

}  // namespace hysteron

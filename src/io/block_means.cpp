#include "io/block_means.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr std::size_t fewest_kept = 2000;
// Share of the displacement's standard deviation.
constexpr double largest_bend = 1e-3;

constexpr auto time_at = static_cast<std::size_t>(Quantity::time);
constexpr auto displacement_at = static_cast<std::size_t>(Quantity::displacement);

// With commas between thousands.
std::string counted(std::size_t number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return digits;
}

}  // namespace

std::size_t kept_of_each(const std::vector<std::size_t>& samples, std::size_t total) {
  std::vector<std::size_t> ascending = samples;
  std::ranges::sort(ascending);
  std::size_t left = total;
  for (std::size_t k = 0; k < ascending.size(); ++k) {
    const std::size_t share = left / (ascending.size() - k);
    if (ascending[k] > share) return std::max(share, fewest_kept);
    left -= ascending[k];
  }
  return std::max(total, fewest_kept);
}

BlockMeans::BlockMeans(const Sources& sources, std::size_t k) : k_(k) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].column >= 0) present_.push_back(i);
  }
}

void BlockMeans::add(const Row& row) {
  if (held_ == 0) {
    first_ = row;
    sum_.fill(0.0);
    sum_tt_ = sum_tx_ = sum_xx_ = 0.0;
  }
  for (const std::size_t i : present_) sum_[i] += row[i] - first_[i];
  const double t = row[time_at] - first_[time_at];
  const double x = row[displacement_at] - first_[displacement_at];
  sum_tt_ += t * t;
  sum_tx_ += t * x;
  sum_xx_ += x * x;
  if (++seen_ > 2) {
    const double second = before_[0] - 2.0 * before_[1] + row[displacement_at];
    noise_ += second * second;
    noise_of_ += 6.0;
  }
  before_[0] = before_[1];
  before_[1] = row[displacement_at];
  if (++held_ == k_) close_block();
}

void BlockMeans::close_block() {
  const auto count = static_cast<double>(k_);
  for (const std::size_t i : present_) means_[i].push_back(first_[i] + sum_[i] / count);
  const double t = sum_[time_at] / count;
  const double x = sum_[displacement_at] / count;
  const double tt = sum_tt_ - count * t * t;
  const double tx = sum_tx_ - count * t * x;
  const double xx = sum_xx_ - count * x * x;
  if (tt > 0.0) {
    left_ += std::max(xx - tx * tx / tt, 0.0);
    left_of_ += std::max(count - 2.0, 0.0);
  }
  held_ = 0;
}

double BlockMeans::bend() const {
  const std::vector<double>& x = means_[displacement_at];
  if (x.empty() || left_of_ == 0.0) return 0.0;
  double sum = 0.0;
  double square = 0.0;
  for (const double value : x) {
    sum += value - x[0];
    square += (value - x[0]) * (value - x[0]);
  }
  const auto count = static_cast<double>(x.size());
  const double variance = square / count - sum * sum / (count * count);
  const double bent = left_ / left_of_ - noise_ / noise_of_;
  return variance > 0.0 ? std::sqrt(std::max(bent, 0.0) / variance) : 0.0;
}

void thin(Channels& channels, const Sources& sources, const ReadOptions& options, const std::string& file) {
  const std::size_t samples = channels[time_at].size();
  if (options.keep_samples == 0 || samples <= options.keep_samples) return;
  const std::size_t k = (samples + options.keep_samples - 1) / options.keep_samples;
  BlockMeans means(sources, k);
  Row row{};
  for (std::size_t n = 0; n < samples; ++n) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!channels[i].empty()) row[i] = channels[i][n];
    }
    means.add(row);
  }
  const double bend = means.bend();
  channels = means.take();
  if (options.remark)
    options.remark(thinning_remark(file, samples, options.samples_of_all, k, channels[time_at], bend));
}

Remark thinning_remark(const std::string& file, std::size_t read, std::size_t of_all, std::size_t k,
                       const std::vector<double>& time, double bend) {
  const std::size_t kept = time.size();
  const double step = (time.back() - time.front()) / static_cast<double>(kept - 1);
  const std::string text = fmt::format("{} samples read, every {} averaged to one: {} kept, {:.3g} ms apart",
                                       counted(read), k, counted(kept), 1e3 * step);
  if (bend <= largest_bend) {
    return {file, Remark::Kind::thinned, "thinned",
            text + "; " + Option::keep_samples + fmt::format(" {} keeps all", std::max(read, of_all))};
  }
  // What a straight line leaves grows with the square of the block. Blocks are of whole samples.
  const double block = std::floor(static_cast<double>(k) * std::sqrt(largest_bend / bend));
  const std::size_t needed =
      block < 1.0 ? read : static_cast<std::size_t>(std::ceil(static_cast<double>(read) / block));
  return {file, Remark::Kind::thinned, "thinned too far",
          text +
              fmt::format("; the motion is too fast for that, it bends by {:.2g} % of its size within them, expected "
                          "{} kept of this recording (",
                          100.0 * bend, counted(needed)) +
              Option::keep_samples + ")"};
}

}  // namespace hysteron

#include "diagnose/residual/contrast_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.hpp"

namespace hysteron::contrast {
namespace {

// A recording holds the motion if its weight is this share of the mean one.
constexpr double least_weight = 0.1;
// From so many motions or recordings on, the error over them counts.
constexpr std::size_t fewest_clusters = 3;
// A part with more of the weight than this is nearly all there is.
constexpr double most_weight = 0.9;
constexpr double margin = 0.08;           // of a recording, that a shift stays away from none at all
constexpr double margin_of_period = 0.1;  // of a period, that it stays away from a multiple of one
// Draws of a shift.
constexpr std::uint32_t tries = 16;

// Squared standard error of the weighted mean from the scores of its parts, each score enlarged by what its own part
// of the mean took off it (CR2 of Bell and McCaffrey 2002, for one coefficient).
double squared_error(std::span<const Part> parts, double value, double total) {
  double sum = 0.0;
  for (const Part& part : parts) {
    const double score = part.weight * (part.value - value) / total;
    sum += score * score / std::max(1.0 - part.weight / total, 1.0 - most_weight);
  }
  return sum;
}

// Recordings of one motion as one part.
std::vector<Part> motions_of(std::span<const Part> recordings) {
  std::map<std::size_t, Part> sums;
  for (const Part& part : recordings) {
    Part& sum = sums.emplace(part.motion, Part{part.recording, 0.0, 0.0, part.motion}).first->second;
    sum.weight += part.weight;
    sum.value += part.weight * part.value;
  }
  std::vector<Part> result;
  for (auto& [motion, part] : sums) {
    part.value /= part.weight;
    result.push_back(part);
  }
  return result;
}

const Stream& stream() {
  static const Stream result = Stream(1).child("contrast");
  return result;
}

}  // namespace

double normal_of(double t, double degrees) {
  const double size = (8.0 * degrees + 1.0) / (8.0 * degrees + 3.0) * std::sqrt(degrees * std::log1p(t * t / degrees));
  return std::copysign(size, t);
}

std::size_t placebo_shift(std::size_t placebo, std::size_t recording, std::size_t size, double period) {
  const auto counted = static_cast<double>(size);
  double shift = 0.5 * counted;
  for (std::uint32_t k = 0; k < tries; ++k) {
    shift =
        (margin + (1.0 - 2.0 * margin) * stream().uniform(placebo, static_cast<std::uint32_t>(recording), k)) * counted;
    const double cycles = period > 0.0 ? shift / period : 0.5;
    if (std::fabs(cycles - std::round(cycles)) >= margin_of_period) {
      break;
    }
  }
  return std::min(static_cast<std::size_t>(shift), size > 0 ? size - 1 : 0);
}

double placebo_sign(std::size_t placebo, std::size_t recording, std::size_t part) {
  static const Stream signs = stream().child("sign");
  return signs.uniform(placebo, static_cast<std::uint32_t>(recording), static_cast<std::uint32_t>(part)) < 0.5 ? -1.0
                                                                                                               : 1.0;
}

double effective_number(std::span<const Part> parts) {
  double sum = 0.0;
  double squares = 0.0;
  for (const Part& part : parts) {
    sum += part.weight;
    squares += part.weight * part.weight;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

std::optional<Contrast> pooled(ContrastKind kind, std::span<const Part> recordings, std::span<const Part> blocks) {
  double total = 0.0;
  double sum = 0.0;
  for (const Part& part : recordings) {
    total += part.weight;
    sum += part.weight * part.value;
  }
  if (!(total > 0.0) || !std::isfinite(total) || !std::isfinite(sum)) {
    return std::nullopt;
  }
  Contrast result;
  result.kind = kind;
  result.what = card_of(kind).what;
  result.unit = card_of(kind).unit;
  result.value = sum / total;
  std::size_t agreeing = 0;
  std::vector<Part> holding;
  for (const Part& part : recordings) {
    if (part.weight > least_weight * total / static_cast<double>(recordings.size())) {
      holding.push_back(part);
      result.of_recordings.push_back({part.recording, part.value});
      agreeing += part.value * result.value > 0.0 ? 1 : 0;
    }
  }
  result.recordings = holding.size();
  result.consistency = static_cast<double>(agreeing) / static_cast<double>(holding.size());
  if (blocks.size() < 2) {
    return std::nullopt;
  }
  double square = squared_error(blocks, result.value, total);
  // The degrees are those of one of the errors; the largest is small by chance less often than any.
  double degrees = effective_number(blocks) - 1.0;
  if (holding.size() >= fewest_clusters) {
    square = std::max(square, squared_error(holding, result.value, total));
    degrees = static_cast<double>(holding.size()) - 1.0;
  }
  const std::vector<Part> motions = motions_of(holding);
  if (motions.size() >= fewest_clusters && !card_of(kind).by_recording) {
    square = std::max(square, squared_error(motions, result.value, total));
  }
  result.std_error = std::max(std::sqrt(square), least_error * std::fabs(result.value));
  result.z =
      result.std_error > 0.0 ? normal_of(result.value / result.std_error, std::max(degrees, least_degrees)) : 0.0;
  if (!std::isfinite(result.value) || !std::isfinite(result.std_error) || !std::isfinite(result.z)) {
    return std::nullopt;
  }
  return result;
}

namespace {

std::vector<Part> recordings_of(std::span<const Event> events, std::vector<Part>* blocks) {
  struct Sum {
    double count = 0.0;
    double value = 0.0;
    std::size_t motion = 0;
  };
  std::map<std::size_t, Sum> sums;
  for (const Event& event : events) {
    Sum& sum = sums[event.recording];
    sum.count += 1.0;
    sum.value += event.value;
    sum.motion = event.motion;
  }
  std::vector<Part> result;
  result.reserve(sums.size());
  for (const auto& [recording, sum] : sums) {
    result.push_back({recording, 1.0, sum.value / sum.count, sum.motion});
  }
  for (const Event& event : events) {
    if (blocks != nullptr) {
      blocks->push_back({event.recording, 1.0 / sums[event.recording].count, event.value, event.motion});
    }
  }
  return result;
}

}  // namespace

std::optional<Contrast> pooled(ContrastKind kind, std::span<const Event> events) {
  std::vector<Part> blocks;
  const std::vector<Part> recordings = recordings_of(events, &blocks);
  return pooled(kind, recordings, blocks);
}

double mean_of(std::span<const Event> events) {
  double sum = 0.0;
  const std::vector<Part> recordings = recordings_of(events, nullptr);
  for (const Part& part : recordings) {
    sum += part.value;
  }
  return recordings.empty() ? 0.0 : sum / static_cast<double>(recordings.size());
}

void judge(Contrast& contrast, double size, std::span<const double> of_placebos) {
  contrast.placebos = of_placebos.size();
  const auto below = std::ranges::count_if(of_placebos, [&](double other) { return other < size; });
  contrast.placebo_quantile =
      of_placebos.empty() ? 0.0 : static_cast<double>(below) / static_cast<double>(of_placebos.size());
}

}  // namespace hysteron::contrast

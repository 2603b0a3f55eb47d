#include "diagnose/residual/locate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/random.hpp"
#include "diagnose/signal/features.hpp"

namespace hysteron {
namespace {

constexpr std::size_t bins = 16;      // of each quantity, of equal numbers of samples
constexpr std::size_t stretches = 8;  // of each recording, the blocks of the bootstrap
constexpr int resamples = 200;        // of the bootstrap
// An interval is told when it holds this part of the misfit, this many times its share of the samples, and in 19 of 20
// resamples more than its share.
constexpr double least_part = 0.2;
constexpr double least_ratio = 1.25;
constexpr double surely_above = 1.1;
// Values of one level differ by less than this part of their range.
constexpr double level_width = 5e-3;

// One variable sampled over all recordings.
struct Variable {
  std::string name;
  std::string unit;
  double factor = 1.0;  // from SI to the unit in sentences
  std::string shown_unit;
  std::function<double(const Recording&, const Features&, std::size_t)> value;  // NaN: not defined there
};

const std::vector<Variable>& variables() {
  static const std::vector<Variable> list = {
      {"speed", "m/s", 1e3, "mm/s",
       [](const Recording& r, const Features&, std::size_t n) { return std::fabs(r.velocity[n]); }},
      {"velocity", "m/s", 1e3, "mm/s",
       [](const Recording& r, const Features&, std::size_t n) { return r.velocity[n]; }},
      {"displacement", "m", 1e3, "mm",
       [](const Recording& r, const Features&, std::size_t n) { return r.displacement[n]; }},
      {"distance from mid-stroke", "m", 1e3, "mm",
       [](const Recording& r, const Features& f, std::size_t n) { return std::fabs(r.displacement[n] - f.centre); }},
      {"displacement since reversal", "m", 1e3, "mm",
       [](const Recording&, const Features& f, std::size_t n) { return f.since_reversal_distance[n]; }},
      {"time since reversal", "s", 1e3, "ms",
       [](const Recording&, const Features& f, std::size_t n) { return f.since_reversal_time[n]; }},
      {"time since the drive changed", "s", 1e3, "ms",
       [](const Recording&, const Features& f, std::size_t n) {
         return f.since_drive_change.empty() || f.drive_step[n] == 0.0 ? std::nan("") : f.since_drive_change[n];
       }},
      {"drive", "", 1.0, "",  // A or V as recorded
       [](const Recording& r, const Features&, std::size_t n) { return r.drive.empty() ? std::nan("") : r.drive[n]; }},
      {"travelled distance", "m", 1.0, "m",
       [](const Recording&, const Features& f, std::size_t n) { return f.travelled[n]; }},
      {"time", "s", 1.0, "s", [](const Recording& r, const Features&, std::size_t n) { return r.time[n] - r.time[0]; }},
  };
  return list;
}

std::string sentence(const Variable& variable, double from, double to, bool lowest, bool highest) {
  const double a = from * variable.factor;
  const double b = to * variable.factor;
  if (lowest && variable.name != "velocity" && variable.name != "displacement") {
    if (variable.name == "displacement since reversal" || variable.name == "time since reversal") {
      return fmt::format("within {:.3g} {} after a reversal", b, variable.shown_unit);
    }
    if (variable.name == "time since the drive changed") {
      return fmt::format("within {:.3g} {} after the drive changed", b, variable.shown_unit);
    }
    return fmt::format("{} below {:.3g} {}", variable.name, b, variable.shown_unit);
  }
  if (highest) {
    return fmt::format("{} above {:.3g} {}", variable.name, a, variable.shown_unit);
  }
  if (lowest) {
    return fmt::format("{} below {:.3g} {}", variable.name, b, variable.shown_unit);
  }
  return fmt::format("{} between {:.3g} and {:.3g} {}", variable.name, a, b, variable.shown_unit);
}

}  // namespace

std::vector<double> bin_edges(std::vector<double> values) {
  std::ranges::sort(values);
  const double apart = level_width * (values.back() - values.front());
  std::vector<double> edges;
  std::vector<double> levels;
  for (std::size_t b = 0; b <= bins; ++b) {
    const double value = values[std::min(values.size() - 1, b * values.size() / bins)];
    if (edges.empty() || value > edges.back()) {
      edges.push_back(value);
    }
    if (levels.empty() || value > levels.back() + apart) {
      levels.push_back(value);
    }
  }
  if (levels.size() > bins / 2) {
    return edges;
  }
  std::vector<double> between = {values.front()};
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    between.push_back(0.5 * (levels[k] + levels[k + 1]));
  }
  between.push_back(values.back());
  return between;
}

std::vector<Location> locate(const std::vector<Recording>& recordings, const Residuals& residuals) {
  std::vector<Features> features;
  std::vector<std::vector<double>> energy;  // per recording and sample, normalised, noise taken off
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    features.push_back(features_of(recordings[k]));
    const Residual& residual = residuals.of[k];
    const double norm = residuals.norms[k];
    const double noise = residuals.noise[k].sigma / norm;
    std::vector<double> r(recordings[k].size(), 0.0);
    for (std::size_t n = residual.from; n < r.size(); ++n) {
      r[n] = (residual.force[n] * residual.force[n] / (norm * norm) - noise * noise) / static_cast<double>(r.size());
    }
    energy.push_back(std::move(r));
  }
  std::vector<Location> result;
  for (Variable variable : variables()) {
    if (variable.name == "drive") {
      variable.unit = recordings.front().drive_kind == DriveKind::voltage ? "V" : "A";
      variable.shown_unit = variable.unit;
    }
    std::vector<double> values;
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      for (std::size_t n = 0; n < recordings[k].size(); n += 7) {
        const double value = variable.value(recordings[k], features[k], n);
        if (std::isfinite(value)) {
          values.push_back(value);
        }
      }
    }
    if (values.size() < 100) {
      continue;
    }
    const std::vector<double> edges = bin_edges(std::move(values));
    const std::size_t count = edges.size() - 1;
    if (count < 2) {
      continue;
    }
    // Sums by block (recording and stretch) and bin.
    const std::size_t blocks = recordings.size() * stretches;
    std::vector<double> misfit(blocks * count, 0.0);
    std::vector<double> samples(blocks * count, 0.0);
    std::vector<double> outside(blocks, 0.0);  // where the variable is not defined
    std::vector<double> outside_samples(blocks, 0.0);
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      const double weight = 1.0 / static_cast<double>(recordings[k].size());
      for (std::size_t n = 0; n < recordings[k].size(); ++n) {
        const std::size_t block = k * stretches + n * stretches / recordings[k].size();
        const double value = variable.value(recordings[k], features[k], n);
        if (!std::isfinite(value)) {
          outside[block] += energy[k][n];
          outside_samples[block] += weight;
          continue;
        }
        const auto upper = std::ranges::upper_bound(edges, value) - edges.begin();
        const std::size_t bin = std::clamp<std::ptrdiff_t>(upper - 1, 0, static_cast<std::ptrdiff_t>(count) - 1);
        misfit[block * count + bin] += energy[k][n];
        samples[block * count + bin] += weight;
      }
    }
    const auto shares = [&](const std::vector<std::size_t>& chosen, std::size_t from, std::size_t to) {
      double inside = 0.0;
      double all = 0.0;
      double inside_samples = 0.0;
      double all_samples = 0.0;
      for (const std::size_t block : chosen) {
        for (std::size_t b = 0; b < count; ++b) {
          const bool in = b >= from && b < to;
          inside += in ? misfit[block * count + b] : 0.0;
          inside_samples += in ? samples[block * count + b] : 0.0;
          all += misfit[block * count + b];
          all_samples += samples[block * count + b];
        }
        all += outside[block];
        all_samples += outside_samples[block];
      }
      return std::pair{all > 0.0 ? std::clamp(inside / all, 0.0, 1.0) : 0.0, inside_samples / all_samples};
    };
    std::vector<std::size_t> every(blocks);
    std::iota(every.begin(), every.end(), std::size_t{0});
    double best = 0.0;
    std::size_t best_from = 0;
    std::size_t best_to = 0;
    for (std::size_t from = 0; from < count; ++from) {
      for (std::size_t to = from + 1; to <= count; ++to) {
        const auto [part, of_samples] = shares(every, from, to);
        if (part - of_samples > best) {
          best = part - of_samples;
          best_from = from;
          best_to = to;
        }
      }
    }
    if (best <= 0.0) {
      continue;
    }
    const auto [part, of_samples] = shares(every, best_from, best_to);
    std::vector<double> ratios;
    const Stream stream = Stream(0).child("locate").child(variable.name);
    for (int s = 0; s < resamples; ++s) {
      std::vector<std::size_t> drawn(blocks);
      for (std::size_t b = 0; b < blocks; ++b) {
        drawn[b] = stream.below(blocks, static_cast<std::uint64_t>(s), static_cast<std::uint32_t>(b));
      }
      const auto [drawn_part, drawn_samples] = shares(drawn, best_from, best_to);
      ratios.push_back(drawn_samples > 0.0 ? drawn_part / drawn_samples : 0.0);
    }
    std::ranges::sort(ratios);
    Location location;
    location.variable = variable.name;
    location.unit = variable.unit;
    // An end that is zero but for rounding is zero.
    location.from = std::fabs(edges[best_from]) < 1e-6 * std::fabs(edges.back()) ? 0.0 : edges[best_from];
    location.to = edges[best_to];
    location.where = sentence(variable, location.from, location.to, best_from == 0, best_to == count);
    if (location.where.ends_with(' ')) {  // a variable without a unit
      location.where.pop_back();
    }
    location.share_of_misfit = part;
    location.share_of_samples = of_samples;
    location.lowest_ratio = ratios[resamples / 20];
    if (part < least_part || part < least_ratio * of_samples || location.lowest_ratio < surely_above) {
      continue;
    }
    // Recordings that hold more than their share of it.
    std::vector<double> held(recordings.size(), 0.0);
    double total = 0.0;
    for (std::size_t block = 0; block < blocks; ++block) {
      for (std::size_t b = best_from; b < best_to; ++b) {
        held[block / stretches] += misfit[block * count + b];
        total += misfit[block * count + b];
      }
    }
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      if (held[k] > total / static_cast<double>(recordings.size())) {
        location.recordings.push_back(recordings[k].file);
      }
    }
    result.push_back(std::move(location));
  }
  std::ranges::stable_sort(result, [](const Location& a, const Location& b) {
    return a.share_of_misfit - a.share_of_samples > b.share_of_misfit - b.share_of_samples;
  });
  if (result.size() > 5) {
    result.resize(5);
  }
  return result;
}

}  // namespace hysteron

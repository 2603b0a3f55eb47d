#include "challenge/place.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hysteron::challenge {
namespace {

constexpr std::size_t classes = 48;
// A turn counts once the speed was above this part of the recording's largest on both sides, a step of the drive from
// this part of its range on.
constexpr double quiet_speed = 0.02;
constexpr double least_step = 0.05;

using Values = std::vector<double>;
using Channels = std::map<std::string, Values>;

double largest(const Values& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

void add_turns(Channels& channels, const Measured& r) {
  const double quiet = quiet_speed * largest(r.v);
  double path = 0.0;
  double path_at_turn = 0.0;
  double time_of_turn = r.time.front();
  int sense = 0;
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    if (k > 0) path += std::abs(r.x[k] - r.x[k - 1]);
    const int now = r.v[k] > quiet ? 1 : (r.v[k] < -quiet ? -1 : 0);
    if (now != 0 && now != sense) {
      sense = now;
      path_at_turn = path;
      time_of_turn = r.time[k];
    }
    channels["displacement since reversal"].push_back(path - path_at_turn);
    channels["time since reversal"].push_back(r.time[k] - time_of_turn);
    channels["travelled distance"].push_back(path);
  }
}

void add_drive(Channels& channels, const Measured& r) {
  if (r.drive.empty()) return;
  channels["drive"] = r.drive;
  const auto [low, high] = std::ranges::minmax(r.drive);
  double settled = r.drive.front();
  double changed = std::nan("");
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    if (std::abs(r.drive[k] - settled) > least_step * std::max(high - low, 0.1 * std::abs(high))) {
      settled = r.drive[k];
      changed = r.time[k];
    }
    channels["time since the drive changed"].push_back(r.time[k] - changed);
  }
}

Channels channels_of(const Measured& r) {
  const auto [low, high] = std::ranges::minmax(r.x);
  Channels channels = {{"velocity", r.v}, {"displacement", r.x}};
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    channels["speed"].push_back(std::abs(r.v[k]));
    channels["distance from mid-stroke"].push_back(std::abs(r.x[k] - 0.5 * (low + high)));
    channels["time"].push_back(r.time[k] - r.time.front());
  }
  add_turns(channels, r);
  add_drive(channels, r);
  return channels;
}

// A value of a variable, with what a sample of it counts and the squared change there.
struct Sample {
  double value, weight, energy;
};

nlohmann::json spread(std::vector<Sample> samples) {
  std::ranges::sort(samples, {}, &Sample::value);
  Values edges = {samples.front().value};
  Values weights;
  Values energies;
  double weight = 0.0;
  double energy = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    weight += samples[k].weight;
    energy += samples[k].energy;
    const bool full = (k + 1) * classes / samples.size() > k * classes / samples.size();
    // Equal values stay in one class.
    if (k + 1 == samples.size() || (full && samples[k + 1].value > samples[k].value)) {
      edges.push_back(k + 1 == samples.size() ? samples[k].value : 0.5 * (samples[k].value + samples[k + 1].value));
      weights.push_back(weight);
      energies.push_back(energy);
      weight = energy = 0.0;
    }
  }
  return {{"edges", edges}, {"samples", weights}, {"energy", energies}};
}

// The part of a class [a, b] that lies in [from, to].
double overlap(double a, double b, double from, double to) {
  if (b <= a) return a >= from && a <= to ? 1.0 : 0.0;
  return std::clamp((std::min(b, to) - std::max(a, from)) / (b - a), 0.0, 1.0);
}

}  // namespace

nlohmann::json places_of(const std::vector<Measured>& recordings, const Forces& left,
                         const std::vector<double>& peaks) {
  std::map<std::string, std::vector<Sample>> samples;
  double all = 0.0;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const double count = static_cast<double>(left[r].size());
    for (const double value : left[r]) all += value * value / (peaks[r] * peaks[r] * count);
  }
  if (!(all > 0.0)) return nlohmann::json::object();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const double count = static_cast<double>(left[r].size());
    for (const auto& [name, values] : channels_of(recordings[r])) {
      for (std::size_t k = 0; k < std::min(values.size(), left[r].size()); ++k) {
        if (!std::isfinite(values[k])) continue;
        const double energy = left[r][k] * left[r][k] / (peaks[r] * peaks[r] * count * all);
        samples[name].push_back({values[k], 1.0 / (count * static_cast<double>(recordings.size())), energy});
      }
    }
  }
  nlohmann::json result = nlohmann::json::object();
  for (auto& [name, list] : samples) result[name] = spread(std::move(list));
  return result;
}

double concentration(const nlohmann::json& places, const std::string& variable, double from, double to) {
  if (!places.contains(variable)) return 0.0;
  const nlohmann::json& of = places.at(variable);
  double samples = 0.0;
  double energy = 0.0;
  for (std::size_t k = 0; k < of.at("samples").size(); ++k) {
    const double part = overlap(of.at("edges").at(k).get<double>(), of.at("edges").at(k + 1).get<double>(), from, to);
    samples += part * of.at("samples").at(k).get<double>();
    energy += part * of.at("energy").at(k).get<double>();
  }
  return samples > 0.0 ? energy / samples : 0.0;
}

}  // namespace hysteron::challenge

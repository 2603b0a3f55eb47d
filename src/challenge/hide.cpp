#include "challenge/hide.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "io/velocity.hpp"

namespace hysteron::challenge {
namespace {

constexpr double least_share = 0.1;
constexpr double most_share = 0.3;
// Force at which a play bears, over the peak force.
constexpr double bearing_share = 0.02;
// Where the stops begin, over the largest amplitude.
constexpr double least_stop = 0.7;
constexpr double most_stop = 0.85;

using Channel = std::vector<double>;

// A recording with the derivatives that the arithmetic needs.
struct Source {
  const Recording* recording;
  double middle;  // of the campaign's strokes
  Channel x;      // from there
  Channel v;
  Channel a;
};

std::vector<Source> sources_of(const std::vector<Recording>& recordings) {
  double low = 1e300;
  double high = -1e300;
  for (const Recording& recording : recordings) {
    const auto [least, most] = std::ranges::minmax(recording.displacement);
    low = std::min(low, least);
    high = std::max(high, most);
  }
  std::vector<Source> result;
  for (const Recording& recording : recordings) {
    Source source{&recording, 0.5 * (low + high), recording.displacement, {}, {}};
    for (double& x : source.x) x -= source.middle;
    source.v = derive_velocity(recording.time, recording.displacement);
    source.a = derive_velocity(recording.time, source.v);
    result.push_back(std::move(source));
  }
  return result;
}

double root_mean_square(const std::vector<Channel>& channels) {
  double sum = 0.0;
  double count = 0.0;
  for (const Channel& channel : channels) {
    for (const double value : channel) sum += value * value;
    count += static_cast<double>(channel.size());
  }
  return std::sqrt(sum / count);
}

double largest(const std::vector<Channel>& channels) {
  double result = 0.0;
  for (const Channel& channel : channels) {
    for (const double value : channel) result = std::max(result, std::fabs(value));
  }
  return result;
}

std::vector<Channel> of_each(const std::vector<Source>& sources, const std::function<Channel(const Source&)>& channel) {
  std::vector<Channel> result;
  result.reserve(sources.size());
  for (const Source& source : sources) result.push_back(channel(source));
  return result;
}

// sample(source, n) at every sample.
Channel sampled(const Source& source, const std::function<double(const Source&, std::size_t)>& sample) {
  Channel result(source.x.size());
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = sample(source, n);
  return result;
}

// Linear between samples, the ends held.
double at(const Channel& time, const Channel& values, double t) {
  const auto above = std::ranges::upper_bound(time, t);
  if (above == time.begin()) return values.front();
  if (above == time.end()) return values.back();
  const auto n = static_cast<std::size_t>(above - time.begin());
  const double part = (t - time[n - 1]) / (time[n] - time[n - 1]);
  return values[n - 1] + part * (values[n] - values[n - 1]);
}

void add_to(Channel& channel, const Channel& more, double factor) {
  for (std::size_t n = 0; n < channel.size(); ++n) channel[n] += factor * more[n];
}

// Recordings as they are, but without the channels that would contradict an altered one.
std::vector<Recording> bare(const std::vector<Recording>& recordings) {
  std::vector<Recording> result = recordings;
  for (Recording& recording : result) {
    recording.velocity.clear();
    recording.acceleration.clear();
    recording.velocity_measured = false;
  }
  return result;
}

// F + size * shape, the size such that the change has the share of the force.
Altered with_force(const std::vector<Source>& sources, std::vector<Recording> recordings, const std::string& name,
                   const std::string& unit, double share,
                   const std::function<double(const Source&, std::size_t)>& shape) {
  const std::vector<Channel> shapes = of_each(sources, [&](const Source& s) { return sampled(s, shape); });
  const double force = root_mean_square(of_each(sources, [](const Source& s) { return s.recording->force; }));
  const double size = share * force / root_mean_square(shapes);
  for (std::size_t r = 0; r < recordings.size(); ++r) add_to(recordings[r].force, shapes[r], size);
  return {"", share, {{name, unit, size}}, std::move(recordings)};
}

Altered delayed(const std::vector<Source>& sources, std::vector<Recording> recordings, double share) {
  const double force = root_mean_square(of_each(sources, [](const Source& s) { return s.recording->force; }));
  // Slopes of the force beyond its noise: of the force smoothed as a displacement is.
  const double slope = root_mean_square(
      of_each(sources, [](const Source& s) { return derive_velocity(s.recording->time, s.recording->force); }));
  const double lag = share * force / slope;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Recording& source = *sources[r].recording;
    for (std::size_t n = 0; n < source.size(); ++n) {
      recordings[r].force[n] = at(source.time, source.force, source.time[n] - lag);
    }
  }
  return {"", share, {{"lag", "s", lag}}, std::move(recordings)};
}

// The damper's motion behind an element in series: what was recorded plus the deflection under the measured force.
Altered behind(const std::vector<Source>& sources, std::vector<Recording> recordings, double share, bool play) {
  double smallest = 1e300;
  for (const Source& source : sources) {
    const auto [low, high] = std::ranges::minmax(source.x);
    if (high > low) smallest = std::min(smallest, 0.5 * (high - low));
  }
  const double force = largest(of_each(sources, [](const Source& s) { return s.recording->force; }));
  const double deflection = share * smallest;
  for (Recording& recording : recordings) {
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double load = recording.force[n] / force;
      recording.displacement[n] += deflection * (play ? std::tanh(load / bearing_share) : load);
    }
  }
  return {"",
          share,
          {play ? HiddenParameter{"gap", "m", 2.0 * deflection} : HiddenParameter{"C", "m/N", deflection / force}},
          std::move(recordings)};
}

Altered stopped(const std::vector<Source>& sources, std::vector<Recording> recordings, Draws& draws, double share) {
  const double from =
      draws.uniform(least_stop, most_stop) * largest(of_each(sources, [](const Source& s) { return s.x; }));
  Altered result = with_force(
      sources, std::move(recordings), "k_b", "N/m", share,
      [from](const Source& s, std::size_t n) { return std::max(s.x[n] - from, 0.0) - std::max(-s.x[n] - from, 0.0); });
  // The catalogue counts from the recording's zero.
  const double middle = sources.front().middle;
  result.parameters.push_back({"x_up", "m", middle + from});
  result.parameters.push_back({"x_low", "m", from - middle});
  return result;
}

template <class Values>
void shuffle(Values& values, Draws& draws) {
  for (std::size_t k = values.size(); k > 1; --k) {
    std::swap(values[k - 1], values[static_cast<std::size_t>(draws.integer(0, static_cast<int>(k) - 1))]);
  }
}

std::vector<Recording> with_shuffled_drive(std::vector<Recording> recordings, Draws& draws) {
  std::vector<double> levels;
  std::vector<Recording*> constant;
  for (Recording& recording : recordings) {
    if (recording.drive.empty()) throw InputError(recording.file, 0, "no current or voltage, expected one to shuffle");
    if (drive_varies(recording)) {
      shuffle(recording.drive, draws);
    } else {
      levels.push_back(recording.drive.front());
      constant.push_back(&recording);
    }
  }
  shuffle(levels, draws);
  for (Recording* recording : constant) {
    recording->drive.assign(recording->size(), levels.back());
    levels.pop_back();
  }
  return recordings;
}

std::vector<Recording> with_swapped_forces(std::vector<Recording> recordings) {
  const std::vector<Recording> originals = recordings;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Channel& other = originals[(r + 1) % originals.size()].force;
    for (std::size_t n = 0; n < recordings[r].size(); ++n) recordings[r].force[n] = other[n % other.size()];
  }
  return recordings;
}

}  // namespace

const std::vector<std::string_view>& hideable() {
  static const std::vector<std::string_view> ids = {"inertia",   "sensor-delay", "force-drift", "cubic-stiffness",
                                                    "asymmetry", "end-stop",     "compliance",  "clearance"};
  return ids;
}

const std::vector<std::string_view>& placebos() {
  static const std::vector<std::string_view> ids = {"shuffled-drive", "flipped-velocity", "swapped-forces"};
  return ids;
}

void check_hideable(const std::string& id) {
  std::string known;
  for (const auto* list : {&hideable(), &placebos()}) {
    for (const std::string_view one : *list) {
      if (one == id) return;
      known += (known.empty() ? "" : ", ") + std::string(one);
    }
  }
  throw InputError("cannot hide '" + id + "' in recordings, expected one of " + known);
}

Altered alter(const std::vector<Recording>& recordings, const std::string& id, Draws& draws) {
  const std::vector<Source> sources = sources_of(recordings);
  std::vector<Recording> plain = bare(recordings);
  const double share = draws.log_uniform(least_share, most_share);
  Altered result;
  if (id == "inertia") {
    result =
        with_force(sources, std::move(plain), "m", "kg", share, [](const Source& s, std::size_t n) { return s.a[n]; });
  } else if (id == "sensor-delay") {
    result = delayed(sources, std::move(plain), share);
  } else if (id == "force-drift") {
    result = with_force(sources, std::move(plain), "r", "N/s", share, [](const Source& s, std::size_t n) {
      return s.recording->time[n] - s.recording->time.front();
    });
  } else if (id == "cubic-stiffness") {
    result = with_force(sources, std::move(plain), "k3", "N/m^3", share,
                        [](const Source& s, std::size_t n) { return s.x[n] * s.x[n] * s.x[n]; });
  } else if (id == "asymmetry") {
    result = with_force(sources, std::move(plain), "e", "1", share, [](const Source& s, std::size_t n) {
      return s.recording->force[n] * (s.v[n] < 0.0 ? -1.0 : 1.0);
    });
  } else if (id == "end-stop") {
    result = stopped(sources, std::move(plain), draws, share);
  } else if (id == "compliance" || id == "clearance") {
    result = behind(sources, std::move(plain), share, id == "clearance");
  } else if (id == "shuffled-drive") {
    result.recordings = with_shuffled_drive(std::move(plain), draws);
  } else if (id == "swapped-forces") {
    result.recordings = with_swapped_forces(std::move(plain));
  } else if (id == "flipped-velocity") {
    for (std::size_t r = 0; r < plain.size(); ++r) {
      plain[r].velocity = sources[r].v;
      for (double& v : plain[r].velocity) v = -v;
    }
    result.recordings = std::move(plain);
  } else {
    check_hideable(id);
  }
  result.id = id;
  return result;
}

}  // namespace hysteron::challenge

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

// The force of `from` laid over the samples of a stretch, first on first and last on last.
void lay(const Channel& from, std::size_t first, std::size_t last, Channel& to, std::size_t begin, std::size_t end) {
  for (std::size_t n = begin; n < end; ++n) {
    const double part = end - begin > 1 ? static_cast<double>(n - begin) / static_cast<double>(end - begin - 1) : 0.0;
    const double place = static_cast<double>(first) + part * static_cast<double>(last - 1 - first);
    const auto at_sample = std::min(static_cast<std::size_t>(place), from.size() - 2);
    to[n] = from[at_sample] + (place - static_cast<double>(at_sample)) * (from[at_sample + 1] - from[at_sample]);
  }
}

// Every recording of `group` with the force of another one of it.
void swap_forces(std::vector<Recording>& recordings, const std::vector<std::size_t>& group, std::size_t by) {
  const std::vector<Recording> originals = recordings;
  for (std::size_t k = 0; k < group.size(); ++k) {
    const Channel& other = originals[group[(k + by) % group.size()]].force;
    Channel& force = recordings[group[k]].force;
    for (std::size_t n = 0; n < force.size(); ++n) force[n] = other[n % other.size()];
  }
}

std::vector<Recording> with_swapped_forces(std::vector<Recording> recordings, Draws& draws) {
  if (recordings.size() < 2) throw InputError("swapped-forces takes two recordings or more");
  std::vector<std::size_t> order(recordings.size());
  for (std::size_t r = 0; r < order.size(); ++r) order[r] = r;
  shuffle(order, draws);
  swap_forces(recordings, order, 1);
  return recordings;
}

// Among neighbours in the order of amplitudes, three and three, so that the motions are alike.
std::vector<Recording> with_swapped_like_forces(const std::vector<Source>& sources, std::vector<Recording> recordings,
                                                Draws& draws) {
  if (recordings.size() < 2) throw InputError("swapped-like-forces takes two recordings or more");
  std::vector<std::size_t> order(recordings.size());
  std::vector<double> amplitudes;
  for (std::size_t r = 0; r < order.size(); ++r) {
    order[r] = r;
    const auto [low, high] = std::ranges::minmax(sources[r].x);
    amplitudes.push_back(high - low);
  }
  shuffle(order, draws);  // recordings of equal amplitude in any order
  std::ranges::stable_sort(order, {}, [&](std::size_t r) { return std::round(20.0 * std::log(amplitudes[r])); });
  for (std::size_t first = 0; first < order.size();) {
    // No group of one is left at the end.
    const std::size_t left = order.size() - first;
    const std::size_t count = left < 6 ? (left <= 3 ? left : 2) : 3;
    swap_forces(recordings,
                {order.begin() + static_cast<std::ptrdiff_t>(first),
                 order.begin() + static_cast<std::ptrdiff_t>(first + count)},
                1);
    first += count;
  }
  return recordings;
}

std::vector<Recording> with_reversed_forces(std::vector<Recording> recordings, Draws& draws) {
  for (Recording& recording : recordings) {
    std::ranges::reverse(recording.force);
    const auto place = static_cast<std::ptrdiff_t>(draws.uniform(0.0, 1.0) * static_cast<double>(recording.size()));
    std::ranges::rotate(recording.force, recording.force.begin() + place);
  }
  return recordings;
}

std::vector<Recording> with_shuffled_strokes(const std::vector<Source>& sources, std::vector<Recording> recordings,
                                             Draws& draws) {
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const Source& source = sources[r];
    const double quiet = 0.02 * largest({source.v});
    std::vector<std::size_t> turns = {0};
    double sense = 0.0;
    for (std::size_t n = 0; n < source.v.size(); ++n) {
      if (std::abs(source.v[n]) < quiet) continue;
      if (source.v[n] * sense < 0.0) turns.push_back(n);
      sense = source.v[n];
    }
    turns.push_back(source.v.size());
    std::vector<std::size_t> order(turns.size() - 1);
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    shuffle(order, draws);
    for (std::size_t k = 0; k < order.size(); ++k) {
      lay(source.recording->force, turns[order[k]], turns[order[k] + 1], recordings[r].force, turns[k], turns[k + 1]);
    }
  }
  return recordings;
}

// The path since the start, and the turns since, of a recording.
Channel path_of(const Source& source) {
  Channel path(source.x.size(), 0.0);
  for (std::size_t n = 1; n < path.size(); ++n) path[n] = path[n - 1] + std::abs(source.x[n] - source.x[n - 1]);
  return path;
}
Channel turns_of(const Source& source) {
  const double quiet = 0.02 * largest({source.v});
  Channel turns(source.v.size(), 0.0);
  double sense = 0.0;
  double count = 0.0;
  for (std::size_t n = 0; n < turns.size(); ++n) {
    if (std::abs(source.v[n]) >= quiet) {
      if (source.v[n] * sense < 0.0) count += 1.0;
      sense = source.v[n];
    }
    turns[n] = count;
  }
  return turns;
}

// F (1 + size g), g one channel a recording; `sign` that of the size, which stays below 0.95.
Altered with_factor(const std::vector<Source>& sources, std::vector<Recording> recordings, const std::string& name,
                    double share, double sign, const std::vector<Channel>& factors) {
  std::vector<Channel> shapes = factors;
  for (std::size_t r = 0; r < shapes.size(); ++r) {
    for (std::size_t n = 0; n < shapes[r].size(); ++n) shapes[r][n] *= sources[r].recording->force[n];
  }
  const double force = root_mean_square(of_each(sources, [](const Source& s) { return s.recording->force; }));
  const double whole = root_mean_square(shapes);
  const double size = std::min(share * force / whole, sign < 0.0 ? 0.95 : 5.0);
  for (std::size_t r = 0; r < recordings.size(); ++r) add_to(recordings[r].force, shapes[r], sign * size);
  return {"", size * whole / force, {{name, "1", size}}, std::move(recordings)};
}

// The motion with a deflection of its own that each recording has: `shapes` of size 1 at the peak force.
Altered with_deflection(std::vector<Recording> recordings, const std::vector<Channel>& shapes, double deflection,
                        double share, HiddenParameter parameter) {
  for (std::size_t r = 0; r < recordings.size(); ++r) add_to(recordings[r].displacement, shapes[r], deflection);
  return {"", share, {std::move(parameter)}, std::move(recordings)};
}

double smallest_amplitude(const std::vector<Source>& sources) {
  double smallest = 1e300;
  for (const Source& source : sources) {
    const auto [low, high] = std::ranges::minmax(source.x);
    if (high > low) smallest = std::min(smallest, 0.5 * (high - low));
  }
  return smallest;
}

Altered pocketed(const std::vector<Source>& sources, std::vector<Recording> recordings, Draws& draws, double share) {
  const double peak = largest(of_each(sources, [](const Source& s) { return s.recording->force; }));
  const double pressure = peak * draws.log_uniform(0.04, 0.15);
  const double length = share * smallest_amplitude(sources) * (1.0 + pressure / peak);
  const auto shapes = of_each(sources, [pressure](const Source& source) {
    return sampled(source, [pressure](const Source& s, std::size_t n) {
      const double f = s.recording->force[n];
      return f / (pressure + std::abs(f));
    });
  });
  return with_deflection(std::move(recordings), shapes, length, share, {"L", "m", length});
}

// The leak's size: the largest deflection within a recording over the smallest amplitude.
Altered leaking(const std::vector<Source>& sources, std::vector<Recording> recordings, double share) {
  const auto shapes = of_each(sources, [](const Source& s) {
    const Recording& r = *s.recording;
    Channel integral(r.size(), 0.0);
    for (std::size_t n = 1; n < integral.size(); ++n) {
      integral[n] = integral[n - 1] + 0.5 * (r.force[n] + r.force[n - 1]) * (r.time[n] - r.time[n - 1]);
    }
    return integral;
  });
  const double e = share * smallest_amplitude(sources) / largest(shapes);
  return with_deflection(std::move(recordings), shapes, e, share, {"e", "m/(N s)", e});
}

Altered pinched(const std::vector<Source>& sources, std::vector<Recording> recordings, Draws& draws, double share) {
  const double stroke = largest(of_each(sources, [](const Source& s) { return s.x; }));
  const double centre = stroke * draws.uniform(-0.3, 0.3);
  const double width = stroke * draws.uniform(0.15, 0.4);
  const auto factors = of_each(sources, [centre, width](const Source& source) {
    return sampled(source, [centre, width](const Source& s, std::size_t n) {
      const double y = (s.x[n] - centre) / width;
      return 1.0 / (1.0 + y * y * y * y);
    });
  });
  Altered result = with_factor(sources, std::move(recordings), "p", share, -1.0, factors);
  result.parameters.push_back({"x_p", "m", sources.front().middle + centre});
  return result;
}

Altered sticking(const std::vector<Source>& sources, std::vector<Recording> recordings, Draws& draws, double share) {
  const double length = largest(of_each(sources, [](const Source& s) { return s.x; })) * draws.log_uniform(1.0, 5.0);
  const auto factors = of_each(sources, [length](const Source& s) {
    Channel factor = path_of(s);
    for (double& value : factor) value = 1.0 / ((1.0 + value / length) * (1.0 + value / length));
    return factor;
  });
  return with_factor(sources, std::move(recordings), "a", share, 1.0, factors);
}

Altered degraded(const std::vector<Source>& sources, std::vector<Recording> recordings, double share) {
  std::vector<Channel> factors = of_each(sources, turns_of);
  const double most = std::max(largest(factors), 1.0);
  for (Channel& factor : factors) {
    for (double& value : factor) value /= most;
  }
  return with_factor(sources, std::move(recordings), "d", share, -1.0, factors);
}

Altered charged(const std::vector<Source>& sources, std::vector<Recording> recordings, Draws& draws, double share) {
  const double g = draws.uniform(0.45, 0.7) / largest(of_each(sources, [](const Source& s) { return s.x; }));
  Altered result = with_force(sources, std::move(recordings), "f_g", "N", share,
                              [g](const Source& s, std::size_t n) { return 1.0 / (1.0 - g * s.x[n]) - 1.0; });
  result.parameters.push_back({"g", "1/m", g});
  return result;
}

// The kind of a placebo, "kind#number".
std::string kind_of(const std::string& id) { return id.substr(0, id.find('#')); }

Altered alter_one(const std::vector<Recording>& recordings, const std::string& id, Draws& draws, double share);

}  // namespace

const std::vector<std::string_view>& hideable() {
  static const std::vector<std::string_view> ids = {
      "inertia",          "sensor-delay",      "force-drift", "cubic-stiffness", "gas-spring",    "offset-force",
      "coulomb-friction", "quadratic-damping", "asymmetry",   "pinching",        "stiction",      "degradation",
      "end-stop",         "compliance",        "clearance",   "entrapped-gas",   "series-dashpot"};
  return ids;
}

const std::vector<std::string_view>& placebos() {
  static const std::vector<std::string_view> ids = {"shuffled-drive",      "flipped-velocity", "swapped-forces",
                                                    "swapped-like-forces", "reversed-forces",  "shuffled-strokes"};
  return ids;
}

bool is_placebo(const std::string& id) { return std::ranges::find(placebos(), kind_of(id)) != placebos().end(); }

std::vector<std::string> parts_of(const std::string& id) {
  std::vector<std::string> parts = {""};
  for (const char c : id) {
    if (c == '+') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

void check_hideable(const std::string& id) {
  if (is_placebo(id)) return;
  for (const std::string& part : parts_of(id)) {
    if (std::ranges::find(hideable(), part) != hideable().end()) continue;
    std::string known;
    for (const auto* list : {&hideable(), &placebos()}) {
      for (const std::string_view one : *list) known += (known.empty() ? "" : ", ") + std::string(one);
    }
    throw InputError("cannot hide '" + part + "' in recordings, expected one of " + known);
  }
}

double force_of(const std::vector<Recording>& recordings) {
  std::vector<Channel> forces;
  for (const Recording& recording : recordings) forces.push_back(recording.force);
  return root_mean_square(forces);
}

Altered alter(const std::vector<Recording>& recordings, const std::string& id, Draws& draws, double share) {
  check_hideable(id);
  Altered result;
  result.recordings = recordings;
  for (const std::string& part : parts_of(id)) {
    Altered one = alter_one(result.recordings, kind_of(part), draws, share);
    result.recordings = std::move(one.recordings);
    result.share = std::max(result.share, one.share);
    for (HiddenParameter& parameter : one.parameters) {
      // Of several the parameters are told apart as in model.json.
      if (part != id) parameter.name = part + "." + parameter.name;
      result.parameters.push_back(std::move(parameter));
    }
  }
  result.id = id;
  return result;
}

namespace {

Altered alter_one(const std::vector<Recording>& recordings, const std::string& id, Draws& draws, double wanted) {
  const std::vector<Source> sources = sources_of(recordings);
  std::vector<Recording> plain = bare(recordings);
  const double drawn = draws.log_uniform(least_share, most_share);
  const double share = wanted > 0.0 ? wanted : drawn;
  if (id == "inertia") {
    return with_force(sources, std::move(plain), "m", "kg", share,
                      [](const Source& s, std::size_t n) { return s.a[n]; });
  }
  if (id == "sensor-delay") return delayed(sources, std::move(plain), share);
  if (id == "force-drift") {
    return with_force(sources, std::move(plain), "r", "N/s", share,
                      [](const Source& s, std::size_t n) { return s.recording->time[n] - s.recording->time.front(); });
  }
  if (id == "cubic-stiffness") {
    return with_force(sources, std::move(plain), "k3", "N/m^3", share,
                      [](const Source& s, std::size_t n) { return s.x[n] * s.x[n] * s.x[n]; });
  }
  if (id == "offset-force") {
    return with_force(sources, std::move(plain), "f0", "N", share, [](const Source&, std::size_t) { return 1.0; });
  }
  if (id == "coulomb-friction") {
    const double film = 5e-3 * largest(of_each(sources, [](const Source& s) { return s.v; }));
    return with_force(sources, std::move(plain), "fc", "N", share,
                      [film](const Source& s, std::size_t n) { return std::tanh(s.v[n] / film); });
  }
  if (id == "quadratic-damping") {
    return with_force(sources, std::move(plain), "d2", "N s^2/m^2", share,
                      [](const Source& s, std::size_t n) { return s.v[n] * std::abs(s.v[n]); });
  }
  if (id == "asymmetry") {
    return with_force(sources, std::move(plain), "e", "1", share, [](const Source& s, std::size_t n) {
      return s.recording->force[n] * (s.v[n] < 0.0 ? -1.0 : 1.0);
    });
  }
  if (id == "gas-spring") return charged(sources, std::move(plain), draws, share);
  if (id == "pinching") return pinched(sources, std::move(plain), draws, share);
  if (id == "stiction") return sticking(sources, std::move(plain), draws, share);
  if (id == "degradation") return degraded(sources, std::move(plain), share);
  if (id == "end-stop") return stopped(sources, std::move(plain), draws, share);
  if (id == "compliance" || id == "clearance") return behind(sources, std::move(plain), share, id == "clearance");
  if (id == "entrapped-gas") return pocketed(sources, std::move(plain), draws, share);
  if (id == "series-dashpot") return leaking(sources, std::move(plain), share);
  Altered result;
  if (id == "shuffled-drive") {
    result.recordings = with_shuffled_drive(std::move(plain), draws);
  } else if (id == "swapped-forces") {
    result.recordings = with_swapped_forces(std::move(plain), draws);
  } else if (id == "swapped-like-forces") {
    result.recordings = with_swapped_like_forces(sources, std::move(plain), draws);
  } else if (id == "reversed-forces") {
    result.recordings = with_reversed_forces(std::move(plain), draws);
  } else if (id == "shuffled-strokes") {
    result.recordings = with_shuffled_strokes(sources, std::move(plain), draws);
  } else {
    for (std::size_t r = 0; r < plain.size(); ++r) {
      plain[r].velocity = sources[r].v;
      for (double& v : plain[r].velocity) v = -v;
    }
    result.recordings = std::move(plain);
  }
  return result;
}

}  // namespace

}  // namespace hysteron::challenge

#include "challenge/excitation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hysteron::challenge {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double most_samples = 30000.0;

// Rise from 0 to 1 over s in [0, 1] with its derivatives: s^3 (10 - 15 s + 6 s^2).
Kinematics rise(double s) {
  if (s <= 0.0) return {};
  if (s >= 1.0) return {1.0, 0.0, 0.0};
  return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)), 30.0 * s * s * (1.0 - s) * (1.0 - s),
          60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)};
}

void measure(Run& test) {
  constexpr int points = 4000;
  for (int k = 0; k < points; ++k) {
    const Kinematics m = test.motion.at(test.duration * k / points);
    test.peak_amplitude = std::max(test.peak_amplitude, std::abs(m.x - test.motion.offset));
    test.peak_speed = std::max(test.peak_speed, std::abs(m.v));
    test.peak_acceleration = std::max(test.peak_acceleration, std::abs(m.a));
  }
}

Run sine_test(double amplitude, double frequency, double level) {
  Run test;
  test.kind = "sine";
  test.motion.sines = {{amplitude, two_pi * frequency, 0.0}};
  test.drive = {{0.0}, {level}, 0.002};
  test.lead = std::max(0.05, 1.0 / frequency);
  return test;
}

// Odd multiples of f0 up to the highest frequency, amplitudes falling with frequency, random phases.
Run multisine_test(Draws& draws, double amplitude, double highest_frequency) {
  Run test;
  test.kind = "multisine";
  const double f0 = draws.uniform(0.15, 0.3);
  double f = f0;
  while (f <= highest_frequency) {
    test.motion.sines.push_back({1.0 / (f + 0.3), two_pi * f, draws.uniform(0.0, two_pi)});
    f += 2.0 * f0;
  }
  test.duration = 5.0;
  measure(test);
  for (auto& sine : test.motion.sines) sine.amplitude *= amplitude / test.peak_amplitude;
  test.peak_amplitude = test.peak_speed = test.peak_acceleration = 0.0;
  test.lead = 1.0;
  return test;
}

Run triangle_test(Draws& draws, double amplitude, double speed) {
  Run test;
  test.kind = "triangle";
  test.motion.triangle_amplitude = amplitude;
  test.motion.triangle_omega = std::numbers::pi / 2.0 * speed / amplitude;
  test.motion.triangle_sharpness = draws.uniform(0.9, 0.97);
  test.lead = 0.5;
  return test;
}

Drive random_steps(Draws& draws, double duration, const std::vector<double>& levels) {
  Drive drive{{0.0}, {draws.pick(levels)}, draws.uniform(0.001, 0.003)};
  double t = draws.uniform(0.2, 0.6);
  while (t < duration - 0.1) {
    double level = draws.pick(levels);
    if (level == drive.levels.back()) level = level == levels.front() ? levels.back() : levels.front();
    drive.times.push_back(t);
    drive.levels.push_back(level);
    t += draws.uniform(0.25, 0.8);
  }
  return drive;
}

Drive staircase(double duration, const std::vector<double>& levels) {
  Drive drive{{}, {}, 0.002};
  std::vector<double> order = levels;
  for (std::size_t k = levels.size(); k-- > 1;) order.push_back(levels[k - 1]);
  for (std::size_t k = 0; k < order.size(); ++k) {
    drive.times.push_back(duration * static_cast<double>(k) / static_cast<double>(order.size()));
    drive.levels.push_back(order[k]);
  }
  return drive;
}

std::vector<double> draw_levels(Draws& draws, const Needs& needs, double highest) {
  if (needs.one_level) return {highest * draws.uniform(0.3, 1.0)};
  const int count = std::max(needs.levels, draws.integer(2, 4));
  std::vector<double> levels;
  levels.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) levels.push_back(std::round(100.0 * highest * k / (count - 1)) / 100.0);
  return levels;
}

void add_sines(Draws& draws, const Needs& needs, double amplitude, const std::vector<double>& levels, int limit,
               std::vector<Run>& tests) {
  constexpr std::array<double, 7> grid = {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0};
  const int frequency_count = needs.one_frequency ? 1 : std::max(needs.frequencies, draws.integer(2, 4));
  std::vector<double> frequencies;
  const int first = draws.integer(0, 1);
  for (int k = 0; k < frequency_count; ++k) {
    const std::size_t at =
        frequency_count == 1 ? 3 : static_cast<std::size_t>(first + k * (6 - first) / frequency_count);
    frequencies.push_back(std::round((needs.slow ? 40.0 : 100.0) * grid[at] * draws.uniform(0.9, 1.1)) / 100.0);
  }
  const int amplitude_count = draws.integer(2, 3);
  std::vector<double> amplitudes;
  amplitudes.reserve(static_cast<std::size_t>(amplitude_count));
  const double smallest = needs.small_amplitudes ? draws.uniform(0.05, 0.12) : draws.uniform(0.15, 0.4);
  for (int k = 0; k < amplitude_count; ++k) {
    amplitudes.push_back(amplitude * std::pow(smallest, 1.0 - k / (amplitude_count - 1.0)));
  }
  std::vector<Run> all;
  for (const double f : frequencies) {
    for (const double a : amplitudes) {
      for (const double level : levels) all.push_back(sine_test(a, f, level));
    }
  }
  // A random subset in random order, so that neither level nor severity runs with time.
  for (std::size_t k = all.size(); k > 1; --k) {
    std::swap(all[k - 1], all[static_cast<std::size_t>(draws.integer(0, static_cast<int>(k) - 1))]);
  }
  // The largest amplitude, the highest frequency and every level stay in.
  std::vector<Run> kept;
  const auto keep_first = [&](auto wanted) {
    const auto found = std::ranges::find_if(all, wanted);
    if (found != all.end()) {
      kept.push_back(*found);
      all.erase(found);
    }
  };
  for (const double level : levels) {
    keep_first(
        [&](const Run& t) { return t.drive.levels[0] == level && t.motion.sines[0].amplitude == amplitudes.back(); });
  }
  for (const double f : frequencies) {
    keep_first([&](const Run& t) { return t.motion.sines[0].omega == two_pi * f; });
  }
  while (static_cast<int>(kept.size()) < limit && !all.empty()) {
    kept.push_back(all.back());
    all.pop_back();
  }
  for (std::size_t k = kept.size(); k > 1; --k) {
    std::swap(kept[k - 1], kept[static_cast<std::size_t>(draws.integer(0, static_cast<int>(k) - 1))]);
  }
  for (Run& test : kept) {
    const double period = two_pi / test.motion.sines[0].omega;
    test.duration = std::clamp(draws.uniform(3.0, 5.0) * period, 2.0, 5.0);
    tests.push_back(test);
  }
}

void add_broadband(Draws& draws, const Needs& needs, double amplitude, const std::vector<double>& levels,
                   int multisines, int triangles, std::vector<Run>& tests) {
  const bool steps = needs.drive_steps || (!needs.one_level && draws.chance(0.7));
  for (int k = 0; k < multisines; ++k) {
    const double share = k == 0 ? 1.0 : draws.uniform(needs.small_amplitudes ? 0.15 : 0.4, 0.9);
    Run test = multisine_test(draws, amplitude * share, draws.uniform(4.0, 8.0) * (needs.slow ? 0.3 : 1.0));
    test.duration = draws.uniform(3.0, 6.0);
    test.drive = steps ? random_steps(draws, test.duration, levels)
                       : Drive{{0.0}, {levels[static_cast<std::size_t>(k) % levels.size()]}, 0.002};
    tests.push_back(test);
  }
  for (int k = 0; k < triangles; ++k) {
    const double share = k == 0 ? 1.0 : draws.uniform(0.3, 0.8);
    Run test = triangle_test(draws, amplitude * share, amplitude * draws.log_uniform(0.4, 3.0));
    test.duration = std::clamp(2.5 * two_pi / test.motion.triangle_omega, 3.0, 8.0);
    test.drive = needs.drive_steps && k % 2 == 1
                     ? staircase(test.duration, levels)
                     : Drive{{0.0}, {levels[static_cast<std::size_t>(k) % levels.size()]}, 0.002};
    tests.push_back(test);
  }
}

// The time of the motion at time t, with its derivatives: t itself until the motion slows down.
//   T(t) = stop + d (s - s^4 (5/2 - 3 s + s^2)),   s = (t - stop) / d, d = `stopping`;   T'(t) = 1 - rise(s)
Kinematics time_of_motion(const Motion& motion, double t) {
  if (t <= motion.stop) {
    return {t, 1.0, 0.0};
  }
  const double s = std::min((t - motion.stop) / motion.stopping, 1.0);
  const Kinematics r = rise(s);
  return {motion.stop + motion.stopping * (s - s * s * s * s * (2.5 + s * (-3.0 + s))), 1.0 - r.x,
          -r.v / motion.stopping};
}

}  // namespace

Kinematics Motion::at(double time) const {
  const Kinematics clock = time_of_motion(*this, time);
  const double t = clock.x;
  Kinematics sum;
  for (const Sine& sine : sines) {
    const double angle = sine.omega * t + sine.phase;
    const double s = sine.amplitude * std::sin(angle);
    sum.x += s;
    sum.v += sine.amplitude * sine.omega * std::cos(angle);
    sum.a -= sine.omega * sine.omega * s;
  }
  if (triangle_amplitude > 0.0) {
    const double k = triangle_sharpness;
    const double scale = triangle_amplitude / std::asin(k);
    const double s = std::sin(triangle_omega * t);
    const double c = std::cos(triangle_omega * t);
    const double root = std::sqrt(1.0 - k * k * s * s);
    sum.x += scale * std::asin(k * s);
    sum.v += scale * k * c * triangle_omega / root;
    sum.a -= scale * k * s * triangle_omega * triangle_omega * (1.0 - k * k) / (root * root * root);
  }
  if (ramp > 0.0) {
    const Kinematics r = rise(t / ramp);
    const double rv = r.v / ramp;
    const double ra = r.a / (ramp * ramp);
    sum = {r.x * sum.x, r.x * sum.v + rv * sum.x, r.x * sum.a + 2.0 * rv * sum.v + ra * sum.x};
  }
  return {offset + sum.x, clock.v * sum.v, clock.v * clock.v * sum.a + clock.a * sum.v};
}

double Drive::at(double t) const {
  double value = levels.front();
  for (std::size_t k = 1; k < times.size() && times[k] < t; ++k) {
    const double share = std::min((t - times[k]) / slew, 1.0);
    value = levels[k - 1] + share * (levels[k] - levels[k - 1]);
  }
  return value;
}

Excitation draw_excitation(const Stream& stream, Design design, const Needs& needs, double amplitude,
                           double highest_level) {
  Draws draws(stream, "excitation");
  Draws stops(stream, "stops");
  Excitation result;
  result.highest_level = highest_level;
  const std::vector<double> levels = draw_levels(draws, needs, highest_level);
  switch (design) {
    case Design::sines:
      add_sines(draws, needs, amplitude, levels, draws.integer(4, needs.long_runs ? 8 : 16), result.tests);
      break;
    case Design::broadband:
      add_broadband(draws, needs, amplitude, levels, draws.integer(3, 5), draws.integer(2, 3), result.tests);
      break;
    case Design::mixed:
      add_sines(draws, needs, amplitude, levels, draws.integer(4, 6), result.tests);
      add_broadband(draws, needs, amplitude, levels, draws.integer(2, 3), draws.integer(1, 2), result.tests);
      break;
  }
  // A ramp holds more than one frequency.
  const bool from_rest = !needs.steady && (needs.from_rest || draws.chance(0.8));
  const double middle = draws.chance(0.3) ? amplitude * draws.uniform(-0.3, 0.3) : 0.0;
  double total = 0.0;
  for (std::size_t k = 0; k < result.tests.size(); ++k) {
    Run& test = result.tests[k];
    test.number = k;
    test.motion.offset = middle;
    if (needs.long_runs && k % 4 == 0) test.duration = draws.uniform(12.0, 20.0);
    if (from_rest) {
      test.motion.ramp = draws.uniform(0.1, 0.4);
      test.lead = 0.05;
    }
    if (needs.stops && !needs.steady) {
      test.motion.stop = test.duration;
      test.motion.stopping = stops.uniform(0.02, 0.1);
      test.duration += stops.uniform(0.4, 0.9);
    }
    test.duration = std::round(100.0 * test.duration) / 100.0;
    measure(test);
    total += test.duration;
    result.amplitude = std::max(result.amplitude, test.peak_amplitude);
    result.smallest_amplitude = k == 0 ? test.peak_amplitude : std::min(result.smallest_amplitude, test.peak_amplitude);
    result.speed = std::max(result.speed, test.peak_speed);
    result.acceleration = std::max(result.acceleration, test.peak_acceleration);
    result.longest = std::max(result.longest, test.duration);
  }
  constexpr std::array<double, 9> rates = {1000.0, 800.0, 625.0, 500.0, 400.0, 320.0, 250.0, 200.0, 160.0};
  const double wanted = std::min(draws.log_uniform(needs.slow ? 500.0 : 250.0, 1200.0), most_samples / total);
  result.sampling_rate = rates.back();
  for (const double rate : rates) {
    if (rate <= wanted) {
      result.sampling_rate = rate;
      break;
    }
  }
  // One test in four is kept from the fit, never all of a kind.
  const std::size_t held = std::max<std::size_t>(1, result.tests.size() / 4);
  for (std::size_t k = 0; k < held; ++k) {
    result.tests[(k * 4 + 2) % result.tests.size()].held_out = true;
  }
  return result;
}

}  // namespace hysteron::challenge

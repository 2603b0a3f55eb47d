#include "challenge/concealed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "challenge/absorption.hpp"
#include "challenge/base.hpp"

namespace hysteron::challenge {
namespace {

// Grid points a second of the simulation: fine enough for the filter and the delay.
constexpr double finest_grid = 2500.0;

Needs merged(const Needs& a, const Needs& b) {
  Needs all;
  all.drive_steps = a.drive_steps || b.drive_steps;
  all.levels = std::max(a.levels, b.levels);
  all.from_rest = a.from_rest || b.from_rest;
  all.long_runs = a.long_runs || b.long_runs;
  all.frequencies = std::max(a.frequencies, b.frequencies);
  all.one_level = a.one_level || b.one_level;
  all.one_frequency = a.one_frequency || b.one_frequency;
  all.steady = a.steady || b.steady;
  all.slow = a.slow || b.slow;
  all.small_amplitudes = a.small_amplitudes || b.small_amplitudes;
  all.speed_decade = a.speed_decade || b.speed_decade;
  return all;
}

Design draw_design(Draws& draws, const Task& task, const Needs& needs) {
  if (task.level == Level::absorbed || needs.one_frequency) return Design::sines;
  if (needs.one_level) return draws.chance(0.5) ? Design::sines : Design::broadband;
  if (needs.drive_steps || needs.speed_decade) return draws.chance(0.5) ? Design::broadband : Design::mixed;
  const int which = draws.integer(0, 2);
  return which == 0 ? Design::sines : which == 1 ? Design::broadband : Design::mixed;
}

Law draw_true_law(Draws& draws, const Task& task) {
  std::vector<Law> laws = {Law::bouc_wen,        Law::bouc_wen, Law::bouc_wen, Law::modified_bouc_wen,
                           Law::tanh_hysteresis, Law::bingham,  Law::lugre,    Law::lugre};
  if (task.level == Level::wrong_base) {
    laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis, Law::lugre};
  }
  // A law without a knee takes up little.
  if (task.level == Level::absorbed) std::erase(laws, Law::bingham);
  for (const std::string& id : task.effects) {
    const HiddenEffect& effect = hidden_effect(id);
    std::erase_if(laws, [&](Law law) { return std::ranges::find(effect.laws, law) == effect.laws.end(); });
  }
  if (laws.empty()) laws = hidden_effect(task.effects.at(0)).laws;
  return draws.pick(laws);
}

double draw_share(Draws& draws, Level level, double noise) {
  switch (level) {
    case Level::buried:
      return noise * draws.uniform(0.35, 0.9);
    case Level::foreign:
      return draws.log_uniform(0.03, 0.2);
    default:
      return draws.log_uniform(0.02, 0.2);
  }
}

Chain draw_chain(Draws& draws, Level level, std::string& disturbance) {
  Chain chain;
  chain.noise = level == Level::buried ? draws.log_uniform(0.015, 0.03) : draws.log_uniform(0.003, 0.02);
  chain.coloured_share = draws.uniform(0.0, 0.6);
  chain.correlation = draws.uniform(0.5, 0.95);
  chain.outlier_rate = draws.chance(0.3) ? draws.log_uniform(1e-4, 1e-3) : 0.0;
  chain.outlier_size = draws.uniform(0.03, 0.1);
  chain.force_bits = draws.integer(12, 16);
  chain.displacement_noise = draws.log_uniform(3e-5, 3e-4);
  chain.displacement_bits = draws.integer(15, 17);
  chain.velocity_noise = draws.log_uniform(5e-4, 3e-3);
  if (level != Level::none) return chain;
  switch (draws.integer(0, 5)) {
    case 0:
      disturbance = "coloured noise";
      chain.noise = draws.log_uniform(0.01, 0.03);
      chain.coloured_share = 0.95;
      chain.correlation = draws.uniform(0.95, 0.995);
      break;
    case 1:
      disturbance = "coarse quantisation";
      chain.noise = 0.002;
      chain.force_bits = draws.integer(7, 9);
      break;
    case 2:
      disturbance = "outliers";
      chain.outlier_rate = draws.uniform(0.002, 0.01);
      chain.outlier_size = draws.uniform(0.1, 0.3);
      break;
    case 3:
      disturbance = "displacement noise";
      chain.displacement_noise = draws.log_uniform(1e-3, 3e-3);
      chain.displacement_bits = 13;
      break;
    case 4:
      disturbance = "scatter between recordings";
      break;
    default:
      disturbance = "white noise";
      chain.coloured_share = 0.0;
  }
  return chain;
}

Forces clean_forces(const Physics& physics, const std::vector<Run>& tests, double rate, int decimation) {
  Forces forces;
  for (const Run& test : tests) {
    forces.push_back(clean_force(physics, simulate(physics, test, rate), decimation));
  }
  return forces;
}

double peak_of(const std::vector<double>& values) {
  double peak = 0.0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

// a + factor b
Forces combined(const Forces& a, double factor, const Forces& b) {
  Forces result = a;
  for (std::size_t r = 0; r < a.size(); ++r) {
    for (std::size_t k = 0; k < a[r].size(); ++k) result[r][k] += factor * b[r][k];
  }
  return result;
}

Forces difference(const Forces& a, const Forces& b) { return combined(a, -1.0, b); }

// Root mean square of the change in the recording that changes most.
double largest_change(const Forces& change) {
  double largest = 0.0;
  for (const std::vector<double>& recording : change) {
    double squares = 0.0;
    for (const double value : recording) squares += value * value;
    largest = std::max(largest, std::sqrt(squares / static_cast<double>(recording.size())));
  }
  return largest;
}

double nrmse(const Forces& difference, const std::vector<double>& peaks) {
  double sum = 0.0;
  for (std::size_t r = 0; r < difference.size(); ++r) {
    double squares = 0.0;
    for (const double value : difference[r]) squares += value * value;
    sum += squares / static_cast<double>(difference[r].size()) / (peaks[r] * peaks[r]);
  }
  return std::sqrt(sum / static_cast<double>(difference.size()));
}

// Finds the strength at which the effect changes the force by the wanted share of the base's peak: secant steps on
// logarithms inside the effect's range.
struct Calibration {
  double strength;
  double share;
  Forces change;
};
Calibration calibrate(const HiddenEffect& effect, const Physics& base, const Device& device, const Stream& shape,
                      const Concealed& c, const Forces& without, double wanted) {
  const double rate = c.excitation.sampling_rate * c.decimation;
  const double peak = device.force;
  const auto measured = [&](double strength) {
    Physics physics = base;
    effect.put(physics, device, strength, Draws(shape));
    // A lag of the recorded velocity leaves the force as it is: its size is what a law fed with it makes of it.
    physics.acting_lag = physics.velocity_lag;
    Calibration result{strength, 0.0, {}};
    result.change = difference(clean_forces(physics, c.excitation.tests, rate, c.decimation), without);
    result.share = largest_change(result.change) / peak;
    return result;
  };
  const auto inside = [&](double strength) { return std::clamp(strength, effect.least, effect.most); };
  Calibration best = measured(inside(wanted));
  double slope = 1.0;
  for (int k = 0; k < 6 && std::abs(best.share / wanted - 1.0) > 0.03; ++k) {
    if (best.share <= 0.0) {
      // Nothing happens yet: a threshold lies above.
      if (best.strength >= effect.most) break;
      best = measured(inside(3.0 * best.strength));
      continue;
    }
    const double log_step = std::clamp(std::log(wanted / best.share) / slope, -2.0, 2.0);
    const double next = inside(best.strength * std::exp(log_step));
    if (next == best.strength) break;
    Calibration tried = measured(next);
    if (tried.share > 0.0) {
      const double seen = std::log(tried.share / best.share) / std::log(tried.strength / best.strength);
      if (std::isfinite(seen)) slope = std::clamp(seen, 0.2, 5.0);
    }
    if (std::abs(std::log(std::max(tried.share, 1e-12) / wanted)) <= std::abs(std::log(best.share / wanted))) {
      best = std::move(tried);
    } else {
      slope = std::clamp(2.0 * slope, 0.2, 5.0);
    }
  }
  return best;
}

}  // namespace

Concealed make_concealed(const Task& task, std::uint64_t seed) {
  const Stream stream = Stream(seed).child("campaign").child(static_cast<std::uint64_t>(task.number));
  Draws draws(stream, "campaign");
  Concealed c;
  c.name = fmt::format("campaign-{:04d}", task.number);
  c.task = task;

  Needs needs;
  for (const std::string& id : task.effects) {
    const HiddenEffect& effect = hidden_effect(id);
    needs = merged(needs, task.level == Level::unexcited ? effect.starved : effect.needs);
    c.velocity_given = c.velocity_given || effect.needs_velocity_channel;
  }
  if (task.level == Level::absorbed) needs = merged(needs, {.levels = 3, .frequencies = 3, .steady = true});
  c.design = draw_design(draws, task, needs);
  if (needs.long_runs && c.design == Design::broadband) c.design = Design::mixed;
  const Law law = draw_true_law(draws, task);
  c.chain = draw_chain(draws, task.level, c.disturbance);
  c.velocity_given = c.velocity_given || draws.chance(0.4);
  c.roles_given = draws.chance(0.7);
  c.drive_is_voltage = draws.chance(0.2);
  if (law == Law::bingham) {
    // Its step at rest is lost in a derived velocity.
    needs.slow = true;
    c.velocity_given = true;
    c.chain.velocity_noise = 2e-4;
  }

  Device device;
  device.force = draws.log_uniform(200.0, 20000.0);
  device.amplitude = draws.log_uniform(8e-3, 4e-2);
  device.level =
      c.drive_is_voltage ? std::round(draws.uniform(2.0, 5.0)) : std::round(10.0 * draws.uniform(0.8, 3.0)) / 10.0;
  c.excitation = draw_excitation(stream, c.design, needs, device.amplitude, device.level);
  device.amplitude = c.excitation.amplitude;
  device.smallest_amplitude = c.excitation.smallest_amplitude;
  device.speed = c.excitation.speed;
  device.acceleration = c.excitation.acceleration;
  device.longest = c.excitation.longest;
  device.middle = c.excitation.tests.front().motion.offset;
  for (const Run& test : c.excitation.tests) {
    device.energy = std::max(device.energy, 0.3 * device.force * test.peak_speed * test.duration);
  }
  const double sampling = c.excitation.sampling_rate;
  c.decimation = std::max(2, static_cast<int>(std::ceil(finest_grid / sampling)));
  const double rate = sampling * c.decimation;

  const Physics base = draw_law(stream, law, device);
  c.told_model = model_of(law);
  if (task.level == Level::wrong_base) {
    const WrongBase wrong = wrong_base_for(law, stream);
    c.told_model = wrong.model;
    c.acceptable = wrong.acceptable;
  }
  bool driven = false;
  for (const Run& test : c.excitation.tests) {
    driven = driven || std::ranges::any_of(test.drive.levels, [&](double level) {
               return level != c.excitation.tests.front().drive.levels.front();
             });
  }
  if (driven) c.told_by_current = driven_parameters(c.told_model);

  // Without anything hidden: the peak force to which sizes refer, and the law's own derivatives.
  const Forces without = clean_forces(base, c.excitation.tests, rate, c.decimation);
  std::vector<double> peaks;
  for (const auto& force : without) peaks.push_back(peak_of(force));
  c.peaks = peaks;
  Device sized = device;
  sized.force = *std::ranges::max_element(peaks);

  c.physics = base;
  if (!task.effects.empty()) {
    const std::vector<Forces> derivatives = law_derivatives(base, c.excitation.tests, rate, c.decimation, without);
    for (std::size_t k = 0; k < task.effects.size(); ++k) {
      const HiddenEffect& effect = hidden_effect(task.effects[k]);
      const Stream shape = stream.child("shape").child(effect.id);
      Draws size(stream.child("size"), effect.id);
      HiddenTruth truth;
      truth.id = task.effects[k];
      truth.excited = task.level != Level::unexcited;
      const double wanted = draw_share(size, task.level, c.chain.noise);
      Device at = sized;
      if (!truth.excited) at.amplitude *= size.uniform(1.5, 2.0);
      Calibration found{size.log_uniform(0.05, 0.3), 0.0, {}};
      if (truth.excited) {
        found = calibrate(effect, base, at, shape, c, without, wanted);
      } else {
        Physics with = base;
        found.strength = std::clamp(found.strength, effect.least, effect.most);
        effect.put(with, at, found.strength, Draws(shape));
        found.change = difference(clean_forces(with, c.excitation.tests, rate, c.decimation), without);
        found.share = largest_change(found.change) / sized.force;
      }
      truth.share = found.share;
      truth.strength = found.strength;
      Physics alone = base;
      effect.put(alone, at, found.strength, Draws(shape));
      truth.parameters = effect.parameters(alone);
      effect.put(c.physics, at, found.strength, Draws(shape));
      truth.change_nrmse = nrmse(found.change, peaks);
      const Forces left = left_over(found.change, derivatives, peaks, false);
      c.left = c.left.empty() ? left : combined(c.left, 1.0, left);
      truth.left_nrmse = nrmse(left, peaks);
      truth.left_nrmse_single = nrmse(left_over(found.change, derivatives, peaks, true), peaks);
      // Independent samples fewer by (1 + r) / (1 - r) for the coloured part of the noise.
      const double r = c.chain.coloured_share * c.chain.correlation;
      const double sigma = c.chain.noise * sized.force;
      double energy = 0.0;
      for (const auto& recording : left) {
        for (const double value : recording) energy += value * value;
      }
      truth.detectability = energy / (sigma * sigma) * (1.0 - r) / (1.0 + r);
      c.truths.push_back(std::move(truth));
    }
  }

  std::vector<Physics> per_test(c.excitation.tests.size(), c.physics);
  if (c.disturbance == "scatter between recordings") {
    const double scatter = draws.uniform(0.002, 0.008);
    for (Physics& p : per_test) {
      const double yield = 1.0 + scatter * draws.normal();
      const double damping = 1.0 + scatter * draws.normal();
      p.alpha_a *= yield;
      p.alpha_b *= yield;
      p.c_a *= damping;
      p.c_b *= damping;
    }
  }
  std::vector<Track> tracks;
  for (std::size_t r = 0; r < per_test.size(); ++r) {
    tracks.push_back(simulate(per_test[r], c.excitation.tests[r], rate));
    c.range.force = r == 0 ? peak_of(clean_force(per_test[r], tracks[r], c.decimation))
                           : std::max(c.range.force, peak_of(clean_force(per_test[r], tracks[r], c.decimation)));
  }
  c.range.amplitude = device.amplitude + std::abs(device.middle);
  c.range.speed = device.speed;
  c.range.level = device.level;
  for (std::size_t r = 0; r < per_test.size(); ++r) {
    c.recordings.push_back(measure(per_test[r], tracks[r], c.decimation, c.chain, c.range,
                                   stream.child("noise").child(static_cast<std::uint64_t>(r))));
  }
  return c;
}

}  // namespace hysteron::challenge

#include "challenge/concealed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <type_traits>
#include <utility>

#include "challenge/absorption.hpp"
#include "challenge/base.hpp"
#include "core/error.hpp"
#include "core/extent.hpp"

namespace hysteron::challenge {
namespace {

// Grid points a second of the simulation: fine enough for the filter and the delay.
constexpr double finest_grid = 1600.0;

// Of a foreign cause beside effects, over the power of the strongest of them.
constexpr double least_foreign_power = 0.05;
constexpr double most_foreign_power = 2.0;

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
  if (laws.empty()) laws = common_laws(task.effects);
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
  std::vector<double> before;
  for (const Run& test : tests) {
    Track track = simulate(physics, test, rate, before);
    forces.push_back(clean_force(physics, track, decimation));
    before = std::move(track.end);
  }
  return forces;
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

// Finds the strength at which `size` of the change of force is the wanted one: secant steps on logarithms inside the
// effect's range.
struct Calibration {
  double strength;
  double size;
  Forces change;
};
using SizeOf = double (*)(const Forces& change, const std::vector<double>& peaks);

// Root mean square in the recording that changes most, over the campaign's peak.
double share_of_peak(const Forces& change, const std::vector<double>& peaks) {
  return largest_change(change) / *std::ranges::max_element(peaks);
}

class Workshop {
 public:
  Workshop(const Concealed& c, const Physics& base, const Device& device)
      : tests_(c.excitation.tests),
        rate_(c.excitation.sampling_rate * c.decimation),
        decimation_(c.decimation),
        base_(base),
        device_(device),
        without_(clean_forces(base, tests_, rate_, decimation_)) {
    for (const auto& force : without_) peaks_.push_back(peak_of(force));
    // Sizes refer to what the damper does, not to what it was drawn for.
    device_.force = *std::ranges::max_element(peaks_);
  }

  [[nodiscard]] const Device& device() const { return device_; }
  [[nodiscard]] const std::vector<double>& peaks() const { return peaks_; }
  [[nodiscard]] std::vector<Forces> derivatives() const {
    return law_derivatives(base_, tests_, rate_, decimation_, without_);
  }

  // What a form changes at a strength.
  [[nodiscard]] Forces change(const HiddenForm& form, const Device& device, double strength,
                              const Stream& shape) const {
    Physics physics = base_;
    physics.parts = {form.make(device, strength, Draws(shape))};
    // A late velocity channel leaves the force as it is: its size is what a law fed with it makes of it.
    physics.acting_delay = physics.parts.front()->velocity_delay();
    return difference(clean_forces(physics, tests_, rate_, decimation_), without_);
  }

  [[nodiscard]] Calibration calibrate(const FormOf& what, const Stream& shape, double wanted, SizeOf size_of) const {
    const HiddenEffect& effect = *what.effect;
    const auto measured = [&](double strength) {
      Calibration result{strength, 0.0, change(*what.form, device_, strength, shape)};
      result.size = size_of(result.change, peaks_);
      return result;
    };
    const auto inside = [&](double strength) { return std::clamp(strength, effect.least, effect.most); };
    Calibration best = measured(inside(wanted));
    double slope = 1.0;
    for (int k = 0; k < 6 && std::abs(best.size / wanted - 1.0) > 0.03; ++k) {
      if (best.size <= 0.0) {
        // Nothing happens yet: a threshold lies above.
        if (best.strength >= effect.most) break;
        best = measured(inside(3.0 * best.strength));
        continue;
      }
      const double log_step = std::clamp(std::log(wanted / best.size) / slope, -2.0, 2.0);
      const double next = inside(best.strength * std::exp(log_step));
      if (next == best.strength) break;
      Calibration tried = measured(next);
      if (tried.size > 0.0) {
        const double seen = std::log(tried.size / best.size) / std::log(tried.strength / best.strength);
        if (std::isfinite(seen)) slope = std::clamp(seen, 0.2, 5.0);
      }
      if (std::abs(std::log(std::max(tried.size, 1e-12) / wanted)) <= std::abs(std::log(best.size / wanted))) {
        best = std::move(tried);
      } else {
        slope = std::clamp(2.0 * slope, 0.2, 5.0);
      }
    }
    return best;
  }

 private:
  const std::vector<Run>& tests_;
  double rate_;
  int decimation_;
  Physics base_;
  Device device_;
  Forces without_;
  std::vector<double> peaks_;
};

// Energy in noise variances, per independent sample: fewer by (1 + r) / (1 - r) for the coloured part of the noise.
double detectability_of(const Forces& left, const Chain& chain, double peak) {
  const double r = chain.coloured_share * chain.correlation;
  const double sigma = chain.noise * peak;
  double energy = 0.0;
  for (const auto& recording : left) {
    for (const double value : recording) energy += value * value;
  }
  return energy / (sigma * sigma) * (1.0 - r) / (1.0 + r);
}

// Foreign causes end at the bounds of their strength here and there, with less power than was drawn.
bool foreign_in_range(const Concealed& c) {
  if (c.task.level != Level::beside) return true;
  return std::ranges::all_of(c.truths, [](const HiddenTruth& truth) {
    return !hidden_effect(truth.id).foreign || (truth.power_over_strongest > 0.93 * least_foreign_power &&
                                                truth.power_over_strongest < 1.07 * most_foreign_power);
  });
}

// Puts the causes of the task into c.physics and writes down their sizes; returns what each changes. Foreign causes
// beside effects of the catalogue are sized by their power over that of the strongest effect; they come last in a task.
std::vector<Forces> hide_causes(Concealed& c, const Workshop& workshop, const Stream& stream) {
  const Task& task = c.task;
  const bool beside = task.level == Level::beside;
  const std::vector<double>& peaks = workshop.peaks();
  std::vector<Forces> changes;
  double strongest = 0.0;  // change_nrmse of an effect of the catalogue
  double first_share = 0.0;
  for (std::size_t k = 0; k < task.effects.size(); ++k) {
    const FormOf what = hidden_form(task.forms.at(k));
    const HiddenEffect& effect = *what.effect;
    const Stream shape = stream.child("shape").child(effect.id);
    Draws size(stream.child("size"), effect.id);
    HiddenTruth truth;
    truth.id = task.effects[k];
    truth.form = what.form->id;
    if (!what.form->also.empty()) c.acceptable.emplace_back(what.form->also);
    truth.excited = task.level != Level::unexcited;
    double wanted = draw_share(size, task.level, c.chain.noise);
    if (beside && first_share > 0.0) wanted = first_share * size.log_uniform(0.3, 1.0);
    if (first_share == 0.0) first_share = wanted;
    Device at = workshop.device();
    Calibration found{};
    if (!truth.excited) {
      at.amplitude *= size.uniform(1.5, 2.0);
      found.strength = std::clamp(size.log_uniform(0.05, 0.3), effect.least, effect.most);
      found.change = workshop.change(*what.form, at, found.strength, shape);
    } else if (beside && effect.foreign) {
      const double power = size.log_uniform(least_foreign_power, most_foreign_power);
      found = workshop.calibrate(what, shape, strongest * std::sqrt(power), nrmse);
    } else {
      found = workshop.calibrate(what, shape, wanted, share_of_peak);
    }
    const PartPointer part = what.form->make(at, found.strength, Draws(shape));
    c.physics.parts.push_back(part);
    truth.strength = found.strength;
    truth.parameters = part->parameters();
    truth.share = share_of_peak(found.change, peaks);
    truth.change_nrmse = nrmse(found.change, peaks);
    if (!effect.foreign) strongest = std::max(strongest, truth.change_nrmse);
    c.truths.push_back(std::move(truth));
    changes.push_back(std::move(found.change));
  }
  for (HiddenTruth& truth : c.truths) {
    if (strongest > 0.0) truth.power_over_strongest = std::pow(truth.change_nrmse / strongest, 2.0);
  }
  return changes;
}

// How far a re-fit of the law would take the causes up.
void find_what_is_left(Concealed& c, const Workshop& workshop, const std::vector<Forces>& changes) {
  if (changes.empty()) return;
  const std::vector<Forces> derivatives = workshop.derivatives();
  const std::vector<double>& peaks = workshop.peaks();
  for (std::size_t k = 0; k < changes.size(); ++k) {
    HiddenTruth& truth = c.truths[k];
    const Forces left = left_over(changes[k], derivatives, peaks, false);
    c.left = c.left.empty() ? left : combined(c.left, 1.0, left);
    truth.left_nrmse = nrmse(left, peaks);
    truth.left_nrmse_single = nrmse(left_over(changes[k], derivatives, peaks, true), peaks);
    truth.detectability = detectability_of(left, c.chain, workshop.device().force);
  }
}

// Forms that a task leaves open are drawn.
Task with_forms(const Task& task, const Stream& stream) {
  if (task.forms.size() == task.effects.size()) return task;
  Task result = task;
  result.forms.clear();
  std::vector<InSeries> chain;
  for (const std::string& id : task.effects) {
    const HiddenEffect& effect = hidden_effect(id);
    Draws draws(stream.child("form"), id);
    const auto first = static_cast<std::size_t>(draws.integer(0, static_cast<int>(effect.forms.size()) - 1));
    for (std::size_t k = 0; k < effect.forms.size(); ++k) {
      const HiddenForm& form = effect.forms[(first + k) % effect.forms.size()];
      chain.push_back(form.chain);
      if (can_stand_in_series(chain)) {
        result.forms.push_back(form.id);
        break;
      }
      chain.pop_back();
    }
  }
  if (result.forms.size() != task.effects.size()) throw InputError("these effects cannot stand in series");
  return result;
}

// Half of the campaigns say when their tests were made: the damper then goes on from one to the next, its heat and its
// wear with it. Starts are whole seconds.
void draw_pauses(Excitation& excitation, Draws draws) {
  if (!draws.chance(0.5)) return;
  double start = 0.0;
  excitation.tests.front().started = start;
  for (std::size_t r = 1; r < excitation.tests.size(); ++r) {
    const double end = start + excitation.tests[r - 1].duration;
    start = std::ceil(end + draws.log_uniform(20.0, 1500.0));
    excitation.tests[r].pause = start - end;
    excitation.tests[r].started = start;
  }
}

// None where `strict` and a foreign cause cannot have its power.
std::optional<Concealed> attempt(const Task& asked, const Stream& stream, bool strict) {
  Draws draws(stream, "campaign");
  Concealed c;
  c.task = with_forms(asked, stream);
  c.name = fmt::format("campaign-{:04d}", c.task.number);
  const Task& task = c.task;

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
  needs.stops = task.stops;
  c.excitation = draw_excitation(stream, c.design, needs, device.amplitude, device.level);
  draw_pauses(c.excitation, Draws(stream, "clock"));
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

  c.physics = draw_law(stream, law, device);
  c.told_model = model_of(law);
  if (task.level == Level::wrong_base || (task.level == Level::beside && draws.chance(0.5))) {
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

  const Workshop workshop(c, c.physics, device);
  c.peaks = workshop.peaks();
  const std::vector<Forces> changes = hide_causes(c, workshop, stream);
  if (strict && !foreign_in_range(c)) return std::nullopt;
  find_what_is_left(c, workshop, changes);

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
  c.range.force = 0.0;
  for (std::size_t r = 0; r < per_test.size(); ++r) {
    const std::vector<double> before = r > 0 ? tracks.back().end : std::vector<double>{};
    tracks.push_back(simulate(per_test[r], c.excitation.tests[r], rate, before));
    c.range.force = std::max(c.range.force, peak_of(clean_force(per_test[r], tracks[r], c.decimation)));
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

// Not a damper that a test rig would be stopped for: a force that is no number or many times that of the damper as
// drawn, or a cause that should be excited and changes next to nothing.
bool runs(const Concealed& c) {
  const double peak = *std::ranges::max_element(c.peaks);
  if (!(c.range.force < 6.0 * peak)) return false;
  for (const Measured& recording : c.recordings) {
    if (!std::ranges::all_of(recording.force, [](double f) { return std::isfinite(f); })) return false;
  }
  return std::ranges::all_of(c.truths, [](const HiddenTruth& truth) { return !truth.excited || truth.share > 1e-4; });
}

// Whether the drive has different levels, beside its noise: from recording to recording, or within one.
bool several_levels(const std::vector<Measured>& recordings) {
  constexpr double least = 0.05;   // of the largest level
  constexpr double within = 0.25;  // of it, between the tenths at both ends of a recording
  std::vector<double> levels;
  double widest = 0.0;
  double largest = 0.0;
  for (const Measured& recording : recordings) {
    if (recording.drive.empty()) return false;
    std::vector<double> sorted = recording.drive;
    std::ranges::sort(sorted);
    const std::size_t tenth = sorted.size() / 10;
    levels.push_back(sorted[sorted.size() / 2]);
    widest = std::max(widest, sorted[sorted.size() - 1 - tenth] - sorted[tenth]);
    largest = std::max({largest, std::abs(sorted[tenth]), std::abs(sorted[sorted.size() - 1 - tenth])});
  }
  const auto [low, high] = std::ranges::minmax(levels);
  return high - low > least * largest || widest > within * largest;
}

// Leaves one to `most` of the recordings, as a user has them who made no more: without roles, and told no law in a
// drive that does not change. The truths keep the sizes that they have in all.
void keep_few(Concealed& c, int most, const Stream& stream) {
  Draws draws(stream, "few");
  const std::size_t all = c.recordings.size();
  const auto count = std::min(all, static_cast<std::size_t>(draws.integer(1, most)));
  std::vector<std::size_t> kept(all);
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  for (std::size_t k = 0; k < count; ++k) {
    std::swap(kept[k], kept[static_cast<std::size_t>(draws.integer(static_cast<int>(k), static_cast<int>(all) - 1))]);
  }
  kept.resize(count);
  std::ranges::sort(kept);
  const auto cut = [&](auto& rows) {
    std::remove_reference_t<decltype(rows)> some;
    for (const std::size_t k : kept) some.push_back(rows[k]);
    rows = std::move(some);
  };
  cut(c.recordings);
  cut(c.excitation.tests);
  cut(c.peaks);
  if (!c.left.empty()) cut(c.left);
  c.roles_given = false;
  if (!several_levels(c.recordings)) c.told_by_current.clear();
}

}  // namespace

Concealed make_concealed(const Task& task, std::uint64_t seed) {
  const Stream stream = Stream(seed).child("campaign").child(static_cast<std::uint64_t>(task.number));
  constexpr std::uint64_t attempts = 8;
  for (const bool strict : {true, false}) {
    for (std::uint64_t k = 0; k < attempts; ++k) {
      try {
        std::optional<Concealed> c = attempt(task, stream.child(k), strict);
        if (!c || !runs(*c)) continue;
        if (task.most_recordings > 0) keep_few(*c, task.most_recordings, stream);
        return *std::move(c);
      } catch (const TooStiff&) {  // another draw
      }
    }
  }
  throw WorkError(fmt::format("campaign {}: no damper with these causes runs", task.number));
}

}  // namespace hysteron::challenge

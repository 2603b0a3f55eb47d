// Signature contrasts: what was put into the force comes out with its size; noise and the nearest confounder do not.
#include "diagnose/residual/contrast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>

#include "core/drive.hpp"
#include "core/earlier_work.hpp"
#include "core/random.hpp"
#include "diagnose/residual/contrast_parts.hpp"
#include "diagnose/search/relatives.hpp"
#include "simulate/knowledge.hpp"
#include "simulate/part.hpp"

namespace hysteron {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// A sine that fades in over half a cycle.
struct Sine {
  double amplitude;
  double frequency;
  double drive = 0.5;
};
const std::vector<Sine> usual = {{0.015, 0.5, 0.0}, {0.015, 0.5, 1.0}, {0.008, 1.5, 0.0}, {0.008, 1.5, 0.5},
                                 {0.008, 1.5, 1.0}, {0.003, 4.0, 0.0}, {0.003, 4.0, 0.5}, {0.003, 4.0, 1.0}};

Recording sine(const Sine& of, double rate = 500.0, double seconds = 8.0) {
  Recording result;
  const double w = two_pi * of.frequency;
  for (std::size_t n = 0; n < static_cast<std::size_t>(seconds * rate); ++n) {
    const double t = static_cast<double>(n) / rate;
    const double s = std::min(2.0 * t * of.frequency, 1.0);
    const double rise = 2.0 * of.frequency;
    const double window = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    const double slope = 30.0 * s * s * (1.0 - s) * (1.0 - s) * rise;
    const double curve = 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) * rise * rise;
    const double sn = of.amplitude * std::sin(w * t);
    const double cs = of.amplitude * std::cos(w * t);
    result.time.push_back(t);
    result.displacement.push_back(window * sn);
    result.velocity.push_back(window * w * cs + slope * sn);
    result.derived_acceleration.push_back(-window * w * w * sn + 2.0 * slope * w * cs + curve * sn);
  }
  result.drive.assign(result.size(), of.drive);
  result.drive_kind = DriveKind::current;
  return result;
}

// Force of a damper that follows this motion: yield force 200 N + 500 N/A over a yield travel of 0.6 mm, damping,
// spring.
std::vector<double> base_force(const Recording& recording, const std::vector<double>& drive) {
  std::vector<double> result;
  double z = 0.0;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double step = n > 0 ? recording.displacement[n] - recording.displacement[n - 1] : 0.0;
    const double sign = step < 0.0 ? -1.0 : 1.0;
    z = sign + (z - sign) * std::exp(-std::fabs(step) / 6e-4);
    result.push_back((200.0 + 500.0 * drive[n]) * z + 600.0 * recording.velocity[n] +
                     1000.0 * recording.displacement[n]);
  }
  return result;
}

struct Scene {
  std::vector<Recording> recordings;
  std::vector<Residual> residuals;
  [[nodiscard]] std::vector<Contrast> found() const { return contrasts(recordings, residuals); }
};

// Noise of this share of the largest simulated force, and its correlation from sample to sample.
struct Noise {
  double size = 0.003;
  double correlation = 0.0;
  std::uint64_t seed = 1;
};

void add(Scene& scene, Recording recording, const std::vector<double>& simulated, const std::vector<double>& missing,
         const Noise& noise) {
  const Stream stream = Stream(noise.seed).child("noise").child(scene.recordings.size());
  double peak = 0.0;
  for (const double force : simulated) {
    peak = std::max(peak, std::fabs(force));
  }
  const double fresh = std::sqrt(1.0 - noise.correlation * noise.correlation);
  double level = stream.normal(0, 1);
  Residual residual;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    level = noise.correlation * level + fresh * stream.normal(n);
    recording.force.push_back(simulated[n] + missing[n] + noise.size * peak * level);
    residual.force.push_back(simulated[n] - recording.force[n]);
  }
  scene.recordings.push_back(std::move(recording));
  scene.residuals.push_back(std::move(residual));
}

using Missing = std::function<double(const Recording& recording, const std::vector<double>& force, std::size_t n)>;

Scene scene_of(const Missing& missing, const std::vector<Sine>& sines = usual, const Noise& noise = {},
               double rate = 500.0) {
  Scene result;
  for (const Sine& one : sines) {
    const Recording recording = sine(one, rate);
    const std::vector<double> force = base_force(recording, recording.drive);
    std::vector<double> extra;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      extra.push_back(missing(recording, force, n));
    }
    add(result, recording, force, extra, noise);
  }
  return result;
}

const Contrast* find(const std::vector<Contrast>& found, ContrastKind kind) {
  const auto at = std::ranges::find(found, kind, &Contrast::kind);
  return at == found.end() ? nullptr : &*at;
}

// It has the value within four standard errors and `share` of it, and no placebo but a few in a hundred is as large.
void expect_value(const std::vector<Contrast>& found, ContrastKind kind, double value, double share) {
  const Contrast* one = find(found, kind);
  ASSERT_NE(one, nullptr) << card_of(kind).id;
  EXPECT_NEAR(one->value, value, share * std::fabs(value)) << card_of(kind).id;
  EXPECT_GT(std::fabs(one->z), 3.0) << card_of(kind).id;
  EXPECT_GE(one->consistency, 0.75) << card_of(kind).id;
  EXPECT_GT(one->placebo_quantile, 0.97) << card_of(kind).id;
}

TEST(Contrast, MassIsTheForcePerAcceleration) {
  expect_value(
      scene_of([](const Recording& r, const auto&, std::size_t n) { return 7.0 * r.derived_acceleration[n]; }).found(),
      ContrastKind::acceleration, 7.0, 0.05);
}

TEST(Contrast, OneFrequencySaysNothingOfAMass) {
  const Scene one = scene_of([](const Recording& r, const auto&, std::size_t n) { return -300.0 * r.displacement[n]; },
                             {{0.01, 1.0, 0.0}, {0.01, 1.0, 0.5}, {0.01, 1.0, 1.0}});
  const std::vector<Contrast> found = one.found();
  const Contrast* mass = find(found, ContrastKind::acceleration);
  EXPECT_TRUE(mass == nullptr || std::fabs(mass->z) < 3.0);
}

TEST(Contrast, DampingAndSpringsHaveTheirOwnValues) {
  using Kind = ContrastKind;
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) {
                 return 4e7 * std::pow(r.displacement[n], 3.0);
               }).found(),
               Kind::stiffness_cubic, 4e7, 0.05);
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) {
                 return 2e5 * std::pow(r.displacement[n], 2.0);
               }).found(),
               Kind::stiffness_bend, 2e5, 0.05);
  for (const double d2 : {3e3, -3e3}) {
    expect_value(scene_of([d2](const Recording& r, const auto&, std::size_t n) {
                   return d2 * r.velocity[n] * std::fabs(r.velocity[n]);
                 }).found(),
                 Kind::speed_bend, d2, 0.05);
  }
  expect_value(scene_of([](const Recording&, const auto&, std::size_t) { return 20.0; }).found(), Kind::mean_force,
               20.0, 0.05);
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) { return 4e3 * r.displacement[n]; }).found(),
               Kind::stiffness, 4e3, 0.05);
}

TEST(Contrast, FrictionHasTheSignOfTheVelocityAndFallsAtSpeed) {
  const double fastest = 0.003 * two_pi * 4.0;
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) {
                 return 40.0 * std::tanh(r.velocity[n] / 1e-3);
               }).found(),
               ContrastKind::dry_friction, 40.0, 0.15);
  const auto found = scene_of([&](const Recording& r, const auto&, std::size_t n) {
                       const double relative = r.velocity[n] / (0.1 * fastest);
                       return 60.0 * std::tanh(r.velocity[n] / 1e-3) * std::exp(-relative * relative);
                     }).found();
  const Contrast* low = find(found, ContrastKind::low_speed);
  ASSERT_NE(low, nullptr);
  EXPECT_GT(low->z, 3.0);
  EXPECT_GT(low->value, 30.0);
}

TEST(Contrast, DirectionsAndEndsOfTheStrokeHaveTheirOwnValues) {
  expect_value(scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                 return 0.06 * f[n] * std::tanh(r.velocity[n] / 1e-3);
               }).found(),
               ContrastKind::direction, 0.06, 0.05);
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) {
                 return 5e4 * std::max(r.displacement[n] - 0.01125, 0.0);
               }).found(),
               ContrastKind::stroke_end, 5e4, 0.25);
  expect_value(scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                 return -0.15 * f[n] * std::exp(-std::pow(r.displacement[n] / (0.35 * 0.015), 2.0));
               }).found(),
               ContrastKind::middle_loss, 0.15, 0.1);
  expect_value(scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                 return -0.1 * f[n] * std::tanh(r.displacement[n] / (0.2 * 0.015));
               }).found(),
               ContrastKind::side_loss, 0.1, 0.1);
}

// A bore that is wide beyond a place is one thing, a lever whose arm changes with the place another.
TEST(Contrast, AGainThatChangesEvenlyWithThePlaceIsNoLossOnOneSide) {
  const auto found = scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                       return -0.1 * f[n] * r.displacement[n] / 0.015;
                     }).found();
  const Contrast* side = find(found, ContrastKind::side_loss);
  EXPECT_TRUE(side == nullptr || std::fabs(side->z) < 2.0);
}

TEST(Contrast, ABoreThatIsWiderAtBothEndsAlikeIsNoLossOnOneSide) {
  const auto found = scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                       const double place = r.displacement[n] / 0.015;
                       return -0.3 * f[n] * place * place;
                     }).found();
  const Contrast* side = find(found, ContrastKind::side_loss);
  EXPECT_TRUE(side == nullptr || std::fabs(side->z) < 2.0);
}

// A force of the place alone, whatever its shape, takes nothing off a force.
TEST(Contrast, AStepOfTheForceAtAPlaceIsNoLossOnOneSide) {
  const auto found = scene_of([](const Recording& r, const auto&, std::size_t n) {
                       return 60.0 * std::tanh(r.displacement[n] / (0.2 * 0.015));
                     }).found();
  const Contrast* side = find(found, ContrastKind::side_loss);
  EXPECT_TRUE(side == nullptr || std::fabs(side->z) < 2.0);
}

// A dashpot on a spring with free travel, for which the model has a linear spring.
TEST(Contrast, ASpringThatIsWeakInTheMiddleIsNoLossOfForceThere) {
  Scene scene;
  for (const Sine& one : usual) {
    const Recording recording = sine(one);
    std::vector<double> simulated;
    std::vector<double> missing;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double x = recording.displacement[n];
      const double spring = 6e4 * std::copysign(std::max(std::fabs(x) - 0.003, 0.0), x);
      simulated.push_back(4e4 * x + 200.0 * recording.velocity[n]);
      missing.push_back(spring - 4e4 * x);
    }
    add(scene, recording, simulated, missing, {});
  }
  const std::vector<Contrast> found = scene.found();
  const Contrast* middle = find(found, ContrastKind::middle_loss);  // absent where the place tells all of it
  EXPECT_TRUE(middle == nullptr || std::fabs(middle->z) < 2.0);
}

TEST(Contrast, ADelayIsMeasuredInSecondsAndIsNoPlay) {
  for (const double delay : {5e-3, -2e-3}) {
    Scene scene;
    for (const Sine& one : usual) {
      const Recording recording = sine(one, 1000.0);
      const std::vector<double> force = base_force(recording, recording.drive);
      std::vector<double> extra;
      for (std::size_t n = 0; n < recording.size(); ++n) {
        const auto from = static_cast<std::size_t>(std::max(0L, static_cast<long>(n) - std::lround(1000.0 * delay)));
        extra.push_back(force[std::min(from, force.size() - 1)] - force[n]);
      }
      add(scene, recording, force, extra, {});
    }
    const std::vector<Contrast> found = scene.found();
    expect_value(found, ContrastKind::force_delay, delay, 0.15);
    const Contrast* travel = find(found, ContrastKind::reversal_travel);
    ASSERT_NE(travel, nullptr);
    EXPECT_LT(std::fabs(travel->value), 3e-5);
  }
}

// Force of the damper of base_force without damping and spring behind a play that begins closed: the damper follows
// while the contact bears, and rests where its force is zero while the gap is crossed.
std::vector<double> force_behind_play(const Recording& recording, double gap) {
  constexpr int parts = 40;
  std::vector<double> result;
  double z = 0.0;
  double in_gap = -0.5 * gap;  // of -gap/2 .. gap/2: open in between
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double step = n > 0 ? (recording.displacement[n] - recording.displacement[n - 1]) / parts : 0.0;
    for (int k = 0; k < parts; ++k) {
      const double sign = step < 0.0 ? -1.0 : 1.0;
      const double next = sign + (z - sign) * std::exp(-std::fabs(step) / 6e-4);
      const bool bears =
          (in_gap >= 0.5 * gap && (sign > 0.0 || next >= 0.0)) || (in_gap <= -0.5 * gap && (sign < 0.0 || next <= 0.0));
      if (bears) {
        z = next;
      } else {
        in_gap = std::clamp(in_gap + step, -0.5 * gap, 0.5 * gap);
      }
    }
    result.push_back((200.0 + 500.0 * recording.drive[n]) * z);
  }
  return result;
}

TEST(Contrast, APlayIsItsTravelAtEverySpeedForceAndRateOfSampling) {
  constexpr double gap = 4e-4;
  for (const double rate : {500.0, 2000.0}) {
    Scene scene;
    for (const Sine& one : usual) {
      const Recording recording = sine(one, rate);
      const std::vector<double> simulated = force_behind_play(recording, 0.0);
      std::vector<double> extra = force_behind_play(recording, gap);
      std::ranges::transform(extra, simulated, extra.begin(), std::minus<>());
      add(scene, recording, simulated, extra, {});
    }
    const std::vector<Contrast> found = scene.found();
    expect_value(found, ContrastKind::reversal_travel, gap, 0.05);
    const Contrast* travel = find(found, ContrastKind::reversal_travel);
    EXPECT_EQ(travel->recordings, usual.size());
    for (const ContrastOfRecording& one : travel->of_recordings) {
      EXPECT_NEAR(one.value, gap, 0.1 * gap) << scene.recordings[one.recording].time[1];
    }
  }
}

// An elastic element in series loses travel too, but as the force grows.
TEST(Contrast, ASeriesSpringIsNoPlay) {
  Scene scene;
  for (const Sine& one : usual) {
    const Recording recording = sine(one);
    const auto force_with = [&](double compliance) {
      std::vector<double> result;
      double force = 0.0;
      const double yield = 200.0 + 500.0 * one.drive;
      for (std::size_t n = 0; n < recording.size(); ++n) {
        const double step = n > 0 ? recording.displacement[n] - recording.displacement[n - 1] : 0.0;
        for (int k = 0; k < 20; ++k) {
          const double sign = step < 0.0 ? -1.0 : 1.0;
          const double slope = (yield - sign * force) / 6e-4;
          force += slope / (1.0 + compliance * slope) * step / 20.0;
        }
        result.push_back(force);
      }
      return result;
    };
    const std::vector<double> simulated = force_with(0.0);
    std::vector<double> extra = force_with(1.5e-7);
    std::ranges::transform(extra, simulated, extra.begin(), std::minus<>());
    add(scene, recording, simulated, extra, {});
  }
  const std::vector<Contrast> found = scene.found();
  const Contrast* soft = find(found, ContrastKind::force_travel);
  ASSERT_NE(soft, nullptr);
  EXPECT_GT(soft->z, 3.0);
  EXPECT_NEAR(soft->value, 1.5e-7, 0.5 * 1.5e-7);
  const Contrast* travel = find(found, ContrastKind::reversal_travel);
  ASSERT_NE(travel, nullptr);
  EXPECT_LT(std::fabs(travel->value), 2e-5);
}

// Motions that stop at 2 s and rest; the measured force loses `lost` of its peak within the time constant `tau`.
Scene stopped(double lost, double tau, double rate) {
  Scene scene;
  for (const Sine& one : usual) {
    for (const double side : {1.0, -1.0}) {
      Recording recording = sine(one, rate, 4.0);
      std::size_t stop = recording.size() / 2;
      while (side * recording.velocity[stop] < 0.9 * one.amplitude * two_pi * one.frequency) {
        ++stop;
      }
      for (std::size_t n = stop; n < recording.size(); ++n) {
        recording.displacement[n] = recording.displacement[stop];
        recording.velocity[n] = 0.0;
        recording.derived_acceleration[n] = 0.0;
      }
      const std::vector<double> force = base_force(recording, recording.drive);
      double peak = 0.0;
      for (const double value : force) {
        peak = std::max(peak, std::fabs(value));
      }
      std::vector<double> extra(force.size(), 0.0);
      for (std::size_t n = stop; n < recording.size(); ++n) {
        const double since = recording.time[n] - recording.time[stop];
        extra[n] = -side * lost * peak * (1.0 - std::exp(-since / tau));
      }
      add(scene, recording, force, extra, {});
    }
  }
  return scene;
}

TEST(Contrast, RelaxationAtRestIsTheShareOfTheForceThatIsLost) {
  constexpr double tau = 0.05;
  constexpr double lost = 0.3;
  // Means of exp(-t / tau) over 5 to 20 ms and over 80 to 200 ms after the stop, which is one sample late.
  const auto mean = [&](double from, double to) {
    return tau * (std::exp(-from / tau) - std::exp(-to / tau)) / (to - from);
  };
  expect_value(stopped(lost, tau, 500.0).found(), ContrastKind::rest_relaxation,
               lost * (mean(0.005, 0.02) - mean(0.08, 0.2)), 0.1);
}

// Of a force that holds still and is sampled every 40 ms, nothing is known of its first 20 ms: no value is a value.
TEST(Contrast, RelaxationAtRestHasNoValueWhereItsFirstForceWasNotSampled) {
  const std::vector<Contrast> found = stopped(0.0, 0.05, 25.0).found();
  EXPECT_EQ(find(found, ContrastKind::rest_relaxation), nullptr);
}

TEST(Contrast, WhatFadesInTheCourseOfARecordingHasItsOwnValue) {
  const auto work_at = [](const Recording& r, const std::vector<double>& f, std::size_t n) {
    static const Recording* last = nullptr;
    static double work = 0.0;
    if (n == 0 || last != &r) {
      work = 0.0;
      last = &r;
    } else {
      work += 0.5 * (f[n] * r.velocity[n] + f[n - 1] * r.velocity[n - 1]) * (r.time[n] - r.time[n - 1]);
    }
    return work;
  };
  expect_value(scene_of([&](const Recording& r, const std::vector<double>& f, std::size_t n) {
                 return -5e-4 * work_at(r, f, n) * f[n];
               }).found(),
               ContrastKind::energy_fade, 5e-4, 0.15);
  expect_value(scene_of([](const Recording& r, const auto&, std::size_t n) { return 4.0 * r.time[n]; }).found(),
               ContrastKind::drift, 4.0, 0.05);
}

// Tests in an order that no circumstance has, with what their files tell of the work before.
Scene started(const Noise& noise = {}) {
  Scene scene = scene_of([](const Recording&, const auto&, std::size_t) { return 0.0; }, usual, noise);
  constexpr std::array<double, 8> starts = {2100.0, 900.0, 3300.0, 0.0, 2700.0, 1500.0, 300.0, 4000.0};
  for (std::size_t k = 0; k < starts.size(); ++k) {
    scene.recordings[k].started = starts[k];
  }
  EXPECT_FALSE(carry_work(scene.recordings).has_value());
  return scene;
}

// The force of each recording times a factor of its own.
void scale(Scene& scene, const std::function<double(const Recording& recording, std::size_t k)>& factor) {
  for (std::size_t k = 0; k < scene.recordings.size(); ++k) {
    Recording& recording = scene.recordings[k];
    const double by = factor(recording, k) - 1.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double more = by * recording.force[n];
      recording.force[n] += more;
      scene.residuals[k].force[n] -= more;
    }
  }
}

TEST(Contrast, WhatEarlierRecordingsDidHasItsOwnValue) {
  Scene scene = started();
  scale(scene, [](const Recording& recording, std::size_t) { return 1.0 - 5e-4 * left_of(recording.earlier, 0.0); });
  expect_value(scene.found(), ContrastKind::carried_fade, 5e-4, 0.05);
  Scene silent = started();
  for (Recording& recording : silent.recordings) recording.earlier.clear();
  EXPECT_EQ(find(silent.found(), ContrastKind::carried_fade), nullptr) << "no starts, no contrast";
}

TEST(Contrast, RecordingsOfSizesByChanceAreNoWear) {
  int loud = 0;
  int beyond = 0;
  constexpr int draws = 400;
  for (int draw = 0; draw < draws; ++draw) {
    Scene scene = started();
    const Stream stream = Stream(static_cast<std::uint64_t>(draw)).child("sizes");
    scale(scene, [&](const Recording&, std::size_t k) { return 1.0 + 0.01 * stream.normal(k); });
    std::vector<Contrast> found;
    contrast::add_carried_contrast(contrast::tracks_of(scene.recordings, scene.residuals), contrast::all_placebos,
                                   found);
    ASSERT_EQ(found.size(), 1U);
    loud += std::fabs(found[0].z) > 2.58 ? 1 : 0;
    beyond += found[0].placebo_quantile >= 0.95 ? 1 : 0;
  }
  // 1 % and 5 % of 400, and three standard errors of these counts.
  EXPECT_LE(loud, 10);
  EXPECT_LE(beyond, 33);
  EXPECT_GE(beyond, 7) << "placebos are no harder than chance";
}

// Recordings with a step of the drive every 0.31 s, the force's drive being another than the recorded one.
Scene with_steps(const std::function<std::vector<double>(const Recording&)>& seen) {
  Scene result;
  for (const Sine& one : usual) {
    Recording recording = sine(one);
    constexpr std::array<double, 7> levels = {0.0, 1.0, 0.4, 0.8, 0.2, 0.6, 0.1};
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.drive[n] = levels[static_cast<std::size_t>(recording.time[n] / 0.31) % levels.size()];
    }
    const std::vector<double> force = base_force(recording, recording.drive);
    std::vector<double> extra = base_force(recording, seen(recording));
    std::ranges::transform(extra, force, extra.begin(), std::minus<>());
    add(result, recording, force, extra, {});
  }
  return result;
}

TEST(Contrast, TheDriveIsSeenLaterOrRemembered) {
  const std::vector<Contrast> late =
      with_steps([](const Recording& r) {
        std::vector<double> current = r.drive;
        for (std::size_t n = 1; n < current.size(); ++n) {
          current[n] = r.drive[n] + (current[n - 1] - r.drive[n]) * std::exp(-(r.time[n] - r.time[n - 1]) / 0.015);
        }
        return current;
      }).found();
  expect_value(late, ContrastKind::drive_lag, 0.015, 0.1);
  const std::vector<Contrast> remembered = with_steps([](const Recording& r) {
                                             std::vector<double> field = r.drive;
                                             double memory = r.drive.front();
                                             for (double& value : field) {
                                               memory = std::clamp(memory, value - 0.25, value + 0.25);
                                               value += 0.3 * (memory - value);
                                             }
                                             return field;
                                           }).found();
  expect_value(remembered, ContrastKind::drive_memory, 0.3, 0.2);
  const Contrast* lag = find(remembered, ContrastKind::drive_lag);
  EXPECT_TRUE(lag == nullptr || std::fabs(lag->value) < 2e-3);
}

// The clamp of the current drifts while the current stays: it goes up and never comes down, so that nothing tells what
// would remain then.
TEST(Contrast, AClampThatDriftsRemembersNothing) {
  Scene scene;
  double level = 0.0;
  for (const Sine& one : usual) {
    Recording recording = sine(one);
    level = level < 0.9 ? level + 0.5 : 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.drive[n] = level + 0.02 * recording.time[n];
    }
    const std::vector<double> force = base_force(recording, recording.drive);
    std::vector<double> extra = base_force(recording, std::vector<double>(recording.size(), level));
    std::ranges::transform(extra, force, extra.begin(), std::minus<>());
    add(scene, recording, force, extra, {});
  }
  ASSERT_TRUE(varies(scene.recordings.front().drive));
  EXPECT_EQ(find(scene.found(), ContrastKind::drive_memory), nullptr);
}

TEST(Contrast, ADelayOfTheForceIsNoLagOfTheDrive) {
  Scene scene = with_steps([](const Recording& r) { return r.drive; });
  for (std::size_t k = 0; k < scene.recordings.size(); ++k) {
    Recording& recording = scene.recordings[k];
    const std::vector<double> force = recording.force;
    for (std::size_t n = 0; n < force.size(); ++n) {
      recording.force[n] = force[n < 2 ? 0 : n - 2];
      scene.residuals[k].force[n] += force[n] - recording.force[n];
    }
  }
  const std::vector<Contrast> found = scene.found();
  // Two samples late: at a step the slope of the force is that of two samples as well, one of them before it.
  expect_value(found, ContrastKind::force_delay, 4e-3, 0.3);
  const Contrast* lag = find(found, ContrastKind::drive_lag);
  EXPECT_TRUE(lag == nullptr || std::fabs(lag->value) < 1e-3);
}

TEST(Contrast, TheForceBendsOverTheDrive) {
  const std::vector<Contrast> found = scene_of([](const Recording& r, const std::vector<double>& f, std::size_t n) {
                                        const double drive = r.drive[n] - 0.5;
                                        return -0.2 * f[n] * drive * drive;
                                      }).found();
  const Contrast* bend = find(found, ContrastKind::drive_bend);
  ASSERT_NE(bend, nullptr);
  EXPECT_LT(bend->value, 0.0);
  EXPECT_LT(bend->z, -3.0);
  // Over the levels of all recordings, of which each has one; of everything else a recording has a value of its own.
  for (const Contrast& one : found) {
    EXPECT_EQ(one.of_all, &one == bend) << one.what;
  }
}

TEST(Contrast, AVelocityThatComesLateIsSeenWithoutAModel) {
  Scene scene = scene_of([](const Recording&, const auto&, std::size_t) { return 0.0; });
  for (Recording& recording : scene.recordings) {
    recording.velocity_measured = true;
    std::vector<double> late = recording.velocity;
    for (std::size_t n = 0; n < late.size(); ++n) {
      late[n] = recording.velocity[n] - 3e-3 * recording.derived_acceleration[n];
    }
    recording.velocity = late;
  }
  const std::vector<Contrast> found = scene.found();
  const Contrast* lag = find(found, ContrastKind::velocity_delay);
  ASSERT_NE(lag, nullptr);
  EXPECT_NEAR(lag->value, 3e-3, 1e-4);
}

// Shares of contrasts that speak though nothing is missing: 1 % of a standard normal is beyond 2.58. Placebos are
// narrower than the null by what the columns of the regression take off the noise, so that up to 6 % are beyond 97.5 %.
TEST(Contrast, NoiseOfAnyColourSpeaksNoMoreOftenThanStated) {
  for (const double correlation : {0.0, 0.6, 0.95}) {
    double total = 0.0;
    double large = 0.0;
    double beyond = 0.0;
    double both = 0.0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      const auto nothing = [](const Recording&, const auto&, std::size_t) { return 0.0; };
      for (const Contrast& one : scene_of(nothing, usual, {0.01, correlation, seed}, 100.0).found()) {
        total += 1.0;
        large += std::fabs(one.z) > 2.58 ? 1.0 : 0.0;
        beyond += one.placebo_quantile > 0.975 ? 1.0 : 0.0;
        both += std::fabs(one.z) > 2.58 && one.placebo_quantile > 0.975 ? 1.0 : 0.0;
      }
    }
    ASSERT_GT(total, 450.0);
    EXPECT_LT(large / total, 0.01) << correlation;
    EXPECT_LT(beyond / total, 0.06) << correlation;
    EXPECT_LT(both / total, 0.01) << correlation;
  }
}

TEST(Contrast, EveryNumberIsFiniteWhateverComesIn) {
  const auto check = [](const Scene& scene) {
    for (const Contrast& one : scene.found()) {
      EXPECT_TRUE(std::isfinite(one.value) && std::isfinite(one.std_error) && std::isfinite(one.z) &&
                  std::isfinite(one.consistency) && std::isfinite(one.placebo_quantile))
          << card_of(one.kind).id;
    }
  };
  check({});
  const auto nothing = [](const Recording&, const auto&, std::size_t) { return 0.0; };
  check(scene_of(nothing, usual, {0.0, 0.0, 1}));
  Scene still = scene_of(nothing, {{0.0, 1.0, 0.0}});
  check(still);
  EXPECT_TRUE(still.found().empty());
  Scene broken = scene_of(nothing);
  broken.residuals[0].force[100] = std::numeric_limits<double>::quiet_NaN();
  broken.residuals[1].force.resize(10);
  broken.residuals[2].from = broken.recordings[2].size();
  broken.recordings[3].drive.clear();
  check(broken);
  Scene one = scene_of(nothing, {usual[0]});
  check(one);
  one.residuals[0].from = one.recordings[0].size() - 60;
  check(one);
}

TEST(Contrast, IsTheSameEachTime) {
  const Scene scene = scene_of([](const Recording& r, const auto&, std::size_t n) { return 50.0 * r.velocity[n]; });
  const std::vector<Contrast> first = scene.found();
  const std::vector<Contrast> second = scene.found();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].value, second[k].value);
    EXPECT_EQ(first[k].placebo_quantile, second[k].placebo_quantile);
  }
}

TEST(Contrast, IsTheSameWithoutPlacebos) {
  const Scene scene = scene_of([](const Recording& r, const auto&, std::size_t n) { return 50.0 * r.velocity[n]; });
  const std::vector<Contrast> all = scene.found();
  const std::vector<Contrast> none = contrasts(scene.recordings, scene.residuals, {}, Placebos::none);
  ASSERT_EQ(all.size(), none.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].kind, none[k].kind);
    EXPECT_EQ(all[k].z, none[k].z);
    EXPECT_EQ(none[k].placebos, 0U);
  }
}

TEST(Contrast, EveryEffectOfTheCatalogueHasAContrastThatSpeaksForIt) {
  for (const Part* effect : effect_catalogue()) {
    EXPECT_FALSE(effect->knowledge->contrasts.empty()) << effect->id;
    for (const ContrastSense& told : effect->knowledge->contrasts) {
      const std::vector<Voice> voices = voices_of(told.contrast);
      const auto own = std::ranges::find(voices, effect->id, &Voice::effect);
      ASSERT_NE(own, voices.end()) << effect->id;
      EXPECT_EQ(own->sense, told.sense) << effect->id;
    }
  }
}

TEST(Contrast, EachSpeaksForAnEffect) {
  for (std::size_t k = 0; k < contrast_kinds; ++k) {
    EXPECT_FALSE(voices_of(static_cast<ContrastKind>(k)).empty()) << card_of(static_cast<ContrastKind>(k)).id;
  }
}

}  // namespace
}  // namespace hysteron

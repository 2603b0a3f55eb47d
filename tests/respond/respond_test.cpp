// Responses against closed forms, the order of the integrator, and the interpolations against their theory.
#include "respond/respond.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"

namespace hysteron {
namespace {

using Vector = std::vector<double>;
constexpr double pi = std::numbers::pi;

Vector times(double rate, double duration) {
  Vector result;
  for (int n = 0; n <= static_cast<int>(std::lround(rate * duration)); ++n) {
    result.push_back(n / rate);
  }
  return result;
}
template <class F>
Vector of(const Vector& time, F&& f) {
  Vector result;
  for (const double t : time) {
    result.push_back(f(t));
  }
  return result;
}

// Parameters by name, the others neutral (the cards' initial values).
Oscillator oscillator_of(const std::string& law, const std::vector<std::string>& effects,
                         const std::vector<std::pair<std::string, double>>& values, double mass) {
  Oscillator result;
  result.model = make_model(law, effects);
  Vector p;
  for (const Parameter& card : result.model.parameters()) {
    p.push_back(card.initial);
  }
  const auto names = result.model.parameter_names();
  for (const auto& [name, value] : values) {
    const auto at = std::ranges::find(names, name);
    EXPECT_NE(at, names.end()) << name;
    p[static_cast<std::size_t>(at - names.begin())] = value;
  }
  result.parameters = [p](double, std::span<const double>) { return p; };
  result.mass = mass;
  return result;
}

constexpr double mass = 2.0;
constexpr double k = 800.0;
constexpr double c = 6.0;

TEST(Respond, FreeDecayOfALinearOscillator) {
  // Half of spring and dashpot in the model, half beside it.
  Oscillator oscillator = oscillator_of("viscous", {}, {{"c0", 0.5 * c}, {"k0", 0.5 * k}, {"f0", 0.0}}, mass);
  oscillator.stiffness = 0.5 * k;
  oscillator.damping = 0.5 * c;
  Excitation excitation;
  excitation.time = times(100.0, 3.0);
  RespondOptions options;
  options.tolerance = 1e-10;
  options.displacement = 0.01;
  options.velocity = -0.05;
  const MassMotion response = respond(oscillator, excitation, options);
  const double decay = c / (2.0 * mass);
  const double w = std::sqrt(k / mass - decay * decay);
  for (std::size_t n = 0; n < excitation.time.size(); ++n) {
    const double t = excitation.time[n];
    const double x = std::exp(-decay * t) * (0.01 * std::cos(w * t) + (-0.05 + decay * 0.01) / w * std::sin(w * t));
    ASSERT_NEAR(response.displacement[n], x, 1e-9);
  }
}

// Energy of an undamped Duffing oscillator is kept.
TEST(Respond, ConservesTheEnergyOfASpring) {
  const Oscillator oscillator = oscillator_of("viscous", {"cubic-stiffness"},
                                              {{"c0", 0.0}, {"k0", k}, {"f0", 0.0}, {"cubic-stiffness.k3", 4e6}}, mass);
  Excitation excitation;
  excitation.time = times(100.0, 5.0);
  RespondOptions options;
  options.tolerance = 1e-11;
  options.displacement = 0.02;
  const MassMotion response = respond(oscillator, excitation, options);
  const auto energy = [&](std::size_t n) {
    const double x = response.displacement[n];
    const double v = response.velocity[n];
    return 0.5 * mass * v * v + 0.5 * k * x * x + 1e6 * x * x * x * x;
  };
  for (std::size_t n = 0; n < excitation.time.size(); ++n) {
    ASSERT_NEAR(energy(n) / energy(0), 1.0, 1e-8);
  }
}

// Steady state under a sine, at and off resonance; the sine is one period, repeated.
TEST(Respond, ResonanceOfALinearOscillator) {
  for (const double ratio : {0.5, 1.0, 2.0}) {
    const double w = ratio * std::sqrt(k / mass);
    const double period = 2.0 * pi / w;
    Vector time;
    for (int n = 0; n < 32; ++n) {
      time.push_back(period * n / 32.0);
    }
    const Oscillator oscillator = oscillator_of("viscous", {}, {{"c0", c}, {"k0", k}, {"f0", 0.0}}, mass);
    Excitation excitation;
    for (int turn = 0; turn < 150; ++turn) {
      for (const double t : time) {
        excitation.time.push_back(t + turn * period);
      }
    }
    excitation.force =
        Signal(time, of(time, [&](double t) { return 3.0 * std::cos(w * t); }), Interpolation::band_limited, true);
    const MassMotion response = respond(oscillator, excitation, {.tolerance = 1e-10});
    const std::complex<double> gain = 3.0 / std::complex<double>(k - mass * w * w, c * w);
    for (std::size_t n = excitation.time.size() - 32; n < excitation.time.size(); ++n) {
      const double x = (gain * std::exp(std::complex<double>(0.0, w * excitation.time[n]))).real();
      ASSERT_NEAR(response.displacement[n], x, 1e-7 * std::abs(gain)) << ratio;
    }
  }
}

// Transmissibility: the relative motion of a mass on a shaken base.
TEST(Respond, BaseMotion) {
  const double w = 1.3 * std::sqrt(k / mass);
  const double period = 2.0 * pi / w;
  Vector time;
  for (int n = 0; n < 40; ++n) {
    time.push_back(period * n / 40.0);
  }
  const Oscillator oscillator = oscillator_of("viscous", {}, {{"c0", c}, {"k0", k}, {"f0", 0.0}}, mass);
  Excitation excitation;
  for (int turn = 0; turn < 150; ++turn) {
    for (const double t : time) {
      excitation.time.push_back(t + turn * period);
    }
  }
  excitation.base =
      Signal(time, of(time, [&](double t) { return 0.004 * std::cos(w * t); }), Interpolation::band_limited, true);
  const MassMotion response = respond(oscillator, excitation, {.tolerance = 1e-10});
  const std::complex<double> gain = 0.004 * mass * w * w / std::complex<double>(k - mass * w * w, c * w);
  for (std::size_t n = excitation.time.size() - 40; n < excitation.time.size(); ++n) {
    const double y = (gain * std::exp(std::complex<double>(0.0, w * excitation.time[n]))).real();
    ASSERT_NEAR(response.displacement[n], y, 1e-5 * std::abs(gain));
  }
}

// A mass in the model is a mass beside it.
TEST(Respond, InertiaOfTheModelAddsToTheMass) {
  Excitation excitation;
  excitation.time = times(200.0, 1.0);
  excitation.force = Signal(excitation.time, of(excitation.time, [](double t) { return 20.0 * std::sin(15.0 * t); }),
                            Interpolation::cubic, false);
  const MassMotion apart = respond(oscillator_of("bouc-wen", {"inertia"}, {{"inertia.m", 1.5}}, mass), excitation, {});
  const MassMotion together = respond(oscillator_of("bouc-wen", {}, {}, mass + 1.5), excitation, {});
  for (std::size_t n = 0; n < excitation.time.size(); ++n) {
    ASSERT_NEAR(apart.displacement[n], together.displacement[n], 1e-10);
  }
}

// Power put in is power stored and dissipated: the work of the excitation on a Maxwell element and a mass.
TEST(Respond, SeriesElementIsAMaxwellElement) {
  // Dashpot in series with a spring: F' / k_s + F / c = v up to the element's own damping; steady sine.
  const double w = 30.0;
  const double period = 2.0 * pi / w;
  const double compliance = 1e-5;
  const double dashpot = 4000.0;
  Vector time;
  for (int n = 0; n < 64; ++n) {
    time.push_back(period * n / 64.0);
  }
  Oscillator oscillator = oscillator_of(
      "viscous", {"compliance"},
      {{"c0", dashpot}, {"k0", 0.0}, {"f0", 0.0}, {"compliance.C", compliance}, {"compliance.tau", 5e-4}}, 20.0);
  oscillator.stiffness = 3e4;
  Excitation excitation;
  for (int turn = 0; turn < 30; ++turn) {
    for (const double t : time) {
      excitation.time.push_back(t + turn * period);
    }
  }
  excitation.force =
      Signal(time, of(time, [&](double t) { return 50.0 * std::cos(w * t); }), Interpolation::band_limited, true);
  const MassMotion response = respond(oscillator, excitation, {.tolerance = 1e-9});
  const std::complex<double> iw(0.0, w);
  const std::complex<double> element = iw * dashpot / (1.0 + dashpot * iw * compliance / (1.0 + iw * 5e-4));
  const std::complex<double> gain = 50.0 / (3e4 - 20.0 * w * w + element);
  for (std::size_t n = excitation.time.size() - 64; n < excitation.time.size(); ++n) {
    const double x = (gain * std::exp(iw * excitation.time[n])).real();
    ASSERT_NEAR(response.displacement[n], x, 1e-6 * std::abs(gain));
  }
}

TEST(Respond, OrderOfEqualSteps) {
  const Oscillator oscillator =
      oscillator_of("hyperbolic-tangent", {"cubic-stiffness"},
                    {{"cubic-stiffness.k3", 1e7}, {"k0", 5e3}, {"v_y", 0.1}, {"tau", 0.05}}, 10.0);
  Excitation excitation;
  excitation.time = times(20.0, 1.0);
  const Vector fine = times(400.0, 1.0);
  excitation.force =
      Signal(fine, of(fine, [](double t) { return 300.0 * std::sin(9.0 * t); }), Interpolation::band_limited, false);
  const MassMotion exact = respond(oscillator, excitation, {.tolerance = 1e-13});
  Vector errors;
  for (const int substeps : {2, 4, 8}) {
    const MassMotion response = respond(oscillator, excitation, {.substeps = substeps});
    double worst = 0.0;
    for (std::size_t n = 0; n < excitation.time.size(); ++n) {
      worst = std::max(worst, std::fabs(response.displacement[n] - exact.displacement[n]));
    }
    errors.push_back(worst);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 5.0, 0.8);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 5.0, 0.8);
}

// Of a multisine at 0.4 of half the sampling frequency; the theory of straight lines: error (w h)^2 / 8 at most.
TEST(Signal, BandLimitedIsExactWhereLinesAreNot) {
  const double rate = 100.0;
  Vector time;
  for (int n = 0; n < 200; ++n) {
    time.push_back(n / rate);
  }
  const auto truth = [](double t) { return std::sin(2.0 * pi * 20.0 * t) + 0.5 * std::cos(2.0 * pi * 3.0 * t + 0.4); };
  const auto slope = [](double t) {
    return 2.0 * pi * 20.0 * std::cos(2.0 * pi * 20.0 * t) - pi * 3.0 * std::sin(2.0 * pi * 3.0 * t + 0.4);
  };
  const Signal exact(time, of(time, truth), Interpolation::band_limited, true);
  const Signal lines(time, of(time, truth), Interpolation::linear, true);
  double worst = 0.0;
  double worst_slope = 0.0;
  double worst_line = 0.0;
  for (int n = 0; n < 3000; ++n) {
    const double t = 0.00123 * n;
    worst = std::max(worst, std::fabs(exact.value(t) - truth(t)));
    worst_slope = std::max(worst_slope, std::fabs(exact.slope(t) - slope(t)));
    worst_line = std::max(worst_line, std::fabs(lines.value(t) - truth(t)));
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(worst_slope, 1e-4);
  const double theory = std::pow(2.0 * pi * 20.0 / rate, 2) / 8.0;
  EXPECT_GT(worst_line, 0.7 * theory);
  EXPECT_LT(worst_line, 1.1 * theory);
}

TEST(Signal, CubicIsExactForParabolas) {
  Vector time = {0.0, 0.1, 0.25, 0.3, 0.55, 0.6, 0.8, 0.9};
  const auto parabola = [](double t) { return 1.0 + 2.0 * t - 3.0 * t * t; };
  const Signal signal(time, of(time, parabola), Interpolation::cubic, false);
  for (double t = 0.0; t < 0.9; t += 0.01) {
    ASSERT_NEAR(signal.value(t), parabola(t), 1e-13);
    ASSERT_NEAR(signal.slope(t), 2.0 - 6.0 * t, 1e-11);
  }
  EXPECT_THROW(Signal(time, of(time, parabola), Interpolation::band_limited, false), InputError);
}

TEST(Respond, RefusesWhatIsNoDeviceAndTellsWhatRunsAway) {
  Excitation excitation;
  excitation.time = times(100.0, 1.0);
  EXPECT_THROW(respond(oscillator_of("viscous", {"sensor-delay"}, {{"sensor-delay.lag", 1e-3}}, mass), excitation, {}),
               InputError);
  // A negative spring is no run-away of numbers within a second, a strong one is.
  Oscillator oscillator = oscillator_of("viscous", {"cubic-stiffness"}, {{"cubic-stiffness.k3", -1e12}}, mass);
  EXPECT_THROW(respond(oscillator, excitation, {.displacement = 0.1}), WorkError);
}

}  // namespace
}  // namespace hysteron

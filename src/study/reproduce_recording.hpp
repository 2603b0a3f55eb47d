// Simulated recordings of round trips: a damper with published parameters on a settled sine.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "simulate/composite.hpp"
#include "study/reproduce.hpp"

namespace hysteron::reproduce {

// Share of the peak force that the noise of a noisy recording has, as its standard deviation.
inline constexpr double noise_share = 0.01;

struct SineTest {
  double amplitude;  // m
  double frequency;  // Hz
  double drive;      // A or V
  DriveKind kind;
};

// Three periods of 100 samples after two to settle; white noise of `noise` times the peak force, drawn by `name`.
[[nodiscard]] Recording sine_recording(const CompositeModel& model, const std::vector<double>& parameters,
                                       const std::string& name, const SineTest& test, double noise);

// Title, budget, seeds, and an integration that is more exact than the deviations compared.
[[nodiscard]] Study round_trip(const ReproduceOptions& options, const std::string& title);
[[nodiscard]] ModelSpec model_on(const std::string& label, const std::string& model, std::vector<std::string> on);

// In percent; "-" where nothing is published to compare with.
[[nodiscard]] std::string deviation(double obtained, double published);
// Of a force predicted with a run's parameters on a recording it has not seen.
[[nodiscard]] double nrmse_on(const Plan& plan, std::size_t problem, const RunRecord& run, const Recording& unseen);
// Least squares coefficients of 1, x, x^2, ...
[[nodiscard]] std::vector<double> polynomial_through(const std::vector<double>& x, const std::vector<double>& y,
                                                     int order);

}  // namespace hysteron::reproduce

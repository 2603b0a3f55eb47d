#include "study/sine_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "fit/driver.hpp"

namespace hysteron {

namespace {

// Times at which the displacement rises through the middle, coming from a quarter of the half range below it.
std::vector<double> rises(const Recording& recording, double middle, double half) {
  std::vector<double> result;
  bool armed = false;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double x = recording.displacement[n] - middle;
    if (x < -0.25 * half) armed = true;
    if (!armed || x < 0.0 || n == 0) continue;
    const double before = recording.displacement[n - 1] - middle;
    const double share = x > before ? x / (x - before) : 0.0;
    result.push_back(recording.time[n] - share * (recording.time[n] - recording.time[n - 1]));
    armed = false;
  }
  return result;
}

}  // namespace

SineFit fit_sine(const Recording& recording, std::size_t budget) {
  const auto [low, high] = std::ranges::minmax(recording.displacement);
  const double half = 0.5 * (high - low);
  const double middle = 0.5 * (high + low);
  const double start = recording.time.front();
  const double length = recording.time.back() - start;
  const std::vector<double> rising = rises(recording, middle, half);
  if (rising.size() < 2) throw InputError(recording.file + ": the motion has no whole period, expected a sine");
  const double about = static_cast<double>(rising.size() - 1) / (rising.back() - rising.front());
  // Half a period more or fewer in the whole recording is another optimum.
  const double wide = std::min(0.2 * about, 0.25 / length);
  // Unit coordinates: amplitude 0 to 2 half ranges, frequency about +- wide, phase at the start 0 to 2 pi.
  const auto sine_of = [&](const double* u) {
    return SineFit{2.0 * half * u[0], about + wide * (2.0 * u[1] - 1.0), 2.0 * std::numbers::pi * u[2], middle, 0.0};
  };
  const auto rms = [&](const SineFit& sine) {
    double sum = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double t = recording.time[n] - start;
      const double angle = 2.0 * std::numbers::pi * sine.frequency * t + sine.phase;
      const double off = recording.displacement[n] - middle - sine.amplitude * std::sin(angle);
      sum += off * off;
    }
    return std::sqrt(sum / static_cast<double>(recording.size()));
  };
  Problem problem;
  problem.dimension = 3;
  problem.budget = budget;
  problem.stream = Stream(1).child("sine");
  problem.linear.assign(3, false);
  const double turns_before = about * (rising.front() - start);
  problem.start = {0.5, 0.5, std::ceil(turns_before) - turns_before};
  const RunResult run = run_solver(*find_solver("nelder-mead"), problem, [&](const Request& request) {
    Response response;
    for (std::size_t first = 0; first < request.points.size(); first += 3) {
      response.cost.push_back(rms(sine_of(request.points.data() + first)) / half);
    }
    return response;
  });
  SineFit sine = sine_of(run.best.data());
  sine.rms = rms(sine);
  // The phase at time zero.
  const double turns = sine.phase / (2.0 * std::numbers::pi) - sine.frequency * start;
  sine.phase = 2.0 * std::numbers::pi * (turns - std::floor(turns));
  return sine;
}

Recording with_motion_of(const SineFit& sine, Recording recording) {
  const double omega = 2.0 * std::numbers::pi * sine.frequency;
  recording.acceleration.clear();
  recording.derived_acceleration.resize(recording.size());
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double angle = omega * recording.time[n] + sine.phase;
    recording.displacement[n] = sine.amplitude * std::sin(angle);
    recording.velocity[n] = sine.amplitude * omega * std::cos(angle);
    recording.derived_acceleration[n] = -omega * omega * recording.displacement[n];
  }
  return recording;
}

}  // namespace hysteron

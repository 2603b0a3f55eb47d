#include "datasets/support/stepped_voltage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "presets/support/bouc_wen_form.hpp"
#include "simulate/composite.hpp"

namespace hysteron {
namespace {

constexpr double rate = 1000.0;  // samples a second
constexpr double duration = 3.0;
constexpr double quiet = 0.5;
constexpr double step_length = 0.17;
constexpr std::array<double, 11> levels{5.0, 0.0, 2.5, 1.0, 4.0, 0.5, 3.0, 5.0, 1.5, 3.5, 0.0};

struct Run {
  const char* file;
  double frequency;   // Hz
  double amplitude;   // m
  std::size_t first;  // of the levels
  Role role;
};
constexpr Run runs[] = {{"1.0Hz_15mm.csv", 1.0, 0.015, 0, Role::fit},
                        {"2.0Hz_10mm.csv", 2.0, 0.010, 3, Role::fit},
                        {"3.0Hz_5mm.csv", 3.0, 0.005, 6, Role::fit},
                        {"1.5Hz_12mm.csv", 1.5, 0.012, 8, Role::validate}};

double command_at(double t, std::size_t first) {
  if (t < quiet) return 0.0;
  return levels[(first + static_cast<std::size_t>((t - quiet) / step_length + 1e-9)) % levels.size()];
}

}  // namespace

Campaign stepped_voltage_campaign(const VoltageDamper& damper, double noise, const Stream& stream) {
  Campaign campaign;
  campaign.model = "bouc-wen";
  campaign.by_current = {{"alpha", 1}, {"c0", 1}};
  const CompositeModel model = make_model("bouc-wen", {});
  const std::size_t count = model.parameter_count();
  for (const Run& run : runs) {
    Recording recording;
    recording.file = run.file;
    recording.drive_kind = DriveKind::voltage;
    recording.velocity_measured = true;
    recording.start = Start::from_nothing;
    const double omega = 2.0 * std::numbers::pi * run.frequency;
    std::vector<double> parameters;
    double u = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(duration * rate) + 1; ++k) {
      const double t = static_cast<double>(k) / rate;
      recording.time.push_back(t);
      recording.displacement.push_back(run.amplitude * std::sin(omega * t));
      recording.velocity.push_back(run.amplitude * omega * std::cos(omega * t));
      recording.drive.push_back(command_at(t, run.first));
      // Exact for a command that is linear between the samples, as a recorded one is taken to be.
      if (k > 0) {
        const double before = recording.drive[k - 1];
        const double behind = (recording.drive[k] - before) * rate / damper.eta;
        u = recording.drive[k] - behind + (u - before + behind) * std::exp(-damper.eta / rate);
      }
      const NormalForm z =
          normal_form(damper.alpha_a + damper.alpha_b * u, damper.A, damper.gamma, damper.beta, damper.n);
      for (const double value :
           {z.yield_force, damper.c0a + damper.c0b * u, damper.k0, -damper.k0 * damper.x0, z.x_y, z.share, damper.n}) {
        parameters.push_back(value);
      }
    }
    const Motion motion = make_motion(recording.time, recording.displacement, recording.velocity, {}, 1e-8);
    std::vector<double> state(static_cast<std::size_t>(model.states()), 0.0);
    recording.force.resize(recording.size());
    model.march<double>(motion, parameters.data(), count, 0, recording.size(), state.data(), recording.force.data());
    double peak = 0.0;
    for (const double force : recording.force) peak = std::max(peak, std::fabs(force));
    const Stream draws = stream.child(recording.file);
    for (std::size_t k = 0; k < recording.size(); ++k) recording.force[k] += noise * peak * draws.normal(k);
    campaign.recordings.push_back(std::move(recording));
    campaign.roles.push_back(run.role);
  }
  return campaign;
}

}  // namespace hysteron

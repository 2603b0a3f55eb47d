// rd8040-twin: the damper RD-8040-1 as the PSO paper identified it (equations 16 to 23), over its 55 conditions.
//   x = 25 mm sin(2 pi f t), f = 0.4 .. 2.0 Hz in steps of 0.4, i = 0 .. 1 A in steps of 0.1
//   modified Bouc-Wen with offset force; alpha = 80, n = 1, x0 = 0, SI units
// Three periods at 100 samples a period, starting in the settled cycle; white noise of 1 % of the peak force on the
// force channel. The original recordings are not public: this is a stand-in made of the published parameters. For many
// conditions the published k0 is negative, for some beta or gamma is; they are used as printed.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "datasets/dataset.hpp"
#include "presets/support/rd8040_polynomials.hpp"
#include "simulate/composite.hpp"

namespace hysteron {

extern const DatasetEntry dataset_rd8040_twin;

namespace {

constexpr double amplitude = 0.025;  // m
constexpr double noise_share = 0.01;
constexpr int periods = 3;
constexpr int settling_periods = 2;
constexpr int samples_per_period = 100;

Campaign generate(const Stream& stream) {
  Campaign campaign;
  campaign.model = "modified-bouc-wen";
  const CompositeModel model = make_model("modified-bouc-wen", {"offset-force"});
  for (int fi = 1; fi <= 5; ++fi) {
    for (int ci = 0; ci <= 10; ++ci) {
      const double f = 0.4 * fi;
      const double current = 0.1 * ci;
      const double gamma = rd8040::gamma(current, f);
      const double sum = rd8040::beta(current, f) + gamma;
      // Normal form, see models/modified_bouc_wen.cpp; n = 1.
      const double z_scale = rd8040::A(current, f) / sum;
      const std::vector<double> parameters{80.0 * z_scale,
                                           rd8040::c0(current, f),
                                           rd8040::c1(current, f),
                                           rd8040::k0(current, f),
                                           rd8040::k1(current, f),
                                           1.0 / sum,
                                           gamma / sum,
                                           1.0,
                                           0.0,
                                           rd8040::f0(current, f)};
      Recording recording;
      recording.file = std::to_string(fi * 4 / 10) + "." + std::to_string(fi * 4 % 10) + "Hz_" +
                       std::to_string(ci / 10) + "." + std::to_string(ci % 10) + "A.csv";
      recording.drive_kind = DriveKind::current;
      recording.velocity_measured = true;
      const double omega = 2.0 * std::numbers::pi * f;
      const int all = (settling_periods + periods) * samples_per_period + 1;
      std::vector<double> time;
      std::vector<double> x;
      std::vector<double> v;
      for (int n = 0; n < all; ++n) {
        const double t = n / (f * samples_per_period);
        time.push_back(t);
        x.push_back(amplitude * std::sin(omega * t));
        v.push_back(amplitude * omega * std::cos(omega * t));
      }
      const std::vector<double> force = simulate(model, make_motion(time, x, v, {}, 1e-8), parameters);
      double peak = 0.0;
      for (const double value : force) {
        peak = std::max(peak, std::fabs(value));
      }
      const Stream noise = stream.child(recording.file);
      constexpr std::size_t first = std::size_t{settling_periods} * samples_per_period;
      for (std::size_t k = first; k < time.size(); ++k) {
        recording.time.push_back(time[k] - time[first]);
        recording.displacement.push_back(x[k]);
        recording.velocity.push_back(v[k]);
        recording.force.push_back(force[k] + noise_share * peak * noise.normal(k));
        recording.drive.push_back(current);
      }
      campaign.recordings.push_back(std::move(recording));
      campaign.roles.push_back(Role::unassigned);
    }
  }
  return campaign;
}

}  // namespace

const DatasetEntry dataset_rd8040_twin = {
    "rd8040-twin", "Simulated twin of the MR damper RD-8040-1 over 55 conditions",
    "identified parameters (16)-(23) of the PSO-against-GA study of the RD-8040-1, 2021",
    "0.4 to 2 Hz, 0 to 1 A, 25 mm sines, three settled periods of 100 samples; truth: modified-bouc-wen + "
    "offset-force\n"
    "with the published polynomials; white force noise of 1 % of each recording's peak force from the seed.",
    &generate};

}  // namespace hysteron

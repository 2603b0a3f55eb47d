// Time of a whole diagnosis of six recordings with 30,000 samples in all: a Bouc-Wen damper at two levels of the drive,
// with an effect hidden in the force and with none. Threads as OMP_NUM_THREADS says.
#include "diagnose/diagnose.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"

namespace hysteron {
namespace {

constexpr std::size_t samples = 5000;
constexpr double rate = 1000.0;  // Hz
constexpr double noise = 0.01;   // of the peak force

Campaign campaign_with(const std::vector<std::string>& effects, const std::vector<double>& effect_parameters) {
  const CompositeModel model = make_model("bouc-wen", effects);
  const Stream stream = Stream(1).child("diagnosis");
  Campaign campaign;
  campaign.model = "bouc-wen";
  campaign.by_current = {{"alpha", 1}, {"c0", 1}};
  for (const double level : {0.0, 1.0}) {
    for (const double frequency : {0.8, 2.0, 4.0}) {
      Recording recording;
      recording.file = std::to_string(campaign.recordings.size()) + ".csv";
      recording.velocity_measured = true;
      recording.drive_kind = DriveKind::current;
      const double omega = 2.0 * std::numbers::pi * frequency;
      const double amplitude = 0.02 / std::sqrt(frequency);
      for (std::size_t n = 0; n < samples; ++n) {
        const double t = static_cast<double>(n) / rate;
        recording.time.push_back(t);
        recording.displacement.push_back(amplitude * std::sin(omega * t));
        recording.velocity.push_back(amplitude * omega * std::cos(omega * t));
        recording.drive.push_back(level);
      }
      std::vector<double> parameters = {200.0 + 600.0 * level, 600.0 + 900.0 * level, 1000.0, 0.0, 1.5e-3, 0.5, 1.5};
      parameters.insert(parameters.end(), effect_parameters.begin(), effect_parameters.end());
      const Motion motion =
          make_motion(recording.time, recording.displacement, recording.velocity, recording.drive, 1e-6);
      recording.force = simulate(model, motion, parameters);
      const double peak = std::fabs(
          *std::ranges::max_element(recording.force, [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
      for (std::size_t n = 0; n < samples; ++n) {
        recording.force[n] += noise * peak * stream.normal(n, static_cast<std::uint32_t>(campaign.recordings.size()));
      }
      campaign.recordings.push_back(recording);
      campaign.roles.push_back(Role::unassigned);
    }
  }
  return campaign;
}

void diagnose_campaign(benchmark::State& bench, const Campaign& campaign) {
  DiagnoseOptions options;
  options.model = campaign.model;
  options.layout.by_current = campaign.by_current;
  for (auto _ : bench) {
    const auto diagnosis = diagnose(campaign, options, [](double, const std::string&) {});
    std::string said(name_of(diagnosis->verdict.answer));
    for (const Named& named : diagnosis->verdict.effects) {
      said += " " + named.id;
    }
    bench.SetLabel(said);
  }
}

}  // namespace
}  // namespace hysteron

int main(int argc, char** argv) {
  using namespace hysteron;
  const auto add = [](const std::string& name, const Campaign& campaign) {
    benchmark::RegisterBenchmark(("diagnose/" + name).c_str(), diagnose_campaign, campaign)
        ->Unit(benchmark::kSecond)
        ->Iterations(1)
        ->UseRealTime();
  };
  add("none", campaign_with({}, {}));
  add("inertia", campaign_with({"inertia"}, {12.0}));
  add("clearance", campaign_with({"clearance"}, {1e-3, 1e-7, 10.0, 5e-4}));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

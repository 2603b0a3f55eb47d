// The response of the law `hysteretic-spring` with the parameters of the published equations is that of the dataset.
#include <gtest/gtest.h>

#include <cmath>

#include "datasets/dataset.hpp"
#include "respond/respond.hpp"

namespace hysteron {
namespace {

constexpr std::size_t period = 8192;

// RMS of what the simulated displacement differs by over the last period.
double error_of(const Recording& recording, Interpolation interpolation) {
  const CompositeModel model = make_model("hysteretic-spring", {});
  const std::map<std::string, double> truth = {{"k_z", 5e4}, {"c0", 10.0},   {"k0", 5e4},
                                               {"f0", 0.0},  {"on", -300.0}, {"off", 1900.0}};
  std::vector<double> parameters;
  for (const std::string& name : model.parameter_names()) {
    parameters.push_back(truth.at(name));
  }
  Excitation excitation;
  excitation.time = recording.time;
  excitation.force = Signal(recording.time, recording.force, interpolation, false);
  const std::vector<double> motion =
      respond({model, [&](double, std::span<const double>) { return parameters; }, 2.0, 0.0, 0.0}, excitation, {})
          .displacement;
  double square = 0.0;
  for (std::size_t n = motion.size() - period; n < motion.size(); ++n) {
    square += std::pow(motion[n] - recording.displacement[n], 2.0);
  }
  return std::sqrt(square / static_cast<double>(period));
}

TEST(HystereticSpring, RespondsAsThePublishedOscillator) {
  const Campaign campaign = find_dataset("hysteretic-oscillator")->generate(Stream(1));
  const Recording& test = campaign.recordings[1];
  EXPECT_LT(error_of(test, Interpolation::band_limited), 2e-8);
  // What straight lines between the samples of the force are off by is what the best published models are off by.
  EXPECT_NEAR(error_of(test, Interpolation::linear), 7.3e-6, 1.5e-6);
  EXPECT_NEAR(error_of(campaign.recordings[0], Interpolation::band_limited), 8e-6, 0.3e-6);
}

}  // namespace
}  // namespace hysteron

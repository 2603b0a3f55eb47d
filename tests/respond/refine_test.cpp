// Identification from the motion of a mass: what is put in comes out, within what the noise allows.
#include "respond/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/random.hpp"
#include "respond/respond.hpp"

namespace hysteron {
namespace {

constexpr double rate = 500.0;  // Hz
const std::map<std::string, double> truth = {{"alpha", 60},   {"c0", 300},    {"k0", 2000}, {"f0", 0},
                                             {"x_y", 0.0008}, {"share", 0.6}, {"n", 1.5}};
const Rig rig{20.0, 8000.0, 0.0, Interpolation::cubic};

std::vector<double> parameters_of(const CompositeModel& model) {
  std::vector<double> result;
  for (const std::string& name : model.parameter_names()) {
    result.push_back(truth.at(name));
  }
  return result;
}

std::vector<double> slope_of(const std::vector<double>& values) {
  std::vector<double> result(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    const std::size_t low = n == 0 ? 0 : n - 1;
    const std::size_t high = std::min(n + 1, values.size() - 1);
    result[n] = (values[high] - values[low]) * rate / static_cast<double>(high - low);
  }
  return result;
}

// The motion under a sum of sines of `amplitude` N each, recorded with noise of `noise` m in the displacement; without
// amplitude a free decay from 30 mm, which records no force.
Recording shaken(double amplitude, double noise, std::uint64_t seed) {
  const Stream stream(seed);
  constexpr std::size_t count = 2000;
  Recording recording;
  recording.file = "shaken-" + std::to_string(seed) + ".csv";
  std::vector<double> force(count, 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    recording.time.push_back(static_cast<double>(n) / rate);
    for (std::size_t k = 0; k < 20; ++k) {
      force[n] += amplitude * std::sin(2.0 * std::numbers::pi *
                                       ((1.0 + 0.45 * static_cast<double>(k)) * recording.time[n] + stream.uniform(k)));
    }
  }
  const CompositeModel model = make_model("bouc-wen", {});
  RespondOptions with;
  with.displacement = amplitude > 0.0 ? 0.0 : 0.03;
  Excitation excitation;
  excitation.time = recording.time;
  excitation.force = Signal(recording.time, force, Interpolation::cubic, false);
  const MassMotion motion = respond({model, [&](double, std::span<const double>) { return parameters_of(model); },
                                     rig.mass, rig.stiffness, rig.damping},
                                    excitation, with);
  recording.displacement = motion.displacement;
  for (std::size_t n = 0; n < count; ++n) {
    recording.displacement[n] += noise * stream.normal(1000 + n);
  }
  recording.velocity = noise > 0.0 ? slope_of(recording.displacement) : motion.velocity;
  recording.derived_acceleration = noise > 0.0 ? slope_of(recording.velocity) : motion.acceleration;
  if (amplitude > 0.0) {
    recording.force = force;
  }
  return recording;
}

struct Fitted {
  Identification identification;
  ResponseFit response;
};

Fitted fitted_to(const std::vector<Recording>& responses) {
  Campaign campaign;
  campaign.recordings = damper_recordings(responses, rig);
  campaign.roles.assign(responses.size(), Role::unassigned);
  IdentifyOptions options;
  options.budget = 4000;
  options.layout.fix = {{"f0", 0.0}};
  Fitted result{identify(campaign, "bouc-wen", options, {}), {}};
  result.response = refine(result.identification, responses, rig, options, {});
  return result;
}

TEST(DamperRecordings, HoldTheForceOfTheEquationOfMotion) {
  const Recording response = shaken(20.0, 0.0, 1);
  const CompositeModel model = make_model("bouc-wen", {});
  RespondOptions with;
  Excitation excitation;
  excitation.time = response.time;
  excitation.force = Signal(response.time, response.force, Interpolation::cubic, false);
  const std::vector<double> force =
      respond({model, [&](double, std::span<const double>) { return parameters_of(model); }, rig.mass, rig.stiffness,
               rig.damping},
              excitation, with)
          .force;
  const std::vector<Recording> damper = damper_recordings({response}, rig);
  for (std::size_t n = 0; n < force.size(); ++n) {
    ASSERT_NEAR(damper[0].force[n], force[n], 1e-6) << n;
  }
}

TEST(DamperRecordings, WantAnAcceleration) {
  Recording response = shaken(20.0, 0.0, 1);
  response.derived_acceleration.clear();
  EXPECT_THROW(damper_recordings({response}, rig), InputError);
}

// The descent brings the motion down to its noise, which the equation of motion does not, and the parameters within
// three of their standard errors and three per cent.
TEST(Refine, FindsTheDamperBehindAShakenMass) {
  const double noise = 3e-5;
  const Fitted fit = fitted_to({shaken(20.0, noise, 1), shaken(40.0, noise, 2)});
  EXPECT_LT(fit.response.cost, 0.8 * fit.response.before);
  for (const ResponseScore& score : fit.response.scores) {
    EXPECT_NEAR(score.rmse, noise, 0.1 * noise) << score.file;
  }
  for (const Estimate& estimate : fit.identification.estimates) {
    ASSERT_TRUE(estimate.std_error) << estimate.name;
    const double error = std::fabs(estimate.term.value - truth.at(estimate.name));
    EXPECT_LT(error, 3.5 * *estimate.std_error) << estimate.name;
    EXPECT_LT(error, 0.03 * truth.at(estimate.name)) << estimate.name;
  }
}

TEST(Refine, TakesAFreeDecayWithoutAForce) {
  const double noise = 1e-5;
  const Fitted fit = fitted_to({shaken(0.0, noise, 3)});
  EXPECT_NEAR(fit.response.scores[0].rmse, noise, 0.1 * noise);
  for (const Estimate& estimate : fit.identification.estimates) {
    EXPECT_LT(std::fabs(estimate.term.value - truth.at(estimate.name)), 0.1 * truth.at(estimate.name)) << estimate.name;
  }
}

TEST(Refine, AMassThatDoesNotMoveIsAnInputError) {
  Recording still = shaken(20.0, 0.0, 1);
  Fitted fit = fitted_to({still});
  std::ranges::fill(still.displacement, 0.0);
  EXPECT_THROW(refine(fit.identification, {still}, rig, {}, {}), InputError);
}

// A slow force moves a light mass on a spring by force / stiffness: one per cent more stiffness, one per cent less
// motion.
TEST(Refine, SensitivityOfASlowMotionToItsSpringIsOne) {
  const Rig light{0.01, 0.0, 0.0, Interpolation::cubic};
  const double stiffness = 2000.0;
  const double omega = 2.0 * std::numbers::pi * 0.5;
  Recording recording;
  recording.file = "slow.csv";
  for (std::size_t n = 0; n < 2000; ++n) {
    const double t = static_cast<double>(n) / rate;
    recording.time.push_back(t);
    recording.force.push_back(20.0 * std::sin(omega * t));
    recording.displacement.push_back(recording.force.back() / stiffness);
    recording.velocity.push_back(20.0 / stiffness * omega * std::cos(omega * t));
    recording.derived_acceleration.push_back(-omega * omega * recording.displacement.back());
  }
  Campaign campaign;
  campaign.recordings = damper_recordings({recording}, light);
  campaign.roles.assign(1, Role::unassigned);
  IdentifyOptions options;
  options.budget = 400;
  options.layout.fix = {{"f0", 0.0}, {"c0", 1.0}};
  Identification result = identify(campaign, "viscous", options, {});
  refine(result, {recording}, light, options, {});
  ASSERT_EQ(result.sensitivities.size(), 1U);
  EXPECT_NEAR(result.sensitivities[0].value, 1.0, 0.01);
}

}  // namespace
}  // namespace hysteron

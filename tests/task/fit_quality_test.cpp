// What a fit's record says of its parameters, of what is left over and of its starts.
#include "task/fit_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "task/residual_record.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

Campaign damper(const std::vector<double>& currents) {
  Campaign campaign;
  for (const double current : currents) {
    Recording recording;
    recording.file = "r" + std::to_string(campaign.recordings.size()) + ".csv";
    recording.velocity_measured = true;
    const Stream stream = Stream(3).child(recording.file);
    for (std::size_t n = 0; n < 300; ++n) {
      const double t = static_cast<double>(n) / 100.0;
      const double omega = 2.0 * std::numbers::pi;
      recording.time.push_back(t);
      recording.displacement.push_back(0.02 * std::sin(omega * t));
      recording.velocity.push_back(0.02 * omega * std::cos(omega * t));
      recording.force.push_back((2000.0 + 1500.0 * current) * recording.velocity.back() +
                                9000.0 * recording.displacement.back() + 10.0 * stream.normal(n));
    }
    recording.drive.assign(recording.size(), current);
    recording.drive_kind = DriveKind::current;
    campaign.recordings.push_back(std::move(recording));
    campaign.roles.push_back(Role::unassigned);
  }
  return campaign;
}

Identification fitted(const Campaign& campaign, const std::vector<std::string>& effects, bool law) {
  IdentifyOptions options;
  options.budget = 600;
  options.effects = effects;
  if (law) options.layout.by_current["c0"] = 1;
  return identify(campaign, "viscous", options, {});
}

TEST(FitQuality, ThePairThatIsKnownTogetherOnlyIsNamed) {
  const Identification result = fitted(damper({0.0}), {"offset-force"}, false);
  const json found = correlation_json(result, DriveKind::current);
  ASSERT_EQ(found.at("inseparable").size(), 1U) << found.dump();
  EXPECT_EQ(found["inseparable"][0]["parameters"], (json{"f0", "offset-force.f0"}));
  EXPECT_TRUE(found["note"].get<std::string>().starts_with(
      "These recordings do not separate f0 and offset-force.f0 (r = -1.000): "))
      << found["note"];
}

TEST(FitQuality, ValuesOfALawStandForItsParameter) {
  const Identification result = fitted(damper({0.0, 1.0}), {}, true);
  const json found = correlation_json(result, DriveKind::current);
  EXPECT_EQ(found.at("names"), (json{"c0 at 0 A", "c0 at 1 A", "k0", "f0"}));
  EXPECT_TRUE(found.at("inseparable").empty());
  EXPECT_TRUE(found["note"].get<std::string>().starts_with("These recordings separate every two parameters"));
  const json sensitivity = sensitivity_json(result);
  ASSERT_EQ(sensitivity.size(), 3U);
  EXPECT_EQ(sensitivity[0]["parameter"], "c0");
  // Both recordings weigh the same over their own largest force.
  double squares = 0.0;
  double all = 0.0;
  for (const double c : {2000.0, 3500.0}) {
    const double damping = c * 2.0 * std::numbers::pi;
    squares += damping * damping / (damping * damping + 81e6);
    all += 1.0;
  }
  EXPECT_NEAR(sensitivity[0]["value"].get<double>(), std::sqrt(squares / all), 0.01);
}

TEST(FitQuality, StartsAreSortedAndThoseAtTheBestCounted) {
  RunResult run;
  run.ends.cost = {0.3, 0.1, 0.10001, 0.2};
  run.ends.diverged = 1;
  const json found = starts_json(run);
  EXPECT_EQ(found.at("costs"), (json{0.1, 0.10001, 0.2, 0.3}));
  EXPECT_EQ(found.at("reached"), 2);
  EXPECT_EQ(found.at("diverged"), 1);
  run.ends.cost = {0.1};
  EXPECT_TRUE(starts_json(run).is_null());
}

// White noise of a known size: the criteria in closed form.
TEST(ResidualRecord, CriteriaOfWhiteNoise) {
  constexpr std::size_t count = 40000;
  constexpr double deviation = 0.02;
  const Stream stream(9);
  Recording recording;
  std::vector<double> force;
  for (std::size_t n = 0; n < count; ++n) {
    recording.time.push_back(static_cast<double>(n));
    recording.force.push_back(100.0 * std::cos(static_cast<double>(n)));
    force.push_back(recording.force.back() - 100.0 * deviation * stream.normal(n));
  }
  recording.force[0] = 100.0;
  force[0] = 100.0;
  const std::vector<double> residual = normalised_residual(recording, force, Normalisation::max_abs);
  const json found = residual_json(residual_facts({residual}), 5);
  const double n = found.at("effective_samples");
  EXPECT_NEAR(n, count, 0.03 * count);
  const double likelihood = n * std::log(deviation * deviation);
  // The logarithm of a mean square of n values has the standard deviation sqrt(2 / n).
  EXPECT_NEAR(found.at("aic").get<double>(), likelihood + 10.0, 4.0 * std::sqrt(2.0 * n));
  EXPECT_NEAR(found.at("bic").get<double>() - found.at("aic").get<double>(), 5.0 * std::log(n) - 10.0, 1e-6);
}

}  // namespace
}  // namespace hysteron

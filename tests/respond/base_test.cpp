// Identification on a base that moves, and models that cannot respond.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "io/velocity.hpp"
#include "respond/refine.hpp"
#include "respond/respond.hpp"

namespace hysteron {
namespace {

constexpr double rate = 500.0;  // Hz

// A mass of 20 kg on a spring of 8000 N/m beside a Kelvin-Voigt damper, on a base that moves.
Rig table() {
  Rig rig{20.0, 8000.0, 0.0, Interpolation::cubic};
  rig.base = true;
  return rig;
}

Recording on_base() {
  Recording recording;
  recording.file = "table.csv";
  for (std::size_t n = 0; n < 1000; ++n) {
    const double t = static_cast<double>(n) / rate;
    const double rise = std::min(t / 0.5, 1.0);
    const double window = rise * rise * rise * (10.0 - 15.0 * rise + 6.0 * rise * rise);
    double b = 0.0;
    for (const double f : {1.3, 2.9, 4.1}) b += 2e-3 * std::sin(2.0 * std::numbers::pi * f * t);
    recording.time.push_back(t);
    recording.base.push_back(window * b);
  }
  Oscillator oscillator{make_model("viscous", {}),
                        [](double, std::span<const double>) {
                          return std::vector<double>{180.0, 1500.0, 0.0};
                        },
                        20.0, 8000.0, 0.0};
  Excitation excitation;
  excitation.time = recording.time;
  excitation.base = Signal(recording.time, recording.base, Interpolation::cubic, false);
  recording.displacement = respond(oscillator, excitation, {}).displacement;
  recording.velocity = derive_velocity(recording.time, recording.displacement);
  recording.derived_acceleration =
      derive_acceleration(recording.time, recording.displacement, recording.velocity, false);
  return recording;
}

TEST(OnABase, TheDamperIsRecovered) {
  Campaign campaign;
  const std::vector<Recording> responses = {on_base()};
  campaign.recordings = damper_recordings(responses, table());
  campaign.roles = {Role::unassigned};
  IdentifyOptions options;
  options.budget = 600;
  options.layout.fix = {{"f0", 0.0}};
  Identification result = identify(campaign, "viscous", options, {});
  const ResponseFit fit = refine(result, responses, table(), options, {});
  EXPECT_LT(fit.cost, 1e-5);
  EXPECT_LT(fit.cost, fit.before);
  const std::vector<double> p = parameters_at(result.layout.held(), result.terms, 0.0, 0.0, {});
  EXPECT_NEAR(p[0], 180.0, 0.1);
  EXPECT_NEAR(p[1], 1500.0, 1.0);
  ASSERT_EQ(fit.motions.size(), 1U);
  EXPECT_EQ(fit.motions[0].displacement.size(), responses[0].size());
}

// m (a + b'') + F = 0, with the damper at rest at the start; the end has one side as well.
TEST(OnABase, TheFirstAndTheLastAccelerationAreThoseOfTheWholeBase) {
  std::vector<double> time;
  std::vector<double> base;
  constexpr double omega = 2.0 * std::numbers::pi * 1.4;
  for (std::size_t n = 0; n <= 500; ++n) {
    time.push_back(static_cast<double>(n) / rate);
    base.push_back(0.02 * (1.0 - std::cos(omega * time.back())));
  }
  Oscillator oscillator{make_model("viscous", {}),
                        [](double, std::span<const double>) {
                          return std::vector<double>{2000.0, 8000.0, 0.0};
                        },
                        100.0, 0.0, 0.0};
  Excitation excitation;
  excitation.time = time;
  excitation.base = Signal(time, base, Interpolation::cubic, false);
  const MassMotion motion = respond(oscillator, excitation, {});
  for (const std::size_t n : {std::size_t{0}, time.size() - 1}) {
    const double of_base = 0.02 * omega * omega * std::cos(omega * time[n]);
    EXPECT_NEAR(motion.acceleration[n], -of_base - motion.force[n] / 100.0, 0.02 * std::fabs(of_base)) << n;
  }
}

TEST(OnABase, ABaseIsWantedAndNotByStraightLines) {
  Recording without = on_base();
  without.base.clear();
  EXPECT_THROW(damper_recordings({without}, table()), InputError);
  Rig straight = table();
  straight.interpolation = Interpolation::linear;
  const std::vector<Recording> responses = {on_base()};
  const Layout layout(make_model("viscous", {}), scale_of(damper_recordings(responses, table())), {});
  EXPECT_THROW(refuse_if_not_responding(layout, responses, straight), InputError);
  EXPECT_NO_THROW(refuse_if_not_responding(layout, responses, table()));
}

TEST(Response, AModelThatCannotRespondIsRefusedBeforeItIsFitted) {
  const std::vector<Recording> responses = {on_base()};
  const Layout layout(make_model("viscous", {"sensor-delay"}), scale_of(damper_recordings(responses, table())), {});
  EXPECT_THROW(refuse_if_not_responding(layout, responses, table()), InputError);
}

}  // namespace
}  // namespace hysteron
